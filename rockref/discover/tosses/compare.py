"""Models beside measured tosses: errors by start and by use, by stretch, and what needs no contact model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.tosses.body import frames_of, nominal_corners, nominal_model, throw_frame
from rockref.discover.tosses.errors import Errors, errors
from rockref.discover.tosses.ledger import ledger
from rockref.discover.tosses.predict import CLEARANCE, STARTS, predict
from rockref.discover.tosses.stretches import by_stretch, stretch_of
from rockref.measure.reading.keys import USES
from rockref.measure.records.toss import Toss, Tosses
from rockref.measure.tosses import flat_sliding, impact_balance, stated_energy
from rockref.measure.tosses.flight import Poses, flight_frames, side_by_side
from rockref.model.errors import InputError

#: Errors of simulators on 550 of the public tosses, identified and reported on the same ones, from the raw first frame:
#: position [%], its deviation, rotation [deg], its deviation. B. Acosta, W. Yang, M. Posa (2022), arXiv:2110.00541.
PUBLISHED = {
    "Drake": (13.5, 8.2, 16.5, 20.0),
    "Bullet": (14.9, 8.9, 16.5, 20.2),
    "MuJoCo": (25.1, 10.8, 21.7, 21.4),
}


@dataclass(frozen=True)
class Row:
    """One model on the tosses of one use from one kind of start."""

    model: str
    use: str
    start: str
    errors: Errors
    stretches: list[dict[str, Any]]
    sliding: dict[str, dict[str, Any]]

    def to_dict(self) -> dict[str, Any]:
        """Return plain numbers."""
        return {"model": self.model, "use": self.use, "start": self.start} | self.errors.summary() | {
            "stretches": self.stretches, "sliding": self.sliding,
        }  # fmt: skip


@dataclass(frozen=True)
class TossComparison:
    """All rows, and what the measurements say by themselves."""

    tosses: Tosses
    rows: list[Row]
    measured: dict[str, Any]

    def to_dict(self) -> dict[str, Any]:
        """Return what `rockref compare --json` prints for tosses."""
        t = self.tosses
        return {
            "experiment": t.name,
            "kind": "toss",
            "tosses": len(t.tosses),
            "copies": [list(pair) for pair in t.copies],
            "sha256": t.sha256,
            "rows": [row.to_dict() for row in self.rows],
            "published_raw_start": {k: list(v) for k, v in PUBLISHED.items()},
            "measured": self.measured,
        }


def compare(tosses: Tosses, models: list[Model] | None = None, names: list[str] | None = None) -> TossComparison:
    """Return errors of models (default: the plain law with stated values) from both kinds of start, over all frames.

    Raises
    ------
    InputError
        E-SIZE, where there is no toss.
    """
    models = models or [nominal_model(tosses)]
    names = names or ["stated values"]
    rows = [
        row_of(name, model, poses, tosses.width, use, start)
        for use, poses in poses_by_use(tosses).items()
        for name, model in zip(names, models, strict=True)
        for start in STARTS
    ]
    if not rows:
        raise InputError("E-SIZE", str(tosses.path), "holds no toss", "Give one at least.")
    return TossComparison(tosses, rows, measured(tosses.tosses, tosses, models[0]))


def poses_by_use(tosses: Tosses) -> dict[str, Poses]:
    """Return the poses of the tosses of every use that has any."""
    return {use: side_by_side(chosen, tosses.rate) for use in USES if (chosen := tosses.used(use))}


def row_of(name: str, model: Model, poses: Poses, width: float, use: str, start: str) -> Row:
    """Return the errors of one model."""
    found = predict(model, poses, start)
    e = errors(found, poses, width)
    # Where a toss is in its course is said of the measurement, by the same drawn corners for every model.
    frames, P = frames_of(model.replace(effects=()), throw_frame(poses)), nominal_corners(model)
    seen = frames.over_plate(poses)
    where = stretch_of(seen, P)
    energy = ledger(model, found, poses, where)
    stretches = [s | {"energy_lost": energy[s["stretch"]]} for s in by_stretch(where, e)]
    modelled = frames.over_plate(poses._replace(x=found.x, Lambda=np.nan_to_num(found.Lambda)))
    both = {"measured": seen, "model": modelled}
    g = float(model.body()[0].g)
    sliding = {k: flat_sliding.sliding_friction(v, P, g).to_dict()["values"] for k, v in both.items()}
    return Row(name, use, start, e, stretches, sliding)


def measured(chosen: tuple[Toss, ...], tosses: Tosses, model: Model) -> dict[str, Any]:
    """Return flight arcs, flat sliding; first impacts with the stated and with the measured centre of mass."""
    poses = side_by_side(chosen, tosses.rate)
    frames, P = frames_of(model.replace(effects=()), throw_frame(poses)), nominal_corners(model)
    own = frames.over_plate(poses)
    arcs = impact_balance.flight_arcs(own, flight_frames(own, P, CLEARANCE))
    found: dict[str, Any] = {"flight_arcs": arcs.to_dict()}
    if not arcs.values:
        return found
    found["sliding"] = flat_sliding.sliding_friction(own, P, -arcs.values["g_z"][0]).to_dict()
    centre = np.array([arcs.values[f"centre_{a}"][0] for a in "xyz"])
    g = np.array([arcs.values[f"g_{a}"][0] for a in "xyz"])
    mass = float(model.mass)
    stated = np.diag(np.asarray(model.body()[0].inertia)) / mass
    for name, c in (("stated_centre", 0 * centre), ("measured_centre", centre)):
        moved = own._replace(x=own.x + own.Lambda @ c)
        try:
            k = impact_balance.first_impacts(moved, P - c, np.diag(stated), g, CLEARANCE / 2)
        except InputError:
            continue
        balance = impact_balance.impulse_balance(k)
        change = impact_balance.energy_change(k, stated)
        found[name] = {
            "impulse_balance": balance.to_dict(),
            "inertia_kg_m2": {a: balance.values[f"inertia_{a}"][0] * mass for a in ("xx", "yy", "zz")},
            "corner": impact_balance.corner_ratios(k).to_dict(),
            "shape": impact_balance.corner_shape(k, flat_sliding.rest_height(own, P)).to_dict(),
            "energy_change": {
                "median": float(np.median(change)), "largest": float(np.max(change)), "gains": int((change > 0).sum()),
                "tosses": len(change),
            },
        }  # fmt: skip
    if "measured_centre" in found:
        J = np.array(list(found["measured_centre"]["inertia_kg_m2"].values())) / mass
        first = flight_frames(own, P, CLEARANCE)
        found["energy_of_stated_velocities"] = stated_energy.rises(chosen, first, centre, J, -g[2])
    return found
