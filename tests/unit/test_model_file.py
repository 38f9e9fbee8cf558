"""model.toml: what is written reads back, and what cannot be read says where and why."""

import os

import numpy as np
import pytest

from rockref import InputError, Model
from rockref.model.parameters import chromosome_54
from rockref.model.problem import ContactPoints
from rockref.model_file import LARGEST_FILE, LONGEST_LINE
from tests import physics

HEAD = "format = 1\n"
SIX = ("K_N_N_m", "K_T_N_m", "C_N_N_s_m", "C_T_N_s_m", "mu_0", "mu")
#: Properties of eight points, and two points of one's own, good but for what a test changes.
EIGHT = "[properties]\n" + "".join(f"{key} = [1{7 * ', 1'}]\n" for key in SIX)
TWO = "[points]\nset = 'custom'\n[custom_points]\nnames = ['a', 'b']\nP_m = [0.1, 0, -0.3, -0.1, 0, -0.3]\n"
TWO += "".join(f"{key} = [1, 1]\n" for key in SIX)


def loaded(tmp_path, text):
    path = tmp_path / "model.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return Model.load(path)


def refused(tmp_path, text):
    with pytest.raises(InputError) as error:
        loaded(tmp_path, text)
    return error.value


class TestReading:
    def test_an_empty_file_is_table_3_1(self, tmp_path):
        assert loaded(tmp_path, "") == Model()

    def test_a_byte_order_mark_is_no_harm(self, tmp_path):
        assert loaded(tmp_path, "\ufeff[block]\nmass_kg = 60\n").mass == 60.0

    def test_whole_numbers_are_numbers(self, tmp_path):
        assert loaded(tmp_path, "[parameters]\nK_N_N_m = 70000000\n").parameters.K_N == 7e7

    def test_notes_are_kept(self, tmp_path):
        model = loaded(tmp_path, '[origin]\nsource = "fit"\n[uncertainty]\nK_N_N_m = 1e6\n')
        assert model.origin == {"source": "fit"}
        assert model.uncertainty == {"K_N_N_m": 1e6}


