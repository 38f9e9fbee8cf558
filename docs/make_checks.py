"""Write `docs/reference/checks.md` from the list of checks: ``python docs/make_checks.py``."""

from __future__ import annotations

import re
from pathlib import Path

from rockref.measure.checks.checklist import CHECKS, OTHERS, Check

PAGE = Path(__file__).resolve().parent / "reference" / "checks.md"
CODE = re.compile(r"[EW](?:-[A-Z]+)+")

HEAD = """# Checks of records

What is looked at when an experiment or tosses are read, on what evidence, and what follows: a refusal (`E-`, exit code
2) or a remark (`W-`, the work goes on). What each code says stands in [Errors and remarks](errors.md). Stretches of
time go with the square root of R/g of the block, rates with the rate of its first swing, and noise and resolution of
the data sheet explain what they can. This page is made from the code by `docs/make_checks.py`.

| subject | evidence | refusal | remark | in |
| --- | --- | --- | --- | --- |
"""


def row(check: Check) -> str:
    """One line of the table; the codes are those that the docstring of the check names."""
    codes = sorted(set(CODE.findall(check.look.__doc__ or "")))
    refusals, remarks = (", ".join(f"`{c}`" for c in codes if c[0] == kind) or "–" for kind in "EW")
    place = check.look.__module__.replace(".", "/") + ".py"
    return f"| {check.subject} | {check.evidence} | {refusals} | {remarks} | `{place}` |\n"


def page() -> str:
    """The whole page."""
    return HEAD + "".join(row(check) for check in (*OTHERS, *CHECKS))


def write() -> None:
    """Write the page where the site is built from."""
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    write()
