"""Where candidates begin when the baseline is far from the runs."""

import numpy as np

from rockref import Model
from rockref.discover.families import Family
from rockref.discover.far import first_looks
from rockref.discover.search import SHORT, Setup, Trial, nominal, windows
from rockref.effects.catalogue import parse
from tests.unit.discover.synthetic import experiment


def far_from(effect: str):
    """Setup and plain family at Table 3.1 of runs that another effect has bent."""
    truth = Model.table_3_1().replace(effects=(parse(effect),))
    e = experiment(truth, [{}, {"turned": True}], duration=1.2, noisy=True)
    setup = Setup(e, e.runs, Model.table_3_1(), end=1.2, workers=1)
    fit = setup.fit(windows(setup, SHORT))
    return setup, Family((), fit, fit.begin())


def test_first_look_ranks_a_turning_foot_first():
    setup, kept = far_from("spin_friction:radius=0.004")
    ids = ("clock_error", "adhesion", "spin_friction", "lingering_wire_pull")
    trials = [Trial((id,), 0.0, 0.0, kept.fit, kept.point) for id in ids]
    found = first_looks(setup, trials, kept)
    assert [f.effects for f in found] == [(id,) for id in ids]
    best = min(found, key=lambda f: f.point.objective)
    assert best.effects == ("spin_friction",)
    assert best.point.objective < kept.point.objective


def test_nominal_keeps_the_effects_alone():
    setup, kept = far_from("spin_friction:radius=0.004")
    trial = Trial(("mass_eccentricity",), 0.0, 0.0, kept.fit, kept.point)
    (family,) = first_looks(setup, [trial], kept)
    family.point.z[:] = 0.5
    z = nominal(family.fit.parameters, family.point.z)
    effects = np.array(["." in p.name for p in family.fit.parameters])
    assert np.all(z[effects] == 0.5) and np.all(z[~effects] == 0)
