"""A sealed truth cannot be read by a glance, and not be changed unseen."""

import json

import pytest

from rockref.blind.cases import sealing
from rockref.blind.scoring.wilson import wilson

TRUTH = {"seed": 4, "cases": [{"name": "case-001", "effects": ["gyro_scale"]}]}


def test_a_truth_comes_back(tmp_path):
    digest = sealing.seal(tmp_path, TRUTH, {"case-001": {}}, "1")
    assert sealing.unseal(tmp_path) == (TRUTH, True)
    assert json.loads((tmp_path / sealing.MANIFEST).read_text())["truth_sha256"] == digest
    for path in tmp_path.iterdir():
        assert "gyro_scale" not in path.read_text()


def test_a_changed_truth_is_seen(tmp_path):
    sealing.seal(tmp_path, TRUTH, {}, "1")
    manifest = (tmp_path / sealing.MANIFEST).read_text()
    sealing.seal(tmp_path, TRUTH | {"seed": 5}, {}, "1")
    (tmp_path / sealing.MANIFEST).write_text(manifest)
    assert sealing.unseal(tmp_path)[1] is False


def test_the_salt_hides_a_truth_that_could_be_guessed(tmp_path):
    assert sealing.seal(tmp_path, TRUTH, {}, "1") != sealing.seal(tmp_path, TRUTH, {}, "1")


@pytest.mark.parametrize(
    ("hits", "n", "low", "high"),
    # The roots of (p - hits/n)^2 = z^2 p (1 - p)/n, z = 1.959964.
    [(0, 24, 0.0, 0.13797), (9, 10, 0.59585, 0.98212), (0, 0, 0.0, 1.0)],
)
def test_wilson(hits, n, low, high):
    assert wilson(hits, n) == pytest.approx((low, high), abs=2e-5)


def test_wilson_is_the_solution_of_its_quadratic():
    from rockref.blind.scoring.wilson import Z

    for hits, n in ((1, 7), (29, 31), (60, 60)):
        for p in wilson(hits, n):
            assert (p - hits / n) ** 2 == pytest.approx(Z * Z * p * (1 - p) / n, abs=1e-12)
