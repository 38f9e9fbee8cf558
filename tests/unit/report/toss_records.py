"""Records of tosses as the commands make them, with made-up numbers that are told apart in a text."""

from __future__ import annotations

from typing import Any


def spread(mean: float) -> dict[str, float]:
    """A mean with what stands beside it."""
    shares = {"mean": 1.0, "sd": 0.5, "median": 0.8, "lower_quartile": 0.6, "upper_quartile": 1.4}
    return {name: share * mean for name, share in shares.items()}


def summary(position: float, rotation: float) -> dict[str, Any]:
    """Errors of 20 tosses."""
    return {"position_percent": spread(position), "rotation_deg": spread(rotation), "tosses": 20}


def value(v: float, se: float, unit: str = "1") -> dict[str, Any]:
    return {"value": v, "se": se, "unit": unit}


def measured() -> dict[str, Any]:
    """What tosses say without a contact model."""
    part = {
        "impulse_balance": {"scatter": 0.0018},
        "inertia_kg_m2": {"xx": 1.07e-3, "yy": 1.06e-3, "zz": 1.04e-3},
        "corner": {"values": {"friction": value(0.159, 0.005)}},
        "energy_change": {"gains": 3, "tosses": 51},
    }
    return {
        "flight_arcs": {"values": {"g_x": value(0.11, 0.02, "m/s2"), "drag": value(0.05, 0.02, "1/s"),
                                   "centre_z": value(5.7e-3, 2e-4, "m")}},
        "stated_centre": part,
        "measured_centre": part,
        "energy_of_stated_velocities": {
            "tosses": 222, "from_frame_to_frame": 22, "largest": 0.066, "largest_in_flight": 0.02, "around": 4,
            "least_loss_around": 0.15,
        },
        "sliding": {"values": {"0.1 to 0.2 m/s": value(0.21, 0.001)}},
    }  # fmt: skip


def stretch(name: str, grows: float) -> dict[str, Any]:
    """One part of a toss."""
    return {
        "stretch": name, "tosses": 20, "frames_percent": 25.0, "position_percent": 5.5, "rotation_deg": 6.5,
        "growth": {"position_percent": grows, "rotation_deg": -grows},
        "energy_lost": {"measured_percent": 54.1, "model_percent": 55.6, "gains": 2},
    }  # fmt: skip


def row(model: str, use: str, start: str, position: float) -> dict[str, Any]:
    """One model on the tosses of a use."""
    slides = {"measured": {"0.1 to 0.2 m/s": value(0.21, 0.001)}, "model": {"0.3 to 0.4 m/s": value(0.14, 0.002)}}
    return {"model": model, "use": use, "start": start, "sliding": slides,
            "stretches": [stretch("flight", 0.1), stretch("first impact", 6.4)]} | summary(position, 9.1)  # fmt: skip


def comparison() -> dict[str, Any]:
    """Two models on fit and held-out tosses."""
    rows = [
        row(model, use, start, position)
        for use in ("fit", "holdout")
        for model, position in (("plain", 12.3), ("explained", 6.1))
        for start in ("flight", "raw")
    ]
    return {"experiment": "made", "copies": [[4, 2]], "sha256": "0123abcd", "rows": rows, "measured": measured()}


def rung(added: str, verdict: str, position: float, rotation: float) -> dict[str, Any]:
    """A step of the staircase."""
    return {
        "added": added, "verdict": verdict, "proof": {"mean": 3.85, "low": 2.05, "high": 5.76, "interval": 0.9},
        "holdout": {"flight": summary(position, rotation), "raw": summary(position + 2, rotation + 2)},
        "parameters": {"K_N": {"value": 90123.4, "unit": "N/m"}},
    }  # fmt: skip


def gate(name: str, passed: bool) -> dict[str, Any]:
    return {"name": name, "passed": passed, "value": 0.013, "limit": 0.02}


def diagnosis(verdict: str = "named") -> dict[str, Any]:
    """A diagnosis with two effects."""
    ids = ("mass_eccentricity", "rounded_corners")
    return {
        "experiment": "made", "kind": "toss", "verdict": verdict, "effects": list(ids), "not_needed": ["adhesion"],
        "sentence": "Missing: mass_eccentricity and then rounded_corners.",
        "nominal_holdout": {"flight": summary(12.6, 14.9), "raw": summary(14.2, 15.5)},
        "staircase": [rung("the law, its contact fitted", "", 11.2, 13.5), rung(ids[0], "named", 9.0, 10.7),
                      rung(ids[1], "indicated", 8.2, 7.7)],
        "floor": {"position_percent": 2.1, "rotation_deg": 1.8, "position_percent_median": 1.6,
                  "rotation_deg_median": 0.8},
        "measured_without_contact_model": measured(),
        "agreement": [
            {"quantity": "centre of mass, z", "unit": "m", "with_contact_model": 5.71e-3, "without": 5.68e-3,
             "standard_error": 2e-4, "how": "flight arcs"},
            {"quantity": "friction", "unit": "1", "with_contact_model": 0.164, "without": 0.159,
             "standard_error": 0.005, "how": "impulse ratio"},
        ],
        "confusion": {a: {b: 1.0 if a == b else 0.953 for b in ids} for a in ids},
        "gates": [gate("step_small", True), gate("off_bounds", verdict != "not_trustworthy")],
        "seconds": 612.4, "sha256": "0123abcd",
    }  # fmt: skip


def fit(passed: bool = True) -> dict[str, Any]:
    """A fit of the law with one effect."""
    return {
        "kind": "toss", "effects": ["mass_eccentricity"], "objective": 2.5,
        "parameters": {"K_N": {"value": 90123.4, "unit": "N/m"}}, "gates": [gate("step_small", passed)],
        "errors": [{"use": "fit", "start": "flight"} | summary(7.7, 8.8)],
    }  # fmt: skip


def addition(held_out: bool = True) -> dict[str, Any]:
    """An effect that was added; without held-out tosses there is no proof."""
    made = fit()
    use = "holdout" if held_out else "fit"
    return {
        "kind": "toss", "effect": "mass_eccentricity", "effects": made["effects"], "parameters": made["parameters"],
        "gates": made["gates"],
        "errors": [{"use": use, "start": "flight", "before": summary(11.2, 13.5), "after": summary(9.0, 10.7)}],
        "holdout_falls_by": {"mean": 4.96, "low": 2.71, "high": 7.53, "interval": 0.9} if held_out else {},
    }  # fmt: skip
