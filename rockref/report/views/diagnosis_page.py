"""The page of `rockref diagnose`: measured, fails, tried, explained, what would make sure, the error falling."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.compare.models import Comparison, compare
from rockref.discover.compare.sentences import findings
from rockref.discover.compare.stretches import AXES
from rockref.discover.diagnose import Diagnosis
from rockref.discover.diagnosis_record import plain
from rockref.discover.provenance import OF_ONE_RELEASE
from rockref.effects import catalogue
from rockref.report.charts.dots import dots
from rockref.report.html import blocks
from rockref.report.html.falling import by_use
from rockref.report.html.page import Page
from rockref.report.tables import comparison_tables
from rockref.report.tables.table import Table
from rockref.report.terminal import diagnosis_text
from rockref.report.views.card import card_of_diagnosis, fitted_baseline
from rockref.report.views.comparison_page import add_runs

#: Bytes for the curves of the runs; decided: the page stays below half of what it may have.
ROOM = 600_000
BASELINE = "baseline"
#: Candidates whose names stand below a figure; decided: names of twenty letters do not touch.
NAMED = 4


def compared(d: Diagnosis) -> Comparison:
    """Return the fitted baseline and the model that was found, beside all runs from the release on."""
    names, models = [BASELINE], [fitted_baseline(d)]
    if d.effects and d.model is not None:
        names.append(found_name(d))
        models.append(without_notes(d.model))
    return compare(d.experiment, models, names, releases={})


def without_notes(model: Model) -> Model:
    """Return the model without the notes of a fit about one release."""
    return model.replace(origin={k: v for k, v in model.origin.items() if k not in OF_ONE_RELEASE})


def found_name(d: Diagnosis) -> str:
    """Return what the model that was found is called in figures."""
    return diagnosis_text.with_words(plain(d.to_dict()))


def diagnosis_page(d: Diagnosis, comparison: Comparison | None = None) -> Page:
    """Return the page of a diagnosis; `comparison` saves simulating the runs again."""
    c = compared(d) if comparison is None else comparison
    record = plain(d.to_dict())
    page = Page(f"{d.experiment.name}: which effect is missing?", diagnosis_text.sentence_of(record))
    page.set_card(card_of_diagnosis(record, c))
    add_diagnosis(page, record, c)
    page.add_section("Where the numbers come from")
    page.add_provenance(blocks.provenance(c) | {"diagnosis": record["versions"], "seconds": f"{record['seconds']:.0f}"})
    return page


def add_diagnosis(page: Page, record: dict[str, Any], c: Comparison) -> None:
    """Add the sections of a diagnosis (its JSON record) to a page."""
    page.add_section("The verdict", verdict_words(record))
    page.add_section("What was measured")
    blocks.add_measured(page, c)
    page.add_section("Where the baseline fails")
    add_where(page, record, c)
    page.add_section("What was tried", TRIED)
    add_tried(page, record)
    page.add_section("What explains it")
    add_explanation(page, record)
    page.add_section("What would make it sure")
    add_sure(page, record)
    page.add_section("The error falling")
    add_falling_error(page, record)
    blocks.add_error_figure(page, c)
    page.add_section("Run by run")
    add_runs(page, c, ROOM)
    page.add_section("In motion")
    blocks.add_motion(page, c)


TRIED = (
    "A score test predicts what each effect of the catalogue would gain on top of the baseline. The best are fitted "
    "together with all parameters and release tilts, at growing memories. What counts is what is gained over the "
    "baseline, which is fitted as well."
)


def verdict_words(record: dict[str, Any]) -> list[str]:
    """Return the verdict, what this kind of verdict means, and the proof on held-out runs."""
    words = [diagnosis_text.sentence_of(record), diagnosis_text.MEANINGS.get(record["verdict"], "")]
    if record["verdict"] == "something_else":
        words.append(diagnosis_text.looks_like(record))
    e = record["error"]
    floor = e["noise_floor"]
    if record["amplitudes"]:
        parts = [
            f"{name} {e['baseline'][use]:.4f} to {e['with_effect'][use]:.4f} deg/s RMS"
            for use, name in (("fit", "on the fit runs"), ("holdout", "on the held-out runs"))
            if e["baseline"].get(use) is not None and e["with_effect"].get(use) is not None
        ]
        words.append(f"The error falls {', '.join(parts)}; the noise floor is {floor:.4f}.")
    return [w for w in words if w]


def add_where(page: Page, record: dict[str, Any], c: Comparison) -> None:
    """Add where the fitted baseline fails, and what its misfit looks like."""
    page.add_sentences(
        [f.text for f in findings(c) if f.model == BASELINE],
        "The baseline, fitted without any effect, from the release on",
    )
    page.add_table(diagnosis_text.signature_table(record))
    shares = record["signature"].get("axis_shares")
    rest = record["signature"].get("remaining_axis_shares")
    if shares:
        states = [("baseline", shares)] + ([("after the best fit", rest)] if rest else [])
        add_shares(page, states)
    page.add_table(comparison_tables.errors_table(c, 0))


def add_shares(page: Page, states: Sequence[tuple[str, dict[str, float]]]) -> None:
    """Add the shares of the axes in the misfit as dots."""
    numbers = [(name, [100 * (shares.get(a) or 0.0) for a in AXES]) for name, shares in states]
    title = "Shares of the axes in the misfit"
    svg, keys = dots(title, AXES, numbers, label="share (%)", limits=(0.0, 105.0), height=120.0)
    sentence = "How the misfit of the fitted baseline, noise taken out, is shared among the axes of the gyroscope."
    page.add_figure(svg, sentence, None, "Shares of the axes", keys)


def add_tried(page: Page, record: dict[str, Any]) -> None:
    """Add the candidates by gain."""
    ranking = record["ranking"]
    if not ranking:
        page.add_text("No candidate was refitted.")
        return
    if len(ranking) > 1:
        add_gains(page, ranking)
    page.add_table(diagnosis_text.ranking_table(record))


def add_gains(page: Page, ranking: list[dict[str, Any]]) -> None:
    """Add the figure of the gains, where there are some to be compared."""
    names = [r["effect"] if len(ranking) <= NAMED else str(k) for k, r in enumerate(ranking, 1)]
    gains = [("gain", [max(r["gain"], 1.0) for r in ranking])]
    title = "Gain of the candidates"
    svg, _ = dots(title, names, gains, label="gain (nat)", x_label="effect", log=True, height=150.0)
    sentence = "Log-likelihood that each candidate gains over the baseline, best first, on a logarithmic scale."
    page.add_figure(svg, sentence, None, title)


def add_explanation(page: Page, record: dict[str, Any]) -> None:
    """Add the physics of what was found, and how large it is."""
    if not record["effects"]:
        page.add_text("Nothing of the catalogue. " + diagnosis_text.MEANINGS.get(record["verdict"], ""))
    for id in record["effects"]:
        page.add_heading(id)
        add_physics(page, id)
    if record["amplitudes"]:
        page.add_table(diagnosis_text.amplitudes_table(record))


def add_physics(page: Page, id: str) -> None:
    """Add an effect: what it is, its equation, where it is from."""
    kind = catalogue.find(id)
    page.add_text(kind.sentence or "An effect of the user's own.")
    if kind.equation:
        page.add_equation(kind.equation)
    if kind.source:
        page.add_text(f"Source: {kind.source}")


def add_sure(page: Page, record: dict[str, Any]) -> None:
    """Add the experiment that would separate, the confounders, what could have stayed unseen, and the checks."""
    if record["separating_experiment"]:
        page.add_text(record["separating_experiment"])
    sentences = [
        f"{id} is most easily mistaken for {kind.confounder}."
        for id in record["effects"]
        if (kind := catalogue.EFFECTS.get(id)) is not None and kind.confounder
    ]
    if sentences:
        page.add_sentences(sentences)
    if record.get("detection_limits"):
        page.add_table(diagnosis_text.limits_table(record))
    if record.get("confusion"):
        page.add_table(diagnosis_text.confusion_table(record))
    rows = diagnosis_text.gates_rows(record)
    page.add_table(Table("Checks of the verdict and of the fit behind it", ("check", "found"), rows, prose=True))


def add_falling_error(page: Page, record: dict[str, Any]) -> None:
    """Add the error before and after over windows, on fit and held-out runs."""
    e = record["error"]
    page.add_text(f"The error counts {e['stretch']}.")
    places = [("baseline", "baseline")]
    if record["amplitudes"]:
        places.append((diagnosis_text.with_words(record), "with_effect"))
    errors = {use: [np.nan if (v := e[key].get(use)) is None else v for _, key in places] for use in ("fit", "holdout")}
    svg, keys = by_use("The error falling", [name for name, _ in places], errors, e["noise_floor"], "model")
    sentence = "RMS of measured minus modelled, deg/s, before and after, on the runs that were fitted and not."
    page.add_figure(svg, sentence, diagnosis_text.errors_table(record), "The error falling", keys)
