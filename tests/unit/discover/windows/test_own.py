"""Windows with a user's own effect, by the law's text: the same residuals as by the compiled step."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from rockref import InputError, Model
from rockref.discover.fit.approach import placed
from rockref.discover.fit.search import Setup
from rockref.discover.looking.look import candidates_beside
from rockref.discover.looking.screen import screen
from rockref.discover.plan import GYRO, Release, campaign, recorded
from rockref.discover.windows.own import known_own
from rockref.discover.windows.series import Series, series
from rockref.effects import catalogue
from rockref.effects.prior import Prior

#: A user's class that does what `quadratic_drag` does, so that there is something to be held to.
OWN = """
from dataclasses import dataclass
from rockref.effects.base import Effect, Quantity
from rockref.effects.loads.quadratic_drag import QuadraticDrag

@dataclass(frozen=True)
class Mine(Effect):
    id = "mine"
    quantities = {"c": Quantity("N m s2", 0.0, 0.1, 10.0, 0.4, "+", "drag", 0.0)}
    c: float = 0.0

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        return QuadraticDrag(self.c).body_wrench(problem, c, x, Lambda, v, W, m)

@dataclass(frozen=True)
class Shown(Effect):
    id = "shown"
    quantities = {"c": Quantity("rad/s", 0.0, 0.1, 10.0, 0.4)}
    c: float = 0.0

    def sensor(self, t, crv):
        return crv + self.c
"""
TABLE, TILT = Model.table_3_1(), 0.117


@cache
def two_runs() -> Series:
    """Short windows of two runs, one of them turned."""
    runs = tuple(recorded(TABLE, Release(TILT, turned), GYRO, seed, 0.75) for seed, turned in enumerate((False, True)))
    return series(campaign(TABLE, runs[0], GYRO, 0.0014), runs, 0.02, 0.05, 0.75, workers=1)


@pytest.fixture
def own(tmp_path, monkeypatch):
    monkeypatch.setattr(catalogue, "OWN", {})
    (tmp_path / "mine.py").write_text(OWN, encoding="utf-8")
    return lambda name: catalogue.named(f"{tmp_path / 'mine.py'}:{name}")


def other_phase(model: Model) -> Model:
    """The model as it is in another run: a floor that shakes does so with another phase."""
    shaken = [replace(e, phase=1.0) if e.id == "base_vibration" else e for e in model.effects]
    return model.replace(effects=tuple(shaken))


@pytest.mark.parametrize("words", [[], ["cable_restraint"], ["spin_friction", "compliant_support", "base_vibration"]])
def test_own_effects_are_stepped_as_the_compiled_ones_are(own, words):
    windows = two_runs()
    later = np.flatnonzero(windows.start > 0)[::2]  # those from the release last half a second
    corrections = np.random.default_rng(1).normal(size=(len(later), 5)) * 1e-5
    others = [catalogue.parse(word) for word in words]
    found = []
    for effect in (catalogue.EFFECTS["quadratic_drag"](0.4), own("Mine")(0.4)):
        model = TABLE.replace(effects=catalogue.in_step_order([effect, *others]))
        models = [model, other_phase(model)]
        found.append(windows.residual(models, np.array([TILT, TILT]), corrections, which=later))
    # The compiled step adds moments in another order: some last digits, in units of the noise.
    np.testing.assert_allclose(found[1], found[0], atol=1e-7)
    assert np.abs(found[0]).max() > 1


def test_own_effects_of_the_sensor_are_not_fitted(own):
    model = TABLE.replace(effects=(own("Shown")(0.1),))
    with pytest.raises(InputError, match="effect shown: acts on the sensor"):
        two_runs().residual([model, model], np.array([TILT, TILT]), np.zeros((two_runs().B, 5)))


def test_a_diagnosis_tries_it_beside_the_catalogue(own, monkeypatch):
    """The screen gives a class that does what drag does the gain of drag, on runs that were dragged."""
    # Of the catalogue's drag the moment alone: the user's class has no force.
    drag = catalogue.find("quadratic_drag")
    monkeypatch.setattr(drag, "priors", {"c_v": Prior("fixed")})
    none = drag.quantities["c_v"]._replace(typical=0.0)
    monkeypatch.setattr(drag, "quantities", drag.quantities | {"c_v": none})
    dragged = TABLE.replace(effects=(drag(5.0),))
    # A small tilt is an early impact, and so a short first window: each evaluation steps all of it.
    run = recorded(dragged, Release(0.03, False), GYRO, 1, 0.45)
    experiment = campaign(TABLE, run, GYRO, 0.0014)
    mine = own("Mine")
    setup = Setup(experiment, (run,), TABLE, 0.45, workers=1, own=(mine.id,))
    assert mine in candidates_beside(setup, ()) and mine not in candidates_beside(setup, (mine.id,))
    fit = setup.fit(series(experiment, (run,), 0.02, 0.04, 0.45, workers=1))
    start = placed(fit, np.zeros(len(fit.parameters)))
    first, second = screen(fit, start, (drag, mine), setup)
    assert {first.effects, second.effects} == {("quadratic_drag",), ("mine",)}
    assert first.gain > 20
    # Both take the same step; their residuals agree to the rounding of a step, here some 1e-9 of the noise.
    assert second.gain == pytest.approx(first.gain, rel=1e-6)


def test_what_a_diagnosis_cannot_try_is_refused(own, tmp_path):
    path = tmp_path / "mine.py"
    assert known_own((f"{path}:Mine",)) == ("mine",)
    with pytest.raises(InputError, match="acts on the sensor"):
        known_own((f"{path}:Shown",))
    with pytest.raises(InputError, match="in the catalogue"):
        known_own(("quadratic_drag",))
    with pytest.raises(InputError, match="given twice"):
        known_own((f"{path}:Mine", f"{path}:Mine"))
    with pytest.raises(InputError, match="other.py"):
        known_own((f"{tmp_path / 'other.py'}:Mine",))
