"""Experiments of the blind test before anything is hidden: the source's block in its laboratory, and other blocks.

A setup holds what the experimenter states, and what only the generator knows: the parameters of the law.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from rockref.blind.simulator.world import DEGREE, NOMINAL_TILT, SOURCE, Block, Sensor, draw_parameters

NEAR, OTHER = "near", "other"
#: Runs of the source's campaign: id, use, stated tilt [rad], turned.
RUNS = (
    ("01", "fit", NOMINAL_TILT, False),
    ("02", "fit", NOMINAL_TILT, False),
    ("03", "holdout", NOMINAL_TILT, False),
    ("04", "fit", 0.098, False),
    ("05", "holdout", 0.108, False),
    ("06", "fit", NOMINAL_TILT, True),
)
Runs = tuple[tuple[str, str, float, bool], ...]

# What other blocks are drawn from; decided, so that they hold what stands free and is measured: statuettes and casks,
# drums of columns, pillars. From a fifth of a metre to two metres, four to nine times as high as wide, from wood to
# steel (kg/m3).
HEIGHTS, SLENDERNESS, DENSITIES = (0.2, 2.0), (4.0, 9.0), (600.0, 8000.0)
#: Stiffness over mass [N/m/kg]: half a decade to both sides of the source's 1.1e6. Tangential over normal stiffness.
STIFFNESS, TANGENTIAL = (0.35e6, 3.5e6), (0.5, 1.0)
#: Damping ratios and friction coefficients; and how the inner points' stand to the outer points'.
DAMPING, FRICTION = (0.03, 0.5), (0.1, 0.7)
INNER_DAMPING, INNER_FRICTION = (0.7, 1.25), (0.8, 1.25)
#: Heights of the feet [m] of a base 0.1 m wide or wider; narrower ones are as flat for their width.
FEET, FEET_WIDTH = (0.0, 200e-6), 0.1
#: Distance of the inner points over the width.
DIAGONAL = (0.01, 0.15)
#: Share of other blocks that have the source's mass and sides, and feet of their own.
SAME_SIZE = 0.25
#: First tilt over the tipping angle; and the tilts of the runs over the first, as in the source's campaign.
TILT, TILTS = (0.65, 0.85), (1.0, 0.84, 1.0, 0.92, 1.0)
#: What a wire of such a length scatters about its stated tilt, and what the experimenter believes that it does.
TILT_SPREAD, TILT_STATED = 0.004, 0.012
#: Instruments: samples a second, bandwidth over that, noise [deg/s].
SAMPLE_RATES, BANDWIDTHS, NOISES = (500, 800, 1000, 1600, 2000, 4000), (0.2, 0.4), (0.03, 0.1)
#: Uses of two to six runs. Of two, one is held out.
USES = {
    2: ("fit", "holdout"), 3: ("fit", "fit", "holdout"), 4: ("fit", "fit", "holdout", "fit"),
    5: ("fit", "fit", "holdout", "fit", "fit"), 6: ("fit", "fit", "holdout", "fit", "fit", "holdout"),
}  # fmt: skip
#: Effects that only a turned run tells apart (the plate's or the block's), and such as only a second tilt does.
TURNED, TILTED = ("plate_tilt", "mass_eccentricity"), ("quadratic_drag", "rolling_resistance")


@dataclass(frozen=True)
class Setup:
    """One campaign.

    Attributes
    ----------
    block, runs, seconds, tilt_uncertainty : as stated: of the block, of each run (id, use, tilt [rad], turned), length
        of a record [s], [rad].
    sensor : the data sheet of the gyroscope.
    parameters : those of the law, or None where they are drawn about Table 3.1.
    """

    block: Block = SOURCE
    runs: Runs = RUNS
    seconds: float = 5.0
    tilt_uncertainty: float = 0.0014
    sensor: Sensor = field(default_factory=Sensor)
    parameters: dict[str, float] | None = None

    @property
    def is_other(self) -> bool:
        """Return whether the block is not near Table 3.1."""
        return self.parameters is not None

    @property
    def nominal_tilt(self) -> float:
        """Return the stated tilt [rad] that belongs to the parameter theta_0."""
        return self.runs[0][2] if self.is_other else NOMINAL_TILT

    def parameters_by(self, rng: np.random.Generator, spread: float) -> dict[str, float]:
        """Return the parameters of the law, about Table 3.1 by `spread` (log-normal) where none are set."""
        return draw_parameters(rng, spread) if self.parameters is None else dict(self.parameters)


def other_block(seed: int, effects: Sequence[str] = (), attempt: int = 0) -> Setup:
    """Draw a block that is not the source's, its instrument and its campaign; the effects decide what runs it needs."""
    rng = np.random.default_rng([int(seed), 4, attempt])
    block = _block(rng)
    width, height = block.width, block.height
    tilt = round(math.atan2(width, height) * float(rng.uniform(*TILT)), 4)
    rate = int(rng.choice(SAMPLE_RATES))
    sensor = Sensor(
        sample_rate=float(rate),
        low_pass=float(np.clip(round(rate * float(rng.uniform(*BANDWIDTHS)), -1), 100, 500)),
        noise=_rounded(_log_uniform(rng, NOISES)) * DEGREE,
    )
    # As many swings as the source's block makes in five seconds.
    seconds = round(2.0 * 5.0 * math.sqrt(math.hypot(width, height) / math.hypot(SOURCE.width, SOURCE.height))) / 2.0
    parameters = _parameters(rng, block, tilt)
    runs = _runs(rng, tilt, effects)
    return Setup(block, runs, seconds, _rounded(TILT_STATED * tilt), sensor, parameters)


