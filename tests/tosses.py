"""Tosses made by the law itself, with known truth, as folders of the public form."""

import gzip
from pathlib import Path

import numpy as np

from rockref.api import Model
from rockref.discover.tosses.body import frames_of, nominal_model
from rockref.discover.tosses.predict import STEPS_A_FRAME, simulated
from rockref.measure.records.toss import Toss, Tosses
from rockref.measure.tosses.flight import Poses, Starts
from rockref.measure.tosses.load import CUBE_MASS, CUBE_WIDTH
from rockref.model.rotation import exponential, quaternion

RATE = 148.0


def stated() -> Model:
    """The cube with stated values."""
    return nominal_model(Tosses(Path("."), "made", RATE, CUBE_MASS, CUBE_WIDTH, CUBE_WIDTH, ()))


def tosses_of(model: Model, count: int, uses=("fit",), frames: int = 50, noise: float = 2e-5) -> Tosses:
    """Tosses of a model, their uses in turn."""
    x, Lambda, _ = made(model, count, frames=frames, seed=2, noise=noise)
    t = np.arange(frames) / RATE
    listed = tuple(Toss(str(i), str(i), uses[i % len(uses)], t, x[i], Lambda[i]) for i in range(count))
    return Tosses(Path("made"), "made", RATE, CUBE_MASS, CUBE_WIDTH, CUBE_WIDTH, listed)


def made(model: Model, count: int, frames: int = 100, seed: int = 0, noise: float = 0.0):
    """Tracked poses x (B, F, 3), Lambda (B, F, 3, 3) and the starts of `count` tosses; noise [m, a tenth of rad]."""
    rng = np.random.default_rng(seed)
    x = np.column_stack([rng.uniform(0.1, 0.3, count), rng.uniform(-0.1, 0.1, count), rng.uniform(0.13, 0.16, count)])
    v = np.column_stack([rng.uniform(-1.2, -0.8, count), np.zeros(count), rng.uniform(-0.3, 0.3, count)])
    turn = rng.normal(size=(count, 3))
    # No turn beyond 3 rad: the exponential takes none above pi.
    turn *= np.minimum(1.0, 3 / np.linalg.norm(turn, axis=1))[:, None]
    Lambda, W = exponential(turn), rng.normal(size=(count, 3)) * 3
    nothing = np.zeros(count)
    starts = Starts(x, v, Lambda, W, np.zeros((count, 12, 12)), np.ones(count, int), nothing, nothing)
    poses = Poses(
        np.arange(frames) / RATE, np.zeros((count, frames, 3)), np.zeros((count, frames, 3, 3)),
        np.full(count, frames), v, W,
    )  # fmt: skip
    x_body, Lambda_body = simulated(model, starts, poses, STEPS_A_FRAME, "auto")
    heading = exponential(np.column_stack([nothing, nothing, rng.uniform(-3, 3, count)]))
    x_t, Lambda_t = frames_of(model, heading).to_tracked(x_body, Lambda_body)
    x_t = x_t + noise * rng.normal(size=x_t.shape)
    Lambda_t = Lambda_t @ exponential(10 * noise * rng.normal(size=x_t.shape))
    return x_t, Lambda_t, starts


def write_tosses(folder: Path, x: np.ndarray, Lambda: np.ndarray, numbers=None) -> Path:
    """A folder with tosses.csv.gz; `numbers` are those of the tosses."""
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["toss,frame,t_s,x_m,y_m,z_m,qw,qx,qy,qz"]
    for i, number in enumerate(numbers if numbers is not None else range(len(x))):
        q = quaternion(Lambda[i])
        for f in range(x.shape[1]):
            values = ",".join(f"{a:.7f}" for a in (*x[i, f], *q[f]))
            lines.append(f"{number},{f},{f / RATE:.6f},{values}")
    (folder / "tosses.csv.gz").write_bytes(gzip.compress(("\n".join(lines) + "\n").encode(), mtime=0))
    return folder
