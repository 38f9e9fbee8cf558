"""The page of `rockref simulate`: the rates, the points that touch, the main impacts of one computed release."""

from __future__ import annotations

from pathlib import Path

from rockref import __version__
from rockref.api import Model
from rockref.model.response import Response
from rockref.report.block_drawing import block_drawing
from rockref.report.curves import curves
from rockref.report.drawing import Line, Panel
from rockref.report.output import made_folder
from rockref.report.page import Page, Table
from rockref.report.response_table import as_measured
from rockref.report.style import AXIS_NAMES

# decided: what a screen shows of a curve; a rate of more rows is thinned evenly.
MOST_ROWS = 4000


def write_response_page(response: Response, model: Model, folder: Path) -> Path:
    """Write ``index.html`` of a simulated release into the folder, and return its path. Raises InputError E-WRITE."""
    impacts = [float(t) for t in response.main_impacts()]
    effects = ", ".join(effect.id for effect in model.active_effects()) or "no effects"
    lead = f"{model.mass:g} kg, {model.points.replace('_', ' ')}, {effects}: {len(impacts)} main impacts."
    page = Page("A simulated release", lead)
    page.add_section("The body rates")
    step = -(-len(response.t) // MOST_ROWS)
    t, crv = response.t[::step], as_measured(response).crv[::step]
    panels = [Panel(f"{AXIS_NAMES[k]}, deg/s", [Line("simulated", t, crv[:, k])]) for k in range(3)]
    panels.append(Panel("points that touch", strips=response.contacts()))
    sentence = "Rates about the block's axes as a gyroscope without noise shows them, and when each point touches."
    if step > 1:
        sentence += f" One row in {step} is drawn."
    page.add_curves(curves(t, panels, title="Body rates", sentence=sentence, marks=impacts))
    rows = [[str(k + 1), f"{at:.4f}"] for k, at in enumerate(impacts)]
    page.add_details("Main impacts", Table("Main impacts", ("number", "time (s)"), rows))
    page.add_section("The block")
    page.add_figure(block_drawing(), "The block's axes and corners, the block turned, its feet. Not to scale.")
    page.add_section("Where the numbers come from")
    page.add_provenance({"rockref": __version__, "model": repr(model), "effects": effects})
    return page.write(made_folder(folder) / "index.html")
