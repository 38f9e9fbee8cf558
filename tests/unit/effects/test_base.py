"""What every effect has: values, absence, limits, and the words in which they are refused."""

import math
from dataclasses import FrozenInstanceError, dataclass

import pytest

from rockref import InputError
from rockref.effects.base import POSITIVE, Effect, Quantity, implausible, in_json, limits
from rockref.effects.nothing_added import nothing


@dataclass(frozen=True)
class Breeze(Effect):
    """An effect with a parameter of every make."""

    id = "breeze"
    quantities = {
        "height": Quantity("m", None, 0.5, 2.0, None, least=-1.0),
        "force": Quantity("N", 0.0, 1.0, 5.0, 2.0, "+", "push", 0.0, 100.0),
        "share": Quantity("1", 1.0, 0.5, 2.0, 1.5, "any", "share of it", POSITIVE),
    }
    height: float | None = None
    force: float = 0.0
    share: float = 1.0


@dataclass(frozen=True)
class Gust(Breeze):
    """The same, which its force alone brings in."""

    switches = ("force",)


def refusal(effect):
    """The error with which the values of an effect are refused."""
    with pytest.raises(InputError) as found:
        effect.check("model.toml")
    return found.value


def test_values_are_the_parameters_by_name():
    assert Breeze(0.7, 2.0).values() == {"height": 0.7, "force": 2.0, "share": 1.0}
    assert Breeze.typical() == Breeze(None, 2.0, 1.5)


def test_an_effect_is_absent_where_all_that_brings_it_in_is():
    assert Breeze().is_absent()
    assert not any(effect.is_absent() for effect in (Breeze(0.7), Breeze(force=2.0), Breeze(share=0.5)))
    assert Gust(0.7, 0.0, 0.5).is_absent() and not Gust(force=2.0).is_absent()


@pytest.mark.parametrize("force", [0, 0.0, 1e-300, 3, 100.0])
def test_a_number_within_its_limits_is_taken(force):
    Breeze(0.7, force, 0.1).check("here")
    Breeze(None, force).check("here")
    Breeze(-1.0, force).check("here")


FORCE = "Give a number of at least 0 N and of at most 100 N; plausible is 1 to 5 N."


@pytest.mark.parametrize(
    "effect, place, what, cure",
    [
        (Breeze(force="2"), "force", "is '2'", "Give a number, in N."),
        (Breeze(force=True), "force", "is True", "Give a number, in N."),
        (Breeze(force=None), "force", "is None", "Give a number, in N."),
        (Breeze(force=math.nan), "force", "is nan", "Give a number, in N."),
        (Breeze(share=[1.0]), "share", "is [1.0]", "Give a number."),
        (Breeze(height="top"), "height", "is 'top'", "Give a number, in m."),
        (Breeze(force=-1), "force", "is -1.0 N", FORCE),
        (Breeze(force=100.5), "force", "is 100.5 N", FORCE),
        (Breeze(force=10**400), "force", "is inf N", FORCE),
        (Breeze(force=-(10**5000)), "force", "is -inf N", FORCE),
        (Breeze(force=math.inf), "force", "is inf N", FORCE),
        (Breeze(share=0.0), "share", "is 0.0", "Give a number above 0; plausible is 0.5 to 2."),
        (Breeze(share=math.inf), "share", "is inf", "Give a number above 0; plausible is 0.5 to 2."),
        (Breeze(height=-1.5), "height", "is -1.5 m", "Give a number of at least -1 m; plausible is 0.5 to 2 m."),
        (Breeze(height=-math.inf), "height", "is -inf m", "Give a number of at least -1 m; plausible is 0.5 to 2 m."),
    ],
)
def test_what_is_no_number_or_beyond_its_limits_is_refused(effect, place, what, cure):
    error = refusal(effect)
    code = "E-RANGE" if "plausible" in cure else "E-TYPE"
    assert (error.code, error.where) == (code, f"model.toml: breeze {place}")
    assert (error.what, error.cure) == (what, cure)


def test_limits_are_those_that_there_are():
    assert limits(Quantity("m", 0.0, 1.0, 2.0, 1.5)) == "a number that is finite; plausible is 1 to 2 m"
    assert limits(Quantity("1", 0.0, 1.0, 2.0, 1.5, most=3.0)) == "a number of at most 3; plausible is 1 to 2"
    assert limits(Quantity("N", 0.0, 1.0, 2.0, 1.5, least=-4.0)) == ("a number of at least -4 N; plausible is 1 to 2 N")
    assert limits(Quantity("N", 0.0, 1.0, 2.0, 1.5, least=POSITIVE, most=9.0)) == (
        "a number above 0 and of at most 9 N; plausible is 1 to 2 N"
    )


def test_what_adds_nothing_is_an_effect_that_answers_its_question():
    kind = nothing("NoWind", "loads", "No wind.", "The air stands still.", "F = 0", "this test")
    assert (kind.__name__, kind.__doc__, kind.__module__) == ("NoWind", "No wind.", "rockref.effects.nothing_added")
    assert (kind.question, kind.sentence, kind.equation, kind.source) == (
        "loads", "The air stands still.", "F = 0", "this test"
    )  # fmt: skip
    assert kind() == kind() and kind().is_absent()
    with pytest.raises(FrozenInstanceError):
        kind().question = "contact"


def test_json_has_words_for_the_infinite_and_null_for_what_is_open():
    assert [in_json(x) for x in (None, math.nan, math.inf, -math.inf)] == [None, None, "inf", "-inf"]
    assert [in_json(x) for x in (0.0, -2.5)] == [0.0, -2.5]


def test_a_number_outside_its_range_is_implausible_unless_it_is_absent():
    assert (
        implausible(Breeze()) == [] and implausible(Breeze(0.5, 1.0, 0.5)) == implausible(Breeze(2.0, 5.0, 2.0)) == []
    )
    assert implausible(Breeze(2.5, 0.5, 0.25)) == [
        ("height", "is 2.5 m", "0.5 to 2 m"), ("force", "is 0.5 N", "1 to 5 N"), ("share", "is 0.25", "0.5 to 2"),
    ]  # fmt: skip
