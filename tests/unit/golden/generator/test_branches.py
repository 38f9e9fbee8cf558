"""Every vector is on the branch that it states: the branch derived anew, from the law in float64 and from what is
expected."""

import numpy as np
import pytest

from golden.generator.bounds import programs
from rockref.conformance import vectors
from rockref.conformance.judge import claims
from rockref.conformance.vectors.claim import with_effect
from rockref.effects import catalogue
from rockref.engines import has_numba, run
from rockref.engines.compiled.pack import has_twin
from rockref.model import contact, geometry, integrator, rotation
from rockref.model.integrator import prepared_inertia
from rockref.model.parameters import Parameters, point_properties
from rockref.model.problem import Block

LAYERS = ("L0", "L1", "L2", "L3", "L4", "L5s", "L7")
EYE = np.eye(3)


def of_piece(piece):
    return [v for layer in LAYERS for v in vectors.layer(layer) if v.piece == piece]


def where(flags):
    return np.flatnonzero(np.atleast_1d(flags)).tolist()


def size(angle):
    """The kinds of increments, by the law's own limit between its series, and by the angle itself."""
    if angle == 0:
        return "none"
    if np.sin(angle) / angle == 1 and 1 - angle * angle / 6 == 1:
        return "tiny"
    if angle**2 <= rotation.SHORT_SERIES_ANGLE_SQUARED:
        return "short series"
    return "near a half turn" if np.pi - angle < 0.19 else "long series"


@pytest.mark.parametrize("layer", LAYERS)
def test_every_vector_states_its_branch(layer):
    assert [v.id for v in vectors.layer(layer) if not v.branch] == []


def test_constants():
    seen = set()
    for v in of_piece("derived"):
        q = {k: float(x) for k, x in v.inputs.items() if k != "delta_long"}
        J = np.diag(geometry.cuboid_inertia(q["mass"], q["width"], q["depth"], q["height"]))
        P = geometry.eight_points(q["width"], q["depth"], q["height"], v.inputs["delta_long"], q["delta_diag"])
        names = ("K_N", "K_T", "beta_int", "beta_ext", "mu_int", "mu_ext")
        made = point_properties(Parameters().replace(**{k: q[k] for k in names}), q["mass"], np.arange(8) < 4)
        ends = ("internal", "external")
        found = {
            "cross-section": "square" if J[0] == J[1] else "oblong",
            "raised": where(P[:4, 2] > P[4:, 2]),
            "lowered": where(P[:4, 2] < P[4:, 2]),
            "more damping": ends[int(made["C_N"][0] > made["C_N"][4])],
            "more friction": ends[int(made["mu"][0] > made["mu"][4])],
        }
        assert v.branch == found, v.id
        seen |= {v.branch["cross-section"], v.branch["more damping"], "lowered" if v.branch["lowered"] else ""}
    assert seen >= {"square", "oblong", "external", "internal", "lowered"}


def test_the_release_stands_on_the_stated_feet():
    pivots = set()
    for v in of_piece("release"):
        q = v.inputs
        up = v.expect["x"].value[2] + (q["P"] @ v.expect["Lambda"].value.T)[:, 2]
        K = q["K_N"][up < 0]
        assert v.branch == {"pivots": where(up < 0), "equally stiff": bool(np.ptp(K) == 0)}, v.id
        half = q["mass"] * q["g"] / 2
        assert -up[up < 0] * K == pytest.approx(half, rel=1e-9), v.id
        assert any("internal pivot" in flag for flag in v.flags) == bool(np.any(np.flatnonzero(up < 0) >= 4)), v.id
        pivots.add(tuple(v.branch["pivots"]))
    assert pivots == {(0, 1), (0, 5), (4, 5)}


def test_places_and_rates_of_points():
    terms = set()
    for v in of_piece("kinematics"):
        q = v.inputs
        k = contact.point_kinematics(q["x"], q["Lambda"], q["v"], q["W"], q["P"])
        still = contact.point_kinematics(q["x"], q["Lambda"], 0 * q["v"], q["W"], q["P"])
        found = {
            "leaning": bool(np.any(k.r != q["P"])),
            "moving": bool(np.any(k.u_rate != still.u_rate)),
            "turning": bool(np.any(still.u_rate != 0)),
            "in the plate": where(k.u[:, 2] <= 0),
            "approaching": where(k.u_rate[:, 2] < 0),
        }
        assert v.branch == found, v.id
        terms.add(tuple(v.branch[k] for k in ("leaning", "moving", "turning")))
    assert terms >= {(False, True, False), (False, False, True), (True, False, False)}
    assert terms >= {(True, False, True), (True, True, True)}


