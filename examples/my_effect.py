"""An effect of one's own: a magnet under the base brakes the block's turning by eddy currents in the plate.

rockref effects examples/my_effect.py:EddyBrake
rockref simulate --effect examples/my_effect.py:EddyBrake:c=0.05
"""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.model.rotation import apply


@dataclass(frozen=True)
class EddyBrake(Effect):
    """A moment -c omega on the body."""

    id = "eddy_brake"
    question = "loads"
    quantities = {"c": Quantity("N m s", absent=0.0, low=0.002, high=0.2, typical=0.05, sign="+", least=0.0)}
    sentence = "Currents that the moving magnet drives in the plate brake every rotation in proportion to its speed."
    equation = r"M = -c\,\omega"
    source = "Lenz's law; the form is ours"
    confounder = "quadratic_drag"
    experiment = "Turn the magnet off, or put an insulating plate under the block."

    c: float = 0.0

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        return np.zeros_like(x), -self.c * apply(Lambda, W)
