"""All mistakes and controls of the zoo, by id."""

from rockref.conformance.faults.bodies import OF_BODIES
from rockref.conformance.faults.controls import CONTROLS
from rockref.conformance.faults.flow import OF_FLOW
from rockref.conformance.faults.habits import OF_HABITS
from rockref.conformance.faults.memory import OF_MEMORY
from rockref.conformance.faults.mistake import Mistake
from rockref.conformance.faults.points import OF_POINTS
from rockref.conformance.faults.ports import OF_PORTS
from rockref.conformance.faults.whole_runs import OF_RUNS
from rockref.conformance.rules import ORDER

OF_ALL = OF_BODIES + OF_POINTS + OF_FLOW + OF_RUNS + OF_MEMORY + OF_PORTS + OF_HABITS
MISTAKES: tuple[Mistake, ...] = tuple(sorted(OF_ALL, key=lambda m: (ORDER[m.rule], int(m.id[1:]))))
BY_ID: dict[str, Mistake] = {m.id: m for m in MISTAKES}
__all__ = ["BY_ID", "CONTROLS", "MISTAKES"]
