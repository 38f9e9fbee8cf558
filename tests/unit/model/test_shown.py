"""What shows itself: facts in a line, in words, in a table. The pictures are tested beside the report."""

from dataclasses import replace

import numpy as np
import pytest

import rockref
from rockref.effects.catalogue import EFFECTS
from rockref.model import shown
from rockref.model.base_motion import BaseMotion
from rockref.model.problem import State
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


def side_by_side(problem, leans):
    """The problem for blocks that begin with these leans [rad] about X, side by side."""
    c, s, z = np.cos(leans), np.sin(leans), np.zeros_like(leans)
    Lambda = np.stack([np.stack(row, -1) for row in ((z + 1, z, z), (z, c, s), (z, -s, c))], -2)
    rest, v, W = np.zeros((len(leans), 3)), np.outer(leans, [0, 3, 4]), np.outer(leans, [1, 0, 0])
    start = State.at_rest(x=rest, Lambda=Lambda, n=4, v=v, W=W)
    return problem.replace(start=start)


def test_responses_side_by_side_say_how_many_and_between_which_ends(response):
    pair = response.problem.replace(
        start=State.at_rest(x=np.zeros((2, 3)), Lambda=np.broadcast_to(np.eye(3), (2, 3, 3)), n=4)
    )
    two = {
        key: np.stack([getattr(response, key)] * 2)
        for key in ("x", "v", "Lambda", "W", "F", "s", "anchored", "sliding")
    }
    two["W"][1] *= 2
    two["Lambda"][1] = np.eye(3)
    late = replace(response, problem=pair, t=response.t + 1.0, **two)
    facts, rate = late.facts(), float(np.degrees(np.abs(response.W).max()))
    # Main impacts are those of one block.
    assert list(facts) == ["blocks", "duration", "rows", "points", "largest lean", "largest rate", "overturned"]
    assert (facts["blocks"], facts["duration"]) == ("2", "0.09 s")
    assert facts["largest lean"] == f"0 to {np.degrees(0.01):.3g} deg"
    assert facts["largest rate"] == f"{rate:.3g} to {2 * rate:.3g} deg/s"
    grid = replace(late, problem=pair.replace(start=replace(pair.start, x=np.zeros((2, 3, 3)))), t=response.t[:0])
    assert grid.facts() == {"blocks": "2 x 3", "rows": "none"}


def test_a_response_says_that_its_block_fell(response):
    fallen = response.Lambda.copy()
    fallen[-1] = [[1, 0, 0], [0, 0.6, -0.8], [0, 0.8, 0.6]]
    facts = replace(response, Lambda=fallen).facts()
    assert facts["overturned"] == "yes" and facts["largest lean"] == "53.1 deg"


def test_a_batch_says_its_size_and_a_moved_plate_by_which_record():
    base = BaseMotion(0.0, 0.01, np.zeros((2, 3)), name="kobe")
    problem = side_by_side(FOUR.problem(duration=0.5), np.array([0.01, 0.03])).replace(base=base)
    facts = problem.facts()
    assert (facts["blocks"], facts["plate"]) == ("2", "moves as kobe does")
    assert facts["lean at start"] == f"{np.degrees(0.01):.4g} to {np.degrees(0.03):.4g} deg"
    assert problem.replace(base=replace(base, name="")).facts()["plate"] == "moves as a record does"
    square = problem.replace(start=replace(problem.start, x=np.zeros((2, 3, 3))))
    assert square.facts()["blocks"] == "2 x 3"


def test_a_state_says_its_motion_and_how_many_feet_touch():
    start = side_by_side(FOUR.problem(duration=0.5), np.array([0.01, 0.03])).start
    touching = np.array([[True, True, False, False], [True, False, False, False]])
    assert replace(start, t=0.25, anchored=touching).facts() == {
        "time": "0.25 s",
        "lean": f"{np.degrees(0.01):.4g} to {np.degrees(0.03):.4g} deg",
        "speed": "0.05 to 0.15 m/s",
        "rate": f"{np.degrees(0.01):.4g} to {np.degrees(0.03):.4g} deg/s",
        "touching": "1 to 2 of 4 points",
    }
    whole = State.at_rest(x=np.zeros(3), Lambda=np.eye(3), n=4, v=np.array([3, 4, 0]), W=np.array([0, 0, 1]))
    assert whole.facts()["speed"] == "5 m/s" and whole.facts()["rate"] == "57.3 deg/s"


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
    both = problem.replace(effects=(EFFECTS["adhesion"](1.0), EFFECTS["plate_tilt"](0.1)))
    assert both.facts()["effects"] == "adhesion, plate_tilt"
    assert "lean 2.865 deg" in repr(problem.start) and "of 4 points" in repr(problem.start)


