"""A user's own effect: the example works everywhere, and the mistakes of its author are explained to him."""

from pathlib import Path

import numpy as np
import pytest

from rockref import InputError, Model, simulate
from rockref.effects import catalogue
from rockref.effects.probe import probe_absent, sample_problem
from rockref.effects.scale import prior_of
from rockref.effects.user import load_user
from rockref.model.integrator import evaluate_contact
from tests.command import run
from tests.refusal import refused

EXAMPLE = Path(__file__).resolve().parents[3] / "examples/my_effect.py"
HEAD = """
from dataclasses import dataclass, replace
import numpy as np
from rockref.effects.base import Effect, Quantity

@dataclass(frozen=True)
class Mine(Effect):
    id = "mine"
    quantities = {"c": Quantity("N", 0.0, 0.1, 10.0, 1.0)}
    c: float = 0.0
"""
HOOK = "    def sensor(self, t, crv):\n        return crv + self.c\n"


def written(tmp_path, text, head=HEAD):
    path = tmp_path / "mine.py"
    path.write_text(head + text, encoding="utf-8")
    return f"{path}:Mine"


def test_the_example_is_a_page_and_brakes_the_block():
    effect = catalogue.parse(f"{EXAMPLE}:EddyBrake:c=0.05")
    assert len(EXAMPLE.read_text().splitlines()) < 45
    model = Model.table_3_1()
    plain = simulate(model, duration=0.01, engine="numpy")
    braked = simulate(model.replace(effects=(effect,)), duration=0.01)
    assert 0 < braked.W[-1, 0] < plain.W[-1, 0]
    absent = simulate(model.problem(duration=0.01).replace(effects=(type(effect)(),)), engine="numpy")
    assert np.array_equal(absent.W, plain.W)


def test_the_example_goes_through_a_model_file(tmp_path):
    effect = catalogue.parse(f"{EXAMPLE}:EddyBrake")
    Model.table_3_1().replace(effects=(effect,)).save(tmp_path / "model.toml")
    (back,) = Model.load(tmp_path / "model.toml").effects
    assert back.values() == effect.values() and back.id == "eddy_brake"


