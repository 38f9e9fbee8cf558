"""Every vector is on the branch that it states: the branch derived anew, from the law in float64 and from what is
expected."""

import numpy as np
import pytest

from rockref.conformance import vectors
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
