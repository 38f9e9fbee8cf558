"""What is kept of fits: read back as it was, asked for by what it depends on, and no failure where there is no room."""

import json
import os
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover import fit_store
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import S2, S3, F
from rockref.discover.fit_store import FitStore, cache_folder, fit_key, options_key, prune
from rockref.discover.kept_search import KeptSearch
from rockref.discover.selection.search import Search
from rockref.effects.catalogue import parse
from tests.unit.discover import fakes

TABLE = Model.table_3_1()


@pytest.fixture(scope="module")
def made():
    return fakes.made_experiment(0.7)


@pytest.fixture
def problem(made):
    return fit_problem(made, made.fit_runs(), TABLE, end=0.6, workers=1)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("ROCKREF_CACHE", str(tmp_path / "kept"))
    return tmp_path / "kept"


def fitted(problem, effects=(), objective=100.0, value=0.1):
    n = len(problem.parameters(effects))
    return FittedModel(effects, value * np.arange(n), objective=objective, loss=1.0)


def test_a_fit_is_read_back_as_it_was_whatever_the_order_of_its_effects(folder, made, problem):
    store = FitStore().open(made)
    h = fitted(problem, ("gyro_scale", "rolling_resistance"))
    store.note(problem)(h, S3)
    store.save()
    again, stage = FitStore().open(made).start(problem, ("rolling_resistance", "gyro_scale"))
    assert stage is S3 and again.effects == ("rolling_resistance", "gyro_scale")
    names = [p.name for p in problem.parameters(h.effects)]
    order = [names.index(p.name) for p in problem.parameters(again.effects)]
    assert np.array_equal(again.z, h.z[order])
    assert FitStore().open(made).start(problem, ("gyro_scale",)) is None
    assert FitStore(fresh=True).open(made).start(problem, h.effects) is None


def test_the_longest_memory_is_kept_and_of_these_the_best(problem):
    store = FitStore(on_disk=False)
    keep = store.note(problem)
    for stage, objective, value in ((S2, 10.0, 0.1), (S3, 50.0, 0.2), (S3, 40.0, 0.3), (S3, 45.0, 0.4), (S2, 1.0, 0.5)):
        keep(fitted(problem, objective=objective, value=value), stage)
    keep(fitted(problem, objective=1.0), F.upto(0.3))  # not the whole record
    keep(fitted(problem, objective=1.0), F.inflated(2.0))
    h, stage = store.start(problem, ())
    assert stage is S3 and h.objective == 40.0 and h.z[1] == pytest.approx(0.3)


def test_a_fit_belongs_to_its_block_its_points_and_its_seconds(made, problem):
    key = fit_key(problem, ())
    assert fit_key(fit_problem(made, made.fit_runs(), TABLE.replace(mu_ext=0.2), end=0.6, workers=1), ()) == key
    for other in (TABLE.replace(mass=50.0), Model.four_points(), TABLE.replace(foot_radius=1e-4)):
        assert fit_key(fit_problem(made, made.fit_runs(), other, end=0.6, workers=1), ()) != key
    assert fit_key(fit_problem(made, made.fit_runs(), TABLE, end=0.5, workers=1), ()) != key


def test_a_diagnosis_belongs_to_all_its_options():
    key = options_key(TABLE, 0, 3.0, ())
    dragged = TABLE.replace(effects=(parse("quadratic_drag:c=0.4"),))
    others = [options_key(TABLE.replace(mu_ext=0.2), 0, 3.0, ()), options_key(TABLE, 1, 3.0, ()),
              options_key(TABLE, 0, 1.6, ()), options_key(TABLE, 0, 3.0, ("mine",)),
              options_key(dragged, 0, 3.0, ())]  # fmt: skip
    assert len({key, *others}) == 6
    assert options_key(TABLE.replace(origin={"made_by": "x"}), 0, 3.0, ()) == key


def test_other_data_and_another_program_find_nothing(folder, monkeypatch, made, problem):
    store = FitStore().open(made)
    store.note(problem)(fitted(problem), F)
    store.save()
    other = replace(made, runs=(replace(made.runs[0], sha256="f" * 64), *made.runs[1:]))
    assert FitStore().open(other).start(problem, ()) is None
    monkeypatch.setattr(fit_store, "program_digest", lambda: "another")
    assert FitStore().open(made).start(problem, ()) is None


@pytest.mark.parametrize("text", ["", "{", "[]", '{"format": 99}', '{"format": 1, "fits": {}}'])
def test_a_file_that_cannot_be_read_counts_as_nothing_kept(folder, made, problem, text):
    store = FitStore().open(made)
    store.path.parent.mkdir()
    store.path.write_text(text)
    assert FitStore().open(made).start(problem, ()) is None


def test_without_a_folder_to_write_to_there_is_one_remark_and_no_failure(folder, made, problem):
    folder.write_text("no folder")
    store = FitStore().open(made)
    store.note(problem)(fitted(problem), F)
    store.save()
    assert store.remark.code == "W-CACHE" and store.start(problem, ()) is not None


def test_the_folder_is_that_of_the_system(monkeypatch):
    monkeypatch.delenv("ROCKREF_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", "/somewhere")
    monkeypatch.setenv("LOCALAPPDATA", "/local")
    for system, start in (("linux", "/somewhere"), ("darwin", "~/Library/Caches"), ("win32", "/local")):
        monkeypatch.setattr(fit_store, "sys", SimpleNamespace(platform=system))
        assert cache_folder().as_posix() == f"{os.path.expanduser(start)}/rockref"
    monkeypatch.setenv("ROCKREF_CACHE", "/mine")
    assert cache_folder().as_posix() == "/mine"


def test_the_oldest_files_go(tmp_path, monkeypatch):
    monkeypatch.setattr(fit_store, "MOST", 2)
    for k in range(4):
        (tmp_path / f"{k}.json").write_text("{}")
        os.utime(tmp_path / f"{k}.json", (k, k))
    prune(tmp_path)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["2.json", "3.json"]


def test_an_interrupted_search_goes_on_after_its_last_stage(folder, monkeypatch, made, problem):
    """The stages before are not computed again, and the search ends as one that was not interrupted."""
    did = []
    null = fitted(problem)

    def begin(search):
        did.append("S2")
        search.baseline, search.problem.tone = null, 17.0
        return [null, fitted(problem, ("gyro_scale",), 50.0)]

    def lengthen(search, beam, stage):
        did.append(stage.name)
        if stage is F and len(did) == 3:
            raise KeyboardInterrupt
        return beam[:1] if stage is F else beam

    monkeypatch.setattr(Search, "begin", begin)
    monkeypatch.setattr(Search, "lengthen", lengthen)
    monkeypatch.setattr(Search, "eliminate", lambda search, beam: [*beam, search.baseline])
    with pytest.raises(KeyboardInterrupt):
        KeptSearch(Fitter(problem), FitStore().open(made), "key").run()
    problem.tone = None
    found = KeptSearch(Fitter(problem), FitStore().open(made), "key").run()
    assert did == ["S2", "S3", "F", "F"] and problem.tone == 17.0
    assert [h.effects for h in found] == [(), ()] and np.array_equal(found[1].z, null.z)
    kept = json.loads(next(folder.glob("*.json")).read_text())
    assert kept["searches"]["key"]["stage"] == "S3"
