"""A recorder whose seconds are not seconds."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.prior import Prior

#: Share of itself by which the rate moves at most; decided: plausible clocks move by less over ten seconds, true time
#: always grows, and rows that were even stay as even as a low-pass needs them.
HELD = 0.05


@dataclass(frozen=True)
class ClockError(Effect):
    """A row that the recorder dates t was taken at the true time t + (rate - 1)(t + growth t^2/2).

    Above 1 the recorder's clock is slow (its second is longer than a second) and the record looks hurried. The error of
    an oscillator that warms up moves, by the share `growth` of that at the release every second; where it has moved the
    rate by `HELD` of itself it stays (decided: no oscillator moves so far). Between the rows that are given it is
    cubic; one row alone stays as it is. Where the true time lies beyond the last row the last row is held: simulate as
    much longer to have none of it.
    """

    id = "clock_error"
    question = "sensor"
    quantities = {
        "rate": Quantity("1", 1.0, 0.98, 1.02, 1.01, "any", "true time over the recorder's time", POSITIVE, 100.0),
        # Beyond one a second the error at the release would tell of less than a second.
        "growth": Quantity("1/s", 0.0, -0.25, 0.25, 0.0, "any", "growth of the error, a second, over it", -1.0, 1.0),
    }
    switches = ("rate",)
    # Decided: an oscillator that has just been switched on moves by a tenth of its error a second.
    priors = {"growth": Prior("form")}
    sentence = "A cheap oscillator runs fast or slow, so the whole record is stretched or squeezed in time."
    equation = r"W_m(t) = W\left(t + (\eta - 1)(t + g\,t^2/2)\right)"
    source = (
        "D. W. Allan (1987), Time and frequency (time-domain) characterization, estimation, and prediction of "
        "precision clocks and oscillators, IEEE Trans. UFFC 34:647-654, doi:10.1109/T-UFFC.1987.26997 (linear drift)"
    )
    confounder = "inertia_deviation"
    experiment = "Record a second pulse of a known clock, or an hour by a watch: the count tells the rate."

    stage = "clock"

    rate: float = 1.0
    growth: float = 0.0

    def true_time(self, t: np.ndarray) -> np.ndarray:
        """Return the true time (N,) [s] of what the recorder dates t (N,) [s]."""
        change = (self.rate - 1) * self.growth
        if change == 0:
            return self.rate * t
        moves = np.minimum(t, HELD * self.rate / abs(change))
        return self.rate * t + change * moves * (t - moves / 2)

    def sensor(self, t, crv):
        if self.is_absent() or len(t) < 2:
            return crv
        from scipy.interpolate import CubicSpline

        t = np.asarray(t, float)
        return CubicSpline(t, crv, axis=-2)(np.clip(self.true_time(t), t[0], t[-1]))

    def undo(self, t, crv):
        """Return the rows stay, their instants become the true ones; a row that was held is dated as if it were not."""
        return t if self.is_absent() else self.true_time(np.asarray(t, float)), crv
