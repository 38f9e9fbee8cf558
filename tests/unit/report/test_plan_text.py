"""A plan in words and tables says what its record says."""

import io

import numpy as np
import pytest
from rich.console import Console

from rockref import Model
from rockref.discover.fit.baseline import baseline_parameters
from rockref.discover.plan import Plan, Release, Says, further, outlook
from rockref.effects import catalogue
from rockref.report.plan_text import print_plan

TABLE = Model.table_3_1()
EFFECTS = tuple(catalogue.find(id) for id in ("viscous_friction", "rolling_resistance"))
ONCE, OTHER, TURNED = Release(0.117), Release(0.098), Release(0.117, True)


def says(release, film, rolling, together):
    """A run with this information about two effects, and about their difference."""
    n = len(baseline_parameters(TABLE, 0, 0.0014))
    H = np.diag([0.0] * n + [film, rolling])
    H[n:, n:] += together * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return Says(release, H)


@pytest.fixture(scope="module")
def plan():
    known = {ONCE: says(ONCE, 1e-4, 4e3, 1e6), OTHER: says(OTHER, 9.0, 9.0, 0.0), TURNED: says(TURNED, 1.0, 1.0, 0.0)}
    now, repeats = (outlook(TABLE, known, [ONCE] * n, EFFECTS) for n in (1, 3))
    varied = outlook(TABLE, known, [ONCE, OTHER, TURNED], EFFECTS)
    more = further(TABLE, known, [ONCE], [ONCE, OTHER, TURNED], EFFECTS, now)
    return Plan(TABLE, now, repeats, varied, repeats, varied, more, 1.0)


@pytest.fixture(scope="module")
def printed(plan):
    out = io.StringIO()
    print_plan(Console(file=out, width=200), plan)
    return out.getvalue()


def test_the_next_run_is_the_first_of_the_record(plan, printed):
    best = plan.to_dict()["further_runs"][0]
    assert f"The run that would help most next: {best['run']};" in printed
    assert f"for {best['helps_most']} by {best['its_limit_falls_by']:.1f}." in printed
    assert "0.117 (a repeat)" in printed and "0.117t" in printed


def test_every_limit_is_there_with_its_unit_and_size(plan, printed):
    limits = plan.to_dict()["limits"]
    assert set(limits) == {"viscous_friction.c", "rolling_resistance.lever"}
    for name, limit in limits.items():
        (row,) = [line for line in printed.splitlines() if line.startswith(name)]
        assert f"{limit['limit']:.3g} {limit['unit']}" in row and f"{limit['in_typical_sizes']:.2g}" in row


def test_what_is_confused_or_unseen_is_said(plan, printed):
    found = plan.to_dict()
    assert [p["effects"] for p in found["confused"]] == [["viscous_friction", "rolling_resistance"]]
    (row,) = [line for line in printed.splitlines() if line.startswith("viscous_friction ")]
    assert row.split() == ["viscous_friction", "rolling_resistance", f"{found['confused'][0]['cosine']:.3f}"]
    unseen = found["undetectable"]
    seen = len(plan.outlook.effects) - len(unseen)
    assert f"{seen} of 2 effects would show" in printed
    assert ("Not even so: " + ", ".join(unseen) in printed) == bool(unseen)


def test_repeats_are_set_against_varied_releases(plan, printed):
    versus = plan.to_dict()["repeats_against_varied"]
    assert f"lower by a factor of {versus['median_ratio']:.1f} (median)" in printed
    pairs = versus["confused_pairs"]
    assert f"{pairs[1]} against {pairs[0]} pairs stay confused" in printed
