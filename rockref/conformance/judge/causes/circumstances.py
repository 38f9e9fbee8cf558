"""Which rule all wrong forces have in common: what every foot that is wrong does, and none that is right.

The short runs are experiments: in each row every foot touches anew or is tied, has a stretched spring or a damper that
works, sticks or slides, slid before or did not. A rule is believed where the circumstance in which it speaks is met
wherever forces are wrong, and hardly anywhere where they are right. Where forces are not shown, a row stands for its
feet: the next row shows whether all of them were right.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.as_if import GIVEN_UP, given_up
from rockref.conformance.judge.causes.rows_of_the_law import Feet, Row, off, rows_of_the_law, same
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

#: A circumstance is believed from this agreement on, where that of the rule it overrules is less by this factor.
#: Decided: where friction is wrong the circumstance of its rule agrees by 0.8 or more, those of others by half as much.
CLEAR, LESS = 0.8, 0.7


def shows_parts(f: Feet) -> np.ndarray:
    """Return which feet show how much of their trial force is the spring's: of a sliding foot its direction alone."""
    return f["dragged"] & (f["bent"] | ~f["slides"])


Circumstance = Callable[[Feet], np.ndarray]
Circumstances = tuple[tuple[str, str, Circumstance], ...]
Parts = tuple[tuple[str, str, str], ...]
Answers = Sequence[tuple[Vector, dict[str, Any]]]
#: Circumstances of friction by rule, in words and as flags (n,) of feet; the first of those that agree equally well is
#: believed.
CIRCUMSTANCES: Circumstances = (
    ("T5", "feet touch anew", lambda f: f["new"]),
    ("T5", "feet touch anew beside others that are tied", lambda f: f["beside"]),
    ("T5", "stretched feet stand beside one that touches anew", lambda f: f["spring"] & f["company"]),
    ("T5", "anchors are those of the step before", lambda f: f["later"] & ~f["new"] & f["spring"] & f["dragged"]),
    ("T1", "dampers of friction work", lambda f: f["damper"]),
    ("T1", "springs of friction are stretched", lambda f: f["spring"]),
    ("T1", "dampers of sticking feet work", lambda f: f["damper"] & ~f["slides"]),
    ("T1", "springs of sticking feet are stretched", lambda f: f["spring"] & ~f["slides"]),
    ("T1", "springs of feet that slid are stretched", lambda f: f["spring"] & f["slid"] & shows_parts(f)),
    ("T1", "dampers of feet that slid work", lambda f: f["damper"] & f["slid"] & shows_parts(f)),
    ("T2", "feet slide", lambda f: f["slides"]),
    ("T2", "feet begin or cease to slide", lambda f: f["slides"] != f["slid"]),
    ("T2", "feet that touch anew slide", lambda f: f["new"] & f["slides"]),
    ("T6", "feet that slid are between the cones", lambda f: f["between"] & f["slid"]),
    ("T6", "feet that stuck are between the cones", lambda f: f["between"] & ~f["slid"]),
    ("T3", "feet slide", lambda f: f["slides"]),
    ("T3", "feet slide on", lambda f: f["slides"] & f["slid"]),
    ("T3", "feet begin to slide", lambda f: f["slides"] & ~f["slid"]),
    ("T4", "feet slid in the step before", lambda f: f["moved"]),
    ("T4", "anchors of feet were moved", lambda f: f["carried"]),
    ("S1", "a step comes before", lambda f: f["later"]),
)
#: The same of normal forces.
OF_NORMAL_FORCES: Circumstances = (
    ("N1", "feet touch", lambda f: f["touching"]),
    ("N1", "normal dampers work", lambda f: f["touching"] & f["push"]),
    ("N1", "normal dampers of feet that slid work", lambda f: f["touching"] & f["push"] & f["slid"]),
    ("N1", "feet slid", lambda f: f["touching"] & f["slid"]),
    ("N1", "feet touch anew", lambda f: f["touching"] & f["new"]),
    ("N2", "feet are open", lambda f: ~f["touching"]),
    ("S1", "a step comes before", lambda f: f["touching"] & f["later"]),
    ("S1", "a step comes before, and normal dampers work", lambda f: f["touching"] & f["later"] & f["push"]),
)
#: Rules that another circumstance may overrule; of those that turn the block or move it alone, where rows show the
#: other as well.
MAY_BE_ANOTHER = ("T5", "T1", "T2", "T6", "T3", "T4", "S1", "I4", "I5")
ALONE = {"I4": "turned", "I5": "displaced"}
#: A share of the sticking feet whose damper works by one part of the velocity that has to be wrong, and how many right
#: ones whose damper works by the other part alone, for the velocity (K1) to be wrong and not the damper. Decided.
MOST, SOME = 0.9, 3
VELOCITY = "Dampers of friction are right where {} alone: the sliding velocity is wrong."
RATE = "Normal dampers are right where {} alone: the rate of penetration is wrong."
UNDAMPED = "Feet at rest are right, and feet that move are wrong, where no damper works: the velocity is wrong."
ANEW = "Feet that touch anew are wrong, and tied ones are right: it is the anchor, and not the trial force."
SLID = "Anchors of feet that stuck are right, and those of feet that slid in the step before are not."
#: Parts of the velocity of a foot.
PARTS = ("drift", "spin", "fall", "tilt")
#: The two parts of a velocity, along the plate and across it: that which is asked, the other, and the other in words.
ALONG: Parts = (("drift", "spin", "the block turns"), ("spin", "drift", "the block drifts"))
ACROSS: Parts = (("fall", "tilt", "the block turns"), ("tilt", "fall", "the block falls"))
IN_COMMON = "Forces are wrong where {}, and hardly anywhere else."
AFTER_A_STEP = IN_COMMON.format("a step comes before")
SLOW = (
    "Normal dampers of slow feet are wrong, and those of fast ones are right: it is the damper, and not the velocity."
)
BOTH = "What is wrong of open feet and of those that touch is the penetration."
NORMAL = "The normal forces of the row are wrong already: where {}."


