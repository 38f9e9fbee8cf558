"""The effects, one after another: what each says of itself, and a picture of the crv with and without it.

The command `rockref effects`, and the page of the documentation (`docs/make_gallery.py`), are made from here.
"""

from __future__ import annotations

import inspect
import math
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from rockref import api
from rockref.effects.base import HOOKS, POSITIVE, Effect, Quantity, in_json
from rockref.effects.catalogue import OF_TOSSES, measured
from rockref.effects.sensor.clock_error import ClockError
from rockref.model.channel import DEGREES
from rockref.model.storage import write_bytes
from rockref.report.charts import style
from rockref.report.charts.figures import new_figure, rendered

#: What each question asks, as a heading.
TITLES = {
    "contact": "How does the plate push back?",
    "friction": "How does the plate hold the feet?",
    "shape": "What is the block?",
    "loads": "What else pulls and pushes?",
    "support": "What does the plate stand on?",
    "release": "How does the block start?",
    "sensor": "What does the gyroscope make of it?",
}
#: Where effects act that change no term of the step.
WHERE_POSES_ARE_READ = "measured poses, where they become poses of the body over the plate"
#: The heading of what only tosses know.
TOSSES = "What else shows in measured tosses?"
#: The effect that makes eight points of four: it is shown on, and needs, the four-point model.
ON_FOUR_POINTS = "foot_defects"
#: Characters in a line of a picture's title; decided: what fits above it in letters of eight points.
TITLE = 110
#: Pictures last until a little after the second main impact [s], while one can still follow both curves.
DURATION = 1.5


def acts_at(kind: type[Effect]) -> list[str]:
    """Return names of the hooks that the effect overrides, in the order of the step."""
    return [name for name in HOOKS if getattr(kind, name) is not getattr(Effect, name)]


def card(kind: type[Effect]) -> dict[str, Any]:
    """Return what an effect says of itself, in plain text and numbers."""
    parameters = {
        name: {
            "meaning": q.meaning,
            "unit": q.unit,
            "absent": in_json(q.absent),
            "typical": in_json(q.typical),
            "plausible": [in_json(q.low), in_json(q.high)],
            "sign": q.sign,
            "sign_in_words": sign_in_words(kind, name),
            "allowed": allowed(q),
        }
        for name, q in kind.quantities.items()
    }
    return {
        "id": kind.id,
        "question": kind.question,
        "sentence": kind.sentence,
        "form": inspect.cleandoc(kind.__doc__ or ""),
        "equation": kind.equation,
        "source": kind.source,
        "parameters": parameters,
        "acts_at": acts_at(kind),
        "confounder": kind.confounder,
        "experiment": kind.experiment,
        "example": words(kind.typical()),
        "command": command(kind.typical()),
    }


def sign_in_words(kind: type[Effect], name: str) -> str:
    """Return on which side of its absent value a parameter is physical."""
    q = kind.quantities[name]
    finite = q.absent is not None and math.isfinite(q.absent)
    if q.sign == "+":
        brings_in = kind.switches is None or name in kind.switches
        return f"physical only above {q.absent:g}" if brings_in and finite else "positive"
    if finite and q.least == q.absent:
        return f"{q.absent:g} or more"
    if finite and q.most == q.absent:
        return f"{q.absent:g} or less"
    if q.least >= 0:
        return f"on either side of {q.absent:g}" if finite else "of any size"
    return "of either sign"


def allowed(q: Quantity) -> str:
    """Return what is not refused, in words: the hard limits."""
    least = "above 0" if q.least == POSITIVE else f"at least {q.least:g}" if math.isfinite(q.least) else ""
    most = f"at most {q.most:g}" if math.isfinite(q.most) else ""
    return ", ".join(part for part in (least, most) if part) or "all finite numbers"


def command(effect: Effect) -> str:
    """Return what to type to use the effect: of what only tosses know a fit, else a simulation, with the model it
    needs."""
    if effect.id in OF_TOSSES:
        return f"rockref fit FOLDER_OF_TOSSES --effect {effect.id}"
    model = "four_points " if effect.id == ON_FOUR_POINTS else ""
    return f"rockref simulate {model}--effect {words(effect)}"


def words(effect: Effect) -> str:
    """Return the effect as it is written on the command line; what stands at its absent value needs no word."""
    shown = {name: value for name, value in effect.values().items() if value != effect.quantities[name].absent}
    values = ",".join(f"{name}={value:g}" for name, value in shown.items())
    return f"{effect.file or effect.id}:{values}" if values else effect.file or effect.id


def curves(
    effect: Effect, duration: float = DURATION, progress: Callable[[float], None] | None = None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return times (N,) [s], and crv (N, 3) [deg/s] without and with the effect, for the block of Table 3.1.

    `foot_defects` is shown against the four-point model, to which it belongs. A clock that is slow shows more of the
    motion in the same time: it is simulated for that much longer.
    """
    base = api.Model.four_points() if effect.id == ON_FOUR_POINTS else api.Model.table_3_1()
    without = api.simulate(base, duration=duration, engine="auto")
    longer = max(duration, float(effect.true_time(np.array(duration)))) if isinstance(effect, ClockError) else duration
    with_it = api.simulate(base.replace(effects=(effect,)), duration=longer, engine="auto", progress=progress)
    shown = measured([effect], with_it.t, with_it.W)[: len(without.t)]
    return without.t, without.W * DEGREES, shown * DEGREES


def picture(effect: Effect, duration: float = DURATION, progress: Callable[[float], None] | None = None) -> Any:
    """Return a figure: the three rates, without the effect in grey and with it in colour; beside them what it
    changes."""
    t, without, with_it = curves(effect, duration, progress)
    figure = new_figure(9.6, 5.6)
    axes = figure.subplots(3, 2, sharex=True, width_ratios=(5, 3))
    law = "without (four points)" if effect.id == ON_FOUR_POINTS else "without"
    for row, name, a, b in zip(axes, style.AXIS_NAMES, without.T, with_it.T, strict=True):
        row[0].plot(t, a, color=style.GREY, linewidth=0.9, label=law)
        row[0].plot(t, b, color=style.colour(0), linewidth=0.9, label="with")
        row[1].plot(t, b - a, color=style.colour(1), linewidth=0.9)
        row[0].set_ylabel(f"{name}\n(deg/s)", fontsize=9)
        for ax in row:
            ax.margins(y=0.08)
            ax.axhline(0.0, color=style.BAND, linewidth=0.6, zorder=0)
            ax.set_xlim(0.0, float(t[-1]))
    for ax in axes[-1]:
        ax.set_xlabel("time (s)")
    axes[0, 0].legend(loc="upper right", ncols=2, frameon=False, fontsize=8)
    axes[0, 1].set_title("with minus without", fontsize=8)
    title = textwrap.wrap(words(effect).replace(",", ", "), TITLE, break_on_hyphens=False)
    figure.suptitle("\n".join(title), fontsize=8, x=0.02, ha="left")
    return figure


def write_picture(
    effect: Effect, path: Path, duration: float = DURATION, progress: Callable[[float], None] | None = None
) -> None:
    """Write the picture as .png or .svg, whole or not at all. Raises InputError (E-WRITE)."""
    write_bytes(path, rendered(picture(effect, duration, progress), path.suffix.lstrip(".").lower()))


def value_text(value: float | str | None) -> str:
    """Return a value of a parameter as it is shown: six digits; None is the top of the block."""
    return "the top" if value is None else value if isinstance(value, str) else f"{value:g}"
