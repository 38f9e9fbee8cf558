"""Write `docs/reference/effects_gallery.md` from the catalogue: ``python docs/make_gallery.py``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import rockref
from rockref.effects.base import Effect
from rockref.effects.catalogue import EFFECTS, OF_TOSSES, QUESTIONS
from rockref.report.views import gallery

PAGE = Path(__file__).resolve().parent / "reference" / "effects_gallery.md"
#: Small pictures in a row of the page's overview.
ABREAST = 4


def page() -> str:
    """Return the page of the documentation, in Markdown."""
    parts = [
        "# Effects",
        "What may be added to the law. `rockref effects NAME` prints the same; `rockref simulate --effect WORDS` and",
        "a model file use it. Pictures show the block of Table 3.1, without the effect in grey and with it, at its",
        "typical size, in colour; on the right is the difference, with minus without, on a scale of its own. For",
        "`foot_defects`, which makes eight points of four, grey is the four-point model. They are drawn when the site",
        "is built (`make docs`).",
        "",
        "*Absent* is the value at which a parameter changes nothing; *typical* the size at which an effect is shown,",
        "and at which a search begins; *plausible* the range outside which a value is used with a remark; beyond its",
        "hard limits it is refused. *Acts at* names the methods of [an effect's class](../howto/own_effect.md).",
    ]
    parts += ["", *thumbnails([kind.id for answers in QUESTIONS.values() for kind in answers[1:]])]
    for question, answers in QUESTIONS.items():
        parts += [
            "",
            f"## {gallery.TITLES[question]}",
            "",
            f"The law: {answers[0].sentence}",
            "",
            f"$${answers[0].equation}$$",
        ]
        for kind in answers[1:]:
            parts += ["", *section(kind), "", f"![crv with and without {kind.id}](effects/{kind.id}.png)"]
    parts += [
        "",
        f"## {gallery.TOSSES}",
        "",
        "A block that is released stands on its feet, and a gyroscope sees no pose.",
    ]
    for kind in OF_TOSSES.values():
        parts += ["", *section(kind)]
    return "\n".join(parts) + "\n"


def thumbnails(ids: Sequence[str]) -> list[str]:
    """Return the lines of a table of pictures, each a link to its effect, `ABREAST` in a row."""
    cells = [f"[![{id}](effects/{id}.png)](#{id}) {id}" for id in ids] + [""] * (-len(ids) % ABREAST)
    rows = ["| " + " | ".join(cells[k : k + ABREAST]) + " |" for k in range(0, len(cells), ABREAST)]
    return ["| " * ABREAST + "|", "| --- " * ABREAST + "|", *rows]


def section(kind: type[Effect]) -> list[str]:
    """Return one effect of the page, as lines."""
    about = gallery.card(kind)
    lines = [f"### {kind.id}", "", kind.sentence, "", f"$${kind.equation}$$", "", about["form"], ""]
    lines += ["| parameter | meaning | unit | absent | typical | plausible | sign; hard limits |", "| --- " * 7 + "|"]
    for name, p in about["parameters"].items():
        low, high = p["plausible"]
        sizes = [gallery.value_text(p["absent"]), gallery.value_text(p["typical"]), f"{low:g} to {high:g}"]
        cells = [f"`{name}`", p["meaning"], p["unit"], *sizes]
        lines.append("| " + " | ".join([*cells, f"{p['sign_in_words']}; {p['allowed']}"]) + " |")
    hooks = ", ".join(f"`{hook}`" for hook in about["acts_at"]) or gallery.WHERE_POSES_ARE_READ
    lines += ["", f"- Acts at: {hooks}."]
    lines += [f"- Most like it: [{kind.confounder}](#{kind.confounder}). What tells them apart: {kind.experiment}"]
    lines += [f"- Source: {kind.source}."]
    return [*lines, "", f"`{about['command']}`"]


def write_pictures(folder: Path) -> None:
    """Write the picture of every effect as id.png, where it is missing or older than the code that it shows."""
    folder.mkdir(parents=True, exist_ok=True)
    package = Path(rockref.__file__).parent
    shown = [*package.glob("model/*.py"), *package.glob("effects/**/*.py"), Path(gallery.__file__)]
    changed = max(path.stat().st_mtime for path in shown)
    for kind in EFFECTS.values():
        path = folder / f"{kind.id}.png"
        if not path.exists() or path.stat().st_mtime < changed:
            gallery.write_picture(kind.typical(), path)


def write() -> None:
    """Write the page where the site is built from."""
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    write()
