"""Write `docs/reference/commands.md` and `docs/reference/api.md` from the sources: ``python docs/make_reference.py``.

The commands with their options, from the command line itself; what `import rockref` gives, with signatures and
docstrings. A test compares both with what they would be now.
"""

from __future__ import annotations

import inspect
import re
from pathlib import Path
from typing import Any

import rockref

ROOT = Path(__file__).resolve().parents[1]
COMMANDS, API = ROOT / "docs/reference/commands.md", ROOT / "docs/reference/api.md"

HEAD_OF_COMMANDS = """# Commands

Written from the command line itself by `docs/make_reference.py`. `rockref COMMAND --help` prints the same. Exit codes:
0 fine, 1 the result falls short of what was asked, 2 input that cannot be used (told in a line with
[its code](errors.md)), 130 interrupted. Where a command has `--json`, it prints one object for machines
and nothing else on standard output.
"""

HEAD_OF_API = """# From Python

What `import rockref` gives, written from the code by `docs/make_reference.py`. It loads NumPy and nothing else. SI
units throughout; a leading `...` in a shape stands for axes of a batch. Further functions are imported from where they
live ([the house](../explanation/house.md) has the folders): their docstrings say shapes, units and errors in the same
way.

A model, a problem, its block, points and start, a response, an experiment and an ensemble show themselves: in a line
(`repr`), in words (`summary()`), in a table where a notebook shows them, and all but a start as a Matplotlib figure
(`plot()`).
"""


def cell(text: str) -> str:
    """A text for a cell of a table."""
    return re.sub(r"\s+", " ", text).replace("|", "\\|").replace("<", "&lt;").replace("[", "\\[").strip()


def section(name: str, command: Any) -> list[str]:
    """A command: what it does, its examples, its arguments and options."""
    text = inspect.cleandoc(command.help).replace("\b\n", "")
    said, _, rest = text.partition("Example:\n")
    examples, _, after = rest.partition("\n\n")
    lines = [f"## rockref {name}", "", f"{said.strip()}\n"]
    if after:
        lines += [f"{after.strip()}\n"]
    if examples:
        lines += ["```text", inspect.cleandoc(examples), "```", ""]
    lines += ["| argument, option | meaning | if left out |", "| --- | --- | --- |"]
    for given in command.params:
        if given.name != "help" and not getattr(given, "hidden", False):
            own = ", ".join(f"`{o}`" for o in (*given.opts, *given.secondary_opts))
            lines.append(f"| {own} | {cell(given.help or '')} | {default(given)} |")
    return [*lines, ""]


def default(given: Any) -> str:
    """What an option is where it is not given."""
    if given.required:
        return "refused"
    value = given.default
    if value is None or callable(value) or value == [] or value == ():
        return "–"
    return {True: "yes", False: "no"}[value] if isinstance(value, bool) else f"`{value}`"


def commands() -> dict[str, Any]:
    """All commands by name."""
    import typer.main

    from rockref import cli

    found = {}
    for name, command in typer.main.get_command(cli.application()).commands.items():  # type: ignore[attr-defined]
        # of a group, as `rockref blind`, its commands
        found |= {f"{name} {k}": c for k, c in getattr(command, "commands", {}).items()} or {name: command}
    return dict(sorted(found.items()))


def commands_page() -> str:
    """The page of the commands."""
    lines = [HEAD_OF_COMMANDS]
    for name, command in commands().items():
        lines += section(name, command)
    return "\n".join(lines)


def signature(thing: Any) -> str:
    """The parameters of a function or class."""
    text = re.sub(r"(: |-> )'([^']*)'", r"\1\2", str(inspect.signature(thing)))
    return text.replace("<factory>", "...")


def documented(name: str, thing: Any, level: int = 2) -> list[str]:
    """A class or function with its docstring, and the public methods of a class."""
    lines = [f"{'#' * level} {name.split('.')[-1]}", ""]
    if not (inspect.isclass(thing) and issubclass(thing, Exception)):
        lines += ["```python", f"{name}{signature(thing)}", "```", ""]
    lines += ["```text", inspect.getdoc(thing) or "", "```", ""]
    if inspect.isclass(thing) and not issubclass(thing, Exception):
        for key, own in vars(thing).items():
            function = getattr(own, "__func__", own)
            if not key.startswith("_") and inspect.isfunction(function):
                lines += documented(f"{name}.{key}", getattr(thing, key), level + 1)
            elif isinstance(own, property) and not key.startswith("_"):
                lines += [f"{'#' * (level + 1)} {key}", "", "```text", inspect.getdoc(own) or "", "```", ""]
    return lines


def api_page() -> str:
    """The page of the public names."""
    lines = [HEAD_OF_API]
    names = ["Model", "simulate", "Response"]
    for name in [*names, *(n for n in rockref.__all__ if n not in names and n != "__version__")]:
        lines += documented(f"rockref.{name}", getattr(rockref, name))
    return "\n".join(lines)


def write() -> None:
    """Write both pages where the site is built from."""
    COMMANDS.write_text(commands_page(), encoding="utf-8")
    API.write_text(api_page(), encoding="utf-8")


if __name__ == "__main__":
    write()
