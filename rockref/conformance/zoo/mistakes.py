"""All mistakes and controls of the zoo, by id."""

from rockref.conformance.rules import ORDER
from rockref.conformance.zoo.controls import CONTROLS
from rockref.conformance.zoo.mistake import Mistake
from rockref.conformance.zoo.of_bodies import OF_BODIES
from rockref.conformance.zoo.of_flow import OF_FLOW
from rockref.conformance.zoo.of_habits import OF_HABITS
from rockref.conformance.zoo.of_memory import OF_MEMORY
from rockref.conformance.zoo.of_points import OF_POINTS
from rockref.conformance.zoo.of_ports import OF_PORTS
from rockref.conformance.zoo.of_runs import OF_RUNS

OF_ALL = OF_BODIES + OF_POINTS + OF_FLOW + OF_RUNS + OF_MEMORY + OF_PORTS + OF_HABITS
MISTAKES: tuple[Mistake, ...] = tuple(sorted(OF_ALL, key=lambda m: (ORDER[m.rule], int(m.id[1:]))))
BY_ID: dict[str, Mistake] = {m.id: m for m in MISTAKES}
__all__ = ["BY_ID", "CONTROLS", "MISTAKES"]
