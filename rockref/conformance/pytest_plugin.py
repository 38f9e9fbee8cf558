"""`pytest --rockref-backend package:Backend`: every vector as a test of your own suite.

Loaded by pytest when rockref is installed; without the option it does nothing.
"""

from __future__ import annotations

from typing import Any

import pytest


def pytest_addoption(parser: Any) -> None:
    """The options."""
    group = parser.getgroup("rockref")
    group.addoption("--rockref-backend", metavar="TARGET", help="package:Class or path/to/file.py:Class.")
    group.addoption("--rockref-profile", default="float64", help="float64 (default), float32 or scheme.")
    group.addoption(
        "--rockref-layers", default="L0,L1,L2,L3,L4,L5s,L7", help="Layers of vectors; add L5 for whole trajectories."
    )


def pytest_collection_modifyitems(session: pytest.Session, config: pytest.Config, items: list[pytest.Item]) -> None:
    """Add a test for every vector whose piece the backend shows, and for every run of L5."""
    target = config.getoption("--rockref-backend")
    if not target:
        return
    from rockref.conformance import asking, vectors
    from rockref.conformance.backend import load
    from rockref.conformance.judge import NOT_OF_THE_SCHEME, chosen_layers

    backend, profile = load(target), config.getoption("--rockref-profile")
    for layer in chosen_layers(config.getoption("--rockref-layers").split(",")):
        if layer == "L5":
            names = vectors.trajectory_names()
            items += [RunItem.from_parent(session, name=f"{layer}/{n}", given=(backend, n, profile)) for n in names]
        elif layer not in ("L6", "LE"):
            for vector in vectors.layer(layer):
                own_step = profile == "scheme" and vector.piece in NOT_OF_THE_SCHEME
                if asking.has(backend, vector.piece) and not own_step:
                    given = (backend, vector, profile)
                    items.append(VectorItem.from_parent(session, name=f"{layer}/{vector.id}", given=given))


class Failed(Exception):
    """A result outside its bar; the message says which."""


class _Item(pytest.Item):
    """A test that is not in a file."""

    def __init__(self, *, given: Any, **rest: Any):
        super().__init__(**rest)
        self.given = given

    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        """The message alone, where the vector failed."""
        return str(excinfo.value) if isinstance(excinfo.value, Failed) else super().repr_failure(excinfo)

    def reportinfo(self) -> tuple[Any, int | None, str]:
        """Where the test comes from: from the vectors."""
        return "rockref vectors", None, self.name


class VectorItem(_Item):
    """One vector."""

    def runtest(self) -> None:
        """Put the question, weigh the answer."""
        from rockref.conformance.in_words import numbers
        from rockref.conformance.judge import answered
        from rockref.conformance.rules import BY_ID

        backend, vector, profile = self.given
        checks = answered(backend, vector, profile)
        failed = [c for c in checks if c.failed and not c.follows] or [c for c in checks if c.failed]
        if failed:
            rule = BY_ID[min(failed, key=lambda c: c.rank).rule]
            said = "\n  ".join(map(numbers, failed))
            raise Failed(f"rule {rule.id} - {rule.says}, {rule.equation}; {', '.join(vector.flags)}\n  {said}")


class RunItem(_Item):
    """One trajectory."""

    def runtest(self) -> None:
        """Run it, compare row by row."""
        from rockref.conformance.asking import as_mapping
        from rockref.conformance.in_words import run_line
        from rockref.conformance.runs import judge_rows
        from rockref.conformance.vectors import trajectory

        backend, name, profile = self.given
        run = trajectory(name)
        if profile not in run.meta["horizon_s"]:
            pytest.skip(f"{name} is not given in the profile {profile}")
        judged = judge_rows(run, as_mapping(backend.simulate(run.problem), "simulate"), profile)
        if judged.failed:
            at = f"; first divergent sample at {judged.first['t_s']:.6g} s" if judged.first else ""
            raise Failed(run_line(judged) + at)
