"""Intervals of shares, and stated probabilities against what was right."""

import pytest

from rockref.blind.scoring.intervals import as_text, by_word, reliability, wilson, words_as_text


@pytest.mark.parametrize(
    ("hits", "n", "low", "high"),
    # The roots of (p - hits/n)^2 = z^2 p (1 - p)/n, z = 1.959964.
    [(0, 24, 0.0, 0.13797), (9, 10, 0.59585, 0.98212), (0, 0, 0.0, 1.0)],
)
def test_wilson(hits, n, low, high):
    assert wilson(hits, n) == pytest.approx((low, high), abs=2e-5)


def said(probability, right):
    return {"probability": probability, "right": right}


def test_probabilities_are_counted_by_bins_that_hold_their_lower_edge():
    marks = [said(0.85, True), said(0.9, False), said(0.95, True), said(1.0, True), said(None, False), {"right": True}]
    rows = reliability(marks)
    found = [(r["from"], r["to"], r["right"], r["n"]) for r in rows]
    assert found == [(0.85, 0.95, 1, 2), (0.95, 1.0, 2, 2)]
    assert rows[0]["stated"] == pytest.approx(0.875) and rows[0]["low"] < 0.5 < rows[0]["high"]
    assert as_text(rows).splitlines()[2].startswith("| 0.85 to 0.95 | 87.5 % | 1 of 2 |")
    assert reliability([]) == []


def test_each_word_is_counted_with_how_often_it_was_right():
    marks = [{"verdict": "named", "right": True}, {"verdict": "none", "right": False}, {"verdict": "named", "right": 0}]
    rows = by_word(marks)
    assert [(r["verdict"], r["right"], r["n"]) for r in rows] == [("named", 1, 2), ("none", 0, 1)]
    assert (rows[0]["low"], rows[0]["high"]) == wilson(1, 2)
    assert "| `named` | 1 of 2 | 9 to 91 % |" in words_as_text(rows)
