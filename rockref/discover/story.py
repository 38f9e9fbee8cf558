"""The whole path on one experiment: compared, diagnosed, the effect added, the error before and after."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from rockref.discover.add import Addition, add
from rockref.discover.compare.models import Comparison, baseline_model, compare
from rockref.discover.diagnose import Diagnosis, diagnose
from rockref.measure.experiment import load_experiment


@dataclass
class Journey:
    """What was found at each step; `addition` is None where the diagnosis names nothing that could be added."""

    diagnosis: Diagnosis
    addition: Addition | None
    comparison: Comparison

    @property
    def lines(self) -> list[str]:
        """The story in sentences."""
        d, a = self.diagnosis, self.addition
        found = [f"{d.experiment.name}: {d.sentence}"]
        if a is None:
            return found
        for e in a.estimates:
            if e.of_effect and e.of_run is None and e.name.startswith(a.effect + "."):
                unit = "" if e.unit == "1" else f" {e.unit}"
                found.append(f"{e.name} = {e.value:.3g}{unit} (90 %: {e.low:.3g} to {e.high:.3g}).")
        for use, words in (("fit", "fit runs"), ("holdout", "held-out runs")):
            before, after = getattr(a.before, use), getattr(a.after, use)
            if before is not None and after is not None:
                found.append(
                    f"The error on the {words} falls from {before.total:.3f} to {after.total:.3f} deg/s RMS; the noise "
                    f"floor is {a.noise:.3f}."
                )
        return found


def run_story(
    experiment: str | Path, say: Callable[[str], None], engine: str = "auto", seed: int = 0, quick: bool = True
) -> Journey:
    """Compare, diagnose, add the first effect of the verdict, and compare again: nominal baseline and what was found.

    say : called with a line at every stage; quick : half the seconds of each run are used, which is enough for an
    effect of its typical size. Raises InputError, NumericalError.
    """
    end = QUICK_END if quick else WHOLE_END
    say("diagnosing")
    found = diagnose(experiment, seed=seed, end=end, progress=say)
    addition = None
    if found.verdict in ("named", "indicated", "pair", "class"):
        effect = found.effects[0]
        say(f"adding {effect}")
        addition = add(effect, experiment, seed=seed, end=end, progress=say)
    say("comparing before and after")
    loaded = load_experiment(experiment)
    models, names = [baseline_model(loaded)], ["baseline"]
    if addition is not None:
        models.append(addition.model)
        names.append(f"with {addition.effect}")
    return Journey(found, addition, compare(loaded, models, names, engine=engine))


#: Seconds of each run: what the diagnosis uses, and half of it.
WHOLE_END, QUICK_END = 3.0, 1.6
