"""A gyroscope that runs into its stops."""

import math
from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.prior import Prior

#: Largest rate that soft stops still tell, in ranges (decided: there they show 0.995 of the range, and noise counts a
#: hundred times); places in which their curve is followed by lines, 0.004 ranges apart, which leave 4e-6 of a range.
TOLD, PLACES = 3.0, 1501
#: Share of the range up to which a rate is told. Decided: rounding to a fiftieth of the range hides no flat top, and
#: below it stops of any softness bend a rate to a fifty-seventh at most.
TOP = 0.99
#: Seconds near the largest rate that make a top flat (decided: a cusp of a rocking block is within a hundredth of its
#: peak for some 2 ms).
FLAT = 12e-3
#: Ranges of soft stops from which fits start, in largest rates that a record shows (decided: there they take a half, a
#: quarter and a tenth off the true rate).
SOFT = (1.05, 1.3, 1.8)


@dataclass(frozen=True)
class GyroSaturation(Effect):
    """Each measured rate is cut at plus and minus `range`.

    With `softness` 1 the stops are soft: the rate is bent towards them all the way, as a hyperbolic tangent is, and no
    top is flat; between 0 and 1 it is so much of the way from the one to the other (decided: a straight blend, since
    both are known and stay one rate for each).
    """

    id = "gyro_saturation"
    question = "sensor"
    quantities = {
        "range": Quantity("rad/s", math.inf, 0.1, 10.0, 0.4, "any", "largest rate that is shown", POSITIVE),
        "softness": Quantity("1", 0.0, 0.0, 1.0, 0.0, "any", "share by which the stops are soft", 0.0, 1.0),
    }
    switches = ("range",)
    priors = {"softness": Prior("form")}
    sentence = "Beyond its range the sensor shows its largest number: tops are flat, or bent where its stops are soft."
    equation = r"W_m = (1 - s)\,\mathrm{clip}(W,\ -R,\ R) + s\,R\tanh(W/R)"
    source = "D. H. Titterton, J. L. Weston (2004), Strapdown Inertial Navigation Technology, doi:10.1049/PBRA017E"
    confounder = "gyro_scale"
    experiment = "Choose the sensor's next larger range; a flat top that stays at one number in every run is the range."

    stage = "samples"

    range: float = math.inf
    softness: float = 0.0

    def sensor(self, t, crv):
        if self.is_absent():
            return crv
        hard = np.clip(crv, -self.range, self.range)
        if not self.softness:
            return hard
        return hard + self.softness * (self.range * np.tanh(crv / self.range) - hard)

    def undo(self, t, crv):
        """Return what stops have left: what hard ones have cut stays cut, what soft ones show beyond their reach is the
        largest rate they tell."""
        if self.is_absent() or not self.softness:
            return t, crv
        rates = np.linspace(-TOLD, TOLD, PLACES) * self.range
        return t, np.interp(crv, self.sensor(rates, rates), rates)

    def heard(self, t, crv):
        return np.abs(crv) < TOP * self.range

    @classmethod
    def seeds_in(cls, records):
        """Return the largest rate of all records, if one shows it for longer than a cusp lasts, and soft stops beyond
        it."""
        limit = max(float(np.abs(crv).max()) for _, crv in records)
        longest = max(float(np.sum(np.abs(crv) > TOP * limit, axis=0).max() * (t[1] - t[0])) for t, crv in records)
        hard = ({"range": limit},) if longest >= FLAT else ()
        return (*hard, *({"range": beyond * limit, "softness": 1.0} for beyond in SOFT))