def rule_in_common(answers: Answers, check: Check, rule: str) -> tuple[str, str]:
    """Return the rule whose circumstance is met where friction is wrong and not where it is right, and a sentence;
    `rule` itself unless another explains clearly more, and the failure that is told, too."""
    if check.layer != "L5s" or not check.weighed or rule not in MAY_BE_ANOTHER:
        return rule, ""
    of_runs = by_run(answers, friction)
    wrong, right = parted(of_runs)
    if len(wrong) < 2 or not (rule not in ALONE or any(np.any(feet.get(ALONE[rule], False)) for feet in wrong)):
        return rule, ""
    if rule == "T1" and (words := right_alone(wrong, right, sticking_damper, ALONG)):
        return "K1", VELOCITY.format(words)
    if rule == "T1" and undamped(wrong, right, has_friction):
        return "K1", UNDAMPED
    if rule == "T1" and anew_alone(wrong, right):
        return "T5", ANEW
    if rule == "T1" and given_up(answers):
        return "T5", GIVEN_UP
    if after_sliding_alone(wrong, right) and (rule == "T5" or (rule == "T6" and beyond_the_cones(wrong, right))):
        return "T4", SLID
    scores = [agreement(meets, wrong, right) for _, _, meets in CIRCUMSTANCES]
    own = max((s for s, (r, _, _) in zip(scores, CIRCUMSTANCES, strict=True) if r == rule),
              default=agreement(always, wrong, right))  # fmt: skip
    best = int(np.argmax(scores))
    believed, words, meets = CIRCUMSTANCES[best]
    told = any(is_off and np.any(meets(feet)) for feet, is_off in of_runs.get(check.vector, []))
    clear = told and scores[best] >= CLEAR and own <= LESS * scores[best]
    if believed == "T4" and not all_are_carried(wrong):
        return rule, ""
    if clear and believed == "T1" and rule == "T5" and given_up(answers):
        return rule, GIVEN_UP
    return (believed, IN_COMMON.format(words)) if clear else (rule, "")


def right_alone(wrong: Sequence[Feet], right: Sequence[Feet], works: Circumstance, parts: Parts) -> str:
    """Return the part of the velocity, in words, by which alone dampers are right, and by the other part wrong.

    works : feet whose damper is asked. Returns "" where there is no such part.
    """
    for part, other, words in parts:

        def by_part(f: Feet, part: str = part) -> np.ndarray:
            return works(f) & f[part]

        def by_other(f: Feet, part: str = part, other: str = other) -> np.ndarray:
            return works(f) & f[other] & f[f"no {part}"]

        counts = [[sum(bool(np.any(meets(f))) for f in of) for of in (wrong, right)] for meets in (by_part, by_other)]
        (guilty, innocent), (blamed, free) = counts
        if guilty and guilty >= MOST * (guilty + innocent) and not blamed and free >= SOME:
            return words
    return ""


def anew_alone(wrong: Sequence[Feet], right: Sequence[Feet]) -> bool:
    """Return whether a foot touches anew wherever forces are wrong, and springs and dampers of others are right."""
    tied = [f for f in right if not np.any(f["new"]) and np.any(f["spring"] & f["damper"] & ~f["slides"])]
    return len(tied) >= SOME and all(bool(np.any(f["new"])) for f in wrong)


