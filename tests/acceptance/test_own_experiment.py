"""The worked example of `docs/howto/own_experiment.md`, and every mistake that `refused_records.md` lists."""

import re
import shutil

import numpy as np
import pytest

from rockref.measure import load_experiment
from rockref.measure.signals.impacts import main_impacts
from tests.refusal import refused
from tests.shipped import ROOT, program

PAGE = (ROOT / "docs/howto/refused_records.md").read_text(encoding="utf-8")
HEADER = "t_s,wx_deg_s,wy_deg_s,wz_deg_s"


@pytest.fixture(scope="module")
def example():
    return program("examples/own_experiment.py")


@pytest.fixture(scope="module")
def converted(example, tmp_path_factory):
    """The folder that the example makes."""
    pytest.importorskip("numba")
    place = tmp_path_factory.mktemp("own")
    example.play_the_logger(place / "logger")
    example.convert(place / "logger", place / "my_block")
    return place / "my_block"


def test_the_folder_is_used_without_a_remark(converted):
    experiment = load_experiment(converted)
    assert experiment.notices == ()
    assert [run.use for run in experiment.runs] == ["fit", "fit", "holdout", "fit"]
    # the logger's gyroscope has 0.06 deg/s
    assert np.degrees(experiment.gyro.noise) == pytest.approx(0.06, abs=0.003)


def test_the_release_is_found(example, converted):
    """The logger lets go half a second after it was switched on; a sample is 2 ms."""
    for file, *_ in example.RUNS.values():
        t, chip = example.read(converted.parent / "logger" / file)
        wx = example.body_rates(chip)[:, 0]
        assert example.release(t, wx - wx[t < 0.4].mean(), 0.06) == pytest.approx(0.5, abs=5e-4)


def table(change, header=HEADER):
    """A mistake in the numbers of run 01."""

    def make(folder):
        path = folder / "run01.csv"
        rows = change(np.loadtxt(path, delimiter=",", skiprows=1))
        np.savetxt(path, rows, "%.6f", ",", header=header, comments="")

    return make


def text(pattern, replacement, file="run01.csv", count=0):
    """A mistake in the text of a file."""

    def make(folder):
        path = folder / file
        old = path.read_text(encoding="utf-8")
        new = re.sub(pattern, replacement, old, count=count, flags=re.MULTILINE)
        assert new != old
        path.write_text(new, encoding="utf-8")

    return make


def toml(pattern, replacement, count=1):
    """A mistake in experiment.toml."""
    return text(pattern, replacement, "experiment.toml", count)


def cells(rows, place, value):
    rows = rows.copy()
    rows[place] = value
    return rows


def before_the_release(rows):
    """A record that begins when the logger is switched on, half a second before."""
    rest = np.column_stack([np.arange(0, 0.5, 0.002), np.zeros((250, 3))])
    return np.vstack([rest, rows + [0.5, 0, 0, 0]])


def lost_before_an_impact(rows):
    """The logger loses 60 ms just before the second main impact, and numbers its rows on."""
    second = main_impacts(rows[:, 0], np.radians(rows[:, 1:])).times[1]
    last = int(second * 500) - 10
    left = np.delete(rows, range(last - 30, last), axis=0)
    return np.column_stack([rows[: len(left), 0], left[:, 1:]])


def rows_exchanged(rows, at, count):
    """Two blocks of so many rows in each other's place."""
    first = int(at * 500)
    order = np.arange(len(rows))
    order[first - count : first + count] = np.roll(order[first - count : first + count], count)
    return np.column_stack([rows[:, 0], rows[order, 1:]])


def set_up_again(rows):
    """Rest against the wire, after a hand turned the block back from where it was."""
    hand = np.zeros((600, 4))
    turned = rows[:700, 1].sum() / 500
    hand[:300, 1] = -turned * 2.0 / 0.6 * np.sin(np.pi * np.arange(300) / 300) ** 2
    hand[:, 1:] += 0.05 * np.random.default_rng(0).standard_normal((600, 3))
    both = np.vstack([rows[:700], hand])
    return np.column_stack([np.arange(len(both)) / 500, both[:, 1:]])


def averaged(rows):
    """Means over seven rows."""
    means = [np.convolve(np.pad(rows[:, k], 3, mode="edge"), np.ones(7) / 7, mode="valid") for k in (1, 2, 3)]
    return np.column_stack([rows[:, 0], *means])


