"""Golden files are what their makers make: to the byte, on a machine whose longdouble has 64 bits, with gcc.

Ten minutes of processor time; `make golden` does the same and says what differs.
"""

import json
import shutil

import numpy as np
import pytest

from rockref.conformance.maker import cases_effects, fingerprints, make, small, trajectories
from tests.golden.make import table_3_1

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(np.finfo(np.longdouble).nmant + 1 < 64, reason="longdouble has fewer than 64 bits here"),
    pytest.mark.skipif(shutil.which("gcc") is None, reason="no gcc on this machine"),
]


def there(name: str) -> bytes:
    return (make.FOLDER / name).read_bytes()


@pytest.mark.parametrize("layer", small.LAYERS)
def test_vectors_of_rules(layer):
    refused: list[str] = []
    assert small.written(small.document(layer, refused)) == there(f"{layer}.json")


def test_vectors_of_effects():
    lines: list[str] = []
    assert cases_effects.document(lines.append) == there("LE.json")
    assert lines == [], "none is refused"


def test_runs_and_what_the_manifest_says_of_them():
    runs, windows = trajectories.names()
    made = dict(trajectories.files(lambda line: None))
    assert {name for name, data in made.items() if data != there(name)} == set()
    kept = json.loads(there("MANIFEST.json"))
    assert (kept["trajectories"], kept["windows"]) == (runs, windows)
    documents = {layer: json.loads(there(f"{layer}.json")) for layer in small.LAYERS}
    again = make.manifest(documents, runs, windows)
    assert {key: again[key] for key in again if key != "made_with"} == {
        key: kept[key] for key in kept if key != "made_with"
    }


def test_fingerprints_of_mistakes():
    assert fingerprints.file() == there("fingerprints.csv.gz")


def test_response_of_table_3_1():
    assert table_3_1() == []
