"""What may be missing: every effect of the catalogue as numbers that a fit can move."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from functools import partial

from rockref.api import Model
from rockref.discover.fit.parameter import Parameter
from rockref.effects import catalogue
from rockref.effects.base import Effect, Quantity
from rockref.effects.loads.base_vibration import BaseVibration

#: Candidates that no window can judge by a derivative: a shaking base has a phase of its own in every run, and a
#: clipped record has none at all.
LEFT_OUT = ("base_vibration", "gyro_saturation")
#: Parameters that shape an effect but do not bring it in: they are found on a logarithmic scale about their typical
#: value. name -> spread (decided: a factor of about two).
SHAPES = {
    ("adhesion", "range"): 0.5,
    ("gyro_bandwidth", "damping"): 0.5,
    ("hertzian_contact", "reference"): 0.5,
    ("stribeck_friction", "velocity"): 0.7,
    ("lingering_wire_pull", "tau"): 0.5,
    ("compliant_support", "mass"): 0.7,
    ("compliant_support", "ratio"): 0.7,
}
#: Parameters between two laws, on a straight scale from one to the other: they begin half way. name -> centre, spread.
BETWEEN = {("dimension_deviation", "inertia_share"): (0.5, 0.5)}
SHAPES |= {key: spread for key, (_, spread) in BETWEEN.items()}
#: Prior standard deviation of those, in such spreads; decided: flat, within what is possible.
FLAT = 2.0
#: Factors by which what the feet have in common differs from foot to foot, typically not at all: found on a logarithmic
#: scale about one (decided: radii of feet that are ground by hand, by a third).
OF_EACH_FOOT = {("rounded_feet", f"foot{i}"): 0.3 for i in (1, 2, 3, 4)}
SHAPES |= OF_EACH_FOOT
#: Parameters that are kept at what they are by default, since no record of a release can tell them from another one.
FIXED = {
    ("load_dependent_friction", "reference"),
    ("cable_restraint", "height"),
    ("base_vibration", "phase"),
    ("gyro_bandwidth", "delay"),
}
#: Positive factors: found on a logarithmic scale about the value at which they are absent. effect -> spread.
FACTORS = {
    "uneven_foot_stiffness": 0.4,
    "uneven_foot_damping": 0.4,
    "uneven_foot_friction": 0.3,
    "stribeck_friction": 0.4,
}
#: Parameters that are absent at infinity: found as their inverse (as a user's own that are).
INVERSE = ("gyro_bandwidth.frequency", "gyro_saturation.range")
#: Parameters that are typically none, and what counts as their typical size (decided: half a kilogram more at one
#: corner makes products of inertia of 0.02 with the long axis; axes half a degree from square; drag on the faces of the
#: block, from bottom to top, with three times the typical moment about its base, has a force of 20 N s2/m2 at the
#: centre. Such drag does not slow its turning about the long axis, as a moment alike about all axes does: runs with it
#: were named `cable_restraint`).
SELDOM = {("inertia_deviation", axes): 0.02 for axes in ("xy", "xz", "yz")}
SELDOM |= {("gyro_misalignment", axes): 0.005 for axes in ("xy", "xz", "yz")}
SELDOM |= {("quadratic_drag", "c_v"): 20.0}
#: The same for what turns one form of a law into another one, 1 being all the way; no effect is there by it alone.
FORMS = {
    ("uneven_foot_stiffness", "tangential_share"): 1.0,
    ("uneven_foot_damping", "normal_share"): 1.0,
    ("uneven_contact_normals", "turning_share"): 1.0,
    ("spin_friction", "sliding_share"): 1.0,
    ("hysteretic_contact", "curved_share"): 1.0,
    ("lingering_wire_pull", "evenness"): 1.0,
    ("gyro_saturation", "softness"): 1.0,
    ("compliant_support", "pitch"): 1.0,
}
SELDOM |= FORMS
#: Their prior standard deviation in such sizes: what the runs cannot tell from the rest of the effect stays none, and
#: one whole size costs 50 log-likelihood units (decided; axes that are not square trade with a turned sensor, and with
#: a prior like the others' they spoiled its angles by 8 % where there was nothing of the kind).
SELDOM_PRIOR = 0.1
#: Numbers whose hard limit depends on the block: a fit keeps them below the plausible end of their range. Steps along
#: the inner points' distance added up to 74 mm on a blind case, where the middle of the base is 71 mm from its corner.
PLAUSIBLE = {("foot_defects", "delta_diag")}
#: Share of half a small base's diagonal that inner points stay within (decided: at one they meet in the middle).
NEARLY = 0.9
#: Prior standard deviation in typical sizes; decided: what is five times the typical size is not expected.
PRIOR = 3.0


def current(model: Model, kind: type[Effect]) -> Effect:
    """The effect of this kind in a model, or a new one with its shape parameters typical and its switches absent."""
    for effect in model.effects:
        if effect.id == kind.id:
            return effect
    shape = {k: q.typical for k, q in kind.quantities.items() if (kind.id, k) in SHAPES or is_kept(kind, k)}
    return kind(**shape)


def is_kept(kind: type[Effect], key: str) -> bool:
    """Whether a parameter of a user's own effect does not bring it in: no fit moves it, it stays typical."""
    return kind.file is not None and kind.switches is not None and key not in kind.switches


