"""`rockref plan`: what a campaign could show before it is made."""

from typing import Annotated

import typer

from rockref.commands._options import AsJson, Full, JsonFile, PageFolder, StartModel, Threads, Verbose
from rockref.commands._results import only_for


def plan(
    model: StartModel = "table_3_1",
    runs: Annotated[
        str, typer.Option("--runs", help="Planned releases, by tilt in rad: x3 repeats a release, t turns the block.")
    ] = "0.117x3,0.098,0.117t",
    effect: Annotated[
        list[str] | None,
        typer.Option(
            "--effect",
            "-e",
            help="An effect to detect, id or file.py:Class; may be repeated. Default: the whole catalogue.",
        ),
    ] = None,
    outcomes: Annotated[
        str | None,
        typer.Option("--outcomes", help="Two probabilities of falling that tests should distinguish, as 0.5,0.6."),
    ] = None,
    tests: Annotated[
        int | None, typer.Option(min=1, help="With --outcomes: how many tests of either kind are possible.")
    ] = None,
    output: JsonFile = None,
    report: PageFolder = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the simulated noise.")] = 0,
    workers: Threads = None,
    full: Full = False,
    verbose: Verbose = False,
    as_json: AsJson = False,
) -> None:
    """Predict by simulation which effects planned runs could detect, and which they would confuse.

    Says which further run would help most, and whether repeats of one release or varied releases would show more. With
    --outcomes it says only how many tests on a shake table distinguish two probabilities of falling. Exit code 0, or 2
    if the input cannot be used.

    \b
    Example:
      rockref plan
      rockref plan --runs 0.117x5 --effect rolling_resistance --effect viscous_friction
      rockref plan --model model.toml --runs 0.117,0.1,0.117t --json > plan.json
      rockref plan --outcomes 0.5,0.6 --tests 226
    """
    if outcomes is not None:
        from rockref.commands._shaken import plan_outcomes

        only_for("releases", report=report is not None, output=output is not None, effect=bool(effect), full=full)
        return plan_outcomes(outcomes, tests, as_json)
    only_for("--outcomes", tests=tests is not None)
    from rockref.commands._models import models_and_others, say_idle
    from rockref.commands._progress import stages
    from rockref.commands._results import in_json, told, usable_files
    from rockref.discover.plan import plan as run_plan
    from rockref.discover.plan import releases_from
    from rockref.engines import compiled_ahead
    from rockref.model.storage import write_text
    from rockref.report.output import usable_folder
    from rockref.report.terminal.next_command import after_plan
    from rockref.report.terminal.plan_text import print_plan

    usable_files(output)
    folder = usable_folder(report)
    planned = releases_from(runs)
    (given,), candidates = models_and_others([model], effect)
    say_idle(given, model)
    with compiled_ahead(), stages("planning", verbose=verbose) as say:
        found = run_plan(given, planned, candidates or None, seed=seed, workers=workers, progress=say)
    text = in_json(found.to_dict())
    words, then = lambda console: print_plan(console, found, full), lambda: after_plan(found, model, effect or ())
    with told(as_json, lambda written: text, words, then) as written:
        if output is not None:
            write_text(output, text + "\n")
            written.append(output)
        if folder is not None:
            from rockref.report.views.plan_page import plan_page

            written.append(plan_page(found).write_into(folder))
