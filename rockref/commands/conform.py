"""`rockref conform`: judge a backend by the vectors, and say which equation is wrong."""

import json
import sys
from difflib import get_close_matches
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

from rockref.commands._options import AsJson

ACTIONS = ("exe", "export", "answer", "serve", "judge", "zoo", "example", "physics")


class Command(TyperCommand):
    """A command after whose `exe` a program stands with options of its own."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the words of the command line; those of the program are left to it."""
        own = {o for p in self.params for o in (*p.opts, *p.secondary_opts) if o.startswith("-")}
        return super().parse_args(ctx, parted(args, own | set(ctx.help_option_names)))


def parted(args: list[str], own: set[str]) -> list[str]:
    """Return words with "--" before the first option after `exe` that is not among `own`: from there on they are the
    program's. A long option that looks like a slip in writing one of ours is left for the parser to refuse."""
    if "exe" not in args or "--" in args:
        return args
    for i in range(args.index("exe") + 2, len(args)):
        name = args[i].partition("=")[0]
        if name.startswith("-") and name not in own:
            slip = name.startswith("--") and get_close_matches(name, own, cutoff=0.8)
            return args if slip else [*args[:i], "--", *args[i:]]
    return args


def conform(
    target: Annotated[str, typer.Argument(help="A backend, or one of the actions above.")] = "numpy",
    rest: Annotated[
        list[str] | None, typer.Argument(help="What the action takes: a program with its arguments, files, names.")
    ] = None,
    layers: Annotated[
        str | None, typer.Option(help="Layers to judge, of L0,L1,L2,L3,L4,L5s,LS,L5,L6,L7,LE. Default: all.")
    ] = None,
    profile: Annotated[
        str | None,
        typer.Option(help="float64, float32 or scheme (another integrator). Default: what the backend states."),
    ] = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="Leave out the long trajectories and the properties (L5, L6).")
    ] = False,
    as_json: AsJson = False,
    junit: Annotated[Path | None, typer.Option(help="Write JUnit XML to this file.")] = None,
    badge: Annotated[Path | None, typer.Option(help="Write a badge (SVG) to this file.")] = None,
    html: Annotated[Path | None, typer.Option(help="Write a page that shows where the trajectories part.")] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="File that export, answer, zoo, example or physics writes.")
    ] = None,
    timeout: Annotated[
        float, typer.Option(help="Seconds that a program (exe) has for a run; for a small question it has a sixtieth.")
    ] = 600.0,
    examples: Annotated[int, typer.Option(min=1, help="Examples drawn for each property of L6.")] = 50,
    colour: Annotated[
        bool | None, typer.Option("--colour/--no-colour", help="Colour the verdict. Default: on a terminal.")
    ] = None,
) -> None:
    """Judge a simulator of the block (a backend) by test vectors; name the first wrong rule and its equation.

    TARGET is a backend: numpy, numba, path/to/file.py:Class, package:Class or the name of an entry point; or

    \b
      exe PROGRAM        a program that reads and writes JSON lines
      export             write the questions to a file
      judge FILE         judge the answers in a file
      answer, serve      let a Python backend answer a file, or serve as a program
      example LANGUAGE   write a backend to start from: python, c or javascript
      physics ENGINE     judge an engine with a contact law of its own, by mechanics: mujoco, pybullet, ..., or a file
      zoo                test the judge itself with seeded faults

    Options of PROGRAM itself come after --. Exit code 1 if the backend falls short.

    \b
    Example:
      rockref conform
      rockref conform numba --html verdict.html
      rockref conform examples/backend_numpy.py:Backend --quick
      rockref conform exe ./backend --timeout 60
      rockref conform exe --quick python3 -u backend.py
      rockref conform export --output requests.jsonl
      rockref conform judge responses.jsonl --json
      rockref conform example c --output mine.c
      rockref conform zoo --json
      rockref conform physics mujoco
    """
    from rockref.commands._physics import physics
    from rockref.commands._results import usable_files, write_or_print
    from rockref.conformance.backends.examples import source
    from rockref.conformance.judge.findings import LAYERS
    from rockref.model.errors import InputError

    rest = rest or []
    if target not in ACTIONS and rest:
        raise InputError(
            "E-ARGUMENT",
            target,
            f"is followed by {rest[0]!r}",
            "Only exe, judge, answer, serve, example, physics take more arguments.",
        )
    # A bare "not timeout > 0" lets infinity pass, which is no limit and may be wanted, and not nan.
    if not timeout > 0.0:
        raise InputError("E-RANGE", "--timeout", f"is {timeout:g} s", "Give a positive number of seconds.")
    usable_files(junit, badge, html, output)
    chosen = _layers(layers, quick, LAYERS)
    if target == "zoo":
        _zoo(as_json, quick, output)
    elif target == "example":
        write_or_print(source(rest[0] if rest else "python"), output)
    elif target == "physics":
        physics(rest, as_json, quick, output, _progress if sys.stderr.isatty() and not as_json else None)
    elif target in ("export", "answer", "serve"):
        _files(target, rest, chosen, profile or "float64", output)
    else:
        backend, answered = _backend(target, rest, timeout)
        _judge(backend, [n for n in chosen if answered is None or n in answered], profile, as_json, colour, examples,
               {"junit": junit, "badge": badge, "html": html})  # fmt: skip


