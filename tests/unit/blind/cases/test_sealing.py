"""A sealed truth cannot be read by a glance, and not be changed unseen."""

import json

from rockref.blind.cases import sealing

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
