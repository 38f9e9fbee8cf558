"""Which fits the evidence of a diagnosis keeps."""

import numpy as np

from rockref.discover.diagnose import STORED, stored
from rockref.discover.fit.fitter import FittedModel
from tests.unit.discover.selection.test_finalists import Descents


def test_the_parts_of_the_best_are_kept_though_many_sets_of_more_effects_explain_better():
    def at(objective: float, *effects: str) -> FittedModel:
        return FittedModel(("carried", *effects), np.zeros(1), objective=objective)

    null, feet, tilt, both = at(9000.0), at(2000.0, "feet"), at(8000.0, "tilt"), at(1000.0, "feet", "tilt")
    negligible = [at(999.0 - k, "feet", "tilt", f"negligible {k}") for k in range(12)]
    kept = stored(Descents(), [*negligible[::-1], both, feet, tilt, null])
    assert len(kept) == STORED + 1 and all(any(h is k for k in kept) for h in (null, feet, tilt, both))
    assert [h.objective for h in kept] == sorted(h.objective for h in kept)
