"""Tosses of a rigid block as plain data: poses, frame by frame."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from rockref.measure.records.notice import Notice


@dataclass(frozen=True, eq=False)
class Toss:
    """One toss: `id`; `group` (the toss of which it is a copy, or itself); `use`, ``fit`` or ``holdout``.

    t : (N,) time from the first frame [s];  x : (N, 3) tracked point [m], z up;  Lambda : (N, 3, 3) body to board.
    v, W : (N, 3) stated velocity [m/s] and body rates [rad/s], or None.
    """

    id: str
    group: str
    use: str
    t: np.ndarray = field(repr=False)
    x: np.ndarray = field(repr=False)
    Lambda: np.ndarray = field(repr=False)
    v: np.ndarray | None = field(default=None, repr=False)
    W: np.ndarray | None = field(default=None, repr=False)

    @property
    def frames(self) -> int:
        """Return number of frames."""
        return len(self.t)


@dataclass(frozen=True, eq=False)
class Tosses:
    """All tosses of a folder: `path`, `name`, `rate` [Hz], stated `mass` [kg], `width`, `height` [m], `tosses` without
    copies, `copies` (id of the copy, id of its original), `notices`, `sha256` of the table."""

    path: Path
    name: str
    rate: float
    mass: float
    width: float
    height: float
    tosses: tuple[Toss, ...]
    copies: tuple[tuple[str, str], ...] = ()
    notices: tuple[Notice, ...] = field(default=(), repr=False)
    sha256: str = ""

    def used(self, use: str) -> tuple[Toss, ...]:
        """Return the tosses marked ``fit`` or ``holdout``."""
        return tuple(toss for toss in self.tosses if toss.use == use)
