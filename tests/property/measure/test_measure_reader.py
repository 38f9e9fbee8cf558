"""Whatever stands in an experiment folder, it either loads or says why not."""

from __future__ import annotations

import gzip
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rockref.measure.experiment import load_experiment
from rockref.measure.reading.table import read_table
from rockref.model.errors import InputError

NEEDED = ("t", "wx", "wy", "wz")
HEADER = b"t_s,wx_deg_s,wy_deg_s,wz_deg_s\n"
NAMES = ["t_s", "wx_deg_s", "wy_rad_s", "wz_deg_s", "wx", "note", "x_m", "qw", "", "t_s "]
PIECES = [
    b"0.001",
    b"1",
    b"-2.5e3",
    b"nan",
    b"inf",
    b"1e999",
    b"",
    b" ",
    b"x",
    b"1_0",
    b"0x1",
    b"\xff",
    b"\0",
    "−1".encode(),
    "٣".encode(),
    b'"1"',
]
SEPARATORS = [b",", b";", b"\n", b"\r\n", b"\r", b"\t", b"\x0b", "\u2028".encode()]

tables = st.lists(st.one_of(st.sampled_from(PIECES), st.sampled_from(SEPARATORS)), max_size=60).map(b"".join)
headers = st.lists(st.sampled_from(NAMES), max_size=8).map(lambda names: ",".join(names).encode() + b"\n")

TOML = """
name = "made"
kind = "release"
baseline = "eight_points"
block = { mass_kg = 54.0, width_m = 0.1, height_m = 0.688 }
release = { tilt_uncertainty_rad = 0.0014 }
gyro = { sample_rate_hz = 200, noise_deg_s = 0.05, bandwidth_hz = 80, resolution_deg_s = 0.01 }
[[run]]
id = "01"
file = "run01.csv"
use = "fit"
release_tilt_rad = 0.117
block_turned_deg = 0
"""


def run_bytes() -> bytes:
    """A good run at 200 Hz, long enough for one impact."""
    alpha = math.atan2(0.1, 0.688)
    p = math.sqrt(0.75 * 9.81 / (0.5 * math.hypot(0.1, 0.688)))
    t = np.arange(0.0, 0.9, 0.005)
    first = math.acosh(alpha / (alpha - 0.117)) / p
    s = t - first
    rising, falling = (alpha - 0.117) * p * np.sinh(p * t), 0.63 * np.cosh(p * s) - alpha * p * np.sinh(p * s)
    wx = np.degrees(np.where(s < 0.0, rising, falling))
    wx += 0.05 * np.random.default_rng(0).standard_normal(len(t))
    return (
        HEADER
        + "".join(
            f"{a:.3f},{b:.2f},0.0{k % 7},0.0{k % 5}\n" for k, (a, b) in enumerate(zip(t, wx, strict=True))
        ).encode()
    )


GOOD = run_bytes()


@pytest.fixture(scope="module")
def place(tmp_path_factory) -> Path:
    """One folder for all examples of a test: each writes its files anew."""
    folder = tmp_path_factory.mktemp("experiment")
    (folder / "experiment.toml").write_text(TOML)
    (folder / "run01.csv").write_bytes(GOOD)
    load_experiment(folder)
    return folder


def says_why(action, folder: Path) -> object | None:
    """Return what `action` returns, or None if it refuses in our own way."""
    try:
        return action()
    except InputError as error:
        assert error.code.startswith("E-")
        assert str(folder) in error.where or "argument" in error.where
        assert error.what and error.cure.strip()
        assert len(str(error)) < 1500
        return None


@given(
    head=st.one_of(st.just(HEADER), headers, st.binary(max_size=40)), body=st.one_of(tables, st.binary(max_size=200))
)
@example(head=HEADER, body=b"0,1,2,3\r0,1,2,3\n\n")
@example(head=HEADER, body=b"0,1,2,3\n" * 3 + b"\x1f\x8b")
@example(head=b"\x1f\x8b", body=b"")
def test_any_table_reads_or_says_why(place, head, body):
    path = place / "table.csv"
    path.write_bytes(head + body)
    table = says_why(lambda: read_table(path, NEEDED), place)
    if table is not None:
        assert all(np.isfinite(values).all() and len(values) == table.rows for values in table.columns.values())
        assert set(NEEDED) <= set(table.columns)


