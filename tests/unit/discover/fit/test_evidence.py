"""What held-out runs say of a fit."""

from types import SimpleNamespace

import numpy as np

from rockref.discover.fit.evidence import held_gains, held_out


def test_where_no_run_was_held_out_nothing_is_seen():
    """A diagnosis of such an experiment ended, after minutes, in an array that could not be made."""
    seen = held_out(None, None, None, SimpleNamespace(holdout_runs=tuple), ())
    assert len(seen.loss) == len(seen.count) == len(seen.run_of) == 0 and np.isnan(seen.rms)
    assert held_gains(seen, seen) == []