def _layers(layers: str | None, quick: bool, every: tuple[str, ...]) -> list[str]:
    from rockref.model.errors import InputError

    if layers is not None:
        names = [name.strip() for name in layers.split(",") if name.strip()]
        if not names:
            raise InputError("E-LAYER", "--layers", "is empty", f"Use some of {', '.join(every)}, or leave it out.")
        return names
    return [n for n in every if not (quick and n in ("L5", "L6"))]


def _backend(target: str, rest: list[str], timeout: float) -> tuple[Any, set[str] | None]:
    """Return the backend, and the layers to which it has answers (None: whatever it is asked)."""
    from rockref.conformance.backends.load import load
    from rockref.model.errors import InputError

    if target == "exe":
        from rockref.conformance.backends.executable import Executable

        if not rest:
            raise InputError("E-ARGUMENT", "exe", "no program is given", "rockref conform exe ./program [arguments].")
        return Executable(rest, small=max(timeout / 60, 1.0), long=timeout), None
    if target == "judge":
        from rockref.conformance.judge.offline import Recorded

        if len(rest) != 1:
            raise InputError("E-ARGUMENT", "judge", f"has {len(rest)} files", "rockref conform judge responses.jsonl.")
        recorded = Recorded(Path(rest[0]))
        return recorded, recorded.layers
    return load(target), None


def _judge(
    backend: Any,
    layers: list[str],
    profile: str | None,
    as_json: bool,
    colour: bool | None,
    examples: int,
    files: dict[str, Any],
) -> None:
    from rockref.commands._results import say_written
    from rockref.conformance.judge.findings import judge, used_profile
    from rockref.conformance.judge.verdict import as_json as in_json
    from rockref.conformance.judge.verdict import verdict
    from rockref.conformance.reports import terminal
    from rockref.conformance.reports.junit import junit
    from rockref.conformance.reports.page import badge
    from rockref.conformance.reports.page import page as page_of
    from rockref.model.storage import write_bytes

    show = sys.stderr.isatty() and not as_json
    try:
        findings = judge(backend, layers, used_profile(backend, profile), _progress if show else None, examples)
        found = verdict(findings, backend)
    finally:
        # Also where the judge is interrupted: a program has a group of its own, and would go on.
        if hasattr(backend, "close"):
            backend.close()
    if show:
        typer.echo("\r" + " " * 40 + "\r", nl=False, err=True)
    written: list[Path] = []
    for name, make in (("junit", junit), ("badge", badge), ("html", page_of)):
        if files[name] is not None:
            data = make(found)
            write_bytes(files[name], data if isinstance(data, bytes) else data.encode())
            written.append(files[name])
    if as_json:
        typer.echo(json.dumps(in_json(found), indent=1))
    else:
        say_written(written)
        typer.echo(terminal.text(found, sys.stdout.isatty() if colour is None else colour), nl=False, color=True)
    if not found.passed:
        raise typer.Exit(1)


def _progress(layer: str, share: float) -> None:
    typer.echo(f"\r{layer:4} {share:4.0%}", nl=False, err=True)


def _files(action: str, rest: list[str], layers: list[str], profile: str, output: Path | None) -> None:
    from rockref.commands._results import write_or_print
    from rockref.conformance.backends import json_lines
    from rockref.conformance.backends.load import load
    from rockref.conformance.judge import offline
    from rockref.model.errors import InputError

    if action == "serve":
        json_lines.serve(load(rest[0] if rest else "numpy"))
        return
    if action == "export":
        made = offline.text(layers, profile)
    else:
        if len(rest) != 2:
            raise InputError(
                "E-ARGUMENT", "answer", f"has {len(rest)} arguments", "rockref conform answer BACKEND requests.jsonl."
            )
        backend = load(rest[0])
        made = "".join(json_lines.line(json_lines.answer(backend, q)) for q in offline.requests_in(Path(rest[1])))
    write_or_print(made, output)


def _zoo(as_json: bool, quick: bool, output: Path | None) -> None:
    from rockref.conformance.faults.run import falls_short, run_zoo
    from rockref.conformance.faults.table import in_csv, in_words, page, rows
    from rockref.model.storage import write_text

    found = run_zoo(black_box=not quick, progress=_progress if sys.stderr.isatty() and not as_json else None)
    if output is not None:
        write_text(output, in_csv(rows(found)) if output.suffix == ".csv" else page(rows(found)))
    typer.echo(json.dumps(found, indent=1) if as_json else in_words(found))
    if falls_short(found):
        raise typer.Exit(1)
