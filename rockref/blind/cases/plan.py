"""Which cases a blind test has, near the source's block and of others.

Controls, single effects at three sizes, two at once, unlisted effects, matched pairs, and faulty records.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rockref.blind.cases import unlisted
from rockref.blind.cases.blocks import NEAR, OTHER, RUNS, Runs
from rockref.blind.cases.faulty import FAULTS
from rockref.blind.cases.hidden import EFFECTS

CONTROL, SINGLE, PAIR, UNLISTED, MATCHED, FAULTY = "control", "single", "pair", "unlisted", "matched", "faulty"
#: Words of an earlier format of the truth.
EARLIER = {"outsider": UNLISTED, "twin": MATCHED}
#: Share of each kind; after the proportions of a study of verdicts (controls a fifth, half single effects).
SHARES = {CONTROL: 0.20, SINGLE: 0.50, PAIR: 0.10, UNLISTED: 0.10, MATCHED: 0.06, FAULTY: 0.04}
#: Kinds of which a small plan has one each, in this order.
FIRST = (CONTROL, SINGLE, UNLISTED, PAIR, FAULTY)
#: decided: of three blocks one is not near Table 3.1.
OTHERS = 3
#: Stands for every effect of the catalogue in a list of words.
EACH = "each"
#: Sizes of a single effect, in typical ones.
SIZES = (0.5, 1.0, 2.0)
#: Pairs whose members are each other's nearest confounders.
CONFUSABLE = (
    ("rolling_resistance", "quadratic_drag"),
    ("uneven_foot_stiffness", "uneven_foot_friction"),
    ("plate_tilt", "mass_eccentricity"),
    ("cable_restraint", "quadratic_drag"),
    ("gyro_scale", "inertia_deviation"),
    ("gyro_misalignment", "release_velocity"),
    ("hertzian_contact", "uneven_foot_damping"),
    ("spin_friction", "gyro_scale"),
)
#: Pairs whose members have nothing to do with each other.
UNLIKE = (
    ("cable_restraint", "gyro_scale"),
    ("plate_tilt", "gyro_drift"),
    ("base_vibration", "rolling_resistance"),
    ("lingering_wire_pull", "clock_error"),
    ("uneven_foot_stiffness", "gyro_misalignment"),
    ("mass_eccentricity", "stribeck_friction"),
    ("compliant_support", "spin_friction"),
    ("gyro_bandwidth", "quadratic_drag"),
)
#: Unlisted effects of a plan. Not among them: creeping feet, whose spring and damper a refit of the baseline may well
#: be able to stand in for; whether they are another law or another value is then a matter of words.
PLANNED = tuple(id for id in unlisted.EFFECTS if id != "creeping_feet")
#: Height of the centre of mass, m: a tilt of the plate times this is the eccentricity that turns the block as much.
LEVER = 0.344


@dataclass(frozen=True)
class Case:
    """One case to be made: its kind, effects with sizes, seed, block, runs, values, class of a matched pair, fault."""

    kind: str
    effects: tuple[tuple[str, float], ...]
    seed: int
    runs: Runs | None = None
    values: dict[str, dict[str, float]] = field(default_factory=dict)
    same_as: tuple[str, ...] = ()
    other_form: bool | None = None
    block: str = NEAR
    fault: str | None = None


def counts(n: int, block: str = NEAR) -> dict[str, int]:
    """Return how many cases of each kind n cases of a block have.

    Matched pairs are of blocks near the source alone, from ten cases on.
    """
    if n < len(FIRST):
        return {kind: int(kind in FIRST[:n]) for kind in SHARES}
    found = {kind: max(1, int(share * n)) for kind, share in SHARES.items()}
    found[MATCHED] = 2 * round(SHARES[MATCHED] * n / 2 + 0.25) if n >= 10 and block == NEAR else 0
    found[SINGLE] += n - sum(found.values())
    return found


def shared(n: int) -> tuple[int, int]:
    """Return how many of n cases are near the source, and how many are of other blocks."""
    return n - n // OTHERS, n // OTHERS


def plan(seed: int, near: int, other: int = 0) -> list[Case]:
    """Return the cases of this seed, shuffled: so many near the source, so many of other blocks."""
    rng = np.random.default_rng([int(seed), 0])
    cases = _drawn(rng, near, NEAR) + _drawn(rng, other, OTHER)
    return [cases[i] for i in rng.permutation(len(cases))]


def _drawn(rng: np.random.Generator, n: int, block: str) -> list[Case]:
    """Return n cases of one kind of block."""
    wanted = counts(n, block)
    cases = [Case(CONTROL, (), _seed(rng)) for _ in range(wanted[CONTROL])]
    cases += [Case(SINGLE, (one,), _seed(rng)) for _, one in zip(range(wanted[SINGLE]), _singles(rng), strict=False)]
    likes, unlikes = rng.permutation(CONFUSABLE), rng.permutation(UNLIKE)
    for i in range(wanted[PAIR]):
        a, b = (likes, unlikes)[i % 2][(i // 2) % len(CONFUSABLE)]
        cases.append(Case(PAIR, ((str(a), 1.0), (str(b), 1.0)), _seed(rng)))
    order = rng.permutation(PLANNED)
    for i in range(wanted[UNLISTED]):
        cases.append(Case(UNLISTED, ((str(order[i % len(order)]), (1.0, 1.5)[i // len(order) % 2]),), _seed(rng)))
    for number in range(wanted[MATCHED] // 2):
        cases += _matched_pair(rng, number)
    faults = rng.permutation(list(FAULTS))
    for i in range(wanted[FAULTY]):
        cases.append(Case(FAULTY, (), _seed(rng), fault=str(faults[i % len(faults)])))
    return [replace(case, block=block) for case in cases]


def listed(seed: int, words: Sequence[str], near: int | None = None, other: int = 0) -> list[Case]:
    """Return cases from words: "none", "gyro_scale", "gyro_scale:2", "plate_tilt+gyro_drift", "wrapped", "each:0.5".

    "each" stands for all effects of the catalogue, one a case. Every word once, near the source; or, if numbers are
    given, so many near it and so many of other blocks, the words in turn for either, shuffled.

    Raises ValueError with the word for others: an id that nobody knows, no positive size, an effect twice in a case,
    a fault beside an effect.
    """
    rng = np.random.default_rng([int(seed), 0])
    single = [one for word in words for one in _spelled(word)]
    if near is None:
        return [_listed(word, rng, NEAR) for word in single]
    if not single:
        return []
    cases = [_listed(single[i % len(single)], rng, NEAR) for i in range(near)]
    cases += [_listed(single[i % len(single)], rng, OTHER) for i in range(other)]
    return [cases[i] for i in rng.permutation(len(cases))]


def _spelled(word: str) -> list[str]:
    id, colon, size = word.partition(":")
    return [f"{effect}{colon}{size}" for effect in EFFECTS] if id == EACH else [word]


def _listed(word: str, rng: np.random.Generator, block: str) -> Case:
    if word in FAULTS:
        return Case(FAULTY, (), _seed(rng), block=block, fault=word)
    effects = []
    for part in [] if word == "none" else word.split("+"):
        id, _, size = part.partition(":")
        if id not in EFFECTS and id not in unlisted.EFFECTS:
            raise ValueError(id)
        effects.append((id, _size(part, size)))
    if len({id for id, _ in effects}) < len(effects):
        raise ValueError(word)
    kind = CONTROL if not effects else PAIR if len(effects) > 1 else SINGLE
    if any(id in unlisted.EFFECTS for id, _ in effects):
        kind = UNLISTED
    return Case(kind, tuple(effects), _seed(rng), block=block)


def _size(part: str, size: str) -> float:
    """Return how many typical sizes; one without a number. Raises ValueError with the part for what is no positive
    number."""
    try:
        found = float(size or 1.0)
    except ValueError:
        raise ValueError(part) from None
    if not 0.0 < found < math.inf:
        raise ValueError(part)
    return found


def _seed(rng: np.random.Generator) -> int:
    return int(rng.integers(1, 2**31))


def _singles(rng: np.random.Generator) -> Iterator[tuple[str, float]]:
    """Yield every effect once, at sizes that differ from one to the next; then again at another size, and so on."""
    order = [str(id) for id in rng.permutation(list(EFFECTS))]
    while True:
        for turn in range(len(SIZES)):
            for i, id in enumerate(order):
                yield id, SIZES[(i + turn) % len(SIZES)]


def _matched_pair(rng: np.random.Generator, number: int) -> list[Case]:
    """Return two cases with one seed that differ in the cause alone, in a campaign too poor to tell the causes
    apart."""
    seed = _seed(rng)
    values: dict[str, dict[str, float]]
    runs: Runs
    if number % 2 == 0:  # never turned: what belongs to the plate and what to the block look alike
        y = float(rng.choice([-1.0, 1.0]) * rng.uniform(0.7e-3, 1.5e-3))
        names = ("plate_tilt", "mass_eccentricity")
        values = {"plate_tilt": {"x": 0.0, "y": y}, "mass_eccentricity": {"x": 0.0, "y": y * LEVER, "z": 0.0}}
        runs = RUNS[:5]
    else:  # one tilt only: losses with another dependence on the speed look alike
        names = ("quadratic_drag", "rolling_resistance")
        values, runs = {}, RUNS[:3]
    return [
        Case(MATCHED, ((id, 0.5),), seed, runs, {id: values[id]} if id in values else {}, names, False) for id in names
    ]
