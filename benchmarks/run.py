"""What is measured, said in tables, drawn, and printed as one JSON line: `make bench`.

All speeds are block-steps a second by the clock on the wall, best of some repetitions, engines one after another in one
run: on a machine that others use too, the ratios mean more than the numbers.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from block import DURATION, STEP, released
from timing import Speed, speed

from rockref import Model
from rockref.engines import has_numba
from rockref.engines.machine import describe
from rockref.model import simulate as law
from rockref.model.problem import Problem, stack

ROOT = Path(__file__).resolve().parents[1]
STEPS = round(DURATION / STEP)
BATCHES = (1, 4, 16, 64, 256, 1024)
DURATIONS = (0.01, 0.1, 1.0, 5.0)
POINTS = (4, 8, 16, 32)


def main() -> None:
    """Measure everything, write the figure and the table, print one JSON line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--peers", default=sys.executable, metavar="PYTHON", help="interpreter that has the peers")
    parser.add_argument("--dry", action="store_true", help="write no files")
    given = parser.parse_args()
    found = {"machine": machine(), **numpy_alone(), **numpy_in_batch(), **peers(given.peers)}
    if has_numba():
        found |= {**first_call(), **memory(), **compiled(), **cores(), **growth(), **effects(), **abreast()}
    else:
        say("numba is not installed (pip install 'rockref[fast]'): the compiled engine is left out")
    if not given.dry:
        from tables import write

        write(found, ROOT)
    print(json.dumps(found))


def say(text: str) -> None:
    """Progress, beside the JSON line."""
    print(text, file=sys.stderr, flush=True)


def machine() -> dict:
    """What the figures were measured on."""
    facts = describe()
    return {key: facts[key] for key in ("cpu", "cores", "platform", "python", "numpy", "numba")} | {
        "load_before": os.getloadavg()[0]
    }


def row(name: str, s: Speed) -> dict:
    """One result, said and kept."""
    say(f"{name:44} {s.best:14,.0f} block-steps a second (median {s.median:,.0f})")
    return {name: s.best, f"{name}_median": s.median}


def numpy_alone() -> dict:
    """The law itself, one block."""
    problem = released(3000 * STEP)
    return row("numpy_one_block", speed(lambda: law.simulate(problem), 3000))


def numpy_in_batch(B: int = 1024, steps: int = 150) -> dict:
    """The law itself, a thousand blocks side by side."""
    problem = stack([tilted(i, steps * STEP) for i in range(B)])
    return row(f"numpy_batch_{B}", speed(lambda: law.simulate(problem), B * steps, repeat=3))


def tilted(i: int, duration: float = DURATION) -> Problem:
    """The released block, its tilt a little different for every i."""
    return released(duration, Model.table_3_1().replace(theta_0=0.110 + 1e-5 * (i % 1024)))


def compiled() -> dict:
    """The compiled engine, one block: what `simulate(engine="numba")` gives."""
    from rockref.engines.compiled.engine import simulate

    problem = released()
    simulate(problem)
    return row("numba_one_core", speed(lambda: simulate(problem), STEPS, repeat=25))


def cores(B: int = 16) -> dict:
    """Many runs at once: one thread, and all cores; pieces alternate, so that a busy moment hits both."""
    from rockref.engines.compiled.batch import from_problems, run_batch

    batch, all_cores = from_problems([tilted(64 * i) for i in range(B)]), os.cpu_count() or 1
    run_batch(batch)
    best = {1: 0.0, all_cores: 0.0}
    for _ in range(6):
        for workers in best:
            best[workers] = max(best[workers], speed(lambda w=workers: run_batch(batch, workers=w), B * STEPS, 1).best)
    gain = best[all_cores] / best[1]
    say(f"{'numba_all_cores':44} {best[all_cores]:14,.0f} block-steps a second, {gain:.2f} times one thread")
    return {"numba_one_thread": best[1], "numba_all_cores": best[all_cores], "gain_of_all_cores": gain}


def first_call() -> dict:
    """Seconds of the first call of all (it compiles), and of the first call of a later process (it loads)."""
    code = (
        "import time; import rockref; start = time.perf_counter(); "
        "rockref.simulate(rockref.Model.table_3_1(), 1e-3, engine='numba'); print(time.perf_counter() - start)"
    )
    with tempfile.TemporaryDirectory() as folder:
        seconds = [_seconds(code, folder) for _ in range(2)]
    say(f"first call {seconds[0]:.1f} s (compiles), first call of a later process {seconds[1]:.2f} s (loads)")
    return {"first_call_s": seconds[0], "first_call_of_a_later_process_s": seconds[1]}


def _seconds(code: str, cache: str) -> float:
    environment = {**os.environ, "NUMBA_CACHE_DIR": cache}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    return float(done.stdout)


#: What a run may take at its peak [MB].
MOST_MEMORY = 200


