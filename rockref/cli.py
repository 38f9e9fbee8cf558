"""The command line: ``rockref COMMAND ...``.

Exit codes: 0 fine, 1 falls short of what was asked, 2 unusable input, 130 interrupted.
"""

import os
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import Annotated

import typer

from rockref import __version__, commands
from rockref.commands._help import FullHelp
from rockref.commands._terminal import show_what_can_be_shown
from rockref.model.errors import Interrupted, RockrefError

# What is kept of a command that was interrupted, and what goes on from it; of the others nothing is.
KEPT = {
    "blind make": "Finished cases are kept: the same command goes on with the next one.",
    "blind score": "Verdicts that were reached are kept: the same command goes on with the next case.",
}


def application() -> typer.Typer:
    """Return the Typer application with every command of :data:`rockref.commands.COMMANDS`."""
    # Plain help (no rich markup): half the start-up time, and examples keep their line breaks.
    app = typer.Typer(
        name="rockref",
        cls=FullHelp,
        no_args_is_help=True,
        add_completion=False,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110},
    )
    app.callback()(_top)
    for name, place in commands.COMMANDS.items():
        folder, _, function = place.partition(".")
        module = import_module(f"rockref.commands.{folder}")
        command = getattr(module, function)
        if isinstance(command, typer.Typer):
            app.add_typer(command, name=name)
        else:
            app.command(name, cls=getattr(module, "Command", None))(command)
    return app


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line (`arguments`, or those of the process) and end with :class:`SystemExit`."""
    show_what_can_be_shown()
    try:
        application()(args=None if arguments is None else list(arguments))
    except RockrefError as error:
        _stop(str(error), 130 if isinstance(error, Interrupted) else 2)
    except (KeyboardInterrupt, SystemExit) as end:
        # Typer makes a silent exit of an interruption.
        if isinstance(end, SystemExit) and end.code != 130:
            raise
        _stop(f"interrupted. {kept_of(sys.argv[1:] if arguments is None else arguments)}", 130)
    except OSError as error:
        where = os.fsdecode(error.filename) if error.filename is not None else "input or output"
        _stop(f"{where}: {error.strerror or error}. Nothing was left half-written. [E-OS]", 2)
    finally:
        # Only commands that compute have compiled anything.
        compiled = sys.modules.get("rockref.engines.on_disk")
        for remark in getattr(compiled, "not_kept", ())[:1]:
            print(f"rockref: {remark}", file=sys.stderr)


def kept_of(arguments: Sequence[str]) -> str:
    """Return what an interrupted command has kept, and what goes on from it."""
    words = [word for word in arguments if not word.startswith("-")][:2]
    kept = KEPT.get(" ".join(words)) or KEPT.get(words[0] if words else "")
    return kept or "No file is half-written, and nothing is kept of what was being computed: start it again."


def _stop(message: str, code: int) -> None:
    print(f"rockref: {message}", file=sys.stderr)
    raise SystemExit(code)


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"rockref {__version__}")
        raise typer.Exit()


def _top(
    show_version: Annotated[
        bool, typer.Option("--version", help="Print the version and stop.", callback=_print_version, is_eager=True)
    ] = False,
) -> None:
    """Simulate a rocking block, judge other simulators of it, and find the physical effect that a model of it lacks.

    \b
    To see it once:
      rockref demo
    With records of your own block:
      rockref new my_block logs/*.csv --mass 54kg --width 100mm --height 688mm
      rockref compare my_block
      rockref diagnose my_block --report report

    Each command says at its end what to type next; `rockref COMMAND --help` shows what it does, with an example.
    """
