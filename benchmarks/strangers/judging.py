"""How well the judge names mistakes that it does not know: `python benchmarks/strangers.py`.

Each mistake of a list is planted in the tutorial backend, which is judged three times: with its pieces, by runs alone,
and by runs that show no forces. Named: the verdict has the rule that was planted. Top two: that rule is the one that
the verdict has, or the next one that it gives. Alike: the verdict has that rule, or says that runs cannot tell it from
the one that it has. The fingerprints of the zoo are not consulted: none of its mistakes helps. Two minutes of processor
time.

    --list first | second | ... | twenty-first  the mistakes of `strangers_list.py`, `strangers_second.py` and so on;
                                all by default
    --profile scheme            planted in backends with another integrator (`strangers_schemes.py`; with `--list
                                fourth` those of `strangers_fourth.py`, with `fifth`, `thirteenth`, `fourteenth`,
                                `fifteenth` to `twenty-first` of theirs)
    --controls                  correct variants in place of mistakes (`strangers_controls.py`), long runs among them;
                                and rows of too few digits, which are told as a format
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import strangers_controls
import strangers_controls_c
import strangers_eighteenth
import strangers_eighth
import strangers_eleventh
import strangers_fifteenth
import strangers_fifth
import strangers_fourteenth
import strangers_fourth
import strangers_list
import strangers_nineteenth
import strangers_ninth
import strangers_schemes
import strangers_second
import strangers_seventeenth
import strangers_seventh
import strangers_sixteenth
import strangers_sixth
import strangers_tenth
import strangers_third
import strangers_thirteenth
import strangers_twelfth
import strangers_twentieth
import strangers_twentyfirst
from strangers_list import HARMLESS, Mistake

from rockref.conformance.backends.executable import Executable
from rockref.conformance.judge.findings import LAYERS, judge
from rockref.conformance.judge.verdict import alike, suspects, verdict
from rockref.conformance.vectors import flat

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
SOURCE, SOURCE_C = EXAMPLES / "backend_numpy.py", EXAMPLES / "backend_c/backend.c"
QUICK = [name for name in LAYERS if name not in ("L5", "L6")]
WAYS = ("pieces", "runs", "runs without forces")
LISTS = {
    "first": strangers_list.MISTAKES,
    "second": strangers_second.MISTAKES,
    "third": strangers_third.MISTAKES,
    "fourth": strangers_fourth.MISTAKES,
    "fifth": strangers_fifth.MISTAKES,
    "sixth": strangers_sixth.MISTAKES,
    "seventh": strangers_seventh.MISTAKES,
    "eighth": strangers_eighth.MISTAKES,
    "ninth": strangers_ninth.MISTAKES,
    "tenth": strangers_tenth.MISTAKES,
    "eleventh": strangers_eleventh.MISTAKES,
    "twelfth": strangers_twelfth.MISTAKES,
    "thirteenth": strangers_thirteenth.MISTAKES,
    "fourteenth": strangers_fourteenth.MISTAKES,
    "fifteenth": strangers_fifteenth.MISTAKES,
    "sixteenth": strangers_sixteenth.MISTAKES,
    "seventeenth": strangers_seventeenth.MISTAKES,
    "eighteenth": strangers_eighteenth.MISTAKES,
    "nineteenth": strangers_nineteenth.MISTAKES,
    "twentieth": strangers_twentieth.MISTAKES,
    "twenty-first": strangers_twentyfirst.MISTAKES,
}
MISTAKES = strangers_list.MISTAKES
#: Other integrators, as lines of the function that makes a step.
STEPS = {
    **strangers_fourth.SCHEMES,
    **strangers_fifth.SCHEMES,
    **strangers_fourteenth.SCHEMES,
    **strangers_fifteenth.SCHEMES,
    **strangers_sixteenth.SCHEMES,
    **strangers_seventeenth.SCHEMES,
    **strangers_eighteenth.SCHEMES,
    **strangers_nineteenth.SCHEMES,
    **strangers_twentieth.SCHEMES,
    **strangers_twentyfirst.SCHEMES,
}


def made(text: str, says: str) -> Any:
    """The backend of a text."""
    space: dict[str, Any] = {"__name__": "planted"}
    exec(compile(text, says, "exec"), space)
    return space["Backend"]()


def changed(text: str, says: str, *changes: tuple[str, str]) -> str:
    """The text with each change made at its one place."""
    for old, new in changes:
        assert text.count(old) == 1, f"{says}: {text.count(old)} places of {old!r}"
        text = text.replace(old, new)
    return text


def planted(mistake: Mistake, scheme: str | None = None) -> Any:
    """The tutorial backend, or the one with another integrator, with the mistake in it."""
    text = changed(with_step(scheme), mistake.says, (mistake.old, mistake.new), *mistake.more)
    return made(text, mistake.says)


def with_step(scheme: str | None) -> str:
    """The tutorial's text, as it is or with another integrator."""
    text = SOURCE.read_text()
    if scheme is None:
        return text
    if scheme in strangers_schemes.SCHEMES:
        return strangers_schemes.exchanged(text, scheme)
    return strangers_fourth.exchanged(text, STEPS[scheme])


