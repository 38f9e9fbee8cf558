"""The granite blocks: a made-up folder of the same layout, and the measured one where it is."""

import os
import sys

import numpy as np
import pytest

from rockref.model.errors import InputError
from rockref.shake.statistics.held_out import held_out_regression
from rockref.shake.statistics.scores import hits, log_losses, repeats
from tests.shipped import ROOT

sys.path.insert(0, str(ROOT / "benchmarks"))
from granite_blocks import FELL, VARIABLE, load_granite, record_sizes, sizes  # noqa: E402

measured = pytest.mark.skipif(not os.environ.get(VARIABLE), reason=f"{VARIABLE} names no folder with the granite tests")


@pytest.fixture
def made_up(tmp_path):
    """A table that moves with 1 and 4 Hz; its accelerometer leads by a radian at 1 Hz and has the other sign."""
    t, slow = np.arange(6000) / 200.0, np.arange(1500) / 50.0
    displacement = lambda t: 0.05 * np.sin(np.pi * t) ** 2 + 1e-3 * np.sin(8 * np.pi * t)  # noqa: E731
    right = 0.1 * np.pi**2 * np.cos(2 * np.pi * t) - 1e-3 * (8 * np.pi) ** 2 * np.sin(8 * np.pi * t)
    led = right + 0.1 * np.pi**2 * (np.cos(2 * np.pi * t + 1.0) - np.cos(2 * np.pi * t))
    np.savez(
        tmp_path / "records.npz",
        **{
            "007_main": np.round(-led / (2e-4 * 9.81)).astype(np.int16),
            "007_displacement": np.round(displacement(slow) / 2e-5).astype(np.int16),
        },
    )
    (tmp_path / "blocks.toml").write_text("[sp1]\nmass = 353.8\n[sp2]\nmass = 350.0\n", encoding="utf-8")
    rows = ["test,motion,record,pga_is_nominal,fell_sp1,fell_sp2", "7,A,1,0,1,0", "8,A,0,0,1,0", "9,B,1,1,1,1"]
    (tmp_path / "outcomes.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    return load_granite(tmp_path), t, right, led


def test_slow_motion_is_that_of_the_displacement(made_up):
    blocks, t, right, led = made_up
    inside = (t > 5) & (t < 25)
    a = blocks.base_motion(7).a[inside, 0]
    # The crossover of order four at 2 Hz leaves 1/17 of what the accelerometer has at 1 Hz; 4 Hz are in both.
    assert np.abs(a - right[inside]).max() < 0.1 * np.abs(led - right).max()
    alone = blocks.base_motion(7, crossover=0.0).a[:, 0]
    # Rounded to counts.
    assert alone == pytest.approx(led, abs=1.01e-3)


def test_aborted_tests_and_those_without_a_record_are_left_out(made_up):
    blocks = made_up[0]
    assert blocks.clean().test.tolist() == [7]
    assert blocks.block(2)["mass"] == 350.0
    with pytest.raises(InputError, match="E-GRANITE"):
        blocks.base_motion(8)


def test_absent_data_are_said(monkeypatch, tmp_path):
    monkeypatch.delenv(VARIABLE, raising=False)
    with pytest.raises(InputError, match="E-FOLDER"):
        load_granite()
    with pytest.raises(InputError, match="E-FOLDER"):
        load_granite(tmp_path)


@measured
def test_neighbours_of_the_460_clean_tests():
    tests = load_granite().clean()
    assert (len(tests), tests.motion.nunique()) == (460, 56)
    found = {}
    for fell in FELL:
        for name, numbers in (("sheet", sizes), ("record", record_sizes)):
            p = held_out_regression(np.log(numbers(tests)), tests[fell], tests.motion)
            found[name, fell] = log_losses(p, tests[fell]).mean(), hits(p, tests[fell]).mean()
    # Three figures are stated, for a fit with a small quadratic penalty in place of Jeffreys' prior.
    assert [found["sheet", f][0] for f in FELL] == pytest.approx([0.273, 0.284], abs=1.5e-3)
    assert [found["record", f][0] for f in FELL] == pytest.approx([0.305, 0.296], abs=1.5e-3)
    # A test or two lie at one half.
    assert [found["sheet", f][1] for f in FELL] == pytest.approx([0.872, 0.870], abs=5e-3)


@measured
def test_repeats_set_the_ceiling():
    tests = load_granite().clean()
    found = [repeats(tests.motion, tests.pga_sheet_g, tests[f]) for f in FELL]
    assert [(r.pairs, r.agree) for r in found] == [(34, 30), (34, 32)]
