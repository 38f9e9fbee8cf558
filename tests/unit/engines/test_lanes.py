"""Runs that go abreast in the lanes of vector registers have the bits of runs that go alone."""

import itertools
import math
import platform
import re
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("numba")

import numba

import rockref
from rockref.effects.catalogue import EFFECTS, OF_TOSSES
from rockref.engines.compiled import abreast, batch, kernel, slots
from rockref.engines.compiled import columns as col
from rockref.engines.compiled.batch import from_problems, packs_of, run_batch
from rockref.engines.compiled.jit import inlined
from rockref.engines.compiled.lanes import LANES, anyof, as_lanes, both, choose, negated
from tests.property.engines.problems import similar_problem

ALL = {**EFFECTS, **OF_TOSSES}
TABLE = rockref.Model.table_3_1()

# --- the type ---------------------------------------------------------------------------------------------------------

SPECIAL = [0.0, -0.0, 1.0, -1.5, np.inf, -np.inf, np.nan, 5e-324, -2.3e-308, 1.7e308, 0.1, 3.0]


@inlined
def mixed(a, b):
    """Every operation once, where lanes disagree about which way to go."""
    c = (a + b) * a - b / a
    other = both(a > b, negated(a < 0.5))
    if anyof(other):
        c = choose(other, math.sqrt(abs(c)), c)
    c = max(-c, b) + min(a, c)
    c += choose(a == b, 1, choose(a != a, b, 2.0))
    c -= choose(a >= b, math.exp(-abs(b)), math.cos(a) + math.sin(b)) * choose(a <= 0.1, a, 0.25)
    return choose(abs(a) < 2.0, c + abs(a) ** b, c)


@numba.njit(error_model="numpy")
def alone(a, b, out):
    for i in range(len(a)):
        out[i] = mixed(a[i], b[i])


@numba.njit(error_model="numpy")
def together(a, b, out):
    a_, b_, out_ = as_lanes(a), as_lanes(b), as_lanes(out)
    for i in range(len(a_)):
        out_[i] = mixed(a_[i], b_[i])


def test_every_operation_has_the_bits_of_one_number():
    """Also of infinities, zeros with a sign and numbers below the normal ones; what is no number stays none."""
    pairs = np.array(list(itertools.product(SPECIAL, SPECIAL)))
    pairs = np.concatenate([pairs, np.random.default_rng(1).normal(size=(LANES * 10 - len(pairs) % LANES, 2))])
    a, b = (np.ascontiguousarray(column).reshape(-1, LANES) for column in pairs.T)
    one, many = np.empty(a.size), np.empty_like(a)
    alone(a.ravel(), b.ravel(), one)
    together(a, b, many)
    lost = np.isnan(one)
    np.testing.assert_array_equal(np.isnan(many.ravel()), lost)
    np.testing.assert_array_equal(one[~lost].view(np.int64), many.ravel()[~lost].view(np.int64))
    assert not lost.all() and lost.any()


def test_without_compiling_the_choices_are_python_s():
    assert choose(True, 1, 2) == 1 and anyof(False) is False and both(1, 0) is False and negated(0) is True


# --- the loop ---------------------------------------------------------------------------------------------------------


def kicked(*ids: str, duration: float = 8e-3, **changes):
    """The block at release, kicked so that its feet stick, slide, lift and land."""
    problem = TABLE.replace(**changes).problem(duration, output_rate=1e4)
    start = replace(problem.start, W=np.array([3.0, 0.4, 1.0]), v=np.array([0.3, 0.1, -0.2]))
    return problem.replace(start=start, effects=tuple(ALL[id].typical() for id in ids))


def several(*ids: str, runs: int = LANES + 1) -> list:
    """Runs that differ in stiffness and friction, one of them at rest in the air, so that they touch at other times."""
    problems = [kicked(*ids, K_N=2e7 * (1 + 0.1 * k), mu_int=0.2 + 0.02 * k) for k in range(runs - 1)]
    start = replace(problems[0].start, x=problems[0].start.x + np.array([0, 0, 1e-4]), v=np.zeros(3))
    return [*problems, problems[0].replace(start=start)]


def bits(rows) -> list[bytes]:
    return [a.tobytes() for a in rows]


def one_by_one(whole: batch.Batch) -> list[np.ndarray]:
    """States, forces and memories of the runs of a batch, each by the loop of single runs."""
    keys = ("body", "P", "props", "memory", "effects", "state", "forces")
    alone = []
    for b in range(len(whole.props)):
        wanted = whole.wanted if whole.wanted.ndim == 1 else whole.wanted[b]
        own = {key: getattr(whole, key)[b : b + 1] for key in keys}
        alone.append(run_batch(replace(whole, **own, wanted=wanted), full=True))
    return [np.concatenate(column) for column in zip(*alone, strict=True)]


@pytest.mark.parametrize(
    "ids", [(), *((id,) for id in slots.IN_THE_STEP), slots.IN_THE_STEP], ids=lambda ids: "+".join(ids[:2])
)
def test_lanes_have_the_bits_of_single_runs(ids):
    """The law, each effect on its own variant, and all effects at once."""
    whole = from_problems(several(*ids))
    assert bits(run_batch(whole, full=True)) == bits(one_by_one(whole))


