"""Find a missing effect from Python: where the model fails, two suspects, and what held-out runs say of them.

Run it cell by cell, or whole, in the folder of the project: ``python examples/find_a_missing_effect.py`` (a minute
on a free core). `rockref diagnose` asks the same of the whole catalogue.
"""

# %% An experiment: six runs, two of them held out
from pathlib import Path

from rockref.discover.add_effect import add_effect
from rockref.discover.compare.models import baseline_model, compare
from rockref.discover.compare.sentences import findings
from rockref.measure import load_experiment

EXPERIMENT = Path(__file__).resolve().parents[1] / "data/experiments/mystery-05"
experiment = load_experiment(EXPERIMENT)
print(", ".join(f"{run.id} ({run.use})" for run in experiment.runs))

# %% Where does the model fail? It loses too little energy in the free arcs, and the right share at impacts
comparison = compare(experiment, [baseline_model(experiment)])
for finding in findings(comparison):
    if finding.kind in ("energy", "to_second_impact"):
        print(finding.text)

# %% Something brakes the block between its impacts. Two suspects, each fitted together with everything else, on the
# first 0.8 s of each run (3 s are the default, and take longer)
suspects = {id: add_effect(id, EXPERIMENT, end=0.8) for id in ("rolling_resistance", "quadratic_drag")}
for id, found in suspects.items():
    before, after = found.before.holdout, found.after.holdout
    assert before is not None and after is not None
    name, size = next(iter(found.own_numbers.items()))
    errors = f"{before['total']:.4f} -> {after['total']:.4f} deg/s (noise {found.noise:.4f})"
    print(f"{id:20} held-out error {errors}", end="")
    print(f", {name} = {size.value:.3g} ({size.low:.3g} to {size.high:.3g}) {size.unit}")

# %% The one that comes nearer to the noise, on runs that no fit has seen, is kept
best = min(suspects, key=lambda id: suspects[id].after.holdout["total"])
suspects[best].model.save("with_effect.toml")
print(f"{best} is kept: with_effect.toml")
assert best == "rolling_resistance"
