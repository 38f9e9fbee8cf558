"""The drawing of the block: what stands in it is what the law says."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest

from rockref.report.charts.block_drawing import TILT, block_drawing, problem
from tests.shipped import ROOT


def written(svg):
    """What is written, and where in the drawing."""
    texts = [element for element in ET.fromstring(svg).iter() if element.tag.endswith("text")]
    return [t.text for t in texts], np.array([(t.get("x"), t.get("y")) for t in texts], float)


def words(svg):
    return written(svg)[0]


def test_the_figure_of_the_pages_is_this_drawing():
    """Corners are named where the law puts them; another machine's last bits may turn over a tenth of a pixel."""
    kept = written((ROOT / "docs/figures/block.svg").read_text(encoding="utf-8"))
    made = written(block_drawing(standalone=True))
    assert kept[0] == made[0] and made[1] == pytest.approx(kept[1], abs=0.11)


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
