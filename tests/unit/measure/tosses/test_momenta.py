"""Flight arcs, and the balance of momenta over an impact, on motion in closed form."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

from rockref.measure.tosses.flight import Poses, Starts
from rockref.measure.tosses.impact_balance import (
    Impacts,
    Measured,
    corner_ratios,
    corner_shape,
    crossing,
    energy_change,
    first_impacts,
    flight_arcs,
    impulse_balance,
    robust,
)
from rockref.model.rotation import exponential
from tests.refusal import refusal

RATE = 148.0
G = np.array([0.1, -0.2, -9.7])


def arcs(count, frames=12, drag=0.3, centre=(0.01, -0.02, 0.03)):
    """Poses that obey x + Lambda c = a + b t + g t^2/2 - d v t^2/2 exactly, v the mean velocity."""
    rng = np.random.default_rng(5)
    t = np.arange(frames) / RATE
    start, speed, W = rng.uniform(-1.0, 1.0, (3, count, 3))
    Lambda = exponential(rng.uniform(-1.0, 1.0, (count, 1, 3))) @ exponential(5.0 * W[:, None] * t[:, None])
    x = start[:, None] + speed[:, None] * t[:, None] + G * (t * t / 2)[:, None] - Lambda @ np.array(centre)
    # v T = x(T) - x(0) - d v T^2/2 with the drag in x(T).
    v = (x[:, -1] - x[:, 0]) / (t[-1] + drag * t[-1] ** 2 / 2)
    x -= drag * v[:, None] * (t * t / 2)[:, None]
    return Poses(t, x, Lambda, np.full(count, frames), np.zeros((count, 3)), np.zeros((count, 3)))


@pytest.mark.parametrize(("count", "frames"), [(3, 8), (7, 12)])
def test_arcs_give_gravity_drag_and_centre(count, frames):
    found = flight_arcs(arcs(count, frames), np.full(count, frames))
    truth = {"g_x": 0.1, "g_y": -0.2, "g_z": -9.7, "drag": 0.3, "centre_x": 0.01, "centre_y": -0.02, "centre_z": 0.03}
    assert list(found.values) == list(truth) and found.tosses == count and isinstance(found.tosses, int)
    assert [v for v, *_ in found.values.values()] == pytest.approx(list(truth.values()), abs=1e-9)
    assert [unit for *_, unit in found.values.values()] == 3 * ["m/s2"] + ["1/s"] + 3 * ["m"]
    assert found.scatter < 1e-12


def test_arcs_of_seven_frames_are_too_short_and_two_are_too_few():
    found = flight_arcs(arcs(7, 12), np.array([7, 12, 12, 2, 12, 7, 7]))
    assert found.tosses == 3
    few = flight_arcs(arcs(7, 12), np.array([7, 12, 12, 2, 7, 7, 7]))
    assert few.values == {} and few.tosses == 0 and np.isnan(few.scatter)


def test_each_arc_uses_its_own_frames():
    """Frames beyond those used are anywhere. One that ends earlier has its own mean velocity: there is no drag."""
    poses = arcs(10, 12, drag=0.0)
    used = np.where(np.arange(10) % 2, 9, 12)
    poses.x[1::2, 9:] += 5.0
    assert flight_arcs(poses, used).scatter < 1e-12


def test_arcs_are_fitted_as_if_all_their_numbers_were_sought_at_once():
    """Five arcs, six numbers each and seven in common: 180 rows less 37 are the degrees of freedom."""
    count, n = 5, 12
    poses = arcs(count, n)
    poses = poses._replace(x=poses.x + 1e-4 * np.random.default_rng(6).standard_normal(poses.x.shape))
    t = poses.t
    A = np.zeros((count, n, 3, 7 + 6 * count))
    for k in range(count):
        v = (poses.x[k, -1] - poses.x[k, 0]) / t[-1]
        for j in range(3):
            A[k, :, j, j] = t * t / 2
            A[k, :, j, 3] = -v[j] * t * t / 2
            A[k, :, j, 7 + 6 * k + j], A[k, :, j, 10 + 6 * k + j] = 1.0, t
        A[k, :, :, 4:7] = -poses.Lambda[k]
    A, y = A.reshape(-1, 37), poses.x.reshape(-1)
    p = np.linalg.lstsq(A, y, rcond=None)[0]
    found = flight_arcs(poses, np.full(count, n))
    assert [v for v, *_ in found.values.values()] == pytest.approx(p[:7], rel=1e-6)
    assert found.scatter == pytest.approx(np.sqrt(np.sum((y - A @ p) ** 2) / (180 - 37)), rel=1e-6)


def test_robust_mean_is_the_mean_with_its_error():
    """One unknown, every row its own group: the sandwich is sqrt(sum r^2)/n, the scatter that with n - 1."""
    y = np.array([1.0, 2.0, 3.0, 4.0, 6.0])
    p, se, scatter, keep = robust(np.ones((5, 1)), y, np.arange(5))
    r = y - 3.2
    assert p == pytest.approx([3.2]) and keep.all()
    assert se == pytest.approx([np.sqrt(r @ r) / 5])
    assert scatter == pytest.approx(np.sqrt(r @ r / 4))
    assert robust(np.ones((5, 1)), y, np.arange(5), lost=2)[2] == pytest.approx(np.sqrt(r @ r / 2))
    # Never fewer than one degree of freedom.
    assert robust(np.ones((5, 1)), y, np.arange(5), lost=4)[2] == pytest.approx(np.sqrt(r @ r))


def test_rows_of_one_group_err_together():
    """Pairs of rows that are alike count as one: the error is that of the mean of half as many."""
    y = np.repeat([1.0, 2.0, 3.0, 4.0, 6.0], 2)
    together = robust(np.ones((10, 1)), y, np.repeat(np.arange(5), 2))[1]
    apart = robust(np.ones((10, 1)), y, np.arange(10))[1]
    assert together == pytest.approx(np.sqrt(2.0) * apart)
    # Numbers of groups may be left out.
    assert robust(np.ones((10, 1)), y, 3 * np.repeat(np.arange(5), 2))[1] == pytest.approx(together)


def test_two_unknowns_have_the_errors_of_the_sandwich():
    rng = np.random.default_rng(8)
    A, groups = rng.normal(size=(30, 2)), np.repeat(np.arange(10), 3)
    y = A @ [2.0, -1.0] + 0.1 * rng.normal(size=30)
    p, se, scatter, _ = robust(A, y, groups)
    r = y - A @ p
    assert np.allclose(A.T @ r, 0.0, atol=1e-12)
    bread = np.linalg.inv(A.T @ A)
    meat = sum(np.outer(A[groups == k].T @ r[groups == k], A[groups == k].T @ r[groups == k]) for k in range(10))
    assert se == pytest.approx(np.sqrt(np.diag(bread @ meat @ bread)))
    assert scatter == pytest.approx(np.sqrt(r @ r / 28))


@pytest.mark.parametrize(("far", "kept"), [(17.5, True), (18.9, False)])
def test_a_gross_error_is_twelve_robust_deviations(far, kept):
    """The others are 1 or -1: their median size about the common mean is 1.05, and the limit 17.8 times that."""
    y = 100.0 + np.array([1.0, -1.0] * 200 + [far])
    p, _, scatter, keep = robust(np.ones((401, 1)), y, np.arange(401))
    assert keep[:-1].all() and keep[-1] == kept
    rest = y if kept else y[:-1]
    assert p == pytest.approx([rest.mean()], abs=1e-12)
    square = np.sum((rest - rest.mean()) ** 2)
    assert scatter == pytest.approx(np.sqrt(square / (len(rest) - 1)))
    # Of what was lost before, the rows that are left out have their share.
    scatter = robust(np.ones((401, 1)), y, np.arange(401), lost=40)[2]
    assert scatter == pytest.approx(np.sqrt(square / (len(rest) - 1 - 40 * len(rest) / 401)), rel=1e-9)


def test_gross_errors_that_hide_one_another_are_found_one_after_the_other():
    """The mean of the first round is off by the largest; then the next one stands out."""
    y = np.array([1.0, -1.0] * 40 + [1e4, 1e2])
    p, _, _, keep = robust(np.ones((82, 1)), y, np.arange(82))
    assert keep.sum() == 80 and p == pytest.approx([0.0], abs=1e-12)


def test_an_exact_fit_keeps_all_rows_and_a_small_error_is_gross_beside_it():
    assert robust(np.ones((5, 1)), np.zeros(5), np.arange(5))[3].all()
    y = np.zeros(101)
    y[7] = 1e-3
    assert robust(np.ones((101, 1)), y, np.arange(101))[3].sum() >= 100


BODY = np.array([[0.05, 0.0, 0.0], [-0.05, 0.01, -0.02], [0.0, 0.05, 0.03]])


def bounce(v_after, W_after, at, lead=0, low=0.0, frames=40, before=12.3):
    """A body of three corners that strikes once, at `before` frames, and flies on: poses, and what is true of it."""
    dt = 1.0 / RATE
    v0, W0, L0 = np.array([-1.0, 0.2, 0.1]), np.array([2.0, -3.0, 1.0]), exponential(np.array(at))
    t = np.arange(frames) * dt
    tc = before * dt
    L_c = L0 @ exponential(W0 * tc)
    corner = int(np.argmin(L_c[2] @ BODY.T))
    r = L_c @ BODY[corner]
    height = -r[2] + low
    x0 = np.array([0.3, 0.1, height]) - np.array([0, 0, 1.0]) * (v0 * tc + G * tc**2 / 2)[2]
    s = t - tc
    x = x0 + v0 * t[:, None] + G * (t * t / 2)[:, None]
    x_c = x0 + v0 * tc + G * tc**2 / 2
    after = s > 0
    x[after] = (x_c + v_after * s[:, None] + G * (s * s / 2)[:, None])[after]
    Lambda = np.where(after[:, None, None], L_c @ exponential(W_after * s[:, None]), L0 @ exponential(W0 * t[:, None]))
    poses = Poses(t, x[None], Lambda[None], np.array([frames]), v0[None], W0[None])
    return poses, {
        "v_before": v0 + G * tc, "v_after": v_after, "L_before": L_c, "L_after": L_c, "W_before": W0,
        "W_after": W_after, "corner": corner, "r": r, "height": low, "which": 0,
    }  # fmt: skip


@pytest.mark.parametrize("at", [(0.1, 0.2, 0.3), (1.0, -0.5, 0.2)])
@pytest.mark.parametrize(("before", "low"), [(12.3, 0.0), (12.9, -0.001), (20.0, 0.0005)])
def test_an_impact_in_closed_form_is_found_again(at, before, low):
    poses, true = bounce(np.array([-0.7, 0.1, 1.5]), np.array([1.0, 1.5, -0.5]), at, before=before, low=low)
    found = first_impacts(poses, BODY, np.eye(3) * 1e-3, G, 2e-3)
    for name, value in true.items():
        assert getattr(found, name)[0] == pytest.approx(value, abs=1e-7), name


def test_crossing_is_where_two_parabolas_meet():
    rng = np.random.default_rng(4)
    at, v1, v2 = rng.normal(size=(3, 6, 3))
    when, later = np.linspace(0.1, 0.4, 6), np.linspace(0.05, 0.5, 6)
    nothing = np.zeros(6)
    a = Starts(at - v1 * when[:, None] - G * (when**2 / 2)[:, None], v1, *[None] * 3, nothing, nothing, nothing)
    s = (later - when)[:, None]
    # The state that b has at `later`, if it left the same place at `when` with v2 + g when.
    v_b = v2 + G * when[:, None] + G * s
    x_b = at + (v2 + G * when[:, None]) * s + G * s**2 / 2
    b = Starts(x_b, v_b, *[None] * 3, nothing, nothing, nothing)
    assert crossing(a, b, later, G) == pytest.approx(when, rel=1e-9)


def struck(count=12, seed=2):
    """Impacts of a body of known inertia over mass, each at a corner of its own, with rates that balance."""
    rng = np.random.default_rng(seed)
    J = np.array([0.002, 0.003, 0.004])
    Lambda = exponential(rng.uniform(-1.0, 1.0, (count, 3)))
    v1, dv, W1, r = rng.normal(size=(4, count, 3))
    W2 = W1 + np.einsum("bji,bj->bi", Lambda, np.cross(r, dv)) / J
    numbers = np.arange(count)
    return Impacts(v1, v1 + dv, Lambda, Lambda, W1, W2, numbers, r, rng.normal(size=count), numbers), J


def test_the_impulse_gives_the_inertia_over_the_mass():
    k, J = struck()
    found = impulse_balance(k)
    assert [(n, u) for n, (_, _, u) in found.values.items()] == [
        ("inertia_xx", "m2"), ("inertia_yy", "m2"), ("inertia_zz", "m2"),
    ]  # fmt: skip
    assert [v for v, *_ in found.values.values()] == pytest.approx(J, rel=1e-9)
    assert found.tosses == 12 and found.scatter < 1e-12


def test_the_impulse_of_a_body_that_turns_meanwhile_is_balanced_in_plate_axes():
    k, J = struck()
    turn = exponential(np.array([0.1, -0.2, 0.05]))
    after = k.L_before @ turn
    # The same angular momentum after the impact, in the axes of the body as it lies then.
    L = np.einsum("bij,bj->bi", k.L_after, J * k.W_after)
    W2 = np.einsum("bji,bj->bi", after, L) / J
    turned = replace(k, L_after=after, W_after=W2)
    assert [v for v, *_ in impulse_balance(turned).values.values()] == pytest.approx(J, rel=1e-9)


def test_errors_of_one_impact_hang_together():
    """Twice every impact: twice the rows, and errors smaller by the root of two, as of independent tosses."""
    k, _ = struck()
    noisy = replace(k, v_after=k.v_after + 0.01 * np.random.default_rng(1).normal(size=(12, 3)))
    double = Impacts(*(np.concatenate([a, a]) for a in vars(noisy).values()))
    one, two = impulse_balance(noisy), impulse_balance(double)
    assert [s for _, s, _ in two.values.values()] == pytest.approx([s / np.sqrt(2) for _, s, _ in one.values.values()])


def corner_speeds(k):
    """Velocities of the corner before and after, plate axes, from the body rates turned into them."""
    for v, L, W in ((k.v_before, k.L_before, k.W_before), (k.v_after, k.L_after, k.W_after)):
        yield v + np.cross(np.einsum("bij,bj->bi", L, W), k.r)


def test_radius_and_time_of_contact_are_found_in_the_depth():
    """height = rest - rho (s - 1) - tau u, s the sum of the slopes, u the corner's normal speed."""
    k, _ = struck(20)
    u = next(corner_speeds(k))[:, 2]
    s = np.abs(k.L_before[:, 2]).sum(axis=1)
    height = -0.001 - 0.003 * (s - 1.0) + 0.002 * u
    found = corner_shape(replace(k, height=height), -0.001)
    values = {name: value for name, (value, _, _) in found.values.items()}
    assert values == pytest.approx({"radius": 0.003, "half_contact_time": 0.002}, rel=1e-9)
    assert [unit for *_, unit in found.values.values()] == ["m", "s"]
    assert found.tosses == 20 and found.scatter < 1e-12