def with_effect(model: Model, effect: Effect) -> Model:
    """The model with this effect in place of the one of the same kind."""
    kept = [e for e in model.effects if e.id != effect.id]
    return replace(model, effects=catalogue.in_step_order([*kept, effect]))


def setter(kind: type[Effect], key: str):
    """Sets one parameter of an effect in a model; an effect that is absent and stays so is not even made."""

    def set_value(model: Model, value: float) -> Model:
        there = any(e.id == kind.id for e in model.effects)
        if not there and ((kind.id, key) in SHAPES or value == kind.quantities[key].absent):
            return model
        return with_effect(model, replace(current(model, kind), **{key: value}))

    return set_value


def parameters_of(kind: type[Effect], runs: int, frequency: float | None = None) -> tuple[Parameter, ...]:
    """The free parameters of an effect; z = 0 is its absence, z = 1 its typical size (shapes: typical at z = 0)."""
    if kind.id == "base_vibration":
        return vibration_parameters(kind, runs, frequency)
    found = []
    still = [k for k in kind.quantities if (kind.id, k) in FIXED or is_kept(kind, k)]
    switches = [k for k in kind.quantities if (kind.id, k) not in SHAPES and k not in still]
    shapes = [k for k in kind.quantities if (kind.id, k) in SHAPES]
    for key in [*switches, *shapes]:
        found.append(parameter_of(kind, key, kind.quantities[key]))
    return tuple(found)


def parameter_of(kind: type[Effect], key: str, q: Quantity) -> Parameter:
    """One parameter of an effect as a number that a fit can move."""
    typical, absent = float(q.typical or 0.0), float(q.absent or 0.0)
    make = partial(Parameter, f"{kind.id}.{key}", unit=q.unit, step=0.05)
    if (kind.id, key) in BETWEEN:
        centre, spread = BETWEEN[kind.id, key]
        return make(setter(kind, key), centre, spread, prior=FLAT, low=q.least, high=q.most)
    if (kind.id, key) in SHAPES:
        return make(setter(kind, key), typical, SHAPES[kind.id, key], log=True, prior=1.0)
    low = absent if q.sign == "+" else q.least
    if (kind.id, key) in SELDOM:
        return make(setter(kind, key), absent, SELDOM[kind.id, key], prior=SELDOM_PRIOR, low=low, high=q.most)
    if kind.id in FACTORS:
        return make(setter(kind, key), 1.0, FACTORS[kind.id], log=True, prior=PRIOR)
    if kind.id == "compliant_support":
        return make(support_setter(kind), 0.0, 1.0, low=0.0, prior=PRIOR)
    if is_inverse(f"{kind.id}.{key}"):
        return make(inverse_setter(kind, key), 0.0, 1 / typical, low=0.0, prior=PRIOR)
    # A user's own may have a parameter that is typically none: then a quarter of its plausible range.
    size = abs(typical - absent) or (q.high - q.low) / 4
    high = q.high if (kind.id, key) in PLAUSIBLE else q.most
    return make(setter(kind, key), absent, size, prior=PRIOR, low=low, high=high)


