"""All effects by id."""

from __future__ import annotations

from typing import Any

from rockref.effects.base import Effect


def from_table(where: str, table: dict[str, Any]) -> tuple[Effect, ...]:
    """Effects from the [effects] table of a model file."""
    return ()
