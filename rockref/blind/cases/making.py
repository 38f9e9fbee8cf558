"""`rockref blind make`: the cases of a plan, made side by side, and their truths sealed."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from concurrent.futures import as_completed
from pathlib import Path
from typing import Any

from rockref.blind.cases.plan import Case, plan
from rockref.blind.cases.sealing import MANIFEST, digests, read_json, seal, write_json
from rockref.jobs.folder_lock import alone_in
from rockref.model.errors import InputError

#: Truths of single cases while a test is being made; gone when it is sealed.
PARTS = ".making"


def make_one(folder: str, name: str, case: Case) -> str:
    """Make one case and keep its truth in a part file. A case that is there with its part is left alone."""
    from rockref.blind.cases.blocks import OTHER
    from rockref.blind.cases.generator import make_case, setup_that_shows

    root = Path(folder)
    part = root / PARTS / f"{name}.json"
    if part.exists() and (root / name / "experiment.toml").exists():
        return name
    setup = setup_that_shows(case.effects, case.seed) if case.block == OTHER else None
    truth = make_case(
        root / name, case.effects, case.seed, setup=setup, runs=case.runs, other_form=case.other_form,
        values=case.values, fault=case.fault,
    )  # fmt: skip
    write_json(part, truth | {"kind": case.kind, "class": list(case.same_as)})
    return name


def make(
    folder: Path | str,
    seed: int,
    near: int = 80,
    other: int = 40,
    *,
    cases: Sequence[Case] | None = None,
    workers: int | None = None,
    dask: str | None = None,
    progress: Callable[[float], None] | None = None,
) -> dict[str, Any]:
    """Make a blind test in `folder` and seal it; an interrupted one goes on where it stopped.

    Parameters
    ----------
    seed, near, other : of the plan; cases : instead of a plan's.
    workers : processes; dask : address of a cluster that sees the same folder.

    Returns the manifest. Raises InputError E-SEALED where a finished test is there, E-SEED where another is half made,
    E-WORKERS and E-DASK, E-BUSY where another process is at it.
    """
    folder = Path(folder).resolve()
    cases = plan(seed, near, other) if cases is None else list(cases)
    names = [f"case-{i:03d}" for i in range(1, len(cases) + 1)]
    folder.mkdir(parents=True, exist_ok=True)
    with alone_in(folder):
        if (folder / MANIFEST).exists():
            raise InputError("E-SEALED", str(folder), "holds a sealed blind test", "Score it, or make one elsewhere.")
        (folder / PARTS).mkdir(exist_ok=True)
        _check_same_plan(folder, [repr(case) for case in cases])
        jobs = [(str(folder), name, case) for name, case in zip(names, cases, strict=True)]
        run_all(make_one, jobs, workers, dask, progress)
        return _sealed(folder, seed, names)


def _sealed(folder: Path, seed: int, names: Sequence[str]) -> dict[str, Any]:
    """Seal the truths of cases that are made; their parts go. Returns the manifest."""
    truths = [read_json(folder / PARTS / f"{name}.json") for name in names]
    from rockref import __version__

    seal(folder, {"seed": int(seed), "cases": truths}, {name: digests(folder / name) for name in names}, __version__)
    shutil.rmtree(folder / PARTS)
    return read_json(folder / MANIFEST)


def _check_same_plan(folder: Path, lines: list[str]) -> None:
    here = folder / PARTS / "plan"
    if here.exists() and read_json(here) != lines:
        cure = "Give the seed and number it was started with, or another folder."
        raise InputError("E-SEED", str(folder), "holds a half-made blind test with another plan", cure)
    write_json(here, lines)


def run_all(
    function: Callable[..., Any],
    jobs: Sequence[tuple],
    workers: int | None,
    dask: str | None,
    progress: Callable[[float], None] | None = None,
) -> list[Any]:
    """Call `function` on every job, each on its own as a worker gets free; results in the order of the jobs."""
    from rockref.jobs.campaign import campaign

    results: list[Any] = [None] * len(jobs)
    if not jobs:
        return results
    with campaign(workers, dask) as made:
        if made.executor is None:
            for i, job in enumerate(jobs):
                results[i] = function(*job)
                _say(progress, (i + 1) / len(jobs))
            return results
        pending = {made.executor.submit(function, *job): i for i, job in enumerate(jobs)}
        for done, future in enumerate(as_completed(pending), start=1):
            results[pending[future]] = future.result()
            _say(progress, done / len(jobs))
    return results


def _say(progress: Callable[[float], None] | None, fraction: float) -> None:
    if progress is not None:
        progress(fraction)