def test_slopes_are_those_of_the_mean_attitude():
    k, _ = struck(20)
    after = k.L_before @ exponential(np.array([0.2, 0.1, 0.0]))
    u = next(corner_speeds(k))[:, 2]
    s = np.abs((k.L_before[:, 2] + after[:, 2]) / 2).sum(axis=1)
    tilted = replace(k, L_after=after, height=-0.003 * (s - 1.0) + 0.002 * u)
    assert [v for v, *_ in corner_shape(tilted, 0.0).values.values()] == pytest.approx([0.003, 0.002], rel=1e-9)


def sliding(u1, u2):
    """Impacts of bodies that do not turn, so that their corners have the velocities (B, 3) of the body."""
    B = len(u1)
    u1, u2 = np.array(u1, float), np.array(u2, float)
    still, unit = np.zeros((B, 3)), np.tile(np.eye(3), (B, 1, 1))
    return Impacts(u1, u2, unit, unit, still, still, np.zeros(B, int), still, np.zeros(B), np.arange(B))


def test_ratios_of_corners_that_slide_on():
    """dv along X of 0.1 to 0.5 of the normal one; restitution 0.5 in all but the last."""
    mu = np.array([0.10, 0.15, 0.20, 0.26, 0.50])
    before = [[2.0, 0.0, -1.0]] * 5
    after = [[2.0 - m * 1.5, 0.0, 0.5] for m in mu]
    # Three that do not count: too slow, turned back, turned by more than thirty degrees.
    before += [[0.3, 0.0, -1.0], [0.3, 0.0, -1.0], [2.0, 0.0, -1.0]]
    after += [[0.199, 0.0, 0.5], [-0.3, 0.0, 0.5], [1.0, 0.58, 0.2]]
    found = corner_ratios(sliding(before, after))
    value, se, unit = found.values["friction"]
    assert value == pytest.approx(0.20) and unit == "1"
    assert se == pytest.approx(1.2533 * 1.4826 * 0.06 / np.sqrt(5))
    assert found.values["restitution"] == (pytest.approx(0.5), 0.0, "1")
    assert found.tosses == 5 and found.scatter == pytest.approx(np.std(mu))


