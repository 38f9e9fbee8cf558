"""`rockref add`: the error before and after, the history in the model; the fit itself is made up."""

import json

import pytest

from rockref import Model, cli
from rockref.discover import add_effect as adding
from tests import command
from tests.unit.discover import fakes

run = command.of("add")


@pytest.fixture(scope="module")
def made():
    return fakes.made_experiment()


def test_error_before_and_after_in_words(capsys, monkeypatch, tmp_path, made):
    monkeypatch.setattr(adding, "add_effect", lambda *a, **k: fakes.addition(made))
    code, out, _ = run(capsys, "anywhere", "quadratic_drag", "-o", tmp_path / "m.toml")
    assert code == 0 and len(out.splitlines()) <= 12
    assert out.splitlines()[-1].startswith("Next: rockref compare anywhere --model baseline --model ")
    # (0.25 - 0.07) of (0.25 - 0.05); (0.35 - 0.15) of (0.35 - 0.05).
    assert "Fit runs: error 0.2500 to 0.0700 deg/s RMS, noise floor 0.0500; 90 % of the excess" in out
    assert "Held-out runs: error 0.3500 to 0.1500 deg/s RMS, noise floor 0.0500; 67 % of the excess" in out


def test_history_survives_the_file(capsys, monkeypatch, tmp_path, made):
    monkeypatch.setattr(adding, "add_effect", lambda *a, **k: fakes.addition(made))
    run(capsys, "anywhere", "quadratic_drag", "-o", tmp_path / "m.toml")
    model = Model.load(tmp_path / "m.toml")
    history = model.origin["history"]
    assert [entry["effects"] for entry in history] == [[], ["quadratic_drag"]]
    assert [entry["holdout_deg_s"] for entry in history] == [0.35, 0.15]
    assert history[0]["fit_by_axis_deg_s"] == [0.125, 0.25, 0.375]
    # A second effect keeps what came before the model's own state, and measures that one anew.
    assert [e["effects"] for e in adding.earlier(model, ("quadratic_drag",))] == [[]]


def test_page_and_json(capsys, monkeypatch, tmp_path, made):
    monkeypatch.setattr(adding, "add_effect", lambda *a, **k: fakes.addition(made))
    _, out, _ = run(
        capsys, "anywhere", "quadratic_drag", "-o", tmp_path / "m.toml", "--report", tmp_path / "page", "--json"
    )
    record = json.loads(out)
    assert record["error"]["gap_closed"]["fit"] == pytest.approx(0.9)
    assert record["error"]["before"]["fit"]["transverse"] == 0.25
    page = (tmp_path / "page/index.html").read_text(encoding="utf-8")
    assert "History of the model" in page and page.count("<figure") == 7


def test_unknown_effect_ends_with_2(capsys, tmp_path):
    code, out, err = run(capsys, "anywhere", "quadratic_dra", "-o", tmp_path / "m.toml")
    assert (code, out) == (2, "") and "quadratic_drag" in err and "[E-EFFECT]" in err


def test_what_is_refused_leaves_no_folder(capsys, tmp_path):
    code, _, _ = run(capsys, "anywhere", "quadratic_dra", "--report", tmp_path / "page")
    assert code == 2 and not (tmp_path / "page").exists()
    code, _, err = run(capsys, "anywhere", "quadratic_drag", "--report", "")
    assert code == 2 and "is empty" in err


def test_a_model_that_could_not_be_written_is_refused_before_the_work(capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(adding, "add_effect", lambda *a, **k: pytest.fail("the work was begun"))
    code, _, err = run(capsys, "anywhere", "quadratic_drag", "-o", tmp_path / "nowhere" / "m.toml")
    assert code == 2 and "[E-WRITE]" in err


def test_the_old_order_works_with_a_remark(capsys, monkeypatch, tmp_path):
    """`rockref add EFFECT EXPERIMENT`, as it was spelt before."""
    asked = []
    monkeypatch.setattr(adding, "add_effect", lambda *a, **k: asked.append(a[:2]) or pytest.fail("far enough"))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    for order, remark in ((("quadratic_drag", "folder"), True), (("folder", "quadratic_drag"), False)):
        with pytest.raises(pytest.fail.Exception):
            cli.main(["add", *order])
        assert ("W-SPELLING" in capsys.readouterr().err) == remark
    assert [(effect, str(where)) for effect, where in asked] == [("quadratic_drag", "folder")] * 2
