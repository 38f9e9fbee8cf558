"""Rows that are lost or put out of order while the stamps go on, units of one column, and scales."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.measure.checks.uprights import kept_shifts, odd_arc, zero_of
from rockref.measure.experiment import load_experiment
from rockref.measure.signals.arcs import turned_angle
from rockref.measure.signals.impacts import main_impacts
from rockref.model.errors import InputError
from tests.records import DEGREE, written

RATE = 1000


def told(tmp_path, made, degrees):
    """The refusal, or the codes of the remarks."""
    folder = written(tmp_path, made, np.arange(len(degrees)) / RATE, degrees)
    try:
        return {n.code for n in load_experiment(folder).notices} - {"W-NO-HOLDOUT"}
    except InputError as error:
        return error


def test_rows_that_are_lost_before_an_impact_leave_an_arc_that_does_not_add_up(tmp_path, made):
    impacts = main_impacts(made.t, made.crv)
    last = int(impacts.times[1] * RATE) - 15
    error = told(tmp_path, made, np.delete(made.degrees, np.arange(last - 40, last), axis=0))
    assert error.code == "E-ROWS-LOST"
    lost = turned_angle(made.t, made.crv[:, 0])
    angle = float(error.what.split("add up to ")[1].split(" degrees")[0])
    # What the block turned in the lost rows, with the other sign, but for the impact's own 1 ms.
    assert angle == pytest.approx(-(lost[last] - lost[last - 40]) / DEGREE, abs=0.06)


def test_rows_out_of_order_far_from_upright_are_leaps(tmp_path, made):
    """Two blocks of a tenth of a second, each with its own stamps, about the apex of an arc."""
    impacts = main_impacts(made.t, made.crv)
    middle = int(0.5 * (impacts.times[0] + impacts.times[1]) * RATE)
    order = np.arange(len(made.t))
    order[middle - 40 : middle + 40] = np.roll(order[middle - 40 : middle + 40], 40)
    assert told(tmp_path, made, made.degrees[order]) == {"W-LEAP"}


@pytest.mark.parametrize("axis", [1, 2])
def test_one_column_in_another_unit_is_refused(tmp_path, made, axis):
    folder = written(tmp_path, made)
    rows = np.column_stack((made.t, made.degrees))
    rows[:, 1 + axis] *= DEGREE
    text = "t_s,wx_deg_s,wy_deg_s,wz_deg_s\n" + "\n".join("{:.6f},{:.6f},{:.6f},{:.6f}".format(*row) for row in rows)
    (folder / "run01.csv").write_text(text + "\n", encoding="utf-8")
    with pytest.raises(InputError, match=rf"name it w{'xyz'[axis]}_rad_s") as refused:
        load_experiment(folder)
    assert refused.value.code == "E-RADIANS"


@pytest.mark.parametrize(("scale", "code"), [(0.5, "E-RATE-SIZE"), (2.0, "E-RATE-SIZE"), (1.2, "W-TILT-OFF")])
def test_rates_that_do_not_add_up_to_the_tilt_are_told(tmp_path, made, scale, code):
    found = told(tmp_path, made, scale * made.degrees)
    assert (found.code if isinstance(found, InputError) else code in found and code) == code


def test_rows_that_are_averaged_are_told(tmp_path, made):
    window = np.ones(7) / 7.0
    padded = np.pad(made.degrees, ((3, 3), (0, 0)), mode="edge")
    smooth = np.stack([np.convolve(padded[:, axis], window, mode="valid") for axis in range(3)], axis=-1)
    assert "W-SMOOTH" in told(tmp_path, made, smooth)


def test_a_block_that_moves_when_it_is_let_go_is_no_shift_of_a_zero(tmp_path, made):
    """What stays upright after every arc is a sensor in order, whatever the block did before the first impact."""
    spoiled = made.degrees.copy()
    first = int(main_impacts(made.t, made.crv).times[0] * RATE)
    spoiled[:first, 0] += np.linspace(2.0, 0.0, first)
    assert "W-ZERO" not in told(tmp_path, made, spoiled)


@pytest.mark.parametrize(("axis", "zero"), [(0, 1.0), (1, 2.0)])
def test_a_zero_that_is_off_throughout_is_told(tmp_path, made, axis, zero):
    spoiled = made.degrees.copy()
    spoiled[:, axis] += zero
    assert "W-ZERO" in told(tmp_path, made, spoiled)


def test_the_zero_is_what_all_arcs_have_in_common():
    zero = 0.3
    assert zero_of(np.full(5, zero)) == pytest.approx(zero)
    # One odd arc of three; a block that leans by as much to either side, an odd number of times; and with a zero.
    assert zero_of(np.array([0.0, 0.0, 7.0])) == 0.0
    leaning = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0])
    assert zero_of(leaning) == 0.0
    assert zero_of(zero + leaning) == pytest.approx(zero)
    assert zero_of(np.array([1.0, -1.0])) == 0.0


def test_what_is_lost_stays_lost():
    """A step after the third of six impacts; an impact that is put too late; a block that leans to either side."""
    assert list(kept_shifts(np.array([0.0, 0.0, 0.0, 2.0, 2.0, 2.0]))) == [0.0, 0.0, 2.0, 0.0, 0.0]
    assert list(kept_shifts(np.array([0.0, 0.0, 2.0, 0.0, 0.0]))) == [0.0] * 4
    assert list(kept_shifts(np.array([0.0, 2.0, 0.0, 2.0]))) == [0.0] * 3
    assert list(kept_shifts(np.array([0.0, -2.0]))) == [2.0]


def uprights_of(shifts, *, zero=0.0, peaks=None, grain=0.0):
    """A record whose arcs of half a second add up to `shifts` rad, and to `zero` rad/s; a first swing of 2 rad/s."""
    t = np.arange(0.0, 0.5 * len(shifts) + 1.0, 0.001)
    times = 0.5 * np.arange(1, len(shifts) + 2)
    turned = np.interp(t, times, np.cumsum([0.0, *shifts])) + zero * t
    impacts = SimpleNamespace(times=times, peaks=np.ones(len(times)) if peaks is None else np.array(peaks))
    return SimpleNamespace(impacts=impacts, t=t, turned=turned, rate=2.0, step=0.001, grain=grain)


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize(
    # 0.027 of a rate of 2 rad/s over half a second and two samples; and the values' width all along it.
    ("limit", "given"),
    [(0.031, {}), (0.031, {"zero": 0.1}), (0.036, {"grain": 0.01})],
)
def test_an_arc_is_odd_beyond_the_limit_whatever_the_zero(sign, limit, given):
    arc, angle = odd_arc(uprights_of([0.0, 0.0, sign * 1.02 * limit, 0.0, 0.0, 0.0], **given))
    assert arc == 2 and angle == pytest.approx(sign * 1.02 * limit + 0.5 * given.get("zero", 0.0))
    assert odd_arc(uprights_of([0.0, 0.0, sign * 0.98 * limit, 0.0, 0.0, 0.0], **given)) is None


def test_a_third_of_the_arcs_may_be_odd_and_the_largest_is_told():
    arc, angle = odd_arc(uprights_of([0.0, 0.1, 0.0, 0.0, -0.2, 0.0, 0.0]))
    assert arc == 4 and angle == pytest.approx(-0.2)
    assert odd_arc(uprights_of([0.0, 0.1, 0.0, 0.0, 0.2])) is None


def test_only_arcs_between_large_impacts_are_judged():
    """Two of them at least: one has no other to be odd beside."""
    shifts = [0.0, 0.1, 0.0, 0.0, 0.0]
    assert odd_arc(uprights_of(shifts, peaks=[1.0, 1.0, 1.0, 0.2, 0.2, 0.2]))[0] == 1
    assert odd_arc(uprights_of(shifts, peaks=[0.2, 1.0, 1.0, 0.2, 0.2, 0.2])) is None
    assert odd_arc(uprights_of(shifts, peaks=[1.0, 0.2, 1.0, 1.0, 1.0, 1.0])) is None
