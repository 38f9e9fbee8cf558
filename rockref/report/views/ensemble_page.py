"""The page of `rockref shake`: fragility, maps of what fell, and distributions of maxima of an ensemble."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.report.html.page import Page
from rockref.report.views.ensemble_runs import add_runs
from rockref.report.views.shaken_page import add_distributions, add_fragility, add_spectrum
from rockref.shake.ensemble import Ensemble
from rockref.shake.experiment import MAXIMA
from rockref.shake.plane_block import PlaneBlock, plane_block

#: Distribution functions in one figure, at most; decided: more colours are not told apart.
CURVES = 5


def write_ensemble(rows: list[dict[str, Any]], model: Model, folder: Path, ensemble: Ensemble | None = None) -> Path:
    """Write ``index.html`` of the rows of an ensemble and return its path; with the ensemble, chosen runs are replayed.

    Raises InputError (E-WRITE), and as runs do.
    """
    fell = np.array([row["fell"] for row in rows], float)
    sizes = np.array([[row["pga_m_s2"], row["pgv_m_s"]] for row in rows])
    page = Page("A shaken block", f"{len(rows)} runs, {int(fell.sum())} fell.")
    page.add_section("Fragility", "Runs are taken as independent: the interval is that of the draws, not of motions.")
    if sizes.min() > 0:
        add_fragility(page, sizes, fell)
        add_spectrum(page, sizes, fell, in_a_plane(model))
    page.add_section(
        "Distributions of maxima",
        "Each factor, and each time step where there are several, has its colour and its dash.",
    )
    factors = sorted({(row["factor"], row["step_s"]) for row in rows})
    # Evenly spread over what there is, both ends among them.
    shown = [factors[i] for i in np.unique(np.linspace(0, len(factors) - 1, CURVES).round().astype(int))]
    several = len({step for _, step in factors}) > 1
    names = {key: f"factor {key[0]:g}" + (f", {key[1]:g} s" if several else "") for key in shown}
    samples = {
        quantity: {
            names[key]: np.array(
                [row[f"{quantity}_{unit}"] for row in rows if (row["factor"], row["step_s"]) == key], float
            )
            for key in shown
        }
        for quantity, unit in MAXIMA.items()
    }
    add_distributions(page, samples)
    if ensemble is not None:
        add_runs(page, ensemble, rows)
    page.add_provenance({"runs": len(rows), "records": sorted({row["record"] for row in rows})})
    return page.write_into(folder)


def in_a_plane(model: Model) -> PlaneBlock:
    """Return Housner's block with the size and mass of a model, about the nearer pair of edges of its feet."""
    block, points = model.body()
    reach = [min(points.P[:, axis].max(), -points.P[:, axis].min()) for axis in (0, 1)]
    axis = int(np.argmin(reach))
    inertia = float(block.inertia[1 - axis, 1 - axis])
    return plane_block(
        float(-points.P[:, 2].min()), (reach[axis], reach[axis]), float(np.sqrt(inertia / block.mass)), float(block.g)
    )
