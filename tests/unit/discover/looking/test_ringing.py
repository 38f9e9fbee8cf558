"""At what tone a plate rings is told by an iteration of everything at each tone."""

import numpy as np
import pytest

from rockref.discover.fit.approach import HEAVIER
from rockref.discover.fit.families import refit
from rockref.discover.looking.far import LOOKS, nominal_beside
from rockref.discover.looking.ringing import COMPLIANCE, TONES, at_its_tone
from tests.unit.discover.looking.test_far import far_from

MASS = "compliant_support.mass"


def heard(effect: str, sure: bool = False):
    """What tones show of runs that an effect has bent, and the family without a plate."""
    setup, kept = far_from(effect)
    plain = nominal_beside(setup, kept)
    return at_its_tone(setup, plain, refit(plain, LOOKS, 0), sure), plain


def compliance_at_typical_mass(frequency: float, mass: float, block: float) -> float:
    """Compliance of the plate of 100 kg that rings with the block on it as this one does."""
    return (60 / frequency) ** 2 * (100 / (100 + block)) / (mass / (mass + block))


@pytest.fixture(scope="module")
def plates():
    """A plate whose tone lies half way between two of those that are tried, and whose mass is not the typical one."""
    between = float(np.sqrt(TONES[6] * TONES[7]))
    found, plain = heard(f"compliant_support:frequency={60 / between**0.5},mass=130")
    return found, plain, between


def test_the_tone_of_plate_and_block_is_found_between_those_that_are_tried(plates):
    (first, *_), plain, between = plates
    names = [p.name for p in first.fit.parameters]
    rings = compliance_at_typical_mass(60 / between**0.5, 130.0, plain.fit.base.mass)
    # Each lies 26 % from the next: closer than a quarter of that is none of those that were tried.
    assert first.point.z[names.index(COMPLIANCE)] == pytest.approx(rings, rel=0.06)


def test_nothing_but_the_tone_is_taken_from_the_iterations_and_other_masses_ring_alike(plates):
    found, plain, _ = plates
    names = [p.name for p in found[0].fit.parameters]
    own = [names.index(COMPLIANCE), names.index(MASS)]
    assert [f.point.z[own[1]] for f in found] == [0.0, *HEAVIER]
    for f in found:
        rest = np.delete(f.point.z, own)
        assert np.array_equal(rest[: len(plain.point.z)], plain.point.z) and not np.any(rest[len(plain.point.z) :])


def test_where_no_tone_comes_nearer_there_is_no_plate_unless_it_was_found_before():
    assert heard("gyro_scale:x=0.96,y=0.97,z=0.98")[0] == []
    assert len(heard("gyro_scale:x=0.96,y=0.97,z=0.98", sure=True)[0]) == 1 + len(HEAVIER)
