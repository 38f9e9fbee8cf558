"""From findings to a verdict: pass, or the first rule that is wrong, with its vector, and what follows from it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from rockref.conformance.judge.causes.flags import FORCES, first_steps_are_right, later, telling
from rockref.conformance.judge.causes.friction import one_step_a_row
from rockref.conformance.judge.causes.other_runs import cause_of
from rockref.conformance.judge.causes.whole_steps import rule_of_a_step
from rockref.conformance.judge.compare_answer import ELSEWHERE, OTHERWISE, Check
from rockref.conformance.judge.findings import LAYERS, Findings, finite, of_the_profile
from rockref.conformance.judge.trajectories import RunCheck
from rockref.conformance.rules import ALIKE_IN_RUNS, BY_ID, RULES, downstream
from rockref.conformance.vectors import AS_RUN, layer, manifest

LOOP = "All pieces pass by themselves; the run that is made of them does not."
UNASKED = "Pieces that could tell the rule were not asked: ask for all layers, or begin with --quick."
NO_RULE = "No short run diverges: the first divergent sample of the long ones is all that is known."
A_STEP = "A whole step is wrong, and no short run tells by which rule: it is this one, or one that comes before it."
HANDED = "The piece by itself passes: look at what the step hands to it."
STEP_OF_THE_RUN = "The pieces pass by themselves, steps of other runs, too; the step from a state of this run does not."
HANDED_ON = "All pieces pass by themselves, a step from any state, too: what a step hands to the next makes it wrong."
COMPANY = "The piece by itself passes; where several feet stand together, at the very start of a run, it does not."
ANEW = "The answer is that of a start evaluated anew: the a, T and F that the start brings were not taken."
SMALL = ("L0", "L1", "L2", "L3", "L7")
#: Short runs: those of the law's scheme, and those of other ones.
SHORT = ("L5s", "LS")
#: Of another integrator `rotate` shows the exponential, and not what is multiplied with it, and on which side;
#: `assemble` shows the force, and not the mass by which it is divided.
NOT_BY_PIECES = {"I3", "A1"}
#: Places in L5s behind the runs that show moments of normal forces alone, a second step of normal forces, the first
#: friction, moments of friction, and what a second step remembers.
AFTER_PUSHING, AFTER_STEPPING, AFTER_DRAGGING, AFTER_TURNING, AFTER_REMEMBERING = 35.9, 42.45, 45.6, 64.55, 64.49


@dataclass
class Verdict:
    """What the judge says.

    status : "PASS", "FAIL", or "NOTHING JUDGED"
    rule : the first wrong rule, None where it cannot be told; check : the vector that shows it
    run : the first run that diverges; rules : status of every rule; consequences : failed checks that come after
    slip : a common slip that explains all answers to some result, in words
    neighbours : mistakes of the zoo with a similar fingerprint, for a backend of which the pieces do not tell the rule;
    alone : they were looked for, and there is none
    """

    status: str
    findings: Findings
    rule: str | None = None
    check: Check | None = None
    run: RunCheck | None = None
    says: str = ""
    rules: dict[str, str] = field(default_factory=dict)
    consequences: list[Check] = field(default_factory=list)
    neighbours: list[tuple[str, float]] = field(default_factory=list)
    alone: bool = False
    slip: str = ""

    @property
    def passed(self) -> bool:
        """Return whether everything that was judged is inside."""
        return self.status == "PASS"


def status_of_rules(checks: Sequence[Check]) -> dict[str, str]:
    """Return by rule: fail, "no answer" (none that can be weighed), look, pass, or "not shown"."""
    found = {}
    for rule in RULES:
        own = [c for c in checks if c.rule == rule.id and c.grade not in ("not shown", "not judged")]
        if not own:
            found[rule.id] = "not shown"
        elif any(c.failed and c.weighed for c in own):
            found[rule.id] = "fail"
        elif any(c.failed for c in own):
            found[rule.id] = "no answer"
        else:
            found[rule.id] = "look" if any(c.grade in ("look", "negligible") for c in own) else "pass"
    return found


def with_consequences(rules: dict[str, str], named: str | None, checks: Sequence[Check]) -> dict[str, str]:
    """Return the statuses with "follows" where a failure can be a consequence of the rule that is named: the rule feeds
    on it, or all its failures hang on a wrong decision or are those of whole steps."""
    if named is None:
        return rules
    after, found = downstream(named), dict(rules)
    for rule, status in rules.items():
        if status != "fail" or rule == named:
            continue
        own = [c for c in checks if c.failed and c.rule == rule]
        if rule in after or all(c.follows or c.layer not in SMALL for c in own):
            found[rule] = "follows"
    return found


def first(checks: Sequence[Check]) -> Check | None:
    """Return the failure that comes first in the order of the rules, wrong decisions before what follows from them."""
    failed = [c for c in checks if c.failed and not c.follows] or [c for c in checks if c.failed]
    return min(failed, key=place) if failed else None


def place(check: Check) -> tuple[float, float]:
    """Return where a failure stands: by rule and number; short runs by place alone, as they build on each other."""
    number = float(check.vector.removesuffix(AS_RUN).rpartition("-")[2])
    if check.layer not in SHORT:
        return (check.rank, number)
    if check.note in (ELSEWHERE, OTHERWISE):
        return (0.0, 0.0)
    at = places().get(check.vector, number)
    return (0.0, max(at, stand_ins().get((check.vector, check.name), at)))


@lru_cache
def places() -> dict[str, float]:
    """Return the short runs that are judged elsewhere than at their own number."""
    return {v.id: v.place for name in SHORT for v in layer(name) if v.place is not None}


@lru_cache
def stand_ins() -> dict[tuple[str, str], float]:
    """Return from where on what stands in for forces is judged, by vector and result: a moment turns the block, too,
    whatever the normal force is, and moves it where friction holds the feet; a second step shows the first, too."""
    found: dict[tuple[str, str], float] = {}
    for v in layer("L5s"):
        for name, e in v.expect.items():
            if e.instead_of.startswith("F_T"):
                moved = AFTER_DRAGGING if one_step_a_row(v.inputs) else AFTER_REMEMBERING
                found[v.id, name] = AFTER_TURNING if name.startswith("Lambda") else moved
            elif e.instead_of == "F_N@1" and e.rule != "S1":
                found[v.id, name] = AFTER_STEPPING
            elif e.instead_of and name.startswith("Lambda"):
                found[v.id, name] = AFTER_PUSHING
    return found


def stages(pieces: Sequence[str]) -> tuple[tuple[str, ...], ...]:
    """Return the layers in the order in which a failure in them is believed: small before long.

    Who shows a step but not the contact law is first asked by short runs, which tell the contact rules apart."""
    shown = {"kinematics", "contact_law"} <= set(pieces)
    return (SMALL, ("L4",), SHORT) if shown else (SMALL, SHORT, ("L4",))


@lru_cache
def layers_of_pieces() -> dict[str, str]:
    """Return the layer in which each piece is asked by itself."""
    return {v.piece: name for name in (*SMALL, "L4") for v in layer(name)}


def all_asked(findings: Findings) -> bool:
    """Return whether every piece that is shown was asked by itself: only then can it be said that all of them pass."""
    asked = {layers_of_pieces()[p] for p in findings.pieces}
    return {name for name in asked if of_the_profile(name, findings.profile)} <= set(findings.layers)


def suspect(findings: Findings) -> tuple[str | None, Check | None, str]:
    """Return the first wrong rule, the check that shows it, and a sentence where the rule is inferred."""
    checks, pieces = telling(findings.checks, findings.answers), findings.pieces
    good = {r for r, s in status_of_rules([c for c in checks if c.layer in SMALL]).items() if s in ("pass", "look")}
    if findings.profile == "scheme":
        good -= NOT_BY_PIECES
    for layers in stages(pieces):
        check = first([c for c in checks if c.layer in layers])
        if check is None:
            continue
        if layers == SHORT and check.rule == "S2" and pieces:
            return "S2", check, LOOP if all_asked(findings) else ""
        if layers == ("L4",) and check.vector.endswith(AS_RUN):
            return check.rule, check, A_STEP
        if layers == SMALL or check.rule not in good:
            return check.rule, check, ""
        if layers == ("L4",):
            return in_company(checks) or (rule_of_a_step(findings.answers, check, findings.profile), check, HANDED)
        near = [rule for rule in ALIKE_IN_RUNS.get(check.rule, ()) if rule not in good]
        if check.name.endswith("@0") and not near:
            return check.rule, check, COMPANY
        if findings.profile == "scheme":
            # No step is shown: what it hands to the piece is as unproved as what stands near.
            return (near[0] if near else check.rule), check, HANDED
        unproved = first([c for c in checks if c.layer in SHORT and c.rule not in good])
        if unproved is not None and not {"step", "integrate"} & set(pieces):
            return unproved.rule, unproved, ""
        if findings.step_is_wrong:
            return check.rule, check, STEP_OF_THE_RUN
        handed_on = check.name.startswith(FORCES) or first_steps_are_right(checks, findings.answers)
        if handed_on and later(check) and all_asked(findings):
            return check.rule, check, HANDED_ON
        return ("S2", check, LOOP) if all_asked(findings) else (None, check, UNASKED)
    return None, None, ""


def in_company(checks: Sequence[Check]) -> tuple[str, Check, str] | None:
    """Return the rule that is wrong at the start state of a short run already, before any step: what a step hands on is
    not to blame then. For who shows pieces of one foot, and is wrong where there are several."""
    check = first([c for c in checks if c.layer == "L5s"])
    at_start = check is not None and check.weighed and check.name.endswith("@0")
    if check is None or not at_start:
        return None
    return check.rule, check, "" if check.note == ELSEWHERE else COMPANY


def unanswered(checks: Sequence[Check]) -> str:
    """Return what is said where the first failure is no answer that can be weighed."""
    if not any(c.weighed for c in checks if c.grade not in ("not shown", "not judged")):
        return "No question was answered in a way that can be weighed: that speaks of no rule."
    return "The first failure is an answer that is missing or of another shape: that speaks of no rule."


def not_asked(f: Findings) -> list[str]:
    """Return the layers of the profile that were not asked."""
    return [name for name in LAYERS if of_the_profile(name, f.profile) and name not in f.layers]


def something_judged(findings: Findings) -> bool:
    """Return whether any result was weighed at all: who shows nothing of what is asked has not passed."""
    shown = any(c.grade not in ("not shown", "not judged") for c in findings.checks)
    claimed = any(e.grade != "not shown" for e in findings.effects)
    return shown or claimed or bool(findings.runs or findings.properties)


def verdict(findings: Findings, backend: Any = None) -> Verdict:
    """Weigh the findings. `backend` is asked once more for its fingerprint, where the pieces do not name the rule."""
    rules = status_of_rules(findings.checks)
    rule, check, says = suspect(findings)
    # Of another integrator a run alone shows what its step hands to the pieces.
    asked = ("", COMPANY, HANDED_ON, *([LOOP] if findings.profile == "scheme" else []))
    if check is not None and rule == check.rule and says in asked:
        rule, words = cause_of(findings.answers, findings.checks, check, findings.profile)
        says = " ".join(filter(None, (says, words)))
    if check is not None and not check.weighed:
        rule, says = None, unanswered(findings.checks)
        # What was asked first tells why; later questions may not have been put any more.
        check = next(c for c in findings.checks if c.failed and not c.weighed)
    bad_run = next((r for r in findings.runs if r.failed), None)
    bad_properties = [p for p in findings.properties if not p.holds] + [e for e in findings.effects if e.failed]
    good = "PASS" if something_judged(findings) else "NOTHING JUDGED"
    status = "FAIL" if check or bad_run or bad_properties else good
    found = Verdict(status, findings, rule, check, bad_run, says, rules)
    if status != "FAIL":
        return found
    found.slip, anew = slip_of(findings, check)
    found.says = " ".join(filter(None, (found.says, anew)))
    words, cut = format_of(findings)
    found.slip = words if cut else "; ".join(filter(None, (words, found.slip)))
    found.rule = None if cut else rule
    found.consequences = [c for c in findings.checks if c.failed and c is not check]
    found.rules = with_consequences(rules, found.rule, findings.checks)
    in_pieces = {"step", "contact_law"} <= set(findings.pieces) and findings.profile != "scheme"
    if rule is None and bad_run is not None and in_pieces and not cut:
        found.rule, found.says = ("S2", LOOP) if all_asked(findings) else (None, UNASKED)
    short = any(c.layer in SHORT for c in findings.checks)
    if found.rule is None and check is None and bad_run is not None and short:
        found.says = NO_RULE
    silent = cut or (check is not None and not check.weighed)
    if backend is not None and findings.profile == "float64" and "contact_law" not in findings.pieces and not silent:
        resembling(found, backend)
    return found


def slip_of(findings: Findings, check: Check | None) -> tuple[str, str]:
    """Return a common slip in words, and a sentence where the first failure is that of a start evaluated anew."""
    from rockref.conformance.judge.causes.slips import evaluated_anew, told

    shown = next((a for a in findings.answers if check is not None and a[0].id == check.vector), None)
    return told(findings.answers, findings.checks), ANEW if shown is not None and evaluated_anew(*shown) else ""


def format_of(findings: Findings) -> tuple[str, bool]:
    """Return the format of the numbers in words, where it is short; and whether it takes away all that is missing of
    them: no rule is to blame then."""
    from rockref.conformance.judge.causes.digits import cut_short

    failed = [c for c in findings.failures if c.layer in (*SMALL, *SHORT, "L4") and not c.follows]
    if not failed or not all(c.weighed for c in failed):
        return "", False
    return cut_short(findings.answers, failed)


def resembling(found: Verdict, backend: Any) -> None:
    """Add the nearest mistakes of the zoo, if there are similar ones.

    Where one leaves the same deviations in all runs, its rule is named.
    """
    from rockref.conformance.judge.causes.fingerprints import SAME, fingerprint, neighbours

    found.neighbours = neighbours(fingerprint(backend), rule=found.rule)
    if not found.neighbours:
        found.alone = True
        return
    nearest, cosine = found.neighbours[0]
    rule = manifest()["mistakes"][nearest]["rule"]
    if cosine >= SAME and rule != found.rule:
        found.says = f"All runs deviate as those of {nearest}; the first short run outside would point to {found.rule}."
        found.rule = rule


def alike(v: Verdict) -> list[str]:
    """Return the rules that the runs cannot tell from the one that is named, and of which no piece says that they are
    right."""
    if v.rule is None or v.check is None or v.check.layer not in SHORT:
        return []
    small = status_of_rules([c for c in v.findings.checks if c.layer in SMALL])
    # Rates that are handed out otherwise than they were given may be those of the channel.
    near = ("M1",) if v.check.note == ELSEWHERE and v.check.name == "W@0" else ALIKE_IN_RUNS.get(v.rule, ())
    return [rule for rule in near if small[rule] == "not shown"]


def remarks(v: Verdict) -> list[str]:
    """Return what is remarked of a backend: what it was told, and what differs by more than bars and less than it
    matters."""
    f = v.findings
    counted = grades(v).get("negligible", 0)
    if not counted:
        return f.remarks
    small = [c for c in f.checks if c.grade == "negligible"]
    first_ = f"; first {small[0].name} of {small[0].vector}: {small[0].note}" if small else ""
    differ = (
        f"{counted} results differ by more than ten bars and by less than 1 nN or 1 pm, which is no verdict{first_}."
    )
    return [*f.remarks, differ]


def suspects(v: Verdict) -> list[str]:
    """Return the rules that may be wrong, the likeliest first."""
    return [] if v.rule is None else [v.rule, *alike(v)]


def grades(verdict: Verdict) -> dict[str, int]:
    """Return how many results have each grade."""
    f = verdict.findings
    judged: list[Any] = [*f.checks, *f.runs, *f.effects]
    return Counter(thing.grade for thing in judged)


def check_as_json(check: Check) -> dict[str, Any]:
    """Return a check for JSON."""
    fields = ("vector", "layer", "rule", "name", "grade", "index", "expected", "bar", "got", "note", "follows")
    entry = {k: getattr(check, k) for k in fields} | {
        "equation": BY_ID[check.rule].equation,
        "bars": finite(check.worst),
    }
    entry["index"] = list(check.index)
    return {k: finite(v) if isinstance(v, float) else v for k, v in entry.items()}


def run_as_json(run: RunCheck) -> dict[str, Any]:
    """Return a run for JSON, without its curve."""
    impacts = [{k: finite(v) if isinstance(v, float) else v for k, v in i.items()} for i in run.impacts]
    entry = {"id": run.id, "grade": run.grade, "bars": finite(run.worst), "horizon_s": run.horizon_s, "note": run.note}
    first_ = None if run.first is None else {k: finite(v) if isinstance(v, float) else v for k, v in run.first.items()}
    return entry | {"first_divergence": first_, "event_before": run.event, "impacts": impacts}


def as_json(v: Verdict) -> dict[str, Any]:
    """Return the verdict as one object for machines."""
    f = v.findings
    return {
        "verdict": v.status,
        "rule": v.rule,
        "equation": None if v.rule is None else BY_ID[v.rule].equation,
        "says": None if v.rule is None else BY_ID[v.rule].says,
        "remark": v.says,
        "slip": v.slip,
        "alike": alike(v),
        "not_asked": not_asked(f),
        "backend": f.backend,
        "profile": f.profile,
        "layers": list(f.layers),
        "pieces": list(f.pieces),
        "first_divergence": None if v.check is None else check_as_json(v.check),
        "first_divergent_run": None if v.run is None else run_as_json(v.run),
        "neighbours": [neighbour(id_, cosine) for id_, cosine in v.neighbours],
        "rules": v.rules,
        "grades": grades(v),
        "consequences": {"count": len(v.consequences), "rules": sorted({c.rule for c in v.consequences}),
                         "vectors": sorted({c.vector for c in v.consequences})[:50]},
        "runs": [run_as_json(r) for r in f.runs],
        "properties": [vars(p) for p in f.properties],
        "effects": [vars(e) | {"worst": finite(e.worst)} for e in f.effects],
        "remarks": remarks(v),
        "seconds": round(f.seconds, 2),
    }  # fmt: skip


def neighbour(id_: str, cosine: float) -> dict[str, Any]:
    """Return a similar mistake of the zoo, for JSON."""
    return {"mistake": id_, "cosine": round(cosine, 3), **manifest()["mistakes"][id_]}


def downstream_of(rule: str) -> list[str]:
    """Return the rules that feed on a rule, in order."""
    after = downstream(rule)
    return [r.id for r in RULES if r.id in after]
