"""Mistakes and variants as texts: changes of the tutorial backend, as it is or with another integrator."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from strangers import list_04, schemes
from strangers.list_01 import Mistake
from strangers.registry import STEPS

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SOURCE, SOURCE_C = EXAMPLES / "backend_numpy.py", EXAMPLES / "backend_c/backend.c"


def made(text: str, says: str) -> Any:
    """The backend of a text."""
    space: dict[str, Any] = {"__name__": "planted"}
    exec(compile(text, says, "exec"), space)
    return space["Backend"]()


def changed(text: str, says: str, *changes: tuple[str, str]) -> str:
    """The text with each change made at its one place."""
    for old, new in changes:
        assert text.count(old) == 1, f"{says}: {text.count(old)} places of {old!r}"
        text = text.replace(old, new)
    return text


def planted(mistake: Mistake, scheme: str | None = None) -> Any:
    """The tutorial backend, or the one with another integrator, with the mistake in it."""
    text = changed(with_step(scheme), mistake.says, (mistake.old, mistake.new), *mistake.more)
    return made(text, mistake.says)


def with_step(scheme: str | None) -> str:
    """The tutorial's text, as it is or with another integrator."""
    text = SOURCE.read_text()
    if scheme is None:
        return text
    if scheme in schemes.SCHEMES:
        return schemes.exchanged(text, scheme)
    return list_04.exchanged(text, STEPS[scheme])
