"""The table of checks in the documentation is that of the code, and names every remark of a record."""

import runpy

from tests.shipped import ROOT


def test_every_check_says_what_follows():
    made = runpy.run_path(str(ROOT / "docs" / "make_checks.py"))
    rows = [made["row"](check) for check in (*made["OTHERS"], *made["CHECKS"])]
    assert all("`E-" in row or "`W-" in row for row in rows)
