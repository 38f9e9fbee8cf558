"""Pictures of what `import rockref` gives: a block, its points, a run, an experiment, an ensemble; by Matplotlib."""

from __future__ import annotations

from functools import singledispatch
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.measure.records.release import HOLDOUT, Experiment
from rockref.model.base_motion import BaseMotion
from rockref.model.channel import DEGREES
from rockref.model.errors import InputError
from rockref.model.problem import Block, ContactPoints, Problem, State
from rockref.model.response import Response
from rockref.report.charts import style
from rockref.report.charts.drawing import draw
from rockref.report.charts.figures import dressed, new_figure, titled
from rockref.report.charts.run_panels import response_panels
from rockref.report.charts.shake_figures import fragility_figure, overturning_map
from rockref.shake.ensemble import Ensemble
from rockref.shake.experiment import ShakenExperiment
from rockref.shake.motion_size import motion_size
from rockref.shake.statistics.fragility import fit_fragility

#: Room beside the curves, as a share of their width.
MARGIN = 0.02
#: Curves in one panel, at most; decided: more are a band.
MOST = 12
#: Rows of a curve that a picture of nine inches shows (decided).
ROWS = 4000


@singledispatch
def picture(thing: Any) -> Any:
    """Return a figure of a thing of the house. Raises InputError E-PLOT for what has none."""
    raise InputError("E-PLOT", type(thing).__name__, "has no picture", "Use summary().")


