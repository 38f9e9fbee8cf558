"""`rockref doctor`: what this machine is, and whether its arithmetic is the one that the bits are promised for."""

import json

import typer

from rockref.commands._options import AsJson

PLAIN = "The arithmetic is plain IEEE 754: runs have the bits of the shipped vectors."
OTHER = "The arithmetic is not plain IEEE 754: runs differ in their last bits; compare by error bars."


def doctor(
    as_json: AsJson = False,
) -> None:
    """Print the versions and the machine, and test its arithmetic (a few seconds).

    Exit code 1 if the arithmetic is not plain IEEE 754: then trajectories differ in bits from the shipped vectors.

    \b
    Example:
      rockref doctor
      rockref doctor --json > machine.json
    """
    from rockref.engines import machine

    facts = machine.describe()
    findings = machine.check_arithmetic()
    if as_json:
        typer.echo(json.dumps({"machine": facts, "arithmetic": findings}, indent=2))
    else:
        for name, value in {**facts, **findings}.items():
            typer.echo(f"{name:24} {_text(value)}")
        typer.echo(PLAIN if machine.is_sound(findings) else OTHER)
    if not machine.is_sound(findings):
        raise typer.Exit(1)


def _text(value: object) -> str:
    if value is None:
        return "not installed"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return " ".join(map(str, value)) if isinstance(value, list) else str(value)
