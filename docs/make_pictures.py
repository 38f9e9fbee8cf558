"""Draw the block, and the picture of `docs/explanation/step.md`: ``python docs/make_pictures.py`` (half a minute)."""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib
import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend is chosen first)

from golden import table_3_1_files as golden  # noqa: E402
from rockref import simulate  # noqa: E402
from rockref.report.charts.block_drawing import block_drawing  # noqa: E402

STEPS = (5e-5, 2.5e-5, 1e-5, 5e-6, 2.5e-6, 1e-6, 5e-7, 2e-7, 1e-7)
ENDS = {"first swing, to 0.48 s": 0.48, "past the first main impact, to 0.6 s": 0.6, "to 1.3355 s": golden.END}


def errors() -> dict[str, list[float]]:
    """Relative RMS of the body rates at each step beside the converged motion, by stretch."""
    converged = golden.read("converged")
    found: dict[str, list[float]] = {name: [] for name in ENDS}
    for step in STEPS:
        off = simulate(golden.problem(step), engine="numba").crv - converged.values[:, :3]
        for name, end in ENDS.items():
            rows = converged.t <= end
            found[name].append(float(np.sqrt(np.sum(off[rows] ** 2) / np.sum(converged.values[rows, :3] ** 2))))
    return found


def step_picture(path: Path) -> None:
    """The errors over the step, with the slopes of first and second order."""
    figure, panel = plt.subplots(figsize=(7, 4), layout="constrained")
    for (name, values), mark in zip(errors().items(), ("o-", "s--", "^:"), strict=True):
        panel.loglog(STEPS, values, mark, label=name, markersize=5)
    steps = np.array([5e-6, 5e-5])
    panel.loglog(steps, 2e-10 * (steps / 5e-6) ** 2, color="0.6")
    panel.text(2.2e-5, 1.2e-9, "slope 2", color="0.4")
    panel.loglog([2e-7, 2e-6], [1e-7, 1e-6], color="0.6")
    panel.text(8e-7, 1.6e-7, "slope 1", color="0.4")
    panel.axvline(1e-5, color="0.8", linewidth=0.8)
    panel.set_xlabel("step [s]")
    panel.set_ylabel("relative RMS of the body rates")
    figure.legend(frameon=False, loc="outside upper center", ncols=3)
    figure.savefig(path, dpi=100)


if __name__ == "__main__":
    (ROOT / "docs/figures/block.svg").write_text(block_drawing(standalone=True) + "\n", encoding="utf-8")
    step_picture(ROOT / "docs/figures/step.png")
