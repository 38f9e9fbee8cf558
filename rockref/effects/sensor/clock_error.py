"""A recorder whose seconds are not seconds."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity


@dataclass(frozen=True)
class ClockError(Effect):
    """A row that the recorder dates t was taken at the true time rate * t: W_m(t) = W(rate t).

    Above 1 the recorder's clock is slow (its second is longer than a second) and the record looks hurried. Between the
    rows that are given it is cubic; one row alone stays as it is. Where rate * t lies beyond the last row the last row
    is held: simulate `rate` times as long to have none of it.
    """

    id = "clock_error"
    question = "sensor"
    quantities = {
        "rate": Quantity("1", 1.0, 0.98, 1.02, 1.01, "any", "true time over the recorder's time", POSITIVE, 100.0)
    }
    sentence = "A cheap oscillator runs fast or slow, so the whole record is stretched or squeezed in time."
    equation = r"W_m(t) = W(\eta\,t)"
    source = (
        "D. W. Allan (1966), Statistics of atomic frequency standards, Proc. IEEE 54:221-230, "
        "doi:10.1109/PROC.1966.4634"
    )
    confounder = "inertia_deviation"
    experiment = "Record a second pulse of a known clock, or an hour by a watch: the count tells the rate."

    stage = "clock"

    rate: float = 1.0

    def sensor(self, t, crv):
        if self.is_absent() or len(t) < 2:
            return crv
        from scipy.interpolate import CubicSpline

        t = np.asarray(t, float)
        return CubicSpline(t, crv, axis=-2)(np.clip(self.rate * t, t[0], t[-1]))

    def undo(self, t, crv):
        """Return the rows stay, their instants become the true ones; a row that was held is dated as if it were not."""
        return t if self.is_absent() else self.rate * np.asarray(t, float), crv
