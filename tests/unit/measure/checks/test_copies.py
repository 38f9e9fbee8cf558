"""A copy is told by its numbers, whatever its bytes; repeated measurements are none."""

import gzip

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment

HEADER = "t_s,wx_deg_s,wy_deg_s,wz_deg_s\n"


def text_of(t, w, digits=2, extra=False, end="\n"):
    header = HEADER.replace("\n", ",note\n") if extra else HEADER
    rows = (
        f"{a:.6f}," + ",".join(f"{x:.{digits}f}" for x in row) + (",x" if extra else "")
        for a, row in zip(t, w, strict=True)
    )
    return (header + "".join(row + "\n" for row in rows)).replace("\n", end)


COPIES = {
    "line ends": lambda t, w: text_of(t, w, end="\r\n"),
    "more digits": lambda t, w: text_of(t, w, digits=5),
    "fewer digits": lambda t, w: text_of(t, w, digits=1),
    "a further column": lambda t, w: text_of(t, w, extra=True),
    "cut at the end": lambda t, w: text_of(t[:600], w[:600]),
    "cut at the beginning": lambda t, w: text_of(t[20:], w[20:]),
    "radians": lambda t, w: text_of(t, np.radians(w), digits=7).replace("_deg_s", "_rad_s"),
}


@pytest.mark.parametrize("case", COPIES)
def test_a_copy_is_told(folder, good_signal, case):
    t, w = good_signal(1, sign=-1)
    path = folder / "experiment.toml"
    path.write_text(path.read_text().replace("block_turned_deg = 0", "block_turned_deg = 180"))
    w = np.round(w, 2)
    (folder / "run01.csv").write_text(text_of(t, w))
    (folder / "run02.csv").write_bytes(COPIES[case](t, w).encode())
    said = [str(n) for n in load_experiment(folder).notices if n.code == "W-SAME-DATA"]
    assert len(said) == 1 and "runs 01 and 02 hold the same numbers" in said[0]


def test_a_packed_copy_is_told(folder, good_signal):
    t, w = good_signal(1, sign=-1)
    path = folder / "experiment.toml"
    toml = path.read_text().replace("block_turned_deg = 0", "block_turned_deg = 180")
    path.write_text(toml.replace("run02.csv", "run02.csv.gz"))
    (folder / "run01.csv").write_text(text_of(t, w))
    (folder / "run02.csv.gz").write_bytes(gzip.compress(text_of(t, w).encode(), mtime=0))
    assert "W-SAME-DATA" in {n.code for n in load_experiment(folder).notices}


@pytest.mark.parametrize("digits", [0, 1, 2])
def test_a_repeated_measurement_is_no_copy(folder, good_signal, digits):
    """The same motion, other noise: also where it is written in whole deg/s."""
    path = folder / "experiment.toml"
    toml = path.read_text().replace("block_turned_deg = 180", "block_turned_deg = 0")
    path.write_text(toml.replace("resolution_deg_s = 0.01", f"resolution_deg_s = {10.0**-digits:g}"))
    for name, seed in (("run01.csv", 3), ("run02.csv", 4)):
        (folder / name).write_text(text_of(*good_signal(seed), digits=digits))
    assert "W-SAME-DATA" not in {n.code for n in load_experiment(folder).notices}
