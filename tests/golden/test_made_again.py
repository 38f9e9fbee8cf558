"""Golden files are what their makers make: to the byte, on a machine whose longdouble has 64 bits, with gcc.

Where a library of others computes, to the bars: see `OF_LIBRARIES`.

Ten minutes of processor time; `make golden` does the same and says what differs.
"""

import json
import shutil

import numpy as np
import pytest

from golden.generator import base_motion, effects, fingerprints, make, small_layers, trajectories
from golden.make import table_3_1

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(np.finfo(np.longdouble).nmant + 1 < 64, reason="longdouble has fewer than 64 bits here"),
    pytest.mark.skipif(shutil.which("gcc") is None, reason="no gcc on this machine"),
]


def there(name: str) -> bytes:
    return (make.FOLDER / name).read_bytes()


@pytest.mark.parametrize("layer", small_layers.LAYERS)
def test_vectors_of_rules(layer):
    refused: list[str] = []
    assert small_layers.written(small_layers.document(layer, refused)) == there(f"{layer}.json")


#: Effects whose vectors are filtered by SciPy, which rounds otherwise from one version or processor to another: two
#: machines made them 6e-13 deg/s apart, with bars of 1.5e-12 and 2.4e-12, which are those of one ulp in the record.
OF_LIBRARIES = ("gyro_bandwidth",)


def record_of(vector: dict) -> tuple[np.ndarray, float]:
    """The record that is expected, deg/s, and its bar."""
    told = vector["expect"]["crv_deg_s"]
    return np.array([[float.fromhex(w) for w in row] for row in told["hex"]]), told["bar"]


def test_vectors_of_effects():
    lines: list[str] = []
    made, kept = json.loads(effects.document(lines.append)), json.loads(there("LE.json"))
    assert lines == [], "none is refused"
    pairs = list(zip(made.pop("vectors"), kept.pop("vectors"), strict=True))
    assert made == kept
    for a, b in pairs:
        if a["effect"] in OF_LIBRARIES:
            (here, bar_here), (there_, bar_there) = record_of(a), record_of(b)
            assert np.max(np.abs(here - there_)) <= min(bar_here, bar_there), a["id"]
            assert 0.5 <= bar_here / bar_there <= 2.0, "a bar is the largest of some members, known to a factor"
            a, b = ({k: v for k, v in c.items() if k not in ("expect", "resolving")} for c in (a, b))
        assert a == b, b["id"]


def test_vectors_of_a_plate_that_moves():
    assert small_layers.written(base_motion.document()) == there("LB.json")


def test_runs_and_what_the_manifest_says_of_them():
    runs, windows = trajectories.names()
    made = dict(trajectories.files(lambda line: None))
    assert {name for name, data in made.items() if data != there(name)} == set()
    kept = json.loads(there("MANIFEST.json"))
    assert (kept["trajectories"], kept["windows"]) == (runs, windows)
    documents = {layer: json.loads(there(f"{layer}.json")) for layer in small_layers.LAYERS}
    again = make.manifest(documents, runs, windows)
    assert {key: again[key] for key in again if key != "made_with"} == {
        key: kept[key] for key in kept if key != "made_with"
    }


def test_fingerprints_of_mistakes():
    assert fingerprints.file() == there("fingerprints.csv.gz")


def test_response_of_table_3_1():
    assert table_3_1() == []