def test_thirty_degrees_and_a_fifth_of_a_metre_a_second_still_slide():
    before = [[2.0, 0.0, -1.0]] * 5
    after = [[1.0, 0.57, 0.5], [0.201, 0.0, 0.5], [0.0, 0.0, 0.5], [-1.0, 0.0, 0.5], [0.15, 0.15, 0.5]]
    found = corner_ratios(sliding(before, after))
    # hypot(0.15, 0.15) is 0.21, but at 45 degrees.
    assert found.tosses == 2 and "friction" not in found.values and list(found.values) == ["restitution"]


def test_four_corners_are_too_few_for_a_median():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = corner_ratios(sliding([[0.0, 0.0, -1.0]] * 4, [[0.0, 0.0, 0.5]] * 4))
    assert found.values == {} and found.tosses == 0 and np.isnan(found.scatter)


def test_ratios_are_those_of_the_corner_not_of_the_body():
    """Bodies that turn: the corner's velocity is v + w x r, in plate axes; the impulse has that of the body."""
    k, _ = struck(40)
    u1, u2 = corner_speeds(k)
    dv = k.v_after - k.v_before
    slid = np.hypot(u2[:, 0], u2[:, 1]) > 0.2
    way1, way2 = (np.arctan2(u[:, 1], u[:, 0]) for u in (u1, u2))
    slid &= np.abs(np.angle(np.exp(1j * (way2 - way1)))) < np.pi / 6
    found = corner_ratios(k)
    assert found.tosses == slid.sum() > 4
    assert found.values["friction"][0] == pytest.approx(np.median(np.hypot(dv[:, 0], dv[:, 1])[slid] / dv[slid, 2]))
    assert found.values["restitution"][0] == pytest.approx(np.median(-u2[:, 2] / u1[:, 2]))


