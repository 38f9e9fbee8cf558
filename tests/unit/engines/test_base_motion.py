"""A plate that moves: law and compiled step have the same bits, alone and abreast; no motion changes none."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("numba")

import rockref
from rockref.effects.catalogue import parse
from rockref.engines.compiled import engine
from rockref.model.base_motion import BaseMotion
from rockref.model.simulate import simulate as law
from tests.property.engines.test_bits import assert_same_bits

TABLE = rockref.Model.table_3_1()


def record(seed: int, n: int = 41) -> BaseMotion:
    """Three different components, an odd number of samples, the last not zero, times that are no multiples of steps."""
    return BaseMotion(0.00133, 0.00071, np.random.default_rng(seed).normal(size=(n, 3)) * [8.0, 9.0, 7.0])


def shaken(seed: int, duration: float = 0.04, **changes) -> rockref.Problem:
    """The block at release, shaken so that feet slide, lift and land; the run outlasts the record."""
    return TABLE.problem(duration, output_rate=1e4).replace(**{"base": record(seed), **changes})


def test_the_compiled_step_has_the_bits_of_the_law():
    problem = shaken(0)
    of_law = law(problem)
    assert of_law.sliding.any() and not of_law.anchored.all() and problem.duration > problem.base.end
    assert_same_bits(of_law, engine.simulate(problem))


def test_runs_abreast_have_their_own_motions():
    """One stands still, one starts after its record, two share one; the others differ in length."""
    problems = [shaken(k, 0.02, base=record(k, 11 + 2 * k)) for k in range(5)]
    problems += [shaken(0, 0.02, base=None), shaken(2, 0.02), shaken(2, 0.015, base=problems[2].base)]
    late = replace(problems[0].start, t=1.0)
    problems.append(problems[0].replace(start=late))
    for problem, response in zip(problems, engine.simulate_many(problems), strict=True):
        assert_same_bits(engine.simulate(problem), response)


def test_motion_beside_effects_has_the_bits_of_the_law():
    effects = tuple(parse(words) for words in ("hunt_crossley_contact:a=0.5", "plate_tilt:x=1e-3,y=2e-3"))
    problem = shaken(3, 0.01, effects=effects)
    assert_same_bits(law(problem), engine.simulate(problem))


@pytest.mark.parametrize("run", [law, engine.simulate])
def test_a_plate_that_does_not_move_changes_no_bit(run):
    """Samples of zero, and a record that begins after the run, are no motion at all."""
    still = shaken(0, 0.002, base=None)
    expected = run(still)
    for base in (BaseMotion(0.0, 0.001, np.zeros((3, 3))), replace(record(0), t_0=1.0)):
        assert_same_bits(expected, run(still.replace(base=base)))


def test_a_run_is_cut_anywhere_and_goes_on_with_the_same_bits():
    whole = engine.simulate(shaken(1, 0.03))
    first = engine.simulate(shaken(1, 0.0137))
    rest = law(shaken(1, 0.03 - 0.0137).replace(start=first.final_state))
    np.testing.assert_array_equal(whole.x[-1], rest.x[-1])
    np.testing.assert_array_equal(whole.W[-1], rest.W[-1])


@pytest.mark.parametrize(
    "words",
    ["quadratic_drag:c=0.4", "cable_restraint:k=5", "lingering_wire_pull:force=3", "compliant_support:frequency=60"],
)
@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_effects_that_are_fixed_to_the_room_are_refused_on_a_plate_that_moves(words, engine):
    problem = shaken(0, 0.001, effects=(parse(words),))
    with pytest.raises(rockref.InputError, match="E-BASE"):
        rockref.simulate(problem, engine=engine)
    if words.startswith("cable"):  # without motion they act as ever
        rockref.simulate(problem.replace(base=None, duration=1e-4), engine="numpy")
