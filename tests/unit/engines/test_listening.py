"""Runs that listen: the compiled loop gives the bits of the law's text."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest

pytest.importorskip("numba")

import rockref
from rockref.effects.catalogue import EFFECTS, OF_TOSSES
from rockref.engines.compiled import columns as col
from rockref.engines.compiled import engine, slots
from rockref.engines.compiled.batch import from_problems, run_batch
from rockref.engines.heard import Listening
from rockref.engines.listening import run_listening
from tests.property.engines.problems import similar_problem
from tests.refusal import refused

ALL = {**EFFECTS, **OF_TOSSES}
#: Those without `power` and `exp`, whose last bit NumPy and the C library need not share.
INEXACT = {"hertzian_contact", "load_dependent_friction", "stribeck_friction"}
EXACT = [id for id in slots.IN_THE_STEP if id not in INEXACT]
TICKS, EVERY = 12, 9


def kicked(model, *ids):
    """A block at release, kicked so that its feet stick, slide, lift and land."""
    problem = model.problem(TICKS * EVERY * 1e-5, output_rate=1e5)
    start = replace(problem.start, W=np.array([3.0, 0.4, 1.0]), v=np.array([0.3, 0.1, -0.2]))
    return problem.replace(start=start, effects=tuple(ALL[id].typical() for id in ids))


def listening(runs: int, **changes) -> Listening:
    """Two targets that no run would follow by itself, with ticks at which less is heard."""
    rng = np.random.default_rng(1)
    turns = np.broadcast_to(np.eye(3), (2, TICKS, 3, 3)) + 1e-3 * rng.normal(size=(2, TICKS, 3, 3))
    standard = Listening(
        rates=rng.normal(size=(2, TICKS, 3)), turns=turns, heard=rng.choice([0.0, 0.5, 1.0], size=(2, TICKS, 4)),
        which=np.arange(runs) % 2, gain_rate=np.linspace(0.02, 0.1, runs), gain_attitude=np.linspace(0.2, 0.01, runs),
        every=EVERY,
    )  # fmt: skip
    return replace(standard, **changes)


TABLE, FOUR = rockref.Model.table_3_1(), rockref.Model.four_points()
#: Each variant of the loop is compiled on its own; that of all effects has the text of every group in it.
PROBLEMS = {
    "law": [kicked(TABLE)],
    "all effects": [kicked(TABLE, *EXACT)],
    "four points": [kicked(FOUR), kicked(FOUR, "viscous_friction"), kicked(FOUR, "rolling_resistance")],
    "points of one's own": [similar_problem(3, 5), similar_problem(4, 5)],
    "round feet": [kicked(TABLE.replace(foot_radius=1e-3))],
}


@pytest.mark.parametrize("runs", PROBLEMS.values(), ids=PROBLEMS)
def test_bits_are_those_of_the_text(runs):
    own, compiled = (run_listening(runs, listening(len(runs)), engine=e) for e in ("numpy", "numba"))
    assert np.isfinite(own).all()
    np.testing.assert_array_equal(compiled, own)
    plain = run_listening(runs, listening(len(runs), heard=np.zeros((2, TICKS, 4))))
    assert not np.array_equal(plain[:, 2:], own[:, 2:]), "the correction must show"


@pytest.mark.parametrize("ids", [(), EXACT], ids=["law", "all effects"])
def test_contacts_that_begin_have_the_bits_of_the_text(ids):
    """Blocks that fall on their feet, one after the other touching in other parts of a step."""
    p = kicked(TABLE, *ids)
    falling = replace(p.start, W=np.array([0.3, 0.4, 0.1]))
    runs = [p.replace(start=replace(falling, x=p.start.x + [0, 0, 2e-5 + 3e-7 * k])) for k in range(6)]
    deaf = listening(6, gain_rate=np.zeros(6), gain_attitude=np.zeros(6))
    own, compiled = (run_listening(runs, deaf, engine=e) for e in ("numpy", "numba"))
    np.testing.assert_array_equal(compiled, own)
    plain = run_batch(replace(from_problems(runs), wanted=EVERY * np.arange(TICKS)))[:, :, col.W_ : col.W_ + 3]
    assert not np.array_equal(plain, own), "contacts must begin"


def mixed():
    runs = [kicked(TABLE), kicked(TABLE, "quadratic_drag"), kicked(TABLE.replace(K_N=5e7)), kicked(TABLE, "adhesion")]
    return 3 * runs


@pytest.mark.parametrize("workers", [2, 3, 7])
def test_any_number_of_threads(workers):
    batch = from_problems(mixed())
    one = run_listening(batch, listening(12), workers=1)
    np.testing.assert_array_equal(run_listening(batch, listening(12), workers=workers), one)


def test_a_run_that_hears_nothing_is_the_plain_run():
    """By gains of zero, and by a record that is lost throughout; while no contact begins."""
    batch = replace(from_problems(mixed()), wanted=EVERY * np.arange(TICKS))
    plain = run_batch(batch)[:, :, col.W_ : col.W_ + 3]
    deaf = listening(12, gain_rate=np.zeros(12), gain_attitude=np.zeros(12))
    np.testing.assert_array_equal(run_listening(batch, deaf), plain)
    np.testing.assert_array_equal(run_listening(batch, listening(12, heard=np.zeros((2, TICKS, 4)))), plain)


@pytest.mark.parametrize("kind", ["numpy", "numba"])
@pytest.mark.parametrize("rate", [1e155, 5e5])
def test_a_run_that_loses_its_numbers_spoils_no_other(rate, kind):
    """By overflow, and by a turn of more than 3.2 rad in a step."""
    good, bad = similar_problem(3, 4), similar_problem(4, 4)
    bad = bad.replace(start=replace(bad.start, W=np.array([rate, 0, 0])))
    rates = run_listening([bad, good], listening(2), workers=1, engine=kind)
    assert np.isnan(rates[0, 1:]).all() and np.isfinite(rates[1]).all()
    alone = run_listening([good], listening(1, which=[1], gain_rate=[0.1], gain_attitude=[0.01]), engine=kind)
    np.testing.assert_array_equal(rates[1], alone[0])


def test_a_user_s_effect_listens_by_the_law_s_text():
    @dataclass(frozen=True)
    class Mine(EFFECTS["quadratic_drag"]):
        id: ClassVar[str] = "quadratic_drag"

    own = ALL["quadratic_drag"].typical()
    problem = kicked(TABLE).replace(effects=(Mine(c=own.c, c_v=own.c_v),))
    expected = run_listening([kicked(TABLE, "quadratic_drag")], listening(1), engine="numpy")
    np.testing.assert_array_equal(run_listening([problem], listening(1)), expected)


def test_a_model_that_listens_to_another_s_record_stays_near_it():
    """A block released at a larger angle follows the record within a tenth of what it deviates by itself."""
    problem, other = (m.problem(0.1, output_rate=2000.0) for m in (TABLE, TABLE.replace(theta_0=0.12)))
    record = engine.simulate(problem)
    turns = record.Lambda[0].T @ record.Lambda
    gains = {"gain_rate": np.array([0.0, 0.1]), "gain_attitude": np.array([0.0, 0.005])}
    heard = Listening(record.W[None], turns[None], None, np.zeros(2, int), every=50, **gains)
    deaf, listens = (np.abs(rates - record.W)[100:].max() for rates in run_listening([other, other], heard))
    assert listens < 0.1 * deaf


@pytest.mark.parametrize(
    "change, code",
    [
        ({"rates": np.zeros((2, TICKS, 2))}, "E-SHAPE"), ({"which": np.array([0, 2])}, "E-RANGE"),
        ({"gain_rate": np.array([0.1, 1.5])}, "E-RANGE"), ({"every": 0}, "E-RANGE"),
        ({"rates": np.full((2, TICKS, 3), np.nan)}, "E-RANGE"), ({"gain_attitude": np.zeros(3)}, "E-SHAPE"),
    ],
)  # fmt: skip
def test_what_cannot_be_heard_is_refused(change, code):
    error = refused(run_listening, [kicked(TABLE)] * 2, listening(2, **change))
    assert error.code == code and next(iter(change)) in error.where


def test_engines_that_cannot_run_a_batch_are_refused():
    runs = [kicked(TABLE)]
    for batch, kind in [(from_problems(runs), "numpy"), (runs, "fortran")]:
        error = refused(run_listening, batch, listening(1), engine=kind)
        assert error.code == "E-ENGINE"
