"""Pieces of a long study: made once, made again for another budget, whole after any interruption."""

import json

import pytest

from rockref.jobs.checkpoints import Pieces
from tests.refusal import refused


def test_a_piece_is_made_once_and_again_for_another_budget(tmp_path):
    made = []

    def make():
        made.append(1)
        return {"n": len(made)}

    kept = Pieces(tmp_path, {"versions": 1})
    assert kept.once("a", make, {"budget": (1, 2)}) == kept.once("a", make, {"budget": (1, 2)}) == {"n": 1}
    assert kept.once("a", make, {"budget": (1, 3)}) == {"n": 2}
    assert Pieces(tmp_path, {"versions": 2}).once("a", make, {"budget": (1, 3)}) == {"n": 3}


def test_what_was_done_before_an_interruption_is_not_done_again(tmp_path):
    asked = []

    def make(keys):
        asked.append(list(keys))
        for i in reversed(range(len(keys))):
            if keys[i] == 2 and len(asked) == 1:
                raise KeyboardInterrupt
            yield i, {"key": keys[i]}

    kept = Pieces(tmp_path, {})
    with pytest.raises(KeyboardInterrupt):
        kept.each("p", [1, 2, 3, 4, 5], make)
    assert kept.each("p", [1, 2, 3, 4, 5], make) == [{"key": k} for k in (1, 2, 3, 4, 5)]
    assert asked == [[1, 2, 3, 4, 5], [1, 2]]
    assert all(json.loads(p.read_text())["schema"] for p in tmp_path.glob("*.json"))


def test_a_broken_piece_is_named(tmp_path):
    (tmp_path / "a.json").write_text("{")
    error = refused(Pieces(tmp_path, {}).once, "a", dict)
    assert error.code == "E-FILE" and "a.json" in error.where
