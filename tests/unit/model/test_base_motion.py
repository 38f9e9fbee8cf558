"""The plate's acceleration: linear between samples, zero outside; scaled and turned records; what is no record."""

import numpy as np
import pytest

from rockref.effects.catalogue import EFFECTS
from rockref.model.base_motion import BaseMotion, inertial_force, plate_acceleration
from rockref.model.problem import as_arrays
from rockref.model.simulate import check_base, simulate
from tests import physics
from tests.refusal import refusal, refused

RECORD = BaseMotion(t_0=0.25, dt=0.125, a=[[1.0, -2.0, 0.5], [3.0, 4.0, -1.5], [-5.0, 0.0, 2.0]])


def test_samples_are_met_at_their_times_and_joined_by_lines():
    for k, row in enumerate(RECORD.a):
        assert plate_acceleration(RECORD, 0.25 + k * 0.125).tolist() == row.tolist()
    # a quarter of the way, in numbers that are exact in binary
    assert plate_acceleration(RECORD, 0.25 + 0.03125).tolist() == [1.5, -0.5, 0.0]
    assert RECORD.end == 0.5


@pytest.mark.parametrize("t", [0.0, np.nextafter(0.25, 0), np.nextafter(0.5, 1), 7.0])
def test_the_plate_has_no_acceleration_outside_of_the_record(t):
    assert plate_acceleration(RECORD, t).tolist() == [0.0, 0.0, 0.0]
    single = BaseMotion(RECORD.t_0, RECORD.dt, RECORD.a.astype(np.float32))
    assert plate_acceleration(single, t).dtype == plate_acceleration(single, 0.3).dtype == np.float32


def test_a_turn_goes_from_x_to_y_and_leaves_z():
    assert RECORD.rotated(90).a[0].tolist() == [2.0, 1.0, 0.5]
    assert RECORD.rotated(-180).a.tolist() == (RECORD.a * [-1, -1, 1]).tolist()
    assert RECORD.rotated(360) == RECORD
    # A hundred whole turns, too, are no turn: quarters are counted, not their cosines.
    assert RECORD.rotated(36000) == RECORD
    turned = RECORD.rotated(30)
    # one rounding of each product and sum
    np.testing.assert_allclose(turned.a[0, :2], [np.sqrt(0.75) + 1, 0.5 - 2 * np.sqrt(0.75)], rtol=4e-16)
    np.testing.assert_allclose(turned.rotated(-30).a, RECORD.a, rtol=0, atol=2e-15)


def test_a_factor_multiplies_all_three_components_and_keeps_times_and_name():
    record = BaseMotion(0.25, 0.125, RECORD.a, name="station")
    doubled = record.scaled(2)
    assert doubled.a.tolist() == (2 * RECORD.a).tolist()
    assert (doubled.t_0, doubled.dt, doubled.name) == (0.25, 0.125, "station")
    assert record == RECORD and doubled != RECORD and hash(record) == hash(RECORD)
    assert hash(doubled) != hash(RECORD)


def test_the_force_is_opposite_to_the_acceleration_and_as_large_as_the_mass():
    assert inertial_force(2.0, np.array([1.0, -2.0, 0.5])).tolist() == [-2.0, 4.0, -1.0]
    assert inertial_force(np.array([1.0, 3.0]), RECORD.a[0]).tolist() == [[-1.0, 2.0, -0.5], [-3.0, 6.0, -1.5]]


SECONDS = "Give a finite number of seconds; the interval is positive."
ROWS = "Give one row of three a sample."
NUMBERS = "Give t_0 and dt as numbers [s], a as n rows of three numbers [m/s2]."


@pytest.mark.parametrize(
    "changes, said",
    [
        ({"a": np.zeros((4, 2))}, ("E-SHAPE", " a", "has shape (4, 2)", ROWS)),
        ({"a": np.zeros((0, 3))}, ("E-SHAPE", " a", "has shape (0, 3)", ROWS)),
        ({"a": np.zeros((1, 4, 3))}, ("E-SHAPE", " a", "has shape (1, 4, 3)", ROWS)),
        ({"a": [[0.0, 0.0, 0.0], [0.0, 0.0, np.nan]]},
         ("E-RANGE", " a, sample 1", "is not finite", "Repair or cut the record.")),
        ({"a": "none"}, ("E-TYPE", "", "is not made of numbers", NUMBERS)),
        ({"dt": "soon"}, ("E-TYPE", "", "is not made of numbers", NUMBERS)),
        ({"dt": 0.0}, ("E-RANGE", " dt", "is 0.0", SECONDS)),
        ({"dt": float("inf")}, ("E-RANGE", " dt", "is inf", SECONDS)),
        ({"t_0": float("nan")}, ("E-RANGE", " t_0", "is nan", SECONDS)),
    ],
)  # fmt: skip
def test_what_is_no_record_is_refused(changes, said):
    code, where, what, cure = said
    error = refused(BaseMotion, **{"t_0": 0.0, "dt": 0.01, "a": RECORD.a, **changes})
    assert (error.code, error.where, error.what, error.cure) == (code, f"base motion{where}", what, cure)


@pytest.mark.parametrize("kind, kept", [(np.float32, np.float32), (np.longdouble, np.longdouble), (int, np.float64)])
def test_samples_keep_the_precision_of_a_float_and_stand_in_rows(kind, kept):
    record = BaseMotion("0", np.float32(0.5), np.asfortranarray(2 * RECORD.a).astype(kind))
    assert record.a.dtype == kept and record.a.flags.c_contiguous
    assert (record.t_0, record.dt) == (0.0, 0.5) and type(record.dt) is float


def in_flight(**changes):
    """A body that nothing touches, over a plate that moves from a quarter of a second on."""
    return physics.flying((2.0, 2.0, 1.0), (0, 0, 0), 1 / 16, 0.5).replace(**{"base": RECORD, **changes})


def test_a_body_in_flight_has_the_weights_acceleration_less_that_of_the_plate():
    """It stays behind in the room; 3/8 s are the middle of the record."""
    a = simulate(in_flight(duration=0.375)).final_state.a
    # A rounding each of the force, of the weight and of their quotient, numbers of some 600 N.
    np.testing.assert_allclose(a, [-3.0, -4.0, 1.5 - 9.81], rtol=1e-15)


@pytest.mark.parametrize("precision", [np.float32, np.float64, np.longdouble])
def test_the_plate_moves_in_the_precision_of_the_run(precision):
    moved = as_arrays(in_flight(), precision)
    assert moved.base == RECORD and moved.base.a.dtype == precision
    assert as_arrays(in_flight(base=None), precision).base is None


MOVES = (
    "cannot act on a plate that moves: it needs the speed through air that stands still in the room, so the velocity"
)


def test_what_does_not_go_with_a_moving_plate_is_refused():
    record = "a" * 100
    said = ("E-TYPE", "base", f"is '{record}"[:80], "Give a BaseMotion, or None.")
    assert refusal(simulate, in_flight(base=record)) == said
    drag = EFFECTS["quadratic_drag"]
    said = ("E-BASE", "effect quadratic_drag", f"{MOVES} of the plate too")
    assert refusal(simulate, in_flight(effects=(drag(0.4),))) == (
        *said,
        "Leave the effect out, or the motion of the plate.",
    )
    for effects, base in (((drag(0.4),), None), ((drag(0.0), EFFECTS["plate_tilt"](1e-3)), RECORD)):
        check_base(in_flight(effects=effects, base=base))
