"""Pages of tosses: whole, small, with every number of their records and pictures that show something."""

import io

import matplotlib.image
import numpy as np
import pytest

from rockref.report.html.page import MAX_BYTES
from rockref.report.views import toss_page
from tests.unit.report import toss_records as made
from tests.unit.report.page_checks import faults_of


def pixels(png: bytes) -> np.ndarray:
    return matplotlib.image.imread(io.BytesIO(png), format="png")


def coloured(png: bytes, colour: str) -> int:
    """How many pixels have this colour, but for the edges of lines that are a pixel wide."""
    wanted = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)])
    return int((np.abs(255 * pixels(png)[..., :3] - wanted) < 60).all(-1).sum())


def test_page_of_a_comparison(tmp_path):
    path = toss_page.write_toss_comparison(made.comparison(), tmp_path)
    text = path.read_text(encoding="utf-8")
    assert faults_of(text) == [] and len(text.encode()) < MAX_BYTES
    for word in ("12.3 ± 6.2", "Where: explained, holdout tosses", "22 of 222", "0123abcd"):
        assert word in text, word
    # One picture, of the held-out tosses; a table of stretches for every row from the flight.
    assert text.count("<figure") == 1 and text.count("Where: ") == 4


def test_page_of_a_diagnosis_and_the_picture_beside_it(tmp_path):
    path = toss_page.write_toss_diagnosis(made.diagnosis(), tmp_path)
    text = path.read_text(encoding="utf-8")
    assert faults_of(text) == [] and len(text.encode()) < MAX_BYTES
    for word in ("Missing: mass_eccentricity", "3.85 (2.05 to 5.76)", "5.68 ± 0.20", "0.953", "90123", "0123abcd"):
        assert word in text, word
    # The physics of every effect that was added, and of no law.
    assert "mass_eccentricity: A hole" in text and "rounded_corners: Corners are round" in text
    assert (tmp_path / "staircase.png").read_bytes() == toss_page.staircase_picture(made.diagnosis())


def test_without_a_confusion_there_is_no_table_of_it(tmp_path):
    path = toss_page.write_toss_diagnosis(made.diagnosis() | {"confusion": {}}, tmp_path)
    assert "0.953" not in path.read_text(encoding="utf-8")


def test_pictures_ask_for_no_window_system(monkeypatch):
    """Who draws windows of his own keeps them: the library's backend is left as it is."""
    monkeypatch.setattr("matplotlib.use", lambda *a: pytest.fail("another backend"))
    assert toss_page.staircase_picture(made.diagnosis()).startswith(b"\x89PNG")


@pytest.fixture(scope="module")
def staircase():
    return toss_page.staircase_picture(made.diagnosis())


def test_pictures_have_every_line_and_bar(staircase):
    rows = [r for r in made.comparison()["rows"] if (r["use"], r["start"]) == ("holdout", "flight")]
    stretches = toss_page.stretches_picture(rows)
    for colour in (toss_page.INK, toss_page.PALE, toss_page.SECOND):
        assert coloured(staircase, colour) > 100 and coloured(stretches, colour) > 100


def test_a_longer_staircase_is_a_higher_picture(staircase):
    record = made.diagnosis()
    longer = record | {"staircase": [*record["staircase"], *record["staircase"][1:]]}
    assert pixels(toss_page.staircase_picture(longer)).shape[0] > pixels(staircase).shape[0]