def test_sums_over_the_feet():
    seen = set()
    for v in of_piece("assemble"):
        q, b = v.inputs, v.branch
        sizes = np.abs(q["F"])
        total = np.sum(q["F"], axis=0)
        assert b["loaded"] == where(sizes.sum(axis=1) > 0), v.id
        assert b["axes"] == "".join("xyz"[i] for i in where(sizes.sum(axis=0) > 0)), v.id
        assert b["cancels"] == bool(np.abs(total).max() < 1e-6 * sizes.max()), v.id
        assert b["leaning"] == bool(np.abs(q["Lambda"] - EYE).max() > 0), v.id
        if "force" in v.expect:
            weight = np.array([0, 0, q["mass"] * q["g"]])
            rest = np.abs(v.expect["force"].value + weight).max()
            assert (rest < 1e-9) == (not b["loaded"] or b["cancels"]), v.id
        if {"T", "moment"} <= set(v.expect):
            apart = np.any(v.expect["T"].value != v.expect["moment"].value)
            assert apart == b["leaning"], v.id
        seen.add((len(b["loaded"]), b["axes"], b["cancels"], b["leaning"]))
    assert seen >= {(0, "", False, False), (8, "xyz", False, False), (8, "xyz", True, False), (8, "xyz", False, True)}
    assert seen >= {(1, axis, False, False) for axis in "xyz"}


def test_sizes_of_rotations():
    seen = set()
    for v in of_piece("rotate"):
        Lambda = v.expect["Lambda"].value
        axial = np.array([Lambda[2, 1] - Lambda[1, 2], Lambda[0, 2] - Lambda[2, 0], Lambda[1, 0] - Lambda[0, 1]])
        angle = np.arctan2(np.linalg.norm(axial) / 2, (np.trace(Lambda) - 1) / 2)
        assert v.branch == {"turn": size(angle)}, v.id
        seen.add(v.branch["turn"])
    assert seen == {"none", "tiny", "short series", "long series", "near a half turn"}


def test_both_sides_of_the_switch_between_the_series_are_asked():
    squares = [float(np.sum(v.inputs["Theta"] ** 2)) for v in of_piece("rotate")]
    limit = rotation.SHORT_SERIES_ANGLE_SQUARED
    assert any(0.95 * limit < s <= limit for s in squares) and any(limit < s < 1.05 * limit for s in squares)


def test_terms_of_the_integrator():
    seen = set()
    for v in of_piece("integrate"):
        q = v.inputs
        J = prepared_inertia(Block(np.array(1.0), q["inertia"], np.array(0.0)))
        JW = integrator.times(J.J, q["W"])
        free = integrator.angular_acceleration(0 * q["T"], q["W"], JW, J.J_inverse)
        A = integrator.angular_acceleration(q["T"], q["W"], JW, J.J_inverse)
        acts = [k for k in ("v", "a", "a_next", "W", "T", "T_next") if np.abs(q[k]).max() > 0]
        acts += ["W x J W"] if np.abs(free).max() > 1e-12 * np.abs(q["W"]).max() ** 2 else []
        Theta = integrator.rotation_increment(q["W"], A, q["h"])
        moments = np.linalg.eigvalsh(q["inertia"])
        skewed = np.abs(q["inertia"] - np.diag(np.diag(q["inertia"]))).max() > 0
        kind = "products" if skewed else "ball" if np.ptp(moments) == 0 else "principal axes"
        assert v.branch == {"acts": acts, "turn": size(np.sqrt(np.sum(Theta**2))), "inertia": kind}, v.id
        seen |= {*acts, v.branch["turn"], kind}
    assert seen >= {"v", "a", "a_next", "W", "T", "T_next", "W x J W", "none", "short series", "long series"}
    assert seen >= {"products", "ball", "principal axes"}


def test_samples_of_the_measured_channel():
    leaning = set()
    for v in of_piece("channel"):
        crv = v.expect["crv_deg_s"].value
        in_plate_axes = np.degrees(np.einsum("nij,nj->ni", v.inputs["Lambda"], v.inputs["W"]))
        apart = np.abs(in_plate_axes - crv).max(axis=1) > 1e-9 * np.abs(crv).max()
        signs = ["".join("-0+"[int(s) + 1] for s in row) for row in np.sign(crv)]
        assert v.branch == {"leaning": where(apart), "signs": signs}, v.id
        leaning.add(len(v.branch["leaning"]))
    assert leaning == {0, 5}


def feet_in(response):
    """What the feet do in each row, by the flags of a response."""
    return ["".join("S" if s and a else "s" if a else "-" for a, s in zip(*row, strict=True))
            for row in zip(response.anchored, response.sliding, strict=True)]  # fmt: skip


