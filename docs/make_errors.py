"""Write `docs/reference/errors.md` from the sources: ``python docs/make_errors.py``.

Every error and every remark of rockref has a code, which stays what it is from version to version. The page lists them
all, with what they say and what to do, as found in the calls that make them.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "reference" / "errors.md"
CODE = re.compile(r"[EW](-[A-Z]+)+")

HEAD = """# Errors and remarks

Every error ends with its code in brackets, for example `[E-KEY]`. It names the place (file, and line, column or key; or
the argument), what is wrong with the value that was found, and what to do. On the command line it goes to standard
error, the exit code is 2, and no output has been written. In Python it is a `rockref.InputError`, or for `E-NAN` a
`rockref.model.errors.NumericalError`, with the attributes `code`, `where`, `what` and `cure`.

Codes that begin with `W-` are remarks: the input was used, and something about it was noticed.

A code keeps its meaning from version to version; the words may change. Words in braces stand for what was found or
for what is allowed. This page is made from the code by `docs/make_errors.py`.
"""


class Said(NamedTuple):
    """What a code says at one place of the code: folder or file, what is wrong, what to do."""

    code: str
    place: str
    what: str
    cure: str


def words(node: ast.expr) -> str | None:
    """The text of an expression, with `{}` around what is put in; None where it has no text of its own."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        parts = []
        for part in node.values:
            if isinstance(part, ast.Constant):
                parts.append(str(part.value))
            elif isinstance(part, ast.FormattedValue):
                inside = words(part.value)
                parts.append(inside if inside is not None else "{" + (stands_for(part.value) or "…") + "}")
        return "".join(parts)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        left, right = words(node.left), words(node.right)
        return None if left is None and right is None else (left or "{…}") + (right or "{…}")
    if isinstance(node, ast.IfExp):
        return words(node.body) or words(node.orelse)
    if isinstance(node, ast.Subscript):  # a text cut to a length
        return words(node.value)
    return None


#: Words for names that say little to who does not read the code.
SAID = {"e": "error", "__name__": "kind", "__dataclass_fields__": "names", "strerror": "reason", "self": "…"}


def stands_for(node: ast.AST) -> str:
    """A word for what is put into a text: the first name in it; empty where there is none."""
    match node:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return SAID.get(name, name.lower())
        case ast.Call(func=ast.Name(id="len")):
            return "n"
        case ast.Call(args=[first, *_]):
            return stands_for(first)
        case ast.Call(func=ast.Attribute(value=whose)):
            return stands_for(whose)
        case ast.Constant():
            return ""
    return next((word for part in ast.iter_child_nodes(node) if (word := stands_for(part))), "")


def assigned(tree: ast.AST) -> list[tuple[int, str, str]]:
    """Line, variable and text of every assignment of a text."""
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign):
            for target in node.targets:
                pairs = [(target, node.value)]
                if isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple):
                    pairs = list(zip(target.elts, node.value.elts, strict=False))
                for name, value in pairs:
                    text = words(value)
                    if isinstance(name, ast.Name) and text:
                        found.append((node.lineno, name.id, text))
    return sorted(found)


def said_in(path: Path) -> list[Said]:
    """Every code of a file with its words."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    texts = assigned(tree)

    def text_of(node: ast.expr) -> str:
        """The text of an argument; of a variable, that of the last assignment above, or of the constant below."""
        if isinstance(node, ast.Name):
            same = [(line, text) for line, name, text in texts if name == node.id]
            above = [text for line, text in same if line <= node.lineno] or [text for _, text in same]
            return above[-1] if above else ""
        return words(node) or ""

    place = path.relative_to(ROOT).as_posix()
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr) and (
            whole := re.search(r": (.*?\.) (.*)\[(E-[A-Z]+)\]$", words(node) or "")
        ):
            found.append(Said(whole[3], place, whole[1], whole[2].strip()))
        if not isinstance(node, (ast.Call, ast.Tuple)):
            continue
        items = list(node.args) if isinstance(node, ast.Call) else list(node.elts)
        for at, item in enumerate(items):
            if isinstance(item, ast.Constant) and isinstance(item.value, str) and CODE.fullmatch(item.value):
                rest = [text_of(a) for a in items[at + 1 :]]
                # The order is code, where, what, cure; helpers leave out what they fill in themselves.
                what, cure = (rest[1], rest[2]) if len(rest) > 2 else (rest[0] if rest else "", "".join(rest[1:2]))
                found.append(Said(item.value, place, what, cure))
    return found


def everything() -> list[Said]:
    """What all of rockref may say, in the order of the codes."""
    found = [said for path in sorted((ROOT / "rockref").rglob("*.py")) for said in said_in(path)]
    return sorted(set(found), key=lambda said: (said.code[0] != "E", said))


def cell(text: str) -> str:
    """A text for a cell of a table."""
    return re.sub(r"\s+", " ", text).replace("|", "\\|").replace("<", "&lt;").replace("[", "\\[").strip() or "–"


def page() -> str:
    """The whole page."""
    lines = [HEAD]
    listed = everything()
    for code in dict.fromkeys(said.code for said in listed):
        rows = [said for said in listed if said.code == code]
        lines += [f"## {code}", "", "| what it says | what to do | said in |", "| --- | --- | --- |"]
        lines += [f"| {cell(s.what)} | {cell(s.cure)} | `{s.place}` |" for s in rows] + [""]
    return "\n".join(lines)


def write() -> None:
    """Write the page where the site is built from."""
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    write()