class Runs:
    """`simulate` alone of a backend; answers are kept, the first to a question, the second, and so on, for the way
    without forces too."""

    language, precision = "Python", "float64"

    def __init__(self, backend: Any, kept: dict[bytes, list[Any]], hidden: tuple[str, ...] = ()):
        self.backend, self.kept, self.hidden, self.name = backend, kept, hidden, backend.name
        self.asked: dict[bytes, int] = {}

    def simulate(self, problem: Any) -> Any:
        """A run, without what is hidden."""
        key = b"|".join(np.asarray(v).tobytes() for v in flat(problem).values())
        answers, self.asked[key] = self.kept.setdefault(key, []), self.asked.get(key, 0) + 1
        if len(answers) < self.asked[key]:
            try:
                answers.append(self.backend.simulate(problem))
            except Exception as e:
                answers.append(e)
        answer = answers[self.asked[key] - 1]
        if isinstance(answer, Exception):
            raise answer
        return {k: v for k, v in answer.items() if k not in self.hidden}


def seen(backend: Any, mistake: Mistake, profile: str = "float64") -> dict[str, Any]:
    """What the judge says."""
    found = verdict(judge(backend, QUICK, profile))
    rules = {found.rule, *alike(found)}
    return {
        "detected": found.status == "FAIL",
        "named": found.rule in mistake.rules,
        "top two": bool(set(suspects(found)[:2]) & set(mistake.rules)),
        "alike": bool(rules & set(mistake.rules)),
        "rule": found.rule,
        "next": suspects(found)[1:2],
        "slip": found.slip,
        "says": found.says,
        "vector": None if found.check is None else f"{found.check.vector} {found.check.name}",
    }


def of_mistake(mistake: Mistake, scheme: str | None = None) -> dict[str, Any]:
    """One mistake, in all ways that can show it."""
    backend, kept = planted(mistake, scheme), {}
    backend.simulate = Runs(planted(mistake, scheme), kept).simulate
    profile = "float64" if scheme is None else "scheme"
    ways = {"pieces": seen(backend, mistake, profile)}
    if mistake.in_runs:
        ways["runs"] = seen(Runs(backend, kept), mistake, profile)
        ways["runs without forces"] = seen(Runs(backend, kept, ("F", "anchored")), mistake, profile)
    return {"says": mistake.says, "rules": mistake.rules, "ways": ways}


def counted(found: list[dict[str, Any]]) -> dict[str, dict[str, int]]:
    """By way: how many were asked, detected, named, named in the top two, named or called alike."""
    table = {}
    for way in WAYS:
        asked = [f["ways"][way] for f in found if way in f["ways"]]
        counts = {k: sum(a[k] for a in asked) for k in ("detected", "named", "top two", "alike")}
        table[way] = {"asked": len(asked)} | counts
    return table


def of_schemes() -> Iterator[tuple[Mistake, str]]:
    """The mistakes that are planted in backends with another integrator, and in which: each in one, in turn."""
    yield from ((m, "symplectic Euler") for m in strangers_schemes.MISTAKES)
    yield from in_turn((*strangers_list.MISTAKES, *strangers_second.MISTAKES), list(strangers_schemes.SCHEMES))


def of_list_schemes(lists: Any) -> Iterator[tuple[Mistake, str]]:
    """The same of a list and its own integrators, without what dwindles with the step."""
    yield from lists.OF_STEPS
    dwindle = getattr(lists, "OF_THE_STEP", ())
    asked = getattr(lists, "IN_STEPS", lists.MISTAKES)
    yield from in_turn(tuple(m for m in asked if m.says not in dwindle), list(lists.SCHEMES))


def of_thirteenth_schemes() -> Iterator[tuple[Mistake, str]]:
    """The thirteenth list in all integrators."""
    schemes = (*strangers_schemes.SCHEMES, *strangers_fourth.SCHEMES, *strangers_fifth.SCHEMES)
    yield from in_turn(strangers_thirteenth.MISTAKES, list(schemes))


def in_turn(mistakes: tuple[Mistake, ...], schemes: list[str]) -> Iterator[tuple[Mistake, str]]:
    """The mistakes that runs show and that lie outside the law's step, each in the next integrator."""
    source = SOURCE.read_text()
    step = source[source.index("def first_half") : source.index("PROPERTIES = ")]
    for i, mistake in enumerate(mistakes):
        text, changes = with_step(scheme := schemes[i % len(schemes)]), ((mistake.old, ""), *mistake.more)
        whole = all(text.count(old) == 1 for old, _ in changes)
        if mistake.in_runs and whole and mistake.old not in step:
            yield mistake, scheme


