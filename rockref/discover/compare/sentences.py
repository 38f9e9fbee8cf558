"""What a comparison says, in sentences; every word that judges stands for a threshold in the files imported here."""

from __future__ import annotations

from collections.abc import Callable

from rockref.discover.compare import sentences_shape as shape
from rockref.discover.compare import sentences_times as times
from rockref.discover.compare.finding import Finding
from rockref.discover.compare.models import Comparison

#: In the order in which a person asks: from when on, is the start right, then impact by impact, then why.
SPEAKERS: tuple[Callable[[Comparison, int], list[Finding]], ...] = (
    times.overturned,
    times.leaves_band,
    times.before_impact,
    times.first_impact,
    times.to_second_impact,
    shape.energy,
    shape.amplitude,
    shape.leak,
    shape.envelope,
    shape.error_size,
)


def findings(comparison: Comparison) -> tuple[Finding, ...]:
    """Return the sentences of a comparison: for each model in turn, then models against each other."""
    found: list[Finding] = []
    for model in range(len(comparison.names)):
        for speak in SPEAKERS:
            found.extend(speak(comparison, model))
    if len(comparison.names) > 1:
        found.extend(shape.side_by_side(comparison))
    return tuple(found)