RADIANS = np.array([1, np.pi / 180, np.pi / 180, np.pi / 180])
MISTAKES = [
    ("E-DELIMITER", text(",", ";")),
    ("E-DECIMAL-COMMA", text(r"(?<=\d)\.(?=\d)", ",")),
    ("E-HEADER", text(r"\A.*\n", "", count=1)),
    ("E-COLUMN-MISSING", text("wx_deg_s", "gyro_x_deg_s", count=1)),
    ("E-UNIT", text("wx_deg_s", "wx", count=1)),
    ("E-UNIT", toml("mass_kg = 30.1", "mass_g = 30100")),
    ("E-RADIANS", table(lambda rows: rows * RADIANS)),
    ("E-DEGREES", text("deg_s", "rad_s", count=3)),
    ("E-RATE", table(lambda rows: rows * [1000, 1, 1, 1])),
    ("E-RATE", toml("sample_rate_hz = 500", "sample_rate_hz = 1000")),
    ("E-START", table(lambda rows: rows - [0.5, 0, 0, 0])),
    ("E-RELEASE", table(before_the_release)),
    ("E-TIME", table(lambda rows: rows[np.r_[0:10, 11, 10, 12 : len(rows)]])),
    ("E-GAP", table(lambda rows: np.delete(rows, range(100, 110), axis=0))),
    ("W-GAP-FILLED", table(lambda rows: np.delete(rows, range(100, 102), axis=0))),
    ("E-AXES", text("wx_deg_s,wy_deg_s", "wy_deg_s,wx_deg_s", count=1)),
    ("E-SIGN", table(lambda rows: rows * [1, -1, -1, 1])),
    ("E-SIGN", toml("block_turned_deg = 180", "block_turned_deg = 0")),
    ("E-TILT", toml("release_tilt_rad = 0.105", "release_tilt_rad = 6.02")),
    ("E-TILT", toml("release_tilt_rad = 0.105", "release_tilt_rad = -0.105")),
    ("E-RANGE", toml("height_m = 0.6", "height_m = 600")),
    ("E-SHORT", table(lambda rows: rows[:200])),
    ("E-SPIKE", table(lambda rows: cells(rows, (200, 1), 5000.0))),
    ("E-DROPOUT", table(lambda rows: cells(rows, (slice(300, 340), slice(1, 4)), rows[300, 1:4]))),
    ("E-HOLD", table(lambda rows: cells(rows, np.s_[:, 1:], rows[np.arange(len(rows)) // 20 * 20, 1:]))),
    ("E-REPEAT", table(lambda rows: cells(rows, np.s_[500:540, 1:], rows[460:500, 1:]))),
    ("E-ROWS-LOST", table(lost_before_an_impact)),
    ("E-NOT-FINITE", text(r"^(0\.10\d+),[^,]*", r"\1,nan", count=1)),
    ("E-FIELDS", text(r",[^,]*\n\Z", "")),
    ("E-PATH", toml('file = "run01.csv"', 'file = "../run01.csv"')),
    ("E-FILE", toml('file = "run01.csv"', 'file = "run1.csv"')),
    ("E-RUN-TWICE", toml('file = "run02.csv"', 'file = "run01.csv"')),
    ("E-NO-FIT", toml('use = "fit"', 'use = "holdout"', count=0)),
    ("W-NO-HOLDOUT", toml('use = "holdout"', 'use = "fit"')),
    ("W-RATE", toml("sample_rate_hz = 500", "sample_rate_hz = 502")),
    ("W-START", table(lambda rows: rows[20:])),
    ("W-AXES", text("wy_deg_s,wz_deg_s", "wz_deg_s,wy_deg_s", count=1)),
    ("W-MOVING", table(lambda rows: rows + [0, 3, 0, 0])),
    ("W-RELEASE", table(lambda rows: cells(rows, np.s_[:-30, 1:], rows[30:, 1:])[:-30])),
    ("W-TILT-OFF", toml("release_tilt_rad = 0.105", "release_tilt_rad = 0.088")),
    ("W-LEAP", table(lambda rows: rows_exchanged(rows, 0.95, 20))),
    ("W-SET-UP", table(set_up_again)),
    ("W-SMOOTH", table(averaged)),
    ("W-FIRST-IMPACT", toml("height_m = 0.6", "height_m = 0.5")),
    ("W-NOISE", toml("noise_deg_s = .*", "noise_deg_s = 0.005")),
    ("W-FLAT-TOP", table(lambda rows: np.column_stack([rows[:, 0], np.clip(rows[:, 1:], -20, 20)]))),
    ("W-SAME-DATA", lambda folder: shutil.copy(folder / "run01.csv", folder / "run02.csv")),
]


@pytest.mark.parametrize("code, mistake", MISTAKES)
def test_a_mistake_is_told_as_the_page_says(code, mistake, converted, tmp_path):
    folder = tmp_path / "my_block"
    shutil.copytree(converted, folder)
    mistake(folder)
    if code.startswith("E"):
        error = refused(load_experiment, folder)
        assert error.code == code
    else:
        assert code in {notice.code for notice in load_experiment(folder).notices}


@pytest.mark.parametrize(
    "change",
    [
        toml("height_m = 0.6", "height_mm = 600"),
        toml("release_tilt_rad = 0.105", "release_tilt_deg = 6.016"),
        lambda folder: table(lambda rows: rows * [1000, 1, 1, 1], HEADER.replace("t_s", "t_ms"))(folder),
        lambda folder: table(lambda rows: rows * RADIANS, HEADER.replace("deg_s", "rad_s"))(folder),
    ],
)
def test_the_other_units_of_the_page_are_read(change, converted, tmp_path):
    folder = tmp_path / "my_block"
    shutil.copytree(converted, folder)
    change(folder)
    assert load_experiment(folder).notices == ()


def test_every_code_of_the_page_is_tried():
    """The table of the page and the mistakes above list the same codes."""
    rows = re.findall(r"^\| (`[EW]-.*?) \|(?:.*)$", PAGE, re.MULTILINE)
    listed = {code for row in rows for code in re.findall(r"[EW](?:-[A-Z]+)+", row)}
    assert listed | {"W-GAP-FILLED"} == {code for code, _ in MISTAKES}