def test_a_model_file_names_it_from_where_it_lies(tmp_path, monkeypatch):
    """Beside the model file first, then in the current folder; it is written as it is found from the file's folder."""
    (tmp_path / "a/b").mkdir(parents=True)
    (tmp_path / "mine.py").write_text(HEAD + HOOK, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    Model.table_3_1().replace(effects=(catalogue.parse("mine.py:Mine:c=2"),)).save("a/b/model.toml")
    text = Path("a/b/model.toml").read_text(encoding="utf-8")
    assert 'file = "../../mine.py:Mine"' in text
    monkeypatch.chdir(tmp_path / "a")
    model = Model.load("b/model.toml")
    assert model.effects[0].values() == {"c": 2.0}
    model.save("b/again.toml")
    assert Path("b/again.toml").read_text(encoding="utf-8") == text
    Path("b/model.toml").write_text('[effects.mine]\nfile = "../mine.py:Mine"\n', encoding="utf-8")
    assert Model.load("b/model.toml").effects[0].values() == {"c": 1.0}


@pytest.mark.parametrize(
    "value, said",
    [
        ("3", "file: is 3. Write file = "),
        ('"mine.py"', "names a file, but no class in it"),
        ('"nobody.py:Mine"', "nobody.py', which is no file"),
    ],
)
def test_a_model_file_that_names_no_file_is_explained(tmp_path, value, said):
    # In a folder of a long name, too, the message ends with the file's own.
    folder = tmp_path / ("deep" * 30)
    folder.mkdir()
    (folder / "model.toml").write_text(f"[effects.mine]\nfile = {value}\n", encoding="utf-8")
    error = refused(Model.load, folder / "model.toml")
    assert said in str(error)


MISTAKES = {
    "force of one number": (
        "    def body_wrench(self, problem, c, x, Lambda, v, W, m):\n        return -self.c, np.zeros_like(x)\n",
        "body_wrench: force has shape (), the law's has (3,)",
    ),
    "force per component, batch forgotten": (
        "    def body_wrench(self, problem, c, x, Lambda, v, W, m):\n"
        "        return np.array([0, -self.c * v[1], 0]), np.zeros_like(x)\n",
        "Leading axes are runs side by side",
    ),
    "only a force": (
        "    def body_wrench(self, problem, c, x, Lambda, v, W, m):\n        return -self.c * v\n",
        "Return two things",
    ),
    "not a number": (
        "    def body_wrench(self, problem, c, x, Lambda, v, W, m):\n"
        "        return -self.c * v / np.sqrt(v @ v if v.ndim == 1 else 0.0), np.zeros_like(x)\n",
        "force holds a number that is not finite",
    ),
    "fails inside": (
        "    def body_wrench(self, problem, c, x, Lambda, v, W, m):\n        return v * self.d, x\n",
        "AttributeError: 'Mine' object has no attribute 'd'",
    ),
    "misspelt hook": (
        "    def body_wrenhc(self, problem, c, x, Lambda, v, W, m):\n        return x, x\n",
        "'body_wrench'",
    ),
    "too few arguments": (
        "    def body_wrench(self, x, v):\n        return x, x\n",
        "Write def body_wrench(self, problem",
    ),
    "arguments in another order": (
        "    def body_wrench(self, problem, c, v, x, Lambda, W, m):\n        return -self.c * v, np.zeros_like(x)\n",
        "v is not in its place. Write def body_wrench(self, problem, c, x, Lambda, v, W, m)",
    ),
    "a word for a force": (
        "    def body_wrench(self, problem, c, x, Lambda, v, W, m):\n        return 'strong', np.zeros_like(x)\n",
        "force is str",
    ),
    "ends the program": ("    def sensor(self, t, crv):\n        raise SystemExit(3)\n", "SystemExit: 3"),
    "no hook": ("", "changes nothing"),
    "wrong normal force": (
        "    def normal_force(self, F, k, points, m):\n        return F.sum(axis=-1)\n",
        "normal_force: F has shape (), the law's has (8,)",
    ),
    "one friction coefficient": (
        "    def friction_coefficient(self, mu_0, mu, F_N, k, points, m):\n        return mu\n",
        "friction_coefficient",
    ),
    "memory without batch": (
        "    def start(self, problem):\n        return {'turned': np.zeros(8)}\n"
        "    def body_wrench(self, problem, c, x, Lambda, v, W, m):\n        return x, x\n",
        "memory 'turned' has shape (8,) for a batch of shape (2,)",
    ),
    "start without dict": ("    def start(self, problem):\n        return 0.0\n", "Return a dict of arrays"),
    "points forgotten": ("    def points(self, block, points):\n        return points\n", "Return two things"),
    "points lost": (
        "    def points(self, block, points):\n        return block, replace(points, K_N=points.K_N[:4])\n",
        "points: K_N has shape (4,), the law's has (8,)",
    ),
    "radius of a foot, not of a point": (
        "    def points(self, block, points):\n        return block, replace(points, radius=np.full(4, self.c))\n",
        "points: radius has shape (4,), the law's has (8,)",
    ),
    "names lost": (
        "    def points(self, block, points):\n        return block, replace(points, names=points.names[:5])\n",
        "Give each of the 8 points a name",
    ),
    "gravity lost": (
        "    def points(self, block, points):\n        return replace(block, g=block.g / (1 - self.c)), points\n",
        "points: g holds a number that is not finite",
    ),
    "release lost": ("    def release(self, block, points, state):\n        pass\n", "Return dataclasses.replace"),
    "sensor of one axis": ("    def sensor(self, t, crv):\n        return crv[:, 0]\n", "sensor: crv has shape (50,)"),
    "plate": ("    def plate_motion(self, t, m):\n        return 0.0\n", "plate_motion: gives back float"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistakes_in_hooks_are_explained(tmp_path, mistake):
    text, said = MISTAKES[mistake]
    error = refused(load_user, written(tmp_path, text))
    assert error.code == "E-EFFECT"
    assert said in str(error)
    assert "mine.py" in str(error)


HEADS = {
    "no unit": (HEAD.replace('"N", 0.0', '"", 0.0'), "parameter 'c' has no unit"),
    "no quantity": (HEAD.replace('"c": Quantity', '"k": Quantity'), "parameter 'c' has no quantity"),
    "quantity too many": (
        HEAD.replace("1.0)}", '1.0), "k": Quantity("m", 0.0, 1.0, 2.0, 1.5)}'),
        "belongs to no parameter",
    ),
    "quantity no Quantity": (HEAD.replace('Quantity("N", 0.0, 0.1, 10.0, 1.0)', '"N"'), "quantity 'c' is 'N'"),
    "no dataclass": (HEAD.replace("@dataclass(frozen=True)\n", ""), "is not a dataclass"),
    "no id": (HEAD.replace('    id = "mine"\n', ""), "has the id 'none'"),
    "no default": (HEAD.replace("c: float = 0.0", "c: float"), "cannot be made without parameters"),
    "present by default": (HEAD.replace("c: float = 0.0", "c: float = 1.0"), "is not absent by default"),
    "hides a name": (
        HEAD.replace("c: float", "source: float").replace('"c"', '"source"'),
        "hides what every effect has",
    ),
    "no Effect": (HEAD.replace("class Mine(Effect)", "class Mine"), "is not an Effect"),
    "other class": (HEAD.replace("class Mine", "class Yours"), "It has Yours"),
    "id of tosses taken": (HEAD.replace('"mine"', '"tag_frame"'), "that of a built-in effect"),
    "id no text": (HEAD.replace('"mine"', "3"), "has the id 3"),
    "no parameter": (
        HEAD.replace('{"c": Quantity("N", 0.0, 0.1, 10.0, 1.0)}', "{}").replace("    c: float = 0.0\n", ""),
        "has no parameter",
    ),
    "quantities no dict": (HEAD.replace('{"c": Quantity("N", 0.0, 0.1, 10.0, 1.0)}', "[]"), "that are no dict"),
    "no range": (HEAD.replace("0.1, 10.0", "None, 10.0"), "parameter 'c' has low = None"),
    "typical is nothing": (HEAD.replace("10.0, 1.0", "10.0, 0.0"), "is absent at its typical size"),
    "switch unknown": (HEAD.replace('    id = "mine"', '    id = "mine"\n    switches = ("d",)'), "switch 'd' is no"),
    "id taken": (HEAD.replace('"mine"', '"plate_tilt"'), "that of a built-in effect"),
}


@pytest.mark.parametrize("mistake", HEADS)
def test_mistakes_in_the_class_are_explained(tmp_path, mistake):
    head, said = HEADS[mistake]
    error = refused(load_user, written(tmp_path, HOOK, head), taken=catalogue.EFFECTS | catalogue.OF_TOSSES)
    assert error.code == "E-EFFECT"
    assert said in str(error)


@pytest.mark.parametrize(
    "text, said",
    [
        ("this is no python", "line 1"),
        (HEAD.replace("(frozen=True)", ""), "non-frozen"),
        ("import numpy\n1/0", "line 2: fails when it is run: ZeroDivisionError"),
        ("import sys\n\nsys.exit(0)", "line 3: ends the program when it is run"),
        (HEAD.replace('"N", 0.0, 0.1, 10.0, 1.0', '"N", 0.0'), "line 9: fails when it is run: TypeError"),
        (HEAD.replace('"N", 0.0, 0.1, 10.0, 1.0', "absent=0.0, low=0.1, high=10.0, typical=1.0"), "the unit first"),
        (HEAD.replace("c: float = 0.0", "c: list = []"), "line 6: fails when it is run: ValueError: mutable default"),
    ],
)
def test_a_file_that_does_not_run_is_explained(tmp_path, text, said):
    error = refused(load_user, written(tmp_path, text, ""))
    assert error.code == "E-FILE"
    assert said in str(error)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        load_user(f"{tmp_path}/nobody.py:Mine")
    with pytest.raises(InputError, match="names no class in a file"):
        load_user("mine.txt:Mine")
    for words in (f"{EXAMPLE}", "mine.py"):
        with pytest.raises(InputError, match=r"Write .*\.py:(Class|EddyBrake)"):
            catalogue.parse(words)


LATER = {
    "fails": ("        if c.t > 2e-4:\n            raise KeyError('speed')\n", r", line 14: fails: KeyError: 'speed'"),
    "not finite": (
        "        if c.t > 2e-4:\n            force = force / 0\n",
        "force holds a number that is not finite",
    ),
    "another shape": (
        "        if c.t > 2e-4:\n            force = force[:2]\n",
        "force has shape (2,), the law's has (3,)",
    ),
    "nothing": ("        if c.t > 2e-4:\n            return force\n", "gives back ndarray"),
}


@pytest.mark.parametrize("mistake", LATER)
def test_mistakes_that_show_in_the_run_name_the_hook(tmp_path, capsys, mistake):
    """What is right when it is tried, and wrong later: exit code 2, file, class and hook, and no traceback."""
    lines, said = LATER[mistake]
    begin = "    def body_wrench(self, problem, c, x, Lambda, v, W, m):\n        force = -self.c * (v + 1.0)\n"
    spec = written(tmp_path, begin + lines + "        return force, np.zeros_like(x)\n")
    code, _, err = run(capsys, "simulate", "--duration", "0.001", "--effect", spec)
    assert code == 2
    assert f"{spec}.body_wrench" in err and said in err and "Traceback" not in err


def test_numbers_that_were_lost_before_are_no_mistake_of_the_hook(tmp_path):
    """A run that blows up, as one of many in a search may, is the engine's to tell."""
    kind = load_user(written(tmp_path, HOOK))
    lost = np.full((7, 3), np.nan)
    assert np.all(np.isnan(kind(1.0).sensor(np.arange(7.0), lost)))
    with pytest.raises(InputError, match="not finite"):
        kind(1e308).sensor(np.arange(7.0), np.full((7, 3), 1e308))


def test_a_time_for_each_run_wants_arrays(tmp_path):
    """math's functions take one number: the author is told what to write."""
    text = (
        "    def body_wrench(self, problem, c, x, Lambda, v, W, m):\n        import math\n"
        "        return self.c * math.exp(-c.t) * v, np.zeros_like(x)\n"
    )
    kind = load_user(written(tmp_path, text))
    problem = sample_problem()
    c = evaluate_contact(
        problem, problem.start, *(getattr(problem.start, k) for k in ("x", "Lambda", "v", "W")), 0, 0, ()
    )
    with pytest.raises(InputError, match=r"line 13: fails: TypeError.*Use np\.exp"):
        kind(1.0).body_wrench(problem, c._replace(t=np.zeros(2)), *(np.zeros(3),) * 4, {})


WITH_PRIOR = "from rockref.effects.prior import Prior\n" + HEAD
FITS = {
    "stage": ('    stage = "Sensor"\n', "has the stage 'Sensor'"),
    "prior of nobody": ('    priors = {"d": Prior("shape")}\n', "names 'd', which is no parameter"),
    "seed of nobody": ('    seeds = ({"d": 1.0},)\n', "names 'd', which is no parameter"),
    "one of a run": ('    of_run = ("c",)\n', r"of_run is \('c',\)"),
    "role": ('    priors = {"c": Prior("sizes")}\n', r"the prior of 'c' is Prior\(role='sizes'"),
    "scale": ('    priors = {"c": Prior(scale="cubic")}\n', "the prior of 'c' is Prior.role='', scale='cubic'"),
    "no prior": ('    priors = {"c": 0.5}\n', "the prior of 'c' is 0.5"),
    "no spread": ('    priors = {"c": Prior(spread=0.0)}\n', "a fit cannot count 'c': its spread is 0"),
    "log of nothing": ('    priors = {"c": Prior(scale="log")}\n', "a fit cannot count 'c'"),
    "log about nothing": ('    priors = {"c": Prior(scale="log", spread=0.5)}\n', "a fit cannot count 'c'"),
    "seed that is none": ('    seeds = ({"c": float("nan")},)\n', "seeds: mine c: is nan"),
}


@pytest.mark.parametrize("mistake", FITS)
def test_what_no_fit_could_use_is_explained(tmp_path, mistake):
    line, said = FITS[mistake]
    with pytest.raises(InputError, match=said):
        load_user(written(tmp_path, HOOK, WITH_PRIOR + line))


def test_what_a_fit_needs_is_taken(tmp_path):
    lines = '    stage = "clock"\n    priors = {"c": Prior(spread=2.0)}\n    seeds = ({"c": 3.0},)\n'
    kind = load_user(written(tmp_path, HOOK, WITH_PRIOR + lines))
    assert prior_of(kind, "c").spread == 2.0 and kind.seeds == ({"c": 3.0},) and kind.stage == "clock"


def test_hooks_of_a_class_between_are_guarded(tmp_path):
    """A class that inherits its hook from another one of the author's."""
    between = HOOK.replace("crv + self.c", "crv[:1] if len(t) == 7 else crv + self.c")
    text = between + "\n@dataclass(frozen=True)\nclass Yours(Mine):\n    id = 'yours'\n"
    kind = load_user(written(tmp_path, text).replace(":Mine", ":Yours"))
    with pytest.raises(InputError, match=r"mine\.py:Yours\.sensor: crv has shape \(1, 3\)"):
        kind(1.0).sensor(np.arange(7.0), np.zeros((7, 3)))


PRESENT = {
    "a force of its own": (
        "    def body_wrench(self, problem, c, x, Lambda, v, W, m):\n        return 1.0 + 0 * x, np.zeros_like(x)\n",
        "body_wrench",
    ),
    "a factor without one": (
        "    def normal_force(self, F, k, points, m):\n        return F * self.c\n",
        "normal_force",
    ),
    "half the friction": (
        "    def friction_coefficient(self, mu_0, mu, F_N, k, points, m):\n        return mu_0, mu * (0.5 + self.c)\n",
        "friction_coefficient",
    ),
    "another body": (
        "    def points(self, block, points):\n        return replace(block, mass=block.mass * 1.1), points\n",
        "points",
    ),
    "a push": (
        "    def release(self, block, points, state):\n        return replace(state, v=state.v + 0.1)\n",
        "release",
    ),
    "a plate that moves": (
        "    def start(self, problem):\n        return {'q': np.zeros_like(problem.start.x)}\n"
        "    def plate_motion(self, t, m):\n        return m['q'] + 1e-6, m['q']\n",
        "plate_motion",
    ),
    "a bias": ("    def sensor(self, t, crv):\n        return crv + 1e-3\n", "sensor"),
}


@pytest.mark.parametrize("mistake", PRESENT)
def test_what_is_there_while_it_is_absent_is_explained(tmp_path, mistake):
    """Models drop an absent effect: one that acts there would jump when its number leaves the absent value."""
    text, hook = PRESENT[mistake]
    with pytest.raises(InputError, match=rf"{hook}: changes something where the effect is absent \(c=0\)") as found:
        load_user(written(tmp_path, text))
    assert found.value.code == "E-EFFECT"


def test_what_rounds_or_cannot_be_computed_while_absent_is_no_mistake(tmp_path):
    """0/0 at the absent value is never met, and a power of one may round."""
    divided = "    def normal_force(self, F, k, points, m):\n        return F * (np.sin(self.c) / self.c) ** 2\n"
    assert load_user(written(tmp_path, divided))().is_absent()
    rounded = "    def normal_force(self, F, k, points, m):\n        return (F / 3.7e5 + self.c) * 3.7e5\n"
    assert load_user(written(tmp_path, rounded))().is_absent()


@pytest.mark.parametrize("kind", catalogue.IN_STEP_ORDER, ids=lambda kind: kind.id)
def test_the_built_in_ones_change_nothing_while_absent(kind):
    probe_absent(kind(), kind.id)


def test_a_good_one_passes(tmp_path):
    kind = load_user(written(tmp_path, HOOK), taken=catalogue.EFFECTS | catalogue.OF_TOSSES)
    assert kind.typical().values() == {"c": 1.0}
    assert np.all(catalogue.measured([kind(0.5)], np.arange(3.0), np.zeros((3, 3))) == 0.5)
