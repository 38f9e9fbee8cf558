"""The verbs of `import rockref`: load, compare, fit, diagnose, add, plan, conform; each is its command, from Python."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rockref.results import Result, printed

if TYPE_CHECKING:
    from rockref.api import Model
    from rockref.discover.progress import StageReport
    from rockref.measure.records.release import Experiment

Progress = Callable[["StageReport"], None] | None


def load(folder: str | Path) -> Experiment:
    """Load an experiment folder: block, gyroscope, runs. Remarks stand in its ``notices``.

    Raises InputError, as :func:`rockref.measure.load_experiment`.
    """
    from rockref.measure import load_experiment

    return load_experiment(_folder(folder))


def compare(
    experiment: str | Path | Experiment,
    models: Model | str | Path | Sequence[Model | str | Path] = (),
    *,
    names: Sequence[str] | None = None,
    engine: str = "auto",
) -> Result:
    """Compare models with the measured runs of an experiment; without models its baseline.

    Models are models, files, ``"baseline"``, ``"table_3_1"`` or ``"four_points"``; `names` are said in their place.
    Raises InputError, NumericalError.
    """
    from rockref.discover.compare.models import baseline_model
    from rockref.discover.compare.models import compare as run_comparison
    from rockref.discover.compare.record import to_dict
    from rockref.discover.compare.sentences import findings
    from rockref.report.charts.run_panels import whole_run
    from rockref.report.terminal.next_command import BASELINE
    from rockref.report.views.comparison_page import write_report

    loaded = _experiment(experiment)
    listed = [models] if isinstance(models, str | Path) or not isinstance(models, Sequence) else list(models)
    chosen = [baseline_model(loaded) if one == BASELINE else _model(one) for one in listed or [BASELINE]]
    names = list(names or _names(listed)) if listed else [f"baseline ({loaded.baseline})"]
    found = run_comparison(loaded, chosen, names, engine=engine)
    said = findings(found)
    title = f"comparison of {loaded.name} with {' and '.join(names)}"
    return Result(
        title,
        found,
        lambda: "\n".join(f.text if len(names) < 2 or f.model is None else f"{f.model}: {f.text}" for f in said),
        found_dict=lambda: to_dict(found),
        draw=lambda: whole_run(found, 0),
        page=lambda folder: write_report(found, folder)[0],
    )


def fit(
    experiment: str | Path | Experiment,
    model: Model | str | Path | None = None,
    effects: Sequence[str] | str = (),
    *,
    seed: int = 0,
    check: bool = True,
    progress: Progress = None,
) -> Result:
    """Fit the parameters of a model, by default the baseline, to the fit runs; ``result.model`` has them.

    `effects` are ids to fit along. Raises InputError, NumericalError.
    """
    from rockref.discover.fit_baseline import fit_baseline
    from rockref.report.terminal.fit_text import print_fit

    along, seed = tuple(_words(effects)), _seed(seed)
    folder, start = _folder(experiment), _optional(model)
    found = fit_baseline(folder, along, start, seed, None, check=check, progress=progress)
    return _of_model(f"fit of {found.experiment.name}", found, lambda: printed(lambda c: print_fit(c, found)), start)


def diagnose(
    experiment: str | Path | Experiment,
    model: Model | str | Path | None = None,
    effects: Sequence[str] | str = (),
    *,
    seed: int = 0,
    progress: Progress = None,
) -> Result:
    """Say which effect the model lacks, how large it is, and how sure that is; ``result.model`` has it.

    `effects` are further candidates of your own, ``path/to/file.py:Class``. Raises InputError, NumericalError.
    """
    from rockref.discover import diagnose as engine
    from rockref.discover.diagnosis_record import plain
    from rockref.engines import compiled_ahead
    from rockref.report.terminal.diagnosis_text import print_diagnosis
    from rockref.report.views.diagnosis_page import diagnosis_page

    own, seed = _words(effects), _seed(seed)
    start = _optional(model)
    with compiled_ahead():
        found = engine.diagnose(_folder(experiment), start, seed, None, progress=progress, own=own)
    record = plain(found.to_dict())
    return _of_model(
        f"diagnosis of {found.experiment.name}",
        found,
        lambda: printed(lambda c: print_diagnosis(c, record)),
        start,
        page=lambda folder: diagnosis_page(found).write_into(folder),
    )


def add(
    experiment: str | Path | Experiment,
    effect: str,
    model: Model | str | Path | None = None,
    *,
    seed: int = 0,
    progress: Progress = None,
) -> Result:
    """Fit one more effect into a model together with all that it has; ``result.model`` has both.

    Raises InputError, NumericalError.
    """
    from rockref.discover.add_effect import add_effect
    from rockref.report.terminal.addition_text import print_addition
    from rockref.report.views.addition_page import addition_page

    (effect,), seed, start = _words(effect, "effect"), _seed(seed), _optional(model)
    found = add_effect(effect, _folder(experiment), start, seed, None, progress=progress)
    return _of_model(
        f"{effect} in {found.experiment.name}",
        found,
        lambda: printed(lambda c: print_addition(c, found)),
        start,
        page=lambda folder: addition_page(found).write_into(folder),
    )


def plan(
    model: Model | str | Path = "table_3_1",
    runs: str = "0.117x3,0.098,0.117t",
    effects: Sequence[str] | str = (),
    *,
    seed: int = 0,
    progress: Progress = None,
) -> Result:
    """Foretell which effects planned runs could show: tilts in rad, ``x3`` repeats, ``t`` turns the block.

    Raises InputError, NumericalError.
    """
    from rockref.discover.plan import plan as run_plan
    from rockref.discover.plan import releases_from
    from rockref.report.terminal.plan_text import sentences

    own, seed = _words(effects), _seed(seed)
    if not isinstance(runs, str):
        raise _no_runs(runs)
    found = run_plan(_model(model), releases_from(runs), own or None, seed=seed, progress=progress)
    return Result(f"plan of {runs}", found, lambda: "\n".join(sentences(found)))


def conform(backend: Any, *, layers: Sequence[str] | str | None = None, profile: str | None = None) -> Result:
    """Judge a backend by the vectors: an object with the functions of a backend, or ``"package:Backend"``.

    `layers` are those of ``rockref conform --layers``, as ``"L1,L2"``. ``result.passed`` is the verdict.
    Raises InputError.
    """
    from rockref.conformance.backends.load import load as load_backend
    from rockref.conformance.judge.findings import judge, used_profile
    from rockref.conformance.judge.verdict import as_json, verdict
    from rockref.conformance.reports import terminal
    from rockref.conformance.reports.page import page as page_of
    from rockref.model.storage import write_bytes
    from rockref.report.output import made_folder

    judged = load_backend(backend) if isinstance(backend, str) else backend
    chosen = [name.strip() for name in layers.split(",")] if isinstance(layers, str) else layers
    found = verdict(judge(judged, chosen, used_profile(judged, profile)), judged)

    def page(folder: Path) -> Path:
        path = made_folder(folder) / "index.html"
        write_bytes(path, page_of(found).encode())
        return path

    return Result("conformance", found, lambda: terminal.text(found), found_dict=lambda: as_json(found), page=page)


def _of_model(
    title: str, found: Any, words: Callable[[], str], start: Model | None, page: Callable[[Path], Path] | None = None
) -> Result:
    """Return the result of a verb that found a model: the picture and the page show it beside what was started with."""

    def beside() -> Result:
        from rockref.discover.compare.models import baseline_model

        before = start if start is not None else baseline_model(found.experiment)
        return compare(found.experiment.path, [before, found.model], names=["before", "after"])

    return Result(title, found, words, draw=lambda: beside().plot(), page=page or (lambda f: beside().save_page(f)))


def _experiment(given: Any) -> Experiment:
    from rockref.measure.records.release import Experiment

    if isinstance(given, Experiment):
        return given if all(run.loaded for run in given.runs) else load(given.path)
    return load(_folder(given))


def _folder(given: Any) -> Path:
    from rockref.measure.records.release import Experiment
    from rockref.model.errors import InputError

    if isinstance(given, Experiment):
        return given.path
    if not isinstance(given, str | Path):
        raise InputError("E-TYPE", "experiment", f"is {given!r}"[:80], "Give a folder, or what rockref.load returned.")
    return Path(given)


def _words(given: Any, name: str = "effects") -> list[str]:
    """Return effects as words: one, or a sequence of them. Raises InputError E-TYPE for what is neither."""
    from rockref.model.errors import InputError

    listed = [given] if isinstance(given, str) else given
    if not isinstance(listed, Sequence) or not all(isinstance(one, str) for one in listed):
        cure = 'Give the id of an effect, as "rolling_resistance", or path/to/file.py:Class.'
        raise InputError("E-TYPE", name, f"is {given!r}"[:80], cure)
    return list(listed)


def _no_runs(given: Any) -> Exception:
    from rockref.model.errors import InputError

    return InputError("E-TYPE", "runs", f"is {given!r}"[:80], 'Give tilts in rad, as "0.117x3,0.098,0.117t".')


def _seed(given: Any) -> int:
    """Return a seed. Raises InputError E-TYPE where it is no whole number from zero on."""
    from rockref.model.errors import InputError

    if isinstance(given, bool) or not isinstance(given, int) or given < 0:
        raise InputError("E-TYPE", "seed", f"is {given!r}"[:80], "Give a whole number, 0 or above.")
    return given


def _model(given: Any) -> Model:
    from rockref.api import Model
    from rockref.model.errors import InputError

    if isinstance(given, Model):
        return given
    if given in ("table_3_1", "four_points"):
        return getattr(Model, given)()
    if not isinstance(given, str | Path):
        cure = "Give a Model, a file, table_3_1 or four_points."
        raise InputError("E-TYPE", "model", f"is {given!r}"[:80], cure)
    return Model.load(given)


def _optional(given: Any) -> Model | None:
    return None if given is None else _model(given)


def _names(listed: Sequence[Any]) -> list[str]:
    """Return a short name for each model: a file's without its ending, else its place; what is twice has its place."""
    from rockref.api import Model

    names = [f"model {k + 1}" if isinstance(one, Model) else Path(one).stem for k, one in enumerate(listed)]
    return [name if names.count(name) == 1 else f"{name} ({k + 1})" for k, name in enumerate(names)]
