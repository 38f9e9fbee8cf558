"""Whatever an effect adds, it keeps the precision of what it is added to."""

from dataclasses import fields, replace

import numpy as np
import pytest

from rockref.effects import catalogue
from rockref.effects.base import Effect
from rockref.effects.probe import sample_problem
from rockref.model.integrator import evaluate_contact
from rockref.model.problem import as_arrays

KINDS = (*catalogue.IN_STEP_ORDER, *catalogue.OF_TOSSES.values())
#: SciPy's splines and filters compute in double precision.
IN_DOUBLE = ("gyro_bandwidth", "clock_error")


def cast(points, dtype):
    """Contact points with every number of this precision."""
    numbers = {f.name: getattr(points, f.name) for f in fields(points) if f.name != "names"}
    return replace(points, **{key: None if a is None else a.astype(dtype) for key, a in numbers.items()})


def overridden(effect, name):
    """Whether the effect has a hook of its own by this name."""
    return getattr(type(effect), name) is not getattr(Effect, name)


def results(effect, dtype):
    """The arrays that the hooks of an effect give back, from the small problem in this precision."""
    problem = as_arrays(sample_problem(), dtype).replace(effects=(effect,))
    s, points, block = problem.start, cast(problem.points, dtype), problem.block
    if effect.id == "foot_defects":
        corners = {f.name: getattr(points, f.name) for f in fields(points)}
        points = replace(points, **{k: None if a is None else a[:4] for k, a in corners.items()})
    c = evaluate_contact(problem.replace(effects=()), s, s.x, s.Lambda, s.v, s.W, s.W * 0, 0.0, ())
    m = effect.start(problem)
    found = list(m.values())
    if overridden(effect, "points"):
        changed_block, changed = effect.points(block, points)
        found += [changed_block.inertia, changed_block.g] + [getattr(changed, k) for k in ("P", "K_N", "C_T", "mu")]
        found += [a for a in (changed.radius,) if a is not None]
    if overridden(effect, "release"):
        state = effect.release(block, points, s)
        found += [state.x, state.v, state.W]
    if overridden(effect, "sensor") and effect.id not in IN_DOUBLE:
        found.append(effect.sensor(np.arange(50) / 2000, np.full((50, 3), 0.1, dtype)))
    if overridden(effect, "normal_force"):
        found.append(effect.normal_force(points.K_N * c.k.xi, c.k, points, m))
    if overridden(effect, "friction_coefficient"):
        found += effect.friction_coefficient(points.mu_0, points.mu, c.F_N, c.k, points, m)
    found += effect.plate_motion(0.0, m) or ()
    found += effect.point_wrench(problem, c, m) or ()
    found += effect.body_wrench(problem, c, s.x, s.Lambda, s.v, s.W, m) or ()
    return [*found, *m.values()]


@pytest.mark.parametrize("dtype", [np.float32, np.longdouble])
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.id)
def test_an_effect_keeps_the_precision_of_what_it_is_given(kind, dtype):
    for array in results(kind.typical(), dtype):
        assert array.dtype == dtype


@pytest.mark.parametrize("kind", [catalogue.EFFECTS["gyro_misalignment"], catalogue.EFFECTS["inertia_deviation"]])
@pytest.mark.parametrize("dtype", [np.float32, np.longdouble])
def test_products_of_two_axes_keep_it_too(kind, dtype):
    for array in results(kind(xy=0.01, xz=0.02, yz=0.03), dtype):
        assert array.dtype == dtype
