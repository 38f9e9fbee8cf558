"""Causes with a known signature: what makes an engine deviate so, in general; the adapter adds its own knob."""

#: Key of a cause: the cause in words, and what to do where the adapter names no knob of its own.
CAUSES = {
    "frame": ("the adapter returns another state than it was given", "check the quaternion's order, body or world axes "
              "of omega, and whether the velocity is that of the centre of mass"),
    "precision": ("the engine computes in single precision", 'say precision "float32" in facts(), or build it in '
                  "double"),
    "inertia": ("the moments of inertia are other ones", "check their order, and whether the engine makes its own from "
                "the shape"),
    "gyroscopic": ("the term omega x J omega is missing", "switch the engine's gyroscopic forces on"),
    "count": ("a step too many is made", "check whether the first call makes a step of its own"),
    "damping": ("the engine damps free motion", "set linear and angular damping to zero"),
    "gravity": ("gravity is another one", "check its value, and whether it acts in every substep"),
    "plate": ("there is no contact with the plate", "check that plate and body collide, and the plate's pose"),
    "creep": ("friction is a viscous law at small speeds", "raise the friction's stiffness or the iterations"),
    "rattling": ("the contact does not come to rest", "raise the contact's damping, or lower its stiffness or the "
                 "step"),
    "pyramid_inside": ("the friction cone is a pyramid inside Coulomb's cone, weaker by 1/sqrt(2) along its diagonal",
                       "choose an elliptic or round cone"),
    "pyramid_outside": ("the friction cone is a pyramid around Coulomb's cone, stronger by sqrt(2) along its diagonal",
                        "choose an elliptic or round cone, or a friction model that couples both directions"),
    "friction": ("friction is not that of its coefficient", "check how the engine combines the coefficients of two "
                 "bodies, and at how many points a face rests"),
    "rounding": ("in single precision such a drift grows as steps get smaller", "take larger steps, or build the "
                 "engine in double precision"),
    "integrator": ("the integrator is of first order in free rotation", "halve the step, or choose one of higher "
                   "order"),
    "few_contacts": ("the block stands on fewer contact points than it has corners", "give the body a contact point at "
                     "every corner, or the ground as a large box"),
    "energy": ("the contact gives energy", "lower stiffness or step, switch position correction with velocity off, or "
               "give the ground as a large box"),
    "sleep": ("the engine puts slow bodies to sleep", "switch sleeping off"),
    "soft": ("the contact is soft", "make it stiffer, with a smaller step if need be"),
    "pivot": ("the pivot lies inside the edge", "the contact acts on a patch, or edges are rounded: make the contact "
              "stiffer and the edges sharp"),
    "early": ("contacts act before they touch", "shorten the distance at which contacts are predicted"),
    "stale": ("contact points are kept while the body turns", "switch the reuse of contact points off"),
    "step": ("the error does not shrink with the step", "look for constants with the unit of time or length in the "
             "engine's settings"),
    "lost": ("the engine did not return finite numbers", "lower the step or the stiffness"),
}  # fmt: skip


def advice(cause: str, knobs: dict[str, str]) -> str:
    """Return the cause in words and the knob: the adapter's own where it names one."""
    if cause not in CAUSES:
        return ""
    what, cure = CAUSES[cause]
    return f"{what}; {knobs.get(cause, cure)}"
