"""Ctrl-C: what was found is kept, and what is said of it is true."""

import pytest

from rockref.commands._keeping import checkpoints_in, interruption
from rockref.discover import diagnose as engine
from rockref.discover.evidence.evidence import Evidence
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import S3
from rockref.discover.fit_store import FitStore
from rockref.model.errors import Interrupted
from tests.command import run
from tests.unit.discover import fakes
from tests.unit.discover.test_fit_store import TABLE, fitted


@pytest.fixture
def kept(tmp_path, monkeypatch):
    monkeypatch.setenv("ROCKREF_CACHE", str(tmp_path / "kept"))
    return tmp_path / "kept"


@pytest.fixture(scope="module")
def made():
    return fakes.made_experiment(0.7)


@pytest.mark.parametrize(
    "words, place, goes_on",
    [
        ("diagnose anywhere", "diagnose.diagnose", "The same command begins its search anew; rockref fit"),
        ("fit anywhere", "fit_baseline.fit_baseline", "The same command, without --fresh, starts from"),
        ("fit anywhere -e adhesion", "fit_baseline.fit_baseline", "The same command starts anew, for"),
        ("add anywhere adhesion", "add_effect.add_effect", "The same command, without --fresh, starts"),
    ],
)
def test_an_interruption_says_what_was_kept_and_what_goes_on_from_it(
    capsys, monkeypatch, tmp_path, kept, made, words, place, goes_on
):
    problem = fit_problem(made, made.fit_runs(), TABLE, end=0.6, workers=1)

    def work(*given, store, **options):
        store.open(made)
        store.note(problem)(fitted(problem), S3)
        raise KeyboardInterrupt

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(f"rockref.discover.{place}", work)
    code, out, err = run(capsys, *words.split())
    assert (code, out) == (130, "")
    assert "Kept: 1 fit, the best of the baseline; no file was written." in err and goes_on in err
    assert len(list(kept.glob("*.json"))) == 1 and FitStore().open(made).start(problem, ()) is not None
    assert not (tmp_path / "model.toml").exists()


def test_a_search_goes_on_after_the_stage_that_was_kept(made, kept):
    store = FitStore().open(made)
    problem = fit_problem(made, made.fit_runs(), TABLE, end=0.6, workers=1)
    store.note(problem)(fitted(problem), S3)
    store.kept["searches"]["key"] = {"stage": "S2"}
    assert interruption(store).endswith("The same command, without --fresh, goes on with the search after stage S2.")


def test_where_nothing_was_found_nothing_is_said_to_be_kept(made, kept):
    assert interruption(FitStore().open(made)).startswith("interrupted. Nothing was found yet")


def test_a_diagnosis_with_the_same_options_is_answered_from_what_was_kept(monkeypatch, made, kept):
    said = fakes.fitted().evidence
    evidence = Evidence("synthetic", made.digest, 1000, {}, [said])
    computed = []

    def evidence_of(fitter, fits, experiment):
        computed.append(len(fits))
        return evidence

    problem = fit_problem(made, made.fit_runs(), TABLE, end=0.6, workers=1)
    monkeypatch.setattr(engine, "opened", lambda path: (made, made))
    monkeypatch.setattr(engine.KeptSearch, "run", lambda search: [fitted(problem)])
    monkeypatch.setattr(engine, "evidence_of", evidence_of)

    def ask(fresh=False, **options):
        return engine.diagnose("folder", end=0.6, workers=1, store=FitStore(fresh=fresh), **options)

    first, again = ask(), ask()
    assert len(computed) == 1 and again.from_store and not first.from_store
    left_out = ("from_kept_diagnosis",)
    assert {k: v for k, v in again.to_dict().items() if k not in left_out} == {
        k: v for k, v in first.to_dict().items() if k not in left_out
    }
    assert again.model.parameters == first.model.parameters
    ask(seed=1)
    ask(fresh=True)
    assert len(computed) == 3


@pytest.mark.parametrize("there, words", [(("generation-3.json",), "--resume"), ((), "nothing is kept")])
def test_an_interrupted_search_says_which_checkpoints_go_on(tmp_path, there, words):
    for name in there:
        (tmp_path / name).write_text("{}", encoding="utf-8")
    with pytest.raises(Interrupted, match=words) as ended, checkpoints_in(tmp_path):
        raise KeyboardInterrupt
    assert all(name in str(ended.value) for name in there)