def memory() -> dict:
    """Peak memory [MB] of a process that makes a run of 10 s at 2 kHz: from Python, and by the command, with its file.

    Loops that are on disk already: making machine code takes more, once.
    """
    api = "import rockref; rockref.simulate(rockref.Model.table_3_1(), 10.0, engine='numba')"
    with tempfile.TemporaryDirectory() as folder:
        out = str(Path(folder) / "run.csv")
        words = ["-m", "rockref", "simulate", "--duration", "10", "--engine", "numba", "-o", out]
        for arguments in (["-c", api], words):
            _peak_memory(arguments)
        found = {"memory_api_mb": _peak_memory(["-c", api]), "memory_command_mb": _peak_memory(words)}
    for key, value in found.items():
        say(f"{key:44} {value:14,.0f} (at most {MOST_MEMORY} asked)")
    return found


def _peak_memory(arguments: list[str]) -> float:
    """Largest resident memory [MB] of a Python process with these arguments."""
    code = (
        "import resource, subprocess, sys; subprocess.run([sys.executable, *sys.argv[1:]], check=True, "
        "stdout=subprocess.DEVNULL); print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024 / 1e6)"
    )
    done = subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=True)
    return float(done.stdout)


def growth() -> dict:
    """How the seconds of a run grow with duration, with points, and with the size of a batch."""
    from rockref.engines.compiled.batch import from_problems, run_batch
    from rockref.engines.compiled.engine import simulate

    def seconds(run, repeat: int = 3) -> float:
        return 1 / speed(run, 1, repeat).best

    durations = [
        [d, seconds(lambda p=p: simulate(p))] for d, p in zip(DURATIONS, map(released, DURATIONS), strict=True)
    ]
    points = [[n, seconds(lambda p=p: simulate(p))] for n, p in zip(POINTS, map(with_points, POINTS), strict=True)]
    batches, by_law = [], []
    for B in BATCHES:
        problems = [tilted(i, 200 * STEP) for i in range(B)]
        batch, together = from_problems(problems), stack(problems)
        batches.append([B, seconds(lambda b=batch: run_batch(b)) / 200])
        # The same 200 steps: a run ends with its last row, and at 2 kHz the first after the start is that of step 50.
        by_law.append([B, seconds(lambda p=together: law.simulate(p)) / 200])
    say(f"one step of {BATCHES[-1]} blocks: numba {batches[-1][1]:.2e} s, numpy {by_law[-1][1]:.2e} s")
    return {
        "seconds_by_duration": durations, "seconds_by_points": points,
        "seconds_a_step_by_batch_numba": batches, "seconds_a_step_by_batch_numpy": by_law,
    }  # fmt: skip


def effects() -> dict:
    """What each effect costs, in parts of the law."""
    from effects import costs

    rows = costs()
    most = max(rows, key=lambda row: row["release"]["ratio"])
    say(f"the dearest effect, {most['effect']}: {most['release']['ratio']:.2f} times the law")
    return {"effects": rows}


def abreast() -> dict:
    """Runs in lanes against single runs, and the roof over them."""
    import lanes

    found = {"roof": lanes.roof(), **lanes.measured()}
    say(f"lanes make {found['lanes_by_effect'][0]['ratio']:.2f} times the block-steps of single runs")
    return {"abreast": found}


def with_points(n: int, duration: float = 0.3) -> Problem:
    """The released block with n points: the first four of the eight, all, or further ones inside the base."""
    from dataclasses import replace

    problem = released(duration)
    points = problem.points
    pick = np.arange(n) % points.n
    P = points.P[pick]
    P[points.n :, :2] *= 0.5  # further points stand half way to the middle and a millimetre higher: they only look
    P[points.n :, 2] += 1e-3
    fields = {key: getattr(points, key)[pick] for key in ("K_N", "K_T", "C_N", "C_T", "mu_0", "mu")}
    more = replace(points, P=P, names=tuple(f"{points.names[i]}" for i in pick), **fields)
    start = {key: getattr(problem.start, key)[pick] for key in ("s", "anchored", "sliding")}
    return problem.replace(points=more, start=replace(problem.start, **start))


def peers(python: str) -> dict:
    """The same block in LAMMPS and MuJoCo, in a process of their own."""
    command = [python, str(Path(__file__).parent / "peers.py")]
    environment = {**os.environ, "PYTHONPATH": f"{ROOT}:{os.environ.get('PYTHONPATH', '')}"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    try:
        found = json.loads(done.stdout.strip().splitlines()[-1])
    except (IndexError, ValueError):
        found = {name: {"skipped": done.stderr.strip()[-200:]} for name in ("lammps", "mujoco", "mujoco_rollout")}
    for name, result in found.items():
        if "skipped" in result:
            say(f"{name}: {result['skipped']}. pip install 'rockref[peers]'")
        else:
            say(f"{name:44} {result['steps_per_s']:14,.0f} block-steps a second")
    return {"peers": found}


if __name__ == "__main__":
    main()
