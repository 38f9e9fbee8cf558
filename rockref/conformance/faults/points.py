"""Mistakes at a contact point: where it is, how hard the plate pushes, friction."""

from __future__ import annotations

import numpy as np

from rockref.conformance.backends.rule_set import Made, Rules, Touch, point_law
from rockref.conformance.faults.mistake import Mistake
from rockref.model.rotation import apply, apply_to_points, cross, transposed

# -- K1: where the point is and how it moves ------------------------------------------------------------------------


def _rates(change):
    """Return a plant that lets `change` rewrite the motion k of the points."""

    def plant(rules: Rules) -> Rules:
        def kinematics(x, Lambda, v, W, P):
            return change(rules.kinematics(x, Lambda, v, W, P), x, Lambda, v, W, P)

        return rules.replace(kinematics=kinematics)

    return plant


def wrong_sign_of_rate(k, x, Lambda, v, W, P):
    return k._replace(xi_rate=-k.xi_rate)


def rate_of_the_centre(k, x, Lambda, v, W, P):
    u_rate = np.broadcast_to(v[..., None, :], k.u.shape).copy()
    return k._replace(u_rate=u_rate, xi_rate=-u_rate[..., 2], v_slide=u_rate[..., :2])


def slide_with_the_normal_part(k, x, Lambda, v, W, P):
    flat = np.sqrt(k.v_slide[..., 0] ** 2 + k.v_slide[..., 1] ** 2)
    whole = np.sqrt(flat**2 + k.xi_rate**2)
    return k._replace(v_slide=k.v_slide * np.where(flat > 0, whole / np.where(flat > 0, flat, 1), 1)[..., None])


def body_rate_not_turned(k, x, Lambda, v, W, P):
    u_rate = v[..., None, :] + cross(W[..., None, :], k.r)
    return k._replace(u_rate=u_rate, xi_rate=-u_rate[..., 2], v_slide=u_rate[..., :2])


def slide_of_the_centre(k, x, Lambda, v, W, P):
    return k._replace(v_slide=np.broadcast_to(v[..., None, :2], k.v_slide.shape))


def lever_of_the_rate_from_the_origin(k, x, Lambda, v, W, P):
    u_rate = v[..., None, :] + cross(apply(Lambda, W)[..., None, :], k.u)
    return k._replace(u_rate=u_rate, xi_rate=-u_rate[..., 2], v_slide=u_rate[..., :2])


def turned_the_wrong_way(k, x, Lambda, v, W, P):
    r = apply_to_points(transposed(Lambda), P)
    u = x[..., None, :] + r
    u_rate = v[..., None, :] + cross(apply(Lambda, W)[..., None, :], r)
    return type(k)(r, u, u_rate, -u[..., 2], -u_rate[..., 2], u_rate[..., :2])


def lever_cross_rate(k, x, Lambda, v, W, P):
    u_rate = v[..., None, :] + cross(k.r, apply(Lambda, W)[..., None, :])
    return k._replace(u_rate=u_rate, xi_rate=-u_rate[..., 2], v_slide=u_rate[..., :2])


# -- N1, N2: the normal force ---------------------------------------------------------------------------------------


def adhesion(xi, xi_rate, K_N, C_N):
    return K_N * xi + C_N * xi_rate


def clipped_separately(xi, xi_rate, K_N, C_N):
    return np.maximum(K_N * xi, 0) + np.maximum(C_N * xi_rate, 0)


def damper_by_depth(xi, xi_rate, K_N, C_N):
    return np.maximum(K_N * xi * (1 + C_N / K_N * 1e4 * xi_rate), 0)


def damper_reversed(xi, xi_rate, K_N, C_N):
    return np.maximum(K_N * xi - C_N * xi_rate, 0)


def damper_in_loading_only(xi, xi_rate, K_N, C_N):
    return np.maximum(K_N * xi + C_N * np.maximum(xi_rate, 0), 0)


def no_branch(xi, F_N):
    return F_N


def contact_above_the_plate(xi, F_N):
    return np.where(xi < -2e-6, 0, F_N)


def depth_without_sign(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    c = point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p)
    return c._replace(F_N=rules.normal(np.abs(xi), xi_rate, p.K_N, p.C_N))


def tangential_constants(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    return point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p._replace(K_N=p.K_T, C_N=p.C_T))


# -- T5: the anchor -------------------------------------------------------------------------------------------------


def stale_anchor(xi, u_t, s, had_anchor):
    ever = had_anchor | (s[..., 0] != 0) | (s[..., 1] != 0)
    return np.where(ever[..., None], s, u_t), xi >= 0


def anchor_set_in_every_step(xi, u_t, s, had_anchor):
    return u_t.copy(), xi >= 0


def anchor_at_the_origin(xi, u_t, s, had_anchor):
    keep = (xi >= 0) & had_anchor
    return np.where(keep[..., None], s, 0 * u_t), xi >= 0


def touching_for_ever(xi, u_t, s, had_anchor):
    return np.where(had_anchor[..., None], s, u_t), (xi >= 0) | had_anchor


