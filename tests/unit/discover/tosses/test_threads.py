"""The same last bits on any number of threads: of the many valleys of the error they choose the one of a fit."""

import os
import subprocess
import sys

import pytest

#: As many frames and numbers as the public tosses have.
PROGRAM = """
import hashlib
import numpy as np
from rockref.discover.tosses.descent import Slopes
from rockref.measure.tosses.impact_balance import robust

draw = np.random.default_rng(1).normal
{what}
print(hashlib.sha256(b"".join(np.asarray(a).tobytes() for a in found)).hexdigest())
"""
NORMAL = """
slopes = Slopes(draw(size=(22646, 2, 3)), draw(size=(22646, 2, 3, 38)), np.ones((22646, 2)), np.ones(38), 222)
found = slopes.normal_equations(np.zeros(38), 3.0)
"""
ROBUST = "found = robust(draw(size=(13000, 7)), draw(size=13000), np.arange(13000) // 60)"


USABLE = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@pytest.mark.skipif(USABLE < 2, reason="one core has one thread")
@pytest.mark.parametrize("what", [NORMAL, ROBUST])
def test_one_thread_and_two_give_the_same_bits(what):
    digests = set()
    for threads in ("1", "2"):
        environment = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), threads)
        done = subprocess.run(
            [sys.executable, "-c", PROGRAM.format(what=what)],
            capture_output=True, text=True, check=True, env=os.environ | environment,
        )  # fmt: skip
        digests.add(done.stdout)
    assert len(digests) == 1
