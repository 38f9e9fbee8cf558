"""What a fit assumes of an effect's quantities before it has seen data: role, scale, spread, deviation, bounds."""

from __future__ import annotations

import math
from dataclasses import dataclass

#: "size": brings the effect in. "shape": shapes it, about its typical value. "form": turns one form of a law into
#: another one, 1 being all the way; no effect is there by it alone. "fixed": stays typical, no record can tell it.
ROLES = ("size", "shape", "form", "fixed")
#: "linear"; "log"; "inverse", of what is absent at infinity; "compliance", of a support's frequency: the inverse of its
#: square over that of the typical one, absent at zero, which means rigid.
SCALES = ("linear", "log", "inverse", "compliance")

#: Prior standard deviations of the roles, in spreads. Decided: of a size, what is five times the typical one is not
#: expected; of a shape, its spread is already that of what is found.
OF_ROLE = {"size": 3.0, "shape": 1.0, "form": 0.1, "fixed": 0.0}
#: The same for what is typically none: where data cannot tell it from the rest of its effect it stays none, and one
#: whole spread costs 50 log-likelihood units (decided: axes that are not square trade with a turned sensor).
TYPICALLY_NONE = OF_ROLE["form"]
#: Spread of a shape's logarithm where none is declared (decided: a factor of about two between its ends).
SHAPE_SPREAD = 0.5
#: Compliance, over that of the typical frequency, at which a support is rigid: its frequency is 30 times the typical.
RIGID = 1e-3


@dataclass(frozen=True)
class Prior:
    """How a fit counts one quantity: centre + spread z on its scale; on a log scale centre exp(spread z).

    role, scale : of ROLES, of SCALES. centre, spread, low, high : on the scale (on a log scale centre, low and high are
    the quantity itself). deviation : prior standard deviation of z. What is left out (empty, nan) follows from the
    Quantity: `prior_of` completes it.
    """

    role: str = ""
    scale: str = ""
    centre: float = math.nan
    spread: float = math.nan
    deviation: float = math.nan
    low: float = math.nan
    high: float = math.nan
