"""The figures of a run as files."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.report.charts import run_panels


def with_impacts(c, times):
    """The comparison with these main impacts in the first run."""
    first, *others = c.measured
    impacts = SimpleNamespace(times=np.array(times))
    return replace(c, measured=(replace(first, features=replace(first.features, impacts=impacts)), *others))


@pytest.mark.parametrize("times, columns", [([], None), ([0.5], None), ([0.5, 1.3], 2), ([0.3, 0.5, 0.7, 1.0, 1.3], 3)])
def test_zooms_are_about_the_impacts_that_are_there(short, times, columns):
    figure = run_panels.zooms(with_impacts(short, times), 0)
    if columns is None:
        assert figure is None
        return
    # Three rates and the contacts of the one model; the last column ends behind the last impact.
    assert len(figure.axes) == 4 * columns
    assert figure.axes[-1].get_xlim()[1] == pytest.approx(times[-1] + run_panels.BEYOND)


def test_a_run_without_two_impacts_has_no_file_of_zooms(short, tmp_path, monkeypatch):
    monkeypatch.setattr(run_panels, "rendered", lambda figure, kind: b"drawn")
    names = {p.name for p in run_panels.write_figures(short, tmp_path)}
    assert names == {f"synthetic_run01_{n}.{kind}" for n in ("whole", "zooms") for kind in ("png", "svg")}
    names = {p.name for p in run_panels.write_figures(with_impacts(short, [0.5]), tmp_path)}
    assert names == {"synthetic_run01_whole.png", "synthetic_run01_whole.svg"}
