"""What the runs of a batch listen to, as plain arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Listening:
    """What the runs of a batch listen to, at ticks 0 .. K-1. The start is tick 0; no run corrects there.

    rates : (M, K, 3) observed rates [rad/s], body axes
    turns : (M, K, 3, 3) observed rotation since the start: the observed attitude is Lambda(start) @ turns
    heard : (M, K, 4) factors from 0 to 1 on the gains of the three rates and of the attitude, or None for 1; 0 where
        the record is clipped or lost, and any finite number stands in `rates` and `turns`
    which : (B,) which of the M targets a run listens to
    gain_rate, gain_attitude : (B,) 1 - exp(-tick / tau), with the time constants of rates and attitude
    every : steps from tick to tick
    """

    rates: np.ndarray
    turns: np.ndarray
    heard: np.ndarray | None
    which: np.ndarray
    gain_rate: np.ndarray
    gain_attitude: np.ndarray
    every: int