class TestRefusals:
    @pytest.mark.parametrize(
        "text, code, where",
        [
            ("[block]\nmass = 54\n", "E-KEY", "[block]"),
            ("[blok]\nmass_kg = 54\n", "E-KEY", "model.toml"),
            ("[parameters]\nK_N = 6e7\n", "E-KEY", "[parameters]"),
            ("format = 2\n", "E-FORMAT", "format"),
            ("[block]\nmass_kg = '54'\n", "E-TYPE", "mass_kg"),
            ("[block]\nmass_kg = true\n", "E-TYPE", "mass_kg"),
            ("[block]\nmass_kg = [54]\n", "E-TYPE", "mass_kg"),
            ("[block]\nmass_kg = nan\n", "E-TYPE", "mass_kg"),
            ("[block]\nmass_kg = inf\n", "E-TYPE", "mass_kg"),
            ("[block]\nmass_kg = 1" + 400 * "0" + "\n", "E-TYPE", "mass_kg"),
            ("[block]\nmass_kg = -54\n", "E-RANGE", "mass"),
            ("[block]\ninertia_kg_m2 = [1, 2, 3]\n", "E-TYPE", "inertia_kg_m2"),
            ("[block]\ninertia_kg_m2 = [1, 0, 0, 0, 1, 0, 0, 0, -1]\n", "E-RANGE", "inertia"),
            ("[parameters]\nK_N_N_m = -6e7\n", "E-RANGE", "K_N"),
            ("[parameters]\ndelta_long_m = [0, 0, 0]\n", "E-TYPE", "delta_long_m"),
            ("[parameters]\ndelta_long_m = [0, 0, 0, 1]\n", "E-RANGE", "[parameters] delta_long_m[3]"),
            ("[parameters]\ndelta_diag_m = 6.0\n", "E-RANGE", "delta_diag"),
            ("[parameters]\nmu_ext = -0.25\n", "E-RANGE", "mu_ext"),
            ("[points]\nset = 'six'\n", "E-KEY", "points"),
            ("[points]\nset = 6\n", "E-KEY", "points"),
            ("[points]\nset = 'custom'\n", "E-KEY", "custom_points"),
            ("[points]\nfoot_radius_m = -1e-3\n", "E-RANGE", "foot_radius"),
            ("[properties]\nK_N_N_m = [1, 1, 1, 1, 1, 1, 1, 1]\n", "E-KEY", "[properties]"),
            ("[custom_points]\nnames = []\n", "E-TYPE", "names"),
            ("[custom_points]\nnames = ['a']\nP_m = [0, 0]\n", "E-TYPE", "P_m"),
            ("[effects.unheard_of]\nx = 1\n", "E-", "unheard_of"),
            ("[effects]\nquadratic_drag = 3\n", "E-", "quadratic_drag"),
            ("[effects.quadratic_drag]\nmist = 1\n", "E-", "quadratic_drag"),
            ("block = 3\n", "E-TYPE", "block"),
            ("[block\n", "E-TOML", "model.toml"),
            ("[block]\nmass_kg = 54\nmass_kg = 55\n", "E-TOML", "model.toml"),
            (5000 * "[" + "\n", "E-TOML", "model.toml"),
            (b"[block]\n# \xff\n", "E-ENCODING", "byte 0xff in line 2"),
            ("[parameters]\ntheta_0_rad = 0.2\n", "E-TILT", "[parameters] theta_0_rad"),
            ("[parameters]\ntheta_0_rad = 6.7\n", "E-TILT", "[parameters] theta_0_rad"),
            ("[block]\nheight_m = 1.2\n", "E-TILT", "[parameters] theta_0_rad"),
            ("[parameters]\nK_T_N_m = 0\n", "E-RANGE", "[parameters] K_T_N_m"),
            ("[parameters]\nmu_int = 50\n", "E-RANGE", "[parameters] mu_int"),
            ("[parameters]\ndelta_long_m = [0.010, 0.040, 0.092, 0.058]\n", "E-RANGE", "delta_long_m[2]"),
            ("[block]\nwidth_m = 0.0001\n", "E-RANGE", "[block] width_m"),
            ("[block]\nheight_m = 688\n", "E-RANGE", "[block] height_m"),
            ("[points]\nfoot_radius_m = 5\n", "E-RANGE", "[points] foot_radius_m"),
            (EIGHT.replace("K_T_N_m = [1", "K_T_N_m = [-1"), "E-RANGE", "[properties] K_T_N_m of point 1ext"),
            (EIGHT.replace("mu_0 = [1", "mu_0 = [0.5"), "E-RANGE", "[properties] mu_0"),
            (EIGHT.replace("mu_0 = [1", "mu_0 = [50"), "E-RANGE", "[properties] mu_0"),
            (TWO.replace("K_N_N_m = [1", "K_N_N_m = [-1"), "E-RANGE", "[custom_points] K_N_N_m of point a"),
            (TWO.replace("mu = [1, 1", "mu = [1, 2"), "E-RANGE", "[custom_points] mu_0"),
            (TWO.replace("'b'", "'a'"), "E-KEY", "'a' is there twice"),
            (TWO.replace("-0.3", "0.3"), "E-RANGE", "[custom_points] P_m"),
            (b"\x00\x01", "E-TOML", "model.toml"),
        ],
        ids=lambda value: str(value)[:40],
    )
    def test_says_code_and_place(self, tmp_path, text, code, where):
        error = refused(tmp_path, text)
        assert error.code.startswith(code)
        assert "model.toml" in error.where
        assert where in error.where or where in error.what
        assert error.cure

    def test_the_nearest_key_is_offered(self, tmp_path):
        assert "mass_kg" in refused(tmp_path, "[block]\nmass_gk = 54\n").cure

    def test_a_file_that_is_none(self, tmp_path):
        for path in (tmp_path / "missing.toml", tmp_path):
            with pytest.raises(InputError) as error:
                Model.load(path)
            assert error.value.code == "E-FILE"

    def test_a_pipe_is_not_waited_for(self, tmp_path):
        os.mkfifo(tmp_path / "model.toml")
        with pytest.raises(InputError, match="not a regular file"):
            Model.load(tmp_path / "model.toml")

    def test_a_line_that_would_take_minutes_is_refused(self, tmp_path):
        """TOML's time grows with the square of the length of a dotted key: 50 000 characters took three minutes."""
        error = refused(tmp_path, HEAD + ".".join(["a"] * 25_000) + " = 1\n")
        assert error.code == "E-TOML" and "line 2" in error.what

    def test_a_file_that_is_too_large_is_not_read(self, tmp_path):
        assert refused(tmp_path, b"#" * (LARGEST_FILE + 2)).code == "E-SIZE"

    @pytest.mark.parametrize("text", [EIGHT, TWO])
    def test_what_the_tests_change_is_good(self, tmp_path, text):
        assert loaded(tmp_path, text).check() is None

    @pytest.mark.filterwarnings("error")
    def test_a_negative_stiffness_is_no_warning(self, tmp_path):
        assert refused(tmp_path, TWO.replace("K_N_N_m = [1", "K_N_N_m = [-1")).code == "E-RANGE"

    def test_corners_above_and_below_are_a_body(self, tmp_path):
        """A body that is thrown has them all round."""
        assert loaded(tmp_path, TWO.replace("-0.1, 0, -0.3", "-0.1, 0, 0.3")).custom_points.n == 2


