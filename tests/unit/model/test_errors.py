"""Errors carry code, place, finding and cure, and say them in one line."""

import pytest

from rockref.model.errors import InputError, NumericalError, RockrefError


@pytest.mark.parametrize("kind, builtin", [(InputError, ValueError), (NumericalError, ArithmeticError)])
def test_an_error_says_where_what_and_what_to_do(kind, builtin):
    error = kind("E-RANGE", "model.toml: [block] mass_kg", "is -1.0", "Give a positive number.")
    assert isinstance(error, RockrefError)
    assert isinstance(error, builtin)
    assert (error.code, error.where) == ("E-RANGE", "model.toml: [block] mass_kg")
    assert (error.what, error.cure) == ("is -1.0", "Give a positive number.")
    assert str(error) == "model.toml: [block] mass_kg: is -1.0. Give a positive number. [E-RANGE]"
