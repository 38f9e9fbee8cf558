"""`rockref compare`: exit codes, JSON, report folder."""

import json
import re

import pytest

from rockref import Model
from rockref.report.terminal.comparison_text import print_comparison
from tests.command import run
from tests.printed import printed
from tests.shipped import ROOT, two_runs


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    """Two runs of a shipped experiment, so that a comparison is quick."""
    return two_runs(tmp_path_factory.mktemp("short"))


@pytest.fixture(scope="module")
def model_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("models") / "mine.toml"
    Model.table_3_1().replace(beta_ext=0.22).save(path)
    return path


def test_tables_and_sentences(capsys, short):
    code, out, _ = run(capsys, "compare", short)
    assert code == 0 and len(out.splitlines()) <= 12 and "leaves the band" in out
    assert out.splitlines()[-1] == f"Next: rockref diagnose {short} --report report"
    code, out, _ = run(capsys, "compare", short, "--full")
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


@pytest.mark.parametrize("extra, said", [(("--model", "nowhere.toml"), "E-FILE"), (("--engine", "abacus"), "E-ENGINE")])
def test_bad_options_end_with_2(capsys, short, tmp_path, extra, said):
    code, out, err = run(capsys, "compare", short, *extra, "--report", tmp_path / "new" / "report")
    assert (code, out) == (2, "") and said in err
    assert not list(tmp_path.iterdir())


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


@pytest.fixture(scope="module")
def of_two_models(short):
    from rockref.discover.compare.models import compare
    from rockref.measure import load_experiment

    return compare(load_experiment(short), [Model.table_3_1(), Model.four_points()], ["table_3_1", "four_points"])


@pytest.mark.parametrize(("width", "terminal"), [(80, True), (80, False), (40, True), (120, False), (200, True)])
def test_every_number_of_the_tables_is_there(of_two_models, width, terminal):
    """In whatever width, as a word of its own: nothing is cut, no number is broken."""
    from rockref.report.tables import comparison_tables

    shown = printed(print_comparison, of_two_models, True, width=width, terminal=terminal)
    assert "\u2026" not in shown
    words = set(shown.split())
    made = [comparison_tables.runs_table(of_two_models), comparison_tables.energy_table(of_two_models)]
    for model in (0, 1):
        made += [comparison_tables.departures_table(of_two_models, model)]
        made += [comparison_tables.errors_table(of_two_models, model, use) for use in ("fit", "holdout")]
    for table in made:
        for row in table.rows:
            assert {word for cell in row for word in cell.split()} <= words, table.caption


def test_at_80_columns_no_line_of_a_table_is_longer(of_two_models):
    shown = printed(print_comparison, of_two_models, True, width=80, terminal=True)
    assert max(map(len, shown.splitlines())) <= 80


def test_in_a_pipe_a_row_is_a_line(of_two_models):
    shown = printed(print_comparison, of_two_models, True, width=80)
    rows = [line.split() for line in shown.splitlines() if line.startswith("01 (fit) ")]
    # one of the runs, one a model of where it leaves the band
    assert len(rows) == 3
    assert all(re.fullmatch(r"0\.\d{3}", word) for word in rows[0][-6:-1] if word != "/")


@pytest.mark.parametrize("command", ["compare", "diagnose"])
def test_a_report_in_no_folder_is_refused(capsys, short, command):
    code, out, err = run(capsys, command, short, "--report", "")
    assert (code, out) == (2, "")
    assert "--report" in err and "name a folder" in err


def test_a_model_too_stiff_for_the_step_is_named_with_its_point(capsys, short, tmp_path):
    """The command has no step to choose: the cure is the model's."""
    path = tmp_path / "glass.toml"
    Model.four_points().replace(K_N=6e12).save(path)
    code, out, err = run(capsys, "compare", short, "--model", path)
    said = " ".join(err.split())
    assert (code, out) == (2, "")
    assert "model glass" in said and "K_N = 6e+12 N/m" in said and "1ext" in said and "[E-STEP]" in said
    assert "Use a step" not in said
