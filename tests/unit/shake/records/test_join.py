"""Components along x, y and z of the plate: right-handed, square, one to three."""

import numpy as np
import pytest

from rockref.model.errors import InputError
from rockref.shake.records.channel import Channel
from rockref.shake.records.join import joined


def channels(*directions):
    return [Channel(f"file {k}", np.full(3, k + 1.0), 0.01, d) for k, d in enumerate(directions)]


@pytest.mark.parametrize(
    "directions, first",
    [
        ((90.0, 0.0), [1, 2, 0]),
        ((0.0, 90.0), [2, 1, 0]),
        ((140.0, 230.0), [2, 1, 0]),
        ((270.0, 0.0, "up"), [2, 1, 3]),
        (("down", 90.0, 0.0), [2, 3, -1]),
        ((None, "up", None), [1, 3, 2]),
        ((37.0,), [1, 0, 0]),
        (("z", "x"), [2, 0, 1]),
    ],
)
def test_axes_are_right_handed(directions, first):
    assert joined(channels(*directions))[0][0].tolist() == first


@pytest.mark.parametrize("directions", [(10.0, 90.0), (0.0, 90.0, 180.0), ("up", "down"), (0.0, 180.0)])
def test_components_of_no_one_instrument_are_refused(directions):
    with pytest.raises(InputError, match="E-RECORD-AXES"):
        joined(channels(*directions))


def test_the_order_is_said_where_it_decides():
    assert [n.code for n in joined(channels(None, None))[2]] == ["W-RECORD-AXES"] * 2
    assert not joined(channels(None))[2]