# -- T1: the trial force --------------------------------------------------------------------------------------------


def no_damper(u_t, s, v_slide, K_T, C_T):
    return K_T[..., None] * (s - u_t)


def damper_pushes(u_t, s, v_slide, K_T, C_T):
    return K_T[..., None] * (s - u_t) + C_T[..., None] * v_slide


def normal_constants(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    return point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p._replace(K_T=p.K_N, C_T=p.C_N))


# -- T2, T6: the cone -----------------------------------------------------------------------------------------------


def larger_component(F):
    return np.maximum(np.abs(F[..., 0]), np.abs(F[..., 1]))


def sum_of_components(F):
    return np.abs(F[..., 0]) + np.abs(F[..., 1])


def square_against_limit(size, limit):
    return size * size <= limit


def never_slides(size, limit):
    return size >= 0


def always_slides(size, limit):
    return size < 0


def coefficients_exchanged(F_N, was_sliding, mu_0, mu):
    return np.where(was_sliding, mu_0, mu) * F_N


def always_static(F_N, was_sliding, mu_0, mu):
    return mu_0 * F_N


def always_dynamic(F_N, was_sliding, mu_0, mu):
    return mu * F_N


def threshold_by_the_spring(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    """Plant a fault: the threshold takes K_N xi, the damper forgotten."""

    def threshold(F_N, was_sliding, mu_0, mu):
        return rules.threshold(np.where(xi >= 0, p.K_N * xi, 0 * F_N), was_sliding, mu_0, mu)

    return point_law(rules.replace(threshold=threshold), xi, xi_rate, u_t, v_slide, s, anchored, sliding, p)


# -- T3: sliding ----------------------------------------------------------------------------------------------------


def box(F_trial, size, stick, mu_F_N):
    limit = mu_F_N[..., None]
    return np.where(stick[..., None], F_trial, np.clip(F_trial, -limit, limit))


def no_guard(F_trial, size, stick, mu_F_N):
    return np.minimum(1, mu_F_N / size)[..., None] * F_trial


def returned_half_way(F_trial, size, stick, mu_F_N):
    ratio = mu_F_N / np.where(stick, 1, size)
    scale = np.where(stick, 1, np.where(mu_F_N > 0, (1 + ratio) / 2, 0))
    return scale[..., None] * F_trial


def dashpot_outside(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    c = point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p)
    spring = p.K_T[..., None] * (c.s_trial - u_t)
    size = rules.size(spring)
    limited = np.minimum(1, p.mu * c.F_N / np.where(size > 0, size, 1))[..., None] * spring
    F_T = np.where(c.sliding[..., None], limited - p.C_T[..., None] * v_slide, c.F_T)
    return c._replace(F_T=np.where((c.F_N > 0)[..., None], F_T, 0))


def cone_by_the_uncut_normal(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    c = point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p)
    uncut = np.where(xi >= 0, p.K_N * xi + p.C_N * xi_rate, 0)
    size = rules.size(c.F_trial)
    F_T = rules.friction(c.F_trial, size, ~c.sliding | (size == 0), p.mu * uncut)
    F_T = np.where((c.sliding & (uncut < 0))[..., None], F_T, c.F_T)
    return c._replace(F_T=F_T, s=rules.anchor(F_T, u_t, c.s_trial, v_slide, ~c.sliding, p.K_T, p.C_T))


def against_the_velocity(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    c = point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p)
    speed = rules.size(v_slide)
    along = -(p.mu * c.F_N / np.where(speed > 0, speed, 1))[..., None] * v_slide
    F_T = np.where(c.sliding[..., None], along, c.F_T)
    return c._replace(F_T=F_T, s=rules.anchor(F_T, u_t, c.s_trial, v_slide, ~c.sliding, p.K_T, p.C_T))


def slides_with_mu_0(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    c = point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p)
    size = rules.size(c.F_trial)
    F_T = np.where(c.sliding[..., None], rules.friction(c.F_trial, size, ~c.sliding, p.mu_0 * c.F_N), c.F_T)
    return c._replace(F_T=F_T, s=rules.anchor(F_T, u_t, c.s_trial, v_slide, ~c.sliding, p.K_T, p.C_T))


# -- T4: the anchor after sliding -----------------------------------------------------------------------------------


def anchor_left_behind(F_T, u_t, s, v_slide, stick, K_T, C_T):
    return s


def anchor_without_damper(F_T, u_t, s, v_slide, stick, K_T, C_T):
    return np.where(stick[..., None], s, u_t + F_T / K_T[..., None])


def anchor_at_the_foot(F_T, u_t, s, v_slide, stick, K_T, C_T):
    return np.where(stick[..., None], s, u_t)


def anchor_on_the_other_side(F_T, u_t, s, v_slide, stick, K_T, C_T):
    return np.where(stick[..., None], s, u_t - (F_T + C_T[..., None] * v_slide) / K_T[..., None])


def _one(**changes):
    return lambda rules: rules.replace(**changes)


OF_POINTS = (
    Mistake("Z04", "K1", "sign of the penetration rate: the damper feeds energy", _rates(wrong_sign_of_rate)),
    Mistake("Z06", "K1", "rates of the centre, omega x r forgotten", _rates(rate_of_the_centre)),
    Mistake(
        "Z19", "K1", "sliding velocity not projected: contains the normal part", _rates(slide_with_the_normal_part)
    ),
    Mistake("Z25", "K1", "angular velocity not turned into plate axes", _rates(body_rate_not_turned)),
    Mistake("Z36", "K1", "sliding velocity of the centre in place of the foot's", _rates(slide_of_the_centre)),
    Mistake(
        "Z88", "K1", "rates with the lever from the origin of the plate", _rates(lever_of_the_rate_from_the_origin)
    ),
    Mistake("Z37", "K1", "points turned by the transposed rotation", _rates(turned_the_wrong_way)),
    Mistake("Z38", "K1", "r x omega for omega x r", _rates(lever_cross_rate)),
    Mistake("Z01", "N1", "adhesion: the damper may pull in rebound", _one(normal=adhesion)),
    Mistake("Z02", "N1", "spring and damper clipped separately", _one(normal=clipped_separately)),
    Mistake("Z39", "N1", "damper proportional to the depth (Hunt-Crossley)", _one(normal=damper_by_depth)),
    Mistake("Z40", "N1", "damper with the wrong sign", _one(normal=damper_reversed)),
    Mistake("Z41", "N1", "damper in loading only", _one(normal=damper_in_loading_only)),
    Mistake("Z42", "N1", "tangential constants in the normal force", _one(point_law=tangential_constants)),
    Mistake("Z03", "N2", "damping acts above the plate", _one(gap=no_branch)),
    Mistake("Z43", "N2", "contact from two micrometres above the plate", _one(gap=contact_above_the_plate)),
    Mistake("Z85", "N2", "depth without its sign: pushes from both sides", _one(point_law=depth_without_sign)),
    Mistake("Z09", "T5", "anchor kept after lift-off", _one(touch=stale_anchor)),
    Mistake("Z10", "T5", "anchor set anew in every step", _one(touch=anchor_set_in_every_step)),
    Mistake("Z44", "T5", "anchor of a new touch at the origin of the plate", _one(touch=anchor_at_the_origin)),
    Mistake("Z86", "T5", "contact flag never cleared", _one(touch=touching_for_ever)),
    Mistake("Z45", "T1", "no damper in the trial force", _one(trial=no_damper)),
    Mistake("Z46", "T1", "damper of the trial force pushes", _one(trial=damper_pushes)),
    Mistake("Z47", "T1", "normal constants in the trial force", _one(point_law=normal_constants)),
    Mistake("Z48", "T2", "larger component in place of the length", _one(size=larger_component)),
    Mistake("Z49", "T2", "sum of the components in place of the length", _one(size=sum_of_components)),
    Mistake("Z50", "T2", "square of the trial force against the limit", _one(sticks=square_against_limit)),
    Mistake("Z89", "T2", "never slides", _one(sticks=never_slides)),
    Mistake("Z90", "T2", "always slides", _one(sticks=always_slides)),
    Mistake("Z91", "T6", "threshold by the spring's part of the normal force", _one(point_law=threshold_by_the_spring)),
    Mistake("Z17", "T6", "coefficients exchanged in the threshold", _one(threshold=coefficients_exchanged)),
    Mistake("Z51", "T6", "static threshold for sliding points too", _one(threshold=always_static)),
    Mistake("Z52", "T6", "dynamic threshold for sticking points too", _one(threshold=always_dynamic)),
    Mistake("Z12", "T3", "box in place of the cone: x and y cut separately", _one(friction=box)),
    Mistake("Z14", "T3", "dashpot added outside the cone", _one(point_law=dashpot_outside)),
    Mistake(
        "Z16",
        "T3",
        "sliding force by the normal force before the tension cut",
        _one(point_law=cone_by_the_uncut_normal),
    ),
    Mistake("Z22", "T3", "0/0 at zero trial force", _one(friction=no_guard)),
    Mistake(
        "Z53", "T3", "sliding force along the velocity, not along the trial force", _one(point_law=against_the_velocity)
    ),
    Mistake("Z54", "T3", "sliding with the static coefficient", _one(point_law=slides_with_mu_0)),
    Mistake("Z55", "T3", "returned half-way to the cone only", _one(friction=returned_half_way)),
    Mistake("Z11", "T4", "force returned to the cone, anchor not moved", _one(anchor=anchor_left_behind)),
    Mistake("Z13", "T4", "anchor moved without the damper's part", _one(anchor=anchor_without_damper)),
    Mistake("Z56", "T4", "anchor moved to the foot", _one(anchor=anchor_at_the_foot)),
    Mistake("Z57", "T4", "anchor moved to the other side of the foot", _one(anchor=anchor_on_the_other_side)),
)
