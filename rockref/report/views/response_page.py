"""The page of `rockref simulate`: the rates, the points that touch, the main impacts of one computed release."""

from __future__ import annotations

from pathlib import Path

from rockref import __version__
from rockref.api import Model
from rockref.model.response import Response
from rockref.report.charts import style
from rockref.report.charts.block_drawing import block_drawing
from rockref.report.charts.run_panels import response_panels
from rockref.report.html.curves import curves
from rockref.report.html.page import Page
from rockref.report.tables.response_table import as_measured
from rockref.report.tables.table import Table

# decided: what a screen shows of a curve; a rate of more rows is thinned evenly.
MOST_ROWS = 4000
# decided: what a sentence holds.
IMPACTS = 3


def write_response_page(response: Response, model: Model, folder: Path) -> Path:
    """Write ``index.html`` of a simulated release into the folder, and return its path. Raises InputError E-WRITE."""
    impacts = [float(t) for t in response.main_impacts()]
    effects = ", ".join(effect.id for effect in model.active_effects()) or "no effects"
    page = Page("A simulated release", lead(response, model, effects))
    page.add_section("The body rates")
    step = -(-len(response.t) // MOST_ROWS)
    panels = response_panels(as_measured(response), "simulated", style.INK, every=step)
    sentence = (
        "Rates about the block's axes (X main, Y transverse, Z longitudinal) as a gyroscope without noise shows them, "
        "and when each point touches. Red lines: main impacts."
    )
    if step > 1:
        sentence += f" One row in {step} is drawn."
    page.add_curves(curves(response.t[::step], panels, title="Body rates", sentence=sentence, marks=impacts))
    rows = [[str(k + 1), f"{at:.4f}"] for k, at in enumerate(impacts)]
    page.add_details("Main impacts", Table("Main impacts", ("number", "time (s)"), rows))
    page.add_section("The block")
    page.add_figure(block_drawing(), "The block's axes and corners, the block turned, its feet. Not to scale.")
    page.add_section("Where the numbers come from")
    page.add_provenance({"rockref": __version__, "model": repr(model), "effects": effects})
    return page.write_into(folder)


def lead(response: Response, model: Model, effects: str) -> str:
    """Return the block, when it strikes the plate, and how fast it turns, in a sentence."""
    impacts = [f"{t:.3f}" for t in response.main_impacts()[:IMPACTS]]
    more = " and later" if len(response.main_impacts()) > IMPACTS else ""
    many = "s" if len(impacts) > 1 else ""
    struck = f"main impact{many} at {', '.join(impacts)} s{more}" if impacts else "no main impact"
    fell = " The block overturns." if response.overturned else ""
    largest = float(abs(as_measured(response).crv).max())
    body = f"{model.mass:g} kg, {model.points.replace('_', ' ')}, {effects}"
    return f"{body}: {struck}; the largest rate is {largest:.0f} deg/s.{fell}"