def after_sliding_alone(wrong: Sequence[Feet], right: Sequence[Feet]) -> bool:
    """Return whether anchors of feet were moved in the run wherever forces are wrong, none of them before the
    start, and anchors of feet that stuck are right."""
    stuck = [f for f in right if np.any(f["later"] & ~f["new"] & f["spring"] & ~f["slid"])]
    at_start = any(bool(np.any(f["slid"] & ~f["later"])) for f in wrong)
    return len(stuck) >= SOME and not at_start and all_are_carried(wrong)


def all_are_carried(wrong: Sequence[Feet]) -> bool:
    """Return whether an anchor was moved in the run wherever forces are wrong: nothing else follows from it."""
    return all(bool(np.any(f["carried"])) for f in wrong)


def beyond_the_cones(wrong: Sequence[Feet], right: Sequence[Feet]) -> bool:
    """Return whether feet that slid before the start are right between the cones, and many are wrong that are not
    between them, some that stick after they slid: the threshold is right."""
    asked = [f for f in right if np.any(f["between"] & f["slid"] & ~f["later"])]
    stuck = any(bool(np.any(f["carried"] & f["dragged"])) and not np.any(f["slides"]) for f in wrong)
    return stuck and len(asked) >= SOME and sum(not np.any(f["between"]) for f in wrong) >= SOME


def rule_of_normal_forces(answers: Answers, check: Check, rule: str) -> tuple[str, str]:
    """Return the rule of the normal forces, where those of the row whose friction is told are wrong.

    Where those of open feet are wrong, and of feet that touch: K1; S1 where none of them is in a first row.
    """
    if rule == "N1":
        seen = parted(by_run(answers, pushes(check)))
        if words := right_alone(*seen, seen_damper, ACROSS):
            return "K1", RATE.format(words)
        if undamped(*seen, normal_damper):
            return "K1", UNDAMPED
    if rule in ("K1", "S1") and slow_alone(*parted(by_run(answers, pushes(check)))):
        return "N1", SLOW
    if not check.name.startswith("F_"):
        return rule, ""
    of_runs = by_run(answers, normal)
    if not any(is_off for _, is_off in of_runs.get(check.vector, [])):
        return rule, ""
    wrong, right = parted(of_runs)
    if rule == "N2":
        both = sum(bool(np.any(feet["touching"])) for feet in wrong) > 1
        late = all(np.all(feet["later"]) for feet in wrong)
        return (rule, "") if not both else ("S1", AFTER_A_STEP) if late else ("K1", BOTH)
    if not check.name.startswith("F_T@"):
        return rule, ""
    best = max(OF_NORMAL_FORCES, key=lambda c: agreement(c[2], wrong, right))
    return best[0], NORMAL.format(best[1])


def slow_alone(wrong: Sequence[Feet], right: Sequence[Feet]) -> bool:
    """Return whether a foot is slower wherever forces are wrong than all feet are where they are right and dampers
    work, in some runs each: a speed below which the damper does not work is no velocity's."""
    slowest = [
        [float(np.min(f["sinking"][works])) for f in of if np.any(works := asked(f))]
        for of, asked in ((wrong, moves_across), (right, seen_damper))
    ]
    sure = len(slowest[0]) == len(wrong) and min(map(len, slowest)) >= SOME
    return sure and max(slowest[0]) < min(slowest[1])


def undamped(wrong: Sequence[Feet], right: Sequence[Feet], works: Circumstance) -> bool:
    """Return whether touching feet that move show a wrong force where none of their dampers works, and feet at rest do
    not: a velocity that should be zero is not.

    works : feet whose damper is asked
    """

    def moves(f: Feet) -> np.ndarray:
        return np.any([f[part] for part in PARTS], axis=0)

    def stands(f: Feet) -> np.ndarray:
        return f["touching"] & np.all([f[f"no {part}"] for part in PARTS], axis=0)

    idle = sum(bool(np.all(moves(f) & ~works(f) & f["touching"])) for f in wrong)
    resting = [sum(bool(np.all(stands(f))) for f in of) for of in (wrong, right)]
    return idle > 1 and not resting[0] and resting[1] >= SOME


def pushes(check: Check) -> Callable[..., Any]:
    """Return what is looked at of a row to see its normal forces: themselves, or what stands in for them."""
    return normal if check.name.startswith("F_N@") else friction


def sticking_damper(f: Feet) -> np.ndarray:
    """Return which feet stick, with a damper of friction that works."""
    return f["damper"] & ~f["slides"]


