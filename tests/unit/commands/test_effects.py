"""`rockref effects`: the list, one effect, its picture, and what is refused."""

import json
from pathlib import Path

import pytest

from rockref.effects.catalogue import EFFECTS, OF_TOSSES
from tests import command

EXAMPLE = Path(__file__).resolve().parents[3] / "examples/my_effect.py"


def said(capsys, *arguments):
    """What the command prints, and its exit code."""
    code, out, err = command.run(capsys, "effects", *arguments)
    return out, err, code


def test_list_has_every_effect_with_its_sentence(capsys):
    out, _, code = said(capsys)
    assert code == 0
    for id, kind in (EFFECTS | OF_TOSSES).items():
        assert f"  {id:24} {kind.sentence}\n" in out
    assert out.count("  none ") == 8
    assert out.index("\ntosses: ") < out.index("  tag_frame ")


def test_one_effect_shows_what_a_reader_needs(capsys):
    out, _, code = said(capsys, "spin_friction:radius=0.003")
    kind = EFFECTS["spin_friction"]
    assert code == 0
    for part in (kind.sentence, kind.equation, kind.source, kind.confounder, kind.experiment, "here 0.003"):
        assert part in out
    assert "rockref simulate --effect spin_friction:radius=0.003" in out


def test_json_is_json_without_infinities(capsys):
    cards = json.loads(said(capsys, "--json")[0], parse_constant=lambda text: pytest.fail(text))
    assert {card["id"] for card in cards} == set(EFFECTS | OF_TOSSES)
    card = json.loads(said(capsys, "gyro_bandwidth", "--json")[0])
    assert card["parameters"]["frequency"]["absent"] == "inf"
    assert card["acts_at"] == ["sensor"]


@pytest.mark.parametrize("id", ["foot_defects", "quadratic_drag", "compliant_support"])
def test_the_command_that_is_shown_can_be_typed(capsys, id):
    """`foot_defects` needs the four-point model."""
    out = said(capsys, id)[0]
    line = out.split("to use it    rockref ")[1].splitlines()[0]
    assert command.run(capsys, *line.split(), "--duration", "0.01")[0] == 0
    assert f"--picture {id}.png" in out


def test_effects_of_tosses_are_shown_without_a_simulation(capsys):
    out = said(capsys, "tag_frame")[0]
    assert "tag_frame (tracking, tosses only)" in out and "to use it    rockref fit FOLDER_OF_TOSSES" in out
    assert "acts at      measured poses" in out and "--picture" not in out


@pytest.mark.parametrize(
    "id, words",
    [
        ("quadratic_drag", "physical only above 0; allowed is at least 0 N m s2"),
        ("hertzian_contact", "physical only above 1; allowed is above 0, at most 10"),
        ("adhesion", "positive; allowed is above 0 m"),
        ("plate_tilt", "of either sign; allowed is at least -0.2, at most 0.2 rad"),
        ("gyro_scale", "of either sign; allowed is all finite numbers"),
        ("gyro_bandwidth", "of any size; allowed is above 0 Hz"),
        ("uneven_foot_friction", "on either side of 1; allowed is at least 0"),
        ("spin_friction", "0 or more; allowed is at least 0, at most 1"),
        ("dimension_deviation", "1 or less; allowed is at least 0, at most 1"),
    ],
)
def test_sign_and_hard_limits_are_shown(capsys, id, words):
    assert f" {words}\n" in said(capsys, id)[0]


@pytest.mark.parametrize("verb", ["effects", "simulate"])
def test_what_is_not_plausible_is_remarked(capsys, tmp_path, verb):
    """Used all the same, with the range on standard error; from a file, too."""
    more = ["--duration", "0.01"] if verb == "simulate" else []
    for value, remark in (("50", True), ("0.4", False), ("0", False)):
        words = f"quadratic_drag:c={value}"
        code, _, err = command.run(capsys, verb, *(["--effect", words] if verb == "simulate" else [words]), *more)
        assert code == 0
        assert ("c: is 50 N m s2, which is not plausible. Plausible is 0.002 to 5 N m s2" in err) is remark
        assert (err == "") is not remark
    file = tmp_path / "model.toml"
    file.write_text("[effects.rounded_feet]\nradius = 0.03\n", encoding="utf-8")
    _, _, err = command.run(capsys, "simulate", file, "--duration", "0.01")
    assert f"{file}: rounded_feet radius: is 0.03 m" in err


def test_users_own_effect_is_shown(capsys):
    out, _, code = said(capsys, f"{EXAMPLE}:EddyBrake")
    assert code == 0 and "eddy_brake (loads)" in out and "Lenz" in out


def test_picture_is_a_picture(capsys, tmp_path):
    path = tmp_path / "drift.png"
    out, _, code = said(capsys, "gyro_drift", "--picture", str(path), "--duration", "0.01")
    assert code == 0 and f"wrote        {path}" in out
    assert path.read_bytes().startswith(b"\x89PNG")


def test_json_beside_a_picture_is_json_and_nothing_else(capsys, tmp_path):
    path = tmp_path / "drift.svg"
    out, _, code = said(capsys, "gyro_drift", "--picture", str(path), "--duration", "0.01", "--json")
    assert code == 0 and json.loads(out)["id"] == "gyro_drift" and "<svg" in path.read_text(encoding="utf-8")


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
