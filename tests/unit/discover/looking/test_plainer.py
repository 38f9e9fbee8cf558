"""Numbers that are typically none stay in a fit only where they gain as much as an effect has to."""

from dataclasses import dataclass

import numpy as np
import pytest

from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.looking.plainer import plainer
from rockref.discover.window_rules import DETECTED
from tests.unit.discover.bowls import Bowl, family


@dataclass
class Held(Bowl):
    """A bowl over a friction, a drag and its force at the centre; what a prior holds does not move."""

    names: tuple[str, ...] = ("mu_ext", "quadratic_drag.c", "quadratic_drag.c_v")
    parameters: tuple[Parameter, ...] = ()

    def __post_init__(self):
        self.parameters = self.parameters or tuple(Parameter(n, None, 0.0, 1.0) for n in self.names)

    def run(self, point, iterations, rng, relative=0.0):
        self.iterations += iterations
        free = np.array([p.prior > 0.1 for p in self.parameters])
        return self.point(np.where(free, self.bottom, point.z), point.corrections)[0]


def drag(force):
    """A family that stands at the bottom of its bowl, with a force at the centre that gains so many units."""
    bottom = np.array([0.2, 0.9, 0.0])
    bowl = Held(bottom)
    bottom[2] = np.sqrt(force / (0.5 * bowl.series.count.sum()))
    return family(("quadratic_drag",), bowl, bottom.copy())


def test_what_gains_little_is_taken_out_and_the_rest_is_fitted_again():
    found = drag(0.9 * DETECTED)
    found.point.z[0] = 0.5
    without = plainer(found, seed=0)
    assert without.point.z == pytest.approx([0.2, 0.9, 0.0])
    # The family that is gone on with is free to move the number again, and its interval is that of a free one.
    assert without.fit is found.fit and all(p.prior == 1.0 for p in without.fit.parameters)


def test_what_gains_as_much_as_an_effect_stays():
    found = drag(1.1 * DETECTED)
    assert plainer(found, seed=0) is found


def test_radii_of_feet_that_gain_little_become_alike_again():
    """Factors that shape an effect are typically one: they are held as what is typically none is."""
    names = ("mu_ext", "rounded_feet.radius", "rounded_feet.foot3")
    bottom = np.array([0.2, 0.9, 0.0])
    bowl = Held(bottom, names=names)
    bottom[2] = np.sqrt(0.9 * DETECTED / (0.5 * bowl.series.count.sum()))
    found = family(("rounded_feet",), bowl, bottom.copy())
    assert plainer(found, seed=0).point.z == pytest.approx([0.2, 0.9, 0.0])


def test_what_is_none_costs_nothing():
    found = drag(0.0)
    assert plainer(found, seed=0) is found and found.fit.iterations == 0
