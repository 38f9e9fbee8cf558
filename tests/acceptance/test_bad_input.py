"""What cannot be used, given on the command line: exit code 2, one error that names the place and the cure, no output.

The faults themselves, each with its code and its words, are those of the tests of the reader; here they are taken the
whole way of a user.
"""

import gzip
import shutil

import numpy as np
import pytest

from rockref import Model
from tests import command
from tests.unit.measure.checks.test_release import BAD as SIGNALS
from tests.unit.measure.conftest import HEAD, RUN, signal_500hz, table_text
from tests.unit.measure.reading.test_table import BAD as TABLES
from tests.unit.measure.test_experiment import TOML

GOOD = HEAD + RUN.format(id="01", file="run01.csv", use="fit", turned=0)
GOOD += RUN.format(id="02", file="run02.csv", use="holdout", turned=180)
RUN_1, RUN_2 = (table_text(*signal_500hz(seed, sign)) for seed, sign in ((0, 1), (1, -1)))


def written(folder, toml=GOOD, run=RUN_1):
    """A folder with an experiment of two runs, of which the first is `run`, text or bytes."""
    (folder / "experiment.toml").write_text(toml, encoding="utf-8")
    (folder / "run01.csv").write_bytes(run if isinstance(run, bytes) else run.encode())
    (folder / "run02.csv").write_text(RUN_2, encoding="utf-8")


def of_toml(case):
    old, new, code, *_ = TOML[case]
    return lambda folder: written(folder, GOOD.replace(old, new, 1)), code


def of_table(case):
    text, code, *_ = TABLES[case]
    return lambda folder: written(folder, run=text), code


def of_signal(case):
    change, header, code, *_ = SIGNALS[case]
    return lambda folder: written(folder, run=table_text(*change(*signal_500hz()), header)), code


def table(change):
    """The good run with its rows (time and three rates) changed."""
    t, crv = signal_500hz()
    return table_text(*change(t, crv))


def swapped_rows(t, crv):
    t = t.copy()
    t[[100, 101]] = t[[101, 100]]
    return t, crv


BYTES = {
    "not UTF-8": (RUN_1.encode().replace(b"\n0.1", b"\n\xff0.1", 1), "E-ENCODING"),
    "UTF-16": (RUN_1.encode("utf-16"), "E-ENCODING"),
    "empty": (b"", "E-EMPTY"),
    "gzip cut off": (gzip.compress(RUN_1.encode(), mtime=0)[:-20], "E-GZIP"),
    "gzip damaged": (gzip.compress(RUN_1.encode(), mtime=0)[:-8] + bytes(8), "E-GZIP"),
    "a bomb": (100 * gzip.compress(bytes(1_000_000), mtime=0), "E-SIZE"),
    "time runs back": (table(swapped_rows).encode(), "E-TIME"),
    "a gap": (table(lambda t, w: (np.where(t > 0.5, t + 0.2, t), w)).encode(), "E-GAP"),
    "another rate": (table(lambda t, w: (t * 0.5, w)).encode(), "E-RATE"),
}


def of_bytes(case):
    data, code = BYTES[case]
    return lambda folder: written(folder, run=data), code


def removed(name):
    def change(folder):
        written(folder)
        (folder / name).unlink()

    return change, "E-FILE"


CASES = {
    **{f"experiment.toml: {case}": of_toml(case) for case in TOML},
    **{f"table: {case}": of_table(case) for case in TABLES},
    **{f"signal: {case}": of_signal(case) for case in SIGNALS},
    **{f"bytes: {case}": of_bytes(case) for case in BYTES},
    "no experiment.toml": removed("experiment.toml"),
    "no run": removed("run01.csv"),
    "no folder": (lambda folder: folder.rmdir(), "E-FOLDER"),
}


def test_there_are_many():
    assert len(CASES) > 90


