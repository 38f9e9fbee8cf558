"""What a fit assumes of every quantity beforehand: declared in the effect's own file, or computed from the quantity."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

from rockref.effects import scale
from rockref.effects.base import Effect, Quantity
from rockref.effects.catalogue import EFFECTS, OF_TOSSES
from rockref.effects.prior import RIGID, ROLES, SCALES, Prior
from rockref.effects.scale import from_scale, prior_of, to_scale

KINDS = EFFECTS | OF_TOSSES
NUMBERS = [(kind, name) for kind in KINDS.values() for name in kind.quantities]


@pytest.fixture(autouse=True)
def computed_anew():
    """A prior is completed once a process; here every time."""
    scale._prior_of.cache_clear()


@dataclass(frozen=True)
class Gust(Effect):
    """A user's effect that declares nothing."""

    id = "gust"
    quantities = {
        "force": Quantity("N", 0.0, 0.5, 5.0, 2.0, "+", least=-1.0, most=100.0),
        "scale": Quantity("1", 1.0, 0.5, 2.0, 0.9, least=0.1),
        "range": Quantity("m", math.inf, 0.1, 10.0, 4.0),
        "push": Quantity("N", 0.0, -2.0, 2.0, 0.0),
        "swing": Quantity("N", 0.0, -3.0, 3.0, 0.0),
        "stretch": Quantity("1", 1.0, 1.0, 3.0, 2.0, "+"),
        "reference": Quantity("m", 1.0, 0.5, 2.0, 1.5),
    }
    switches = ("force", "scale", "range", "push", "swing", "stretch")


@dataclass(frozen=True)
class Squall(Gust):
    """The same, which declares what it can."""

    id = "squall"
    priors = {
        "force": Prior(scale="compliance"),
        "scale": Prior(scale="log", deviation=2.0),
        "range": Prior("form", "linear"),
        "push": Prior(spread=0.3, high=1.0),
        "reference": Prior("shape"),
    }


def test_without_a_word_a_quantity_says_enough():
    assert prior_of(Gust, "force") == Prior("size", "linear", 0.0, 2.0, 3.0, 0.0, 100.0)
    assert prior_of(Gust, "scale") == Prior("size", "linear", 1.0, 1.0 - 0.9, 3.0, 0.1, math.inf)
    assert prior_of(Gust, "range") == Prior("size", "inverse", 0.0, 0.25, 3.0, 0.0, math.inf)
    # What is typically none: a quarter of its range.
    assert prior_of(Gust, "push") == Prior("size", "linear", 0.0, 1.0, 3.0, -math.inf, math.inf)
    assert prior_of(Gust, "swing").spread == 1.5
    assert prior_of(Gust, "stretch").low == 1.0
    # What does not bring the effect in stays typical.
    fixed = prior_of(Gust, "reference")
    assert (fixed.role, fixed.centre, fixed.deviation) == ("fixed", 1.5, 0.0)


def test_what_is_declared_holds_and_the_rest_follows():
    assert prior_of(Squall, "force") == Prior("size", "compliance", 0.0, 1.0, 3.0, 0.0, math.inf)
    assert prior_of(Squall, "scale") == Prior("size", "log", 1.0, -math.log(0.9), 2.0, -math.inf, math.inf)
    form = prior_of(Squall, "range")
    assert (form.role, form.scale, form.spread, form.deviation) == ("form", "linear", 1.0, 0.1)
    assert prior_of(Squall, "push") == Prior("size", "linear", 0.0, 0.3, 3.0, -math.inf, 1.0)
    assert prior_of(Squall, "reference") == Prior("shape", "log", 1.5, 0.5, 1.0, -math.inf, math.inf)


def test_one_z_of_a_logarithm_is_the_way_from_absent_to_typical_and_a_rigid_support_has_no_compliance():
    quarter = Quantity("1", 2.0, 0.1, 4.0, 0.5)
    assert scale.spread(quarter, "size", "log") == pytest.approx(math.log(4.0))
    assert scale.centre(quarter, "size", "log") == 2.0
    assert scale.centre(quarter, "size", "compliance") == scale.centre(quarter, "size", "inverse") == 0.0


