"""`rockref blind score`: a verdict on every case, then, and only then, the truth."""

from __future__ import annotations

import hashlib
import json
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rockref.blind.cases.making import run_all
from rockref.blind.cases.sealing import MANIFEST, OPENED, SEALED, digests, unseal, write_json
from rockref.blind.scoring import rivals, table
from rockref.blind.scoring.marks import mark
from rockref.identify.alone import alone_in
from rockref.model.errors import InputError

VERDICT, RIVALS = "verdict.json", "rivals.json"
#: Digests of all verdicts, written before the truth is opened.
COMMITTED = "VERDICTS.json"


def judge_case(folder: str, name: str, threads: int | None) -> str:
    """Diagnose one case and keep the verdict in its folder, a failure too; an existing verdict is left alone."""
    path = Path(folder) / name / VERDICT
    if path.exists():
        return name
    began = time.perf_counter()
    try:
        found = _diagnose(path.parent, threads)
    except InputError as error:  # the record is refused: right where it is faulty
        found = {"verdict": "refused", "effects": [], "code": error.code, "why": str(error)}
    except Exception as error:  # a case that breaks the discoverer counts against it, and the others go on
        found = {"verdict": "error", "effects": [], "why": f"{error!r}", "trace": traceback.format_exc()}
    found.setdefault("seconds", round(time.perf_counter() - began, 1))
    write_json(path, found)
    return name


def _diagnose(case: Path, threads: int | None) -> dict[str, Any]:
    from rockref.discover.diagnose import diagnose

    return json.loads(json.dumps(diagnose(case, workers=threads).to_dict(), default=float))


def rival_case(folder: str, name: str) -> str:
    """The verdicts of the rival methods on one case, kept in its folder."""
    path = Path(folder) / name / RIVALS
    if not path.exists():
        found = {}
        for id, method in rivals.METHODS.items():
            try:
                found[id] = method(path.parent)
            except Exception as error:
                found[id] = {"verdict": "error", "effects": [], "why": repr(error)}
        write_json(path, found)
    return name


def score(
    folder: Path | str,
    *,
    workers: int | None = None,
    dask: str | None = None,
    with_rivals: bool = True,
    progress: Callable[[float], None] | None = None,
) -> dict[str, Any]:
    """Score a blind test: diagnose the cases without a verdict, commit to all verdicts, open the truth, mark.

    Returns `scores` (rows of the table), `rivals` (rows for each rival method), `marks` (one a case), `failures`
    (lines), `sealed` (whether truth and cases are those that were published). Writes them to scores.json too.
    Raises InputError E-BLIND where the folder is no blind test, E-WORKERS and E-DASK, E-BUSY where another process is
    at it.
    """
    folder = Path(folder).resolve()
    manifest = _manifest(folder)
    with alone_in(folder):
        return _scored(folder, manifest, workers, dask, with_rivals, progress)


def _scored(
    folder: Path,
    manifest: dict[str, Any],
    workers: int | None,
    dask: str | None,
    with_rivals: bool,
    progress: Callable[[float], None] | None,
) -> dict[str, Any]:
    """The same in a folder of this process alone."""
    names = list(manifest["cases"])
    untouched = all(digests(folder / name) == manifest["cases"][name] for name in names)
    missing = [name for name in names if not (folder / name / VERDICT).exists()]
    threads = 1 if workers is None or workers > 1 or dask else None
    run_all(judge_case, [(str(folder), name, threads) for name in missing], workers, dask, progress)
    if with_rivals:
        run_all(rival_case, [(str(folder), name) for name in names], workers, dask)
    texts = {name: (folder / name / VERDICT).read_bytes() for name in names}
    committed = {name: hashlib.sha256(text).hexdigest() for name, text in texts.items()}
    if not (folder / COMMITTED).exists():
        write_json(folder / COMMITTED, committed)
    first = json.loads((folder / COMMITTED).read_text(encoding="utf-8"))
    truth, same = unseal(folder)
    write_json(folder / OPENED, truth)
    by_name = {case["name"]: case for case in truth["cases"]}
    verdicts = {name: json.loads(text) for name, text in texts.items()}
    marks = [mark(by_name[name], verdicts[name]) for name in names]
    found: dict[str, Any] = {
        "folder": folder.name,
        "sealed": {"truth": same, "cases": untouched, "verdicts_as_first_committed": first == committed},
        "scores": table.scores(marks),
        "failures": table.failures(marks),
        "marks": marks,
        "rivals": _rivals(folder, names, by_name, verdicts) if with_rivals else {},
    }
    write_json(folder / "scores.json", found)
    return found


def _manifest(folder: Path) -> dict[str, Any]:
    if not ((folder / MANIFEST).is_file() and (folder / SEALED).is_file()):
        cure = "Make one: rockref blind make DIR --seed S."
        raise InputError("E-BLIND", str(folder), f"is no blind test ({MANIFEST} or {SEALED} is missing)", cure)
    return json.loads((folder / MANIFEST).read_text(encoding="utf-8"))


def _rivals(folder: Path, names: list[str], truths: dict[str, Any], verdicts: dict[str, Any]) -> dict[str, Any]:
    """Rows of the table for every rival method."""
    read = {name: json.loads((folder / name / RIVALS).read_text(encoding="utf-8")) for name in names}
    said = {id: {name: read[name][id] for name in names} for id in rivals.METHODS}
    said["ranking without holdout"] = {name: rivals.first_of_ranking(verdicts[name]) for name in names}
    return {id: table.scores([mark(truths[name], answers[name]) for name in names]) for id, answers in said.items()}