def with_its_effect(claim, **changed):
    """The problem of a claim, with the effect in it."""
    effect = catalogue.find(claim.effect)(**claim.parameters | changed)
    return with_effect(vectors.problem_of(claim.inputs), effect)


def of_kind(piece):
    return [c for c in claims.claims() if c.piece == piece]


def test_feet_in_runs_with_an_effect():
    for claim in of_kind("effect"):
        assert feet_in(run(with_its_effect(claim), engine="numpy")) == claim.branch["rows"], claim.id


@pytest.mark.skipif(not has_numba(), reason="needs the compiled engine")
def test_feet_in_runs_with_an_effect_by_the_compiled_text():
    with_twin = [c for c in of_kind("effect") if has_twin(with_its_effect(c))]
    assert len(with_twin) == len(of_kind("effect"))
    for claim in with_twin:
        assert feet_in(run(with_its_effect(claim), engine="numba")) == claim.branch["rows"], claim.id


def off(claim, results):
    """By how many bars some results are off."""
    return max(float(np.max(np.abs(results[k] - value) / bar)) for k, (value, bar) in claim.expect.items())


def answered(claim, **changed):
    """The results of a claim with other parameters."""
    if claim.piece == "effect":
        return vars(run(with_its_effect(claim, **changed), engine="auto"))
    effect = catalogue.find(claim.effect)(**claim.parameters | changed)
    crv = catalogue.measured((effect,), claim.inputs["t"], np.radians(claim.inputs["crv_deg_s"]))
    return {"crv_deg_s": np.degrees(crv)}


@pytest.mark.parametrize("piece", claims.PIECES)
def test_parameters_of_effects_that_are_at_work_move_their_vector_and_no_others_do(piece):
    """A hundredth more of each, where the vectors were made with a tenth less."""
    for claim in of_kind(piece):
        assert off(claim, answered(claim)) < 1, claim.id
        moved = [k for k, v in claim.parameters.items() if v and off(claim, answered(claim, **{k: 1.01 * v})) > 10]
        assert moved == claim.branch["at work"], claim.id


def test_every_parameter_of_every_effect_is_at_work_in_a_vector():
    at_work = {(c.effect, name) for c in claims.claims() for name in c.branch["at work"]}
    assert at_work == {(kind.id, name) for kind in catalogue.IN_STEP_ORDER for name in kind.quantities}


def test_samples_that_a_sensor_changes():
    for claim in of_kind("sensor"):
        value, bar = claim.expect["crv_deg_s"]
        changed = np.abs(claim.inputs["crv_deg_s"] - value) > bar
        assert claim.branch["samples changed"] == dict(zip("XYZ", changed.sum(axis=0).tolist(), strict=True))
        assert changed.any(axis=0).all(), claim.id


RUNS = vectors.window_names() + vectors.trajectory_names()


@pytest.mark.parametrize("name", RUNS)
def test_feet_in_runs_by_the_forces_that_another_language_gives(name):
    """Sliding feet have the force of sliding, others another one; of a foot without load the force does not tell."""
    t = vectors.trajectory(name)
    out = programs.answer("double", [t.problem])[0]
    F, anchored = np.asarray(out["F"]), np.asarray(out["anchored"], bool)
    stated = np.array([list(row) for row in t.meta["branch"]["rows"]])
    assert np.array_equal(stated != "-", anchored)
    loaded = F[..., 2] > 0
    limit = t.problem.points.mu * F[..., 2]
    slides = np.abs(np.hypot(F[..., 0], F[..., 1]) - limit) <= 1e-9 * limit
    assert np.array_equal((stated == "S")[loaded], slides[loaded])


@pytest.mark.parametrize("name", RUNS)
def test_feet_in_runs_are_those_of_the_events_before(name):
    t = vectors.trajectory(name)
    feet, names = list(t.meta["branch"]["rows"][0]), list(t.problem.points.names)
    events, found = list(t.meta["events"]), []
    for instant in t.columns["t_s"]:
        while events and events[0][0] <= instant * (1 + 1e-6):
            _, point, what = events.pop(0)
            now = names.index(point)
            before, feet[now] = feet[now], {"lifts": "-", "slides": "S", "sticks": "s", "touches": "?"}[what]
            assert before != feet[now], (name, instant, point)
        found.append("".join(feet))
    stated = t.meta["branch"]["rows"]
    assert len(found) == len(stated)
    for row, right in zip(found, stated, strict=True):
        assert all(a == b or (a == "?" and b != "-") for a, b in zip(row, right, strict=True)), (row, right)
