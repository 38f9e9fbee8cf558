"""The vectors as tests of somebody's own suite: what is collected, and what is said of what cannot be used."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.conformance import pytest_plugin, vectors
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge import claims

EXAMPLE = Path(__file__).resolve().parents[3] / "examples/backend_numpy.py"


def suite(folder, *options):
    """A run of pytest in an empty folder."""
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--color=no", *options]
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=300)


def test_what_cannot_be_used_is_said_in_one_line(tmp_path):
    for option, said in (
        (f"--rockref-backend={EXAMPLE}:Nobody", "E-BACKEND"),
        ("--rockref-profile=float65", "E-PROFILE"),
        ("--rockref-layers=L9", "E-LAYER"),
    ):
        done = suite(tmp_path, f"--rockref-backend={EXAMPLE}:Backend", option)
        assert done.returncode == pytest.ExitCode.USAGE_ERROR and said in done.stderr, done.stdout + done.stderr
        assert "INTERNALERROR" not in done.stdout + done.stderr


def test_a_backend_without_runs_is_unusable(tmp_path):
    (tmp_path / "none.py").write_text("class Backend:\n    pass\n")
    done = suite(tmp_path, "--rockref-backend=none.py:Backend")
    assert done.returncode == pytest.ExitCode.USAGE_ERROR and "simulate" in done.stderr


def test_every_layer_has_its_tests():
    law = NumpyEngine()
    runs = [name for _, name, _ in pytest_plugin.asked(law, "L5", "float64")]
    assert tuple(runs) == vectors.window_names() + vectors.trajectory_names()
    assert tuple(n for _, n, _ in pytest_plugin.asked(law, "L5", "scheme")) == vectors.trajectory_names()
    assert len(pytest_plugin.asked(law, "L6", "float64")) == 8 and len(pytest_plugin.asked(law, "LE", "float64")) > 20
    only = type("Only", (), {"simulate": law.simulate})()
    assert pytest_plugin.asked(only, "L4", "float64")[0][1].endswith("-run")
    assert pytest_plugin.asked(only, "L4", "scheme") == [] == pytest_plugin.asked(only, "LE", "float64")


def test_properties_and_precision_of_the_backend(tmp_path):
    (tmp_path / "mine.py").write_text(
        "from rockref.conformance.backends.law import NumpyEngine\n"
        "import numpy as np\n"
        "class Single(NumpyEngine):\n"
        "    def __init__(self):\n"
        "        super().__init__(np.float32)\n"
        "class Pulls(NumpyEngine):\n"
        "    def contact_law(self, **q):\n"
        "        return super().contact_law(**q) | {'F_N': -1.0}\n"
        "    def effect(self, problem, effect, parameters):\n"
        "        return None\n"
    )
    done = suite(tmp_path, "--rockref-backend=mine.py:Single", "--rockref-layers=L0,L2")
    assert done.returncode == 0, done.stdout
    done = suite(tmp_path, "--rockref-backend=mine.py:Pulls", "--rockref-layers=L6,LE", "-rfs")
    assert "never pulls" in done.stdout and "2 failed" in done.stdout, done.stdout
    assert "is not claimed" in done.stdout


class TestItems:
    """What a test says when it is run: the items themselves, in this process."""

    @pytest.fixture
    def item(self, request):
        """Make the item of this kind that is about a thing."""

        def make(kind, thing, backend=None, profile="float64"):
            given = (backend or NumpyEngine(), thing, profile)
            return kind.from_parent(request.session, name="an item", given=given)

        return make

    def test_a_vector_that_is_answered_rightly_passes_and_else_the_rule_is_named(self, item):
        vector = next(v for v in vectors.layer("L1") if v.rule == "N1")
        item(pytest_plugin.VectorItem, vector).runtest()
        pulls = NumpyEngine()
        pulls.contact_law = lambda **q: NumpyEngine().contact_law(**q) | {"F_N": -1.0}
        with pytest.raises(pytest_plugin.Failed, match=r"rule N1 - .*\(3\.5a\)") as told:
            item(pytest_plugin.VectorItem, vector, pulls).runtest()
        assert "got -1" in str(told.value)

    def test_a_rule_that_follows_from_another_is_not_blamed(self, item):
        vector = next(v for v in vectors.layer("L1") if "just outside" in v.flags)
        stuck = {"sliding": False, "touching": True, "F_T": np.zeros(2), "s": np.zeros(2)}
        sticks = SimpleNamespace(contact_law=lambda **q: stuck)
        with pytest.raises(pytest_plugin.Failed) as told:
            item(pytest_plugin.VectorItem, vector, sticks).runtest()
        assert "sliding" in str(told.value) and "F_T" not in str(told.value)

    def rows(self, name, shift=0.0):
        """The shipped rows of a run, as a backend; the rates are off from the sixtieth row on."""
        columns = vectors.trajectory(name).columns
        W = columns["W_rad_s"].copy()
        W[60:] += shift
        out = {"t": columns["t_s"], "W": W, "x": columns["x_m"], "Lambda": columns["Lambda"].reshape(-1, 3, 3)}
        return SimpleNamespace(simulate=lambda problem: out)

    def test_a_run_passes_or_says_where_it_parts(self, item):
        name = "window_table_3_1_0500ms"
        item(pytest_plugin.RunItem, name, self.rows(name)).runtest()
        with pytest.raises(pytest_plugin.Failed, match="first divergent sample at ") as told:
            item(pytest_plugin.RunItem, name, self.rows(name, 1e-6)).runtest()
        t = vectors.trajectory(name).columns["t_s"][60]
        assert str(told.value).endswith(f" at {t:.6g} s") and name in str(told.value)

    def test_a_run_without_rows_says_so(self, item):
        silent = SimpleNamespace(simulate=lambda problem: {})
        with pytest.raises(pytest_plugin.Failed, match="gives no W") as told:
            item(pytest_plugin.RunItem, "drop", silent).runtest()
        assert "divergent sample" not in str(told.value)

    def test_a_run_that_a_profile_has_not_is_skipped(self, item):
        (name, *_) = [n for n in vectors.window_names() if "scheme" not in vectors.trajectory(n).meta["horizon_s"]]
        with pytest.raises(pytest.skip.Exception, match="is not given in the profile scheme"):
            item(pytest_plugin.RunItem, name, self.rows(name), "scheme").runtest()

    def test_an_effect_holds_is_skipped_or_is_named(self, item):
        claim = next(c for c in claims.claims() if c.effect == "gyro_scale")
        item(pytest_plugin.ClaimItem, (claims.judge_claim, claim)).runtest()
        plain = SimpleNamespace(sensor=lambda effect, parameters, t, crv_deg_s: {"crv_deg_s": crv_deg_s})
        with pytest.raises(pytest_plugin.Failed, match="gyro_scale: .*as if it were left out"):
            item(pytest_plugin.ClaimItem, (claims.judge_claim, claim), plain).runtest()
        with pytest.raises(pytest.skip.Exception, match="gyro_scale is not claimed"):
            item(
                pytest_plugin.ClaimItem, (claims.judge_claim, claim), SimpleNamespace(sensor=lambda *a: None)
            ).runtest()

    def test_the_message_alone_is_shown_where_a_vector_failed(self, item):
        made = item(pytest_plugin.ClaimItem, None)
        try:
            raise pytest_plugin.Failed("rule N1")
        except pytest_plugin.Failed:
            assert made.repr_failure(pytest.ExceptionInfo.from_current()) == "rule N1"
        assert made.reportinfo() == ("rockref vectors", None, "an item")


def test_properties_are_judged_in_double_precision_only():
    assert pytest_plugin.asked(NumpyEngine(), "L6", "float32") == []
    assert pytest_plugin.asked(NumpyEngine(), "LE", "scheme") == []