def test_points_say_how_uneven_they_are():
    points = FOUR.replace(points="eight_points", delta_long=(0.0, 1e-3, 0.0, 0.0)).body()[1]
    assert points.facts()["uneven by"] == "1 mm" and points.facts()["reach"] == "0.1 x 0.1 m"
    assert "radius" not in points.facts()


def test_points_say_what_they_are_made_of():
    points = rockref.Model.table_3_1().replace(width=0.2, K_N=3e7, K_T=2e7, mu_int=0.5, mu_ext=0.3).body()[1]
    two = replace(points, P=np.stack([points.P, 2 * points.P]), radius=np.full(8, 0.01), names=())
    uneven = 1e3 * np.ptp(points.P[:, 2])
    assert two.facts() == {
        "points": "8",
        "reach": "0.2 to 0.4 x 0.1 to 0.2 m",
        "uneven by": f"{uneven:.4g} to {2 * uneven:.4g} mm",
        "K_N": "3e+07 N/m",
        "K_T": "2e+07 N/m",
        "mu": "0.3 to 0.5",
        "radius": "0.01 m",
    }
    assert points.facts()["points"] == "8 (1ext to 4int)"


def test_a_cuboid_is_found_from_its_inertia_and_none_from_an_impossible_one():
    block = rockref.Model(width=0.2, depth=0.3, height=0.4).body()[0]
    assert np.allclose(block.sides(), [0.2, 0.3, 0.4], rtol=1e-12)  # rounding of three sums
    odd = rockref.Block(np.array(1.0), np.diag([1.0, 1.0, 3.0]), np.array(9.81))
    assert np.isnan(odd.sides()).any()
    # Of a thin plate two moments add up to the third: no cuboid is that thin.
    assert np.isnan(rockref.Block(np.array(1.0), np.diag([1.0, 1.0, 2.0]), np.array(9.81)).sides()[2])


def test_blocks_side_by_side_have_sides_of_their_own():
    one, other = (rockref.Model(width=w, depth=0.3, height=0.4).body()[0] for w in (0.2, 0.5))
    both = rockref.Block(
        np.array([one.mass, other.mass]), np.stack([one.inertia, other.inertia]).astype(object), np.array(9.81)
    )
    assert np.allclose(both.sides(), [[0.2, 0.3, 0.4], [0.5, 0.3, 0.4]], rtol=1e-12)  # rounding of three sums
    assert both.facts()["as a cuboid"] == "0.2 to 0.5 x 0.3 x 0.4 m" and both.facts()["gravity"] == "9.81 m/s2"


def test_a_table_holds_every_fact_and_no_raw_text(response):
    class Named(Shown):
        def facts(self):
            return {"name": "<b>"}

    page = Named()._repr_html_()
    assert "&lt;b&gt;" in page and "<b>" not in page
    # A title, and a row: nothing stands between the elements of the table.
    assert "<caption" in page and ">Named</caption><tbody><tr style=" in page
    assert page.endswith(">name</th><td style='text-align:left'>&lt;b&gt;</td></tr></tbody></table>")
    assert all(fact in response._repr_html_() for fact in response.facts().values())
    assert response._repr_html_().count("</td></tr><tr style=") == len(response.facts()) - 1
    lines = response.summary().splitlines()
    assert lines[0] == "Response" and lines[1] == "  duration      0.09 s"


def test_what_has_no_facts_says_so_and_an_empty_summary_is_its_name():
    class Bare(Shown):
        pass

    class Empty(Shown):
        def facts(self):
            return {}

    assert Empty().summary() == "Empty"
    with pytest.raises(NotImplementedError, match="^Bare has no facts$"):
        Bare().facts()


def test_the_last_painter_that_was_named_draws_it(response, monkeypatch):
    monkeypatch.setattr(shown, "_painters", [])
    shown.draw_with(lambda what: ("first", what))
    shown.draw_with(lambda what: ("second", what))
    assert response.plot() == ("second", response) and len(shown._painters) == 1


def test_equal_numbers_are_said_once():
    assert span(np.array(2.0), "kg") == "2 kg" and span([3, 1], "m") == "1 to 3 m"


def test_a_model_says_its_parameters_with_their_units():
    facts = rockref.Model.table_3_1().facts()
    assert facts["K_N"] == "6e+07 N/m" and facts["beta_int"] == "0.15" and facts["delta_long_2"] == "4e-05 m"
    assert facts["effects"] == "none"
