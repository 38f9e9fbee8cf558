"""`rockref reproduce`: the names of studies, and everything once through."""

import json
from pathlib import Path

import pytest

from rockref import cli
from rockref.commands import reproduce


def run(capsys, *arguments):
    """Exit code, standard output and standard error of `rockref ARGUMENTS`."""
    with pytest.raises(SystemExit) as end:
        cli.main([str(a) for a in arguments])
    out, err = capsys.readouterr()
    return end.value.code, out, err


@pytest.fixture
def studies(monkeypatch):
    """Two studies that only note how they were called."""
    called = []

    def made(name):
        return lambda folder, data, workers, quick, say: called.append((name, folder, workers, quick)) or folder / "p"

    monkeypatch.setattr(reproduce, "STUDIES", {"source": made("source"), "other": made("other")})
    return called


@pytest.mark.parametrize(
    ("words", "wanted"), [(["out"], "source"), (["source", "out"], "source"), (["other", "out"], "other")]
)
def test_the_study_may_be_named_and_is_the_source_by_default(capsys, studies, words, wanted):
    code, out, _ = run(capsys, "reproduce", *words, "--workers", 1, "--json")
    assert code == 0 and json.loads(out)["study"] == wanted
    assert studies == [(wanted, Path("out"), 1, False)]


@pytest.mark.parametrize("words", [["nothing", "out"], ["source"]])
def test_a_study_that_is_not_there_or_has_no_folder_is_unusable_input(capsys, studies, words):
    code, _, err = run(capsys, "reproduce", *words)
    assert code == 2 and not studies and "reproduce" in err or "Use one of" in err


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
