"""The studies of the source on disk: which are made, and what is drawn of the models that failed."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.studies.scenarios import REFERENCE
from rockref.workflows import reproduce_source
from rockref.workflows.reproduce_source import PARTS, QUICK, _Art, _scenarios, _studies


@pytest.mark.parametrize("experiment, left_out", [("folder", set()), (None, {"identification"})])
def test_without_an_experiment_nothing_is_identified(tmp_path, experiment, left_out):
    made = _studies(tmp_path, experiment, {}, QUICK, None, _Art(tmp_path))
    assert set(made) == set(PARTS) - left_out


def test_figures_are_kept_as_files_and_small_for_the_page(tmp_path, monkeypatch):
    monkeypatch.setattr(reproduce_source, "rendered", lambda figure, kind, dpi=150: f"{figure} {kind} {dpi}".encode())
    art = _Art(tmp_path)
    art.keep({"a": "first", "b": "second"})
    assert {p.name for p in tmp_path.iterdir()} == {"a.png", "a.svg", "b.png", "b.svg"}
    assert (tmp_path / "b.svg").read_bytes() == b"second svg 150"
    assert art.pictures["a"] == f"first png {reproduce_source.PAGE_DPI}".encode()


def test_the_reference_is_drawn_beside_the_three_best_of_the_models_that_failed(monkeypatch):
    costs = {"reference": 0.02, "a": 1.5, "b": 0.9, "c": 2.5, "d": 1.1}
    rows = [
        {"name": name, "cost": cost, "defects": list(REFERENCE) if name == "reference" else [], "u": [cost]}
        for name, cost in costs.items()
    ]
    target = SimpleNamespace(t=np.arange(3.0), crv=np.zeros((3, 3)), tilt=0.117)
    drawn = []
    monkeypatch.setattr(reproduce_source, "twin", lambda *a: target)
    monkeypatch.setattr(
        reproduce_source, "releases", lambda space, targets, u: [(targets[0].t, np.array(u[0])[:, None, :])]
    )
    monkeypatch.setattr(reproduce_source.source_figures, "scenarios_figure", lambda t, crv, found: drawn.extend(found))
    kept = SimpleNamespace(each=lambda name, items, make, identity: rows)
    found = _scenarios(Model.table_3_1(), QUICK, None, kept, SimpleNamespace(keep=lambda figures: None))
    assert found == rows
    assert [name for name, _, _ in drawn] == [
        "reference (cost 0.02)", "b (cost 0.90)", "d (cost 1.10)", "a (cost 1.50)"
    ]  # fmt: skip
    # Each with the motion of its own numbers.
    assert [float(crv[0, 0]) for _, _, crv in drawn] == [0.02, 0.9, 1.1, 1.5]
