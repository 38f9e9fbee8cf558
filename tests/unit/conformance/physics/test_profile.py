"""What a profile says: in words, as a page, on the command line."""

import json
import math

import pytest

from rockref import cli
from rockref.conformance.physics import profile as profiles
from rockref.conformance.physics.adapter import Lost
from rockref.conformance.physics.causes import CAUSES, advice
from rockref.conformance.physics.checks import CHECKS
from rockref.conformance.physics.finding import Finding, percent
from rockref.conformance.physics.in_words import text
from rockref.conformance.physics.page import page
from tests.unit.conformance.physics import seeded


def failing(check, cause, seen="it leans"):
    return Finding(check, "fail", "1", "0", "", seen, cause)


@pytest.fixture
def stored(monkeypatch):
    """A profile of an engine whose slides fail by default, of checks that are not run."""

    def found(adapter, setting, progress=None):
        slide = failing("slide", "pyramid_inside", "the box slides 41 % too far along the diagonal")
        rest = Finding("rest", "pass", "0", numbers={"creep slope": 8e-4})
        told = {"slide": slide} if setting == "default" else {}
        return [{"rest": rest, **told}.get(name, Finding(name, "pass", "0")) for name in CHECKS]

    monkeypatch.setattr(profiles, "judge_setting", found)
    adapter = seeded.adapter(None, 1e-3, cone="pyramid")
    adapter.settings["careful"] = {"cone": "round"}
    adapter.knobs = {"pyramid_inside": '<option cone="elliptic"/>'}
    made = profiles.judge_engine(adapter, quick=True)
    impact = {"e": 0.5, "low": 0.4, "high": 0.6, "time": math.nan, "depth": 1e-3}
    return json.loads(json.dumps(made | {"passport": {"stiff": {"knobs": {"k": 1}, "shapes": {"sphere": impact}}}}))


class TestWords:
    def test_settings_stand_side_by_side_with_cause_and_knob(self, stored):
        said = text(stored)
        assert "slide               FAIL          pass" in said
        assert "the box slides 41 % too far along the diagonal" in said
        assert "the friction cone is a pyramid" in said and '<option cone="elliptic"/>' in said
        assert "0.400 - 0.600" in said

    def test_the_page_has_verdict_figures_cause_and_knobs(self, stored):
        said = page([stored], {"other": "not installed"})
        assert "| seeded | default | ✓ | ✓ | ✓ | ✓ | ✓ | **✗** |" in said
        assert "8e-04" in said and '`<option cone="elliptic"/>`' in said
        assert "- *careful*: nothing." in said and "- other: not installed" in said
        assert "| stiff | sphere | 0.500 | 0.400 to 0.600 | – | 1.00 |" in said

    def test_the_careful_setting_decides(self, stored):
        assert not profiles.falls_short(stored)
        del stored["settings"]["careful"]
        assert profiles.falls_short(stored)

    def test_an_unknown_cause_gives_no_advice_and_a_known_one_the_general_cure(self):
        assert advice("", {}) == "" and advice("sleep", {}) == "; ".join(CAUSES["sleep"])

    @pytest.mark.parametrize(
        "ratio, said", [(0.4117, "+41 %"), (-0.0299, "-3.0 %"), (0.005, "+0.50 %"), (0, "+0.000 %")]
    )
    def test_percent(self, ratio, said):
        assert percent(ratio) == said


class TestConsequences:
    def test_what_damping_does_to_sliding_is_told_as_damping(self):
        found = profiles.explained(
            [failing("fall", "damping"), failing("slide", "friction"), failing("slope", "sleep")]
        )
        assert [f.cause for f in found] == ["damping", "damping", "sleep"]
        assert "may follow from what fall found" in found[1].seen

    def test_without_a_fault_of_free_motion_nothing_is_explained_away(self):
        found = [failing("slide", "friction")]
        assert profiles.explained(found) == found

    def test_a_plate_that_does_not_hold_fails_every_check_of_contact(self):
        found = profiles.judge_setting(seeded.free("", ""), "default")
        assert [f.verdict for f in found[:3]] == ["pass", "remark", "pass"]
        assert {(f.verdict, f.cause) for f in found[3:]} == {("fail", "plate")} and len(found) == 13

    def test_an_engine_that_loses_its_numbers_fails_and_the_others_go_on(self, monkeypatch):
        def stops(trial):
            raise Lost("x is not finite")

        monkeypatch.setattr(profiles, "CHECKS", {"echo": stops, "fall": lambda trial: Finding("fall", "pass", "0")})
        found = profiles.judge_setting(seeded.adapter(None, 1e-3), "default")
        assert [(f.verdict, f.cause) for f in found] == [("fail", "lost"), ("pass", "")]


class TestCommand:
    def run(self, capsys, *words):
        with pytest.raises(SystemExit) as end:
            cli.main(["conform", "physics", *map(str, words)])
        return end.value.code or 0, *capsys.readouterr()

    @pytest.mark.parametrize("words, code", [((), "E-ARGUMENT"), (("bulet",), "E-BACKEND")])
    def test_what_cannot_be_judged_ends_with_2(self, capsys, words, code):
        ended, _, err = self.run(capsys, *words)
        assert ended == 2 and code in err

    def test_an_engine_that_is_not_there_is_told_with_the_cure(self, capsys, tmp_path):
        (tmp_path / "far.py").write_text("REQUIRES = 'no_such_engine'\ndef run(*_):\n    pass\n")
        code, _, err = self.run(capsys, tmp_path / "far.py")
        assert code == 2 and "no_such_engine is not installed" in err and "E-ENGINE" in err

    def test_the_example_is_an_adapter(self, capsys, tmp_path):
        assert self.run(capsys, "example", "--output", tmp_path / "mine.py")[0] == 0
        from rockref.conformance.physics.adapter import load

        assert load(str(tmp_path / "mine.py")).name == "My engine"

    def test_a_file_is_judged_printed_and_written(self, capsys, tmp_path, monkeypatch):
        monkeypatch.setattr(profiles, "CHECKS", {name: lambda trial, n=name: failing(n, "soft") for name in CHECKS})
        monkeypatch.setattr(profiles.Trial, "is_held", True)
        (tmp_path / "mine.py").write_text("def run(*_):\n    pass\n")
        words = (tmp_path / "mine.py", "--quick", "--output", tmp_path / "page.md")
        code, out, _ = self.run(capsys, *words)
        assert code == 1 and "FAIL: it leans" in out and "it leans" in (tmp_path / "page.md").read_text()
        code, out, _ = self.run(capsys, *words[:2], "--json")
        assert code == 1 and len(json.loads(out)[0]["settings"]["default"]["findings"]) == 13
