"""Variants of one compiled text have files of their own on disk."""

import os
import subprocess
import sys

import pytest

pytest.importorskip("numba")

from rockref.engines.compiled import abreast, kernel, slots


def test_variants_do_not_share_a_file():
    """numba names the files after the qualified name and the line; the line is the same for all."""
    for loops in (kernel.LOOPS, abreast.LOOPS):
        texts = [loop.py_func for loop in loops.values()]
        assert len({text.__code__.co_firstlineno for text in texts}) == 1
        assert len({text.__qualname__ for text in texts}) == len(texts) == len(slots.VARIANTS)


def test_each_variant_calls_functions_of_its_own():
    called = [loop.py_func.__globals__["steps"] for module in (kernel, abreast) for loop in module.LOOPS.values()]
    assert len(set(map(id, called))) == len(called)
    assert kernel.steps is abreast.steps is None, "the text of the loop itself belongs to no variant"


def test_what_each_variant_calls_has_a_name_of_its_own():
    """The name is part of the symbol in the machine code; two of one name are one function where both are loaded."""
    for loops in (kernel.LOOPS, abreast.LOOPS):
        for called in ("begin", "steps"):
            names = [loop.py_func.__globals__[called].py_func.__qualname__ for loop in loops.values()]
            assert len(set(names)) == len(slots.VARIANTS)


#: The first force evaluation of the law, or of a run with one effect, compiled against the law in NumPy.
FIRST_FORCES = """
import sys
from dataclasses import replace
import numpy as np
import rockref
from rockref.effects.catalogue import EFFECTS
from rockref.engines.compiled.engine import simulate
from rockref.model.simulate import simulate as law

plain = rockref.Model.table_3_1().problem(2e-5, output_rate=1e5)
for id in sys.argv[1:]:
    start = replace(plain.start, v=np.array([0.3, 0.1, -0.2]), W=np.array([3.0, 0.4, 1.0]))
    problem = plain.replace(start=start, effects=(EFFECTS[id].typical(),))
    assert np.array_equal(law(problem).F, simulate(problem).F), id
"""


# It compiles two variants in a folder of its own, some twenty seconds.
@pytest.mark.slow
def test_variants_that_were_compiled_in_different_processes_live_in_one(tmp_path):
    """Each process numbers what it compiles from the beginning: the first thing that each compiles has one number."""
    kept = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    one, other = "quadratic_drag", "hunt_crossley_contact"
    for ids in ([one], [other], [one, other]):
        done = subprocess.run([sys.executable, "-c", FIRST_FORCES, *ids], env=kept, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr[-1000:]


#: A run, another, and what was told meanwhile.
TOLD = """
import rockref
from rockref.engines.watchers import compile_watchers
told = []
compile_watchers.append(lambda: told.append(1))
for _ in range(2):
    rockref.simulate(rockref.Model.table_3_1(), 1e-4, output_rate=1e4, engine="numba")
    print(len(told) > 0)
    told.clear()
"""


# It compiles the law in a folder of its own, some ten seconds.
@pytest.mark.slow
def test_who_watches_is_told_when_machine_code_is_made(tmp_path):
    """In the first run of the first process, and never where it is loaded."""
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    said = [
        subprocess.run([sys.executable, "-c", TOLD], env=environment, capture_output=True, text=True, check=True).stdout
        for _ in range(2)
    ]
    assert said == ["True\nFalse\n", "False\nFalse\n"]
