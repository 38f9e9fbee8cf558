"""The response of Table 3.1 against its golden files: every value within its own error bar."""

import hashlib
import json
import platform

import numpy as np
import pytest

import rockref
from golden import make_table_3_1
from golden import table_3_1_files as files
from golden.bars import bar, down_to, rounded_up
from golden.make import main
from rockref.model.rotation import from_quaternion

NAMES = rockref.Model.table_3_1().body()[1].names


@pytest.fixture(scope="module", params=files.KINDS)
def kind(request):
    return request.param


@pytest.fixture(scope="module")
def golden(kind):
    return files.read(kind)


def columns_of(values, *names):
    at = {name: i for i, name in enumerate(files.columns(NAMES))}
    return values[:, [at[name] for name in names]]


class TestFiles:
    def test_digests(self):
        lines = (files.FOLDER / "MANIFEST.sha256").read_text().splitlines()
        listed = dict(reversed(line.split("  ")) for line in lines)
        there = {path.name for path in files.FOLDER.iterdir()} - {"MANIFEST.sha256"}
        assert set(listed) == there == {"schema.json", *(f"{k}{s}.csv.gz" for k in files.KINDS for s in ("", "_bars"))}
        for name, digest in listed.items():
            assert hashlib.sha256((files.FOLDER / name).read_bytes()).hexdigest() == digest, name

    def test_schema(self):
        described = files.described()
        assert described["schema"] == files.SCHEMA
        assert described["points"] == list(NAMES)
        model = rockref.Model.table_3_1()
        assert described["parameters"] == json.loads(json.dumps(vars(model.parameters)))
        assert (described["block"]["mass_kg"], described["g_m_s2"]) == (model.mass, model.g)
        assert (described["step_s"]["scheme"], described["step_s"]["converged"]) == (1e-5, 1.25e-8)

    def test_rows(self, golden):
        """2 kHz from release up to the second main impact, and no further."""
        assert golden.t == pytest.approx(np.arange(len(golden.t)) / files.OUTPUT_RATE, abs=1e-12)
        assert 1.335 <= golden.t[-1] <= 1.3358
        assert golden.values.shape == golden.bars.shape == (len(golden.t), 10 + 24)

    def test_a_value_is_what_a_gyroscope_and_a_plate_would_tell(self, golden):
        """Facts of physics in the files themselves, so that a mistake of the maker does not hide in them."""
        q = columns_of(golden.values, "qw", "qx", "qy", "qz")
        # files keep a digit beyond the bar
        assert np.max(np.abs(np.sum(q * q, axis=1) - 1)) < 1e-8
        forces = golden.values[:, 10:].reshape(len(golden.t), 8, 3)
        assert np.all(forces[..., 2] >= 0)
        mu = np.array([0.25] * 4 + [0.30] * 4)
        # each force is known to its bar: three of them, mu and the other two
        bars = np.max(golden.bars[:, 10:].reshape(len(golden.t), 8, 3), axis=-1)
        assert np.all(np.hypot(forces[..., 0], forces[..., 1]) <= mu * forces[..., 2] + 3 * bars)
        assert np.all(forces[golden.contact == 0] == 0)
        # spinning up: W is the rate of the rotation, by differences over two rows far from impacts
        rows = np.flatnonzero((golden.t > 0.05) & (golden.t < 0.4))
        Lambda = from_quaternion(q)
        turned = np.einsum("tji,tjk->tik", Lambda[rows - 1], Lambda[rows + 1])
        rate = np.degrees(turned[:, 2, 1] - turned[:, 1, 2]) / 2 * files.OUTPUT_RATE / 2
        # the second difference of a motion of 5 rad/s^3 over 1 ms is 1e-6 deg/s; the digits kept leave 1e-4
        assert np.max(np.abs(rate - golden.values[rows, 0])) < 2e-3

    def test_bars_are_small_beside_what_they_judge(self, kind, golden):
        """A bar that swallows a real difference judges nothing: half of them are far below any noise."""
        largest = np.max(np.abs(golden.values[:, :3]), axis=0)
        limit = {"scheme": 1e-9, "converged": 1e-3}[kind]
        assert np.all(np.median(golden.bars[:, :3], axis=0) <= limit * largest)
        assert np.all(golden.bars >= 0)

    def test_few_contacts_are_undecided(self, golden):
        assert np.mean(golden.contact < 0) < 1e-3


