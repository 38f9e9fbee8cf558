"""What a terminal cannot show is replaced by what it can: never an error in the midst of a result."""

from __future__ import annotations

import codecs
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console

# decided: where no terminal sets a width, tables of seven columns fit without being cut.
WIDE = 120

#: What stands for a sign in a smaller alphabet; every other one becomes a question mark.
PLAIN = {
    "–": "-", "—": "-", "−": "-", "‑": "-", "…": "...", "±": "+-", "°": " deg", "∞": "inf", "µ": "u", "μ": "u",
    "×": "x", "·": "*", "√": "sqrt", "≈": "~", "≤": "<=", "≥": ">=", "²": "2", "³": "3", "⁻": "-", "→": "->",
    "α": "alpha", "β": "beta", "δ": "delta", "θ": "theta", "ξ": "xi", "Λ": "Lambda", "σ": "sigma", "ω": "omega",
    "“": '"', "”": '"', "‘": "'", "’": "'", "│": "|", "─": "-", "━": "-", "┃": "|",
}  # fmt: skip


def _replaced(error: UnicodeError) -> tuple[str, int]:
    """Return what is written for the signs that cannot be encoded, and where to go on."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return "".join(PLAIN.get(sign, "?") for sign in error.object[error.start : error.end]), error.end


codecs.register_error("rockref", _replaced)


def show_what_can_be_shown() -> None:
    """Let standard output and error replace what their encoding does not have."""
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        # The alphabet of UTF-8 has everything but halves of pairs, which come from names of files.
        if reconfigure is not None and stream.errors in ("strict", "backslashreplace"):
            reconfigure(errors="rockref")


def console() -> Console:
    """Return where words and tables go: standard output, as wide as the terminal, or WIDE where there is none."""
    from rich.console import Console

    return Console() if sys.stdout.isatty() else Console(width=WIDE)
