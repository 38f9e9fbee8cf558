"""What fits are given of an experiment, and what is refused before anything is fitted."""

import gzip
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from rockref.discover.diagnose import diagnose
from rockref.discover.windows.opened import opened, usable
from rockref.model.errors import InputError
from tests.unit.discover import fakes

CONTROL = Path(__file__).parents[4] / "data" / "experiments" / "mystery-08"


@pytest.mark.parametrize(
    "change, code",
    [
        ({"kind": "toss"}, "E-KIND"),
        ({"gyro": None}, "E-KIND"),
        ({"runs": ()}, "E-NO-FIT"),
    ],
)
def test_what_cannot_be_fitted_is_refused(change, code):
    e = fakes.made_experiment(0.1)
    assert usable(e) is e
    with pytest.raises(InputError) as error:
        usable(replace(e, **change))
    assert error.value.code == code


def test_fits_are_given_the_fit_runs_alone():
    fitted, whole = opened(CONTROL)
    assert [run.id for run in fitted.runs] == [run.id for run in whole.runs]
    assert all((run.crv is not None) == (run.use == "fit") for run in fitted.runs)
    assert all(run.crv is not None for run in whole.runs) and whole.holdout_runs()


def test_a_held_out_record_that_cannot_be_used_is_refused_before_anything_is_fitted(tmp_path):
    folder = shutil.copytree(CONTROL, tmp_path / "short")
    (held, *_) = opened(CONTROL)[1].holdout_runs()
    with gzip.open(folder / held.file, "rt") as whole:
        # 0.4 s: the first main impact is at 0.5 s.
        rows = whole.readlines()[:400]
    with gzip.open(folder / held.file, "wt") as cut:
        cut.writelines(rows)
    said = []
    with pytest.raises(InputError) as error:
        diagnose(folder, progress=said.append)
    assert error.value.code == "E-SHORT" and held.file in error.value.where and not said
