"""A small blind test from end to end: five experiments made by the other simulator, and a verdict on each.

A control, a load, a friction law, a sensor fault, an effect in no list. Three short runs each, so that it takes
minutes; `rockref blind make` and `rockref blind score` do the same at full length with as many cases as are asked for.
"""

import pytest

from rockref.blind.cases.generator import make_case
from rockref.blind.cases.making import make
from rockref.blind.scoring.evaluation import score
from rockref.blind.scoring.marks import gap_closed
from rockref.discover.diagnose import diagnose

RUNS = (("01", "fit", 0.117, False), ("02", "fit", 0.098, True), ("03", "holdout", 0.108, False))
SECONDS, SEED = 1.2, 11


def verdict(tmp_path, *effects):
    make_case(tmp_path / "case", effects, SEED, runs=RUNS, seconds=SECONDS, other_form=False)
    return diagnose(tmp_path / "case", workers=1).to_dict()


def test_nothing_hidden_nothing_found(tmp_path):
    found = verdict(tmp_path)
    assert (found["verdict"], found["effects"]) == ("none", [])
    # What could have hidden all the same is said for every number of every effect.
    assert found["detection_limits"]["quadratic_drag.c"]["value"] > 0


@pytest.mark.parametrize(
    "effect, size",
    [
        pytest.param("cable_restraint", 2.0, id="load", marks=pytest.mark.slow),
        pytest.param("stribeck_friction", 2.0, id="friction", marks=pytest.mark.slow),
        pytest.param("gyro_misalignment", 1.0, id="sensor", marks=pytest.mark.slow),
    ],
)
def test_hidden_effect_is_named_or_in_a_class_that_holds_it(tmp_path, effect, size):
    found = verdict(tmp_path, (effect, size))
    assert found["verdict"] in ("named", "indicated", "class")
    assert effect in found["effects"] and len(found["effects"]) <= 3
    closed = gap_closed(found["error"])
    assert closed is None or closed > 0.8


@pytest.mark.slow
def test_an_effect_in_no_list_is_something_else(tmp_path):
    found = verdict(tmp_path, ("rotor", 1.0))
    assert (found["verdict"], found["effects"]) == ("something_else", [])
    assert "not in the catalogue" in found["sentence"]


@pytest.mark.slow
def test_sixty_cases_are_no_worse_than_the_documentation_says(tmp_path):
    """Hours of processor time. Interrupted, `rockref blind score` goes on in the folder that is left."""
    make(tmp_path / "blind", 1515, 60, 0)
    found = score(tmp_path / "blind")
    assert all(found["sealed"].values())
    rows = {row["score"]: row["value"] for row in found["scores"]}
    print("\n".join(found["failures"]))
    # At the last time it had one wrong name and 29 of 31 first (docs/explanation/blind_test.md): no more wrong names,
    # and one or two of those first less.
    assert rows["controls: false alarms"] == 0
    assert rows["gap closed on held-out runs, median"] > 0.95
    assert rows["all: wrong name"] < 0.017
    assert rows["single: truth first"] > 0.87
