"""The rule table: every rule of the law, in the order in which data flows through a step."""

from __future__ import annotations

from typing import NamedTuple


class Rule(NamedTuple):
    """A rule: id, what it says, equation or place in the source, the function of the law that is it, what it feeds
    on."""

    id: str
    says: str
    equation: str
    function: str
    needs: tuple[str, ...] = ()


RULES: tuple[Rule, ...] = (
    Rule("G1", "inertia of the uniform cuboid", "G1", "rockref.model.geometry:cuboid_inertia"),
    Rule("G2", "places of the eight contact points", "Fig. 3.2b", "rockref.model.geometry:eight_points"),
    Rule("P1", "one stiffness for all points", "(3.7)", "rockref.model.parameters:common_stiffness"),
    Rule("P2", "C = 2 beta sqrt(K m)", "(3.8)", "rockref.model.parameters:viscous_damping", ("P1",)),
    Rule(
        "P3", "the same ratio, normal and tangential", "(3.9)", "rockref.model.parameters:common_damping_ratio", ("P2",)
    ),
    Rule("R1", "release posture", "Release posture", "rockref.model.release:release_posture", ("G2", "P1")),
    Rule("I1", "x+ = x + h v + h^2/2 a", "I1", "rockref.model.integrator:update_position"),
    Rule("I2", "Theta = h W + h^2/2 A, A = J^-1 (T - W x J W)", "I2", "rockref.model.integrator:rotation_increment"),
    Rule("I3", "Lambda+ = Lambda exp(Theta^)", "I3", "rockref.model.integrator:update_rotation", ("I2",)),
    Rule(
        "S1",
        "contact forces at n+1 from x+, Lambda+ and the predicted velocities v + h a, W + h A",
        "The step",
        "rockref.model.integrator:step",
        ("I1", "I2", "I3"),
    ),
    Rule("K1", "penetration, its rate, sliding velocity", "K1", "rockref.model.contact:point_kinematics", ("S1",)),
    Rule("N1", "F_N = max(K_N xi + C_N xi_rate, 0)", "(3.5a)", "rockref.model.contact:kelvin_voigt", ("K1",)),
    Rule("N2", "xi < 0: F_N = 0", "(3.5b)", "rockref.model.contact:open_gap", ("K1",)),
    Rule("T5", "no contact, no anchor; set where the point next touches", "T5", "rockref.model.contact:touch", ("K1",)),
    Rule("T1", "trial force of sticking", "before (3.6)", "rockref.model.contact:trial_force", ("T5",)),
    Rule("T2", "sticking while |F*| <= mu_0 F_N", "(3.6a)", "rockref.model.contact:sticks", ("N1", "N2", "T1")),
    Rule(
        "T6", "threshold mu_0 F_N if it stuck, mu F_N if it slid", "(3.6)", "rockref.model.contact:threshold", ("T2",)
    ),
    Rule("T3", "sliding: mu F_N along the trial force", "(3.6b)", "rockref.model.contact:radial_return", ("T2", "T6")),
    Rule("T4", "after sliding the anchor is moved", "after (3.6)", "rockref.model.contact:move_anchor", ("T3",)),
    Rule("A1", "sum of point forces and weight", "A1", "rockref.model.assembly:resultant_force", ("N1", "N2", "T3")),
    Rule(
        "B1",
        "F = -m a(t) at the centre of mass, in axes that move with the plate",
        "B1",
        "rockref.model.base_motion:inertial_force",
    ),
    Rule("A2", "moment about the centre of mass", "A2", "rockref.model.assembly:resultant_moment", ("N1", "N2", "T3")),
    Rule("A3", "the moment in body axes", "A3", "rockref.model.assembly:body_moment", ("A2",)),
    Rule("I4", "v+ = v + h/2 (a + a+)", "I4", "rockref.model.integrator:update_velocity", ("A1", "B1")),
    Rule(
        "I5",
        "J W+ = exp(-Theta^)[J W + h/2 T] + h/2 T+",
        "I5",
        "rockref.model.integrator:update_momentum",
        ("I2", "A3"),
    ),
    Rule(
        "S2",
        "the run: first evaluation at the start, rows at their instants",
        "The step",
        "rockref.model.simulate:simulate",
    ),
    Rule("M1", "measured channel: crv in deg/s about X, Y, Z", "Fig. 3.4", "rockref.model.channel:crv_deg_s", ("I5",)),
)

#: What a run by itself cannot tell from a rule: constants that are misread, a rate and the damper that it drives, a
#: force and what is made of it, an inertia and the equations that it stands in, an increment and its exponential; as
#: the zoo shows, whose mistakes of the rules on the right make runs point to those on the left.
#: The likeliest first: runs are given their points and constants, and what is derived from parameters comes last.
ALIKE_IN_RUNS: dict[str, tuple[str, ...]] = {
    "I2": ("I5", "G1"),
    "I3": ("I2",),
    "I5": ("I2", "G1", "M1"),
    "K1": ("N1", "G2"),
    "N1": ("K1", "P1", "P2"),
    "T1": ("K1", "T5", "P1", "P2", "P3"),
    "N2": ("G2",),
    "T6": ("T2",),
    "T3": ("T2", "T6"),
    "A1": ("I4", "S2"),
    "A2": ("A3", "G2"),
    "I4": ("A1",),
}

ORDER = {rule.id: i for i, rule in enumerate(RULES)}
BY_ID = {rule.id: rule for rule in RULES}

#: What an optional piece of a backend shows.
PIECES: dict[str, tuple[str, ...]] = {
    "derived": ("G1", "G2", "P1", "P2", "P3"),
    "release": ("R1",),
    "kinematics": ("K1",),
    "contact_law": ("N1", "N2", "T5", "T1", "T2", "T6", "T3", "T4"),
    "assemble": ("A1", "A2", "A3"),
    "rotate": ("I3",),
    "integrate": ("I1", "I2", "I3", "S1", "I4", "I5"),
    "step": (),
    "channel": ("M1",),
}


def downstream(rule: str) -> set[str]:
    """Return the rules that feed on `rule`, directly or through others."""
    found: set[str] = set()
    while True:
        more = {r.id for r in RULES if r.id not in found and ({rule} | found) & set(r.needs)}
        if not more:
            return found
        found |= more
