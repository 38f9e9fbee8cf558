"""What shows itself: facts in a line, in words, in a table. The pictures are tested beside the report."""

import numpy as np
import pytest

import rockref
from rockref.model.shown import Shown, span

FOUR = rockref.Model.four_points()


@pytest.fixture(scope="module")
def response():
    return rockref.simulate(FOUR, duration=0.09, step=2e-5, output_rate=1000.0, engine="numpy", theta_0=0.01)


def test_a_response_says_how_long_how_far_and_how_often(response):
    facts = response.facts()
    assert facts == {
        "duration": "0.09 s",
        "rows": "91",
        "points": "4",
        "main impacts": "1",
        "largest lean": f"{np.degrees(0.01):.3g} deg",
        "largest rate": f"{np.abs(response.crv).max():.3g} deg/s",
        "overturned": "no",
    }
    assert repr(response).startswith("<Response: duration 0.09 s, rows 91, ") and "\n" not in repr(response)


def test_a_problem_says_its_block_and_how_it_begins():
    problem = FOUR.problem(duration=0.5, theta_0=0.05)
    assert problem.facts() == {
        "mass": "54 kg",
        "as a cuboid": "0.1 x 0.1 x 0.688 m",
        "points": "4 (1ext to 4ext)",
        "lean at start": f"{np.degrees(0.05):.4g} deg",
        "effects": "none",
        "duration": "0.5 s",
        "step": "1e-05 s",
    }
    assert "lean 2.865 deg" in repr(problem.start) and "of 4 points" in repr(problem.start)


def test_points_say_how_uneven_they_are():
    points = FOUR.replace(points="eight_points", delta_long=(0.0, 1e-3, 0.0, 0.0)).body()[1]
    assert points.facts()["uneven by"] == "1 mm" and points.facts()["reach"] == "0.1 x 0.1 m"
    assert "radius" not in points.facts()


def test_a_cuboid_is_found_from_its_inertia_and_none_from_an_impossible_one():
    block = rockref.Model(width=0.2, depth=0.3, height=0.4).body()[0]
    assert np.allclose(block.sides(), [0.2, 0.3, 0.4], rtol=1e-12)  # rounding of three sums
    odd = rockref.Block(np.array(1.0), np.diag([1.0, 1.0, 3.0]), np.array(9.81))
    assert np.isnan(odd.sides()).any()


def test_a_table_holds_every_fact_and_no_raw_text(response):
    class Named(Shown):
        def facts(self):
            return {"name": "<b>"}

    assert "&lt;b&gt;" in Named()._repr_html_() and "<b>" not in Named()._repr_html_()
    assert all(fact in response._repr_html_() for fact in response.facts().values())
    assert response.summary().splitlines()[1].split() == ["duration", "0.09", "s"]


def test_equal_numbers_are_said_once():
    assert span(np.array(2.0), "kg") == "2 kg" and span([3, 1], "m") == "1 to 3 m"


def test_a_model_says_its_parameters_with_their_units():
    facts = rockref.Model.table_3_1().facts()
    assert facts["K_N"] == "6e+07 N/m" and facts["beta_int"] == "0.15" and facts["delta_long_2"] == "4e-05 m"
    assert facts["effects"] == "none"
