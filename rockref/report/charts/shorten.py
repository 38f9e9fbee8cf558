"""A Matplotlib SVG in fewer letters: what a page says once is left out of every element; it looks the same."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from html import escape

#: Left out: what the style sheet of the page says for a drawing, or what a browser takes where nothing is said.
UNSAID = {
    "stroke-linecap: butt", "stroke-linejoin: round", "stroke-opacity: 1", "fill-opacity: 1", "stroke-dashoffset: 0"
}  # fmt: skip
_NUMBER = re.compile(r"-?\d+\.?\d*(?:e-?\d+)?")


def shortened(svg: str) -> str:
    """Return the drawing inside an SVG file: no ids of groups, no fonts, tenths of a pixel, neighbours joined.

    Decided: a tenth of a pixel is not seen. A style is kept in the attribute, which outdoes the sheet of the page.
    """
    root = ET.fromstring(svg)
    return "".join(_joined(list(_flat(root))))


def _flat(parent: ET.Element) -> Iterator[tuple[str, str, str]]:
    """Yield every element below one as (head, path, tail): a path to be joined has its data between."""
    for element in parent:
        name = element.tag.rpartition("}")[2]
        attributes = {key.rpartition("}")[2]: value for key, value in element.attrib.items()}
        if name in ("metadata", "style") or (name == "defs" and not any(not _is_style(e) for e in element)):
            continue
        if name == "g":
            attributes.pop("id", None)
            inner = list(_flat(element))
            yield from [(_head("g", attributes), "", ""), *inner, ("</g>", "", "")] if attributes and inner else inner
        elif name == "path" and "id" not in attributes and "transform" not in attributes:
            if path := _path(attributes.pop("d", "")):  # one of which nothing is in view has none
                yield _head("path", {"d": "\0", **attributes}, "/"), path, ""
        elif name == "defs":
            yield "<defs>", "", ""
            yield from _flat(element)
            yield "</defs>", "", ""
        else:
            text = escape("".join(element.itertext()), quote=False).strip()
            yield _head(name, attributes, "" if text else "/"), "", f"{text}</{name}>" if text else ""


def _is_style(element: ET.Element) -> bool:
    return element.tag.endswith("style")


def _joined(parts: list[tuple[str, str, str]]) -> Iterator[str]:
    """Yield elements as text; neighbouring paths that look the same are one path, where overlaps cannot show."""
    for k, (head, path, tail) in enumerate(parts):
        if not path:
            yield head + tail
            continue
        before = k and parts[k - 1][0] == head and parts[k - 1][1] and _joins(head)
        after = k + 1 < len(parts) and parts[k + 1][0] == head and parts[k + 1][1] and _joins(head)
        opening, closing = head.split("\0")
        yield ("" if before else opening) + path + ("" if after else closing)


def _joins(head: str) -> bool:
    """Return whether paths with this head can be drawn as one: strokes alone, nothing seen through."""
    return "fill:none" in head and "opacity" not in head


def _head(name: str, attributes: dict[str, str], end: str = "") -> str:
    """Return the opening tag of an element."""
    shown = []
    for key, value in attributes.items():
        if key == "style":
            value = _style(value)
        elif key == "transform":
            # The number of a tick is turned by nothing.
            value = "" if value.startswith("rotate(-0 ") else _NUMBER.sub(lambda n: _tenths(n[0], 3), value)
        elif key in ("x", "y"):
            value = _tenths(value)
        elif key == "d" and value != "\0":
            value = _path(value)
        if value:
            shown.append(f' {key}="{escape(value)}"')
    return f"<{name}{''.join(shown)}{end}>"


def _style(text: str) -> str:
    """Return a style without the names of fonts, which the page has, and without what goes without saying."""
    rules = [rule.strip() for rule in text.split(";")]
    kept = [rule for rule in rules if rule and rule not in UNSAID and not rule.startswith("font-family")]
    kept = [re.sub(r"^font: ([\d.]+px).*", r"font-size:\1", rule).replace(": ", ":") for rule in kept]
    return re.sub(r"(?<=[:,])0(?=\.)", "", ";".join(kept))


def _path(d: str) -> str:
    """Return the data of a path in tenths of a pixel; a polyline goes from point to point by differences."""
    words = d.split()
    if not all(word in "MLCQzZ" or _NUMBER.fullmatch(word) for word in words):
        return " ".join(words)
    out, at, kind, k = [], (0, 0), "", 0
    while k < len(words):
        if words[k] in "MLCQzZ":
            kind = words[k]
            k += 1
            out.append("z" if kind in "zZ" else "")
            if kind in "zZ":
                continue
        n = {"M": 1, "L": 1, "C": 3, "Q": 2}[kind]
        places = [(_ten(words[k + 2 * j]), _ten(words[k + 2 * j + 1])) for j in range(n)]
        k += 2 * n
        if kind == "M":
            out.append(f"M{_pair(*places[0])}")
            kind = "L"
        elif kind == "L":
            out.append(_step(places[0][0] - at[0], places[0][1] - at[1]))
        else:
            steps = [_pair(x - at[0], y - at[1]) for x, y in places]
            out.append(
                kind.lower() + "".join(s if j == 0 or s.startswith("-") else f" {s}" for j, s in enumerate(steps))
            )
        at = places[-1]
    return "".join(out)


def _step(dx: int, dy: int) -> str:
    """Return a straight piece of a path, in tenths of a pixel."""
    return f"h{_number(dx)}" if dy == 0 else f"v{_number(dy)}" if dx == 0 else f"l{_pair(dx, dy)}"


def _pair(x: int, y: int) -> str:
    second = _number(y)
    return f"{_number(x)}{second if second.startswith('-') else ' ' + second}"


def _ten(word: str) -> int:
    return round(10.0 * float(word))


def _number(tenths: int) -> str:
    """Return tenths as a decimal number without needless zeros: 15 is 1.5, -3 is -.3."""
    text = f"{tenths / 10:.1f}".removesuffix(".0")
    return re.sub(r"^(-?)0(?=\.)", r"\1", text)


def _tenths(word: str, digits: int = 1) -> str:
    return f"{float(word):.{digits}f}".rstrip("0").rstrip(".") if "." in word else word
