"""`rockref compare`: exit codes, JSON, report folder."""

import json
import re
import shutil
from pathlib import Path

import pytest

from rockref import Model, cli

ROOT = Path(__file__).resolve().parents[3]
SHIPPED = ROOT / "data/experiments/mystery-08"


def run(capsys, *arguments):
    """Exit code, standard output and standard error of `rockref ARGUMENTS`."""
    with pytest.raises(SystemExit) as end:
        cli.main([str(a) for a in arguments])
    out, err = capsys.readouterr()
    return end.value.code, out, err


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    """Two runs of a shipped experiment, so that a comparison is quick."""
    folder = tmp_path_factory.mktemp("short")
    head, *runs = (SHIPPED / "experiment.toml").read_text(encoding="utf-8").split("[[run]]")
    kept = [r for r in runs if re.search(r'id = "0[13]"', r)]
    (folder / "experiment.toml").write_text("[[run]]".join([head, *kept]), encoding="utf-8")
    for k in ("01", "03"):
        shutil.copy(SHIPPED / f"run{k}.csv.gz", folder)
    return folder


@pytest.fixture(scope="module")
def model_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("models") / "mine.toml"
    Model.table_3_1().replace(beta_ext=0.22).save(path)
    return path


def test_tables_and_sentences(capsys, short):
    code, out, _ = run(capsys, "compare", short)
    assert code == 0
    for words in ("Error of baseline (eight_points)", "Run by run", "leaves the band", "Energy lost", "01 (fit)"):
        assert words in out
    assert "03 (holdout)" in out


def test_check_ends_with_1_where_the_band_is_left_early(capsys, short):
    assert run(capsys, "compare", short, "--check")[0] == 1


def test_json_of_two_models(capsys, short, model_file):
    code, out, _ = run(capsys, "compare", short, "--model", "table_3_1", "--model", model_file, "--json")
    found = json.loads(out)
    assert code == 0
    assert [m["name"] for m in found["models"]] == ["table_3_1", "mine"]
    assert found["experiment"]["runs"] == {"fit": ["01"], "holdout": ["03"]}
    assert found["written"] == []


def keys_of(value, found):
    if isinstance(value, dict):
        for key, inner in value.items():
            found.add(key)
            keys_of(inner, found)
    elif isinstance(value, list):
        for inner in value:
            keys_of(inner, found)
    return found


def test_every_key_of_the_json_is_documented(capsys, short):
    found = json.loads(run(capsys, "compare", short, "--json")[1])
    for sentence in found["sentences"]:
        # The values of a sentence are those of its kind, listed there by kind.
        sentence["values"] = {}
    page = (ROOT / "docs/reference/compare.md").read_text(encoding="utf-8")
    documented = set(re.findall(r"`([A-Za-z_0-9]+)`", page))
    assert keys_of(found, set()) <= documented
    assert {s["kind"] for s in found["sentences"]} <= documented


def test_report_is_a_page_and_figures(capsys, short, tmp_path):
    folder = tmp_path / "new" / "report"
    code, out, _ = run(capsys, "compare", short, "--report", folder)
    assert code == 0
    names = sorted(p.name for p in folder.iterdir())
    assert names[0] == "index.html" and len(names) == 5
    assert all(f"wrote {folder / name}" in out for name in names)


@pytest.mark.parametrize(
    "extra, said",
    [(("--model", "nowhere.toml"), "E-FILE"), (("--engine", "abacus"), "E-ENGINE")],
)
def test_bad_options_end_with_2(capsys, short, tmp_path, extra, said):
    code, out, err = run(capsys, "compare", short, *extra, "--report", tmp_path / "r")
    assert (code, out) == (2, "") and said in err
    assert not (tmp_path / "r" / "index.html").exists()


def test_folder_without_experiment_ends_with_2(capsys, tmp_path):
    code, out, err = run(capsys, "compare", tmp_path)
    assert (code, out) == (2, "")
    assert "experiment.toml" in err


def test_report_on_a_file_is_refused_before_work(capsys, short, tmp_path):
    (tmp_path / "file").write_text("x")
    code, _, err = run(capsys, "compare", short, "--report", tmp_path / "file")
    assert code == 2 and "E-WRITE" in err


def test_demo_without_data_says_where_to_get_it(capsys, tmp_path):
    code, out, err = run(capsys, "demo", "--data", tmp_path, "--out", tmp_path / "out")
    assert (code, out) == (2, "")
    assert "E-DEMO" in err and "source repository" in err
    assert not (tmp_path / "out").exists()
