"""Putting a vector's question to a backend."""

from __future__ import annotations

from typing import Any

from rockref.conformance.vectors import Vector, problem_of

#: What a backend may raise in place of answering: it is a stranger's, and may even ask to end the program.
ANYTHING = (Exception, SystemExit)


#: Characters that are kept of a stranger's words; decided.
KEPT = 200


def printable(words: object) -> str:
    """Return a stranger's words for a verdict: not too long, and without what a terminal obeys or a file cannot
    hold."""
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in str(words)[:KEPT])


def raised(error: BaseException) -> str:
    """Return what a backend raised, in a line."""
    return printable(f"{type(error).__name__}: {error}".splitlines()[0])


def as_mapping(answer: Any, piece: str) -> dict[str, Any]:
    """Return a piece's answer as a mapping: a dict, or an object with attributes."""
    if isinstance(answer, dict):
        return answer
    if piece == "simulate":
        return {k: getattr(answer, k, None) for k in ("t", "W", "x", "Lambda", "F", "anchored")}
    if hasattr(answer, "_asdict"):
        return dict(answer._asdict())
    return dict(vars(answer))


def has(backend: Any, piece: str) -> bool:
    """Return whether a backend shows a piece."""
    return callable(getattr(backend, piece, None))


def ask(backend: Any, vector: Vector) -> dict[str, Any]:
    """Return the backend's answer to a vector. What the backend raises goes through."""
    if vector.piece in ("step", "simulate"):
        answer = getattr(backend, vector.piece)(problem_of(vector.inputs))
    else:
        answer = getattr(backend, vector.piece)(**vector.inputs)
    return as_mapping(answer, vector.piece)
