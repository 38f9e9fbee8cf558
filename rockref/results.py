"""What the verbs of `import rockref` give back: a result that says, draws and saves itself."""

from __future__ import annotations

import html
import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

# decided: what fits an e-mail without breaking its lines.
WIDTH = 100


class Result:
    """What a verb found, with its words, its picture and its page.

    `found` is the object of the house itself; its attributes are those of the result, too.

    >>> from rockref.results import Result
    >>> said = Result("fit of my_block", {"loss": 1.0}, lambda: "A good fit.", found_dict=lambda: {"loss": 1.0})
    >>> said, said.summary(), said.to_dict()
    (<fit of my_block: A good fit.>, 'A good fit.', {'loss': 1.0})
    """

    def __init__(
        self,
        title: str,
        found: Any,
        words: Callable[[], str],
        *,
        found_dict: Callable[[], dict[str, Any]] | None = None,
        draw: Callable[[], Any] | None = None,
        page: Callable[[Path], Path] | None = None,
    ):
        self.title, self.found = title, found
        self._words, self._dict, self._draw, self._page = words, found_dict or found.to_dict, draw, page

    def __getattr__(self, name: str) -> Any:
        """Return what the object of the house has by this name."""
        if name.startswith("_") or name == "found":
            raise AttributeError(name)
        return getattr(self.found, name)

    def __repr__(self) -> str:
        """Return the title and the first line of the words."""
        first = next((line.strip() for line in self.summary().splitlines() if line.strip()), "")
        return f"<{self.title}: {first if len(first) <= WIDTH else first[: WIDTH - 3] + '...'}>"

    def summary(self) -> str:
        """Return what was found as one would put it in an e-mail."""
        return self._words().strip()

    def to_dict(self) -> dict[str, Any]:
        """Return what was found as plain numbers, lists and words, for JSON."""
        return self._dict()

    def plot(self) -> Any:
        """Return a Matplotlib figure. Raises InputError E-PLOT where the result has none."""
        if self._draw is None:
            raise _nothing("E-PLOT", self.title, "picture")
        return self._draw()

    def save_page(self, folder: Path | str) -> Path:
        """Write the page into a folder, which is made if it is not there, and return the page's path.

        Raises InputError: E-WRITE; E-PLOT where the result has no page.
        """
        if self._page is None:
            raise _nothing("E-PLOT", self.title, "page")
        return self._page(Path(folder))

    def _repr_html_(self) -> str:
        """Return the words, and the picture where there is one, for a notebook."""
        words = f"<pre style='white-space:pre-wrap'>{html.escape(self.summary())}</pre>"
        if self._draw is None:
            return words
        import base64

        buffer = io.BytesIO()
        self._draw().savefig(buffer, format="png", dpi=80)
        data = base64.b64encode(buffer.getvalue()).decode("ascii")
        return f"{words}<img alt='{html.escape(self.title)}' src='data:image/png;base64,{data}'>"


def _nothing(code: str, title: str, what: str) -> Exception:
    from rockref.model.errors import InputError

    return InputError(code, title, f"has no {what}", "Use summary() or to_dict().")


def printed(write: Callable[[Any], None]) -> str:
    """Return what a function prints to a console of WIDTH columns."""
    from rich.console import Console

    kept = io.StringIO()
    write(Console(file=kept, width=WIDTH, color_system=None))
    return "\n".join(line.rstrip() for line in kept.getvalue().splitlines())
