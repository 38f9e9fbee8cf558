"""What a function shows on a console, as text."""

from __future__ import annotations

import io
from collections.abc import Callable
from typing import Any

from rich.console import Console


def printed(show: Callable[..., None], *what: Any, width: int = 220, terminal: bool = False) -> str:
    """What `show(console, *what)` prints on a terminal of this width, or in a pipe."""
    out = io.StringIO()
    show(Console(file=out, width=width, force_terminal=terminal, color_system=None), *what)
    return out.getvalue()
