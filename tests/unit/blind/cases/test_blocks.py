"""Blocks that are not the source's: within what they are drawn from, and the same for the same seed."""

import math

import pytest

from rockref.blind.cases import blocks, generator
from rockref.blind.cases.blocks import RUNS, SOURCE, Setup, other_block
from rockref.blind.cases.generator import SEEN, _head, setup_that_shows, trace
from rockref.measure.experiment import load_experiment

DRAWN = [other_block(seed) for seed in range(200)]


def within(value, limits):
    # What is stated is rounded to three digits.
    return limits[0] * 0.99 <= value <= limits[1] * 1.01


def test_a_block_is_as_wide_and_heavy_as_blocks_are():
    for setup in DRAWN:
        b, p = setup.block, setup.parameters
        assert within(b.height, blocks.HEIGHTS) and within(b.height / b.width, blocks.SLENDERNESS)
        assert within(b.mass / (b.width**2 * b.height), blocks.DENSITIES)
        assert within(p["K_N"] / b.mass, blocks.STIFFNESS) and within(p["K_T"] / p["K_N"], blocks.TANGENTIAL)
        assert within(p["delta_diag"] / b.width, blocks.DIAGONAL)
        for where in ("int", "ext"):
            assert within(p[f"beta_{where}"], blocks.DAMPING) and within(p[f"mu_{where}"], blocks.FRICTION)
        assert all(0 <= p[f"delta_long_{i}"] <= blocks.FEET[1] for i in (1, 2, 3, 4))
    same = sum(setup.block == SOURCE for setup in DRAWN)
    # A binomial of 200 with a quarter: 50, with a deviation of 6; four of those.
    assert abs(same - 50) <= 24


def test_a_campaign_has_two_to_six_runs_and_something_to_fit():
    for setup in DRAWN:
        assert 2 <= len(setup.runs) <= 6 and 500 <= setup.sensor.sample_rate <= 4000
        uses = [use for _, use, _, _ in setup.runs]
        assert {"fit", "holdout"} == set(uses)
        alpha = math.atan2(setup.block.width, setup.block.height)
        assert all(0.5 * alpha < tilt < 0.9 * alpha for _, _, tilt, _ in setup.runs)
        assert all(use == "fit" for _, use, _, turned in setup.runs if turned)
    turned = sum(any(run[3] for run in setup.runs) for setup in DRAWN)
    assert 40 < turned < 160


@pytest.mark.parametrize("id", blocks.TURNED)
def test_what_a_turned_run_tells_has_one(id):
    assert all(any(turned for *_, turned in other_block(seed, [id]).runs) for seed in range(40))


@pytest.mark.parametrize("id", blocks.TILTED)
def test_what_a_second_tilt_tells_has_one_among_the_fitted_runs(id):
    for seed in range(40):
        assert len({tilt for _, use, tilt, _ in other_block(seed, [id]).runs if use == "fit"}) > 1


def test_the_seed_decides():
    assert other_block(3).runs == DRAWN[3].runs and other_block(3).parameters == DRAWN[3].parameters
    assert other_block(3, (), 1).parameters != DRAWN[3].parameters


def test_the_experimenter_is_told_of_block_and_sensor_and_not_of_the_feet(tmp_path):
    setup = DRAWN[0]
    text = _head("x", "eight_points", setup)
    (tmp_path / "experiment.toml").write_text(text)
    for id, *_ in setup.runs:
        (tmp_path / f"run{id}.csv.gz").touch()
    stated = load_experiment(tmp_path, uses=())
    assert (stated.mass, stated.width, stated.height) == (setup.block.mass, setup.block.width, setup.block.height)
    assert stated.gyro.sample_rate == setup.sensor.sample_rate and stated.gyro.bandwidth == setup.sensor.low_pass
    assert stated.gyro.noise == pytest.approx(setup.sensor.noise) and stated.baseline == "eight_points"
    assert [(run.release_tilt, run.use) for run in stated.runs] == [(tilt, use) for _, use, tilt, _ in setup.runs]
    assert set(line.split(" = ")[0] for line in text.splitlines() if " = " in line) == {
        "name", "kind", "baseline", "mass_kg", "width_m", "height_m", "tilt_uncertainty_rad", "sample_rate_hz",
        "noise_deg_s", "bandwidth_hz", "resolution_deg_s", "id", "file", "use", "release_tilt_rad", "block_turned_deg",
    }  # fmt: skip
    assert _head("x", "eight_points", Setup()).count("[[run]]") == len(RUNS)


def test_a_block_that_does_not_show_an_effect_is_drawn_again(monkeypatch):
    pytest.importorskip("numba")
    traces = []

    def noted(setup, *rest):
        traces.append((setup, trace(setup, *rest)))
        return traces[-1][1]

    monkeypatch.setattr(generator, "trace", noted)
    # The first block of this seed hardly turns about its height on its feet.
    setup = setup_that_shows([("spin_friction", 1.0)], 9)
    *others, (last, most) = traces
    assert others and all(size < SEEN for _, size in others)
    assert most >= SEEN and setup is last and others[0][0].parameters == other_block(9, ["spin_friction"]).parameters
