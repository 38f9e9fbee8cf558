"""What each effect costs in the compiled engine: nanoseconds a step, and how many times those of the plain law.

Two uses are measured: one release, to the second main impact, and a batch of short runs that begin along that
motion. Law and effect take turns in short pieces of work, and the least processor time of each
counts: what else runs on the machine then hits both, or counts little.

    python benchmarks/effects.py [--repeat 60] [effect ...]
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from block import released

from rockref.effects.base import Effect
from rockref.effects.catalogue import find
from rockref.model.response import Response

#: Windows of a batch, and their length [s]: those of a fit are 20 to 60 ms long.
WINDOWS, LENGTH = 32, 0.03


def main() -> None:
    """Measure the named effects, or all that act in the step, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("effect", nargs="*", help="ids of effects (default: all that act in the step)")
    parser.add_argument("--repeat", type=int, default=60)
    given = parser.parse_args()
    print("\n".join(table(costs(given.effect, given.repeat))))


def costs(ids=(), repeat: int = 60) -> list[dict]:
    """One row for each effect at its typical size: ns a step and times the law, of the release and of windows."""
    from rockref.engines.compiled.engine import simulate
    from rockref.engines.compiled.slots import IN_THE_STEP

    motion = simulate(released())
    law, rows = uses((), motion), []
    for name in ids or IN_THE_STEP:
        row: dict = {"effect": name}
        for use, (run, steps) in uses((find(name).typical(),), motion).items():
            plain, changed = least(law[use][0], run, repeat)
            row[use] = {"law_ns": plain / steps * 1e9, "ns": changed / steps * 1e9, "ratio": changed / plain}
        rows.append(row)
    return rows


def uses(effects: tuple[Effect, ...], motion: Response) -> dict[str, tuple[Callable, int]]:
    """By name: a call that makes block-steps with these effects, and how many it makes."""
    from rockref.engines.compiled import columns as col
    from rockref.engines.compiled.batch import from_problems, run_batch

    release = motion.problem.replace(effects=effects)
    first = [i * len(motion.t) // WINDOWS for i in range(WINDOWS)]
    starts = [replace(motion.state(row), memory=()) for row in first]
    found = {}
    for name, problems in (
        ("release", [release]),
        ("windows", [release.replace(start=start, duration=LENGTH) for start in starts]),
    ):
        batch = from_problems(problems)
        rows = np.empty((len(problems), len(batch.wanted), col.STATE))
        steps = len(problems) * int(batch.wanted[-1])
        found[name] = (lambda batch=batch, rows=rows: run_batch(batch, workers=1, out=rows)), steps
    return found


def least(one: Callable, other: Callable, repeat: int) -> tuple[float, float]:
    """The least processor seconds of two calls that take turns."""
    seconds: list[list[float]] = [[], []]
    for run in (one, other):
        run()  # compiles
    for _ in range(repeat):
        for kept, run in zip(seconds, (one, other), strict=True):
            begin = time.process_time()
            run()
            kept.append(time.process_time() - begin)
    return min(seconds[0]), min(seconds[1])


def table(rows: list[dict]) -> list[str]:
    """The rows in Markdown, the cheapest first."""
    law = min(row["release"]["law_ns"] for row in rows)
    lines = [
        "| effect | ns a step | times the law | in short runs |",
        "| --- | ---: | ---: | ---: |",
        f"| the plain law | {law:.0f} | 1 | 1 |",
    ]
    for row in sorted(rows, key=lambda r: r["release"]["ratio"]):
        release, windows = row["release"], row["windows"]
        name, ns, ratio = row["effect"], release["ns"], release["ratio"]
        lines.append(f"| `{name}` | {ns:.0f} | {ratio:.2f} | {windows['ratio']:.2f} |")
    return lines


if __name__ == "__main__":
    main()