class TestWriting:
    @pytest.mark.parametrize("change", [{"K_N": np.nan}, {"mass": -1.0}, {"delta_long": (0, 0, np.inf, 0)}], ids=str)
    def test_what_cannot_be_computed_with_is_not_written(self, tmp_path, change):
        with pytest.raises(InputError):
            Model().replace(**change).save(tmp_path / "m.toml")
        assert not list(tmp_path.iterdir())

    def test_a_folder_that_is_missing_leaves_nothing(self, tmp_path):
        with pytest.raises(InputError) as error:
            Model().save(tmp_path / "nowhere" / "model.toml")
        assert error.value.code == "E-WRITE"
        assert list(tmp_path.iterdir()) == []

    def test_fifty_four_genes(self, tmp_path):
        model = Model.from_chromosome_54(chromosome_54(Model().parameters, 54.0) * 1.01)
        model.save(tmp_path / "m.toml")
        back = Model.load(tmp_path / "m.toml")
        for key, values in model.properties.items():
            assert np.array_equal(back.properties[key], values), key

    def test_custom_points(self, tmp_path):
        own = physics.points(np.random.default_rng(0).normal(size=(3, 3)), radius=1e-3)
        Model(points="custom", custom_points=own, inertia=np.diag([1.0, 2, 3])).save(tmp_path / "m.toml")
        back = Model.load(tmp_path / "m.toml")
        for key in ("P", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu", "radius"):
            assert np.array_equal(getattr(back.custom_points, key), getattr(own, key)), key
        assert back.custom_points.names == own.names
        assert np.array_equal(back.inertia, np.diag([1.0, 2, 3]))


def test_hundreds_of_points_are_saved_in_lines_that_can_be_read(tmp_path):
    law = Model.table_3_1()
    few = law.body_without_effects()[1]
    n = 400
    values = {key: np.full(n, getattr(few, key)[0]) for key in ("K_N", "K_T", "C_N", "C_T", "mu_0", "mu")}
    P = np.column_stack([np.linspace(-0.05, 0.05, n) / 3, np.linspace(-0.05, 0.05, n) / 7, np.full(n, -1 / 3)])
    many = ContactPoints(P=P, radius=None, names=tuple(f"p{i}" for i in range(n)), **values)
    law.replace(points="custom", custom_points=many).save(tmp_path / "model.toml")
    assert np.array_equal(Model.load(tmp_path / "model.toml").custom_points.P, P)


def test_a_note_that_could_not_be_read_back_is_not_written(tmp_path):
    with pytest.raises(InputError, match="E-TOML"):
        Model(origin={"note": "x" * (LONGEST_LINE + 1)}).save(tmp_path / "model.toml")
    assert not (tmp_path / "model.toml").exists()
