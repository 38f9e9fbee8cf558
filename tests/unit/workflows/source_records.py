"""Results of the studies of the source, with made-up numbers that are told apart on a page."""

from __future__ import annotations

from typing import Any

from rockref.model.parameters import TABLE_3_1
from tests.unit.report.terminal.test_identification_text import RECORD as IDENTIFICATION

FACTS = [
    {"what": "first main impact", "stated": "0.51 s", "ours": "0.5103 s", "agrees": True},
    {"what": "second main impact", "stated": "1.40 s", "ours": "1.3358 s", "agrees": False},
    {"what": "of the experiment alone", "stated": "-", "ours": "", "agrees": None},
]


def sensitivity() -> dict[str, Any]:
    """A study of a block out of its plane."""
    axes = ("main", "transverse", "longitudinal")
    horizons = {
        "duration_s": 6.0,
        "agree_to_0.1_until_s": dict.fromkeys(axes, 1.25),
        "agree_to_0.5_until_s": dict.fromkeys(axes),
    }
    digits = {"name": "K_N", "value": 6e7, "stated": 1, "found": 2, "change": 0.04, "change_stated": 0.3}
    return {
        "families": dict.fromkeys(("time_step", "last_digits", "release_angle"), horizons),
        "significant_digits": [digits],
        "growth": {"factor_per_impact": 10.0, "spread_factor": 1.2, "digits_per_impact": 1.0, "runs": 2},
    }


def twin(seed: int, off: float, at_floor: bool) -> dict[str, Any]:
    """A twin whose parameters are all off by so many last digits; the stiffness is not determined."""
    names = list(TABLE_3_1)
    parameters = {n: {"off": off, "error": 0.25, "determined": n != "K_N"} for n in names}
    return {
        "seed": seed, "chi2": 1.011, "chi2_of_the_truth": 1.022, "at_floor": at_floor, "parameters": parameters,
        "trade_offs": [[names[0], names[1], -0.87]],
    }  # fmt: skip


def twins() -> list[dict[str, Any]]:
    """Three seeds, two of them at the noise floor."""
    return [twin(1, 0.5, True), twin(2, -0.25, True), twin(3, 7.0, False)]


def group(k: int) -> dict[str, Any]:
    """A group of two genes, of which every second one comes out."""
    return {
        "group": f"group {k}", "genes": [f"gene {2 * k}", f"gene {2 * k + 1}"], "correlation": 0.81, "others": 0.12,
        "spread": 0.05, "chance": 0.29, "comes_out": k % 2 == 0,
    }  # fmt: skip


def reduction() -> dict[str, Any]:
    """Six groups of twelve genes over four generations; gene k stands at (k + generation) / 16."""
    return {
        "simulations": 4321, "cost": 0.0456, "genes": [f"gene {k}" for k in range(12)],
        "ways": [[(k + generation) / 16 for k in range(12)] for generation in range(4)],
        "groups": [group(k) for k in range(6)],
    }  # fmt: skip


def scenarios() -> list[dict[str, Any]]:
    """A model that returns to the plane, and one that does not."""
    rows = [("eight points", 12, 0.021, 7.3), ("four points, no defect", 6, 1.5, None)]
    return [
        {"name": name, "genes": genes, "cost": cost, "rms_deg_s": [0.11, 0.22, 0.33], "quasi_2d_from": back}
        for name, genes, cost, back in rows
    ]


def results() -> dict[str, Any]:
    """All six studies."""
    return {
        "response": {"facts": FACTS}, "sensitivity": sensitivity(), "identification": IDENTIFICATION,
        "twins": twins(), "reduction": reduction(), "scenarios": scenarios(),
    }  # fmt: skip
