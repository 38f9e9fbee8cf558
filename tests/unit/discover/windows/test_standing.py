"""A block that stands on its feet at the start of a window: on one corner, on two feet, in dents; and nothing rings."""

import numpy as np
import pytest

from rockref import Model
from rockref.discover.windows.reconstruct import standing_place
from rockref.discover.windows.standing import standing_starts
from rockref.effects.catalogue import parse
from rockref.engines.compiled import columns as col
from rockref.engines.compiled import pack
from rockref.engines.compiled.batch import Batch, run_batch
from rockref.model.rotation import exponential

H, ROWS = 1e-5, 801
#: Rates of a block that rises slowly [rad/s, body axes].
RISING = np.array([0.25, 0.0, 0.0])


def begun(model: Model, roll: float, rates=RISING, pressed: float = 0.0, plate=None):
    """Table 3.1's block tilted by 0.08 rad and rolled, at the start of a window: a batch of one for 8 ms."""
    problem = pack.with_memory(model.problem(duration=1.0, theta_0=0.08))
    Lambda = (problem.start.Lambda @ exponential(np.array([0.0, roll, 0.0])))[None].copy()
    body, props, effects = (f(problem)[None] for f in (pack.body_row, pack.props_rows, pack.effects_row))
    P = problem.points.P[None].copy()
    n = P.shape[1]
    state, memory = np.empty((1, col.STATE)), np.empty((1, n, col.MEMORY))
    place = standing_place(problem.points.P, np.eye(3), problem.start.x, problem.start.Lambda)[None]
    deep = np.full((1, n), pressed)
    none = np.zeros((1, 5))
    upright, plate = np.eye(3)[None], np.zeros((1, 4)) if plate is None else np.array(plate)[None]
    standing_starts(Lambda, rates[None], none, body, P, props, effects, deep, upright, place, plate, state, memory)
    return Batch(body, P, props, memory, effects, state, H, np.arange(ROWS)[None].astype(np.int64))


def run(batch: Batch):
    """States (ROWS, STATE) and forces (ROWS, n, 3) of a batch of one; the forces of row 0 belong to row 1."""
    states, forces, _ = run_batch(batch, 1, full=True)
    return states[0], forces[0, 1:]


def level() -> Model:
    """The block with feet of one height: rolled by nothing it stands on two of them alike."""
    return Model.table_3_1().replace(delta_long=(5e-5,) * 4)


@pytest.fixture(scope="module")
def corner():
    """Rolled by 2 mrad one corner is clearly the lowest."""
    batch = begun(Model.table_3_1(), 0.002, np.array([0.25, 0.01, 0.0]))
    return run(batch)[0], batch.P[0], batch.memory[0]


def test_one_corner_touches_and_the_lowest_one(corner):
    states, P, memory = corner
    L = states[0, col.L : col.L + 9].reshape(3, 3)
    heights = (P @ L.T)[:, 2]
    assert np.flatnonzero(memory[:, col.ANCHORED] + memory[:, col.SLIDING]).tolist() == [int(np.argmin(heights))]


def test_force_is_that_of_the_motion_and_does_not_ring(corner):
    states, P, memory = corner
    L = states[:, col.L : col.L + 9].reshape(-1, 3, 3)
    pivot = int(np.argmax(memory[:, col.ANCHORED]))
    depth = -(states[:, col.X + 2] + (L @ P[pivot])[:, 2])
    assert depth[0] > 0
    # A start without the balance swings by its whole depth; what is left here changes with the posture.
    assert np.abs(depth / depth[0] - 1).max() < 0.1


def test_acceleration_is_kept(corner):
    states, _, _ = corner
    v, w = states[:, col.V : col.V + 3], states[:, col.W_ : col.W_ + 3]
    early = (v[200] - v[0]) / (200 * H)
    late = (v[800] - v[600]) / (200 * H)
    # Over 8 ms the posture changes by 2 mrad of 70: the acceleration by a few per cent; ringing would change its sign.
    assert np.linalg.norm(late - early) < 0.15 * np.linalg.norm(early)
    spin = [(w[b] - w[a]) / (200 * H) for a, b in ((0, 200), (600, 800))]
    assert np.linalg.norm(spin[1] - spin[0]) < 0.15 * np.linalg.norm(spin[0])


@pytest.mark.parametrize("effect", ["", "hertzian_contact:exponent=1.5", "hysteretic_contact:kappa=0.6"])
def test_two_feet_share_the_weight_and_nothing_rings(effect):
    model = level().replace(effects=(parse(effect),) if effect else ())
    batch = begun(model, 0.0)
    states, forces = run(batch)
    feet = np.flatnonzero(batch.memory[0, :, col.ANCHORED])
    assert len(feet) == 2
    total = forces[:, :, 2].sum(axis=1)
    np.testing.assert_allclose(forces[0, feet[0]], forces[0, feet[1]], rtol=1e-3, atol=0.5)
    # Each as deep as if it stood alone, the feet would push with twice the weight at first and then let go. What the
    # block bears on them grows by 1.6 per cent while it rises, and rings by less than one.
    assert np.abs(total / total[0] - 1).max() < 0.03
    # The feet hold the block: it does not begin to turn about the vertical, nor to roll.
    assert np.abs(states[:, [col.W_ + 1, col.W_ + 2]]).max() < 2e-5


