"""Experiment folders: good ones load whole, bad ones say why not, held-out files stay closed."""

import hashlib
import math
import os
import shutil

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.signals.noise import noise_floor
from rockref.measure.signals.repeatability import repeat_groups
from rockref.model import storage
from rockref.model.errors import InputError
from tests.shipped import two_runs


def rewrite(folder, old, new, count=1):
    path = folder / "experiment.toml"
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, count))


def refused(folder, **arguments):
    with pytest.raises(InputError) as caught:
        load_experiment(folder, **arguments)
    return caught.value


def test_good_experiment_loads_whole(folder):
    experiment = load_experiment(folder)
    assert (experiment.name, experiment.kind, experiment.baseline) == ("made", "release", "eight_points")
    assert (experiment.mass, experiment.width, experiment.height) == (54.0, 0.1, 0.688)
    assert experiment.tilt_uncertainty == 0.0014
    assert experiment.gyro.sample_rate == 500.0
    assert experiment.gyro.noise == pytest.approx(math.radians(0.05), rel=1e-15)
    assert experiment.gyro.range is None
    assert [run.id for run in experiment.fit_runs()] == ["01"]
    assert [run.id for run in experiment.holdout_runs()] == ["02"]
    run = experiment.run("02")
    assert run.block_turned == pytest.approx(math.pi)
    assert run.crv.shape == (len(run.t), 3)
    assert run.crv[:, 0].min() == pytest.approx(-0.65, abs=0.01)
    assert run.pose is None and run.filled == ()
    assert experiment.notices == ()


def test_arrays_cannot_be_written(folder):
    run = load_experiment(folder).runs[0]
    with pytest.raises(ValueError, match="read-only"):
        run.crv[0, 0] = 1.0


@pytest.mark.parametrize("number", range(1, 12))
def test_shipped_experiments_load_without_remark(shipped, number):
    experiment = load_experiment(shipped / f"mystery-{number:02d}", uses=("fit",))
    assert experiment.notices == ()
    assert [run.loaded for run in experiment.runs] == [True, True, False, True, False, True]
    assert [len(group) for group in repeat_groups(experiment.runs)] == [2]
    assert all(run.crv.shape == (5000, 3) for run in experiment.fit_runs())


def test_held_out_files_are_not_opened(folder, monkeypatch):
    (folder / "run02.csv").write_bytes(b"\xff rubbish that no reader accepts")
    opened = []
    real = os.open
    monkeypatch.setattr(
        storage.os, "open", lambda path, flags: opened.append(os.path.basename(path)) or real(path, flags)
    )
    experiment = load_experiment(folder, uses=("fit",))
    assert opened == ["experiment.toml", "run01.csv"]
    held = experiment.run("02")
    assert (held.loaded, held.t, held.crv, held.sha256) == (False, None, None, None)
    assert "run02.csv" not in experiment.digests
    assert refused(folder).code == "E-ENCODING"


def test_digest_follows_the_files(folder):
    before = load_experiment(folder)
    assert before.digests["run01.csv"] == hashlib.sha256((folder / "run01.csv").read_bytes()).hexdigest()
    assert load_experiment(folder).digest == before.digest
    assert load_experiment(folder, uses=("fit",)).digest != before.digest
    with (folder / "run01.csv").open("a") as stream:
        stream.write("1.500,1,0,0\n")
    assert load_experiment(folder).digest != before.digest


def test_folder_may_move(folder, tmp_path_factory):
    moved = tmp_path_factory.mktemp("moved") / "ä b"
    shutil.copytree(folder, moved)
    assert load_experiment(moved).digest == load_experiment(folder).digest


