"""A sensitivity study and the record of an identification without the minutes of simulation."""

import numpy as np

from rockref.studies.predictability import Growth
from rockref.studies.sensitivity import Digits, family
from rockref.studies.sensitivity_study import Study

IDENTIFICATION = {
    "search": {
        "simulations": 10000, "cost": 0.1234, "weights": {"main_impacts": 2.0},
        "terms": {"01": {"main_impacts": 0.05}, "06": {"main_impacts": 0.07}},
    },
    "least_squares": {
        "at_noise_floor": True, "chi2": 1.02,
        "values": {"K_N": 6.1e7, "theta_0": 0.1171},
        "errors": {"K_N": 5e6, "theta_0 of 01": 1e-5, "theta_0 of 06": 3e-5},
        "determined": {"K_N": False, "theta_0": True},
        "trade_offs": [["K_N", "beta_ext", -0.91]],
    },
    "runs": [
        {"run": "03", "use": "holdout", "release_tilt_rad": 0.11712, "rms_deg_s": [0.05, 0.06, 0.07],
         "rms_over_noise": 1.01, "rms_over_noise_as_stated": 2.5},
    ],
}  # fmt: skip


def study() -> Study:
    """Responses that part at 2 s, differences that grow ten times from impact to impact."""
    t = np.arange(0, 3, 5e-4)
    base = np.stack([np.abs(np.sin(4 * t)) * np.sign(np.cos(2 * t)), np.cos(60 * t), np.sin(80 * t)], axis=-1)
    f = family(["a", "b"], np.array([base, base * (1 + 0.2 * (t > 2))[:, None]]))
    g = Growth(np.array([0.5, 1.3]), np.array([[1.0, 9.0], [1.0, 11.0]]), 10.0, 1.2)
    return Study(0, f, f, f, (Digits("K_N", 6e7, 1, 2, 0.04, 0.3),), g)
