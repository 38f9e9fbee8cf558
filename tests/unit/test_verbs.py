"""The verbs of `import rockref`: lazy, one call a question, results that say and draw themselves."""

import subprocess
import sys

import pytest

import rockref
from rockref import InputError, Model, verbs
from rockref.results import Result, printed
from tests.refusal import refused
from tests.shipped import two_runs


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    return two_runs(tmp_path_factory.mktemp("short"))


@pytest.fixture(scope="module")
def compared(short):
    pytest.importorskip("numba")
    return rockref.compare(short, "table_3_1")


def test_a_verb_is_loaded_when_it_is_asked_for():
    code = "import sys, rockref; n, m = 'rockref.verbs', sys.modules; print(n in m); rockref.load; print(n in m)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False", "True"]
    assert set(rockref.__all__) <= set(dir(rockref))
    with pytest.raises(AttributeError, match="no attribute 'frobnicate'"):
        rockref.frobnicate  # noqa: B018


def test_an_experiment_says_itself_in_a_line(short):
    assert repr(rockref.load(short)).count("\n") == 0
    assert "runs 2 (1 fit, 1 holdout)" in repr(rockref.load(short))


def test_a_comparison_says_draws_and_saves_itself(compared, tmp_path):
    assert repr(compared).startswith("<comparison of ") and len(repr(compared)) < 250
    assert "band of noise" in compared.summary()
    assert compared.to_dict()["models"] and compared.holds_to_second_impact() is False
    assert compared.plot().axes
    assert compared._repr_html_().startswith("<pre") and "data:image/png" in compared._repr_html_()
    page = compared.save_page(tmp_path / "report")
    assert page.name == "index.html" and page.stat().st_size > 10_000


def test_a_backend_is_judged(tmp_path):
    judged = rockref.conform("rockref.conformance.backends.law:NumpyEngine", layers="L1")
    assert judged.passed and judged.save_page(tmp_path).read_text().startswith("<!")
    error = refused(judged.plot)
    assert error.code == "E-PLOT"


@pytest.mark.parametrize(
    "call",
    [
        lambda: rockref.load(3),
        lambda: rockref.diagnose("folder", effects=3),
        lambda: rockref.fit("folder", effects=["gyro_scale", 3]),
        lambda: rockref.add("folder", 3),
        lambda: rockref.fit("folder", seed="a"),
        lambda: rockref.plan(runs=3),
        lambda: rockref.compare(3),
        lambda: rockref.compare("nowhere", 3),
        lambda: rockref.plan(3),
        lambda: verbs._model(b"m"),
    ],
)
def test_wrong_types_are_refused_by_name(call):
    error = refused(call)
    assert error.code in ("E-TYPE", "E-FOLDER")


def test_models_are_named_by_file_or_place():
    assert verbs._names(["table_3_1", Model(), "a/one.toml", "b/one.toml"]) == [
        "table_3_1",
        "model 2",
        "one (3)",
        "one (4)",
    ]


def test_a_fit_hands_on_what_it_was_given(monkeypatch, short):
    """The verb adds nothing to the fit: folder, effects, start and seed go in; the model and words come out."""

    class Found:
        model, experiment = Model(), rockref.load(short)

        def to_dict(self):
            return {"loss": 1.0}

    asked = []
    monkeypatch.setattr("rockref.discover.fit_baseline.fit_baseline", lambda *a, **k: asked.append((a, k)) or Found())
    monkeypatch.setattr(
        "rockref.report.terminal.fit_text.print_fit", lambda console, found: console.print("A good fit.")
    )
    result = rockref.fit(rockref.load(short), effects="gyro_scale", seed=3)
    assert asked == [((short, ("gyro_scale",), None, 3, None), {"check": True, "progress": None})]
    assert result.summary() == "A good fit." and result.model == Model() and result.to_dict() == {"loss": 1.0}


def test_words_are_as_wide_as_a_letter():
    lines = printed(lambda console: console.print("word " * 60)).splitlines()
    assert max(map(len, lines)) <= 100 and len(lines) == 3


def test_a_result_without_a_page_says_so():
    empty = Result("nothing", {}, lambda: "", found_dict=dict)
    with pytest.raises(InputError):
        empty.save_page("somewhere")
    with pytest.raises(AttributeError):
        empty._private  # noqa: B018