@pytest.mark.parametrize("groups", slots.VARIANTS)
def test_every_variant_gives_the_law_where_nothing_is_on(groups, monkeypatch):
    whole = from_problems(several())
    expected = bits(one_by_one(whole))
    monkeypatch.setattr(kernel, "variant_for", lambda effects: groups)
    assert bits(run_batch(whole, full=True)) == expected


def test_the_order_of_the_runs_changes_nothing():
    """Runs of several kinds: with and without effects, full inertia, starts of their own, given accelerations."""
    problems = several() + several("adhesion", runs=3) + several("adhesion", "compliant_support", runs=2)
    problems += [p.replace(block=similar_problem(3, 8).block) for p in several(runs=3)]
    whole = from_problems(problems)
    states, forces, memories = run_batch(whole, full=True)
    order = np.random.default_rng(2).permutation(len(problems))
    mixed = run_batch(from_problems([problems[i] for i in order]), full=True, workers=3)
    assert bits(mixed) == bits(a[order] for a in (states, forces, memories))
    # Some runs go on from where they were, beside others that begin.
    half = np.arange(len(problems)) % 2 == 0
    again = replace(
        whole, state=np.where(half[:, None], states[:, 20], whole.state),
        memory=np.where(half[:, None, None], memories[:, 20], whole.memory),
        forces=np.where(half[:, None, None], forces[:, 20], whole.forces), wanted=whole.wanted[:21],
    )  # fmt: skip
    rest = run_batch(again)
    np.testing.assert_array_equal(rest[half], states[half, 20:41])
    np.testing.assert_array_equal(rest[~half], states[~half, :21])


def test_points_of_one_s_own_and_other_numbers_of_them():
    for n in (1, 4, 12):
        whole = from_problems([similar_problem(seed, n) for seed in range(LANES + 2)])
        assert bits(run_batch(whole, full=True)) == bits(one_by_one(whole))


def test_runs_may_want_other_rows_and_end_at_other_times():
    whole = from_problems(several())
    wanted = np.array([[0, 7, 7 + 13 * (b + 1), 400] for b in range(LANES + 1)])
    wanted[1, 2:] = wanted[2, 0:] = -1
    whole = replace(whole, wanted=wanted)
    np.testing.assert_array_equal(run_batch(whole), one_by_one(whole)[0])


@pytest.mark.parametrize("rate", [np.inf, 1e155, 5e5, 2e3])
def test_a_run_that_loses_its_numbers_spoils_no_other(rate):
    """Rates that are none, that overflow, that turn a block by 5 rad in a step; the last by 0.02: the long series."""
    problems = several()
    problems[1] = problems[1].replace(start=replace(problems[1].start, W=np.array([rate, 0.0, 0.0])))
    whole = from_problems(problems)
    states = run_batch(whole)
    np.testing.assert_array_equal(states, one_by_one(whole)[0])
    assert np.isfinite(states[[0, 2], :, : col.GIVEN]).all()
    assert np.isnan(states[1, -1, col.W_]) == (rate > 1e4)


def test_packs_hold_every_run_and_no_two_kinds():
    problems = several("adhesion") + several() + several("hunt_crossley_contact", "adhesion", runs=2)
    whole = batch.checked(from_problems(problems))
    packs = packs_of(whole)
    assert {groups for groups, _ in packs} == {0, slots.FORCES, slots.ALL}
    assert set(np.concatenate([p.ravel() for _, p in packs])) == set(range(len(problems)))
    for runs in np.concatenate([p for _, p in packs]):
        assert len({tuple(whole.effects[b, slots.SWITCHED_BY] != 0) for b in runs}) == 1


@pytest.mark.slow
@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="names of x86's instructions")
def test_the_machine_code_is_full_width():
    """Nearly every product of the loop is one of whole registers, with roots and quotients, and none is contracted."""
    run_batch(from_problems(several()))
    loop = abreast.LOOPS[0]
    if not any(loop.stats.cache_misses.values()):  # what comes from disk has no text
        loop = numba.njit(nogil=True, error_model="numpy", _nrt=False)(loop.py_func)
        loop.compile(tuple(abreast.LOOPS[0].signatures[0]))
    text = loop.inspect_asm(loop.signatures[0])
    register = "zmm" if LANES == 8 else "ymm"
    count = {name: len(re.findall(rf"\b{name}\b.*{register}", text)) for name in ("vmulpd", "vdivpd", "vsqrtpd")}
    single = len(re.findall(r"\bvmulsd\b", text))
    if not count["vmulpd"] and "vmulpd" not in text:
        pytest.skip("no registers of four doubles")
    assert count["vmulpd"] > 20 * max(single, 1) and count["vdivpd"] and count["vsqrtpd"]
    assert not re.findall(r"\bvfn?m(?:add|sub)\w*pd\b", text)