def turned(squares, restitution):
    """Corners on a line to the origin with this cosine squared, that come straight down without a turn."""
    k = sliding([[0.0, 0.0, -1.0]] * len(squares), [[0.0, 0.0, e] for e in restitution])
    c = np.sqrt(np.array(squares))
    return replace(k, r=0.08 * np.stack([np.sqrt(1 - c * c), 0 * c, -c], axis=1))


def test_restitution_is_read_off_for_a_face_and_for_a_tip():
    """0.6 where P_2 is 0 and 0.2 where it is 1; where a corner lies flatter than one of a face P_2 counts as zero."""
    squares = np.array([1 / 3, 0.5, 2 / 3, 0.8, 1.0, 0.1])
    tip = np.array([0.0, 0.25, 0.5, 0.7, 1.0, 0.0])
    found = corner_ratios(turned(squares, 0.6 - 0.4 * tip)).values
    assert found["restitution_on_a_face"] == (pytest.approx(0.6), pytest.approx(0.0, abs=1e-12), "1")
    assert found["restitution_on_a_tip"] == (pytest.approx(0.2), pytest.approx(0.0, abs=1e-12), "1")


@pytest.mark.parametrize(
    "squares",
    [[0.2, 0.25, 0.3, 0.4, 0.53], [1 / 3, 0.5, 2 / 3, 0.8]],
    ids=["corners that are turned alike", "four corners"],
)
def test_no_slope_is_read_where_there_is_none_to_be_read(squares):
    """P_2 from 0 to 0.295; and too few of all turns."""
    found = corner_ratios(turned(squares, np.full(len(squares), 0.5)))
    assert not {"restitution_on_a_face", "restitution_on_a_tip"} & set(found.values)


