"""One sentence about a comparison, and the words that sentences share."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from rockref.discover.compare.models import Comparison


@dataclass(frozen=True)
class Finding:
    """One sentence, what kind it is of (stable), which model it is about (None: several), and its numbers in SI."""

    kind: str
    model: str | None
    text: str
    values: dict[str, Any] = field(default_factory=dict)


def finding(c: Comparison, model: int, kind: str, text: str, **values: Any) -> list[Finding]:
    """Return a list of one finding about the model at this place."""
    return [Finding(kind, c.names[model], text, values)]


def listed(words: list[str]) -> str:
    """Return "a, b and c"."""
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def factor_words(factor: float) -> str:
    """Return "2.0 % larger" for 1.02."""
    return f"{100 * abs(factor - 1.0):.1f} % {'larger' if factor > 1.0 else 'smaller'}"
