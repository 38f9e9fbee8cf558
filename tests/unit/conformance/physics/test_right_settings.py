"""Right settings of different engines are not accused: no check fails."""

import pytest

from rockref.conformance.physics.adapter import Adapter, Engine, load
from rockref.conformance.physics.profile import judge_setting

QUICK, SLOW = (), pytest.mark.slow
#: Engine, knobs (None: its careful setting), mark. They differ in law, stiffness, damping, step and precision.
RIGHT = [
    ("rockref4", {"K": 4e6, "beta": 0.2, "step": 8e-5}, QUICK),
    ("rockref", {"inner": 0.006, "K": 1e7, "beta": 0.1, "step": 5e-5}, SLOW),
    ("rockref", None, SLOW),
    ("rockref4", {"K": 5e7, "beta": 0.5, "step": 1e-5}, SLOW),
    ("mujoco", None, QUICK),
    (
        "mujoco",
        {"cone": "elliptic", "impratio": 20, "solref": "0.002 1", "solimp": "0.99 0.99 0.001", "step": 5e-4},
        SLOW,
    ),
    ("pybullet", None, QUICK),
    ("pybullet", {"damping": 0.0, "step": 5e-4}, SLOW),
    ("drake", None, SLOW),
    ("dart", None, SLOW),
    ("rapier", None, SLOW),
    ("physx", None, SLOW),
    ("lammps", None, SLOW),
]


def engine_or_skip(name):
    adapter = load(name)
    why = adapter.absence()
    if why is not None:
        pytest.skip(why)
    if name.startswith("rockref"):
        pytest.importorskip("numba")  # in NumPy alone a setting takes minutes
    return adapter


@pytest.mark.parametrize(
    "name, knobs", [pytest.param(n, k, marks=m, id=f"{n}-{i}") for i, (n, k, m) in enumerate(RIGHT)]
)
def test_no_check_fails(name, knobs):
    adapter = engine_or_skip(name)
    if knobs is not None:
        adapter.settings = {"careful": knobs}
    found = judge_setting(adapter, "careful")
    assert {f.check: f.seen for f in found if f.verdict not in ("pass", "remark")} == {}


#: What each engine showed as it comes out of the box: check and cause.
KNOWN = [
    ("mujoco", "slide", "pyramid_inside"),
    ("mujoco", "slope", "pyramid_inside"),
    ("mujoco", "rest", "creep"),
    ("pybullet", "fall", "damping"),
    ("dart", "slide", "pyramid_outside"),
    ("rapier", "balance on an edge", "sleep"),
    ("rapier", "rocking period", "early"),
    ("physx", "flight", "damping"),
]


@pytest.mark.parametrize("name, check, cause", KNOWN)
def test_a_known_fault_of_a_default_is_named(name, check, cause):
    from rockref.conformance.physics.checks import CHECKS
    from rockref.conformance.physics.trial import Trial

    adapter: Adapter = engine_or_skip(name)
    found = CHECKS[check](Trial(Engine(adapter, "default")))
    assert (found.verdict, found.cause) == ("fail", cause) and cause in adapter.knobs
