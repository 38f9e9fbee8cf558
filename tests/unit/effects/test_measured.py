"""The order in which effects act, and the channel from the block's rates to the samples, by hand."""

from dataclasses import dataclass

import numpy as np
import pytest

from rockref.effects.base import Effect, Quantity
from rockref.effects.catalogue import EFFECTS, OF_TOSSES, analogue, brought_in, digital, in_step_order, make, measured
from tests.refusal import refusal

T = np.arange(40) / 100
CRV = np.outer(T, (1.0, 2.0, -1.0))


@dataclass(frozen=True)
class Offset(Effect):
    """A user's own: it adds the time and a number to every rate."""

    id = "offset"
    quantities = {"b": Quantity("rad/s", 0.0, 0.1, 1.0, 0.5), "unused": Quantity("1", 1.0, 0.0, 2.0, 1.5)}
    switches = ("b",)
    b: float = 0.0
    unused: float = 1.0

    def sensor(self, t, crv):
        return crv + self.b + t[:, None]


def test_effects_act_in_the_order_of_the_step_and_those_of_tosses_and_of_the_user_after_them():
    given = ["clock_error", "tag_frame", "gyro_scale", "adhesion", "foot_defects"]
    kinds = EFFECTS | OF_TOSSES
    ordered = in_step_order(iter([Offset(0.1), *(kinds[id]() for id in given)]))
    assert [e.id for e in ordered] == ["foot_defects", "adhesion", "gyro_scale", "clock_error", "tag_frame", "offset"]
    assert in_step_order([]) == ()
    said = ("E-EFFECT", "effect adhesion", "is given twice", "Give it once, with all its parameters.")
    assert refusal(in_step_order, [EFFECTS["adhesion"](1.0), Offset(), EFFECTS["adhesion"](2.0)]) == said


def rates(crv):
    """The rates about the first axis [rad/s]."""
    return crv[:, 0]


def test_the_channel_scales_filters_adds_asks_the_clock_and_cuts():
    """Twice the rate, less a tenth of it by the data sheet, plus the user's time and bias, at half the time, cut."""
    chain = [
        EFFECTS["gyro_saturation"](0.9), EFFECTS["clock_error"](0.5), Offset(0.5), EFFECTS["gyro_scale"](2.0, 1.0, 1.0),
    ]  # fmt: skip
    seen = []

    def low_pass(crv):
        seen.append(crv)
        return 0.9 * crv

    found = analogue(iter(chain), T, CRV, low_pass)
    assert np.array_equal(rates(seen[0]), 2 * T)
    # A cubic through points on a line, at half the time.
    assert rates(found) == pytest.approx(0.9 * 2 * T / 2 + 0.5 + T / 2, abs=1e-12)
    assert np.array_equal(digital(iter(chain), T, found), np.clip(found, -0.9, 0.9)) and found.max() > 0.9
    # Without a data sheet the same, but for its tenth.
    assert rates(measured(iter(chain), T, CRV)) == pytest.approx(np.minimum(3 * T / 2 + 0.5, 0.9), abs=1e-12)
    assert measured([EFFECTS["adhesion"](1.0)], T, CRV) is CRV


@pytest.mark.parametrize("place", ["gyro_misalignment", "gyro_drift", "clock_error", "gyro_saturation"])
def test_whatever_stands_in_the_channel_is_given_the_instants_of_the_rows(place):
    @dataclass(frozen=True)
    class Stamp(Offset):
        id, stage = place, EFFECTS[place].stage

    assert np.array_equal(rates(measured([Stamp(0.25)], T, CRV)), T + 0.25 + T)


def test_an_effect_is_made_of_its_parameters_and_a_strange_one_is_told():
    effect = make(Offset, {"b": 2}, "here")
    assert effect == Offset(2.0) and isinstance(effect.b, float)
    said = ("E-KEY", "here", "offset has no parameter 'Unuse'", "Did you mean 'unused'?")
    assert refusal(make, Offset, {"b": 1.0, "Unuse": 1.0}, "here") == said
    said = ("E-KEY", "here", "offset has no parameter 'gain'", "It has b, unused.")
    assert refusal(make, Offset, {"gain": 1.0}, "here") == said
    said = ("E-KEY", "here", "none has no parameter 'c'", "It has none.")
    assert refusal(make, Effect, {"c": 1.0}, "here") == said
    code, where, *_ = refusal(make, Offset, {"b": "1"}, "here")
    assert (code, where) == ("E-TYPE", "here: offset b")


def test_who_names_an_effect_wants_it_there():
    """Typical where nothing is given that brings it in; what is given holds."""
    assert brought_in(Offset, {}, "here") == Offset(0.5, 1.5)
    assert brought_in(Offset, {"unused": 0.25}, "here") == Offset(0.5, 0.25)
    assert brought_in(Offset, {"b": 0.0}, "here") == Offset(0.0, 1.0)
    scale = EFFECTS["gyro_scale"]
    assert brought_in(scale, {"x": 1.5}, "here") == scale(1.5) and brought_in(scale, {}, "here") == scale.typical()
    for given in ({"b": None}, {"unused": None}):
        code, where, *_ = refusal(brought_in, Offset, given, "here")
        assert (code, where) == ("E-TYPE", f"here: offset {list(given)[0]}")
