"""Folders of tests on a shake table: units, outcomes, records, and what is refused."""

import numpy as np
import pytest

from rockref.measure import load_experiment
from rockref.model.errors import InputError
from rockref.shake.experiment import is_shaken_folder, load_shaken

TOML = 'name = "table"\nkind = "shaken"\n[draws]\nheading_deg = 30\nfeet_mm = 0.05\n'
RECORD = "t [s],ax [m/s2],ay [m/s2]\n0.0,0,0\n0.1,3,4\n0.2,0,0\n"


def written(folder, table, toml=TOML):
    (folder / "experiment.toml").write_text(toml)
    (folder / "tests.csv").write_text(table)
    (folder / "a.csv").write_text(RECORD)
    return folder


def test_units_become_si_and_sizes_come_from_the_records(tmp_path):
    table = "record,factor,rotate_deg,fell,tilt_deg,slide_mm,p_mine\na.csv,1,0,0,10,2,0.25\na.csv,2,90,True,,,0.75\n"
    e = load_shaken(written(tmp_path, table))
    assert is_shaken_folder(tmp_path) and e.motion.tolist() == ["a.csv", "a.csv"] and e.fell.tolist() == [0.0, 1.0]
    assert e.maxima["tilt"][0] == pytest.approx(np.radians(10)) and np.isnan(e.maxima["tilt"][1])
    assert e.maxima["slide"][0] == pytest.approx(2e-3)
    # A triangle of 0.2 s and 5 m/s2: PGV is half their product, 0.5 m/s; the second test is twice as large.
    assert e.sizes == pytest.approx(np.array([[5.0, 0.5], [10.0, 1.0]]))
    assert e.motions[1].a[1] == pytest.approx([-8.0, 6.0, 0.0])
    assert (e.draws.heading, e.draws.feet, e.draws.friction) == (30.0, 5e-5, 0.0)
    assert e.stated["mine"].tolist() == [0.25, 0.75]
    assert all(notice.code.startswith("W-RECORD") for notice in e.notices)


def test_a_table_without_records_has_its_own_sizes(tmp_path):
    e = load_shaken(written(tmp_path, "motion,pga_g,pgv_cm_s,fell,odd\nx,0.5,20,1,?\ny,0.1,10,0,?\n"))
    assert e.motions is None and e.sizes == pytest.approx(np.array([[0.5 * 9.81, 0.2], [0.981, 0.1]]))
    assert [notice.code for notice in e.notices] == ["W-COLUMN-UNREAD"]


@pytest.mark.parametrize(
    "table, code",
    [
        ("motion,fell\nx,2\n", "E-RANGE"),
        ("motion,fell\nx,yes\n", "E-NUMBER"),
        ("motion,fell\n", "E-SIZE"),
        ("fell\n1\n", "E-COLUMN-MISSING"),
        ("motion,pga_g\nx,1\n", "E-COLUMN-MISSING"),
        ("motion,fell,tilt_deg,tilt_rad\nx,1,1,1\n", "E-COLUMN-TWICE"),
        ("record,fell\n../a.csv,1\n", "E-PATH"),
        ("record,fell\nb.csv,1\n", "E-FILE"),
    ],
)
def test_what_is_no_table_of_tests_is_refused(tmp_path, table, code):
    with pytest.raises(InputError) as caught:
        load_shaken(written(tmp_path, table))
    assert caught.value.code == code


def test_unknown_keys_and_other_readers_are_told(tmp_path):
    with pytest.raises(InputError, match="E-UNIT"):
        load_shaken(written(tmp_path, "motion,fell\nx,1\n", TOML.replace("heading_deg", "heading")))
    with pytest.raises(InputError, match="E-KIND"):
        load_experiment(written(tmp_path, "motion,fell\nx,1\n"))
