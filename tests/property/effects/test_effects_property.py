"""Any effect, at any plausible size, alone and in pairs."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from rockref import Model
from rockref.effects import catalogue
from rockref.effects.probe import sample_problem
from rockref.model.integrator import evaluate
from rockref.model.problem import State
from rockref.model.simulate import simulate

KINDS = [kind for kind in catalogue.IN_STEP_ORDER if kind.id != "foot_defects"]
ADDED = [kind for kind in KINDS if kind.point_wrench is not catalogue.Effect.point_wrench]
ADDED += [kind for kind in KINDS if kind.body_wrench is not catalogue.Effect.body_wrench]


@st.composite
def effects(draw, kinds=KINDS):
    """An effect with every parameter in its plausible range."""
    kind = draw(st.sampled_from(kinds))
    values = {
        name: draw(st.floats(q.low, q.high, allow_nan=False)) if q.absent is not None else None
        for name, q in kind.quantities.items()
    }
    return kind(**values)


@st.composite
def states(draw):
    """The block near its feet, moving: some points touch, some slide."""
    problem = sample_problem()
    W = np.array([draw(st.floats(-0.5, 0.5)) for _ in range(3)])
    v = np.array([draw(st.floats(-0.05, 0.05)) for _ in range(3)])
    x = np.array([0, 0, 0.344 + draw(st.floats(-2e-5, 1e-4))])
    return problem.replace(start=State.at_rest(x, np.eye(3), 8, v, W))


def loads(problem, chosen):
    """Acceleration and moment of one evaluation, with the memories that a step finds."""
    problem = problem.replace(effects=tuple(chosen))
    memory = tuple(effect.start(problem) for effect in chosen)
    s = problem.start
    start = State.at_rest(s.x, s.Lambda, 8, s.v, s.W)
    start = State(**{**start.__dict__, "memory": memory})
    a, T, _, _ = evaluate(problem, start, s.x, s.Lambda, s.v, s.W, s.W * problem.step, 0.01)
    return np.concatenate([a, T])


@given(states(), effects(ADDED), effects(ADDED))
def test_added_loads_add_up(problem, one, other):
    """Forces and moments put on the body do not see each other: two together are the sum of the two."""
    if one.id == other.id:
        return
    plain = loads(problem, [])
    both = loads(problem, catalogue.in_step_order([one, other])) - plain
    each = (loads(problem, [one]) - plain) + (loads(problem, [other]) - plain)
    # Rounding of the whole loads, of which the differences are taken.
    assert np.all(np.abs(both - each) <= 1e-12 * (np.abs(plain).max() + np.abs(each).max() + 1))


@settings(max_examples=40)
@given(states(), st.lists(effects(), min_size=1, max_size=3, unique_by=lambda e: e.id))
def test_any_effects_run_and_their_order_does_not_matter(problem, chosen):
    """A model gives the same bits however its effects are listed, and no number is lost."""
    start = problem.start
    runs = []
    for listed in (chosen, chosen[::-1]):
        model = Model.table_3_1().replace(effects=tuple(listed))
        runs.append(simulate(model.problem(duration=2e-4, output_rate=1e5, start=start)))
    assert np.all(np.isfinite(runs[0].W)) and np.all(np.isfinite(runs[0].F))
    for key in ("x", "v", "Lambda", "W", "F"):
        assert getattr(runs[0], key).tobytes() == getattr(runs[1], key).tobytes()
    assert np.all(runs[0].F[..., 2] >= 0)  # the plate never pulls


@given(effects())
def test_words_and_tables_bring_an_effect_back(effect):
    effect.check("here")
    (back,) = catalogue.from_table("model.toml", catalogue.to_table([effect]))
    assert back == effect
    words = ",".join(f"{name}={value!r}" for name, value in effect.values().items() if value is not None)
    assert catalogue.parse(f"{effect.id}:{words}") == effect


@given(effects([k for k in KINDS if k.question == "sensor"]), st.integers(0, 2**32 - 1))
def test_sensors_keep_the_shape(effect, seed):
    crv = np.random.default_rng(seed).normal(size=(2, 60, 3))
    out = effect.sensor(np.arange(60) / 2000, crv)
    assert out.shape == crv.shape and out.dtype == crv.dtype and np.all(np.isfinite(out))
