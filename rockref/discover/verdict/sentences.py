"""A verdict in words."""

from __future__ import annotations

from collections.abc import Sequence

from rockref.discover.evidence.evidence import Evidence
from rockref.discover.fit.objective import WHITE
from rockref.discover.verdict.rules import Verdict

#: Nats from which a gain by chance is told (decided: it then counts as much as the prior odds of an effect).
TOLD = 10.0


def sentence(verdict: Verdict, evidence: Evidence) -> str:
    """Return what the verdict says, in one to three sentences."""
    said = {
        "none": no_effect,
        "named": one_effect,
        "pair": several_effects,
        "indicated": indication,
        "class": one_of_several,
        "something_else": unexplained,
        "not_trustworthy": contradiction,
    }[verdict.word](verdict, evidence)
    return said + by_chance(evidence)


def by_chance(evidence: Evidence) -> str:
    """Return a sentence on what an effect that is not there gains in these runs, where that is much, or ""."""
    if evidence.chance < TOLD:
        return ""
    return (
        f" In records that the model makes without it, an effect gains up to {evidence.chance:.0f} nats by chance; so "
        "much of its gain counts for nothing."
    )


def no_effect(verdict: Verdict, evidence: Evidence) -> str:
    """Return the sentence of a verdict without an effect."""
    said = "No effect is missing that these runs could show."
    rivals = [a for a in verdict.alternatives if a.effects]
    if verdict.reason == "not_excluded" and rivals:
        said += f" They do not exclude {joined(rivals[0].effects)} (probability {rivals[0].probability:.2f})."
    return said + unseen(evidence)


def unseen(evidence: Evidence) -> str:
    """Return a sentence on effects that could be there at their typical size and not be seen, or ""."""
    least: dict[str, float] = {}
    for name, limit in evidence.limits.items():
        effect, size = name.split(".")[0], float(limit["in_typical_sizes"])
        least[effect] = min(least.get(effect, float("inf")), size)
    could = [
        f"{id} would be detected above {size:.1f} times its typical size" for id, size in least.items() if size > 1
    ]
    return f" {'; '.join(could)}." if could else ""


def one_effect(verdict: Verdict, evidence: Evidence) -> str:
    """Return the sentence of a verdict that names an effect."""
    return f"{verdict.effects[0]} is missing: with it, fit runs and held-out runs are explained." + beside(verdict)


def several_effects(verdict: Verdict, evidence: Evidence) -> str:
    """Return the sentence of a verdict that names two effects or more."""
    count = {2: "Two", 3: "Three"}.get(len(verdict.effects), "Several")
    return f"{count} effects are missing: {joined(verdict.effects)}." + beside(verdict)


def beside(verdict: Verdict) -> str:
    """Return a sentence on what may be there beside the effects that are certain, or ""."""
    if verdict.reason != "or_more":
        return ""
    more = next((a for a in verdict.alternatives if set(a.effects) > set(verdict.effects)), None)
    if more is None:
        return ""
    rest = [e for e in more.effects if e not in verdict.effects]
    return f" Beside it, {joined(rest)} may be there (probability {more.probability:.2f})."


def indication(verdict: Verdict, evidence: Evidence) -> str:
    """Return the sentence of a verdict that indicates an effect."""
    if verdict.reason == "remnant":
        null = evidence.of(evidence.carried)
        assert null is not None  # what is left is a share of its misfit
        share = (null.loss - verdict.best.loss) / (null.loss - WHITE)
        others = [e for e in verdict.best.effects if e not in (*verdict.effects, *evidence.carried)]
        with_others = f", with {joined(others)} beside it, which others could replace," if others else ""
        return (
            f"{joined(verdict.effects)}{with_others} explains {100 * share:.0f} % of what the baseline leaves; the "
            "rest is above the noise: another law of this kind, or something small beside it."
        )
    said = f"{joined(verdict.effects)} is indicated by the fit runs"
    if verdict.reason == "or_nothing":
        return f"{said} (probability {verdict.probability:.2f}); they do not exclude that nothing is missing."
    held = any(h.held_out for h in evidence.hypotheses)
    return f"{said}; " + ("the held-out runs do not show it." if held else "no run was held out to show it.")


def one_of_several(verdict: Verdict, evidence: Evidence) -> str:
    """Return the sentence of a verdict that cannot tell several effects apart."""
    return f"One of these is missing, and these runs cannot say which: {', '.join(verdict.effects)}."


def unexplained(verdict: Verdict, evidence: Evidence) -> str:
    """Return the sentence of a verdict that no effect of the catalogue explains."""
    h = verdict.best
    if verdict.reason == "sensor":
        return (
            f"The records hold a fault of the sensor, and no hypothesis about the block explains it: "
            f"{'; '.join(evidence.sensor_faults)}. Mend the records, then diagnose again."
        )
    near = f"the nearest hypothesis, {joined(h.effects)}," if h.effects else "the baseline"
    return (
        f"Something moves the block that is not in the catalogue: {near} leaves innovations with a mean loss of "
        f"{h.loss:.2f}, where white noise has {WHITE:.2f}."
    )


def contradiction(verdict: Verdict, evidence: Evidence) -> str:
    """Return the sentence of runs of which one contradicts the others."""
    return (
        f"Run {verdict.run} contradicts the others, which are explained. Check its stated tilt, its side and its "
        "clock, or leave it out."
    )


def joined(effects: Sequence[str]) -> str:
    """Return effects in words."""
    return " and ".join(effects)