TOML = {
    "name missing": ('name = "made"\n', "", "E-KEY-MISSING", "experiment.toml", "name"),
    "name is a path": ('"made"', '"../made"', "E-NAME", "key name", "'../made'"),
    "kind unknown": ('"release"', '"shove"', "E-CHOICE", "key kind", "release, toss"),
    "baseline unknown": ('"eight_points"', '"eight_point"', "E-CHOICE", "key baseline", "Did you mean eight_points?"),
    "block missing": ("[block]", "[blok]", "E-KEY-UNKNOWN", "'blok'", "Did you mean block?"),
    "block not a table": ("[block]", "block = 3\n[other]", "E-KEY-UNKNOWN", "'other'", "not known"),
    "mass as text": ("mass_kg = 54.0", 'mass_kg = "54"', "E-TYPE", "[block], key mass_kg", "not a number"),
    "mass negative": ("mass_kg = 54.0", "mass_kg = -54.0", "E-RANGE", "key mass_kg", "-54.0 is outside"),
    "mass infinite": ("mass_kg = 54.0", "mass_kg = inf", "E-RANGE", "key mass_kg", "inf"),
    "mass a date": ("mass_kg = 54.0", "mass_kg = 2024-01-01", "E-TYPE", "key mass_kg", "2024-01-01"),
    "mass huge": ("mass_kg = 54.0", "mass_kg = 0x" + "f" * 900, "E-RANGE", "key mass_kg", "forty digits"),
    "mass in grams": ("mass_kg = 54.0", "mass_g = 54000", "E-UNIT", "'mass_g'", "mass_kg"),
    "height twice": ("height_m", "height_mm = 688\nheight_m", "E-KEY-TWICE", "[block]", "height_m and height_mm"),
    "width in millimetres": ("width_m = 0.100", "width_m = 100.1", "E-RANGE", "key width_m", "100.1"),
    "rate zero": (
        "sample_rate_hz = 500",
        "sample_rate_hz = 0",
        "E-RANGE",
        "[gyro], key sample_rate_hz",
        "0 is outside",
    ),
    "rate missing": ("sample_rate_hz = 500\n", "", "E-KEY-MISSING", "[gyro]", "sample_rate_hz = 1000"),
    "key misspelt": ("bandwidth_hz", "bandwith_hz", "E-KEY-UNKNOWN", "'bandwith_hz'", "Did you mean bandwidth_hz?"),
    "no run": ("[[run]]", "[[runs]]", "E-KEY-UNKNOWN", "'runs'", "Did you mean run?"),
    "use unknown": ('use = "fit"', 'use = "train"', "E-CHOICE", "run[1], key use", "fit, holdout"),
    "no fit run": ('use = "fit"', 'use = "holdout"', "E-NO-FIT", "[[run]]", "no run is marked fit"),
    "id twice": ('id = "02"', 'id = "01"', "E-RUN-TWICE", "run[2], key id", "also that of run[1]"),
    "file twice": ('"run02.csv"', '"run01.csv"', "E-RUN-TWICE", "run[2], key file", "also that of run[1]"),
    "same file by another name": ('"run02.csv"', '"./run01.csv"', "E-RUN-TWICE", "run[2], key file", "run[1]"),
    "id a number": ('id = "01"', "id = 1", "E-TYPE", "run[1], key id", "1 is not text"),
    "id empty": ('id = "01"', 'id = ""', "E-NAME", "run[1], key id", "''"),
    "file missing": ('"run02.csv"', '"run03.csv"', "E-FILE", "run[2], key file", "'run03.csv'"),
    "file above": ('"run02.csv"', '"../run02.csv"', "E-PATH", "run[2], key file", "out of the folder"),
    "file absolute": ('"run02.csv"', '"/etc/passwd.csv"', "E-PATH", "run[2], key file", "out of the folder"),
    "file of another kind": ('"run02.csv"', '"experiment.toml"', "E-PATH", "run[2], key file", ".csv"),
    "file with a zero": ('"run02.csv"', '"run02\\u0000.csv"', "E-PATH", "run[2], key file", ".csv"),
    "file very long": ('"run02.csv"', '"' + "a" * 400 + '.csv"', "E-PATH", "run[2], key file", "aaa..."),
    "tilt in degrees": ("release_tilt_rad = 0.117", "release_tilt_rad = 6.70", "E-TILT", "run[1]", "degrees?"),
    "tilt beyond tipping": ("release_tilt_rad = 0.117", "release_tilt_rad = 0.15", "E-TILT", "run[1]", "0.144338"),
    "tilt negative": ("release_tilt_rad = 0.117", "release_tilt_rad = -0.117", "E-TILT", "run[1]", "positive"),
    "tilt not a number": ("release_tilt_rad = 0.117", "release_tilt_rad = nan", "E-RANGE", "run[1]", "nan"),
    "tilt huge": ("release_tilt_rad = 0.117", "release_tilt_rad = 0x" + "f" * 900, "E-RANGE", "run[1]", "forty digits"),
    "turned by 90": ("block_turned_deg = 0", "block_turned_deg = 90", "E-TURNED", "run[1]", "90 degrees"),
    "turned in radians": ("block_turned_deg = 180", "block_turned_deg = 3.1416", "E-TURNED", "run[2]", "3.1416"),
    "run not a table": ("[[run]]", "[run]", "E-TOML", "experiment.toml", "not TOML"),
}