@pytest.mark.parametrize("kind, name", NUMBERS, ids=[f"{kind.id}.{name}" for kind, name in NUMBERS])
def test_every_quantity_of_the_catalogue_has_a_prior(kind, name):
    prior, q = prior_of(kind, name), kind.quantities[name]
    assert prior.role in ROLES and prior.scale in SCALES
    assert not any(math.isnan(x) for x in (prior.centre, prior.spread, prior.deviation, prior.low, prior.high))
    brings_in = kind.switches is None or name in kind.switches
    if prior.role == "size":
        # z = 0 is absence, and only what brings an effect in has a size.
        assert brings_in and from_scale(kind, name, prior.centre) == q.absent
    if prior.role != "fixed":
        assert 0 < prior.spread < math.inf and 0 < prior.deviation < math.inf
        assert prior.low <= prior.centre <= prior.high
        # One spread away the number is one that its effect takes.
        ahead = prior.centre * math.exp(prior.spread) if prior.scale == "log" else prior.centre + prior.spread
        kind(**{name: from_scale(kind, name, ahead)}).check("here")


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_what_an_effect_declares_is_about_its_own_quantities(kind):
    assert {*kind.priors, *kind.of_run, *(name for seed in kind.seeds for name in seed)} <= set(kind.quantities)
    assert len(kind.of_run) in (0, 2)
    assert any(prior_of(kind, name).role == "size" for name in kind.quantities)
    for seed in kind.seeds:
        effect = kind(**{**kind.typical().values(), **seed})
        effect.check("here")
        assert not effect.is_absent() and all(
            kind.quantities[k].low <= v <= kind.quantities[k].high for k, v in seed.items()
        )


def test_a_plate_starts_at_several_tones_and_masses_and_a_pull_at_several_sizes():
    seeds = EFFECTS["compliant_support"].seeds
    assert len({(seed["mass"], seed["frequency"]) for seed in seeds}) == len(seeds)
    tones = sorted({seed["frequency"] for seed in seeds})
    # No tone is farther than half of a step of 13 % from a seed.
    assert max(np.diff(np.log(tones))) < 0.13 and tones[0] < 15 and tones[-1] == 100
    assert [seed["force"] for seed in EFFECTS["adhesion"].seeds] == [15.0, 35.0, 70.0]


def test_scales_and_back():
    assert [from_scale(Gust, "range", x) for x in (0.0, 0.5)] == [math.inf, 2.0]
    assert [to_scale(Gust, "range", x) for x in (math.inf, 2.0, 0.5, 0.0)] == [0.0, 0.5, 2.0, 0.0]
    # Twice the compliance of the typical 2 N: the root of two below it. Below a thousandth it is rigid.
    assert from_scale(Squall, "force", 2.0) == pytest.approx(math.sqrt(2.0))
    assert to_scale(Squall, "force", math.sqrt(2.0)) == pytest.approx(2.0)
    assert to_scale(Squall, "force", 0.5) == pytest.approx(16.0)
    assert from_scale(Squall, "force", RIGID) == to_scale(Squall, "force", 0.0) == 0.0
    assert from_scale(Gust, "scale", 0.7) == to_scale(Gust, "scale", 0.7) == 0.7


def test_inner_points_stay_on_their_side_of_a_small_base():
    kind = EFFECTS["foot_defects"]
    assert kind.largest_on("delta_diag", 0.03, 0.04) == pytest.approx(0.9 * 0.025)
    assert kind.largest_on("mu_int", 0.03, 0.04) == EFFECTS["gyro_scale"].largest_on("x", 0.03, 0.04) == math.inf


def test_the_inner_point_that_is_farthest_in_stays_on_its_side():
    """Ratios are kept; of those of the typical one the largest is twice the mean."""
    uneven = replace(EFFECTS["foot_defects"](delta_diag=0.006), diag1=0.5, diag2=2.0)
    assert uneven.within(0.03, 0.04) is uneven
    assert uneven.within(0.012, 0.016) == replace(uneven, delta_diag=0.9 * 0.01 / 2)
    edge = uneven.within(0.012, 0.016)
    assert edge.within(0.012, 0.016) is edge
    moved = EFFECTS["gyro_scale"](2.0)
    assert moved.within(1e-3, 1e-3) is moved
