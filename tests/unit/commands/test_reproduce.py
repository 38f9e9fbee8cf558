"""`rockref reproduce`: the names of studies, and everything once through."""

import json
from pathlib import Path

import pytest

from rockref.commands import reproduce
from rockref.report.html.inline import MAX_BYTES
from rockref.studies.twins import SEEDS
from rockref.workflows.reproduce_source import PARTS
from tests.command import run


@pytest.fixture
def studies(monkeypatch):
    """Two studies that only note how they were called."""
    called = []

    def made(name):
        def make(asked):
            called.append((name, asked.folder, asked.workers, asked.quick))
            return asked.folder / "p"

        return make

    monkeypatch.setattr(reproduce, "STUDIES", {"source": made("source"), "other": made("other")})
    return called


@pytest.mark.parametrize(
    ("words", "wanted"), [(["out"], "source"), (["source", "out"], "source"), (["other", "out"], "other")]
)
def test_the_study_may_be_named_and_is_the_source_by_default(capsys, studies, words, wanted):
    code, out, _ = run(capsys, "reproduce", *words, "--workers", 1, "--json")
    record = json.loads(out)
    assert code == 0 and record["study"] == wanted
    assert record["seconds"] >= 0 and record["processor_seconds"] > 0
    assert studies == [(wanted, Path("out"), 1, False)]


@pytest.mark.parametrize("words", [["nothing", "out"], ["source"]])
def test_a_study_that_is_not_there_or_has_no_folder_is_unusable_input(capsys, studies, words):
    code, _, err = run(capsys, "reproduce", *words)
    assert code == 2 and not studies and "reproduce" in err or "Use one of" in err


@pytest.mark.parametrize("words", [["out", "--only", "twin"], ["cube", "out", "--only", "twins"]])
def test_a_part_that_is_not_there_is_unusable_input(capsys, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    code, _, err = run(capsys, "reproduce", *words)
    assert code == 2 and "--only" in err and not list(tmp_path.iterdir())


def test_the_earthquake_goes_once_through_on_a_page(capsys, tmp_path, monkeypatch):
    pytest.importorskip("numba")
    from rockref.shake import defects

    monkeypatch.setattr(defects, "LEVELS", (0.5, 30.0))
    for name, value in (("RISE", 0.1), ("STRONG", 0.5), ("LENGTH", 0.7), ("AFTER", 0.6)):
        monkeypatch.setattr(defects, name, value)
    code, _, _ = run(capsys, "reproduce", "earthquake", tmp_path / "r", "--signals", 20, "--step", 4e-5, "--workers", 1)
    page = (tmp_path / "r/index.html").read_text(encoding="utf-8")
    record = json.loads((tmp_path / "r/earthquake.json").read_text())
    assert code == 0 and "The authors state" in page
    assert [level["signals"] for level in record["levels"]] == [10, 10]
    # A third of the acceleration that lifts the block, and twenty times it.
    assert record["levels"][0]["rocked"] == [0, 0] and record["levels"][1]["fell"] == [10, 10]
    assert record["only_calibrated_fell"] == record["only_symmetric_fell"] == 0
    assert run(capsys, "reproduce", "cube", tmp_path / "c", "--signals", 20)[0] == 2


@pytest.mark.parametrize("study, kept", [("earthquake", True), ("cube", False)])
def test_an_interrupted_study_says_what_is_kept(capsys, tmp_path, monkeypatch, study, kept):
    def stop(asked):
        raise KeyboardInterrupt

    monkeypatch.setitem(reproduce.STUDIES, study, stop)
    code, _, err = run(capsys, "reproduce", study, tmp_path / "r")
    assert code == 130 and ("the same command goes on" in err) is kept


def test_a_part_alone_has_a_page_of_its_own(capsys, tmp_path):
    pytest.importorskip("numba")
    code, out, _ = run(capsys, "reproduce", tmp_path / "r", "--only", "response", "--workers", 1)
    page = (tmp_path / "r/response.html").read_text(encoding="utf-8")
    assert code == 0 and "s of processor time" in out
    assert "What the source states" in page and "Twin experiments" not in page
    assert list(json.loads((tmp_path / "r/response.json").read_text())) == ["response"]


@pytest.mark.slow
def test_once_through_and_a_second_time_from_what_is_kept(capsys, tmp_path):
    pytest.importorskip("numba")
    code, _, _ = run(capsys, "reproduce", tmp_path / "r", "--quick", "--workers", 1)
    assert code == 0
    page = (tmp_path / "r/index.html").read_text(encoding="utf-8")
    for title in ("Sensitivity", "Twin experiments", "From 54 genes to 12", "The models that failed", "Identification"):
        assert title in page
    before = {p: p.stat().st_mtime_ns for p in (tmp_path / "r/pieces").iterdir()}
    run(capsys, "reproduce", tmp_path / "r", "--quick", "--workers", 1)
    assert {p: p.stat().st_mtime_ns for p in (tmp_path / "r/pieces").iterdir()} == before


@pytest.mark.slow
def test_the_page_of_everything_stays_below_its_limit(capsys, tmp_path):
    # With the whole budget, whose tables are longer and whose curves are richer than those of --quick.
    pytest.importorskip("numba")
    code, _, err = run(capsys, "reproduce", tmp_path / "r", "--workers", 1)
    assert code == 0, err
    results = json.loads((tmp_path / "r/results.json").read_text())
    assert set(results) == set(PARTS) and len(results["twins"]) == len(SEEDS)
    page = tmp_path / "r/index.html"
    assert page.read_text(encoding="utf-8").count('src="data:image/png') == len(list(tmp_path.glob("r/figures/*.png")))
    assert page.stat().st_size < MAX_BYTES
