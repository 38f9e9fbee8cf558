"""`rockref diagnose`: what it prints and writes, with which exit code; the diagnosis itself is made up."""

import json
from dataclasses import replace

import pytest

from rockref.discover import diagnose as engine
from rockref.discover.diagnosis_record import plain
from rockref.measure.records.notice import Notice
from tests import command
from tests.shipped import ROOT
from tests.unit.discover import fakes

run = command.of("diagnose")


@pytest.fixture(scope="module")
def made():
    return fakes.made_experiment()


def answer(monkeypatch, found):
    """Make the engine return this diagnosis; the arguments it was called with come back in a list."""
    calls = []
    monkeypatch.setattr(engine, "diagnose", lambda *a, **k: calls.append((a, k)) or found)
    return calls


def test_json_is_the_record_and_nothing_else(capsys, monkeypatch, made):
    found = fakes.diagnosis("named", made)
    answer(monkeypatch, found)
    code, out, err = run(capsys, "anywhere", "--json")
    assert (code, err) == (0, "")
    assert json.loads(out) == plain(found.to_dict())
    assert set(fakes.DIAGNOSIS_KEYS) <= set(json.loads(out))


@pytest.mark.parametrize(
    "verdict, code", [("named", 0), ("none", 0), ("class", 0), ("something_else", 0), ("not_trustworthy", 1)]
)
def test_exit_code_is_1_only_where_nothing_can_be_trusted(capsys, monkeypatch, made, verdict, code):
    answer(monkeypatch, fakes.diagnosis(verdict, made))
    assert run(capsys, "anywhere")[0] == code


def test_the_verdict_comes_last_and_then_what_to_type(capsys, monkeypatch, made):
    answer(monkeypatch, fakes.diagnosis("named", made))
    _, out, _ = run(capsys, "anywhere")
    assert out.splitlines()[-1] == "Next: rockref add anywhere quadratic_drag"
    said = "NAMED (probability 1.00). quadratic_drag is missing. Its size is 0.41 N m s² (90 %: 0.38 to 0.44). Next:"
    assert said in " ".join(out.split())
    assert len(out.splitlines()) <= 12
    for text in ("0.250", "0.060", "0.350", "0.080", "0.050", "0.38", "0.44", "512"):
        assert text in out, text
    # (0.25 - 0.06) of (0.25 - 0.05), and (0.35 - 0.08) of (0.35 - 0.05).
    assert "95 %" in out and "90 %" in out
    assert "Turn the block <by half a turn> & repeat." in run(capsys, "anywhere", "--full")[1]


def test_a_check_that_the_fit_did_not_pass_is_said_with_the_verdict(capsys, monkeypatch, tmp_path, made):
    """A fit that had not come to rest was "passed: yes", and on the terminal nothing was said of it."""
    found = fakes.diagnosis("named", made)
    sentence = "One more step promises 2.45 units."
    gate = {"name": "gradient_small", "passed": False, "value": 2.45, "limit": 2.0, "sentence": sentence}
    found.gates["gradient_small"] = gate
    answer(monkeypatch, found)
    code, out, _ = run(capsys, "anywhere", "--report", tmp_path)
    assert code == 0 and f"With care: {sentence}" in out
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "a verdict is given" in page and f"Not passed. {sentence}" in page and ">passed<" not in page


def test_the_page_of_the_record_has_every_key(made):
    """`docs/reference/diagnose.md` has a row for each key, and no other row."""
    text = (ROOT / "docs/reference/diagnose.md").read_text(encoding="utf-8")
    keys = [line.split("`")[1] for line in text.split("\n## ")[0].splitlines() if line.startswith("| `")]
    assert sorted(keys) == sorted(fakes.diagnosis("named", made).to_dict())


def test_sizes_come_with_a_caution_where_a_number_is_at_its_bound(capsys, monkeypatch, made):
    found = fakes.diagnosis("named", made)
    answer(monkeypatch, found)
    assert "with care" not in run(capsys, "anywhere", "--full")[1]
    sentence = "gyro_misalignment.xz is farthest from the centre of its prior: 6.7 deviations."
    found.gates["off_bounds"] = {
        "name": "off_bounds",
        "passed": False,
        "value": 6.7,
        "limit": 3.0,
        "sentence": sentence,
    }
    out = " ".join(run(capsys, "anywhere", "--full")[1].split())
    assert f"Take them with care: {sentence}" in out


def test_nothing_found_shows_no_amplitude(capsys, monkeypatch, made):
    answer(monkeypatch, fakes.diagnosis("none", made))
    _, out, _ = run(capsys, "anywhere", "--full")
    assert "How large" not in out and "gap" not in out


def test_record_written_beside_reads_back(capsys, monkeypatch, made, tmp_path):
    found = fakes.diagnosis("class", made)
    answer(monkeypatch, found)
    run(capsys, "anywhere", "--output", tmp_path / "verdict.json")
    assert json.loads((tmp_path / "verdict.json").read_text(encoding="utf-8")) == plain(found.to_dict())


def test_options_reach_the_engine(capsys, monkeypatch, made):
    calls = answer(monkeypatch, fakes.diagnosis("none", made))
    brake = f"{ROOT / 'examples/my_effect.py'}:EddyBrake"
    run(capsys, "anywhere", "--seed", "7", "--workers", "2", "--model", "four_points", "--effect", brake)
    (path, model, seed, workers), options = calls[0]
    assert (str(path), model.points, seed, workers) == ("anywhere", "four_points", 7, 2)
    assert options["own"] == [brake]


def test_unusable_input_ends_with_2(capsys, tmp_path):
    code, out, err = run(capsys, tmp_path / "nowhere")
    assert (code, out) == (2, "") and "[E-FOLDER]" in err


@pytest.mark.parametrize("option", ["--output", "--save-model"])
def test_what_could_not_be_written_is_refused_before_the_work(capsys, monkeypatch, made, tmp_path, option):
    calls = answer(monkeypatch, fakes.diagnosis("none", made))
    code, out, err = run(capsys, "anywhere", option, tmp_path / "nowhere" / "file.toml")
    assert (code, out, calls) == (2, "", []) and "[E-WRITE]" in err


def test_remarks_about_the_records_are_said(capsys, monkeypatch, made):
    """Who does not compare first must hear, too, that a gyroscope saturates or that a record begins late."""
    remark = Notice("W-SATURATED", "run01.csv, column wx_deg_s", "12 samples are at the stated range", "Use another.")
    answer(monkeypatch, fakes.diagnosis("named", replace(made, notices=(remark,))))
    code, out, err = run(capsys, "anywhere", "--json")
    assert code == 0 and json.loads(out)
    assert err == f"rockref: {remark}\n"