def within_base(p: Parameter, model: Model) -> Parameter:
    """A parameter of an effect that keeps inner points on their side of the middle of a model's base."""
    if p.name != "foot_defects.delta_diag":
        return p
    return replace(p, high=min(p.high, NEARLY * math.hypot(model.width, model.depth) / 2))


def is_inverse(name: str) -> bool:
    """Whether a parameter, by its name in a fit ("gyro_bandwidth.frequency"), is found as its inverse."""
    id, _, key = name.partition(".")
    q = catalogue.OWN[id].quantities.get(key) if id in catalogue.OWN else None
    return name in INVERSE or (q is not None and q.absent == math.inf)


def inverse_setter(kind: type[Effect], key: str):
    """For parameters that are absent at infinity: found as their inverse."""
    direct = setter(kind, key)
    return lambda model, value: direct(model, 1 / value if value > 0 else float("inf"))


def vibration_parameters(kind: type[Effect], runs: int, frequency: float | None = None) -> tuple[Parameter, ...]:
    """Frequency and direction of a base vibration, and for each run its cosine and sine amplitude (its own phase)."""
    q = kind.quantities
    size = float(q["amplitude"].typical or 1.0)
    first = frequency or float(q["frequency"].typical or 10.0)

    def component(real: bool):
        def set_value(model: Model, value: float) -> Model:
            there = any(e.id == kind.id for e in model.effects)
            if not there and value == 0:
                return model
            e = current(model, kind)
            assert isinstance(e, BaseVibration)
            c, s = e.amplitude * math.cos(e.phase), e.amplitude * math.sin(e.phase)
            c, s = (value, s) if real else (c, value)
            return with_effect(model, replace(e, amplitude=math.hypot(c, s), phase=math.atan2(s, c)))

        return set_value

    def shape(key: str):
        def set_value(model: Model, value: float) -> Model:
            return with_effect(model, replace(current(model, kind), **{key: value}))

        return set_value

    found = [
        Parameter(f"{kind.id}.frequency", shape("frequency"), first, 0.02, log=True,
                  step=0.05, prior=10.0, unit="Hz"),
        Parameter(f"{kind.id}.direction", shape("direction"), 0.0, 0.5, prior=3.0, unit="rad", step=0.05),
    ]  # fmt: skip
    for i in range(runs):
        for part, real in (("cosine", True), ("sine", False)):
            name = f"{kind.id}.{part}[{i}]"
            found.append(Parameter(name, component(real), 0.0, size, run=i, prior=PRIOR, unit="m/s2", step=0.1))
    return tuple(found)


def support_setter(kind: type[Effect]):
    """A support is absent when it is rigid: found as its compliance against that of the typical frequency."""
    typical, direct = float(kind.quantities["frequency"].typical or 60.0), setter(kind, "frequency")
    return lambda model, value: direct(model, typical / value**0.5 if value > 1e-3 else 0.0)


def value_of(parameter: Parameter, z: float) -> float:
    """The effect's own number at z (an inverse is turned back)."""
    v = parameter.value(z)
    if parameter.name == "compliant_support.frequency":
        typical = float(catalogue.EFFECTS["compliant_support"].quantities["frequency"].typical or 60.0)
        return typical / v**0.5 if v > 1e-3 else 0.0
    if is_inverse(parameter.name):
        return 1 / v if v > 0 else float("inf")
    return v


def kinds(points: str, leave_out: Iterable[str] = (), own: Iterable[str] = ()) -> tuple[type[Effect], ...]:
    """The candidates beside a model with these points; foot defects only where it has none. own : a user's, by id."""
    left = set(leave_out)
    if points != "four_points":
        left.add("foot_defects")
    return tuple(k for k in (*catalogue.IN_STEP_ORDER, *map(catalogue.find, own)) if k.id not in left)
