"""The whole path on one experiment: what is done after which verdict, and what is said of it."""

from types import SimpleNamespace

import pytest

from rockref.discover.progress import StageReport
from rockref.workflows import story
from rockref.workflows.story import run_story
from tests.unit.discover import fakes


@pytest.fixture(scope="module")
def made():
    return fakes.made_experiment()


@pytest.fixture
def steps(monkeypatch, made):
    """Steps that only note what they were asked for; the verdict is that in `asked.verdict`."""
    asked = SimpleNamespace(verdict="named", ends=[], added=[], stores=[], names=None, models=None)

    def diagnose(path, end, progress, store):
        asked.ends.append(end)
        asked.stores.append(store)
        progress(StageReport(2, 7, "fitting from other starts", "the baseline", 10.0))
        return fakes.diagnosis(asked.verdict, made)

    def add_effect(effect, path, end, progress, store):
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
    assert steps.ends == [story.QUICK_END] * 2
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
