"""The models that failed, and the way from 54 genes to 12."""

import json

import numpy as np
import pytest

from rockref.identify.four_points import scenario_space
from rockref.identify.genes import space_54
from rockref.identify.models import model_of
from rockref.identify.search import Found, History, Settings
from rockref.jobs.campaign import campaign
from rockref.studies.reduction import groups, reduction_study
from rockref.studies.scenarios import REFERENCE, SCENARIOS, returns_to_plane, try_scenarios, words


@pytest.mark.parametrize("defects", SCENARIOS)
def test_every_scenario_has_a_model_in_the_middle_of_its_ranges(defects):
    space = scenario_space(defects, 0.117)
    model = model_of(space, np.full(len(space.genes), 0.5))
    assert model.points == "four_points" and len(model.effects) == len([d for d in defects if d != "wire"])
    model.problem(0.01)


@pytest.mark.slow
def test_rows_do_not_depend_on_how_the_work_is_spread(twin):
    names = [REFERENCE, ("wire",)]
    with campaign(1) as one, campaign(2) as two:
        rows = [row for _, row in try_scenarios(twin, Settings(4, 1), one, names)]
        assert dict(enumerate(rows)) == dict(try_scenarios(twin, Settings(4, 1), two, names))
    assert [r["name"] for r in rows] == ["eight points", words(("wire",))]
    assert rows[0]["genes"] == 12 and rows[1]["genes"] == 6
    json.dumps(rows, allow_nan=False)


def test_the_eight_point_model_returns_to_the_plane(table_3_1):
    assert 6 < returns_to_plane(table_3_1) < 14


def made_history(space, alike):
    """Best chromosomes that drift: those of `alike` together, all others on their own."""
    rng = np.random.default_rng(0)
    u = np.clip(0.5 + 0.05 * np.cumsum(rng.normal(size=(60, len(space.genes))), axis=0), 0, 1)
    for names in alike:
        columns = [space.names.index(n) for n in names]
        u[:, columns] = u[:, columns[:1]]
    return Found(u[-1], 0.0, History(best=u.tolist(), best_cost=[0.0] * 60, costs=[[0.0]] * 60))


def test_genes_that_move_as_one_come_out_and_others_do_not(table_3_1):
    space = space_54(table_3_1)
    alike = [n for n in space.names if n.endswith(" K_N")]
    table = {g.group: g for g in groups(space, made_history(space, [alike]), table_3_1.mass)}
    assert table["K_N of all points (3.7)"].comes_out and table["K_N of all points (3.7)"].spread == 0
    assert not table["K_T of all points (3.7)"].comes_out


def test_the_study_is_plain_and_counts_its_simulations(twin, tmp_path):
    with campaign(1) as work:
        result = reduction_study(twin, Settings(6, 4), work, tmp_path / "c.json")
        again = reduction_study(twin, Settings(6, 4), work, tmp_path / "c.json")
    assert result == again and result["simulations"] == 24
    assert np.shape(result["ways"]) == (4, 54) and np.shape(result["correlation"]) == (54, 54)
    json.dumps(result, allow_nan=False)
