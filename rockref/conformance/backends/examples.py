"""Backends to start from, as text: the tutorials in Python, in C and in JavaScript."""

from __future__ import annotations

from pathlib import Path

from rockref.model.errors import InputError

#: In the wheel they lie in the package, in the repository in `examples`.
PLACES = (Path(__file__).parent / "example_files", Path(__file__).resolve().parents[3] / "examples")
FILES = {"python": "backend_numpy.py", "c": "backend_c/backend.c", "javascript": "backend_js/backend.js"}


def source(language: str) -> str:
    """Return the text of a backend to start from. Raises InputError (E-ARGUMENT) for another language."""
    if language not in FILES:
        raise InputError("E-ARGUMENT", language, "has no example", f"Use one of {', '.join(FILES)}.")
    for place in PLACES:
        path = place / FILES[language]
        if path.is_file():
            return path.read_text(encoding="utf-8")
    raise InputError("E-ARGUMENT", language, "is not in this installation", "Install rockref anew.")
