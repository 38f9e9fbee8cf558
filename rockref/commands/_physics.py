"""What `rockref conform physics` does."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import typer


def physics(
    engines: list[str], as_json: bool, quick: bool, output: Path | None, progress: Callable[[str, float], None] | None
) -> None:
    """Judge physics engines by what every rigid body on a plate has to do; exit code 1 where one falls short.

    Raises InputError: E-ARGUMENT without an engine; E-BACKEND for an unknown one; E-ENGINE for one that is not
    installed.
    """
    from rockref.conformance.physics.adapter import KNOWN, load
    from rockref.conformance.physics.in_words import text
    from rockref.conformance.physics.page import page
    from rockref.conformance.physics.profile import falls_short, judge_engine
    from rockref.model.errors import InputError
    from rockref.model.storage import write_text

    if not engines:
        cure = f"Name one of {', '.join(KNOWN)}, a file with a function run, or example."
        raise InputError("E-ARGUMENT", "physics", "no engine is given", cure)
    if engines[0] == "example":
        example(output)
        return
    adapters = [load(name) for name in engines]
    for adapter in adapters:
        why = adapter.absence()
        if why is not None:
            raise InputError(
                "E-ENGINE", adapter.target, f"does not run here: {why}"[:200], "Install it, or name another."
            )
    profiles: list[dict[str, Any]] = [judge_engine(adapter, quick, progress) for adapter in adapters]
    if output is not None:
        write_text(output, page(profiles, {}))
    if as_json:
        typer.echo(json.dumps(profiles, indent=1))
    else:
        typer.echo("\n".join(text(profile) for profile in profiles), nl=False)
    if any(falls_short(profile) for profile in profiles):
        raise typer.Exit(1)


def example(output: Path | None) -> None:
    """Write the adapter to start from."""
    import inspect

    from rockref.commands._results import write_or_print
    from rockref.conformance.physics.adapters import own_engine

    write_or_print(inspect.getsource(own_engine), output)
