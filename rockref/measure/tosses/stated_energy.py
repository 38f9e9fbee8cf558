"""Whether tosses gain energy at an impact: what stated velocities say from frame to frame, and around the impact."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.measure.records.toss import Toss

#: Share of the energy that a toss loses altogether by which it must rise to count; decided: in free flight the energies
#: of neighbouring frames of the public tosses rise by 2.0 % at most.
RISE = 0.02
#: Frames before and after the first contact between which a rise is looked for, and over which the energy is compared
#: where the filter of the velocities, a running median of three frames, reaches no more.
NEAR, CLEAR = 4, 3


def stated_energy(toss: Toss, centre: np.ndarray, inertia_over_mass: np.ndarray, g: float) -> np.ndarray:
    """Return (N,) energy over the mass [m2/s2] of every frame with the velocities that the table states.

    centre (3,) of mass from the tracked point, body axes [m]; inertia_over_mass (3,) principal [m2]; g [m/s2].
    """
    assert toss.v is not None and toss.W is not None
    v = toss.v + (toss.Lambda @ np.cross(toss.W, centre)[..., None])[..., 0]
    z = toss.x[:, 2] + toss.Lambda[:, 2] @ centre
    return np.sum(v**2, axis=1) / 2 + toss.W**2 @ inertia_over_mass / 2 + g * z


def rises(
    tosses: Sequence[Toss], first: np.ndarray, centre: np.ndarray, inertia_over_mass: np.ndarray, g: float
) -> dict[str, float]:
    """Return how many tosses gain energy at their first impact, at frame `first` (B,): two ways to look, empty without
    rates.

    from_frame_to_frame : by two neighbouring frames near it, `largest` the most;  largest_in_flight : the same in the
    frames before, where nothing acts: what the table's own noise makes;  around : from `CLEAR` frames before to as many
    after.
    """
    step, flight, around = [], [], []
    for toss, f in zip(tosses, first, strict=True):
        if toss.v is None or toss.W is None or f + CLEAR >= toss.frames:
            continue
        E = stated_energy(toss, centre, inertia_over_mass, g)
        lost = E[0] - E[-1]
        step.append(np.max(np.diff(E[max(f - NEAR, 0) : f + NEAR + 1])) / lost)
        # The running median reaches one frame ahead.
        flight.append(np.max(np.diff(E[: max(int(f) - 1, 2)])) / lost)
        around.append((E[f + CLEAR] - E[max(f - CLEAR, 0)]) / lost)
    if not step:
        return {}
    return {
        "tosses": len(step), "from_frame_to_frame": int(np.sum(np.array(step) > RISE)), "largest": float(max(step)),
        "largest_in_flight": float(max(flight)),
        "around": int(np.sum(np.array(around) > 0)), "least_loss_around": -float(max(around)),
    }  # fmt: skip
