"""The demonstration: the block rocks, measured runs beside it, where the model fails and why; chapter by chapter.

A chapter takes the story told so far and adds to it: lines for the terminal, sections for the page. The last one tells
what one experiment lacks: diagnosed, the effect added, the error before and after.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from rockref.api import Model, simulate
from rockref.discover.compare.finding import Finding
from rockref.discover.compare.models import Comparison, baseline_model, compare
from rockref.discover.compare.sentences import findings
from rockref.discover.compare.stretches import AXES
from rockref.discover.story import Journey, run_story
from rockref.measure import envelope_shape, envelopes, load_experiment, main_impacts
from rockref.measure.activity import leakage, onset
from rockref.measure.experiment import Experiment
from rockref.measure.noise import noise_floor
from rockref.model.channel import DEGREES
from rockref.model.errors import InputError
from rockref.model.housner import housner
from rockref.model.response import Response
from rockref.report import blocks, style
from rockref.report.comparison_page import add_comparison
from rockref.report.curves import curves
from rockref.report.drawing import Line, Panel
from rockref.report.figures import write_figures
from rockref.report.page import Page
from rockref.report.story_page import add_story

# decided: one whose gyroscope shows the difference before the first impact, one whose energy shows it.
EXPERIMENTS = ("mystery-04", "mystery-05")
#: Long enough for three arcs of the model alone [s].
DURATION = 2.2
# decided: the page holds two experiments; each may use this much for its curves.
ROOM = 420_000


@dataclass
class Story:
    """What has been told: ``lines`` for the terminal, ``page``; and what later chapters need: ``folder`` of the
    experiments, ``out``, ``engine``, ``comparisons`` by name, ``written`` files, ``report`` (called with a line at
    every stage) and ``detail`` (called with what goes on within a stage)."""

    folder: Path
    out: Path
    engine: str
    page: Page
    report: Callable[[str], None]
    detail: Callable[[str], None]
    lines: list[str] = field(default_factory=list)
    comparisons: dict[str, Comparison] = field(default_factory=dict)
    written: list[Path] = field(default_factory=list)


def the_model(story: Story) -> None:
    """Chapter 1: Table 3.1 alone, and the features that its authors saw in the measured response."""
    story.report("the eight-point block of Table 3.1")
    model = Model.table_3_1()
    response = simulate(model, duration=DURATION, output_rate=2000.0, engine=story.engine)
    words = features_in_words(response)
    story.lines += words[:1]
    page = story.page
    page.add_section("The block rocks")
    page.add_text(
        "The released block of Table 3.1: 54 kg on eight contact points, tilted by 0.117 rad. It rocks about its main "
        "axis, and because its feet are not all equally high it also clatters about the other two."
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
    t, rates = response.t, response.crv
    inertia = model.mass * (model.depth**2 + model.height**2) / 12.0
    tilt = model.parameters.theta_0
    planar = housner(model.mass, model.depth, model.height, inertia, model.g, tilt, DURATION, 200.0, 1e-3)
    panels = [
        Panel(f"{a} (deg/s)", [Line("Table 3.1", t, rates[:, k], style.colour(0))], height=125.0)
        for k, a in enumerate(AXES)
    ]
    main = [*panels[0].lines, Line("Housner", planar.t, DEGREES * planar.rate, style.GREY, style.HOUSNER_DASH)]
    panels[0] = Panel(panels[0].label, main, height=150.0)
    panels.append(Panel("contacts", strips=response.contacts(), height=110.0, colour=style.colour(0)))
    return curves(
        t,
        panels,
        title="The model alone",
        sentence="Body rates of the model, Housner's planar block dashed; a line for each point while it touches.",
        marks=[float(v) for v in response.main_impacts()],
        views=blocks.named_views(main_impacts(t, response.W), DURATION),
    )


def the_runs(story: Story) -> None:
    """Chapter 2: the shipped experiments beside the model, and where it fails."""
    for name in EXPERIMENTS:
        story.report(f"{name}: six measured runs beside the model")
        experiment = load_experiment(story.folder / name)
        comparison = compare(experiment, [baseline_model(experiment)], ["table_3_1"], engine=story.engine)
        story.comparisons[name] = comparison
        story.lines += telling(experiment, findings(comparison))
        add_comparison(story.page, comparison, prefix=name, room=ROOM)
        story.written += write_figures(comparison, story.out)


def telling(experiment: Experiment, found: tuple[Finding, ...]) -> list[str]:
    """Return the two lines about one experiment that matter most: where the model leaves it, and a sign of why."""
    by_kind = {f.kind: f.text for f in found}
    order = ("leak", "energy", "to_second_impact", "before_impact", "envelope", "first_impact", "error_size")
    chosen = [by_kind[kind] for kind in order if kind in by_kind][:1]
    return [f"{experiment.name}: {text}" for text in (by_kind["leaves_band"], *chosen)]


def the_missing_effect(story: Story) -> None:
    """Chapter 3: one of the experiments diagnosed, what is missing added, and the error before and after."""

    def say(line: str) -> None:
        (story.report if line.startswith(STAGES) else story.detail)(line)

    journey = run_story(story.folder / EXPERIMENTS[0], say, engine=story.engine)
    story.lines += in_three_lines(journey)
    add_story(story.page, journey, room=ROOM)


def in_three_lines(journey: Journey) -> list[str]:
    """Return the verdict, the sizes of the effect, and the error before and after; the verdict alone without one."""
    d, a = journey.diagnosis, journey.addition
    lines = [f"{d.experiment.name}: {d.sentence}"]
    if a is None:
        return lines
    own = [e for e in a.estimates if e.of_effect and e.of_run is None and e.name.startswith(f"{a.effect}.")]
    sizes = ", ".join(
        f"{e.name.partition('.')[2]} {e.value:.3g}{'' if e.unit == '1' else ' ' + e.unit} ({e.low:.3g} to {e.high:.3g})"
        for e in own
    )
    lines.append(f"Its size, with 90 % intervals: {sizes}.")
    falls = [
        f"on the {words} from {before.total:.3f} to {after.total:.3f}"
        for use, words in (("fit", "fit runs"), ("holdout", "held-out runs"))
        if (before := getattr(a.before, use)) is not None and (after := getattr(a.after, use)) is not None
    ]
    lines.append(f"With it the error falls {' and '.join(falls)} deg/s RMS; the noise floor is {a.noise:.3f}.")
    return lines


#: How the lines begin with which the story says that another stage has begun.
STAGES = ("diagnosing", "adding ", "comparing before and after")


#: What the demonstration tells, in order.
CHAPTERS: tuple[Callable[[Story], None], ...] = (the_model, the_runs, the_missing_effect)


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
    what = f"the experiments {' and '.join(EXPERIMENTS)} are not there"
    cure = (
        "They belong to the source repository, not to the installed package: run the demo in a clone, or give --data."
    )
    raise InputError("E-DEMO", str(places[0]), what, cure)


def silent(text: str) -> None:
    """Say nothing."""


def tell(
    folder: Path,
    out: Path,
    engine: str = "auto",
    report: Callable[[str], None] = silent,
    detail: Callable[[str], None] = silent,
) -> Story:
    """Tell the story: compute every chapter, write page and figures into `out`. Raises InputError, NumericalError."""
    page = Page(
        "rockref: the demonstration",
        "The block rocks, measured runs beside it, where the model fails, and what it lacks.",
    )
    story = Story(folder, out, engine, page, report, detail)
    summary = page.add_section("In short")
    for chapter in CHAPTERS:
        chapter(story)
    summary.blocks.append(("sentences", {"title": "", "sentences": list(story.lines)}))
    page.add_section("Where the numbers come from")
    for comparison in story.comparisons.values():
        page.add_provenance(blocks.provenance(comparison))
    story.written.insert(0, page.write(out / "index.html"))
    return story
