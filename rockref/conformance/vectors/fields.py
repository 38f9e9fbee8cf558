"""The names under which parts of an answer are compared: `F_N`, `F_stick`, `s_slip`, `trace.threshold`, `x@1`."""

from __future__ import annotations

from typing import Any

import numpy as np

#: Results of `step` and `simulate` that are taken apart by contact point, and the part that is meant.
PARTS = {"x_T": "x", "F_N": "F", "F_T": "F", "F_stick": "F", "F_slip": "F", "s_stick": "s", "s_slip": "s"}

#: What a piece answers. Of `simulate` only W is indispensable.
RESULTS = {
    "derived": ("inertia", "P", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu"),
    "release": ("x", "Lambda"),
    "kinematics": ("r", "u", "xi", "xi_rate", "v_slide"),
    "contact_law": ("F_N", "F_T", "s", "touching", "sliding"),
    "assemble": ("force", "moment", "T"),
    "rotate": ("Lambda",),
    "integrate": ("x", "Theta", "Lambda", "v_predicted", "W_predicted", "v", "W"),
    "step": ("x", "v", "Lambda", "W", "s", "anchored", "sliding", "a", "T", "F"),
    "simulate": ("W",),
    "channel": ("crv_deg_s",),
}


def branch_of(anchored: Any, sliding: Any) -> dict[str, list[int]]:
    """Return which points stick and which slide, from their flags (n,)."""
    anchored, sliding = np.asarray(anchored, bool), np.asarray(sliding, bool)
    return {
        "stick": np.flatnonzero(anchored & ~sliding).tolist(),
        "slip": np.flatnonzero(anchored & sliding).tolist(),
    }


def part(name: str, whole: Any, branch: dict[str, Any]) -> Any:
    """Return the part of F (n, 3), s (n, 2) or x (3,) that `name` means; `branch` says which points stick and which
    slide."""
    whole = np.asarray(whole)
    if name == "F_N":
        return whole[..., 2]
    if name in ("F_T", "x_T"):
        return whole[..., :2]
    return whole[branch[name[2:]], :2]


class Missing(KeyError):
    """The backend does not give this result."""


def result(name: str, out: dict[str, Any], branch: dict[str, Any]) -> Any:
    """Return the result called `name` in a piece's answer. Raises `Missing` where the backend does not show it."""
    base, _, row = name.partition("@")
    if base.startswith("trace."):
        trace = out.get("trace") or {}
        if base[6:] not in trace:
            raise Missing(name)
        return trace[base[6:]]
    key = PARTS.get(base, base) if base not in out else base
    if out.get(key) is None:
        raise Missing(name)
    whole = out[key] if not row else np.asarray(out[key])[int(row)]
    return whole if key == base else part(base, whole, branch)
