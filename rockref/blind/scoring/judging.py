"""Verdicts on the cases of a blind test: by a diagnosis, or again from the evidence that a diagnosis stored."""

from __future__ import annotations

import json
import time
import traceback
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rockref.blind.cases.sealing import read_json, write_json
from rockref.model.errors import InputError

if TYPE_CHECKING:
    from rockref.discover.evidence.evidence import Evidence
    from rockref.discover.verdict.calibration import Calibration

VERDICT, EVIDENCE = "verdict.json", "evidence.json"


def judge_case(folder: str, name: str, threads: int | None) -> str:
    """Find the verdict on one case and keep it in its folder, a failure too; an existing verdict is left alone.

    Stored evidence is decided; where there is none the case is diagnosed.
    """
    case = Path(folder) / name
    if (case / VERDICT).exists():
        return name
    began = time.perf_counter()
    try:
        found = decided(case) if (case / EVIDENCE).exists() else diagnosed(case, threads)
    except InputError as error:  # the record is refused: right where it is faulty
        found = {"verdict": "refused", "effects": [], "code": error.code, "why": str(error)}
    except Exception as error:  # a case that breaks the discoverer counts against it, and the others go on
        found = {"verdict": "error", "effects": [], "why": f"{error!r}", "trace": traceback.format_exc()}
    found.setdefault("seconds", round(time.perf_counter() - began, 1))
    write_json(case / VERDICT, found)
    return name


def diagnosed(case: Path, threads: int | None) -> dict[str, Any]:
    """Diagnose a case, and keep its evidence beside it."""
    from rockref.discover.diagnose import diagnose

    result = diagnose(case, workers=threads)
    evidence = getattr(result, "evidence", None)
    if evidence is not None:
        evidence.save(case / EVIDENCE)
    return json.loads(json.dumps(result.to_dict(), default=float))


def decided(case: Path) -> dict[str, Any]:
    """Decide a case again by today's rules; where it has no evidence, the stored verdict stands.

    Raises InputError (E-FILE) where it has neither.
    """
    stored: dict[str, Any] = read_json(case / VERDICT) if (case / VERDICT).exists() else {}
    if not (case / EVIDENCE).exists():
        if not stored:
            cure = "Diagnose it first: rockref blind score DIR."
            raise InputError("E-FILE", str(case), f"has neither {EVIDENCE} nor {VERDICT}", cure)
        return stored
    from rockref.discover.evidence.evidence import Evidence

    return decided_from(Evidence.load(case / EVIDENCE), stored)


def decided_from(evidence: Evidence, stored: dict[str, Any], numbers: Calibration | None = None) -> dict[str, Any]:
    """Return a stored verdict as evidence decides it; numbers : in place of the calibrated ones."""
    from rockref.discover.verdict.rules import decide

    verdict = decide(evidence, numbers)
    if list(verdict.effects) != stored.get("effects"):
        stored = {key: value for key, value in stored.items() if key != "error"}  # errors of another model
    return stored | {
        "verdict": verdict.word,
        "effects": list(verdict.effects),
        "probability": verdict.probability,
        "amplitudes": {
            name: {"value": n.value, "low": n.low, "high": n.high} for name, n in verdict.best.numbers.items()
        },
        "signature": evidence.signature,
        "detection_limits": evidence.limits,
    }
