"""`rockref effects`: what may be added to the law."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from rockref.effects.base import Effect


def effects(
    name: Annotated[
        str | None, typer.Argument(help="An effect: id, id:key=value, or path/to/file.py:Class. Without it, the list.")
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option(
            "--picture", "-p", help="Draw the body rates with and without the effect, to a .png or .svg file."
        ),
    ] = None,
    duration: Annotated[float, typer.Option(help="Seconds that the picture shows.")] = 1.5,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of lines.")] = False,
) -> None:
    """List the effects that may be missing, or show one: equation, source, parameters, confounder, and a picture.

    \b
    Example:
      rockref effects
      rockref effects quadratic_drag
      rockref effects gyro_scale:x=1.05 --picture scale.png
      rockref effects examples/my_effect.py:EddyBrake
    """
    from rockref.commands._models import say_implausible
    from rockref.commands._results import usable_files
    from rockref.effects.catalogue import OF_TOSSES, QUESTIONS, parse
    from rockref.effects.nothing_added import TrackedAsDrawn
    from rockref.model.errors import InputError
    from rockref.report.views import gallery

    if name is None:
        if picture is not None:
            raise InputError("E-EFFECT", "--picture", "needs an effect", "Write rockref effects NAME --picture FILE.")
        if as_json:
            kinds = [kind for answers in QUESTIONS.values() for kind in answers[1:]]
            typer.echo(json.dumps([gallery.card(kind) for kind in (*kinds, *OF_TOSSES.values())], indent=2))
            return
        for question, answers in QUESTIONS.items():
            typer.echo(f"{question}: {gallery.TITLES[question]}")
            for kind in answers:
                typer.echo(f"  {kind.id:24} {kind.sentence}")
        typer.echo(f"tosses: {gallery.TOSSES}")
        tosses: list[type[Effect]] = [TrackedAsDrawn, *OF_TOSSES.values()]
        for kind in tosses:
            typer.echo(f"  {kind.id:24} {kind.sentence}")
        return
    if picture is not None and picture.suffix.lower() not in (".png", ".svg"):
        raise InputError("E-SUFFIX", str(picture), "is no kind of picture", "End its name in .png or .svg.")
    usable_files(picture)
    effect = parse(name, "effects")
    say_implausible([effect], f"effects {name}")
    typer.echo(json.dumps(gallery.card(type(effect)), indent=2) if as_json else text(effect))
    if picture is not None:
        from rockref.commands._progress import progress

        with progress("simulating") as report:
            gallery.write_picture(effect, picture, duration, report)
        if not as_json:
            typer.echo(f"wrote        {picture}")


def text(effect: "Effect") -> str:
    """Return what is shown of an effect, as lines."""
    from rockref.effects.catalogue import OF_TOSSES
    from rockref.report.views import gallery

    about = gallery.card(type(effect))
    asked = about["question"] + (", tosses only" if effect.id in OF_TOSSES else "")
    lines = [f"{about['id']} ({asked})", "", about["sentence"], "", about["form"], ""]
    lines += [f"equation     {about['equation']}", f"source       {about['source']}", "parameters"]
    for key, p in about["parameters"].items():
        low, high = p["plausible"]
        unit = "" if p["unit"] == "1" else f" {p['unit']}"
        here = gallery.value_text(getattr(effect, key))
        absent = gallery.value_text(p["absent"]) + (unit if p["absent"] is not None else "")
        lines.append(f"  {key:12} {p['meaning']}")
        lines.append(f"  {'':12} absent {absent}; plausible {low:g} to {high:g}{unit}; here {here}")
        lines.append(f"  {'':12} {p['sign_in_words']}; allowed is {p['allowed']}{unit}")
    lines += [
        f"acts at      {', '.join(about['acts_at']) or gallery.WHERE_POSES_ARE_READ}",
        f"confounder   {about['confounder']}",
    ]
    lines += [f"told apart   {about['experiment']}", f"to use it    {gallery.command(effect)}"]
    if effect.id not in OF_TOSSES:
        lines.append(f"to see it    rockref effects {gallery.words(effect)} --picture {effect.id}.png")
    return "\n".join(lines)