@picture.register
def of_response(response: Response) -> Any:
    """Draw the rates and the contacts of one block; of a batch, the tilt of each."""
    if not len(response.t):
        raise InputError("E-PLOT", "response", "has no rows", "Give a duration and an output rate.")
    if response.problem.batch:
        return _tilts(response)
    panels = response_panels(response, "simulated", style.INK, every=-(-len(response.t) // ROWS))
    ends = [(float(response.t[0]), float(response.t[-1]))]
    title = f"{response.facts()['largest lean']} largest lean; red: main impacts"
    return draw(panels, ends, marks=response.main_impacts(), title=title)


def _tilts(response: Response) -> Any:
    """Draw the tilt of every block of a batch, or of the first `MOST`."""
    figure = new_figure(9.0, 4.0)
    ax = figure.subplots(1, 1)
    tilt = DEGREES * response.tilt.reshape(-1, len(response.t))
    every = -(-len(response.t) // ROWS)
    for k, own in enumerate(tilt[:MOST]):
        ax.plot(response.t[::every], own[::every], lw=0.9, color=style.colour(k), label=f"block {k}")
    dressed(ax, "tilt (deg)", MARGIN)
    ax.set_xlabel("time (s)")
    ax.legend(fontsize=7, frameon=False, ncols=4)
    return titled(figure, f"The tilt of {min(len(tilt), MOST)} of {len(tilt)} blocks")


@picture.register
def of_block(block: Block) -> Any:
    """Draw both side views of the uniform cuboid with the block's mass and inertia."""
    return _side_views(block, None, None)


@picture.register
def of_problem(problem: Problem) -> Any:
    """Draw the first block of a problem at its start, from both sides, with its contact points."""
    first: Any = problem
    while first.batch:
        from rockref.model.response import pick

        first = pick(first, 0)
    return _side_views(first.block, first.points, first.start)


@picture.register
def of_model(model: Model) -> Any:
    """Draw a model as it is released."""
    return of_problem(model.problem())


def _side_views(block: Block, points: ContactPoints | None, start: State | None) -> Any:
    """Draw a cuboid, points and centre of mass in the planes Y-Z and X-Z of the plate."""
    sides = np.asarray(block.sides(), float).reshape(-1, 3)[0]
    if not np.all(np.isfinite(sides)):
        raise InputError("E-PLOT", "block", "has moments of inertia that no cuboid has", "Use summary().")
    x, L = (np.array([0.0, 0.0, sides[2] / 2]), np.eye(3)) if start is None else (start.x, start.Lambda)
    corners = np.array([[a, b, c] for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]) * sides / 2
    edges = [(i, j) for i in range(8) for j in range(i) if np.sum(corners[i] != corners[j]) == 1]
    at = x + corners @ np.asarray(L, float).T
    figure = new_figure(8.0, 5.4)
    for k, (ax, axis) in enumerate(zip(figure.subplots(1, 2, sharey=True), (1, 0), strict=True)):
        for i, j in edges:
            ax.plot(1e3 * at[[i, j], axis], 1e3 * at[[i, j], 2], color=style.INK, lw=1.0)
        ax.axhline(0.0, color=style.GREY, lw=2.0)
        ax.plot(1e3 * x[axis], 1e3 * x[2], "+", color=style.INK, ms=10)
        if points is not None:
            feet = 1e3 * (x + np.asarray(points.P, float) @ np.asarray(L, float).T)
            ax.plot(feet[:, axis], feet[:, 2], "o", ms=4, color=style.COLOURS[0])
        ax.set_aspect("equal", adjustable="datalim")
        ax.set_xlabel(f"{'XY'[axis]} of the plate (mm)")
        dressed(ax, "height (mm)" if k == 0 else "", MARGIN)
    feet_said = "" if points is None else ", red: contact points"
    return titled(figure, f"{block.facts()['mass']}, drawn as a cuboid; +: centre of mass{feet_said}")


@picture.register
def of_points(points: ContactPoints) -> Any:
    """Draw the points from above, with their names; the colour says how high a point lies above the lowest."""
    P = 1e3 * np.asarray(points.P, float).reshape(-1, points.n, 3)[0]
    figure = new_figure(6.4, 5.4)
    ax = figure.subplots(1, 1)
    height = P[:, 2] - P[:, 2].min()
    marks = ax.scatter(P[:, 0], P[:, 1], c=height, cmap="viridis", s=70, edgecolors=style.INK, linewidths=0.6)
    reach = np.hypot(P[:, 0], P[:, 1])
    for name, (x, y, _), far in zip(points.names, P, reach >= reach.mean(), strict=True):
        # Outer points are named outwards, inner ones inwards: they lie side by side.
        right, up = (np.sign(x) > 0) == far, (np.sign(y) > 0) == far
        at = {"xytext": (8 if right else -8, 8 if up else -8), "ha": "left" if right else "right"}
        ax.annotate(name, (x, y), textcoords="offset points", va="bottom" if up else "top", fontsize=8, **at)
    figure.colorbar(marks, ax=ax, label="height above the lowest point (mm)")
    ax.set_aspect("equal", adjustable="datalim")
    ax.margins(0.2)
    ax.set_xlabel("X (mm)")
    dressed(ax, "Y (mm)", MARGIN)
    return titled(figure, "The contact points from above")


@picture.register
def of_experiment(experiment: Experiment) -> Any:
    """Draw the rate about X of every run, or the height of tosses; held-out runs are dashed."""
    figure = new_figure(9.0, 4.6)
    ax = figure.subplots(1, 1)
    runs = [run for run in experiment.runs if run.loaded][:MOST]
    name = "height (m)"
    for k, run in enumerate(runs):
        assert run.t is not None
        y = None if run.pose is None else run.pose[:, 2]
        if run.crv is not None:
            y, name = DEGREES * run.crv[:, 0], f"{style.AXIS_NAMES[0]} (deg/s)"
        dashes = {"dashes": (4, 2)} if run.use == HOLDOUT else {}
        if y is not None:
            ax.plot(run.t, y, lw=0.8, color=style.colour(k), label=f"{run.id}, {run.use}", **dashes)
    dressed(ax, name, MARGIN)
    ax.set_xlabel("time (s)")
    ax.legend(fontsize=7, frameon=False, ncols=4)
    return titled(figure, f"{experiment.name}: {len(runs)} of {len(experiment.runs)} runs; dashed: held out")


@picture.register
def of_ensemble(ensemble: Ensemble) -> Any:
    """Draw the motions of the plate along x and y; of many, the first `MOST`."""
    figure = new_figure(9.0, 5.0)
    axes = figure.subplots(2, 1, sharex=True)
    for k, base in enumerate(ensemble.motions[:MOST]):
        _motion(axes, base, style.colour(k))
    for ax, name in zip(axes, "xy", strict=True):
        dressed(ax, f"a{name} (m/s2)", MARGIN)
    axes[0].legend(fontsize=7, frameon=False, ncols=4)
    axes[1].set_xlabel("time (s)")
    shown = min(len(ensemble.motions), MOST)
    return titled(figure, f"{shown} of {len(ensemble.motions)} motions, before their factors")


def _motion(axes: Any, base: BaseMotion, colour: str) -> None:
    t = base.t_0 + base.dt * np.arange(len(base.a))
    pga, _ = motion_size(base)
    for axis, ax in enumerate(axes):
        label = f"{base.name or 'record'}, {pga:.2f} m/s2"
        ax.plot(t, np.asarray(base.a[:, axis], float), lw=0.7, color=colour, label=label)


@picture.register
def of_shaken(experiment: ShakenExperiment) -> Any:
    """Draw what fell over PGA and PGV/PGA, or over PGA alone where all motions have one ratio."""
    if experiment.fell is None or experiment.sizes is None:
        raise InputError("E-PLOT", experiment.name, "has no column fell, or no sizes of its motions", "Use summary().")
    pga, pgv = experiment.sizes.T
    if np.ptp(pgv / pga) > 1e-9:
        return overturning_map(pga, pgv / pga, experiment.fell, axes=("PGA (m/s2)", "PGV / PGA (s)"))
    return fragility_figure(pga, experiment.fell, fit_fragility(pga, experiment.fell), "PGA (m/s2)")