@pytest.mark.parametrize("case", TOML)
def test_bad_experiment_is_refused_by_key(folder, case):
    old, new, code, where, words = TOML[case]
    rewrite(folder, old, new)
    error = refused(folder)
    assert error.code == code
    assert str(folder / "experiment.toml") in error.where and where in error.where
    assert words in str(error)


def test_links_may_not_lead_out(folder, tmp_path_factory):
    outside = tmp_path_factory.mktemp("outside") / "run02.csv"
    shutil.move(folder / "run02.csv", outside)
    (folder / "run02.csv").symlink_to(outside)
    error = refused(folder)
    assert (error.code, "out of the folder" in error.what) == ("E-PATH", True)
    (folder / "run02.csv").unlink()
    (folder / "run02.csv").symlink_to(folder / "run02.csv")
    assert refused(folder).code == "E-FILE"
    (folder / "run02.csv").unlink()
    (folder / "sub").mkdir()
    shutil.copy(outside, folder / "sub" / "run02.csv")
    (folder / "run02.csv").symlink_to(folder / "sub" / "run02.csv")
    assert load_experiment(folder).run("02").loaded


def test_folder_that_is_none(folder, tmp_path):
    assert refused(folder / "experiment.toml").code == "E-FOLDER"
    assert refused(tmp_path / "no").code == "E-FOLDER"
    (folder / "experiment.toml").unlink()
    error = refused(folder)
    assert (error.code, "experiment.toml" in error.where) == ("E-FILE", True)


def test_unknown_use_asked_for(folder):
    error = refused(folder, uses=("fit", "hold"))
    assert (error.code, error.where) == ("E-CHOICE", "argument uses")


def test_faults_of_a_table_name_the_run(folder):
    path = folder / "run01.csv"
    path.write_text(path.read_text().replace("\n0.010000,", "\n0.01oooo,"))
    error = refused(folder)
    assert error.code == "E-NUMBER"
    assert error.where == f"{path}, line 7, column t_s"


def test_copies_and_missing_holdout_are_said(folder):
    rewrite(folder, 'use = "holdout"', 'use = "fit"')
    rewrite(folder, "block_turned_deg = 180", "block_turned_deg = 0")
    shutil.copy(folder / "run01.csv", folder / "run02.csv")
    assert {n.code for n in load_experiment(folder).notices} == {"W-NO-HOLDOUT", "W-SAME-DATA"}


def test_a_pose_that_is_half_there_is_said(folder):
    path = folder / "run01.csv"
    head, *rows = path.read_text().splitlines()
    path.write_text("\n".join([f"{head},x_m,qw", *(f"{row},0.1,1" for row in rows)]) + "\n")
    experiment = load_experiment(folder)
    assert experiment.run("01").pose is None
    (said,) = experiment.notices
    assert (said.code, said.where) == ("W-POSE", str(path))
    assert "without y, z, qx, qy, qz" in said.what


def test_toss_has_poses_instead_of_a_release(folder):
    text = 'name = "toss"\nkind = "toss"\nbaseline = "eight_points"\n'
    text += "[block]\nmass_kg = 0.37\nwidth_mm = 104.8\nheight_mm = 104.8\n"
    text += '[[run]]\nid = "0"\nfile = "0.csv"\nuse = "fit"\n'
    (folder / "experiment.toml").write_text(text)
    (folder / "0.csv").write_text("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,1,2,3,1,0,0,0\n0.007,1,2,3,0,1,0,0\n")
    experiment = load_experiment(folder)
    assert experiment.gyro is None and experiment.tilt_uncertainty is None
    assert experiment.width == pytest.approx(0.1048)
    run = experiment.runs[0]
    assert run.crv is None and run.release_tilt is None
    assert np.array_equal(run.pose[1], [1, 2, 3, 0, 1, 0, 0])


def test_a_run_that_is_not_there_is_named_with_those_that_are(tmp_path):
    experiment = load_experiment(two_runs(tmp_path / "e"))
    assert experiment.run("03").use == "holdout"
    with pytest.raises(InputError, match=r"there is no run '99'. There are 01, 03. \[E-RUN\]"):
        experiment.run("99")


