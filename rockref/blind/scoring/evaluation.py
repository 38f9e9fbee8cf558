"""`rockref blind score` and `judge`: a verdict on every case, then, and only then, the truth."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from rockref.blind.cases.blocks import NEAR, OTHER
from rockref.blind.cases.making import run_all
from rockref.blind.cases.sealing import MANIFEST, OPENED, SEALED, digests, read_json, unseal, write_json
from rockref.blind.scoring import table
from rockref.blind.scoring.intervals import by_word, reliability
from rockref.blind.scoring.judging import VERDICT, decided, judge_case
from rockref.blind.scoring.marks import mark
from rockref.jobs.folder_lock import alone_in
from rockref.model.errors import InputError

#: Digests of all verdicts, written before the truth is opened.
COMMITTED = "VERDICTS.json"


def score(
    folder: Path | str,
    *,
    workers: int | None = None,
    dask: str | None = None,
    progress: Callable[[float], None] | None = None,
) -> dict[str, Any]:
    """Score a blind test: find the verdicts that are missing, commit to all, open the truth, mark.

    Returns what :func:`marked` does, and `sealed` (whether truth, cases and verdicts are those that were published);
    writes it to scores.json too.

    Raises InputError E-BLIND where the folder is no blind test, E-WORKERS and E-DASK, E-BUSY where another process is
    at it.
    """
    folder = Path(folder).resolve()
    manifest = _manifest(folder)
    with alone_in(folder):
        names = list(manifest["cases"])
        untouched = all(digests(folder / name) == manifest["cases"][name] for name in names)
        missing = [name for name in names if not (folder / name / VERDICT).exists()]
        threads = 1 if workers is None or workers > 1 or dask else None
        run_all(judge_case, [(str(folder), name, threads) for name in missing], workers, dask, progress)
        texts = {name: (folder / name / VERDICT).read_bytes() for name in names}
        committed = {name: hashlib.sha256(text).hexdigest() for name, text in texts.items()}
        if not (folder / COMMITTED).exists():
            write_json(folder / COMMITTED, committed)
        first = read_json(folder / COMMITTED)
        truth, same = unseal(folder)
        write_json(folder / OPENED, truth)
        found = marked(folder, truth, {name: json.loads(text) for name, text in texts.items()})
        found["sealed"] = {"truth": same, "cases": untouched, "verdicts_as_first_committed": first == committed}
        write_json(folder / "scores.json", found)
    return found


def judge(folder: Path | str) -> dict[str, Any]:
    """Decide every case again from its stored evidence by today's rules, and mark the verdicts; nothing is written.

    All cases are decided before the truth is opened; those of a test that was never scored have no verdict to commit
    to, and are refused, so that rules are not tried on a truth that is still to be judged blind.

    Raises InputError E-BLIND where the folder is no blind test or was not scored, E-FILE where a case has neither
    evidence nor verdict.
    """
    folder = Path(folder).resolve()
    names = list(_manifest(folder)["cases"])
    if not (folder / COMMITTED).exists():
        cure = "Score it first: rockref blind score DIR."
        raise InputError("E-BLIND", str(folder), f"has not been scored ({COMMITTED} is missing)", cure)
    verdicts = {name: decided(folder / name) for name in names}
    return marked(folder, unseal(folder)[0], verdicts)


def marked(folder: Path, truth: dict[str, Any], verdicts: Mapping[str, dict[str, Any]]) -> dict[str, Any]:
    """Mark verdicts by name against an opened truth.

    Returns `scores` (rows over all cases), `by_block` (rows of cases near the source, and of other blocks),
    `reliability` (stated probabilities against right verdicts, by block), `by_word` (how often each word of a verdict
    was right), `marks` (one a case), `failures` (lines).
    """
    by_name = {case["name"]: case for case in truth["cases"]}
    marks = [mark(by_name[name], verdict) for name, verdict in verdicts.items()]
    of = {block: [m for m in marks if m["block"] == block] for block in (NEAR, OTHER)}
    return {
        "folder": folder.name,
        "scores": table.scores(marks),
        "by_block": {block: table.scores(some, block) for block, some in of.items()},
        "reliability": {block: reliability(some) for block, some in of.items()},
        "by_word": by_word(marks),
        "failures": table.failures(marks),
        "marks": marks,
    }


def _manifest(folder: Path) -> dict[str, Any]:
    if not ((folder / MANIFEST).is_file() and (folder / SEALED).is_file()):
        cure = "Make one: rockref blind make DIR --seed S."
        raise InputError("E-BLIND", str(folder), f"is no blind test ({MANIFEST} or {SEALED} is missing)", cure)
    return read_json(folder / MANIFEST)
