"""A user's own effect: the example works everywhere, and the mistakes of its author are explained to him."""

from pathlib import Path

import numpy as np
import pytest

from rockref import InputError, Model, simulate
from rockref.effects import catalogue
from rockref.effects.user import load_user

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
    "release lost": ("    def release(self, block, points, state):\n        pass\n", "Return dataclasses.replace"),
    "sensor of one axis": ("    def sensor(self, t, crv):\n        return crv[:, 0]\n", "sensor: crv has shape (50,)"),
    "plate": ("    def plate_motion(self, t, m):\n        return 0.0\n", "plate_motion: gives back float"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistakes_in_hooks_are_explained(tmp_path, mistake):
    text, said = MISTAKES[mistake]
    with pytest.raises(InputError) as found:
        load_user(written(tmp_path, text))
    assert found.value.code == "E-EFFECT"
    assert said in str(found.value)
    assert "mine.py" in str(found.value)


HOOK = "    def sensor(self, t, crv):\n        return crv + self.c\n"
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
    "id taken": (HEAD.replace('"mine"', '"plate_tilt"'), "that of a built-in effect"),
}


@pytest.mark.parametrize("mistake", HEADS)
def test_mistakes_in_the_class_are_explained(tmp_path, mistake):
    head, said = HEADS[mistake]
    with pytest.raises(InputError) as found:
        load_user(written(tmp_path, HOOK, head), taken=catalogue.EFFECTS)
    assert found.value.code == "E-EFFECT"
    assert said in str(found.value)


@pytest.mark.parametrize(
    "text, said",
    [
        ("this is no python", "line 1"),
        (HEAD.replace("(frozen=True)", ""), "non-frozen"),
        ("import numpy\n1/0", "line 2: fails when it is run: ZeroDivisionError"),
    ],
)
def test_a_file_that_does_not_run_is_explained(tmp_path, text, said):
    with pytest.raises(InputError) as found:
        load_user(written(tmp_path, text, ""))
    assert found.value.code == "E-FILE"
    assert said in str(found.value)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        load_user(f"{tmp_path}/nobody.py:Mine")
    with pytest.raises(InputError, match="names no class in a file"):
        load_user("mine.txt:Mine")


def test_a_good_one_passes(tmp_path):
    kind = load_user(written(tmp_path, HOOK), taken=catalogue.EFFECTS)
    assert kind.typical().values() == {"c": 1.0}
    assert np.all(catalogue.measured([kind(0.5)], np.arange(3.0), np.zeros((3, 3))) == 0.5)
