"""Tosses on the terminal: tables and sentences."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rockref.discover.tosses.compare import PUBLISHED
from rockref.discover.tosses.ledger import GAIN
from rockref.report.tables.table import Table
from rockref.report.terminal.diagnosis_text import confusion_table
from rockref.report.terminal.text import print_table

if TYPE_CHECKING:
    from rich.console import Console

HEAD = ("", "start", "tosses", "position %", "median (quartiles)", "rotation deg", "median (quartiles)")


#: What flight arcs give: words, and the scale to a unit in which it can be read.
ARCS = {f"g_{a}": (f"gravity, {a} (x against the throw)" if a == "x" else f"gravity, {a}", 1.0, "m/s2") for a in "xyz"}
ARCS |= {f"centre_{a}": (f"centre of mass, {a}", 1e3, "mm") for a in "xyz"}
#: What impacts on one corner give.
CORNER = {
    "friction": "friction of the corner",
    "restitution": "restitution of the corner",
    "restitution_on_a_face": "restitution of the corner of a face that comes down flat",
    "restitution_on_a_tip": "restitution of a tip",
}


def error_cells(summary: dict[str, Any]) -> tuple[str, ...]:
    """Return mean ± deviation, median and quartiles of position and rotation."""
    cells: list[str] = []
    for a in (summary["position_percent"], summary["rotation_deg"]):
        cells.append(f"{a['mean']:.1f} ± {a['sd']:.1f}")
        cells.append(f"{a['median']:.1f} ({a['lower_quartile']:.1f} to {a['upper_quartile']:.1f})")
    return tuple(cells)


def errors_table(record: dict[str, Any]) -> Table:
    """Return the models of a comparison beside the published simulators."""
    rows = [
        (f"{r['model']}, {r['use']}", r["start"], str(r["tosses"]), *error_cells(r)) for r in record["rows"]
    ]  # fmt: skip
    for name, (p, ps, a, s) in PUBLISHED.items():
        rows.append((f"{name}, published", "raw", "550", f"{p:.1f} ± {ps:.1f}", "", f"{a:.1f} ± {s:.1f}", ""))
    note = (
        "Mean over all frames of a toss, then over the tosses. Published: identified and reported on the same tosses."
    )
    return Table("Errors", HEAD, tuple(rows), note)


def stretches_table(row: dict[str, Any]) -> Table:
    """Return where the errors of one row grow."""
    rows = tuple(
        (
            s["stretch"], str(s["tosses"]), f"{s['frames_percent']:.0f}",
            f"{s['position_percent']:.1f}", f"{s['growth']['position_percent']:+.1f}",
            f"{s['rotation_deg']:.1f}", f"{s['growth']['rotation_deg']:+.1f}",
            f"{s['energy_lost']['measured_percent']:.1f}", f"{s['energy_lost']['model_percent']:.1f}",
            str(s["energy_lost"]["gains"]),
        )
        for s in row["stretches"]
    )  # fmt: skip
    head = (
        "stretch", "tosses", "frames %", "position %", "grows by", "rotation deg", "grows by", "energy lost %",
        "model", "gain",
    )  # fmt: skip
    note = (
        "Energy: share of what a toss loses altogether, by differences of poses, measured and in the model; gain: "
        f"tosses whose measured energy rises over the stretch by more than {GAIN:.0%} of it."
    )
    return Table(f"Where: {row['model']}, {row['use']} tosses, start from the {row['start']}", head, rows, note)


def with_error(value: float, se: float) -> str:
    """Return a value with two digits of its standard error."""
    digits = max(0, 1 - math.floor(math.log10(se))) if se > 0 else 3
    return f"{value:.{digits}f} ± {se:.{digits}f}"


def measured_table(found: dict[str, Any]) -> Table:
    """Return what the tosses say without a contact model."""
    rows = []
    for key, v in found.get("flight_arcs", {}).get("values", {}).items():
        words, scale, unit = ARCS.get(key, (key, 1.0, v["unit"]))
        rows.append((f"flight arcs: {words}", with_error(scale * v["value"], scale * v["se"]), unit))
    for name in ("stated_centre", "measured_centre"):
        part = found.get(name)
        if part is None:
            continue
        words = name.replace("_", " ")
        rows.append((f"{words}: moment left in the impulse balance, over the mass",
                     f"{part['impulse_balance']['scatter']:.4g}", "m2/s"))  # fmt: skip
        rows += [(f"{words}: inertia {a}", f"{1e3 * v:.2f}", "g m2") for a, v in part["inertia_kg_m2"].items()]
        for key, v in part["corner"]["values"].items():
            rows.append((f"{words}: {CORNER.get(key, key)}", with_error(v["value"], v["se"]), "1"))
        e = part["energy_change"]
        rows.append((f"{words}: impacts that gain kinetic energy", f"{e['gains']} of {e['tosses']}", ""))
    e = found.get("energy_of_stated_velocities")
    if e:
        rows.append(("tosses that gain energy at the first impact, by stated velocities from frame to frame",
                     f"{e['from_frame_to_frame']} of {e['tosses']}", ""))  # fmt: skip
        most, quiet = (f"{100 * e[key]:.1f}" for key in ("largest", "largest_in_flight"))
        rows.append(("the most that one gains so, of all it loses; in free flight", f"{most}; {quiet}", "%"))
        rows.append(
            (
                "tosses that gain energy from three frames before it to three after",
                f"{e['around']} of {e['tosses']}",
                "",
            )
        )
        rows.append(("the least that one loses there, of all it loses", f"{100 * e['least_loss_around']:.0f}", "%"))
    for key, v in found.get("sliding", {}).get("values", {}).items():
        rows.append((f"friction of a face that slides flat, {key}", with_error(v["value"], v["se"]), "1"))
    return Table("Without a contact model", ("what", "value", "unit"), tuple(rows), "First impacts on one corner.")


def _brief(summary: dict[str, Any]) -> tuple[str, str]:
    """Return mean and median of position and rotation."""
    p, r = summary["position_percent"], summary["rotation_deg"]
    return f"{p['mean']:.1f} ({p['median']:.1f})", f"{r['mean']:.1f} ({r['median']:.1f})"


def sliding_table(rows: list[dict[str, Any]]) -> Table:
    """Return friction of a face that slides flat by speed, from how the tosses slow down and from how those of models
    do."""
    parts = [("measured", rows[0]["sliding"]["measured"]), *((r["model"], r["sliding"]["model"]) for r in rows)]
    speeds = list(dict.fromkeys(k for _, part in parts for k in part))
    cells = tuple(
        (speed, *(with_error(part[speed]["value"], part[speed]["se"]) if speed in part else "" for _, part in parts))
        for speed in speeds
    )
    note = f"Deceleration over the model's gravity, read from the poses in the same way; {rows[0]['use']} tosses."
    return Table("Friction of a face that slides flat", ("speed", *(name for name, _ in parts)), cells, note)


def staircase_table(record: dict[str, Any]) -> Table:
    """Return held-out errors after each added effect: mean and median of position and rotation from both starts."""
    first = record["nominal_holdout"]
    rows = [("stated values", "", *_brief(first["flight"]), "", *_brief(first["raw"]))]
    for s in record["staircase"]:
        proof, held = s["proof"], s["holdout"]
        fall = f"{proof['mean']:.2f} ({proof['low']:.2f} to {proof['high']:.2f})"
        rows.append((s["added"].split(":")[0], s["verdict"], *_brief(held["flight"]), fall, *_brief(held["raw"])))
    head = (
        "added",
        "verdict",
        "position %",
        "rotation deg",
        "falls by (90 % of all)",
        "raw: position %",
        "rotation deg",
    )
    f = record["floor"]
    note = (
        "Held-out tosses, means, medians in brackets. "
        f"A true model would have {f['position_percent']:.1f} % and {f['rotation_deg']:.1f} deg "
        f"(medians {f['position_percent_median']:.1f}, {f['rotation_deg_median']:.1f}): the uncertainty of the starts."
    )
    if record["not_needed"]:
        note += f" Tried with all the others, and not needed: {', '.join(record['not_needed'])}."
    return Table("The staircase", head, tuple(rows), note)


def agreement_table(record: dict[str, Any]) -> Table:
    """Return two ways to one quantity."""
    rows = []
    for a in record["agreement"]:
        # A thousandth of the unit is what a hand-sized block is measured in.
        unit, scale = {"m": ("mm", 1e3), "kg m2": ("g m2", 1e3)}.get(a["unit"], (a["unit"], 1.0))
        other = with_error(scale * a["without"], scale * a["standard_error"])
        rows.append((a["quantity"], f"{scale * a['with_contact_model']:.3g}", other, unit, a["how"]))
    head = ("quantity", "fit of the tosses", "without contact model", "unit", "how")
    return Table("Two ways", head, tuple(rows), "")


def print_toss_comparison(console: Console, record: dict[str, Any]) -> None:
    """Print a comparison."""
    if record["copies"]:
        console.print(f"{len(record['copies'])} turned copies of other tosses were set aside.", highlight=False)
    print_table(console, errors_table(record))
    flights = [row for row in record["rows"] if row["start"] == "flight"]
    for row in flights:
        print_table(console, stretches_table(row))
    print_table(console, sliding_table([row for row in flights if row["use"] == flights[-1]["use"]]))
    print_table(console, measured_table(record["measured"]))


def print_toss_diagnosis(console: Console, record: dict[str, Any]) -> None:
    """Print a diagnosis."""
    console.print(f"{record['verdict']}: {record['sentence']}", style="bold", markup=False, highlight=False)
    print_table(console, staircase_table(record))
    print_table(console, agreement_table(record))
    if record["confusion"]:
        print_table(console, confusion_table(record))
    print_gates(console, record)
    console.print(f"  {record['seconds']:.0f} s", highlight=False)


def gates_table(record: dict[str, Any]) -> Table:
    """Return what the gates say."""
    rows = tuple(
        (g["name"], f"{g['value']:.3g}", f"{g['limit']:g}", "passed" if g["passed"] else "not passed")
        for g in record["gates"]
    )
    return Table("Gates", ("gate", "value", "limit", "state"), rows)


def parameters_table(record: dict[str, Any]) -> Table:
    """Return the numbers of a fit."""
    rows = tuple((k, f"{v['value']:.5g}", v["unit"]) for k, v in record["parameters"].items())
    return Table("Fitted", ("parameter", "value", "unit"), rows, "Fitted together to the tosses marked fit.")


def print_gates(console: Console, record: dict[str, Any]) -> None:
    """Print what the gates say."""
    for gate in record["gates"]:
        state = "passed" if gate["passed"] else "NOT PASSED"
        console.print(f"  gate {gate['name']}: {state} ({gate['value']:g}, limit {gate['limit']:g})", highlight=False)


def print_toss_fit(console: Console, record: dict[str, Any]) -> None:
    """Print a fit."""
    print_table(console, parameters_table(record))
    rows = tuple((e["use"], e["start"], str(e["tosses"]), *error_cells(e)) for e in record["errors"])
    print_table(console, Table("Errors", ("use", *HEAD[1:]), rows, "Held-out tosses were not looked at."))
    print_gates(console, record)


def print_toss_addition(console: Console, record: dict[str, Any]) -> None:
    """Print the errors without and with an effect."""
    print_table(console, parameters_table(record))
    rows = tuple(
        (f"{e['use']}, {name}", e["start"], str(e[name]["tosses"]), *error_cells(e[name]))
        for e in record["errors"]
        for name in ("before", "after")
    )
    print_table(console, Table(f"Without and with {record['effect']}", HEAD, rows, ""))
    fall = record["holdout_falls_by"]
    if fall:
        console.print(
            f"On held-out tosses position [%] plus rotation [deg] falls by {fall['mean']:.2f} "
            f"({fall['low']:.2f} to {fall['high']:.2f}, {fall['interval']:.0%}).", highlight=False,
        )  # fmt: skip
    print_gates(console, record)