def test_a_slope_is_read_from_a_range_of_three_tenths():
    found = corner_ratios(turned([0.2, 0.25, 0.3, 0.4, 0.54], np.full(5, 0.5)))
    assert found.values["restitution_on_a_tip"][0] == pytest.approx(0.5)


def test_energy_change_is_that_of_both_motions():
    k, J = struck(3)
    before = [0.5 * v @ v + 0.5 * W @ np.diag(J) @ W for v, W in zip(k.v_before, k.W_before, strict=True)]
    after = [0.5 * v @ v + 0.5 * W @ np.diag(J) @ W for v, W in zip(k.v_after, k.W_after, strict=True)]
    assert energy_change(k, J) == pytest.approx(np.array(after) / np.array(before) - 1.0, rel=1e-12)


def test_what_is_said_where_nothing_lands():
    poses, _ = bounce(np.zeros(3), np.zeros(3), (0.1, 0.2, 0.3))
    said = ("E-SIZE", "tosses", "none has a first impact with flight on both sides", "Give more tosses.")
    assert refusal(first_impacts, poses._replace(x=poses.x + [0.0, 0.0, 9.0]), BODY, np.eye(3), G, 2e-3) == said


def test_what_is_measured_is_written_as_plain_numbers():
    rows = {"radius": (np.float64(0.003), np.float64(0.001), "m")}
    found = Measured(rows, 7, np.float64(0.5)).to_dict()
    assert found == {"values": {"radius": {"value": 0.003, "se": 0.001, "unit": "m"}}, "tosses": 7, "scatter": 0.5}
    numbers = [*found["values"]["radius"].values()][:2] + [found["scatter"]]
    assert [type(number) for number in numbers] == [float] * 3
