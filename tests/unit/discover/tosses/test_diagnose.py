"""The staircase of a diagnosis of tosses: fits are made up at the known truth, everything after them is real."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover.tosses import diagnose as diagnosing
from rockref.discover.tosses.diagnose import Step, agreement, diagnose, rungs, word, words
from rockref.discover.tosses.fit import TossFit
from rockref.discover.tosses.fitting import at_values
from rockref.discover.tosses.together import Stair
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.measure.tosses.flight import side_by_side
from rockref.measure.tosses.load import CUBE_WIDTH
from rockref.model.errors import InputError
from tests.tosses import RATE, stated, tosses_of

pytest.importorskip("numba")
HOLE = MassEccentricity(0.0, 0.0, 5e-3)
UNUSED = ("plate_tilt", "rounded_corners")


def half_held_out(*effects):
    """Tosses of a cube with these effects, every second one held out."""
    return tosses_of(stated().replace(effects=effects), 20, ("fit", "holdout"), noise=2e-4)


@pytest.fixture(scope="module")
def hollow():
    return half_held_out(HOLE)


def step_gate(passed):
    """The gate of the step, which few tosses with errors near their noise do not pass."""
    return {"name": "step_small", "passed": passed, "value": 0.01, "limit": 0.02}


@pytest.fixture
def no_fits(monkeypatch):
    """Fits that stay where they begin, and all candidates together at the truth; what was asked for comes back."""
    monkeypatch.setattr(diagnosing, "step_small", lambda *a: step_gate(True))
    asked = []

    def all_together(law, others, guesses, stages):
        asked.append(tuple(others))
        fit = replace(law.fit, effects=("mass_eccentricity",))
        z = at_values(fit.parameters, {"mass_eccentricity": HOLE})
        return Stair(fit, z, 1.0, {"mass_eccentricity": 3.0}, {"mass_eccentricity": {"mass_eccentricity": 1.0}})

    def way_down(full, own, say):
        law = replace(full.fit, effects=())
        return [full, Stair(law, np.zeros(len(law.parameters)), 5.0)]

    monkeypatch.setattr(TossFit, "run", lambda self, z, *a: (z, 5.0))
    monkeypatch.setattr(diagnosing, "all_together", all_together)
    monkeypatch.setattr(diagnosing, "way_down", way_down)
    return asked


def test_an_effect_that_is_there_is_named_with_its_proof(no_fits, hollow):
    found = diagnose(hollow, candidates=("mass_eccentricity", *UNUSED))
    assert no_fits == [("mass_eccentricity", *UNUSED)] and found.not_needed == UNUSED
    assert (found.verdict, found.effects) == ("named", ("mass_eccentricity",))
    assert found.model.effects[0].z == pytest.approx(HOLE.z)
    law, step = found.to_dict()["staircase"]
    # It lowers the objective from 5 to 1; without it the others lose 3 of these 4.
    assert (step["gain_percent"], step["taken_over_by_others_percent"]) == (80.0, 25.0)
    assert law["verdict"] == "" and step["proof"]["low"] > 0
    before, after = (s["holdout"]["flight"]["position_percent"]["mean"] for s in (law, step))
    assert after < 0.5 * before
    arcs = next(a for a in found.agreement if a["quantity"] == "centre of mass, z")
    assert arcs["with_contact_model"] == pytest.approx(5e-3)
    assert abs(arcs["without"] - 5e-3) < 4 * arcs["standard_error"]
    assert found.confusion and all(g["passed"] for g in found.gates)


def test_what_a_model_has_is_no_candidate(no_fits, hollow):
    begun = stated().replace(effects=(HOLE,))
    said = []
    diagnose(hollow, begun, candidates=("mass_eccentricity", "plate_tilt"), progress=said.append)
    # It explains the tosses as it is, so that nothing has to be fitted.
    assert no_fits == [] and any("is below the floor of the starts" in line for line in said)


def test_at_the_floor_of_the_starts_nothing_is_looked_for(no_fits):
    found = diagnose(half_held_out(), candidates=UNUSED)
    assert no_fits == [] and (found.verdict, found.effects) == ("none", ()) and found.not_needed == UNUSED
    assert found.sentence == "No effect of the catalogue makes the held-out tosses better."
    assert len(found.steps) == 1 and found.model.effects == ()


def test_a_gate_that_is_not_passed_is_the_verdict(no_fits, hollow, monkeypatch):
    monkeypatch.setattr(diagnosing, "step_small", lambda *a: step_gate(False))
    found = diagnose(hollow, candidates=("mass_eccentricity",))
    assert found.verdict == "not_trustworthy"
    assert found.sentence.startswith("Not to be trusted: step_small not passed. Missing,")


@pytest.mark.parametrize("lacking", ["fit", "holdout"])
def test_too_few_tosses_of_either_use_are_refused(hollow, lacking):
    kept = tuple(t for i, t in enumerate(hollow.tosses) if t.use != lacking or i < 10)
    with pytest.raises(InputError, match=f"has 5 tosses of use {lacking}") as error:
        diagnose(replace(hollow, tosses=kept))
    assert error.value.code == "E-SIZE"


@pytest.mark.parametrize("objective, cost, over", [(4.0, 0.5, 0.5), (4.0, 2.0, 0.0), (5.0, 0.0, 1.0)])
def test_what_the_others_take_over_is_a_share_of_the_gain(hollow, monkeypatch, objective, cost, over):
    """Of a gain of one half is lost without the effect; all, where its loss is more; none, where it gains nothing."""
    monkeypatch.setattr(TossFit, "run", lambda self, z, *a: (z, 0.0))
    base = TossFit(stated(), (), side_by_side(hollow.used("fit"), RATE), CUBE_WIDTH)
    fit = replace(base, effects=("mass_eccentricity",))
    law = Stair(base, np.zeros(len(base.parameters)), 5.0)
    top = Stair(fit, np.zeros(len(fit.parameters)), objective, {"mass_eccentricity": cost})
    first, step = rungs([top, law], law, lambda line: None)
    assert first.effect == "" and step.effect == "mass_eccentricity" and step.taken_over == over
    assert step.gain == pytest.approx((5.0 - objective) / 5.0)


def made_step(effect, low, high, over=0.0, mean=10.0):
    """A rung with this proof, and held-out tosses with this error."""
    held = SimpleNamespace(position=np.full(4, mean / 200), rotation=np.full(4, mean / 2))
    step = Step(effect, None, np.zeros(0), taken_over=over, proof={"low": low, "high": high})
    step.holdout = {"flight": held}
    step.verdict = word(step)
    return step


@pytest.mark.parametrize(
    "effect, low, high, over, verdict",
    [
        ("", -1.0, 1.0, 0.0, ""), ("a", -2.0, -1.0, 0.0, "none"), ("a", -1.0, 1.0, 0.0, "indicated"),
        ("a", 1.0, 2.0, 0.0, "named"), ("a", 1.0, 2.0, 1.0, "class"),
    ],
)  # fmt: skip
def test_a_rung_has_the_verdict_of_its_proof(effect, low, high, over, verdict):
    assert made_step(effect, low, high, over).verdict == verdict


@pytest.mark.parametrize(
    "over, effects, verdict",
    [([], (), "none"), ([0.0], ("a",), "named"), ([1.0], ("a",), "class"), ([1.0, 0.0], ("a", "b"), "pair"),
     ([0.0] * 3, ("a", "b", "c"), "named")],
)  # fmt: skip
def test_the_verdict_of_all_rungs(over, effects, verdict):
    steps = [made_step("", 0.0, 0.0)]
    steps += [made_step(e, 1.0, 2.0, o, mean=10.0 - k) for k, (e, o) in enumerate(zip(effects, over, strict=True), 1)]
    found, sentence = words(steps, effects)
    assert found == verdict
    if effects:
        assert sentence.endswith(f": {' and then '.join(effects)}; the held-out error falls from 10.0 to "
                                 f"{10 - len(effects)}.0.")  # fmt: skip


def test_only_what_is_known_both_ways_is_compared():
    base = stated()
    inertia = np.diag(np.asarray(base.body()[0].inertia))
    step = SimpleNamespace(
        values=lambda: {
            "mu": {"value": 0.16}, "mass_eccentricity.x": {"value": 1e-3}, "mass_eccentricity.y": {"value": 2e-3},
            "tag_frame.x": {"value": 2e-4}, "inertia_deviation.yy": {"value": 1.1},
        }
    )  # fmt: skip
    number = {"value": 0.5, "se": 0.1}
    found = {
        "flight_arcs": {"values": {"centre_x": number}},
        "measured_centre": {
            "impulse_balance": {"values": {"inertia_yy": {"value": 2e-3, "se": 1e-4}, "inertia_zz": number}},
            "corner": {"values": {"friction": number}},
        },
    }
    rows = {row["quantity"]: row for row in agreement(step, found, base)}
    assert set(rows) == {"centre of mass, x", "inertia, yy", "friction"}
    # The arcs see the centre from the tracked point; the balance has the inertia over the mass.
    assert rows["centre of mass, x"]["with_contact_model"] == pytest.approx(1.2e-3)
    assert rows["inertia, yy"]["with_contact_model"] == pytest.approx(1.1 * inertia[1])
    assert rows["inertia, yy"]["without"] == pytest.approx(2e-3 * base.mass)
    assert agreement(step, {}, base) == []


def test_every_candidate_has_a_sentence():
    assert set(diagnosing.sentences()) == set(diagnosing.CANDIDATES) and all(diagnosing.sentences().values())
