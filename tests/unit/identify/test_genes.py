"""Chromosomes: ranges, units, and the models that they stand for."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rockref
from rockref.identify.four_points import scenario_space, start_of
from rockref.identify.genes import chromosome, space_12, space_54
from rockref.identify.models import model_of
from rockref.model.errors import InputError
from rockref.model.parameters import TABLE_3_1, chromosome_12, chromosome_54
from rockref.studies.scenarios import SCENARIOS

MODEL = rockref.Model.table_3_1()
SPACES = [space_12(MODEL), space_54(MODEL), *(scenario_space(d, 0.117) for d in SCENARIOS)]


@given(st.sampled_from(SPACES), st.integers(0, 2**32 - 1))
def test_units_and_values_are_inverse(space, seed):
    u = np.random.default_rng(seed).random(len(space.genes))
    # Rounding of a logarithm and a power over a range of a decade.
    np.testing.assert_allclose(space.units(space.values(u)), u, rtol=0, atol=1e-12)


@given(st.sampled_from(SPACES), st.integers(0, 2**32 - 1))
def test_every_chromosome_makes_a_block_that_can_be_released(space, seed):
    u = np.random.default_rng(seed).random(len(space.genes))
    problem = model_of(space, u).problem(0.01, **start_of(space, u))
    assert np.isfinite(problem.start.x).all()
    values = space.values(u)
    assert all(g.low <= v <= g.high for g, v in zip(space.genes, values, strict=True))


@pytest.mark.parametrize("space", SPACES, ids=lambda s: s.kind)
def test_slopes_are_those_of_the_values(space):
    u, h = np.full(len(space.genes), 0.4), 1e-6
    by_difference = (space.values(u + h) - space.values(u - h)) / (2 * h)
    # Second-order difference: h^2 times the third derivative, below 1e-9 of the value.
    np.testing.assert_allclose(space.slopes(u), by_difference, rtol=1e-7)


def test_the_twelve_genes_are_table_3_1():
    space = SPACES[0]
    u = chromosome(space, MODEL.parameters)
    np.testing.assert_allclose(space.values(u), chromosome_12(MODEL.parameters), rtol=1e-14)
    assert np.all((u > 0) & (u < 1)), "Table 3.1 lies inside the ranges"
    assert space.names == tuple(TABLE_3_1)
    with pytest.raises(InputError):
        chromosome(SPACES[1], MODEL.parameters)


def test_54_genes_hold_what_12_say():
    space = SPACES[1]
    assert len(space.genes) == 54
    u = space.units(chromosome_54(MODEL.parameters, MODEL.mass))
    assert np.all((u > 0) & (u < 1))
    made, wanted = (m.problem(0.01) for m in (model_of(space, u), MODEL))
    for key in ("P", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu"):
        np.testing.assert_allclose(getattr(made.points, key), getattr(wanted.points, key), rtol=1e-13)


def test_static_friction_is_never_below_dynamic():
    space = SPACES[1]
    u = np.full(54, 0.5)
    u[[i for i, n in enumerate(space.names) if n.endswith("mu_0")]] = 0.1
    points = model_of(space, u).problem(0.01).points
    np.testing.assert_array_equal(points.mu_0, points.mu)


def test_scenarios_have_the_defects_in_their_name():
    space = scenario_space(("eccentricity", "stiffness"), 0.117)
    v = dict(zip(space.names, space.values(np.full(len(space.genes), 0.9)), strict=True))
    model = model_of(space, np.full(len(space.genes), 0.9))
    assert [e.id for e in model.effects] == ["mass_eccentricity", "uneven_foot_stiffness"]
    assert model.effects[0].x == v["eccentricity_x"] and model.effects[1].foot1 == 1.0
    assert model.points == "four_points" and start_of(space, np.full(len(space.genes), 0.9)) == {}
    wire = scenario_space(("wire",), 0.117)
    assert start_of(wire, np.full(len(wire.genes), 1.0))["out_of_plane"] == pytest.approx(np.radians(0.08))
