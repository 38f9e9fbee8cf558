"""An equation in TeX as a picture inside a page, whose reader has no TeX and may have no network."""

from __future__ import annotations

from html import escape

import numpy as np

#: Height of the letters [pixels]; decided: that of the text around it, and some more for indices.
SIZE = 17.0
#: Room around the letters [pixels], for lines that stand on the edge.
EDGE = 2.0
#: For each code of a matplotlib path the letter that SVG has for it, and how many vertices belong to it.
COMMANDS = {1: ("M", 1), 2: ("L", 1), 3: ("Q", 2), 4: ("C", 3), 79: ("Z", 1)}


def equation_svg(tex: str) -> str:
    """Return SVG of an equation in the colour of the text; empty where matplotlib's mathtext cannot read it.

    The TeX is in it as its label, for readers who do not see.
    """
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import TextPath

    try:
        path = TextPath((0.0, 0.0), f"${tex}$", size=SIZE, prop=FontProperties(math_fontfamily="stix"))
    except (ValueError, AttributeError):  # the second of matplotlib 3.11, for what has nothing to be drawn
        return ""
    if not len(path.vertices):
        return ""
    box = path.get_extents()
    width, height = box.width + 2 * EDGE, box.height + 2 * EDGE
    # Downwards, as SVG counts.
    points = (np.asarray(path.vertices) - (box.x0, box.y1)) * (1.0, -1.0) + EDGE
    return (
        f'<svg class="equation" role="img" aria-label="{escape(tex)}" width="{width:.0f}" height="{height:.0f}" '
        f'viewBox="0 0 {width:.1f} {height:.1f}"><path fill="currentColor" d="{outline(points, path.codes)}"/></svg>'
    )


def outline(points: np.ndarray, codes: np.ndarray) -> str:
    """Return the path of an SVG from vertices (N, 2) and matplotlib's code of each."""
    words, i = [], 0
    while i < len(codes):
        letter, count = COMMANDS[int(codes[i])]
        # What closes a shape has a vertex that says nothing.
        own = () if letter == "Z" else points[i : i + count]
        words.append(letter + " ".join(f"{x:.2f} {y:.2f}" for x, y in own))
        i += count
    return "".join(words)