class TestResponse:
    @pytest.mark.parametrize("engine", ["numba", pytest.param("numpy", marks=pytest.mark.slow)])
    def test_the_scheme_at_the_step_of_the_source(self, engine):
        golden = files.read("scheme")
        response = rockref.simulate(files.problem(files.SCHEME_STEP), engine=engine)
        excess = np.abs(files.values(response) - golden.values) - golden.bars
        worst = np.unravel_index(np.argmax(excess), excess.shape)
        assert excess[worst] <= 0, (golden.t[worst[0]], files.columns(NAMES)[worst[1]], excess[worst])
        decided = golden.contact >= 0
        assert np.array_equal(response.anchored[decided], golden.contact[decided] == 1)

    @pytest.mark.parametrize("step", [1e-6, 4e-7, pytest.param(3.125e-8, marks=pytest.mark.slow)])
    def test_small_steps_tend_to_the_converged_solution(self, step):
        """Steps that the maker did not use: off in proportion to the step, as the bars say. Pose and crv."""
        golden = files.read("converged")
        response = rockref.simulate(files.problem(step), engine="numba")
        off, bars = np.abs(files.values(response) - golden.values)[:, :10], golden.bars[:, :10]
        assert np.all(off <= (1 + step / files.CONVERGED_STEP) * bars)

    def test_the_step_of_the_source_is_not_converged(self):
        """So the two kinds of files differ by far more than their bars, and neither may be judged by the other's."""
        scheme, converged = files.read("scheme"), files.read("converged")
        off = np.abs(scheme.values - converged.values)[:, :3]
        after = scheme.t > 0.55
        beyond = off > scheme.bars[:, :3] + converged.bars[:, :3]
        # before the first impact both resolve the swing; after it all but the crossings differ
        assert np.all(np.mean(beyond[after], axis=0) > 0.95)
        whole = np.sqrt(np.sum(off**2) / np.sum(converged.values[:, :3] ** 2))
        late = scheme.t > 1.32
        by_axis = np.sqrt(np.mean(off[late] ** 2, axis=0) / np.mean(converged.values[late, :3] ** 2, axis=0))
        assert whole == pytest.approx(0.0030, abs=1e-4)
        assert by_axis == pytest.approx([0.0002, 0.0131, 0.0145], abs=2e-4)


class TestBars:
    def test_a_bar_is_never_rounded_down(self):
        for size in (1e-9, 9.96e-9, 9.999e-9, 1.01e-9, 3.3333e-300, 0.5):
            assert size * (1 - 1e-9) <= float(rounded_up(size)) <= 1.1 * size

    def test_a_value_keeps_the_digits_that_its_bar_leaves(self):
        assert down_to(np.pi, 1e-3) == "3.14159e+00"
        assert down_to(np.pi, 0) == repr(np.pi)
        assert (down_to(0.0, 1e-3), down_to(0.0, 0)) == ("0", "0")
        for value, size in ((123.456789, 1e-5), (-1e-12, 1e-15), (5e4, 3.0), (1e-9, 1e-3)):
            assert abs(float(down_to(value, size)) - value) <= size / 10 + 1e-9 * (size > abs(value))

    def test_a_bar_covers_every_other_run(self):
        value = np.array([1.0, 0.0, 0.0])
        size = bar(value, [np.array([1.0, 0, 0]), np.array([1 + 1e-9, 0, 1e-12])])
        assert size[0] == pytest.approx(8e-9, rel=1e-6)
        assert size[1] == 0
        assert size[2] == pytest.approx(8e-12, rel=1e-6)


class TestMake:
    def test_an_unknown_part_is_named(self, capsys):
        assert main(["table_3_2"]) == 2
        assert "table_3_2 is none of small, effects, base, runs, fingerprints, table_3_1" in capsys.readouterr().err

    @pytest.mark.slow
    @pytest.mark.skipif(platform.machine() != "x86_64", reason="bars come from this extended precision")
    def test_the_maker_makes_the_same_bytes(self, tmp_path):
        """Three minutes: what lies there is what the maker makes, to the last digit."""
        make_table_3_1.make(tmp_path)
        assert (tmp_path / "MANIFEST.sha256").read_text() == (files.FOLDER / "MANIFEST.sha256").read_text()
