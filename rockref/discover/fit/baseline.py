"""What the law itself gives a fit to move: its parameters, and of each run the tilt and the roll of its release."""

from __future__ import annotations

from dataclasses import replace

from rockref.api import Model
from rockref.discover.hypotheses.counted import Parameter
from rockref.model.errors import InputError

#: Roll of a release against the posture at rest [rad]; decided: feet of twice and half the common stiffness sink 5 to
#: 10 um apart under half the weight, over 0.1 m.
ROLL_UNCERTAINTY = 1e-4


def set_parameter(name: str):
    """A setter for one of the twelve."""
    if name.startswith("delta_long_"):
        i = int(name[-1]) - 1

        def set_height(model: Model, value: float) -> Model:
            heights = list(model.parameters.delta_long)
            heights[i] = value
            return model.replace(delta_long=tuple(heights))

        return set_height
    return lambda model, value: model.replace(**{name: value})


def set_tilt_offset(model: Model, value: float) -> Model:
    """The release tilt of a run against the stated one [rad]."""
    return replace(model, origin={**model.origin, "tilt_offset": value})


def set_roll_offset(model: Model, value: float) -> Model:
    """Roll of a run at its release against the settled posture, about the transverse axis [rad]."""
    return replace(model, origin={**model.origin, "roll_offset": value})


def roll_parameters(runs: int) -> tuple[Parameter, ...]:
    """A roll of each run, which all its restarts share: the block was not let go quite as it stands at rest."""
    return tuple(
        Parameter(f"roll_offset[{i}]", set_roll_offset, 0.0, ROLL_UNCERTAINTY, run=i, unit="rad", step=0.05)
        for i in range(runs)
    )


def moved_parameters(model: Model) -> tuple[str, ...]:
    """Names of the law's parameters that fits of a model move. Raises InputError (E-MOOT) where none acts in it."""
    names = tuple(name for name in model.acting_parameters() if name != "theta_0")
    if not names:
        what = "states all that a fit could move: nothing of [parameters] but theta_0 acts in it"
        raise InputError("E-MOOT", "model", what, "Fit the nearest model on eight points, or simulate and compare it.")
    return names


def baseline_parameters(model: Model, runs: int, tilt_uncertainty: float) -> tuple[Parameter, ...]:
    """The parameters of the law that windows can see, eleven on eight points, and a release tilt for each run.

    Decided: log-normal priors of 15 % (8 % for delta_diag) about Table 3.1, half a stated digit and more; theta_0 of
    Table 3.1 is replaced by the stated tilt of each run within the stated uncertainty. What does not act in the model
    is left out. Raises InputError as `moved_parameters`.
    """
    p = model.parameters
    names = moved_parameters(model)
    centre = {n: getattr(p, n) for n in names if not n.startswith("delta_long_")}
    centre |= {f"delta_long_{i + 1}": p.delta_long[i] for i in range(4)}
    shared = [Parameter(n, set_parameter(n), centre[n], 0.08 if n == "delta_diag" else 0.15, log=True) for n in names]
    tilts = [
        Parameter(f"tilt_offset[{i}]", set_tilt_offset, 0.0, tilt_uncertainty, run=i, unit="rad", step=0.01)
        for i in range(runs)
    ]
    return (*shared, *tilts)
