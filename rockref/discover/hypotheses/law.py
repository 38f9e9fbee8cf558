"""The numbers of the law that a fit finds, with priors that hold for any block."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from rockref.api import Model
from rockref.discover.hypotheses.parameter import Parameter
from rockref.discover.provenance import ZERO_OFFSETS
from rockref.model.errors import InputError

#: Range of each parameter of the law. Decided, from machined steel on a plate to rough stone: normal stiffness for each
#: kilogram of mass [N/m/kg] (Table 3.1: 1.1e6), tangential over normal stiffness, damping ratios, friction
#: coefficients, heights of the outer points in parts of 0.1 m of width [m], distance of the inner points in widths.
STIFFNESS = (0.33e6, 3.5e6)
TANGENTIAL = (0.3, 1.6)
DAMPING = (0.02, 0.7)
FRICTION = (0.07, 0.9)
HEIGHT = (-10e-6, 210e-6)
DISTANCE = (0.008, 0.17)
#: Width to which HEIGHT belongs [m]; a wider base is machined to the same share of it (decided).
HEIGHT_WIDTH = 0.1
#: Roll of a release against the posture at rest [rad]; decided: feet of twice and half the common stiffness sink 5 to
#: 10 um apart under half the weight, over 0.1 m.
ROLL_UNCERTAINTY = 1e-4
#: Units of the law's parameters as a fit counts them; the others are pure numbers.
UNITS = {"K_N": "N/m", "delta_diag": "m", **{f"delta_long_{k}": "m" for k in (1, 2, 3, 4)}}


def is_height(p: Parameter) -> bool:
    """Return whether a number is the height of an outer point."""
    return p.name.startswith("delta_long_")


def set_parameter(name: str):
    """Return a setter for one of the twelve."""
    if name.startswith("delta_long_"):
        i = int(name[-1]) - 1

        def set_height(model: Model, value: float) -> Model:
            heights = list(model.parameters.delta_long)
            heights[i] = value
            return model.replace(delta_long=tuple(heights))

        return set_height
    return lambda model, value: model.replace(**{name: value})


def set_tilt_offset(model: Model, value: float) -> Model:
    """Set the release tilt of a run against the stated one [rad]."""
    return replace(model, origin={**model.origin, "tilt_offset": value})


def set_roll_offset(model: Model, value: float) -> Model:
    """Set the roll of a run at its release against the settled posture [rad]."""
    return replace(model, origin={**model.origin, "roll_offset": value})


def set_zero_offset(axis: int):
    """Return a setter of what is left of the gyroscope's zero in a run, about one axis of the block [rad/s]."""
    name = ZERO_OFFSETS[axis]
    return lambda model, value: replace(model, origin={**model.origin, name: value})


def set_tangential_ratio(model: Model, value: float) -> Model:
    """Set the tangential stiffness by its ratio to the normal one."""
    return model.replace(K_T=value * model.parameters.K_N)


def with_law(model: Model, values: Mapping[str, float]) -> Model:
    """Return a model with several of the law's numbers, by their names in a fit; K_T is a ratio to K_N."""
    given = dict(values)
    heights = list(model.parameters.delta_long)
    for k in range(len(heights)):
        heights[k] = given.pop(f"delta_long_{k + 1}", heights[k])
    if "K_T" in given:
        given["K_T"] *= given.get("K_N", model.parameters.K_N)
    return model.replace(parameters=model.parameters.replace(delta_long=tuple(heights), **given))


def moved_parameters(model: Model) -> tuple[str, ...]:
    """Return the names of the law's parameters that fits of a model move.

    Raises
    ------
    InputError
        E-MOOT, where none acts in the model.
    """
    names = tuple(name for name in model.acting_parameters() if name != "theta_0")
    if not names:
        what = "states all that a fit could move: nothing of [parameters] but theta_0 acts in it"
        raise InputError("E-MOOT", "model", what, "Fit the nearest model on eight points, or simulate and compare it.")
    return names


def law_parameters(model: Model, stated: Mapping[str, tuple[float, float]] | None = None) -> tuple[Parameter, ...]:
    """Return the law's parameters with wide priors, eleven on eight points.

    stated : ranges of an experiment's own, by the names of its `[prior]` (SI), which take the place of the wide ones
    """
    own = stated or {}
    m, width = float(model.mass), float(model.width)
    most = max(1.0, width / HEIGHT_WIDTH)
    ranges: dict[str, tuple[float, float]] = {
        "K_N": (STIFFNESS[0] * m, STIFFNESS[1] * m),
        "delta_diag": (DISTANCE[0] * width, DISTANCE[1] * width),
    }
    ranges |= {f"delta_long_{k}": (HEIGHT[0] * most, HEIGHT[1] * most) for k in (1, 2, 3, 4)}
    ranges |= dict.fromkeys(("beta_int", "beta_ext"), DAMPING) | dict.fromkeys(("mu_int", "mu_ext"), FRICTION)
    found = []
    for name in moved_parameters(model):
        if name == "K_T":
            limits = own.get("K_T_over_K_N", TANGENTIAL)
            found.append(bounded("K_T", set_tangential_ratio, limits, "log_uniform"))
            continue
        of_height = name.startswith("delta_long_")
        limits = own.get("delta_long" if of_height else name, ranges[name])
        found.append(bounded(name, set_parameter(name), limits, "uniform" if of_height else "log_uniform"))
    return tuple(found)


def bounded(name: str, setter, limits: tuple[float, float], scale: str) -> Parameter:
    """Return a number with a flat prior between two limits."""
    return Parameter(name, setter, centre=0.0, scale=scale, low=limits[0], high=limits[1], unit=UNITS.get(name, "1"))


def release_parameters(runs: int, tilt_uncertainty: float, zero_uncertainty: float = 0.0) -> tuple[Parameter, ...]:
    """Return tilt and roll of each run's release [rad], and its zero offsets [rad/s] if uncertain, run by run.

    Summed over a second, a hundredth of a deg/s turns the measured attitude by as much as feet differ in height.
    """
    found = []
    for i in range(runs):
        found.append(Parameter(f"tilt_offset[{i}]", set_tilt_offset, 0.0, tilt_uncertainty, run=i, unit="rad"))
        found.append(Parameter(f"roll_offset[{i}]", set_roll_offset, 0.0, ROLL_UNCERTAINTY, run=i, unit="rad"))
        if zero_uncertainty > 0:
            for axis, name in enumerate(ZERO_OFFSETS):
                zero = Parameter(f"{name}[{i}]", set_zero_offset(axis), 0.0, zero_uncertainty, run=i, unit="rad/s")
                found.append(replace(zero, moves_target=True))
    return tuple(found)
