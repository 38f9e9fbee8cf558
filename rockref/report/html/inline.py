"""What a page carries inside: scripts and styles of the house, those of others with their licence, and data as JSON."""

from __future__ import annotations

import json
from importlib import resources
from typing import Any

#: decided: what every browser opens at once and every mailbox takes.
MAX_BYTES = 2_000_000


def asset(name: str) -> str:
    """Return the text of a file of the house."""
    return (resources.files("rockref.report.html") / "assets" / name).read_text(encoding="utf-8")


def vendored(name: str) -> str:
    """Return the text of a file of others, which travels with the package."""
    return (resources.files("rockref.report.html") / "vendor" / name).read_text(encoding="utf-8")


def plots() -> str:
    """Return the script that draws curves; the licence travels with the code."""
    return f"/*\n{vendored('uPlot.LICENSE')}*/\n{vendored('uPlot.iife.min.js')}"


def as_json(value: Any) -> str:
    """Return JSON that cannot end the script element that holds it."""
    return json.dumps(value, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
