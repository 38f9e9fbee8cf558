"""`rockref effects`: the list, one effect, its picture, and what is refused."""

import json
from pathlib import Path

import pytest

from rockref import cli
from rockref.effects.catalogue import EFFECTS

EXAMPLE = Path(__file__).resolve().parents[3] / "examples/my_effect.py"


def said(capsys, *arguments):
    """What the command prints, and its exit code."""
    with pytest.raises(SystemExit) as end:
        cli.main(["effects", *arguments])
    out, err = capsys.readouterr()
    return out, err, end.value.code or 0


def test_list_has_every_effect_with_its_sentence(capsys):
    out, _, code = said(capsys)
    assert code == 0
    for id, kind in EFFECTS.items():
        assert f"  {id:24} {kind.sentence}\n" in out
    assert out.count("  none ") == 7


def test_one_effect_shows_what_a_reader_needs(capsys):
    out, _, code = said(capsys, "spin_friction:radius=0.003")
    kind = EFFECTS["spin_friction"]
    assert code == 0
    for part in (kind.sentence, kind.equation, kind.source, kind.confounder, kind.experiment, "here 0.003"):
        assert part in out
    assert "rockref simulate --effect spin_friction:radius=0.003" in out


def test_json_is_json_without_infinities(capsys):
    cards = json.loads(said(capsys, "--json")[0], parse_constant=lambda text: pytest.fail(text))
    assert {card["id"] for card in cards} == set(EFFECTS)
    card = json.loads(said(capsys, "gyro_bandwidth", "--json")[0])
    assert card["parameters"]["frequency"]["absent"] == "inf"
    assert card["acts_at"] == ["sensor"]


def test_users_own_effect_is_shown(capsys):
    out, _, code = said(capsys, f"{EXAMPLE}:EddyBrake")
    assert code == 0 and "eddy_brake (loads)" in out and "Lenz" in out


def test_picture_is_a_picture(capsys, tmp_path):
    path = tmp_path / "drift.png"
    out, _, code = said(capsys, "gyro_drift", "--picture", str(path), "--duration", "0.01")
    assert code == 0 and f"wrote        {path}" in out
    assert path.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["spin_fricton"], "Did you mean 'spin_friction'"),
        (["spin_friction:radius=-1"], "of at least 0 m"),
        (["spin_friction", "--picture", "spin.pdf"], "End its name in .png or .svg"),
        (["--picture", "all.png"], "needs an effect"),
        (["spin_friction", "--picture", "nowhere/spin.png", "--duration", "0.01"], "nowhere"),
    ],
)
def test_what_cannot_be_done_is_said(capsys, arguments, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    _, err, code = said(capsys, *arguments)
    assert code == 2
    assert message in err
    assert not list(tmp_path.iterdir())
