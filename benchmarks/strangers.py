"""How well the judge names mistakes that it does not know: `python benchmarks/strangers.py`.

Each mistake of `strangers_list.py` is planted in the tutorial backend, which is judged three times: with its pieces,
by runs alone, and by runs that show no forces. Named: the verdict has the rule that was planted. Alike: it has that
rule, or says that runs cannot tell it from the one that it has. The fingerprints of the zoo are not consulted: none of
its mistakes helps. A minute of processor time.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from strangers_list import HARMLESS, MISTAKES, Mistake

from rockref.conformance.judge import LAYERS, judge
from rockref.conformance.vectors import flat
from rockref.conformance.verdict import alike, verdict

SOURCE = Path(__file__).resolve().parents[1] / "examples/backend_numpy.py"
QUICK = [name for name in LAYERS if name not in ("L5", "L6")]
WAYS = ("pieces", "runs", "runs without forces")


def planted(mistake: Mistake) -> Any:
    """The tutorial backend with the mistake in it."""
    text = SOURCE.read_text()
    assert text.count(mistake.old) == 1, f"{mistake.says}: {text.count(mistake.old)} places"
    space: dict[str, Any] = {"__name__": "planted"}
    exec(compile(text.replace(mistake.old, mistake.new), mistake.says, "exec"), space)
    return space["Backend"]()


class Runs:
    """`simulate` alone of a backend; each question is answered once and kept, for the way without forces too."""

    language, precision = "Python", "float64"

    def __init__(self, backend: Any, kept: dict[bytes, Any], hidden: tuple[str, ...] = ()):
        self.backend, self.kept, self.hidden, self.name = backend, kept, hidden, backend.name

    def simulate(self, problem: Any) -> Any:
        """A run, without what is hidden."""
        key = b"|".join(np.asarray(v).tobytes() for v in flat(problem).values())
        if key not in self.kept:
            try:
                self.kept[key] = self.backend.simulate(problem)
            except Exception as e:
                self.kept[key] = e
        if isinstance(self.kept[key], Exception):
            raise self.kept[key]
        return {k: v for k, v in self.kept[key].items() if k not in self.hidden}


def seen(backend: Any, mistake: Mistake) -> dict[str, Any]:
    """What the judge says."""
    found = verdict(judge(backend, QUICK))
    rules = {found.rule, *alike(found)}
    return {
        "detected": found.status == "FAIL",
        "named": found.rule in mistake.rules,
        "alike": bool(rules & set(mistake.rules)),
        "rule": found.rule,
        "says": found.says,
        "vector": None if found.check is None else f"{found.check.vector} {found.check.name}",
    }


def of_mistake(mistake: Mistake) -> dict[str, Any]:
    """One mistake, in all ways that can show it."""
    backend, kept = planted(mistake), {}
    ways = {"pieces": seen(backend, mistake)}
    if mistake.in_runs:
        ways["runs"] = seen(Runs(backend, kept), mistake)
        ways["runs without forces"] = seen(Runs(backend, kept, ("F", "anchored")), mistake)
    return {"says": mistake.says, "rules": mistake.rules, "ways": ways}


def counted(found: list[dict[str, Any]]) -> dict[str, dict[str, int]]:
    """By way: how many were asked, detected, named, named or called alike."""
    table = {}
    for way in WAYS:
        asked = [f["ways"][way] for f in found if way in f["ways"]]
        table[way] = {"asked": len(asked)} | {k: sum(a[k] for a in asked) for k in ("detected", "named", "alike")}
    return table


def main() -> None:
    """Judge all, print the table and those that have another name."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true", help="print everything as one JSON object")
    parser.add_argument("--only", default="", help="mistakes with these words in what they say")
    given = parser.parse_args()
    found = []
    for mistake in MISTAKES:
        if given.only in mistake.says:
            found.append(of_mistake(mistake))
            print(f"{len(found)} of {len(MISTAKES)}: {mistake.says}", file=sys.stderr, flush=True)
    table, harmless = counted(found), [of_mistake(m) for m in HARMLESS if given.only in m.says]
    rejected = sum(any(a["detected"] for a in h["ways"].values()) for h in harmless)
    if given.json:
        counts = table | {"harmless": len(harmless), "harmless rejected": rejected}
        print(json.dumps({"counts": counts, "mistakes": found}, indent=1))
        return
    for way, row in table.items():
        print(f"{way}: " + ", ".join(f"{k} {n}" for k, n in row.items()))
    print(f"harmless changes rejected: {rejected} of {len(harmless)}")
    for f in found:
        for way, a in f["ways"].items():
            if not a["named"]:
                got = a["rule"] or ("no rule" if a["detected"] else "PASS")
                print(f"  {way}: {f['says']} ({' or '.join(f['rules'])}): {got}; {a['vector']}; {a['says']}")


if __name__ == "__main__":
    main()
