"""What a verdict may see of an experiment: plain numbers, stored and read back, from which it can be decided again."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from rockref.discover.diagnosis_record import plain
from rockref.discover.fit.objective import WHITE
from rockref.model.errors import InputError
from rockref.model.storage import write_text

#: Version of the stored form.
FORMAT = 1


@dataclass
class Number:
    """One number of an effect: value with its 90 % interval, unit, z in prior deviations, size in typical sizes."""

    value: float
    low: float
    high: float
    unit: str
    z: float
    size: float


@dataclass
class HypothesisEvidence:
    """One set of effects, fitted at the longest memory.

    objective : negative log posterior [nat];  eigenvalues : of its Gauss-Newton matrix in prior deviations
    loss : mean robust loss (white noise: 0.947), by run and axis; of held-out runs by run in `held_out`
    floor : mean loss that it leaves in records of its own, in all and by run and axis; that of white noise if not asked
    blocks : share of 50 ms blocks of each run that are far above white
    farthest : of a law's number [prior deviations];  numbers, law : of the effects and of the law, shared by the runs
    error : root mean square of the innovations by axis and in all [deg/s], the worst tenth of the blocks left out;
        held_out_error : the same of the held-out runs, in all
    """

    effects: tuple[str, ...]
    objective: float
    eigenvalues: list[float]
    loss: float
    loss_by_run_and_axis: dict[str, list[float]]
    blocks: dict[str, float]
    farthest: float
    numbers: dict[str, Number] = field(default_factory=dict)
    law: dict[str, Number] = field(default_factory=dict)
    error: dict[str, float] = field(default_factory=dict)
    held_out_error: float | None = None
    held_out: dict[str, float] = field(default_factory=dict)
    floor: float = WHITE
    floor_by_run_and_axis: dict[str, list[float]] = field(default_factory=dict)

    @property
    def loss_above(self) -> float:
        """Return the mean loss as it would be were the floor that of white noise."""
        return self.loss * WHITE / self.floor

    def losses_above(self) -> dict[str, list[float]]:
        """Return the loss of each run by axis as it would be were the floor that of white noise."""
        floors = self.floor_by_run_and_axis
        return {
            run: [x * WHITE / f for x, f in zip(axes, floors.get(run, [WHITE] * len(axes)), strict=True)]
            for run, axes in self.loss_by_run_and_axis.items()
        }

    def size(self, effect: str) -> float:
        """Return the amplitude of an effect, that of its largest number [typical sizes]."""
        return max((abs(n.size) for name, n in self.numbers.items() if name.partition(".")[0] == effect), default=0.0)


@dataclass
class Evidence:
    """All that a verdict may see.

    samples : innovations of the fit runs;  held_out_samples : of each held-out run
    remarks : codes of the remarks on the records;  sensor_faults : those that are faults of the sensor, in words
    limits : least detectable amplitudes [typical sizes]
    chance : what the weakest effect of the best set gains at most in records of the set without it [nat]
    confusions : cosines between effects that these runs hardly tell apart;  separating : the run that would, in words
    """

    experiment: str
    digest: str
    samples: int
    held_out_samples: dict[str, int]
    hypotheses: list[HypothesisEvidence]
    carried: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()
    sensor_faults: tuple[str, ...] = ()
    signature: dict[str, Any] = field(default_factory=dict)
    limits: dict[str, dict[str, Any]] = field(default_factory=dict)
    confusions: dict[str, dict[str, float]] = field(default_factory=dict)
    separating: str = ""
    chance: float = 0.0
    cost: dict[str, float] = field(default_factory=dict)

    def of(self, effects) -> HypothesisEvidence | None:
        """Return the evidence of a set of effects, in any order."""
        return next((h for h in self.hypotheses if frozenset(h.effects) == frozenset(effects)), None)

    def to_dict(self) -> dict[str, Any]:
        """Return plain values."""
        return plain({"format": FORMAT, **asdict(self)})

    def save(self, path: Path) -> None:
        """Write the evidence as JSON, whole or not at all."""
        write_text(path, json.dumps(self.to_dict(), indent=1) + "\n")

    @classmethod
    def load(cls, path: Path) -> Evidence:
        """Read stored evidence.

        Raises
        ------
        InputError
            E-FILE, E-JSON.
        """
        try:
            found = json.loads(path.read_text(encoding="utf-8"))
        except OSError as e:
            raise InputError("E-FILE", str(path), f"cannot be read ({e.strerror})", "Check the path.") from e
        except ValueError as e:
            raise InputError("E-JSON", str(path), f"is no JSON: {e}", "Give what rockref diagnose has stored.") from e
        return cls.from_dict(found, str(path))

    @classmethod
    def from_dict(cls, found: Mapping[str, Any], where: str = "evidence") -> Evidence:
        """Return evidence from plain values. Raises InputError (E-JSON)."""
        try:
            given = dict(found)
            if given.pop("format") != FORMAT:
                raise InputError("E-JSON", where, "was stored in another form", "Diagnose the experiment again.")
            given["hypotheses"] = [
                HypothesisEvidence(**{
                    **h, "effects": tuple(h["effects"]),
                    **{key: {k: Number(**n) for k, n in h[key].items()} for key in ("numbers", "law")},
                })
                for h in given["hypotheses"]
            ]  # fmt: skip
            for key in ("carried", "remarks", "sensor_faults"):
                given[key] = tuple(given.get(key, ()))
            return cls(**given)
        except (KeyError, TypeError) as e:
            raise InputError("E-JSON", where, f"is no evidence ({e})", "Diagnose the experiment again.") from e


def log_evidence(h: HypothesisEvidence, temperature: float) -> float:
    """Return the logarithm of the evidence by Laplace's method at a temperature [nat].

    Innovations of a chaotic motion are not as independent as white noise: all of the likelihood counts 1/temperature,
    and so does the information that Occam's factor is made of (D. J. C. MacKay 1992, Neural Comput. 4:415-447,
    doi:10.1162/neco.1992.4.3.415).
    """
    data = np.maximum(np.asarray(h.eigenvalues) - 1.0, 0.0)
    return -h.objective / temperature - 0.5 * float(np.sum(np.log1p(data / temperature)))
