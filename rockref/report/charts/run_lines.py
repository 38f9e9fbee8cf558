"""What a chart of a run shows beside its rates: Housner's block, and where the model touches."""

from __future__ import annotations

import numpy as np

from rockref.discover.compare.models import Comparison, RunComparison
from rockref.model.channel import DEGREES
from rockref.model.housner import housner
from rockref.report.charts import style
from rockref.report.charts.drawing import Line

# decided: Housner's curve bends over a swing; 5 ms apart its points are on it to the width of a line.
HOUSNER_RATE, HOUSNER_STEP = 200.0, 1e-3


def housner_line(c: Comparison, k: int, end: float) -> Line:
    """Return Housner's rate about the main axis for the release of a run, deg/s."""
    e, r, run = c.experiment, c.results[0][k], c.measured[k].run
    assert run.release_tilt is not None
    inertia = e.mass * (e.width**2 + e.height**2) / 12.0
    tilt = run.release_tilt + r.tilt_offset
    planar = housner(e.mass, e.width, e.height, inertia, 9.81, tilt, end, HOUSNER_RATE, HOUSNER_STEP)
    sign = -1.0 if abs(run.block_turned) > 1.0 else 1.0
    return Line("Housner", planar.t, sign * DEGREES * planar.rate, style.GREY, style.HOUSNER_DASH, 1.0)


def contact_strips(r: RunComparison) -> list[tuple[str, np.ndarray]]:
    """Return each contact point of the aligned model and its intervals of contact, (k, 2) s in the run's time."""
    strips = []
    for name, intervals in r.aligned.response.contacts():
        on = intervals + r.shift
        # Contacts that end where the next begins are one for the eye; it keeps the page small.
        apart = np.flatnonzero(on[1:, 0] - on[:-1, 1] > 1e-3) + 1
        starts = on[np.concatenate(([0], apart)), 0] if len(on) else np.empty(0)
        ends = on[np.concatenate((apart - 1, [len(on) - 1])), 1] if len(on) else np.empty(0)
        strips.append((name, np.stack((starts, ends), axis=-1)))
    return strips
