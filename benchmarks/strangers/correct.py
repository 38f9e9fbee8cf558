"""Correct variants of the tutorials, none of which is to be rejected; rows of too few digits, which blame no rule."""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rockref.conformance.backends.executable import Executable
from rockref.conformance.judge.findings import LAYERS, judge
from rockref.conformance.judge.verdict import verdict
from strangers.judging import QUICK
from strangers.planting import SOURCE, SOURCE_C, changed, made, with_step
from strangers.registry import FORMATS, IN_C, IN_PYTHON, STEPS

SHORT_LAYERS = [n for n in LAYERS if n != "L5"]


class RunsAlone:
    """`simulate` alone of a backend."""

    language, precision = "Python", "float64"

    def __init__(self, backend: Any):
        self.simulate, self.name = backend.simulate, backend.name


def variants() -> Iterator[tuple[str, Any, list[str], str]]:
    """Correct variants: what they do, the backend, the layers and the profile by which it is judged."""
    for scheme in STEPS:
        yield f"step of {scheme}", made(with_step(scheme), scheme), SHORT_LAYERS, "scheme"
    for v in IN_PYTHON:
        yield v.says, made(changed(SOURCE.read_text(), v.says, *v.changes), v.says), SHORT_LAYERS, "float64"
    with tempfile.TemporaryDirectory() as folder:
        for i, v in enumerate(IN_C):
            source, program = Path(folder) / f"{i}.c", Path(folder) / str(i)
            source.write_text(changed(SOURCE_C.read_text(), v.says, *v.changes))
            flags = v.flags or ("-O2",)
            subprocess.run(["cc", *flags, "-std=gnu11", "-o", str(program), str(source), "-lm"], check=True)
            backend = Executable([str(program)])
            yield v.says, backend, list(LAYERS), "float64"
            backend.close()


def controls(only: str) -> int:
    """Judge the correct variants, with pieces and by runs alone; print each; how many are rejected."""
    rejected = asked = 0
    for says, backend, layers, profile in variants():
        if only not in says:
            continue
        asked += 1
        told = [verdict(judge(b, layers, profile, examples=10)) for b in (backend, RunsAlone(backend))]
        bad = [v for v in told if not v.passed]
        rejected += bool(bad)
        print(
            f"{'REJECTED' if bad else 'passes'}: {says}", *(r for v in told[:1] for r in v.findings.remarks), sep="\n  "
        )
        for v in bad:
            where = f"{v.check.vector} {v.check.name}" if v.check else v.run.id if v.run else ""
            print(f"  {v.rule} {where}", flush=True)
    print(f"controls rejected: {rejected} of {asked}")
    return rejected


def formats(only: str) -> int:
    """Judge rows of too few digits, with pieces and by runs alone; of how many a rule is named, or nothing is told."""
    blamed = 0
    for v in FORMATS:
        backend = made(changed(SOURCE.read_text(), v.says, *v.changes), v.says)
        told = [verdict(judge(b, QUICK, "float64")) for b in (backend, RunsAlone(backend)) if only in v.says]
        wrong = [t for t in told if t.passed or t.rule is not None or not t.slip]
        blamed += bool(wrong)
        print(*(f"{v.says}: {t.status}, {t.rule or 'no rule'}; {t.slip}" for t in told), sep="\n")
    print(f"formats that are blamed on a rule: {blamed} of {len(FORMATS)}")
    return blamed
