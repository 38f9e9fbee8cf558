"""Tosses in other axes, units or orders are refused before anything is computed; those as stated pass."""

import numpy as np
import pytest

from rockref.measure.tosses.load import load_tosses
from rockref.model.rotation import from_quaternion, quaternion
from tests.refusal import refused
from tests.tosses import made, stated, write_tosses


@pytest.fixture(scope="module")
def tosses():
    """Six simulated tosses of a cube, up to rest."""
    x, Lambda, _ = made(stated(), 6, frames=130, seed=4, noise=1e-5)
    return x, Lambda


def scalar_last(Lambda):
    return from_quaternion(np.roll(quaternion(Lambda), -1, axis=-1))


OTHERS = {
    "z down": (lambda x: x * [1, -1, -1], lambda R: R, "E-AXES", "falls along +z"),
    "y up": (lambda x: x[..., [0, 2, 1]], lambda R: R, "E-AXES", "to have y up"),
    "x down": (lambda x: x[..., [2, 0, 1]] * [-1, 1, 1], lambda R: R, "E-AXES", "to have -x up"),
    "millimetres": (lambda x: 1e3 * x, lambda R: R, "E-UNIT", "these are mm"),
    "centimetres": (lambda x: 1e2 * x, lambda R: R, "E-UNIT", "these are cm"),
    "scalar last": (lambda x: x, scalar_last, "E-POSE", "scalar seems to be written last"),
    "inverse": (lambda x: x, lambda R: np.swapaxes(R, -1, -2), "E-POSE", "from board to body"),
    "another zero": (lambda x: x + [0, 0, 0.3], lambda R: R, "E-BOARD", "above the board"),
    "a lower zero": (lambda x: x - [0, 0, 0.05], lambda R: R, "E-BOARD", "under the board"),
}


@pytest.mark.parametrize("case", OTHERS)
def test_other_axes_are_refused_with_their_name(tmp_path, tosses, case):
    place, turn, code, words = OTHERS[case]
    x, Lambda = tosses
    error = refused(load_tosses, write_tosses(tmp_path / "t", place(x), turn(Lambda)))
    assert error.code == code and words in str(error)


def test_tosses_as_stated_pass(tmp_path, tosses):
    assert len(load_tosses(write_tosses(tmp_path / "t", *tosses)).tosses) == 6
