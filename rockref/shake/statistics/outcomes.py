"""Outcomes and samples as arrays, refused where they are none."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.model.errors import InputError


def outcomes(values: Any, name: str = "outcomes") -> np.ndarray:
    """Return 0/1 outcomes as an array (n,) of float. Raises InputError E-SHAPE, E-RANGE."""
    y = finite(values, name)
    if not np.isin(y, (0.0, 1.0)).all():
        raise InputError("E-RANGE", name, f"holds {y[~np.isin(y, (0.0, 1.0))][0]:g}", "Give 1 for fell, 0 for stood.")
    return y


def finite(values: Any, name: str) -> np.ndarray:
    """Return values as an array (n,) of finite floats, n > 0. Raises InputError E-SHAPE, E-RANGE."""
    x = np.asarray(values, float)
    if x.ndim != 1 or not len(x):
        raise InputError("E-SHAPE", name, f"has shape {x.shape}", "Give one number a test, and one test at least.")
    if not np.isfinite(x).all():
        raise InputError("E-RANGE", name, "holds a number that is not finite", "Leave that test out.")
    return x


def motions(values: Any, n: int, name: str = "motion") -> tuple[np.ndarray, int]:
    """Return the motion of each of n tests as a number from 0, and how many motions there are.

    Raises InputError E-SHAPE where there is not one label a test.
    """
    labels = np.asarray(values)
    if labels.shape != (n,):
        raise InputError("E-SHAPE", name, f"has shape {labels.shape}", f"Give one label for each of {n} tests.")
    names, numbers = np.unique(labels, return_inverse=True)
    return numbers, len(names)
