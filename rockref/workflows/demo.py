"""The demonstration: the block rocks, measured runs beside it, where the model fails and why; chapter by chapter.

A chapter takes the story told so far and adds to it: lines for the terminal, sections for the page. The page shows the
measured and the modelled block first, then where they part, the effect that is missing, and the error falling.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from rockref.api import Model, simulate
from rockref.discover.compare.finding import Finding
from rockref.discover.compare.models import Comparison
from rockref.discover.compare.sentences import findings
from rockref.discover.diagnosis_record import plain
from rockref.discover.progress import StageReport
from rockref.measure import envelope_shape, envelopes, main_impacts
from rockref.measure.records.release import Experiment
from rockref.measure.signals.activity import leakage, onset
from rockref.measure.signals.noise import noise_floor
from rockref.model.channel import DEGREES
from rockref.model.errors import InputError
from rockref.model.housner import housner
from rockref.model.response import Response
from rockref.report.charts import style
from rockref.report.charts.run_panels import housner_line, response_panels, write_figures
from rockref.report.html import blocks
from rockref.report.html.curves import curves
from rockref.report.html.page import Page
from rockref.report.terminal.addition_text import lines as addition_lines
from rockref.report.terminal.diagnosis_text import amplitudes_table, ranking_table
from rockref.report.terminal.fit_text import said
from rockref.report.views.addition_page import add_errors
from rockref.report.views.card import card_of_diagnosis
from rockref.report.views.diagnosis_page import verdict_words
from rockref.workflows.story import STEPS, Journey, run_story

# decided: its effect is physical, and its energy shows it.
EXPERIMENTS = ("mystery-05",)
#: Long enough for three arcs of the model alone [s].
DURATION = 2.2


@dataclass
class Story:
    """What has been told: ``lines`` for the terminal, ``page``, ``written`` files; ``journey`` is what it tells of."""

    journey: Journey
    out: Path
    engine: str
    page: Page
    lines: list[str] = field(default_factory=list)
    written: list[Path] = field(default_factory=list)

    @property
    def comparison(self) -> Comparison:
        """Return the baseline, and the model with the effect, beside the measured runs."""
        return self.journey.comparison


def the_block(story: Story) -> None:
    """Add section 1: the measured block and the models in motion, then the model of Table 3.1 alone."""
    page, c = story.page, story.comparison
    model = Model.table_3_1()
    response = simulate(model, duration=DURATION, output_rate=2000.0, engine=story.engine)
    words = features_in_words(response)
    story.lines += words[:1]
    page.add_section("The block rocks")
    blocks.add_motion(page, c)
    page.add_text(
        "A block of 54 kg on eight contact points, tilted by 0.117 rad and released. It rocks about its main axis, and "
        "because its feet are not all equally high it also clatters about the other two."
    )
    page.add_sentences(words)
    page.add_curves(model_curves(model, response))


def features_in_words(response: Response) -> list[str]:
    """Return what the response of the model looks like, measured by the functions that read experiments."""
    t, crv = response.t, response.W
    impacts = main_impacts(t, crv)
    first, second = (float(v) for v in response.main_impacts()[:2])
    leak = leakage(t, crv, impacts)
    begin = onset(t, crv, impacts, leak, noise_floor(t, crv))
    envelope = envelopes(t, crv, first, second)
    transverse, longitudinal = (envelope_shape(u, v) for u, v in zip(envelope.upper, envelope.lower, strict=True))
    largest = DEGREES * np.abs(crv).max(axis=0)
    return [
        f"Table 3.1 alone: main impacts at {first:.4f} and {second:.4f} s, rates up to {largest[0]:.0f} deg/s about "
        f"the main axis, {largest[1]:.1f} transverse and {largest[2]:.1f} longitudinal.",
        f"Its transverse motion begins {1e3 * (first - begin):.0f} ms before the first main impact; up to the second "
        f"its envelope is quasi-constant (to {100 * transverse.variation:.0f} %), the longitudinal one small at both "
        f"ends ({100 * longitudinal.start:.0f} and {100 * longitudinal.end:.0f} % of its largest).",
    ]


def model_curves(model: Model, response: Response):
    """Return the curves of the model alone, Housner about the main axis, contacts as lines."""
    inertia = model.mass * (model.depth**2 + model.height**2) / 12.0
    tilt = model.parameters.theta_0
    planar = housner(model.mass, model.depth, model.height, inertia, model.g, tilt, DURATION, 200.0, 1e-3)
    return curves(
        response.t,
        response_panels(response, "Table 3.1", style.colour(0), housner_line(planar)),
        title="The model alone",
        sentence="Body rates of the model, Housner's planar block dashed; a line for each point while it touches.",
        marks=[float(v) for v in response.main_impacts()],
        views=blocks.named_views(main_impacts(response.t, response.W), DURATION),
    )


def the_misfit(story: Story) -> None:
    """Add section 2: where the baseline leaves the measured runs."""
    page, c = story.page, story.comparison
    page.add_section("Where the model fails")
    found = tuple(f for f in findings(c) if f.model in (None, c.names[0]))
    story.lines += telling(c.experiment, found)
    page.add_sentences([f.text for f in found if f.model == c.names[0]])
    page.add_curves(blocks.run_curves(c, 0))
    story.written += write_figures(c, story.out)


def telling(experiment: Experiment, found: tuple[Finding, ...]) -> list[str]:
    """Return the two lines about one experiment that matter most: where the model leaves it, and a sign of why."""
    by_kind = {f.kind: f.text for f in found}
    order = ("leak", "energy", "to_second_impact", "before_impact", "envelope", "first_impact", "error_size")
    chosen = [by_kind[kind] for kind in order if kind in by_kind][:1]
    return [f"{experiment.name}: {text}" for text in (by_kind["leaves_band"], *chosen)]


def the_missing_effect(story: Story) -> None:
    """Add section 3: the verdict, and what it rests on."""
    d = story.journey.diagnosis
    record = plain(d.to_dict())
    story.lines.append(f"{d.experiment.name}: {d.sentence}")
    page = story.page
    page.add_section("The missing effect", verdict_words(record))
    if story.comparison is not None:
        page.add_card(card_of_diagnosis(record, story.comparison))
    if record["amplitudes"]:
        page.add_table(amplitudes_table(record))
    if record["ranking"]:
        page.add_details("Alternatives", ranking_table(record))


def the_error(story: Story) -> None:
    """Add section 4: the error before and after, on fit and held-out runs."""
    a = story.journey.addition
    if a is None:
        return
    sizes = [f"{name.partition('.')[2]} {said(name, n)}" for name, n in a.own_numbers.items()]
    story.lines += [f"Size of {a.effect}: {', '.join(sizes)}.", *addition_lines(a)]
    add_errors(story.page, a, "The error falls")


def the_held_out_run(story: Story) -> None:
    """Add section 5: a run that no fit has seen, before and after; and where the numbers come from."""
    page, c = story.page, story.comparison
    held = c.of("holdout")
    page.add_section("A run that no fit has seen")
    page.add_curves(blocks.run_curves(c, held[0] if held else 0))
    page.add_provenance(blocks.provenance(c))


#: What the demonstration tells, in order.
SECTIONS: tuple[Callable[[Story], None], ...] = (
    the_block, the_misfit, the_missing_effect, the_error, the_held_out_run,
)  # fmt: skip


def find_experiments(given: Path | None) -> Path:
    """Return the folder of the shipped experiments: the given one, ``data/experiments`` here, or in the checkout.

    Raises InputError E-DEMO where it is not there: the wheel does not carry it.
    """
    import rockref

    places = (
        [given]
        if given is not None
        else [Path("data/experiments"), Path(rockref.__file__).parents[1] / "data/experiments"]
    )
    for place in places:
        if all((place / name / "experiment.toml").is_file() for name in EXPERIMENTS):
            return place
    what = f"{', '.join(EXPERIMENTS)} is missing"
    cure = "Experiments belong to the source repository, not to the package: run the demo in a clone, or give --data."
    raise InputError("E-DEMO", str(places[0]), what, cure)


def tell(
    folder: Path, out: Path, engine: str = "auto", report: Callable[[StageReport], None] = lambda report: None
) -> Story:
    """Compute the journey of one experiment, write page and figures into `out`. Raises InputError, NumericalError.

    report : called with every stage
    """
    journey = run_story(folder / EXPERIMENTS[0], report, engine=engine)
    page = Page("rockref: the demonstration", journey.diagnosis.sentence)
    story = Story(journey, out, engine, page)
    report(StageReport(STEPS, STEPS, "writing the page"))
    for section in SECTIONS:
        section(story)
    story.written.insert(0, page.write(out / "index.html"))
    return story
