"""Gains of fitted families, on bowls in place of fits."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover.fit.evidence import CLIP
from rockref.discover.fit.families import (
    Family,
    amplitudes,
    by_sample,
    far_fetched,
    gain_between,
    size_of,
    vibration_amplitude,
)
from rockref.discover.fit.fitted import estimates
from rockref.discover.fit.least_squares import Point
from rockref.discover.hypotheses.counted import Parameter
from tests.unit.discover.bowls import SAMPLES, WINDOWS, Bowl, family, series


def test_gains_over_moved_windows_are_clipped_like_all_others():
    """All windows far off before, at the noise after: clipped, the gain is the same however the windows are cut."""
    kept = family((), Bowl(np.array([0.0]), floor=4.0), [0.0])
    same = family(("inertia_deviation",), Bowl(np.array([0.0, 1.0])), [0.0, 1.0])
    moved = family(("gyro_scale",), Bowl(np.array([0.0, 1.0]), series=series(7)), [0.0, 1.0])
    most = CLIP * kept.fit.series.count.sum()
    assert gain_between(kept, same) == pytest.approx(most)
    assert gain_between(kept, moved) == pytest.approx(most)


def test_the_loss_by_sample_sums_to_the_loss():
    one = family((), Bowl(np.array([0.0]), floor=1.3, series=series(5)), [0.2])
    shared = by_sample(one, one.point.loss)
    assert shared.sum() == pytest.approx(one.point.loss.sum())
    assert len(shared) == WINDOWS * SAMPLES


def test_a_form_of_a_law_is_no_size_of_it():
    """A wire that would let go evenly, but does not pull, is not there; one that pulls is as large as its pull."""
    names = ("lingering_wire_pull.force", "lingering_wire_pull.tau", "lingering_wire_pull.evenness")
    fit = SimpleNamespace(parameters=tuple(Parameter(n, None, 0.0, 1.0) for n in names))
    for pull in (0.0, 0.4):
        wire = Family(("lingering_wire_pull",), fit, Point(np.array([pull, 2.0, 1.0]), None, np.ones(1)))
        assert size_of(wire) == pull


def test_what_stands_below_its_absence_has_no_size():
    """A fit may leave z there, where nothing changes; what may be of either sign has a size on both sides."""
    for name, low, size in (("quadratic_drag.c", 0.0, 0.0), ("mass_eccentricity.x", -np.inf, 1.2)):
        fit = SimpleNamespace(parameters=(Parameter(name, None, 0.0, 0.1, low=low),))
        assert size_of(Family((name.split(".")[0],), fit, Point(np.array([-1.2]), None, np.ones(1)))) == size


@pytest.mark.parametrize("scale, found", [(2.5, {"dimension_deviation"}), (4.2, set())])
def test_what_would_have_to_be_far_above_its_typical_size_is_far_fetched(scale, found):
    """Unless the winner has to be, too."""

    def sized(effect: str, z: float) -> Family:
        fit = SimpleNamespace(parameters=(Parameter(f"{effect}.x", None, 1.0, 0.02),))
        return Family((effect,), fit, Point(np.array([z]), None, np.ones(1)))

    winner = sized("gyro_scale", scale)
    families = [winner, sized("dimension_deviation", -4.45), sized("inertia_deviation", 3.9)]
    assert far_fetched(families, winner) == found


def test_what_leaks_into_a_number_that_is_typically_none_is_in_its_interval():
    """A turned gyroscope, so sure of itself that only the systematic parts of the intervals are left."""
    turn = Parameter("gyro_misalignment.x", None, 0.0, 0.03, unit="rad")
    skew = Parameter("gyro_misalignment.xy", None, 0.0, 0.005, unit="rad")
    other = Parameter("gyro_scale.x", None, 1.0, 0.02, unit="-")
    parameters, z = (Parameter("K_N", None, 1.0, 0.15, log=True), turn, skew, other), np.array([0.4, 1.5, 0.1, 2.0])
    fit = SimpleNamespace(
        parameters=parameters, prior=np.ones(4), normal_equations=lambda point: (1e12 * np.eye(4), None, None)
    )
    found = amplitudes(Family(("gyro_misalignment",), fit, Point(z, None, np.ones(1))))
    half = {name: (row["high"] - row["low"]) / 2 for name, row in found.items()}
    assert half["gyro_misalignment.x"] == pytest.approx(0.15 * 0.045, rel=1e-4)
    # Three per cent of 45 mrad: no skew is claimed where the interval holds none.
    assert half["gyro_misalignment.xy"] == pytest.approx(np.hypot(0.15 * 0.0005, 0.03 * 0.045), rel=1e-4)
    assert half["gyro_scale.x"] == pytest.approx(0.15 * 0.04, rel=1e-4)
    # `rockref add` reads the same rule.
    again = estimates(fit, Point(z, None, np.ones(1)), np.linalg.inv(1e12 * np.eye(4) + np.eye(4)))
    assert {e.name: (e.low, e.high) for e in again if e.of_effect} == {
        name: (row["low"], row["high"]) for name, row in found.items()
    }


def test_a_number_in_another_unit_follows_what_its_effect_may_be_wrong_by():
    """Runs that know the sum of two moments of drag: 15 % of the one, all wrong, are as much of the other."""
    c = Parameter("quadratic_drag.c", None, 0.0, 0.4, unit="N m s2")
    c_v = Parameter("quadratic_drag.c_v", None, 0.0, 20.0, unit="N s2/m2")
    arm = 0.04  # of the centre, to the third power: c_v counts so much against c
    direction = np.array([0.4, 20.0 * arm])
    H = 1e12 * np.outer(direction, direction)
    fit = SimpleNamespace(parameters=(c, c_v), prior=np.ones(2), normal_equations=lambda point: (H, None, None))
    found = amplitudes(Family(("quadratic_drag",), fit, Point(np.array([0.9, 0.05]), None, np.ones(1))))
    half = {name: row["high"] - row["value"] for name, row in found.items()}
    # The priors leave the difference of the two free to some z.
    sd = np.sqrt(np.diag(np.linalg.inv(H + np.eye(2)))) * np.array([0.4, 20.0])
    statistical = 1.645 * 2.0 * sd
    assert half["quadratic_drag.c_v"] == pytest.approx(
        np.linalg.norm([statistical[1], 0.15 * 1.0, 0.15 * 0.36 / arm]), rel=1e-4
    )
    assert half["quadratic_drag.c"] == pytest.approx(np.hypot(statistical[0], 0.15 * 0.36), rel=1e-4)


def test_the_amplitude_of_a_shaking_base_is_that_of_its_two_parts():
    assert vibration_amplitude({"gyro_scale.x": {"value": 1.0}}) == {}
    parts = {"cosine[0]": 0.03, "sine[0]": 0.04, "cosine[1]": 0.0, "sine[1]": -0.05}
    found = vibration_amplitude({f"base_vibration.{k}": {"value": v} for k, v in parts.items()})
    row = found["base_vibration.amplitude"]
    # Two runs that agree leave what is systematic alone.
    assert row["value"] == pytest.approx(0.05) and row["unit"] == "m/s2"
    assert (row["low"], row["high"]) == pytest.approx((0.05 * 0.85, 0.05 * 1.15))