def test_what_turns_a_block_about_the_vertical_is_held_by_two_feet():
    """Feet of which one carries more than the other: on one foot alone the block would begin to turn at once."""
    one, two = (begun(level(), roll) for roll in (2e-4, 4e-5))
    spins = []
    for batch in (one, two):
        states, forces = run(batch)
        L = states[:, col.L : col.L + 9].reshape(-1, 3, 3)
        spins.append(np.abs((L @ states[:, col.W_ : col.W_ + 3, None])[:, 2, 0]).max())
    loads = run(two)[1][0][:, 2]
    assert np.count_nonzero(loads) == 2 and loads.max() > 1.5 * loads[loads > 0].min()
    assert spins[1] < 0.03 * spins[0]


def test_a_second_foot_comes_in_without_a_jump():
    """Rolled less and less the block comes to stand on a second foot; what that carries grows from nothing."""
    forces, heights = [], []
    for roll in np.linspace(1.2e-4, 0.0, 121):
        batch = begun(level(), roll)
        forces.append(run(batch)[1][0][:2])
        heights.append(batch.state[0, col.X + 2])
    loads = np.array(forces)[:, :, 2]
    assert loads[0, 1] == 0 and loads[-1, 1] == pytest.approx(loads[-1, 0], rel=1e-3)
    # A microradian over the distance of the feet, 0.2 m, is 0.1 um on each, and 3 N.
    assert np.abs(np.diff(forces, axis=0)).max() < 4
    assert np.abs(np.diff(heights)).max() < 1e-7


def test_no_foot_is_pulled_out_of_its_cone():
    """On little friction the feet hold what they can: anchors within mu N / K_T of where they stand."""
    batch = begun(level().replace(mu_ext=0.02, mu_int=0.02), 4e-6)
    state, memory, props = batch.state[0], batch.memory[0], batch.props[0]
    u = state[col.X : col.X + 3] + batch.P[0] @ state[col.L : col.L + 9].reshape(3, 3).T
    touching = memory[:, col.ANCHORED] > 0
    pull = props[:, col.K_T] * np.hypot(memory[:, col.S_X] - u[:, 0], memory[:, col.S_Y] - u[:, 1])
    # Differences of a micrometre between places of a tenth of a metre keep nine digits.
    assert np.all(pull[touching] <= 0.02 * props[touching, col.K_N] * -u[touching, 2] * (1 + 1e-6))
    assert np.count_nonzero(touching) == 2 and np.all(memory[touching, col.SLIDING] == 1)


@pytest.mark.parametrize("share", [0, 1])
def test_in_a_dent_the_block_stands_lower_by_it_and_as_firmly(share):
    model = level().replace(effects=(parse(f"hysteretic_contact:kappa=0.5,curved_share={share}"),))
    fresh, dented = begun(model, 0.0), begun(model, 0.0, pressed=2e-5)
    depths = [-(b.state[0, col.X + 2] - fresh.state[0, col.X + 2]) for b in (fresh, dented)]
    K = fresh.props[0, 0, col.K_N]
    force = run(fresh)[1][0, :, 2].max()
    # A dent of a third of the depth; on the line half as stiff again, on the power 3/2 from there to 20 um.
    way = 2e-5 - 2e-5 / 3
    above = force / (1.5 * K) if share == 0 else way * (force / (K * 2e-5)) ** (2 / 3)
    assert depths[1] == pytest.approx(2e-5 / 3 + above - force / K, rel=1e-3)
    states, forces = run(dented)
    total = forces[:, :, 2].sum(axis=1)
    assert np.abs(total / total[0] - 1).max() < 0.03
    assert total[0] == pytest.approx(run(fresh)[1][0, :, 2].sum(), rel=1e-3)


def test_on_a_plate_that_is_lost_the_block_is_lost_too():
    """No depth carries it there, and none is looked for."""
    lost = begun(Model.table_3_1(), 0.002, plate=[0.0, 0.0, np.nan, 0.0])
    assert np.isnan(lost.state[0, 2]) and not lost.memory[0, :, col.ANCHORED].any()


def test_corner_stands_as_deep_on_a_plate_that_moves():
    """On a plate that has sunk, pitched and goes on, the carrying corner is as deep, and rests on it as it did."""
    plate = np.array([1e-5, 2e-3, 1e-4, -3e-2])
    rates = np.array([0.25, 0.01, 0.0])
    still, moving = (begun(Model.table_3_1(), 0.002, rates, plate=p) for p in (None, plate))
    np.testing.assert_array_equal(moving.state[0, col.PLATE], plate)
    pivot = int(np.argmax(still.memory[0, :, col.ANCHORED]))
    assert moving.memory[0, pivot, col.ANCHORED] == 1.0

    def corner(batch: Batch) -> tuple[np.ndarray, np.ndarray]:
        s = batch.state[0]
        L = s[col.L : col.L + 9].reshape(3, 3)
        r = L @ batch.P[0, pivot]
        return s[:3] + r, s[col.V : col.V + 3] + np.cross(L @ s[col.W_ : col.W_ + 3], r)

    (place, speed), (shifted, faster) = corner(still), corner(moving)
    y = place[1]
    np.testing.assert_allclose(shifted, place + [0, 0, 1e-5 + 1e-4 * y], atol=1e-12)
    np.testing.assert_allclose(faster, speed + [0, 0, 2e-3 - 3e-2 * y], atol=1e-9)
