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
from rockref.commands._terminal import show_what_can_be_shown
from rockref.model.errors import RockrefError


def application() -> typer.Typer:
    """Return the Typer application with every command of :data:`rockref.commands.MODULES`."""
    # Plain help (no rich markup): half the start-up time, and examples keep their line breaks.
    app = typer.Typer(
        name="rockref",
        no_args_is_help=True,
        add_completion=False,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110},
    )
    app.callback()(_top)
    for name in commands.MODULES:
        import_module(f"rockref.commands.{name}").register(app)
    return app


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line (`arguments`, or those of the process) and end with :class:`SystemExit`."""
    show_what_can_be_shown()
    try:
        application()(args=None if arguments is None else list(arguments))
    except RockrefError as error:
        _stop(str(error), 2)
    except (KeyboardInterrupt, SystemExit) as end:
        # Typer makes a silent exit of an interruption.
        if isinstance(end, SystemExit) and end.code != 130:
            raise
        _stop("interrupted. No file is half-written; what has --resume goes on from where it was.", 130)
    except OSError as error:
        where = os.fsdecode(error.filename) if error.filename is not None else "input or output"
        _stop(f"{where}: {error.strerror or error}. Nothing was left half-written. [E-OS]", 2)
    finally:
        # Only commands that compute have compiled anything.
        compiled = sys.modules.get("rockref.engines.on_disk")
        for remark in getattr(compiled, "not_kept", ())[:1]:
            print(f"rockref: {remark}", file=sys.stderr)


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
    """The eight-point rocking block: simulate it, judge a backend by it, find the effect that it misses.

    `rockref COMMAND --help` shows what a command does, with an example.
    """
