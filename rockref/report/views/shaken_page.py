"""Outcomes on a shake table on a page: fragility, overturning map, reliability, distribution functions."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from rockref.model.problem import GRAVITY
from rockref.report.charts import shake_figures
from rockref.report.charts.figures import rendered
from rockref.report.html.page import Page
from rockref.report.tables.spoken import SPOKEN
from rockref.report.terminal import shaken_text
from rockref.shake.comparison import ShakenComparison
from rockref.shake.experiment import MAXIMA
from rockref.shake.motion_size import pulse_frequency
from rockref.shake.plane_block import PlaneBlock
from rockref.shake.statistics.binary_regression import fit_binary
from rockref.shake.statistics.fragility import fit_fragility

#: Dots an inch; decided: seven inches are as wide as the page is read.
DPI = 110


def write_shaken(c: ShakenComparison, folder: Path) -> Path:
    """Write ``index.html`` for a comparison and return its path. Raises InputError (E-WRITE)."""
    record, e = c.to_dict(), c.experiment
    page = Page(f"Shaken: {e.name}", " ".join(shaken_text.answers(record)))
    if c.probabilities:
        assert e.fell is not None
        page.add_section("Predictions of falls", [line] if (line := shaken_text.ceiling_line(record)) else [])
        page.add_table(shaken_text.scores_table(record))
        figure = shake_figures.reliability_figure({name: (p, e.fell) for name, p in c.probabilities.items()})
        said = "Share that fell over the predicted probability, with Wilson intervals; on the line is as predicted."
        page.add_figure(rendered(figure, "png", DPI), said)
    if e.fell is not None and e.sizes is not None:
        page.add_section("Fragility of the tests")
        add_fragility(page, e.sizes, e.fell)
    if c.maxima:
        page.add_section("Distributions of maxima")
        add_distributions(page, {q: {n: s.values for n, s in part.items()} for q, part in c.maxima.items()})
        if record["maxima"]:
            page.add_table(shaken_text.distances_table(record))
    page.add_provenance({"experiment": e.name, "sha256": e.digest, **c.how})
    return page.write_into(folder)


def add_fragility(page: Page, sizes: np.ndarray, fell: np.ndarray) -> None:
    """Add the fragility over PGA and the overturning map; sizes (n, 2) PGA [m/s2] and PGV [m/s], fell (n,) 0 or 1.

    What has no spread, or outcomes of one kind, is left out with a sentence.
    """
    pga, ratio = sizes[:, 0] / GRAVITY, sizes[:, 1] / sizes[:, 0]
    if np.ptp(np.log(pga)) < 1e-9:
        page.add_text("All motions have one PGA: there is no curve over it.")
        return
    figure = shake_figures.fragility_figure(pga, fell, fit_fragility(pga, fell, "logit"), "PGA (g)")
    page.add_figure(
        rendered(figure, "png", DPI),
        "Probability of falling over PGA: logit with Jeffreys' prior and its interval, the monotone curve that assumes "
        "no form, and shares of groups of tests with Wilson intervals.",
    )
    if np.ptp(np.log(ratio)) < 1e-9:
        page.add_text("All motions have one PGV/PGA: there is no map over both.")
        return
    page.add_figure(
        rendered(shake_figures.overturning_map(pga, ratio, fell, _regression(pga, ratio, fell)), "png", DPI),
        "Outcomes over PGA and PGV/PGA; lines of equal probability from a logit with Jeffreys' prior.",
    )


def add_spectrum(page: Page, sizes: np.ndarray, fell: np.ndarray, block: PlaneBlock) -> None:
    """Add the map of `add_fragility` in the numbers of a block: A = PGA/(g tan alpha), and w_p/p of the pulse."""
    angle, p = min(block.alpha), max(block.p)
    size, frequency = sizes[:, 0] / (GRAVITY * math.tan(angle)), pulse_frequency(*sizes.T) / p
    if np.ptp(np.log(size)) < 1e-9 or np.ptp(np.log(frequency)) < 1e-9:
        return
    axes = "w_p / p of the one-sine pulse with this PGA and PGV", "PGA / (g tan alpha)"
    figure = shake_figures.overturning_map(frequency, size, fell, _regression(frequency, size, fell), axes)
    page.add_figure(
        rendered(figure, "png", DPI),
        f"The same as an overturning spectrum: alpha = {math.degrees(angle):.2f} degrees and p = {p:.3f} rad/s are "
        "those of the block about its nearer edge. Below 1 no block in a plane lifts.",
    )


def _regression(x: np.ndarray, y: np.ndarray, fell: np.ndarray) -> Any:
    """Return the probability as a function of two sizes, by a logit of their logarithms."""
    design = lambda a, b: np.column_stack([np.ones(len(a)), np.log(a), np.log(b)])  # noqa: E731
    fitted = fit_binary(design(x, y), fell)
    return lambda a, b: fitted.probability(design(a, b))


def add_distributions(page: Page, samples: dict[str, dict[str, np.ndarray]]) -> None:
    """Add a figure of distribution functions with their bands of each quantity."""
    for quantity, parts in samples.items():
        unit, scale = SPOKEN[MAXIMA[quantity]]
        drawn = {name: scale * values for name, values in parts.items()}
        figure = shake_figures.distribution_figure(drawn, f"largest {quantity} ({unit})")
        said = f"Distribution functions of the largest {quantity}; bands that hold a whole function with 95 %."
        page.add_figure(rendered(figure, "png", DPI), said)
