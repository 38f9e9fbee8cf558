"""`rockref lab`: a page with or without an experiment; what has no sliders is refused, and nothing is written."""

import rockref
from rockref.lab import page
from tests import command

run = command.of("lab")


def test_without_an_experiment_the_page_begins_at_the_model(capsys, tmp_path):
    rockref.Model(mass=27.0).save(tmp_path / "mine.toml")
    code, said, _ = run(capsys, "--model", tmp_path / "mine.toml", "--output", tmp_path / "lab.html")
    assert code == 0 and said == f"wrote {tmp_path / 'lab.html'}\n"
    text = (tmp_path / "lab.html").read_text(encoding="utf-8")
    assert '"mass":27.0' in text and '"experiment":null' in text


def test_a_model_without_sliders_is_refused(capsys, tmp_path):
    model = rockref.Model(points="custom", custom_points=rockref.Model().body()[1])
    model.save(tmp_path / "mine.toml")
    code, _, complaint = run(capsys, "--model", tmp_path / "mine.toml", "--output", tmp_path / "lab.html")
    assert code == 2 and "E-LAB" in complaint
    assert not (tmp_path / "lab.html").exists()


def test_a_page_that_is_too_large_is_not_written(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr(page, "MAX_BYTES", 1000)
    code, _, complaint = run(capsys, "--output", tmp_path / "lab.html")
    assert code == 2 and "E-PAGE-SIZE" in complaint
    assert not (tmp_path / "lab.html").exists()
