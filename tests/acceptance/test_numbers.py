"""Numbers at the edge: what is too much is refused or said, and what is long does not drift."""

import hashlib
import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import rockref
from rockref import InputError, Model, State
from rockref.model import rotation
from rockref.model.errors import NumericalError
from tests.refusal import refused

MODEL = Model.table_3_1()
WEIGHT = 54 * 9.81


def standing():
    """The block at rest on the plate: dropped from a hair's breadth, and three seconds of damping."""
    problem = MODEL.problem(duration=3.0, output_rate=100.0)
    upright = State.at_rest(np.array([0, 0, 0.344]), np.eye(3), 8)
    return rockref.simulate(replace(problem, start=upright), engine="numba").final_state


class TestRefused:
    @pytest.mark.parametrize("engine", ["numpy", "numba"])
    def test_stiffness_times_a_million(self, engine):
        error = refused(rockref.simulate, MODEL.replace(K_N=6e13), engine=engine)
        assert error.code == "E-STEP"
        # and the step that it offers is one with which it runs
        step = float(error.cure.split()[-2])
        assert step < 1e-7
        assert np.all(np.isfinite(rockref.simulate(MODEL.replace(K_N=6e13), duration=100 * step, step=step).W))

    @pytest.mark.parametrize("engine", ["numpy", "numba"])
    def test_step_times_a_hundred(self, engine):
        error = refused(rockref.simulate, MODEL, step=1e-3, output_rate=100.0, engine=engine)
        assert error.code == "E-STEP"

    @pytest.mark.parametrize("key", ["mass", "K_N", "K_T"])
    @pytest.mark.parametrize("value", [1e308, 5e-324])
    def test_numbers_at_the_ends_of_float64(self, key, value):
        """Refused, or stopped with step and point, or run with finite numbers: never quietly not finite."""
        try:
            response = rockref.simulate(MODEL.replace(**{key: value}), duration=1e-3, output_rate=1000.0)
        except (InputError, NumericalError) as e:
            assert e.code in ("E-STEP", "E-NAN", "E-RANGE", "E-TILT", "E-START", "E-ANGLE")
        else:
            assert all(np.all(np.isfinite(getattr(response, k))) for k in ("x", "v", "W", "F", "Lambda"))


class TestThrown:
    @pytest.mark.parametrize("engine", ["numpy", "numba"])
    @pytest.mark.parametrize("v", [(100.0, 0, 0), (0, 0, -100.0), (30.0, -80, -50)])
    def test_at_a_hundred_metres_a_second(self, v, engine):
        """It bounces, slides and tumbles; energy is only lost, or the run stops and says where."""
        problem = MODEL.problem(duration=0.02, output_rate=1000.0)
        start = State.at_rest(np.array([0, 0, 0.345]), np.eye(3), 8, v=np.array(v), W=np.array([3.0, 1, 2]))
        try:
            response = rockref.simulate(replace(problem, start=start), engine=engine)
        except (InputError, NumericalError) as e:
            assert e.code in ("E-NAN", "E-ANGLE")
            return
        e = response.energy()
        mechanical = e["kinetic"] + e["potential"]
        # a blow of 4000 kN makes the step itself lose and create a little: below 1e-3 of what there is
        assert np.all(mechanical <= mechanical[0] * (1 + 1e-3))

    def test_energy_of_a_subnormal_motion_is_not_noise(self):
        """W of 1e-310 rad/s in free flight stays what it is."""
        problem = MODEL.problem(duration=0.01, output_rate=1000.0)
        start = State.at_rest(np.array([0, 0, 10.0]), np.eye(3), 8, W=np.array([0, 0, 1e-310]))
        response = rockref.simulate(replace(problem, start=start), engine="numpy")
        assert response.W[-1, 2] == pytest.approx(1e-310, rel=1e-10)
        assert np.all(response.W[:, :2] == 0)


class TestLong:
    def test_a_million_steps_at_rest(self):
        """No drift, no creep: anchors stay, positions move by less than an atom."""
        start = standing()
        problem = replace(MODEL.problem(duration=10.0, output_rate=10.0), start=start)
        response = rockref.simulate(problem, engine="numba")
        assert response.final_state.count - start.count == 1_000_000
        assert np.max(np.abs(response.x - response.x[0])) < 1e-10
        turned = rotation.logarithm(rotation.product(response.Lambda, response.Lambda[0].T))
        assert np.max(np.abs(turned)) < 1e-10
        assert not np.any(response.sliding)
        assert np.array_equal(response.anchored[0], response.anchored[-1])
        assert np.sum(response.F[-1, :, 2]) == pytest.approx(WEIGHT, rel=1e-9)

    @pytest.mark.slow
    def test_an_hour_of_rocking(self):
        """3.6e8 steps from release: energy falls to that of the block at rest, and never rises again.

        Between two rows the contacts take or the step creates; after the rocking has died the total must stay.
        """
        problem = MODEL.problem(duration=3600.0, output_rate=10.0)
        response = rockref.simulate(problem, engine="numba")
        total = response.energy()["total"]
        swing = total[0] - total[-1]
        # the residual of the step is of order two: 1e-7 of what is lost in all
        assert np.all(np.diff(total) <= 1e-6 * swing)
        assert np.max(np.abs(np.diff(total[-30000:]))) <= 1e-12 * total[-1]
        gram = rotation.product(rotation.transposed(response.Lambda[-1]), response.Lambda[-1])
        # one rounding a step at random: the root of 3.6e8 times 1e-16
        assert np.max(np.abs(gram - np.eye(3))) < 1e-11
        assert not response.overturned


PROGRAM = """
import hashlib, rockref
r = rockref.simulate(rockref.Model.table_3_1(), duration=0.6, engine={engine!r})
print(hashlib.sha256(b"".join(getattr(r, k).tobytes() for k in ("t", "x", "v", "Lambda", "W", "F", "s"))).hexdigest())
"""


def test_fresh_processes_give_the_same_bits():
    """Whatever the threads and the order of dictionaries: through the first main impact, to the last bit."""
    digests = set()
    for seed, threads in (("0", "1"), ("random", "4")):
        pools = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
        environment = {"PYTHONHASHSEED": seed} | dict.fromkeys(pools, threads)
        done = subprocess.run(
            [sys.executable, "-c", PROGRAM.format(engine="numba")],
            capture_output=True, text=True, check=True, env=os.environ | environment,
        )  # fmt: skip
        digests.add(done.stdout.strip())
    here = rockref.simulate(MODEL, duration=0.6, engine="numba")
    text = b"".join(getattr(here, k).tobytes() for k in ("t", "x", "v", "Lambda", "W", "F", "s"))
    assert digests == {hashlib.sha256(text).hexdigest()}
