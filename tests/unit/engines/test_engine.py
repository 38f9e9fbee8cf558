"""The compiled engine keeps the contract of the law's: responses, restarts, batches, errors."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("numba")

import rockref
from rockref import engines
from rockref.effects.catalogue import EFFECTS
from rockref.effects.support.compliant_support import CompliantSupport
from rockref.engines.compiled import engine, kernel, slots, sources
from rockref.model.errors import NumericalError
from rockref.model.problem import stack
from rockref.model.simulate import simulate as law
from tests.property.engines.problems import inertia, similar_problem, state
from tests.refusal import refused

MODEL = rockref.Model.table_3_1()
#: A plate that bounces and pitches, so that all that a plate remembers is at work.
PITCHING = CompliantSupport(100.0, 60.0, 0.03, 0.5)
KEYS = ("t", "x", "v", "Lambda", "W", "F", "anchored", "sliding")


def assert_same_rows(a, b, rows_a=slice(None), rows_b=slice(None)):
    for key in KEYS:
        np.testing.assert_array_equal(getattr(a, key)[rows_a], getattr(b, key)[rows_b], err_msg=key)


def test_the_law_s_bits_through_a_landing():
    """Half a millisecond about the first main impact, where feet 3 and 4 land, from a state of the compiled run."""
    whole = engine.simulate(MODEL.problem(0.52))
    impact = whole.main_impacts()[0]
    row = int((impact - 0.005) * 2000)
    window = MODEL.problem(0.01, output_rate=1e4, start=whole.state(row))
    a, b = law(window), engine.simulate(window)
    assert_same_rows(a, b)
    touched = b.anchored.any(axis=0)
    assert touched.sum() >= 4, "the window must hold the landing"


def test_restart_is_bitwise_with_every_memory():
    """Cut anywhere, the run goes on as if it had not been cut; effects with a memory of their own included."""
    ids = ("hysteretic_contact", "spin_friction", "rolling_resistance", "compliant_support")
    model = MODEL.replace(effects=tuple(EFFECTS[id].typical() for id in ids[:-1]) + (PITCHING,))
    whole = engine.simulate(model.problem(0.54))
    first = engine.simulate(model.problem(0.51))
    rest = engine.simulate(model.problem(0.03, start=first.final_state))
    assert_same_rows(whole, rest, slice(1020, None))
    for mine, other in zip(whole.final_state.memory, rest.final_state.memory, strict=True):
        for key in mine:
            np.testing.assert_array_equal(mine[key], other[key])


def test_a_pull_lifts_and_turns_a_plate_that_pitches_as_in_the_law():
    """Over the first main impact, where other feet come within the reach of the pull."""
    falling = engine.simulate(MODEL.problem(0.507)).final_state
    start = replace(falling, memory=(), a=None, T=None, F=None)
    pulled, free = (
        MODEL.replace(effects=effects).problem(0.01, output_rate=1e4, start=start)
        for effects in ((EFFECTS["adhesion"](force=20.0), PITCHING), (PITCHING,))
    )
    found = engine.simulate(pulled)
    # The law has the centre of mass from a point and its lever arm: one rounding more, some 1e-16 a step.
    np.testing.assert_allclose(found.W, law(pulled).W, rtol=0, atol=1e-10)
    pitches = [float(r.final_state.memory[-1]["pitch"]) for r in (found, law(pulled), engine.simulate(free))]
    assert pitches[0] == pytest.approx(pitches[1], rel=1e-6)
    # Without the pull it is 3e-4 of it off, three hundred times the bar.
    assert abs(pitches[0] - pitches[2]) > 1e-4 * abs(pitches[0])


def test_results_do_not_depend_on_the_number_of_workers():
    problems = [MODEL.replace(theta_0=0.1 + 0.001 * i).problem(0.05) for i in range(5)]
    one, three = (engine.simulate_many(problems, workers=k) for k in (1, 3))
    for a, b in zip(one, three, strict=True):
        assert_same_rows(a, b)
    assert not np.array_equal(one[0].W, one[1].W)


def test_a_batch_that_loses_one_block_names_it():
    good, bad = (similar_problem(seed, 4) for seed in (1, 5))
    start = state(np.random.default_rng(5), 4, False, False)
    bad = bad.replace(start=replace(start, v=np.full(3, 1e305)))  # the first forces overflow
    with pytest.raises(NumericalError):
        engine.simulate(stack([good, bad]))
    kept = engine.simulate(stack([good, bad]), keep_going=True)
    np.testing.assert_array_equal(kept.W[0], engine.simulate(good).W)
    assert np.isnan(kept.W[1, 1:]).any(axis=-1).all() and not np.isnan(kept.t).any()


@pytest.mark.parametrize("what", ["x", "v", "W"])
def test_start_without_numbers_is_refused_as_the_law_refuses_it(what):
    problem = similar_problem(5, 4)
    a = np.array(getattr(problem.start, what), copy=True)
    a[0] = np.nan
    problem = problem.replace(start=replace(problem.start, **{what: a}))
    for run in (law, engine.simulate):
        error = refused(run, problem)
        assert error.code == "E-START"


def lost_alike(problem) -> str:
    """What the law and the compiled engine both say of a problem that loses its numbers."""
    texts = []
    for run in (law, engine.simulate):
        with pytest.raises(NumericalError) as error:
            run(problem)
        texts.append(str(error.value))
    assert texts[0] == texts[1]
    return texts[0]


def test_lost_numbers_are_reported_as_the_law_reports_them():
    """The message names step and point: those that the law names."""
    rng = np.random.default_rng(5)
    problem = replace(similar_problem(5, 4), start=state(rng, 4, False, False))
    problem = problem.replace(start=replace(problem.start, v=np.full(3, 1e305)))
    said = lost_alike(problem)
    assert "step" in said and "E-NAN" in said


def test_a_step_that_turns_too_far_is_refused_as_the_law_refuses_it():
    problem = MODEL.problem(1e-3)
    problem = problem.replace(start=replace(problem.start, W=np.array([0.0, 0.0, 4e5])))
    for run in (law, engine.simulate):
        error = refused(run, problem)
        assert (error.code, error.where) == ("E-ANGLE", "step 1 (t = 1e-05 s)")


def test_a_turn_that_overflows_is_lost_numbers_at_its_step():
    """A rate whose square is beyond float64: no angle is told, but the step."""
    problem = MODEL.problem(1e-3)
    problem = problem.replace(start=replace(problem.start, W=np.array([1e160, 0.0, 0.0])))
    said = lost_alike(problem)
    assert said.startswith("step 1 (t = 1e-05 s): ") and said.endswith("[E-NAN]")


def test_random_problems_reach_every_branch():
    """What the property tests draw: feet that stick, slide, lift, land; short and long series of the rotation."""
    seen = set()
    for seed in range(60):
        r = engine.simulate(similar_problem(seed, 6))
        on, slides = r.anchored, r.sliding
        seen |= {"stick"} if (on & ~slides).any() else set()
        seen |= {"slide"} if slides.any() else set()
        seen |= {"land"} if (on[1:] & ~on[:-1]).any() else set()
        seen |= {"lift"} if (~on[1:] & on[:-1]).any() else set()
        seen |= {"flight"} if (~on.any(axis=-1)).any() else set()
        seen |= {"grip again"} if (on[1:] & ~slides[1:] & slides[:-1]).any() else set()
    assert seen == {"stick", "slide", "land", "lift", "flight", "grip again"}
    rng = np.random.default_rng(0)
    turns = [np.linalg.norm(state(rng, 1, True, False).W) * 1e-5 for _ in range(20)]
    assert min(turns) < 0.03 < max(turns)
    assert np.count_nonzero(inertia(rng, False)) == 9


def test_auto_takes_the_compiled_step_where_it_can():
    problem = MODEL.problem(0.01)
    assert engines.chosen(problem, "auto") == "numba"
    assert engines.chosen(problem, "auto", np.longdouble) == "numpy"
    assert engines.chosen(problem, "numpy") == "numpy"
    single = replace(problem.start, x=problem.start.x.astype(np.float32))
    assert engines.chosen(problem.replace(start=single), "auto") == "numpy"


@pytest.mark.parametrize("ask", [{"engine": "fortran"}, {"engine": "numba", "dtype": np.float32}])
def test_what_cannot_be_had_is_refused(ask):
    error = refused(rockref.simulate, MODEL, 0.01, **ask)
    assert error.code == "E-ENGINE"


def test_without_numba_numpy_runs_and_asking_for_it_says_what_to_install(monkeypatch):
    monkeypatch.setattr(engines, "has_numba", lambda: False)
    problem = MODEL.problem(1e-3)
    assert engines.chosen(problem, "auto") == "numpy"
    error = refused(engines.run, problem, "numba")
    assert "rockref[fast]" in error.cure


def test_compiled_code_is_found_again_by_the_next_process():
    """A compiled function in a closure would change the key of the stored code in every process."""
    engine.simulate(MODEL.problem(1e-3))
    code = (
        "import rockref; from rockref.engines.compiled import engine, kernel;"
        "engine.simulate(rockref.Model.table_3_1().problem(1e-3));"
        "print(sum(kernel.LOOPS[0].stats.cache_hits.values()), sum(kernel.LOOPS[0].stats.cache_misses.values()))"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert out == ["1", "0"]


def test_the_fingerprint_follows_the_text(tmp_path, monkeypatch):
    """Any change of a file of the compiled step makes numba compile anew."""
    before = sources.fingerprint()
    for path in sorted(sources.Path(sources.__file__).parent.glob("*.py")):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    monkeypatch.setattr(sources, "__file__", str(tmp_path / "sources.py"))
    assert sources.fingerprint() == before
    (tmp_path / "contact.py").write_text((tmp_path / "contact.py").read_text() + "#")
    assert sources.fingerprint() != before


@pytest.mark.parametrize("groups", slots.VARIANTS)
def test_stored_code_holds_the_fingerprint_and_no_compiled_function(groups):
    held = [cell.cell_contents for cell in kernel.LOOPS[groups].py_func.__closure__]
    assert {sources.FINGERPRINT, groups} <= set(held)
    assert all(type(value) is int for value in held)


@pytest.mark.parametrize("steps_a_report", [1, 37, 100, 10**6])
@pytest.mark.parametrize("ids", [(), ("hysteretic_contact", "spin_friction", "compliant_support")], ids=len)
def test_a_run_in_pieces_has_the_bits_of_one_run(ids, steps_a_report, monkeypatch):
    """Pieces are made where somebody watches; rows every third step, a last piece shorter than the others."""
    model = MODEL.replace(effects=tuple(EFFECTS[id].typical() for id in ids))
    problem = model.problem(3e-3, output_rate=1e5 / 3)
    whole = engine.simulate(problem)
    monkeypatch.setattr(engine, "STEPS_A_REPORT", steps_a_report)
    seen = []
    pieces = engine.simulate(problem, progress=seen.append)
    for key in ("t", "x", "v", "Lambda", "W", "F", "s", "anchored", "sliding"):
        assert np.array_equal(getattr(whole, key), getattr(pieces, key)), key
    assert restart_bits(whole) == restart_bits(pieces)
    assert seen[-1] == 1.0
    assert np.all(np.diff(seen) > 0)
    assert len(seen) == {1: 101, 37: 9, 100: 4, 10**6: 1}[steps_a_report]


def restart_bits(response):
    final = response.final_state
    return [np.asarray(getattr(final, k)).tobytes() for k in ("x", "v", "Lambda", "W", "s", "a", "T", "F")] + [
        final.t, final.origin, final.count
    ]  # fmt: skip


def test_a_run_in_pieces_is_lost_where_one_run_is(monkeypatch):
    problem = MODEL.problem(1e-3, output_rate=1e5)
    problem = problem.replace(start=replace(problem.start, v=np.full(3, 1e305)))
    monkeypatch.setattr(engine, "STEPS_A_REPORT", 1)
    texts = []
    for progress in (None, lambda share: None):
        with pytest.raises(NumericalError) as error:
            engine.simulate(problem, progress=progress)
        texts.append(str(error.value))
    assert texts[0] == texts[1]
    kept = [engine.simulate(problem, progress, keep_going=True) for progress in (None, lambda share: None)]
    assert np.array_equal(kept[0].x, kept[1].x, equal_nan=True)
    assert np.array_equal(kept[0].F, kept[1].F, equal_nan=True)


def test_a_batch_reports_after_every_few_runs(monkeypatch):
    monkeypatch.setattr(engine, "RUNS_A_REPORT", 1)
    monkeypatch.setattr(engine.os, "cpu_count", lambda: 2)
    seen = []
    engine.simulate(stack([MODEL.problem(1e-4, output_rate=1e5)] * 4), progress=seen.append)
    assert seen == [0.5, 1.0]
