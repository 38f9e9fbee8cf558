"""Judge a backend from Python: it passes; one line is broken, and the judge names the equation; then with less shown.

Run it cell by cell, or whole: ``python examples/judge_a_backend.py`` (a quarter of a minute). On the command
line the same is ``rockref conform examples/backend_numpy.py:Backend --quick``.
"""

# %% A backend is any object with `simulate`; this one shows its pieces, too
import sys
from pathlib import Path

import numpy as np

from rockref.conformance import load, text, verdict
from rockref.conformance.judge import judge

PIECES = ("L0", "L1", "L2", "L3", "L4", "L7")
BACKEND = load(f"{Path(__file__).parent / 'backend_numpy.py'}:Backend")


def judged(backend, layers):
    """The verdict over some layers of vectors, printed but for its tables."""
    found = verdict(judge(backend, layers), backend)
    lines = text(found).splitlines()
    print("\n".join([*lines[:4], *(["...", lines[-1]] if len(lines) > 4 else [])]), end="\n\n")
    return found


# %% As it is
assert judged(BACKEND, PIECES).passed

# %% Friction in a box in place of a cone: one line of one function
module = sys.modules[type(BACKEND).__module__]
right = module.sliding_force
module.sliding_force = lambda F_trial, mu, F_N: np.clip(F_trial, -mu * F_N, mu * F_N)
assert judged(BACKEND, PIECES).rule == "T3"


# %% The same mistake where only `simulate` is shown: short runs, each laid out so that one rule decides
class BlackBox:
    """Nothing but runs."""

    name = "black box"

    def simulate(self, problem):
        return BACKEND.simulate(problem)


assert not judged(BlackBox(), ("L5s",)).passed
module.sliding_force = right
assert judged(BlackBox(), ("L5s",)).passed
