"""The drawing of the block: what stands in it is what the law says."""

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

from rockref.report.charts.block_drawing import TILT, block_drawing, problem

ROOT = Path(__file__).resolve().parents[4]


def words(svg):
    return [element.text for element in ET.fromstring(svg).iter("text")]


def test_the_figure_of_the_pages_is_this_drawing():
    kept = (ROOT / "docs/figures/block.svg").read_text(encoding="utf-8")
    made = block_drawing(standalone=True) + "\n"
    numbers = re.compile(r"-?\d+\.\d")
    assert numbers.sub("#", kept) == numbers.sub("#", made)
    # Rounded to a tenth of a pixel, which another machine's last bits may turn over.
    ours, theirs = (np.array([float(n) for n in numbers.findall(text)]) for text in (made, kept))
    assert ours == pytest.approx(theirs, abs=0.11)


@pytest.mark.parametrize("turned, corners", [(False, "1 and 2"), (True, "3 and 4")])
def test_it_says_which_corners_hold_the_block(turned, corners):
    one = problem(turned)
    heights = one.start.x[2] + one.points.P[:4] @ one.start.Lambda.T[:, 2]
    assert " and ".join(str(k + 1) for k in np.flatnonzero(heights < 1e-4)) == corners
    assert f"leans on corners {corners}" in words(block_drawing())


def test_the_first_swing_has_the_sign_that_is_written():
    """Gravity turns the released block back about X: forwards where it is not turned, backwards where it is."""
    for turned, sign in ((False, 1), (True, -1)):
        one = problem(turned)
        pivots = one.points.P[[0, 1] if not turned else [2, 3]].mean(axis=0)
        lever = one.start.Lambda @ -pivots
        moment = one.start.Lambda.T @ np.cross(lever, [0.0, 0.0, -1.0])
        assert np.sign(moment[0]) == sign
    assert TILT < np.arctan2(0.100, 0.230)
    assert {"first swing: wx positive", "first swing: wx negative"} <= set(words(block_drawing()))


def test_a_page_gives_it_its_colour():
    assert "prefers-color-scheme" in block_drawing(standalone=True)
    assert "prefers-color-scheme" not in block_drawing() and "currentColor" in block_drawing()
