"""Predictions beside tests: known probabilities score as they must, and equal distributions are not told apart."""

import numpy as np
import pytest

from rockref.model.errors import InputError
from rockref.shake.comparison import BAR, Sample, ShakenComparison, compare_shaken
from rockref.shake.ensemble import Draws
from rockref.shake.experiment import ShakenExperiment

MOTIONS, EACH = 20, 12


def experiment(rng, **changes):
    """Tests of 20 motions, whose probability of falling rises with PGA and with a number of each motion's own."""
    motion = np.repeat(np.arange(MOTIONS), EACH)
    pga = np.tile(np.geomspace(1.0, 6.0, EACH), MOTIONS)
    hidden = np.repeat(rng.normal(size=MOTIONS), EACH)
    p = 1 / (1 + np.exp(-3 * np.log(pga / 2.5) - 2 * hidden))
    given = dict(
        name="made", motion=motion.astype(str), fell=(rng.random(len(p)) < p).astype(float), maxima={},
        sizes=np.column_stack([pga, 0.1 * pga]), motions=None, stated={"truth": p}, draws=Draws(), digest="",
    )  # fmt: skip
    return ShakenExperiment(**(given | changes))


def test_the_true_probability_beats_the_regression_and_its_loss_is_its_entropy():
    e = experiment(np.random.default_rng(3))
    bar, truth = compare_shaken(e).to_dict()["predictions"]
    p = e.stated["truth"]
    entropy = -(p * np.log(p) + (1 - p) * np.log(1 - p))
    # 240 losses about their entropy with a standard deviation of 0.5 at most: three standard errors.
    assert truth["log_loss"]["mean"] == pytest.approx(entropy.mean(), abs=0.1)
    # PGV/PGA is one number here and takes no part.
    assert bar["name"] == "regression on PGA" and bar["more"] is None and truth["more"]["high"] < 0
    assert truth["brier"]["mean"] < bar["brier"]["mean"]


def test_repeats_set_a_floor_that_no_probability_falls_below():
    rng = np.random.default_rng(4)
    p = rng.beta(0.5, 0.5, size=1000)
    motion = np.repeat(np.arange(1000), 2)
    fell = (rng.random(2000) < np.repeat(p, 2)).astype(float)
    sizes = np.ones((2000, 2))
    e = experiment(rng, motion=motion, fell=fell, sizes=sizes, stated={"truth": np.repeat(p, 2)})
    c = ShakenComparison(e, {"truth": e.stated["truth"]}, {}, None, {})
    from rockref.shake.statistics.scores import repeats

    floors = repeats(motion, sizes[:, 0], fell).floors()
    truth = c.scores()[0]
    # Beta(1/2, 1/2): E p (1 - p) = 1/8; half a share of 1000 pairs is known to 0.007, three of that.
    assert floors["least_brier"] == pytest.approx(1 / 8, abs=0.021)
    assert truth["brier"]["mean"] == pytest.approx(1 / 8, abs=0.021)
    # E h(p) of the arcsine law is 2 ln 2 - 1 = 0.386; the floor 4 ln 2/8 = 0.347 lies below.
    assert floors["least_log_loss"] < truth["log_loss"]["mean"] == pytest.approx(2 * np.log(2) - 1, abs=0.04)


def test_runs_of_one_distribution_are_not_told_from_tests():
    rng = np.random.default_rng(5)
    e = experiment(rng)
    small = 0
    for _ in range(60):
        level = rng.normal(size=MOTIONS)
        motion = np.repeat(np.arange(MOTIONS), 2)
        values = np.exp(level[motion] + 0.3 * rng.normal(size=(11, len(motion))))
        run = np.repeat(np.arange(10), len(motion))
        samples = {
            "measured": Sample(values[0], motion, np.zeros(len(motion), int)),
            "same": Sample(values[1:].ravel(), np.tile(motion, 10), run),
        }
        c = ShakenComparison(e, {}, {"tilt": samples}, None, {})
        small += c.distances(draws=99)[0]["p_value"] <= 0.1
    # A share of 60 at 0.1 has a standard deviation of 0.039; three of them.
    assert small / 60 <= 0.1 + 0.12


def test_one_motion_and_models_without_records_are_refused():
    rng = np.random.default_rng(6)
    with pytest.raises(InputError, match="E-MOTIONS"):
        compare_shaken(experiment(rng, motion=np.full(MOTIONS * EACH, "one")))
    from rockref import Model

    with pytest.raises(InputError, match="E-RECORD"):
        compare_shaken(experiment(rng), [Model.table_3_1()], ["table_3_1"])
    assert BAR.startswith("regression")
