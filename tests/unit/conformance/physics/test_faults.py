"""Each seeded fault shows in its own check, with its cause; the same engine without it passes there."""

import numpy as np
import pytest

from rockref import engines
from rockref.conformance.physics.adapter import Engine, load
from rockref.conformance.physics.checks import CHECKS
from rockref.conformance.physics.trial import Trial
from rockref.model import contact as law
from tests.unit.conformance.physics import seeded


def asked(adapter, *checks):
    trial = Trial(Engine(adapter, "default"))
    return [CHECKS[name](trial) for name in checks]


class TestFreeMotion:
    def test_the_template_passes(self):
        found = asked(seeded.free("", ""), "echo", "flight", "fall")
        # The drift of a first-order integrator is a remark, with its size.
        assert (
            [f.verdict for f in found] == ["pass", "remark", "pass"]
            and "4 %" in found[1].seen
            and found[1].cause == "integrator"
        )

    @pytest.mark.parametrize(
        "check, cause, text, fault",
        [
            ("echo", "frame", "R, v, omega = (", "R, omega, v = ("),
            ("echo", "gyroscopic", "np.cross(J * w, w)", "0 * np.cross(J * w, w)"),
            ("echo", "inertia", "J, g = np.array(scene.inertia)", "J, g = np.array(scene.inertia)[[1, 0, 2]]"),
            ("echo", "damping", "omega = R @ w", "omega = R @ w * 0.999"),
            ("echo", "precision", "np.array(a, float) for a in start", "np.array(a, np.float32) for a in start"),
            ("echo", "count", "range(leg.steps)", "range(leg.steps and leg.steps + 1)"),
            ("flight", "inertia", "J, g = np.array(scene.inertia)", "J, g = np.array(scene.inertia)[[1, 0, 2]]"),
            ("flight", "damping", "omega = R @ w", "omega = R @ w * (1 - 0.01 * scene.step)"),
            ("fall", "gravity", "v = v + scene.step * g", "v = v + 0.995 * scene.step * g"),
            ("fall", "damping", "v = v + scene.step * g", "v = (v + scene.step * g) * (1 - 0.04 * scene.step)"),
        ],
    )
    def test_a_fault_shows_in_its_check(self, check, cause, text, fault):
        (found,) = asked(seeded.free(text, fault), check)
        assert (found.verdict, found.cause) == ("fail", cause), found


@pytest.fixture
def numba():
    pytest.importorskip("numba")


@pytest.mark.usefixtures("numba")
class TestContact:
    def test_the_law_passes_where_its_faulty_copies_fail(self):
        found = asked(seeded.contact(), "rocking period", "apex energy", "impact ratio", "balance on an edge")
        assert [f.verdict for f in found] == ["pass"] * 4, found

    def test_swapped_moments_show_in_free_motion_and_not_in_rocking(self):
        # The small moment, now about the long side's normal, asks for a smaller step.
        adapter = seeded.contact(seeded.swapped_inertia, step=5e-5)
        echo, ratio = asked(adapter, "echo", "impact ratio")
        assert (echo.verdict, echo.cause, ratio.verdict) == ("fail", "inertia", "pass")

    def test_half_a_percent_of_gravity_shows_in_the_fall_alone(self):
        fall, period, balance = asked(
            seeded.contact(seeded.weaker_gravity), "fall", "rocking period", "balance on an edge"
        )
        assert (fall.verdict, fall.cause) == ("fail", "gravity")
        assert fall.numbers["speed"] == pytest.approx(-0.005, rel=1e-3)
        # A quarter of a percent of time is within the bars of the others: they take no blame for it.
        assert period.verdict == balance.verdict == "pass"

    def test_sleep_keeps_the_block_on_its_edge(self):
        (found,) = asked(seeded.contact(seeded.with_sleep), "balance on an edge")
        assert (found.verdict, found.cause) == ("fail", "sleep") and found.seen.count("stays there") == 2

    def test_energy_gained_at_impacts_shows_in_the_apexes(self):
        energy, ratio = asked(seeded.contact(seeded.lively), "apex energy", "impact ratio")
        assert (energy.verdict, energy.cause) == ("fail", "energy")
        assert (ratio.verdict, ratio.numbers["ratio"] > 1) == ("fail", True)

    def test_a_soft_contact_that_only_takes_energy_is_not_accused(self):
        (energy,) = asked(seeded.contact(K=1e5, beta=0.05), "apex energy")
        assert energy.verdict == "pass" and energy.numbers["rise"] < 0.95

    def test_vibration_that_lifts_an_apex_is_not_judged(self):
        """A contact without damping gives back what an earlier impact took: 0.500, 0.458, 0.474 of alpha."""
        (energy,) = asked(seeded.contact(K=1e6, beta=0.0, step=5e-5), "apex energy")
        assert (energy.verdict, energy.cause) == ("not judged", "rattling") and energy.numbers["rise"] > 1.02

    def test_soft_contact_is_not_judged(self):
        found = asked(seeded.contact(K=2e5), "rocking period", "balance on an edge", "half step", "toppling")
        assert {(f.verdict, f.cause) for f in found} == {("not judged", "soft")}

    @pytest.mark.parametrize(
        "norm, way, cause",
        [
            (1, "too far", "pyramid_inside"),
            pytest.param(np.inf, "too short", "pyramid_outside", marks=pytest.mark.slow),
        ],
    )
    def test_a_pyramid_shows_along_the_diagonal(self, monkeypatch, norm, way, cause):
        """Coulomb's circle in the law replaced by the square inside or around it."""
        monkeypatch.setattr(law, "norm", lambda F: np.linalg.norm(F, norm, axis=-1))
        monkeypatch.setattr(engines, "has_numba", lambda: False)
        adapter = seeded.contact(K=2e5, step=5e-4)
        (found,) = asked(adapter, "slide")
        assert (found.verdict, found.cause) == ("fail", cause)
        assert way in found.seen and "along the diagonal" in found.seen


class TestPyBulletOnSoftContact:
    """Soft contact at 1e5 N/m: the engine's plane finds two of four corners, and its apexes rise; a box finds four."""

    KNOBS = {"damping": 0.0, "stiffness": 1e5, "contact_damping": 1000.0}

    @pytest.mark.parametrize("ground, verdict, cause", [("plane", "fail", "few_contacts"), ("box", "pass", "")])
    def test_apexes(self, ground, verdict, cause):
        pytest.importorskip("pybullet")
        adapter = load("pybullet")
        adapter.settings = {"default": self.KNOBS | {"ground": ground}}
        (energy,) = asked(adapter, "apex energy")
        assert (energy.verdict, energy.cause) == (verdict, cause), energy
