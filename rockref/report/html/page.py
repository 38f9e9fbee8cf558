"""One self-contained HTML page, built piece by piece: sections, sentences, tables, figures, curves, players.

Nothing is fetched: style, scripts and data are inside. Everything can be read without scripts; with them curves can be
zoomed and blocks move. Texts are escaped; only SVG made in this folder is taken as it is.
"""

from __future__ import annotations

import base64
import json
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any

from rockref.model.errors import InputError
from rockref.model.storage import write_bytes
from rockref.report.charts.equation import equation_svg
from rockref.report.html.curves import Curves
from rockref.report.html.inline import MAX_BYTES, as_json, asset, plots, vendored
from rockref.report.html.player import Player
from rockref.report.output import made_folder
from rockref.report.tables.table import Table


@dataclass
class Section:
    """A section of the page: ``title``, ``anchor`` (its id), ``blocks`` (kind and content, in order)."""

    title: str
    anchor: str
    blocks: list[tuple[str, Any]] = field(default_factory=list)


class Page:
    """A page under construction. The pieces appear in the order in which they are added.

    title, lead : heading and the one sentence below it.
    """

    def __init__(self, title: str, lead: str = "", *, lang: str = "en") -> None:
        self.title, self.lead, self.lang = title, lead, lang
        self.sections: list[Section] = []
        self.card: dict[str, Any] | None = None
        self._data: dict[str, Any] = {}

    def set_card(self, card: Any) -> None:
        """Put a card (`rockref.report.views.card.Card`) at the head; the sections are folded below it as evidence."""
        self.card = self._kept_card(card)

    def add_card(self, card: Any) -> None:
        """Add a card to the section."""
        self._add("card", self._kept_card(card))

    def _kept_card(self, card: Any) -> dict[str, Any]:
        return {"card": card, "id": None if card.trial is None else self._keep(card.trial.data())}

    def add_section(self, title: str, text: str | Sequence[str] = ()) -> Section:
        """Begin a section with paragraphs of text and return it; what is added next belongs to it."""
        base = re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-") or "section"
        taken = {s.anchor for s in self.sections}
        anchor = base if base not in taken else f"{base}-{len(taken) + 1}"
        self.sections.append(Section(title, anchor))
        self.add_text(*([text] if isinstance(text, str) else text))
        return self.sections[-1]

    def add_text(self, *paragraphs: str) -> None:
        """Add paragraphs."""
        for paragraph in paragraphs:
            self._add("text", paragraph)

    def add_equation(self, tex: str) -> None:
        """Add an equation, as a picture of itself; as its TeX where that cannot be drawn."""
        svg = equation_svg(tex)
        self._add("equation", svg) if svg else self.add_text(f"In TeX: {tex}")

    def add_heading(self, title: str) -> None:
        """Add a heading inside the section."""
        self._add("heading", title)

    def add_sentences(self, sentences: Sequence[str], title: str = "") -> None:
        """Add a list of sentences, under a small title if there is one."""
        self._add("sentences", {"title": title, "sentences": list(sentences)})

    def add_table(self, table: Table) -> None:
        """Add a table that is always open."""
        self._add("table", table)

    def add_figure(
        self, svg: str | bytes, sentence: str, table: Table | None = None, title: str = "", keys: str = ""
    ) -> None:
        """Add a figure: SVG text made here, or the bytes of a PNG. Every figure has a sentence that says what it shows.

        `table` holds its numbers and is folded; `keys` is a legend of :func:`rockref.report.charts.drawing.key`.
        """
        drawn = svg
        if isinstance(svg, bytes):
            data = base64.b64encode(svg).decode("ascii")
            drawn = f'<img alt="{escape(sentence)}" src="data:image/png;base64,{data}">'
        self._add("figure", {"svg": drawn, "sentence": sentence, "table": table, "title": title, "keys": keys})

    def add_curves(self, curves: Curves) -> None:
        """Add curves that can be zoomed; their static picture stands there until scripts run, and on paper."""
        self._add("curves", {"id": self._keep(curves.data), "curves": curves})

    def add_player(self, player: Player) -> None:
        """Add a block in motion."""
        self._add("player", {"id": self._keep(player.data), "player": player})

    def add_provenance(self, facts: Mapping[str, Any]) -> None:
        """Add where everything comes from: versions, hashes, options; nested values are written as JSON."""
        rows = [[name, value if isinstance(value, str) else json.dumps(value)] for name, value in facts.items()]
        self._add("table", Table("Provenance", ("what", "value"), rows, prose=True))

    def add_details(self, title: str, table: Table) -> None:
        """Add a folded table."""
        self._add("details", {"title": title, "table": table})

    def _add(self, kind: str, content: Any) -> None:
        if not self.sections:
            self.add_section("Summary")
        self.sections[-1].blocks.append((kind, content))

    def _keep(self, data: Any) -> str:
        name = f"data-{len(self._data) + 1}"
        self._data[name] = data
        return name

    def html(self) -> str:
        """Return the page as text."""
        import jinja2

        environment = jinja2.Environment(
            loader=jinja2.FunctionLoader(asset), autoescape=True, trim_blocks=True, lstrip_blocks=True
        )
        kinds = {kind for section in self.sections for kind, _ in section.blocks}
        cards = [self.card, *(b for section in self.sections for kind, b in section.blocks if kind == "card")]
        if any(card is not None and card["id"] is not None for card in cards):
            kinds.add("trial")
        return environment.get_template("page.html.j2").render(
            page=self,
            style=(vendored("uPlot.min.css") if kinds & {"curves", "trial"} else "") + asset("style.css"),
            scripts=_scripts(kinds),
            data={name: as_json(value) for name, value in self._data.items()},
        )

    def size(self) -> int:
        """Return how many bytes the page has so far."""
        return len(self.html().encode())

    def write(self, path: str | os.PathLike[str]) -> Path:
        """Write the page, whole or not at all, and return its path.

        Raises InputError: E-WRITE; E-PAGE-SIZE above 2 MB, before anything is written.
        """
        data = self.html().encode()
        if len(data) > MAX_BYTES:
            what = f"the page would have {len(data) / 1e6:.1f} MB, more than {MAX_BYTES / 1e6:g}"
            raise InputError("E-PAGE-SIZE", str(path), what, "Compare fewer runs or models on one page.")
        write_bytes(path, data)
        return Path(path)

    def write_into(self, folder: Path) -> Path:
        """Write the page as ``index.html`` into a folder, which is made if it is not there. Raises as `write`."""
        return self.write(made_folder(folder) / "index.html")


def _scripts(kinds: set[str]) -> list[str]:
    if not kinds & {"curves", "player", "trial"}:
        return []
    parts = ["packed.js"]
    for kind, names in (("trial", ["card.js"]), ("curves", ["curves.js"]), ("player", ["block.js", "player.js"])):
        parts += names if kind in kinds else []
    return [*([plots()] if kinds & {"curves", "trial"} else []), *map(asset, parts)]
