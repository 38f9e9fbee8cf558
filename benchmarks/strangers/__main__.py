"""How well the judge names mistakes that it does not know: `python benchmarks/strangers`.

Each mistake of a list is planted in the tutorial backend, which is judged three times: with its pieces, by runs alone,
and by runs that show no forces. Named: the verdict has the rule that was planted. Top two: that rule is the one that
the verdict has, or the next one that it gives. Alike: the verdict has that rule, or says that runs cannot tell it from
the one that it has. The fingerprints of the zoo are not consulted: none of its mistakes helps. Two minutes of processor
time.

    --list N                    the mistakes of one list, by its number; all by default
    --profile scheme            planted in backends with another integrator (`schemes.py`; with `--list N` those of that
                                list)
    --controls                  correct variants in place of mistakes (`controls.py`, and those of the lists), long
                                runs among them; and rows of too few digits, which are told as a format
"""

from __future__ import annotations

import argparse
import sys
import warnings
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from strangers.correct import controls, formats
from strangers.judging import OF_SCHEMES, of_mistake, of_schemes
from strangers.list_01 import HARMLESS, Mistake
from strangers.registry import LISTS
from strangers.report import show


def main() -> None:
    """Judge all, print the table and those that have another name."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true", help="print everything as one JSON object")
    parser.add_argument("--only", default="", help="mistakes with these words in what they say")
    parser.add_argument("--list", choices=tuple(LISTS), metavar="N", help="one list alone")
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


if __name__ == "__main__":
    warnings.simplefilter("ignore", RuntimeWarning)
    main()