def has_friction(f: Feet) -> np.ndarray:
    """Return which feet slide, or have a spring or a damper of friction that works."""
    return f["spring"] | f["damper"] | f["slides"]


def normal_damper(f: Feet) -> np.ndarray:
    """Return which feet touch, with a normal damper that works."""
    return f["touching"] & f["push"]


def moves_across(f: Feet) -> np.ndarray:
    """Return which feet touch and go up or down, however slowly."""
    return f["touching"] & (f["sinking"] > 0)


def seen_damper(f: Feet) -> np.ndarray:
    """Return which feet show that their normal damper works: where tension is cut, none is seen."""
    return f["pressed"] & f["push"]


def by_run(answers: Answers, seen: Callable[..., Any]) -> dict[str, list[tuple[Feet, bool]]]:
    """Return the experiments of every short run."""
    return {v.id: list(experiments(v, out, seen)) for v, out in answers if v.layer == "L5s"}


def parted(of_runs: dict[str, list[tuple[Feet, bool]]]) -> tuple[list[Feet], list[Feet]]:
    """Return what is wrong, and what is right."""
    found = [one for of in of_runs.values() for one in of]
    return [feet for feet, is_off in found if is_off], [feet for feet, is_off in found if not is_off]


def experiments(vector: Vector, out: dict[str, Any], seen: Callable[..., Any]) -> Iterator[tuple[Feet, bool]]:
    """Yield the feet of one run up to the first row in which one is wrong, and whether they are.

    seen : what of a row is looked at; its groups of feet, each with whether it is wrong, or None where nothing shows
    """
    rows = rows_of_the_law(vector.id)
    for i, row in enumerate(rows):
        groups = seen(out, i, rows) if same(out, "x", i, row.x) and same(out, "Lambda", i, row.Lambda) else None
        if groups is None:
            return
        yield from groups
        if any(is_off for _, is_off in groups):
            return


def friction(out: dict[str, Any], i: int, rows: Sequence[Row]) -> list[tuple[Feet, bool]] | None:
    """Return each foot of a row that touches, and whether its friction is wrong; without forces all of them as one."""
    if out.get("F") is None:
        return together(out, i, rows)
    wrong = off(out, i, rows[i])
    if wrong is None or np.any(wrong[:, 2]):
        return None
    return each(rows[i], np.any(wrong[:, :2], axis=-1), touching=True)


def normal(out: dict[str, Any], i: int, rows: Sequence[Row]) -> list[tuple[Feet, bool]] | None:
    """Return each foot of a row, and whether its normal force is wrong."""
    wrong = off(out, i, rows[i])
    return None if wrong is None else each(rows[i], wrong[:, 2], touching=False)


def each(row: Row, wrong: np.ndarray, touching: bool) -> list[tuple[Feet, bool]] | None:
    """Return the feet of a row one by one, those that touch or all; none of a row without an evaluation."""
    feet = row.feet
    if feet is None:
        return None if np.any(wrong) else []
    asked = np.flatnonzero(feet["touching"] if touching else np.ones_like(wrong))
    return [({name: a[j : j + 1] for name, a in feet.items()}, bool(wrong[j])) for j in asked]


def together(out: dict[str, Any], i: int, rows: Sequence[Row]) -> list[tuple[Feet, bool]] | None:
    """Return the feet of a row that touch, and whether their forces are wrong, as this row's rates and the next row
    show; with whether the block is displaced by it, and turned."""
    feet, last = rows[i].feet, i + 1 == len(rows)
    turned = not same(out, "W", i, rows[i].W) or not (last or same(out, "Lambda", i + 1, rows[i + 1].Lambda))
    displaced = not last and not same(out, "x", i + 1, rows[i + 1].x)
    if (last and not turned) or (feet is None and (turned or displaced)):
        return None
    if feet is None:
        return []
    shown = {"turned": np.array([turned]), "displaced": np.array([displaced])}
    return [({name: a[feet["touching"]] for name, a in feet.items()} | shown, turned or displaced)]


def always(feet: Feet) -> np.ndarray:
    """Return that every foot meets it: the circumstance of a rule that speaks wherever feet touch."""
    return feet["touching"]


def agreement(meets: Circumstance, wrong: Sequence[Feet], right: Sequence[Feet]) -> float:
    """Return how well a circumstance agrees with what is wrong, 0 to 1 (Ochiai's coefficient).

    It is the geometric mean of the share of what is wrong that meets it, and of the share that is wrong of what does.
    """
    guilty, innocent = (sum(bool(np.any(meets(feet))) for feet in of) for of in (wrong, right))
    return guilty / np.sqrt(len(wrong) * (guilty + innocent)) if guilty else 0.0
