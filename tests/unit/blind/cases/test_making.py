"""Cases are made once, each as its worker gets free, in the order of the plan."""

import json
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager

import pytest

from rockref.blind.cases import generator, making, plan
from rockref.jobs.campaign import Campaign, campaign


@pytest.fixture
def made(monkeypatch):
    """A generator that only notes what it was asked for, and writes the head of an experiment."""
    asked = []

    def make_case(folder, effects, seed, **options):
        asked.append(folder.name)
        folder.mkdir()
        (folder / "experiment.toml").write_text(f"name = '{folder.name}'\n")
        return {"name": folder.name, "seed": seed, "effects": [list(e) for e in effects]}

    monkeypatch.setattr(generator, "make_case", make_case)
    return asked


def test_a_case_keeps_its_truth_apart_and_is_not_made_again(tmp_path, made):
    (case,) = plan.listed(1, ["plate_tilt"])
    (tmp_path / making.PARTS).mkdir()
    assert making.make_one(str(tmp_path), "case-001", case) == "case-001"
    part = tmp_path / making.PARTS / "case-001.json"
    truth = json.loads(part.read_text())
    assert truth["effects"][0][0] == "plate_tilt" and truth["kind"] == case.kind
    assert truth["class"] == list(case.same_as)
    making.make_one(str(tmp_path), "case-001", case)
    assert made == ["case-001"]
    part.unlink()
    (tmp_path / "case-001" / "experiment.toml").unlink()
    (tmp_path / "case-001").rmdir()
    making.make_one(str(tmp_path), "case-001", case)
    assert made == ["case-001", "case-001"]


def test_results_stand_in_the_order_of_the_jobs_however_they_end(monkeypatch):
    def job(name, pause):
        time.sleep(pause)
        return name

    @contextmanager
    def threads(workers, dask):
        with ThreadPoolExecutor(3) as pool, campaign(3, executor=pool) as made:
            assert isinstance(made, Campaign)
            yield made

    monkeypatch.setattr("rockref.jobs.campaign.campaign", threads)
    jobs, shares = [("a", 0.2), ("b", 0.0), ("c", 0.1)], []
    assert making.run_all(job, jobs, 3, None, shares.append) == ["a", "b", "c"]
    assert shares == pytest.approx([1 / 3, 2 / 3, 1.0])


def test_alone_the_jobs_are_done_one_after_the_other():
    shares = []
    assert making.run_all(lambda a: 2 * a, [(1,), (2,)], 1, None, shares.append) == [2, 4]
    assert shares == [0.5, 1.0] and making.run_all(lambda: 1, [], 1, None, shares.append) == []
