"""What each part of the discoverer is worth: `python benchmarks/ablation.py FOLDER [--cases case-001,case-002]`.

FOLDER is a blind test that was diagnosed (`rockref blind make`, `rockref blind score`). Its cases are diagnosed again,
each time with one part taken away:

- no varied runs: only the runs of the first release, one of them held out (a tilt, a side; nothing else is known);
- no windows: each run up to its second main impact in one piece from the release, nothing restarted in between;
- no refit: the baseline is fitted, and of one step of every candidate that which gains most is named;
- no held-out runs: the first of the whole discoverer's own ranking, taken at its word.

What was found is kept beside each case; an interrupted run goes on. Some minutes of processor time a case.
"""

from __future__ import annotations

import argparse
import json
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from rich.progress import Progress
from rivals import first_of_ranking, said

from rockref.blind.cases.sealing import unseal, write_json
from rockref.blind.scoring.judging import VERDICT
from rockref.blind.scoring.marks import mark
from rockref.blind.scoring.table import scores
from rockref.discover import window_rules as rules
from rockref.discover.compare.models import baseline_model
from rockref.discover.diagnose import diagnose
from rockref.discover.fit import search
from rockref.discover.fit.families import Family, size_of
from rockref.discover.looking.look import candidates_beside
from rockref.discover.looking.screen import screen
from rockref.discover.windows import series as windows
from rockref.measure.experiment import FIT, load_experiment
from rockref.measure.impacts import main_impacts
from rockref.model.errors import InputError

WHOLE, KEPT = "the whole", "ablation.json"
#: How long after the second main impact a record counts without windows [s]: as long as the first window of a run goes
#: on after its impact (`windows.series`).
AFTER = 0.045


def no_varied_runs(case: Path) -> dict[str, Any]:
    """The verdict on the runs that were released as the first one was."""
    head, *runs = (case / "experiment.toml").read_text(encoding="utf-8").split("[[run]]")
    experiment = load_experiment(case)
    first = experiment.runs[0]
    alike = [r.release_tilt == first.release_tilt and r.block_turned == first.block_turned for r in experiment.runs]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / case.name
        folder.mkdir()
        kept = [text for text, same in zip(runs, alike, strict=True) if same]
        (folder / "experiment.toml").write_text("[[run]]".join([head, *kept]), encoding="utf-8")
        for run, same in zip(experiment.runs, alike, strict=True):
            if same:
                shutil.copy(case / f"run{run.id}.csv.gz", folder)
        return diagnose(folder).to_dict()


@contextmanager
def in_one_piece() -> Iterator[None]:
    """Runs are not cut; each counts from the release to shortly after its second main impact."""

    def whole(experiment: Any, runs: Any, *lengths: Any, **options: Any) -> windows.Series:
        options.pop("sensor", None)
        rate = windows.gyro_of(experiment).sample_rate
        ends = [int((main_impacts(run.t, run.crv).times[1] + AFTER) * rate) for run in runs]
        cuts = [windows.Cut(np.array([0]), np.array([end])) for end in ends]
        return windows.Series(experiment, tuple(runs), cuts, **options)

    kept = search.series
    search.series = whole
    try:
        yield
    finally:
        search.series = kept


def no_windows(case: Path) -> dict[str, Any]:
    """The verdict from whole runs."""
    with in_one_piece():
        return diagnose(case).to_dict()


def no_refit(case: Path) -> dict[str, Any]:
    """The effect of which one step from the fitted baseline gains most, if it gains what an effect has to."""
    experiment = load_experiment(case, uses=(FIT,))
    setup = search.Setup(experiment, experiment.fit_runs(), baseline_model(experiment))
    null = Family((), *search.baseline(setup))
    best = screen(null.fit, null.point, candidates_beside(setup, ()), setup)[0]
    there = rules.is_detected(best.gain, size_of(Family(best.effects, best.fit, best.point)), False)
    return said(best.effects[0] if there else None)


PARTS: dict[str, Callable[[Path], dict[str, Any]]] = {
    "no varied runs": no_varied_runs,
    "no windows": no_windows,
    "no refit": no_refit,
}


def verdicts(case: Path) -> dict[str, dict[str, Any]]:
    """What is said of a case with everything, and without each part; what is there is not made again."""
    whole = json.loads((case / VERDICT).read_text(encoding="utf-8"))
    kept = case / KEPT
    found = json.loads(kept.read_text(encoding="utf-8")) if kept.exists() else {}
    for name, without in PARTS.items():
        if name not in found:
            try:
                verdict = without(case)
            except InputError as error:
                verdict = {"verdict": "error", "effects": [], "why": str(error)}
            found[name] = {key: verdict.get(key) for key in ("verdict", "effects", "signature", "why")}
            write_json(kept, found)
    return {WHOLE: whole, **found, "no held-out runs": first_of_ranking(whole)}


def table(marks: dict[str, list[dict[str, Any]]]) -> list[str]:
    """The scores that have a meaning without a part, in Markdown."""
    rows = {way: {row["score"]: row for row in scores(of)} for way, of in marks.items()}
    wanted = (
        "controls: false alarms", "single: truth first", "all: wrong name", "two effects: both named",
        "in no list: something else",
    )  # fmt: skip
    lines = [f"| score | {' | '.join(marks)} |", "| --- |" + " ---: |" * len(marks)]
    for score in wanted:
        cells = [f"{row['hits']} of {row['n']}" for row in (rows[way][score] for way in marks)]
        lines.append(f"| {score} | {' | '.join(cells)} |")
    return lines


def main(arguments: list[str] | None = None) -> int:
    """Diagnose without each part, print the table. Exit code 2 where the folder is no diagnosed blind test."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--cases", help="names of some, as case-001,case-002; default: all that were diagnosed")
    given = parser.parse_args(arguments)
    cases = sorted(path.parent for path in given.folder.glob(f"case-*/{VERDICT}"))
    if given.cases:
        cases = [case for case in cases if case.name in given.cases.split(",")]
    if not cases:
        print(f"{given.folder}: no diagnosed case there. Run rockref blind make and score first.", file=sys.stderr)
        return 2
    found = {}
    with Progress() as bar:
        task = bar.add_task("cases", total=len(cases))
        for case in cases:
            found[case.name] = verdicts(case)
            bar.advance(task)
    # The truth is opened when all verdicts stand.
    truth = {t["name"]: t for t in unseal(given.folder)[0]["cases"]}
    ways = (WHOLE, *PARTS, "no held-out runs")
    marks = {way: [mark(truth[name], of[way]) for name, of in found.items()] for way in ways}
    print("\n".join(table(marks)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
