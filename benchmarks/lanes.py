"""What runs abreast gain: lanes against the loop of single runs, what they cost by number, and the roof over them.

Both loops take turns in short pieces of work on one core, and the least processor time of each counts. The operations
of a step are counted from the text itself, which runs uncompiled with numbers that count. The peak of the vector unit
is that of products and sums in as many independent chains as there are registers.

    python benchmarks/lanes.py [--repeat 20] [effect ...]
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from block import STEP, released
from effects import least

from rockref import Model
from rockref.effects.catalogue import find
from rockref.model.problem import Problem

#: Steps of a run: those from 0.45 s on, about the first main impact of Table 3.1's block.
STEPS, FROM = 10_000, 0.45
BLOCKS = (1, 2, 4, 8, 16, 64, 256, 1024, 4096)
POINTS = (4, 8, 16)
#: Steps from tick to tick of a listening run, as in most stages of a fit.
EVERY = 16


def main() -> None:
    """Measure and print tables, then one JSON line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("effect", nargs="*", help="ids of effects (default: all that act in the step)")
    parser.add_argument("--repeat", type=int, default=20)
    given = parser.parse_args()
    found = {"roof": roof(), **measured(given.effect, given.repeat)}
    print("\n".join(tables(found)))
    print(json.dumps(found))


def measured(ids=(), repeat: int = 20) -> dict:
    """Ratios of both loops for the law, effects and listening, and the cost by number of blocks and of points."""
    from rockref.engines.compiled.slots import IN_THE_STEP

    return {
        "lanes_by_effect": [gain(name, repeat) for name in (None, *(ids or IN_THE_STEP))],
        "listening_over_law": listening(repeat),
        "seconds_a_step_by_blocks": [[B, per_step(many(B), repeat)] for B in BLOCKS],
        "seconds_a_step_by_points": [[n, per_step(many(16, n), repeat)] for n in POINTS],
    }


def start() -> Problem:
    """The released block of Table 3.1 a little before its first main impact."""
    from rockref.engines.compiled.engine import simulate

    if not _START:
        _START.append(simulate(released(FROM)).final_state)
    return released(STEPS * STEP).replace(start=replace(_START[0], memory=()))


_START: list = []


def several(runs: int, effects=()) -> list[Problem]:
    """Runs that differ in stiffness by a tenth, from one start."""
    problem = start().replace(effects=effects)
    K = problem.points.K_N
    return [
        problem.replace(points=replace(problem.points, K_N=K * (1 + 0.1 * k / runs)), duration=STEPS * STEP)
        for k in range(runs)
    ]


def gain(effect: str | None, repeat: int) -> dict:
    """Block-steps a second of both loops for the law (None), or with an effect of typical size."""
    from rockref.engines.compiled.batch import from_problems, run_batch
    from rockref.engines.compiled.lanes import LANES

    problems = several(2 * LANES, (find(effect).typical(),) if effect else ())
    together, alone = from_problems(problems), [from_problems([p]) for p in problems[::LANES]]
    lanes, single = least(
        lambda: run_batch(together, workers=1), lambda: [run_batch(b, workers=1) for b in alone], repeat
    )
    lanes, single = len(problems) * STEPS / lanes, len(alone) * STEPS / single
    return {"effect": effect or "the plain law", "lanes": lanes, "single": single, "ratio": lanes / single}


def listening(repeat: int) -> float:
    """Processor time of listening runs over that of plain ones, in lanes."""
    from rockref.engines.compiled.batch import from_problems, run_batch
    from rockref.engines.compiled.lanes import LANES
    from rockref.engines.heard import Listening
    from rockref.engines.listening import run_listening

    batch, K = from_problems(several(2 * LANES)), STEPS // EVERY
    few = replace(batch, wanted=np.arange(0, EVERY * K, EVERY))
    own = run_batch(few)
    W, R = own[0, :, 15:18], own[0, :, 6:15].reshape(K, 3, 3)
    B = len(batch.props)
    heard = Listening(W[None], (R[0].T @ R)[None], None, np.zeros(B, int), np.full(B, 0.02), np.full(B, 1e-3), EVERY)
    listens, plain = least(lambda: run_listening(batch, heard, workers=1), lambda: run_batch(few, workers=1), repeat)
    return listens / plain