#: Lists whose mistakes are planted in backends with another integrator.
OF_SCHEMES = {
    "scheme": of_schemes,
    "fourth scheme": partial(of_list_schemes, strangers_fourth),
    "fifth scheme": partial(of_list_schemes, strangers_fifth),
    "thirteenth scheme": of_thirteenth_schemes,
    "fourteenth scheme": partial(of_list_schemes, strangers_fourteenth),
    "fifteenth scheme": partial(of_list_schemes, strangers_fifteenth),
    "sixteenth scheme": partial(of_list_schemes, strangers_sixteenth),
    "seventeenth scheme": partial(of_list_schemes, strangers_seventeenth),
    "eighteenth scheme": partial(of_list_schemes, strangers_eighteenth),
    "nineteenth scheme": partial(of_list_schemes, strangers_nineteenth),
    "twentieth scheme": partial(of_list_schemes, strangers_twentieth),
    "twenty-first scheme": partial(of_list_schemes, strangers_twentyfirst),
}
SHORT_LAYERS = [n for n in LAYERS if n != "L5"]
#: Correct variants: in Python, in C, and integrators.
IN_PYTHON = (
    *strangers_controls.IN_PYTHON,
    *strangers_fourth.IN_PYTHON,
    *strangers_fifth.IN_PYTHON,
    *strangers_sixth.IN_PYTHON,
    *strangers_seventh.IN_PYTHON,
    *strangers_eighth.IN_PYTHON,
    *strangers_ninth.IN_PYTHON,
    *strangers_tenth.IN_PYTHON,
    *strangers_eleventh.IN_PYTHON,
    *strangers_twelfth.IN_PYTHON,
    *strangers_thirteenth.IN_PYTHON,
    *strangers_fourteenth.IN_PYTHON,
    *strangers_fifteenth.IN_PYTHON,
    *strangers_sixteenth.IN_PYTHON,
    *strangers_seventeenth.IN_PYTHON,
    *strangers_eighteenth.IN_PYTHON,
    *strangers_nineteenth.IN_PYTHON,
    *strangers_twentieth.IN_PYTHON,
    *strangers_twentyfirst.IN_PYTHON,
)
OF_C = (
    strangers_controls_c,
    strangers_fourth,
    strangers_fifth,
    strangers_seventeenth,
    strangers_eighteenth,
    strangers_nineteenth,
    strangers_twentieth,
    strangers_twentyfirst,
)
IN_C = tuple(v for each in OF_C for v in each.IN_C)


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
    for v in strangers_fifth.FORMATS:
        backend = made(changed(SOURCE.read_text(), v.says, *v.changes), v.says)
        told = [verdict(judge(b, QUICK, "float64")) for b in (backend, RunsAlone(backend)) if only in v.says]
        wrong = [t for t in told if t.passed or t.rule is not None or not t.slip]
        blamed += bool(wrong)
        print(*(f"{v.says}: {t.status}, {t.rule or 'no rule'}; {t.slip}" for t in told), sep="\n")
    print(f"formats that are blamed on a rule: {blamed} of {len(strangers_fifth.FORMATS)}")
    return blamed


class RunsAlone:
    """`simulate` alone of a backend."""

    language, precision = "Python", "float64"

    def __init__(self, backend: Any):
        self.simulate, self.name = backend.simulate, backend.name


def main() -> None:
    """Judge all, print the table and those that have another name."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true", help="print everything as one JSON object")
    parser.add_argument("--only", default="", help="mistakes with these words in what they say")
    parser.add_argument("--list", choices=tuple(LISTS), help="one list alone")
    parser.add_argument("--profile", choices=("float64", "scheme"), default="float64")
    parser.add_argument("--controls", action="store_true", help="correct variants")
    given = parser.parse_args()
    if given.controls:
        sys.exit(bool(controls(given.only) + formats(given.only)))
    asked: list[tuple[Mistake, str | None]] = [
        (m, None) for k, v in LISTS.items() if given.list in (None, k) for m in v
    ]
    if given.profile == "scheme":
        asked = list(OF_SCHEMES.get(f"{given.list} scheme", of_schemes)())
    found = []
    for mistake, scheme in asked:
        if given.only in mistake.says:
            found.append(of_mistake(mistake, scheme))
            print(f"{len(found)} of {len(asked)}: {mistake.says}", file=sys.stderr, flush=True)
    harmless = [of_mistake(m) for m in HARMLESS if given.only in m.says and given.profile == "float64"]
    show(found, harmless, given.json)


def show(found: list[dict[str, Any]], harmless: list[dict[str, Any]], as_json: bool) -> None:
    """Print counts, and the mistakes that are not named."""
    table, rejected = counted(found), sum(any(a["detected"] for a in h["ways"].values()) for h in harmless)
    if as_json:
        counts = table | {"harmless": len(harmless), "harmless rejected": rejected}
        print(json.dumps({"counts": counts, "mistakes": found}, indent=1))
        return
    for way, row in table.items():
        print(f"{way}: " + ", ".join(f"{k} {n}" for k, n in row.items()))
    print(f"harmless changes rejected: {rejected} of {len(harmless)}")
    for f in found:
        for way, a in f["ways"].items():
            if not a["named"]:
                got = " then ".join([a["rule"], *a["next"]]) if a["rule"] else "no rule" if a["detected"] else "PASS"
                print(f"  {way}: {f['says']} ({' or '.join(f['rules'])}): {got}; {a['vector']}; {a['says']}")


if __name__ == "__main__":
    warnings.simplefilter("ignore", RuntimeWarning)
    main()
