"""Diagnoses, fits and additions without the hour of computing: made-up words and numbers in the real shapes."""

from __future__ import annotations

import numpy as np

from rockref import Model
from rockref.discover.add_effect import Addition, State
from rockref.discover.compare.stretches import AXES
from rockref.discover.diagnose import Diagnosis
from rockref.discover.evidence.evidence import HypothesisEvidence, Number
from rockref.discover.fit_baseline import BaselineFit
from rockref.discover.fit_gates import Gate
from rockref.discover.hypotheses.law import law_parameters
from rockref.discover.plan import Plan, Release, further, outlook
from rockref.effects.catalogue import find, parse
from tests.unit.discover.synthetic import experiment

#: The keys that every diagnosis has.
DIAGNOSIS_KEYS = (
    "experiment", "verdict", "effects", "ranking", "amplitudes", "error", "separating_experiment", "signature", "gates",
    "seconds", "versions",
)  # fmt: skip
DRAG = Model.table_3_1().replace(effects=(parse("quadratic_drag:c=0.4"),))


def made_experiment(duration: float = 1.6):
    """Two fit runs and a held-out one of a block with drag."""
    runs = [{}, {"tilt": 0.105}, {"use": "holdout", "tilt": 0.11}]
    return experiment(DRAG, runs, duration=duration, noisy=True)


def diagnosis(verdict: str = "named", made=None) -> Diagnosis:
    """A diagnosis of this verdict."""
    effects = {"named": ("quadratic_drag",), "class": ("quadratic_drag", "rolling_resistance")}.get(verdict, ())
    found = bool(effects)
    return Diagnosis(
        experiment=made or made_experiment(),
        verdict=verdict,
        effects=effects,
        ranking=[
            {"effect": "quadratic_drag", "gain": 512.3, "z": 32.01, "weight": 0.93},
            {"effect": "rolling_resistance", "gain": 90.1, "z": 13.42, "weight": 0.07},
        ],
        amplitudes={
            "quadratic_drag.c": {"value": 0.41, "low": 0.38, "high": 0.44, "unit": "N m s2", "in_typical_sizes": 1.0}
        }
        if found
        else {},
        error={
            "unit": "deg/s RMS",
            "stretch": "some windows",
            "noise_floor": 0.05,
            "baseline": {"fit": 0.25, "holdout": 0.35},
            "with_effect": {"fit": 0.06, "holdout": 0.08} if found else {"fit": 0.25, "holdout": 0.35},
        },
        separating_experiment="Turn the block <by half a turn> & repeat." if found else "",
        signature={
            "axis": "main",
            "axis_shares": {"main": 0.7, "transverse": 0.2, "longitudinal": np.float64(0.1)},
            "parity": "odd_in_velocity",
            "parity_shares": {"even": 0.05, "odd_in_velocity": 0.97},
            "locked_to": None,
        },
        gates={"median_loss": 1.02, "held_out_gain": [0.5, float("nan")], "passed": verdict != "not_trustworthy"},
        sentence="quadratic_drag is missing." if found else "A sentence.",
        seconds=12.34,
        model=DRAG,
    )


def errors(total: float) -> dict[str, float]:
    """Errors by axis that are about this large."""
    return {axis: total * (k + 1) / 2 for k, axis in enumerate(AXES)} | {"total": total}


LAW = {"K_N": Number(5.9e7, 5.5e7, 6.3e7, "N/m", 0.3, 0.0), "mu_int": Number(0.3, 0.28, 0.32, "1", 0.1, 0.0)}
DRAG_SIZE = {"quadratic_drag.c": Number(0.41, 0.38, 0.44, "N m s2", 0.34, 1.02)}


def addition(made=None) -> Addition:
    """Drag added to the baseline: the gap to the noise closed by nine tenths, by two thirds on the held-out run."""
    before = State((), errors(0.25), errors(0.35))
    after = State(("quadratic_drag",), errors(0.07), errors(0.15))
    history = [before.to_dict(), after.to_dict()]
    return Addition(
        experiment=made or made_experiment(),
        effect="quadratic_drag",
        before=before,
        after=after,
        model=DRAG.replace(origin={"made_by": "rockref add", "history": history}),
        numbers={**DRAG_SIZE, **LAW},
        spread=np.array([0.2, 0.3, 0.4]),
        noise=0.05,
        history=history,
        end=3.0,
        seconds=1.0,
    )


def fitted(outcome: str = "trustworthy", made=None) -> BaselineFit:
    """A fit with this outcome."""
    said = HypothesisEvidence(
        (), 1000.0, [1.0], 0.95, {"01": [0.95, 0.94, 0.96]}, {"01": 0.0}, 0.3, law=LAW, error=errors(0.051)
    )
    gates = [
        Gate("starts_agree", outcome != "not_trustworthy", 0.2, 1.0, "The fit from another start differs little."),
        Gate("innovations_white", outcome != "effect_missing", 0.95, 1.05, "The innovations have a mean loss of 0.95."),
    ]
    return BaselineFit(
        experiment=made or made_experiment(),
        model=Model.table_3_1(),
        effects=(),
        evidence=said,
        gates=gates,
        outcome=outcome,
        noise=0.05,
        end=3.0,
        seconds=1.0,
    )


def planned() -> Plan:
    """A plan of one release, about two effects that it does not tell apart."""
    table = Model.table_3_1()
    effects = tuple(find(id) for id in ("viscous_friction", "rolling_resistance"))
    once, other, turned = Release(0.117), Release(0.098), Release(0.117, True)

    def says(release: Release, film: float, rolling: float, together: float) -> np.ndarray:
        """A run with this information about two effects, and about their difference."""
        n = len(law_parameters(table))
        H = np.diag([0.0] * n + [film, rolling])
        H[n:, n:] += together * np.array([[1.0, -1.0], [-1.0, 1.0]])
        return H

    known = {once: says(once, 1e-4, 4e3, 1e6), other: says(other, 9.0, 9.0, 0.0), turned: says(turned, 1.0, 1.0, 0.0)}
    now, repeats = (outlook(table, known, [once] * n, effects) for n in (1, 3))
    varied = outlook(table, known, [once, other, turned], effects)
    more = further(table, known, [once], [once, other, turned], effects, now)
    return Plan(table, now, repeats, varied, more, 1.0)