@given(
    values=st.lists(
        st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=4, max_size=4), min_size=1, max_size=30
    ),
    packed=st.booleans(),
    ending=st.sampled_from(["\n", "\r\n", "\r"]),
)
def test_numbers_survive_the_text(place, values, packed, ending):
    """Every float64 written with repr comes back to the last bit, where no unit is converted."""
    header = "t_s,wx_rad_s,wy_rad_s,wz_rad_s"
    text = ending.join([header, *(",".join(map(repr, row)) for row in values)]).encode()
    path = place / ("numbers.csv.gz" if packed else "numbers.csv")
    path.write_bytes(gzip.compress(text) if packed else text)
    table = read_table(path, NEEDED)
    for column, name in enumerate(NEEDED):
        assert np.array_equal(table.columns[name], [row[column] for row in values])


scalars = st.one_of(
    st.integers(),
    st.floats(),
    st.booleans(),
    st.text(max_size=8),
    st.sampled_from(["fit", "holdout", "release", "toss", "run01.csv", "../run01.csv", "01"]),
)


def as_toml(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return '"' + "".join(c if c.isalnum() or c in " ./-_" else f"\\U{ord(c):08x}" for c in value) + '"'
    return repr(value) if not isinstance(value, float) or math.isfinite(value) else str(value)


LINES = [number for number, line in enumerate(TOML.split("\n")) if " = " in line and "{" not in line]
KEYS = ["mass_kg", "width_m", "height_m", "sample_rate_hz", "noise_deg_s", "bandwidth_hz", "resolution_deg_s"]


@given(number=st.sampled_from(LINES), value=scalars)
def test_any_value_of_a_key_loads_or_says_why(place, number, value):
    lines = TOML.split("\n")
    lines[number] = lines[number].partition(" = ")[0] + " = " + as_toml(value)
    (place / "experiment.toml").write_text("\n".join(lines), encoding="utf-8", errors="surrogatepass")
    says_why(lambda: load_experiment(place), place)


@given(key=st.sampled_from(KEYS), value=st.one_of(st.floats(), st.integers()))
@example(key="height_m", value=1e-3)
@example(key="sample_rate_hz", value=199.9)
@example(key="noise_deg_s", value=0)
@example(key="resolution_deg_s", value=0)
def test_any_number_of_block_and_gyro_loads_or_says_why(place, key, value):
    start = TOML.index(key + " = ") + len(key) + 3
    end = min(TOML.find(mark, start) for mark in (",", " }") if TOML.find(mark, start) > 0)
    (place / "experiment.toml").write_text(TOML[:start] + as_toml(value) + TOML[end:])
    says_why(lambda: load_experiment(place), place)


@given(
    at=st.integers(0, len(TOML) - 1),
    junk=st.one_of(st.binary(max_size=6), st.sampled_from([b"[", b"]", b"=", b'"', b"\n"])),
)
def test_any_damage_to_the_toml_loads_or_says_why(place, at, junk):
    text = TOML.encode()
    (place / "experiment.toml").write_bytes(text[:at] + junk + text[at + len(junk) :])
    says_why(lambda: load_experiment(place), place)


@given(at=st.integers(0, len(GOOD) - 1), junk=st.one_of(st.binary(max_size=6), st.sampled_from(PIECES + SEPARATORS)))
def test_any_damage_to_a_run_loads_or_says_why(place, at, junk):
    (place / "experiment.toml").write_text(TOML)
    (place / "run01.csv").write_bytes(GOOD[:at] + junk + GOOD[at + len(junk) :])
    try:
        experiment = says_why(lambda: load_experiment(place), place)
        if experiment is not None:
            run = experiment.runs[0]
            assert np.isfinite(run.crv).all() and np.all(np.diff(run.t) > 0.0)
    finally:
        (place / "run01.csv").write_bytes(GOOD)
