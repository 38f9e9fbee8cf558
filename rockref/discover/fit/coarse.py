"""From coarse to fine: a fit first sees residuals averaged over some milliseconds, and then every sample.

A corner impact that comes a fraction of a millisecond early is a spike of some tens of noise widths. Sample by sample
the loss is therefore rough, and least squares stops on the way down; averaged over more than the spike is long it is
smooth, and its lowest place is near the right one. Seismologists fit waveforms in this order, from low frequencies to
high ones, lest they fall in step with the wrong cycle (C. Bunks et al. (1995), Geophysics 60:1457-1473,
doi:10.1190/1.1443880).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rockref.discover.fit.least_squares import Fit, Point

#: Seconds averaged and most iterations, one stage after the other; each a quarter of the one before. Decided on ended
#: fits of six blind cases: from 48 ms on they came down by 730, 360, 300, 1970, 15 and 0 units, from 12 and 4 by 500,
#: 270, 130, -90, -70 and 0; two more stages between these three gained no more.
STAGES = ((48e-3, 6), (12e-3, 6), (3e-3, 4))


def coarse_to_fine(fit: Fit, point: Point, seed: int = 0, relative: float = 0.0) -> Point:
    """Where a fit goes on from after the coarse stages, with its windows' corrections improved on every sample.

    relative : share of the objective that two iterations must gain for a stage to go on.
    """
    rng = np.random.default_rng(seed)
    for seconds, iterations in STAGES:
        wide = replace(fit, averaged=max(2, round(seconds * fit.series.rate)))
        point = wide.run(wide.point(point.z, point.corrections)[0], iterations, rng, relative=relative)
    return fit.relax_states(fit.point(point.z, point.corrections)[0])
