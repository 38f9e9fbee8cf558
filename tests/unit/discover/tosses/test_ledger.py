"""The energy of tosses: by differences of poses over their stretches, and by stated velocities at an impact."""

import numpy as np
import pytest

from rockref.discover.tosses.body import frames_of, throw_frame
from rockref.discover.tosses.compare import compare
from rockref.discover.tosses.ledger import energies, losses
from rockref.discover.tosses.parameters import apply, law_parameters
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.measure.records.toss import Toss
from rockref.measure.tosses.flight import side_by_side
from rockref.measure.tosses.load import load_tosses
from rockref.measure.tosses.stated_energy import rises, stated_energy
from rockref.report.terminal.toss_text import sliding_table, stretches_table, with_error
from tests.tosses import RATE, made, stated, write_tosses


@pytest.fixture(scope="module")
def tosses(tmp_path_factory):
    x, Lambda, _ = made(stated(), 12, frames=130, seed=1)
    return load_tosses(write_tosses(tmp_path_factory.mktemp("made") / "t", x, Lambda))


def test_a_flight_keeps_its_energy_and_spin_and_height_are_in_it():
    model = stated().replace(effects=(MassEccentricity(0, 0, 4e-3),))
    x, Lambda, starts = made(model, 6, frames=8, seed=4)
    poses = side_by_side(
        [Toss(str(i), str(i), "fit", np.arange(8) / RATE, x[i], Lambda[i]) for i in range(6)], RATE
    )  # fmt: skip
    body = frames_of(model, throw_frame(poses)).to_body(poses.x, poses.Lambda)
    E = energies(*body, 1 / RATE, model)
    block = model.body()[0]
    spin = np.einsum("bi,ij,bj->b", starts.W, block.inertia, starts.W) / 2
    true = 0.37 * (np.sum(starts.v**2, axis=1) / 2 + 9.81 * starts.x[:, 2]) + spin
    # A straight line between two frames of a curved way, and half a frame's fall: some thousandths.
    assert E == pytest.approx(np.repeat(true[:, None], 8, axis=1), rel=3e-3)


def test_losses_of_the_stretches_are_all_that_is_lost():
    E = np.array([[5.0, 5.0, 5.0, 4.0, 3.0, 3.0, 2.5, 2.0]])
    lost = losses(E, np.array([[0, 0, 1, 1, 1, 4, 4, -1]]))[0]
    assert lost[[0, 1, 4]] == pytest.approx([0.0, 2.0, 0.5])
    assert np.isnan(lost[[2, 3, 5]]).all()


def test_the_ledger_of_the_true_model_is_that_of_the_tosses_and_another_has_another(tosses):
    soft = apply(stated(), law_parameters(stated())[2:3], np.array([-2.0]))  # a third of the damping
    rows = compare(tosses, [stated(), soft], ["true", "soft"]).to_dict()["rows"]
    true, other = (next(r for r in rows if r["model"] == n and r["start"] == "flight") for n in ("true", "soft"))
    for s in true["stretches"]:
        energy = s["energy_lost"]
        assert energy["model_percent"] == pytest.approx(energy["measured_percent"], abs=1.5)
        assert energy["gains"] == 0
    first = next(s for s in other["stretches"] if s["stretch"] == "first impact")["energy_lost"]
    assert first["model_percent"] < first["measured_percent"] - 5
    assert f"{first['measured_percent']:.1f}" in stretches_table(other).rows[1]


def test_the_friction_of_a_sliding_face_is_read_from_a_prediction_as_from_the_tosses(tosses):
    slippery = apply(stated(), law_parameters(stated())[4:], np.array([-2.0]))
    rows = compare(tosses, [stated(), slippery], ["true", "slippery"]).to_dict()["rows"]
    rows = [r for r in rows if r["use"] == "fit" and r["start"] == "flight"]
    friction = 0.18 * np.array([1.0, np.exp(-0.4)])
    for row, mu in zip(rows, friction, strict=True):
        speeds = row["sliding"]["model"]
        assert speeds and all(v["value"] == pytest.approx(mu, rel=0.05) for v in speeds.values())
        assert all(v["value"] == pytest.approx(0.18, rel=0.05) for v in row["sliding"]["measured"].values())
    assert list(sliding_table(rows).columns) == ["speed", "measured", "true", "slippery"]


def falling(W: np.ndarray) -> Toss:
    """Twelve frames without any motion but turning at W (12, 3) [rad/s]."""
    still = np.zeros((12, 3))
    return Toss("0", "0", "fit", np.arange(12) / RATE, still, np.tile(np.eye(3), (12, 1, 1)), still, W)


def test_a_rise_between_two_frames_is_not_one_around_the_impact():
    W = np.zeros((12, 3))
    W[:6, 0], W[6:, 0] = 4.0, 2.0
    J = np.array([2e-3, 2e-3, 2e-3])
    smooth, filtered = falling(W), falling(W.copy())
    filtered.W[6, 0] = 4.2
    found = rises([smooth, filtered], np.array([6, 6]), np.zeros(3), J, 9.81)
    assert found["tosses"] == 2 and found["from_frame_to_frame"] == 1 and found["around"] == 0
    assert found["largest_in_flight"] == 0.0 < found["largest"]
    assert found["least_loss_around"] == pytest.approx(1.0)
    assert stated_energy(smooth, np.zeros(3), J, 9.81)[0] == pytest.approx(2e-3 * 16 / 2)
    assert rises([Toss("0", "0", "fit", smooth.t, smooth.x, smooth.Lambda)], np.array([6]), np.zeros(3), J, 9.81) == {}


@pytest.mark.parametrize(
    ("value", "se", "said"),
    [(0.0057737, 0.00018, "0.00577 ± 0.00018"), (-9.6407, 0.011, "-9.641 ± 0.011"), (3.0, 0.0, "3.000 ± 0.000")],
)
def test_a_value_has_the_digits_of_its_error(value, se, said):
    assert with_error(value, se) == said
