"""Signals that cannot be those of the release are refused; odd ones are said."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.measure.checks.release import check_first_swing
from rockref.measure.experiment import load_experiment
from rockref.measure.signals.signal import rocking_rate, rocking_time
from rockref.model.errors import InputError
from tests.refusal import refused
from tests.shipped import CONTROL

HEADER = "t_s,wx_deg_s,wy_deg_s,wz_deg_s"


def edited(folder, as_table, good_signal, change, header=HEADER):
    t, crv = good_signal()
    t, crv = change(t, crv)
    (folder / "run01.csv").write_text(as_table(t, crv, header))
    return folder


def late(t, crv):
    """The same motion, half a second later."""
    rest = np.zeros((250, 3))
    return np.arange(len(t) + 250) * 0.002, np.concatenate((rest, crv))


def wild(row, value=5000.0, axis=0, count=1):
    """Single samples that no block has."""

    def change(t, w):
        w = w.copy()
        w[row : row + count, axis] = value
        return t, w

    return change


def held(first, last, value=None):
    """A logger that repeats one value, or its last one."""

    def change(t, w):
        w = w.copy()
        w[first:last] = w[first] if value is None else value
        return t, w

    return change


BAD = {
    "X and Y swapped": (lambda t, w: (t, w[:, [1, 0, 2]]), HEADER, "E-AXES", "column wy_deg_s", "not about X"),
    "X and Z swapped": (lambda t, w: (t, w[:, [2, 1, 0]]), HEADER, "E-AXES", "column wz_deg_s", "not about X"),
    "X of wrong sign": (lambda t, w: (t, -w), HEADER, "E-SIGN", "column wx_deg_s", "must be positive"),
    "radians called degrees": (lambda t, w: (t, np.radians(w)), HEADER, "E-RADIANS", "column wx_deg_s", "wx_rad_s"),
    "degrees called radians": (
        lambda t, w: (t, w),
        HEADER.replace("deg", "rad"),
        "E-DEGREES",
        "column wx_rad_s",
        "wx_deg_s",
    ),
    "swapped and in radians": (
        lambda t, w: (t, w[:, [1, 0, 2]]),
        HEADER.replace("deg", "rad"),
        "E-DEGREES",
        "column wy_rad_s",
        "wy_deg_s",
    ),
    "millirad called degrees": (lambda t, w: (t, 17.45 * w), HEADER, "E-RATE-SIZE", "column wx_deg_s", "37.3 deg/s"),
    "too short": (lambda t, w: (t[:300], w[:300]), HEADER, "E-SHORT", "run01.csv", "ends at 0.598"),
    "channel dead": (lambda t, w: (t, w * [0.0, 1.0, 1.0]), HEADER, "E-STILL", "column wx_deg_s", "all values are 0"),
    "a wild sample in the first swing": (wild(100), HEADER, "E-SPIKE", "column wx_deg_s", "5000 deg/s at 0.2 s"),
    "a wild sample later": (wild(400), HEADER, "E-SPIKE", "column wx_deg_s", "leave these rows out"),
    "wild samples aside": (
        wild(700, -3000.0, 1, 3),
        HEADER,
        "E-SPIKE",
        "column wy_deg_s",
        "3 samples in a row leap away",
    ),
    "zeros in the first swing": (held(100, 200, 0.0), HEADER, "E-DROPOUT", "run01.csv", "from 0.2 to 0.398 s"),
    "zeros after an impact": (held(300, 350, 0.0), HEADER, "E-DROPOUT", "run01.csv", "0, 0, 0 deg/s"),
    "zeros to the end": (held(600, 750, 0.0), HEADER, "E-DROPOUT", "run01.csv", "from 1.2 to 1.498 s"),
    "the last value held": (held(600, 700), HEADER, "E-DROPOUT", "run01.csv", "cut the record before it"),
    "released late": (late, HEADER, "E-RELEASE", "run01.csv", "hardly moves"),
}


def slow_sampling(folder, as_table, rocking, rate, duration):
    """The run at a few samples a second, in both files."""
    path = folder / "experiment.toml"
    text = path.read_text().replace("sample_rate_hz = 500", f"sample_rate_hz = {rate}")
    path.write_text(text.replace("bandwidth_hz = 200", f"bandwidth_hz = {rate / 3}"))
    t = np.arange(0.0, duration, 1.0 / rate)
    noise = 0.05 * np.random.default_rng(0).standard_normal((len(t), 3))
    for name, sign in (("run01.csv", 1), ("run02.csv", -1)):
        (folder / name).write_text(as_table(t, np.degrees(rocking(sign=sign).crv(t)) + noise))
    return folder


def test_too_few_samples_name_the_file(folder, as_table, rocking):
    """At 20 a second a second and a half is long enough for an impact, and too little for a noise floor."""
    error = refused(load_experiment, slow_sampling(folder, as_table, rocking, 20, 1.5))
    assert (error.code, error.where) == ("E-SHORT", str(folder / "run01.csv"))
    assert "30 samples, where 32 are needed" in error.what


def test_a_cusp_of_few_samples_is_no_flat_top(folder, as_table, rocking):
    """At 50 a second a single sample stands for 20 ms."""
    codes = [n.code for n in load_experiment(slow_sampling(folder, as_table, rocking, 50, 3.0)).notices]
    assert "W-FLAT-TOP" not in codes


@pytest.mark.parametrize("offset", [3.0, -3.0])
def test_a_quiet_axis_off_zero_has_no_flat_top(folder, as_table, good_signal, offset):
    """All its samples are near its largest one, however far that is from zero."""

    def quiet(t, w):
        w = w.copy()
        w[:, 2] = offset + 0.05 * np.random.default_rng(1).normal(size=len(w))
        return t, w

    notices = load_experiment(edited(folder, as_table, good_signal, quiet)).notices
    assert "W-FLAT-TOP" not in [n.code for n in notices]


def test_a_rate_of_another_size_need_not_be_its_unit(folder):
    """Width and height exchanged: another block swings thirty times faster, and the column is named rightly."""
    path = folder / "experiment.toml"
    sizes = "width_m = 0.100\nheight_m = 0.688"
    assert sizes in path.read_text()
    path.write_text(path.read_text().replace(sizes, "width_m = 0.688\nheight_m = 0.100"))
    error = refused(load_experiment, folder)
    assert (error.code, error.where) == ("E-RATE-SIZE", f"{folder / 'run01.csv'}, column wx_deg_s")
    assert error.what.startswith("the first swing reaches 36.6 deg/s, where")
    assert error.cure == "A block that is as high as this one is wide reaches that: exchange width_m and height_m."
    # Sides that would not do exchanged, either.
    path.write_text(path.read_text().replace("width_m = 0.688\nheight_m = 0.100", "width_m = 0.2\nheight_m = 0.100"))
    error = refused(load_experiment, folder)
    assert "exchange" not in error.cure and "check" in error.cure.lower()


@pytest.mark.parametrize("case", BAD)
def test_signal_that_cannot_be(folder, as_table, good_signal, case):
    change, header, code, where, words = BAD[case]
    error = refused(load_experiment, edited(folder, as_table, good_signal, change, header))
    assert error.code == code
    assert str(folder / "run01.csv") in error.where and where in error.where
    assert words in str(error)


UNIT = "If the values are in {0}, name the column wx_{1}. If not, check release tilt, width and height."
SIGN = "Turn the sign of X (and of Y), or correct block_turned_deg."
FIRST_SWING = {
    # From 0.117 rad it turns by (alpha - tilt)(cosh(0.9 p T) - 1) in nine tenths of the first swing.
    "X and Y swapped": (
        "the block rocks about this axis (it turns by 0.0872 rad), not about X",
        "Name that column wx_deg_s: X is the rocking axis, Y the other horizontal one, Z the long one.",
    ),
    "X of wrong sign": ("the first swing is negative, and must be positive in this posture", SIGN),
    # 36.6 deg/s, over and times 57.3, and times 17.45.
    "radians called degrees": (
        "the first swing reaches 0.64 deg/s, where 37.3 deg/s are expected",
        UNIT.format("rad/s", "rad_s"),
    ),
    "degrees called radians": (
        "the first swing reaches 2.1e+03 deg/s, where 37.3 deg/s are expected",
        UNIT.format("deg/s", "deg_s"),
    ),
    "millirad called degrees": (
        "the first swing reaches 639 deg/s, where 37.3 deg/s are expected",
        "Check the unit of the column, the release tilt, width and height, and that time starts at the release.",
    ),
}


@pytest.mark.parametrize("case", FIRST_SWING)
def test_a_refused_first_swing_says_what_it_is_and_what_to_do(folder, as_table, good_signal, case):
    change, header, *_ = BAD[case]
    error = refused(load_experiment, edited(folder, as_table, good_signal, change, header))
    assert (error.what, error.cure) == FIRST_SWING[case]


def shaken_about_z(width, height):
    """The rates of a block of 0.1 m by 0.688 m let go at 0.117 rad; from 0.2 s on Z shakes by 200 deg/s."""
    t = np.arange(0.0, 1.2, 0.001)
    x = np.minimum(rocking_rate(0.117, 0.1, 0.688) * np.sinh(4.6 * t) / np.sinh(4.6 * 0.51), 0.65)
    crv = np.column_stack((x, 0.0 * t, np.radians(200.0) * np.cos(2.0 * np.pi * 20.0 * t) * (t > 0.2)))
    return SimpleNamespace(
        t=t, crv=crv, step=0.001, sign=1, scale=1.0, tilt=0.117, width=width, height=height,
        rate=rocking_rate(0.117, width, height), duration=rocking_time(0.117, width, height),
        names=("wx_deg_s", "wy_deg_s", "wz_deg_s"), column=lambda axis: f"column {axis}",
    )  # fmt: skip


def test_the_first_swing_is_judged_about_the_axis_that_the_block_turns_about():
    assert check_first_swing(shaken_about_z(0.1, 0.688)) == []
    error = refused(check_first_swing, shaken_about_z(0.688, 0.1))
    assert "reaches 37.2 deg/s" in error.what and "exchange width_m and height_m" in error.cure


def test_a_block_that_is_turned_must_swing_the_other_way(folder, as_table, good_signal):
    (folder / "run02.csv").write_text(as_table(*good_signal()))
    error = refused(load_experiment, folder)
    assert error.where == f"{folder / 'run02.csv'}, column wx_deg_s"
    assert error.what == "the first swing is positive, and must be negative in this posture"


def test_turned_block_swings_the_other_way(folder):
    path = folder / "experiment.toml"
    path.write_text(path.read_text().replace("block_turned_deg = 180", "block_turned_deg = 0"))
    error = refused(load_experiment, folder)
    assert error.code == "E-SIGN"
    assert "run02.csv" in error.where


def noisy(t, w):
    return t, w + 0.4 * np.random.default_rng(5).standard_normal(w.shape) * [0.0, 1.0, 0.0]


def spiked(t, w):
    w = w.copy()
    w[600, 2] = 80.0
    return t, w


def falling(t, w):
    """The block goes on over its edge after the first swing, faster and faster, and lies still from 1.4 s on."""
    w = w.copy()
    after = t > 0.7
    w[after, 0] = np.where(t < 1.4, 20.0 * np.exp(4.0 * (t - 0.7)), 0.0)[after]
    return t, w


ODD = {
    "falls over": (falling, {"W-OVERTURNED"}, "run01.csv", "falls over at"),
    "clipped": (lambda t, w: (t, np.clip(w, -30.0, 30.0)), {"W-FLAT-TOP"}, "column wx_deg_s", "at 30 deg/s"),
    "clipped below": (lambda t, w: (t, np.maximum(w, -28.0)), {"W-FLAT-TOP"}, "column wx_deg_s", "flat bottom"),
    "axis dead": (lambda t, w: (t, w * [1.0, 1.0, 0.0]), {"W-CONSTANT"}, "column wz_deg_s", "same"),
    "noisy": (noisy, {"W-NOISE"}, "column wy_deg_s", "0.05"),
    "spike": (spiked, {"W-SPIKE"}, "column wz_deg_s", "80 deg/s at 1.2 s (row 601)"),
    # (alpha - tilt) p sinh(p t) at 80 ms and the 26 ms after it
    "late start": (
        lambda t, w: (t[:-40], w[40:]),
        {"W-MOVING", "W-RELEASE"},
        "column wx_deg_s",
        "3.13 deg/s at the release",
    ),
    "zero off": (lambda t, w: (t, w + [2.5, 0.0, 0.0]), {"W-MOVING", "W-TILT-OFF"}, "column wx_deg_s", "subtract it"),
    "sampled at 510": (lambda t, w: (t / 1.005, w), {"W-RATE"}, "column t_s", "502.5"),
}


@pytest.mark.parametrize("case", ODD)
def test_odd_signal_is_said_and_used(folder, as_table, good_signal, case):
    change, codes, where, words = ODD[case]
    experiment = load_experiment(edited(folder, as_table, good_signal, change), uses=("fit",))
    assert {n.code for n in experiment.notices} == codes
    assert where in experiment.notices[0].where
    assert words in str(experiment.notices[0])
    assert experiment.runs[0].loaded


def test_nothing_is_left_of_a_fall(folder, as_table, good_signal):
    whole = load_experiment(folder, uses=("fit",)).runs[0]
    cut = load_experiment(edited(folder, as_table, good_signal, falling), uses=("fit",)).runs[0]
    # Half of the tipping angle of 0.14 rad at 20 deg/s and more takes a quarter of a second at most.
    assert 0.7 < cut.t[-1] < 1.0 and len(cut.crv) == len(cut.t)
    np.testing.assert_array_equal(cut.crv[cut.t < 0.699], whole.crv[whole.t < 0.699])


def lingering(t, w):
    """The block is held back for half a second, and creeps from the first sample on; the gyroscope has a bias."""
    creep = np.arange(250)[:, None] * 0.002
    begun = np.array([4.0, 0.0, 0.0]) * creep + np.array([30.0, 0.0, 0.0]) * creep**3
    noise = 0.05 * np.random.default_rng(3).standard_normal(begun.shape)
    return np.arange(len(t) + 250) * 0.002, np.concatenate((begun + noise, w)) + 0.1


def late_with_a_bias(t, w):
    t, w = late(t, w)
    return t, w + 0.1


@pytest.mark.parametrize("change", [lambda t, w: (t, w), lingering], ids=["plain", "lingering"])
def test_a_record_that_begins_late_was_released(folder, as_table, good_signal, change):
    """Its first sample stands for the rest that is missing."""

    def late_start(t, w):
        t, w = change(t, w)
        return t[30:], w[30:]

    codes = [n.code for n in load_experiment(edited(folder, as_table, good_signal, late_start), uses=("fit",)).notices]
    assert "W-START" in codes


def test_a_block_that_creeps_was_released(folder, as_table, good_signal):
    """A wire that lingers holds it back; one that lies still until later was started at another time."""
    experiment = load_experiment(edited(folder, as_table, good_signal, lingering), uses=("fit",))
    assert "W-FIRST-IMPACT" in {n.code for n in experiment.notices} and experiment.runs[0].loaded
    with pytest.raises(InputError, match="hardly moves"):
        load_experiment(edited(folder, as_table, good_signal, late_with_a_bias), uses=("fit",))


@pytest.mark.parametrize("rest", [0.16, 0.2, 0.24])
def test_a_block_that_begins_to_move_late_is_refused(folder, as_table, good_signal, rest):
    """Time is counted from before the release: it moves in the stretch that is looked at, but did not before."""

    def begun_late(t, w):
        n = round(rest / 0.002)
        return np.arange(len(t) + n) * 0.002, np.concatenate((np.zeros((n, 3)), w))

    with pytest.raises(InputError, match="hardly moves"):
        load_experiment(edited(folder, as_table, good_signal, begun_late), uses=("fit",))


def test_first_impact_at_another_time_is_said(folder):
    path = folder / "experiment.toml"
    # From 0.06 rad this block comes upright after 0.25 s, at nearly two thirds of the rate.
    path.write_text(path.read_text().replace("release_tilt_rad = 0.117", "release_tilt_rad = 0.07"))
    codes = [n.code for n in load_experiment(folder, uses=("fit",)).notices]
    assert codes == ["W-FIRST-IMPACT"]


def test_stated_range_is_watched(folder, as_table, good_signal):
    path = folder / "experiment.toml"
    path.write_text(path.read_text().replace("bandwidth_hz", "range_deg_s = 35\nbandwidth_hz"))
    edited(folder, as_table, good_signal, lambda t, w: (t, np.clip(w, -35.0, 35.0)))
    experiment = load_experiment(folder, uses=("fit",))
    assert "W-SATURATED" in {n.code for n in experiment.notices}
    assert experiment.gyro.range == pytest.approx(math.radians(35.0))


def test_closed_forms_of_the_first_swing(rocking):
    motion = rocking()
    assert rocking_time(0.117, 0.1, 0.688) == pytest.approx(motion.times[0], rel=1e-12)
    # Linear in the angle against the full energy: sin and its argument differ by alpha^2/6, 0.35 %.
    assert rocking_rate(0.117, 0.1, 0.688) == pytest.approx(motion.before[0], rel=4e-3)


def test_the_noise_of_one_column_alone_is_its_unit(folder, as_table, good_signal):
    """In the first swing Z has nothing but noise, and only the other columns say how much there should be."""
    notices = load_experiment(edited(folder, as_table, good_signal, lambda t, w: (t, w * [1, 1, 57.3]))).notices
    said = [str(n) for n in notices if n.code == "W-NOISE"]
    assert len(said) == 1
    assert "column wz_deg_s" in said[0] and "check the unit of this one" in said[0]


def test_a_short_dropout_is_remarked_on(folder, as_table, good_signal):
    """Twenty milliseconds of one value spoil some windows, not the run."""
    notices = load_experiment(edited(folder, as_table, good_signal, held(600, 610))).notices
    said = [str(n) for n in notices if n.code == "W-DROPOUT"]
    assert len(said) == 1
    assert "run01.csv" in said[0] and "from 1.2 to 1.218 s" in said[0]


@pytest.mark.parametrize("path", sorted(CONTROL.parent.glob("mystery-*")), ids=lambda path: path.name)
def test_axes_of_shipped_runs_are_in_their_places(path):
    """Sensors askew, uneven feet and all: the clatter is sharpest about the height."""
    assert "W-AXES" not in {n.code for n in load_experiment(path).notices}
