"""Where each number stands in the flat arrays of the C text; writes `law/layout.h` from the catalogue and the compiled
engine.

`python -m rockref.lab.layout` writes the header anew. The page gets the same table as JSON, so that C, JavaScript and
Python read one list.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.effects.base import Effect
from rockref.effects.catalogue import EFFECTS
from rockref.engines.compiled import columns, slots
from rockref.model.errors import InputError
from rockref.model.storage import write_text

HEADER = Path(__file__).parent / "law" / "layout.h"

#: The numbers of a model, in their order; `inertia` has nine, all zero where the uniform cuboid's holds.
MODEL = tuple(
    "mass width depth height g foot_radius points K_N K_T beta_int beta_ext mu_int mu_ext delta_long_1 delta_long_2 "
    "delta_long_3 delta_long_4 delta_diag theta_0".split()
) + tuple(f"inertia_{i}" for i in range(9))

#: Names of `columns` that the C text uses.
OF_STATE = "X V L W_ A_ T_ GIVEN TIME ORIGIN COUNT Q Q_RATE PITCH PITCH_RATE STATE".split()
OF_BODY = "MASS GRAVITY J J_INVERSE PRINCIPAL BODY".split()
OF_POINTS = "K_N K_T C_N C_T MU_0 MU RADIUS FOOT PROPS".split()
OF_MEMORY = "S_X S_Y ANCHORED SLIDING XI_LARGEST YAW ROLL_X ROLL_Y MEMORY".split()
OF_SLOTS = (
    "HERTZ HYSTERESIS HUNT ORIENTATION STRIBECK LOAD ADHESION VISCOUS NORMALS SPIN ROLLING DRAG CABLE WIRE VIBRATION "
    "TILT SUPPORT OF_EFFECTS CONTACT FORCES MOMENTS LOADS PLATE"
).split()


def value_places() -> dict[str, dict[str, int]]:
    """Return, by effect and quantity, the place of each number in the array of effects; "on" is the effect's switch."""
    places: dict[str, dict[str, int]] = {}
    at = 0
    for id, kind in EFFECTS.items():
        places[id] = {name: at + k for k, name in enumerate(("on", *kind.quantities))}
        at += 1 + len(kind.quantities)
    return places


def page_columns() -> dict[str, int]:
    """Return the columns of a state that the page reads, by name."""
    return {name: getattr(columns, name) for name in OF_STATE}


def count_values() -> int:
    """Return how many numbers the array of effects has."""
    return sum(1 + len(kind.quantities) for kind in EFFECTS.values())


def values_of(effects: tuple[Effect, ...]) -> list[float]:
    """Return the array of these effects; what is absent, or left open (None), is NaN or off.

    Raises KeyError for an effect that is not in the catalogue.
    """
    places, row = value_places(), [0.0] * count_values()
    for effect in effects:
        if effect.is_absent():
            continue
        at = places[effect.id]
        row[at["on"]] = 1.0
        for name, value in effect.values().items():
            row[at[name]] = float("nan") if value is None else float(value)
    return row


def model_row(model: Model) -> list[float]:
    """Return the numbers of a model in the order of `MODEL`.

    Raises InputError: E-LAB, for a model whose points are not made of the twelve parameters: the page has no slider for
    them.
    """
    if model.points == "custom" or model.properties is not None:
        what = "states its contact points one by one, and the lab moves the twelve parameters"
        raise InputError("E-LAB", "the model", what, "Give a model with points eight_points or four_points.")
    p = model.parameters
    given = {name: getattr(model, name, 0.0) for name in ("mass", "width", "depth", "height", "g", "foot_radius")}
    given |= {name: getattr(p, name) for name in MODEL if hasattr(p, name)}
    given |= {f"delta_long_{i}": height for i, height in enumerate(p.delta_long, 1)}
    given["points"] = 4 if model.points == "four_points" else 8
    inertia = np.zeros(9) if model.inertia is None else np.ravel(model.inertia)
    return [float(given[name]) for name in MODEL[:-9]] + [float(a) for a in inertia]


def header() -> str:
    """Return the text of `layout.h`."""
    lines = [
        "// Written by `python -m rockref.lab.layout`. Where each number stands in the flat arrays.",
        "#pragma once",
    ]
    groups: dict[str, Any] = {"state": OF_STATE, "body": OF_BODY, "points": OF_POINTS, "memory": OF_MEMORY}
    for title, names in groups.items():
        of = [f"C_{name.rstrip('_')} = {getattr(columns, name)}" for name in names]
        lines.append(f"enum {{ {', '.join(of)} }}; // {title}")
    of_slots = {"SLOTS" if name == "OF_EFFECTS" else name: getattr(slots, name) for name in OF_SLOTS}
    lines.append(f"enum {{ {', '.join(f'S_{name} = {at}' for name, at in of_slots.items())} }}; // effects")
    lines.append(f"enum {{ {', '.join(f'M_{name}' for name in MODEL)}, M_COUNT }}; // model")
    for id, places in value_places().items():
        lines.append(f"enum {{ {', '.join(f'E_{id}_{name} = {at}' for name, at in places.items())} }};")
    return "\n".join([*lines, f"enum {{ E_COUNT = {count_values()} }};", ""])


if __name__ == "__main__":
    write_text(HEADER, header())
