"""The law under random rounding: every rule's inputs and results moved by up to one ulp, in every step."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from rockref.conformance import pieces

#: Rules whose numbers are moved; decisions are not.
MOVED = (
    "position", "acceleration", "increment", "exponential", "kinematics", "normal", "trial", "threshold",
    "friction", "anchor", "force", "moment", "body_moment", "velocity", "momentum", "rates",
)  # fmt: skip


def noisy_rules(seed: int) -> pieces.Rules:
    """The law with random rounding, one course per seed."""
    draw = np.random.Generator(np.random.PCG64(seed))
    ulp = np.finfo(float).eps

    def move(a: Any) -> Any:
        if isinstance(a, np.ndarray) and a.dtype == np.float64 and a.size > 1:
            return a * (1 + ulp * draw.integers(-1, 2, a.shape, dtype=np.int8))
        return a

    def moved(rule: Callable) -> Callable:
        def with_noise(*arguments: Any) -> Any:
            found = rule(*(move(a) for a in arguments))
            if hasattr(found, "_fields"):
                return type(found)(*(move(a) for a in found))
            return move(found)

        return with_noise

    law = pieces.law()

    def rotation(Lambda: np.ndarray, E: np.ndarray) -> np.ndarray:
        # Rounded against 1, as a pose kept as a quaternion is.
        turned = law.rotation(Lambda, E)
        return turned + ulp / 2 * draw.integers(-1, 2, turned.shape, dtype=np.int8)

    noisy = {name: moved(getattr(law, name)) for name in MOVED}
    return law.replace(**noisy, rotation=rotation)