def many(B: int, n: int | None = None):
    """A batch of B short releases, and its steps; with n points where it is given."""
    from run import with_points

    from rockref.engines.compiled.batch import from_problems

    steps = max(200, 51_200 // B)
    if n is not None:
        problems = [with_points(n, steps * STEP) for _ in range(B)]
    else:
        problems = [released(steps * STEP, Model.table_3_1().replace(theta_0=0.11 + 1e-6 * i)) for i in range(B)]
    return from_problems(problems), steps


def per_step(given, repeat: int) -> float:
    """Least processor seconds of one step of all runs of a batch, on one core."""
    from rockref.engines.compiled.batch import run_batch

    batch, steps = given
    seconds = []
    run_batch(batch, workers=1)
    for _ in range(max(3, repeat // 4)):
        begin = time.process_time()
        run_batch(batch, workers=1)
        seconds.append(time.process_time() - begin)
    return min(seconds) / steps


# --- the roof ---------------------------------------------------------------------------------------------------------


def roof() -> dict:
    """Operations of a step, and the operations a second that one core makes at best, in lanes."""
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(Path(__file__).parents[1])}
    command = [sys.executable, "-c", "import lanes; print(lanes.counted())"]
    done = subprocess.run(
        command, env=environment, capture_output=True, text=True, check=True, cwd=Path(__file__).parent
    )
    return {"operations_a_step": float(done.stdout), "peak": peak()}


class Counted(float):
    """A number that counts what is computed with it."""

    operations = 0


def _counting(name: str) -> Callable:
    plain = getattr(float, name)

    def operation(self, *others):
        Counted.operations += 1
        result = plain(self, *others)
        return Counted(result) if type(result) is float else result

    return operation


_ARITHMETIC = "add sub mul truediv pow radd rsub rmul rtruediv rpow neg abs lt le gt ge eq ne".split()


def counted(steps: int = 400) -> float:
    """Additions, products, quotients, roots and comparisons of a step of the law; its text has to run uncompiled."""
    from rockref.engines.compiled import columns as col
    from rockref.engines.compiled import kernel, pack
    from rockref.model.simulate import simulate as law

    for name in _ARITHMETIC:
        setattr(Counted, f"__{name}__", _counting(f"__{name}__"))
    problem = released(steps * STEP)
    problem = problem.replace(start=law(released(0.01)).final_state)
    props = pack.props_rows(problem)
    read = [
        pack.body_row(problem), pack.centres(problem.points.P, props), props, pack.memory_rows(problem.start),
        problem.start.F, pack.effects_row(problem), pack.state_row(problem),
    ]  # fmt: skip
    numbers = [np.array([[Counted(x) for x in a.ravel()]], object).reshape(1, *a.shape) for a in read]
    rows = [np.zeros((1, 1, col.STATE)), np.zeros((1, 1, problem.points.n, 3))]
    kernel.LOOPS[0](
        0, 1, *numbers, Counted(STEP), np.zeros((1, 3)), np.array([[steps]]), False, *rows,
        np.zeros((1, 1, problem.points.n, col.MEMORY)), np.zeros(1, int),
    )  # fmt: skip
    return Counted.operations / steps


def peak(rounds: int = 200_000) -> float:
    """Products and sums a second of one core in vectors, each chain independent of the others."""
    import numba

    from rockref.engines.compiled.lanes import LANES, as_lanes

    @numba.njit(error_model="numpy")
    def chains(numbers, rounds):
        a = as_lanes(numbers)
        a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
        factor, term = a[8], a[9]
        for _ in range(rounds):
            a0, a1, a2, a3 = a0 * factor, a1 + term, a2 * factor, a3 + term
            a4, a5, a6, a7 = a4 * factor, a5 + term, a6 * factor, a7 + term
        a[0], a[1], a[2], a[3] = a0, a1, a2, a3
        a[4], a[5], a[6], a[7] = a4, a5, a6, a7

    numbers, seconds = np.ones((10, LANES)), []
    chains(numbers, 1)
    for _ in range(20):
        begin = time.process_time()
        chains(numbers, rounds)
        seconds.append(time.process_time() - begin)
    return 8 * LANES * rounds / min(seconds)


def tables(found: dict) -> list[str]:
    """What was found, in Markdown."""
    roof, rows = found["roof"], found["lanes_by_effect"]
    law = rows[0]["lanes"]
    share = law * roof["operations_a_step"] / roof["peak"]
    lines = [
        f"A step of the law computes {roof['operations_a_step']:.0f} operations. One core makes "
        f"{roof['peak'] / 1e9:.1f} thousand million products and sums a second in vectors; runs abreast reach "
        f"{100 * share:.0f} % of that. A listening run costs {found['listening_over_law']:.2f} times a plain one.",
        "",
        "| one core | single runs [million block-steps a second] | abreast | ratio |",
        "| --- | ---: | ---: | ---: |",
    ]
    for row in rows:
        name = row["effect"] if " " in row["effect"] else f"`{row['effect']}`"
        lines.append(f"| {name} | {row['single'] / 1e6:.1f} | {row['lanes'] / 1e6:.1f} | {row['ratio']:.2f} |")
    lines += ["", "| blocks at once | one step of one block [ns], one core |", "| ---: | ---: |"]
    lines += [f"| {B} | {1e9 * s / B:.1f} |" for B, s in found["seconds_a_step_by_blocks"]]
    lines += ["", "| points, 16 blocks at once | one step of one block [ns], one core |", "| ---: | ---: |"]
    lines += [f"| {n} | {1e9 * s / 16:.1f} |" for n, s in found["seconds_a_step_by_points"]]
    return lines


if __name__ == "__main__":
    main()
