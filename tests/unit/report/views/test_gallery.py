"""The gallery: page and pictures are made from what the effects say of themselves."""

import re
from pathlib import Path

import numpy as np

from rockref.effects.base import HOOKS, UNDO_HOOKS
from rockref.effects.catalogue import EFFECTS, OF_TOSSES, QUESTIONS
from rockref.report.views import gallery
from tests.shipped import program

DOCS = Path(__file__).resolve().parents[4] / "docs"
MAKER = program("docs/make_gallery.py")


def test_the_page_has_a_section_and_a_picture_for_each():
    page = MAKER.page()
    assert re.findall(r"^### (\w+)$", page, re.MULTILINE) == [
        *(kind.id for answers in QUESTIONS.values() for kind in answers[1:]),
        *OF_TOSSES,
    ]
    for id in EFFECTS:
        assert f"](effects/{id}.png)" in page


def test_hooks_are_explained_with_their_arguments():
    howto = (DOCS / "howto/own_effect.md").read_text(encoding="utf-8")
    for name, arguments in (HOOKS | UNDO_HOOKS).items():
        assert f"| `{name}({', '.join(arguments)})` |" in howto


def test_curves_are_those_of_the_law_and_of_the_effect():
    t, without, with_it = gallery.curves(EFFECTS["gyro_scale"](2.0, 1.0, 1.0), duration=0.02)
    assert t[-1] == 0.02
    assert np.array_equal(with_it[:, 0], 2 * without[:, 0]) and np.array_equal(with_it[:, 1:], without[:, 1:])
    _, four, eight = gallery.curves(EFFECTS["foot_defects"].typical(), duration=0.02)
    assert not np.array_equal(four, eight)


def test_a_slow_clock_is_shown_to_the_end():
    """It shows the motion at rate t, in the last row, too: nothing is held there."""
    t, without, with_it = gallery.curves(EFFECTS["clock_error"](2.0), duration=0.02)
    _, longer, _ = gallery.curves(EFFECTS["clock_error"](1.5), duration=0.04)
    np.testing.assert_allclose(with_it, longer[::2], atol=1e-9)
    assert len(t) == len(with_it) == len(without)
    _, _, with_it = gallery.curves(EFFECTS["clock_error"](2.0, 1.0), duration=0.02)
    assert not np.allclose(with_it[-1], with_it[-2], atol=1e-9)


def test_a_picture_shows_what_changes_and_its_whole_title():
    """An effect of two per cent hides on the curves; its difference stands beside them, on a scale of its own."""
    effect = EFFECTS["foot_defects"].typical()
    figure = gallery.picture(effect, duration=0.02)
    _, four, eight = gallery.curves(effect, duration=0.02)
    left, right = figure.axes[0::2], figure.axes[1::2]
    for i in range(3):
        assert np.array_equal(right[i].lines[0].get_ydata(), eight[:, i] - four[:, i])
    assert left[0].lines[0].get_label() == "without (four points)"
    title = figure.get_suptitle()
    assert title.replace("\n", " ") == gallery.words(effect).replace(",", ", ")
    assert max(map(len, title.split("\n"))) <= gallery.TITLE


def test_words_are_what_the_command_line_reads():
    assert gallery.words(EFFECTS["cable_restraint"](5.0, 0.3)) == "cable_restraint:k=5,c=0.3"
    assert gallery.words(EFFECTS["gyro_bandwidth"].typical()) == "gyro_bandwidth:frequency=40"


def test_pictures_are_drawn_once(tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr(gallery, "write_picture", lambda effect, path: (drawn.append(effect.id), path.write_text("")))
    MAKER.write_pictures(tmp_path / "effects")
    MAKER.write_pictures(tmp_path / "effects")
    assert sorted(drawn) == sorted(EFFECTS)
