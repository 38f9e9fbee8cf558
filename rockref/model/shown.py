"""What shows itself: in a line, in words, as a table of a notebook, as a picture."""

from __future__ import annotations

import html
from collections.abc import Callable
from typing import Any

import numpy as np

#: Draws what is shown. The law draws nothing: the top level says who does, see `draw_with`.
_painters: list[Callable[[Any], Any]] = []


def draw_with(painter: Callable[[Any], Any]) -> None:
    """Let `plot` of everything that is shown be done by a function, which returns a Matplotlib figure."""
    _painters[:] = [painter]


class Shown:
    """What says its facts: a short line, a summary, a table for notebooks, a picture."""

    def facts(self) -> dict[str, str]:
        """Return what a person wants to know first, in words with units, by its name."""
        raise NotImplementedError(f"{type(self).__name__} has no facts")

    def __repr__(self) -> str:
        """Return the facts in a line."""
        return f"<{type(self).__name__}: {', '.join(f'{name} {fact}' for name, fact in self.facts().items())}>"

    def summary(self) -> str:
        """Return the facts, a line each, as one would put them in an e-mail."""
        facts = self.facts()
        width = max(map(len, facts), default=0)
        return "\n".join([type(self).__name__, *(f"  {name:{width}}  {fact}" for name, fact in facts.items())])

    def plot(self) -> Any:
        """Return a Matplotlib figure. Raises InputError as whatever it is made of does."""
        return _painters[-1](self)

    def _repr_html_(self) -> str:
        """Return the facts as a small table, for a notebook; its colours are those of the page around it."""
        rows = "".join(
            "<tr style='background:none'><th style='text-align:left;font-weight:normal;opacity:0.7'>"
            f"{html.escape(name)}</th><td style='text-align:left'>{html.escape(fact)}</td></tr>"
            for name, fact in self.facts().items()
        )
        title = f"<caption style='text-align:left;font-weight:bold'>{html.escape(type(self).__name__)}</caption>"
        return f"<table style='color:inherit'>{title}<tbody>{rows}</tbody></table>"


def span(values: Any, unit: str = "", digits: int = 4) -> str:
    """Return numbers in words: one where all are equal, else the least and the largest; then the unit.

    >>> from rockref.model.shown import span
    >>> span([0.25, 0.25]), span([2.0, 1.0], "m")
    ('0.25', '1 to 2 m')
    """
    least, most = (f"{float(end):.{digits}g}" for end in (np.min(values), np.max(values)))
    return f"{least if least == most else f'{least} to {most}'} {unit}".rstrip()