def test_a_folder_of_tosses_is_told_from_releases(tmp_path):
    (tmp_path / "tosses.csv").write_text("", encoding="utf-8")
    with pytest.raises(InputError, match="holds tosses; this is not for tosses"):
        load_experiment(tmp_path)


@pytest.mark.parametrize("said", ["[release]\ntilt_uncertainty_rad = 0.0", "[release]"])
def test_a_tilt_of_which_nobody_says_how_far_it_is_off_is_remarked_on(folder, said):
    stated = (folder / "experiment.toml").read_text(encoding="utf-8").split("tilt_uncertainty_rad = ")[1].split()[0]
    rewrite(folder, f"[release]\ntilt_uncertainty_rad = {stated}", said)
    (notice,) = load_experiment(folder, uses=()).notices
    assert notice.code == "W-TILT" and "0.0014 rad off" in notice.what


@pytest.mark.parametrize(
    "old, new",
    [
        ("mass_kg = 54.0", "mass_kg = 54000.0"),
        ("mass_kg = 54.0", "mass_kg = 0.054"),
        ("height_m = 0.688", "height_m = 0.1"),
    ],
)
def test_a_block_of_no_matter_is_remarked_on(folder, old, new):
    """Grams called kilograms, kilograms called grams; or the width typed again for the height: 54 kg in a litre."""
    rewrite(folder, old, new)
    notices = load_experiment(folder, uses=()).notices
    assert [n.code for n in notices] == ["W-DENSITY"]
    assert notices[0].where == f"{folder / 'experiment.toml'}, [block]"


def test_refused_tilts_and_turns_name_the_key_as_it_is_written(folder):
    rewrite(folder, "block_turned_deg = 180", "block_turned_deg = 90")
    assert refused(folder).where.endswith("run[2], key block_turned_deg")
    rewrite(folder, "release_tilt_rad = 0.117", "release_tilt_deg = 12")
    assert refused(folder).where.endswith("run[1], key release_tilt_deg")


def test_what_is_missing_is_said_at_once(folder):
    """Every missing key, with a line to copy; the page of a beginner needs no thirteen tries."""
    (folder / "experiment.toml").write_text('kind = "release"\n[gyro]\nnoise_deg_s = 0.05\n[[run]]\nid = "01"\n')
    error = refused(folder)
    assert error.code == "E-KEY-MISSING" and "10 keys" in error.what
    for line in ('name = "my_block"', "[block]", "mass_kg = 54.0", "sample_rate_hz = 1000", 'file = "run01.csv"'):
        assert line in error.cure.splitlines()[0] or f"  {line}" in error.cure.splitlines()


def test_a_misspelt_key_is_told_before_it_is_missed(folder):
    text = (folder / "experiment.toml").read_text()
    (folder / "experiment.toml").write_text(text.replace("height_m", "hieght_m").replace('name = "made"', ""))
    assert refused(folder).code == "E-KEY-UNKNOWN"


def test_an_open_data_sheet_is_measured_or_taken_by_default(folder):
    """Noise of the record, three tenths of the sample rate, and a remark on each; the release may be absent."""
    stated = load_experiment(folder)
    text = (folder / "experiment.toml").read_text()
    for line in ("noise_deg_s = 0.05\n", "bandwidth_hz = 200\n", "resolution_deg_s = 0.01\n", "[release]\n"):
        assert line in text
        text = text.replace(line, "")
    (folder / "experiment.toml").write_text(text.replace("tilt_uncertainty_rad = 0.0014\n", ""))
    found = load_experiment(folder)
    assert found.gyro.bandwidth == pytest.approx(0.3 * found.gyro.sample_rate)
    # The calm tenth of a record gives its noise to a fifth.
    assert found.gyro.noise == pytest.approx(noise_floor(stated.runs[0].t, stated.runs[0].crv).sigma.mean(), rel=1e-9)
    assert [n.code for n in found.notices if n.code in ("W-DEFAULT", "W-TILT")] == ["W-TILT", "W-DEFAULT", "W-DEFAULT"]


def test_logs_without_an_experiment_suggest_the_command(folder):
    (folder / "experiment.toml").unlink()
    assert "rockref new" in refused(folder).cure
    with pytest.raises(InputError, match="rockref new"):
        load_experiment(folder / "run01.csv")