def _block(rng: np.random.Generator) -> Block:
    """Draw mass and sides."""
    height = round(_log_uniform(rng, HEIGHTS), 3)
    width = round(height / float(rng.uniform(*SLENDERNESS)), 3)
    mass = _rounded(_log_uniform(rng, DENSITIES) * width**2 * height)
    return SOURCE if rng.random() < SAME_SIZE else Block(mass, width, height)


def _parameters(rng: np.random.Generator, block: Block, tilt: float) -> dict[str, float]:
    """Draw the parameters of the law under the names of Table 3.1."""
    stiffness = block.mass * _log_uniform(rng, STIFFNESS)
    damping, friction = _log_uniform(rng, DAMPING), float(rng.uniform(*FRICTION))
    feet = rng.uniform(*FEET, size=4) * min(1.0, block.width / FEET_WIDTH)
    return {
        "K_N": stiffness,
        "K_T": stiffness * _log_uniform(rng, TANGENTIAL),
        "beta_int": float(np.clip(damping * rng.uniform(*INNER_DAMPING), *DAMPING)),
        "beta_ext": damping,
        "mu_int": float(np.clip(friction * rng.uniform(*INNER_FRICTION), *FRICTION)),
        "mu_ext": friction,
        **{f"delta_long_{i}": float(height) for i, height in enumerate(feet, 1)},
        "delta_diag": block.width * float(rng.uniform(*DIAGONAL)),
        "theta_0": tilt * float(np.exp(TILT_SPREAD * rng.normal())),
    }


def _runs(rng: np.random.Generator, tilt: float, effects: Sequence[str]) -> Runs:
    """Draw two to six runs, half of the larger campaigns with the block turned in one that is fitted."""
    turned = bool(rng.random() < 0.5) or any(id in TURNED for id in effects)
    least = 3 if any(id in TURNED + TILTED for id in effects) else 2
    n = int(rng.integers(least, 7))
    last = max(i for i, use in enumerate(USES[n]) if use == "fit")
    tilts = [round(tilt * TILTS[i % len(TILTS)], 4) for i in range(n)]
    return tuple((f"{i + 1:02d}", USES[n][i], tilts[i], turned and n > 2 and i == last) for i in range(n))


def _log_uniform(rng: np.random.Generator, limits: tuple[float, float]) -> float:
    return float(np.exp(rng.uniform(*np.log(limits))))


def _rounded(value: float) -> float:
    """Return a number as it is stated: three digits."""
    return float(f"{value:.3g}")
