"""Steps are halved where halving them shows beside the noise, and nowhere else."""

from dataclasses import replace

import pytest

from rockref import Model
from rockref.discover.fit.few_runs import FewRuns
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import S1, S2, S3, F
from rockref.discover.fit.steps import FINEST, changed, coarse, fine_enough
from tests.unit.discover.synthetic import experiment

MODEL = Model.table_3_1()


def fitter_of(quieter: float = 1.0) -> tuple[Fitter, FittedModel]:
    """A fitter of two releases with a gyroscope that is quieter than that of the source, and the truth."""
    e = experiment(MODEL, [{}, {"turned": True}], duration=1.0, noisy=True)
    e = replace(e, gyro=replace(e.gyro, noise=e.gyro.noise / quieter, resolution=e.gyro.resolution / quieter))
    fitter = Fitter(fit_problem(e, e.runs, MODEL, end=0.9, workers=1))
    fitter.problem.listener.sigma[:] = e.gyro.noise
    return fitter, FittedModel((), fitter.problem.nominal())


def test_the_stages_are_fine_enough_for_the_block_of_the_source():
    fitter, truth = fitter_of()
    assert fine_enough(fitter, [truth], (S1, S2, S3, F)) and not fitter.problem.finer


def test_a_quiet_gyroscope_asks_for_finer_steps():
    fitter, truth = fitter_of(quieter=8.0)
    before = changed(fitter, [truth], S1)
    assert before > coarse(fitter, S1)
    assert not fine_enough(fitter, [truth], [S1])
    assert fitter.problem.finer["S1"] > 1.0 and fitter.problem.finer.keys() == {"S1"}
    # The error is of second order, but for contacts that begin and end within a step: an eighth of its square is left.
    assert changed(fitter, [truth], S1) < before / 8
    assert fine_enough(fitter, [truth], [S1]) or fitter.problem.finer["S1"] == FINEST


def test_steps_that_are_far_too_coarse_are_halved_as_often_as_may_be():
    fitter, truth = fitter_of()
    assert not fine_enough(fitter, [truth], [replace(S3, steps=1)])
    assert fitter.problem.finer == {"S3": FINEST}


def test_at_the_longest_memory_all_counts_and_not_the_mean():
    fitter, truth = fitter_of()
    found = changed(fitter, [truth], F)
    assert 0.0 < found < coarse(fitter, F)
    e = replace(fitter.problem.experiment, runs=fitter.problem.experiment.runs[:1])
    fewer = Fitter(fit_problem(e, e.runs, MODEL, end=0.9, workers=1))
    assert coarse(fewer, F) == coarse(fitter, F) and coarse(fewer, S3) < coarse(fitter, S3)


def test_the_worst_of_a_field_counts():
    fitter, truth = fitter_of()
    stiff = truth.copy()
    stiff.z[0] += 1.0
    both = changed(fitter, [truth, stiff], S1)
    # Side by side all take the steps of the stiffest; alone, the softer one takes coarser ones.
    assert both == pytest.approx(max(changed(fitter, [h], S1) for h in (truth, stiff)), rel=0.3)


def test_what_is_fine_for_all_runs_is_fine_for_few():
    fitter, _ = fitter_of()
    few = FewRuns(fitter.problem).problem
    fitter.problem.finer["S1"] = 2.0
    assert few.finer is fitter.problem.finer
