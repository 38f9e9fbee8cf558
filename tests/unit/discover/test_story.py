"""The whole path on one experiment: what is done after which verdict, and what is said of it."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from rockref.discover import story
from rockref.discover.add_effect import State
from rockref.discover.evidence.evidence import Number
from rockref.discover.progress import StageReport
from rockref.discover.story import Journey, run_story
from tests.unit.discover import fakes


@pytest.fixture(scope="module")
def made():
    return fakes.made_experiment()


@pytest.fixture
def steps(monkeypatch, made):
    """Steps that only note what they were asked for; the verdict is that in `asked.verdict`."""
    asked = SimpleNamespace(verdict="named", ends=[], added=[], stores=[], names=None, models=None)

    def diagnose(path, seed, end, progress, store):
        asked.ends.append(end)
        asked.stores.append(store)
        progress(StageReport(2, 7, "fitting from other starts", "the baseline", 10.0))
        return fakes.diagnosis(asked.verdict, made)

    def add_effect(effect, path, seed, end, progress, store):
        asked.ends.append(end)
        asked.stores.append(store)
        asked.added.append(effect)
        return fakes.addition(made)

    def compare(experiment, models, names, engine):
        asked.models, asked.names = models, names
        return "compared"

    monkeypatch.setattr(story, "diagnose", diagnose)
    monkeypatch.setattr(story, "add_effect", add_effect)
    monkeypatch.setattr(story, "compare", compare)
    monkeypatch.setattr(story, "load_experiment", lambda path: made)
    return asked


@pytest.mark.parametrize("verdict", ["named", "class"])
def test_the_first_effect_of_a_verdict_is_added_and_compared(steps, verdict):
    steps.verdict, said = verdict, []
    journey = run_story("folder", said.append)
    assert steps.added == ["quadratic_drag"] and steps.names == ["baseline", "with quadratic_drag"]
    assert steps.models[0].effects == () and steps.models[1] == journey.addition.model
    assert [(report.step, report.of, report.name) for report in said] == [
        (1, 4, "diagnosing: fitting from other starts"), (3, 4, "comparing before and after"),
    ]  # fmt: skip
    # What follows a diagnosis takes its time, too.
    assert said[0].best == "the baseline" and said[0].seconds_left > 10.0
    assert journey.comparison == "compared"
    # What the diagnosis has found the addition starts from; a person's own kept fits are left alone.
    assert steps.stores[0] is steps.stores[1] and not steps.stores[0].on_disk


@pytest.mark.parametrize("verdict", ["none", "something_else", "not_trustworthy"])
def test_without_an_effect_nothing_is_added(steps, verdict):
    steps.verdict, said = verdict, []
    journey = run_story("folder", said.append)
    assert journey.addition is None and steps.added == [] and steps.names == ["baseline"]
    assert [report.step for report in said] == [1, 3]


@pytest.mark.parametrize("quick, end", [(True, story.QUICK_END), (False, story.WHOLE_END)])
def test_a_quick_story_looks_at_half_of_the_seconds(steps, quick, end):
    run_story("folder", lambda report: None, quick=quick)
    assert steps.ends == [end, end] and story.QUICK_END < 0.6 * story.WHOLE_END


def test_the_lines_give_the_size_of_the_effect_and_both_errors(made):
    lines = Journey(fakes.diagnosis("named", made), fakes.addition(made), None).lines
    assert lines[0] == "synthetic: quadratic_drag is missing."
    # Neither shared numbers of the baseline nor those of a run.
    assert lines[1] == "quadratic_drag.c = 0.41 N m s2 (90 %: 0.38 to 0.44)."
    assert lines[2].startswith("The error on the fit runs falls from 0.250 to 0.070 deg/s RMS; the noise floor is 0.05")
    assert lines[3].startswith("The error on the held-out runs falls from 0.350 to 0.150") and len(lines) == 4


def test_the_verdict_alone_where_nothing_was_added(made):
    assert Journey(fakes.diagnosis("none", made), None, None).lines == ["synthetic: A sentence."]


def test_without_held_out_runs_nothing_is_said_of_them_and_a_pure_number_has_no_unit(made):
    a = fakes.addition(made)
    before, after = (State(s.effects, s.fit, None) for s in (a.before, a.after))
    numbers = {"gyro_scale.x": Number(1.02, 1.01, 1.03, "1", 2.0, 1.0)}
    a = replace(a, before=before, after=after, effect="gyro_scale", numbers=numbers)
    lines = Journey(fakes.diagnosis("named", made), a, None).lines
    assert lines[1] == "gyro_scale.x = 1.02 (90 %: 1.01 to 1.03)." and len(lines) == 3
    assert "held-out" not in " ".join(lines)
