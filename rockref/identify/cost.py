"""The cost of a model against a target: six terms, each a number without unit, weighted in one place.

Decided: the source says what its cost accounts for "amongst others", not how; this form is ours. It compares the
duration between the first two main impacts, and, between them, the envelopes and the Fourier spectra of the transverse
and longitudinal crv. The instant of the first main impact is added: with a known release it is measured as well.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rockref.identify.features import Features

#: Error of an instant that counts as one [s]. Decided: 10 ms, a fiftieth of the time to the first main impact, is as
#: wrong as an envelope that is off by its own size.
INSTANT = 0.01
#: Cost of a model that does not reach its second main impact, plus one for each that is missing. Decided: above all
#: that a model with two impacts gets in practice (some units), so that the search leaves such models first.
MISSING = 20.0


class Terms(NamedTuple):
    """The parts of the cost, unweighted.

    first_impact, duration : error of the instant and of the time between the first two main impacts, over 10 ms.
    envelope_* : quadratic mean error of the upper and lower envelope over the quadratic mean of the target's.
    spectrum_* : the same for the amplitude spectra.
    """

    first_impact: float
    duration: float
    envelope_transverse: float
    envelope_longitudinal: float
    spectrum_transverse: float
    spectrum_longitudinal: float


#: Weights of the terms. Decided: all alike; the scales above make them comparable.
WEIGHTS = Terms(1.0, 1.0, 1.0, 1.0, 1.0, 1.0)


def cost_terms(found: Features, wanted: Features) -> Terms | None:
    """Return the terms of a model's features against the target's; None where the model has no two main impacts."""
    if found.upper is None or found.lower is None or found.spectrum is None:
        return None
    assert wanted.upper is not None and wanted.lower is not None and wanted.spectrum is not None
    outline = [
        _relative(np.stack((found.upper[i], found.lower[i])), np.stack((wanted.upper[i], wanted.lower[i])))
        for i in (0, 1)
    ]
    lines = [_relative(found.spectrum[i], wanted.spectrum[i]) for i in (0, 1)]
    return Terms(
        abs(float(found.impacts[0] - wanted.impacts[0])) / INSTANT,
        abs(found.duration - wanted.duration) / INSTANT,
        outline[0],
        outline[1],
        lines[0],
        lines[1],
    )


def total(terms: Terms | None, impacts: int = 0, weights: Terms = WEIGHTS) -> float:
    """Return the weighted sum; for a model without two main impacts `MISSING` and one more for each that it lacks."""
    if terms is None:
        return MISSING + max(0, 2 - impacts)
    return float(sum(w * term for w, term in zip(weights, terms, strict=True)))


def _relative(found: np.ndarray, wanted: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(found - wanted)) / np.mean(np.square(wanted))))
