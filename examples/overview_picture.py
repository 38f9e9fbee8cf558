"""The picture of the README: a measured run and the model of Table 3.1, until just after the second main impact.

Run it from a checkout: `.venv/bin/python examples/overview_picture.py docs/figures/overview.png`
"""

import sys

import matplotlib
import numpy as np

import rockref
from rockref.measure import load_experiment, record

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend is chosen first)


def main(path: str = "overview.png") -> None:
    experiment = load_experiment("data/experiments/mystery-08")
    run = experiment.run("01")
    response = rockref.simulate(rockref.Model.table_3_1(), duration=1.5, engine="auto", theta_0=run.release_tilt)
    t, W = record(response.t, response.W, experiment.gyro)
    figure, panels = plt.subplots(3, 1, figsize=(9, 6), sharex=True, layout="constrained")
    shown = run.t <= 1.5
    for i, (panel, name) in enumerate(zip(panels, ("main", "transverse", "longitudinal"), strict=True)):
        panel.plot(
            run.t[shown], np.degrees(run.crv[shown, i]), color="0.6", linewidth=2.5, label="measured (practice run)"
        )
        panel.plot(t, np.degrees(W[:, i]), color="tab:blue", linewidth=1, label="Table 3.1, as published")
        for impact in response.main_impacts():
            panel.axvline(impact, color="tab:red", linewidth=0.8, linestyle=":")
        panel.set_ylabel(f"{name} crv [deg/s]")
    panels[0].legend(loc="upper right", frameon=False)
    panels[-1].set_xlabel("time since release [s]")
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