@pytest.mark.parametrize("case", CASES)
def test_a_bad_experiment_ends_with_2_and_leaves_nothing(tmp_path, capsys, case):
    spoil, code = CASES[case]
    folder, report = tmp_path / "experiment", tmp_path / "report"
    folder.mkdir()
    spoil(folder)
    before = sorted(folder.iterdir()) if folder.exists() else None
    status, out, err = command.run(capsys, "compare", folder, "--report", report)
    assert (status, out) == (2, "")
    # the lines of the message may be broken anywhere
    assert f"[{code}]" in "".join(err.split()) and "experiment" in "".join(err.split())
    assert "Traceback" not in err
    assert not report.exists()
    assert (sorted(folder.iterdir()) if folder.exists() else None) == before


@pytest.mark.parametrize(
    "words, code",
    [
        (("--step", "2e-4"), "E-STEP"),
        (("--step", "0"), "E-RANGE"),
        (("--step", "nan"), "E-RANGE"),
        (("--duration", "-1"), "E-RANGE"),
        (("--duration", "inf"), "E-RANGE"),
        (("--duration", "1e-6"), "E-DURATION"),
        (("--duration", "1e9"), "E-SIZE"),
        (("--duration", "1e12", "--rate", "0.001"), "E-SIZE"),
        (("--duration", "9e4", "--rate", "1e5"), "E-SIZE"),
        (("--step", "1e-300"), "E-SIZE"),
        (("--effect", "quadratic_drag:c=-1"), "E-RANGE"),
        (("--effect", "quadratic_dragg"), "E-EFFECT"),
        (("--effect", "quadratic_drag:d=1"), "E-KEY"),
        (("--effect", "quadratic_drag:c=lots"), "E-TYPE"),
        (("--engine", "fortran"), "E-ENGINE"),
        (("table_31",), "E-FILE"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else str(value),
)
def test_a_run_that_cannot_be_made_ends_with_2_and_leaves_nothing(tmp_path, capsys, words, code):
    status, out, err = command.run(capsys, "simulate", "-o", tmp_path / "out.csv", *words)
    assert (status, out) == (2, "")
    assert f"[{code}]" in "".join(err.split())
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "text, code",
    [
        ("[block]\nmas_kg = 54\n", "E-KEY"),
        ("[parameters]\nK_N_N_m = -6e7\n", "E-RANGE"),
        ("[parameters]\ndelta_long_m = [0, 0, 0, 1]\n", "E-RANGE"),
        ("[parameters]\ntheta_0_rad = 6.7\n", "E-TILT"),
        ("[parameters]\ntheta_0_rad = 0.2\n", "E-TILT"),
        ("[parameters]\nK_N_N_m = 6e13\n", "E-STEP"),
        ("[block\n", "E-TOML"),
        ("", None),
    ],
)
def test_a_model_that_is_none_ends_with_2_and_leaves_nothing(tmp_path, capsys, text, code):
    model, out_file = tmp_path / "model.toml", tmp_path / "out.csv"
    model.write_text(text)
    status, _, err = command.run(capsys, "simulate", model, "-o", out_file, "--duration", "0.002")
    if code is None:  # an empty file is Table 3.1
        assert status == 0
        assert out_file.exists()
    else:
        assert status == 2
        assert f"[{code}]" in "".join(err.split())
        assert "model.toml" in "".join(err.split())
        assert not out_file.exists()


def test_an_earlier_result_survives_a_failure(tmp_path, capsys):
    out_file = tmp_path / "out.csv"
    out_file.write_text("precious")
    assert command.run(capsys, "simulate", "-o", out_file, "--step", "2e-4")[0] == 2
    assert out_file.read_text() == "precious"


def test_a_model_may_lie_in_the_folder_of_its_output(tmp_path, capsys):
    Model.table_3_1().save(tmp_path / "model.toml")
    shutil.copy(tmp_path / "model.toml", tmp_path / "copy.toml")
    assert (
        command.run(capsys, "simulate", tmp_path / "model.toml", "-o", tmp_path / "o.csv", "--duration", "0.002")[0]
        == 0
    )
    assert (tmp_path / "model.toml").read_bytes() == (tmp_path / "copy.toml").read_bytes()
