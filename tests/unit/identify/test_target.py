"""What a model is compared with: runs that reach two main impacts, chosen by their names."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from rockref.identify.target import GYRO, chosen_runs, target, targets_of
from rockref.measure.experiment import load_experiment
from rockref.model.errors import InputError
from tests.shipped import two_runs

NAMED = tuple(SimpleNamespace(name=name) for name in ("01", "02", "06"))


@pytest.fixture(scope="module")
def control(tmp_path_factory):
    return load_experiment(two_runs(tmp_path_factory.mktemp("two")))


def test_a_run_that_ends_after_its_first_main_impact_is_refused(control):
    (run,) = control.fit_runs()
    early = run.t < 0.9
    with pytest.raises(InputError, match="the record has 1 main impacts") as error:
        target("01", run.t[early], run.crv[early], GYRO, 0.117)
    assert error.value.code == "E-IMPACTS"


def test_a_target_ends_soon_after_its_second_main_impact(control):
    (seen,) = targets_of(control)
    (run,) = control.fit_runs()
    assert (seen.name, seen.tilt, seen.turned) == (run.id, run.release_tilt, False)
    # As long as the impact itself and what finds it: a twentieth of a second, to a sample.
    assert seen.t[-1] - seen.until == pytest.approx(0.05, abs=1.1e-3) and seen.t[-1] < run.t[-1]
    (held,) = targets_of(control, control.holdout_runs())
    assert held.name == "03"


@pytest.mark.parametrize(
    "change, words", [({"kind": "toss"}, "is a toss experiment"), ({"gyro": None}, r"has no \[gyro\]")]
)
def test_without_releases_or_a_gyroscope_there_is_nothing_to_identify(control, change, words):
    with pytest.raises(InputError, match=words) as error:
        targets_of(replace(control, **change))
    assert error.value.code == "E-KIND"


def test_runs_are_chosen_by_name_in_the_order_given_and_the_first_without():
    assert [t.name for t in chosen_runs(NAMED, "06, 01")] == ["06", "01"]
    assert [t.name for t in chosen_runs(NAMED, None)] == ["01"]


@pytest.mark.parametrize("names, words", [("01,07", "there is no fit run '07'"), ("06,06", "names run 06 twice")])
def test_a_run_that_is_not_there_or_named_twice_is_refused(names, words):
    with pytest.raises(InputError, match=words) as error:
        chosen_runs(NAMED, names)
    assert error.value.code == "E-RUN"
