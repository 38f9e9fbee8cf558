"""`pytest --rockref-backend package:Backend`: every vector as a test of your own suite.

Loaded by pytest when rockref is installed; without the option it does nothing.
"""

from __future__ import annotations

from typing import Any

import pytest

#: Examples drawn for each property; as on the command line.
EXAMPLES = 50


def pytest_addoption(parser: Any) -> None:
    """Add the options."""
    group = parser.getgroup("rockref")
    group.addoption("--rockref-backend", metavar="TARGET", help="package:Class or path/to/file.py:Class.")
    group.addoption("--rockref-profile", help="float64, float32 or scheme; default: what the backend says it is.")
    layers = "Layers of vectors; add L5 for windows and trajectories, L6 for properties, LE for effects."
    group.addoption("--rockref-layers", default="L0,L1,L2,L3,L4,L5s,L7", help=layers)


def pytest_collection_modifyitems(session: pytest.Session, config: pytest.Config, items: list[pytest.Item]) -> None:
    """Add a test for every vector whose piece the backend shows, and for every run of L5."""
    target = config.getoption("--rockref-backend")
    if not target:
        return
    from rockref.conformance.judge.findings import chosen_layers, used_profile
    from rockref.model.errors import InputError

    try:
        backend = usable(target)
        profile = used_profile(backend, config.getoption("--rockref-profile"))
        layers = chosen_layers(config.getoption("--rockref-layers").split(","))
    except InputError as e:
        raise pytest.UsageError(str(e)) from e
    for layer in layers:
        for kind, name, thing in asked(backend, layer, profile):
            items.append(kind.from_parent(session, name=f"{layer}/{name}", given=(backend, thing, profile)))


def usable(target: str) -> Any:
    """Return the backend. Raises InputError (E-BACKEND) where there is none, or it has no `simulate`."""
    from rockref.conformance.backends import call
    from rockref.conformance.backends.load import load
    from rockref.model.errors import InputError

    backend = load(target)
    if not call.has(backend, "simulate"):
        raise InputError("E-BACKEND", target, "has no simulate(problem)", "It is the one mandatory piece.")
    return backend


def asked(backend: Any, layer: str, profile: str) -> list[tuple[Any, str, Any]]:
    """Return what becomes a test: the kind of test, its name, and what it is about."""
    from rockref.conformance import vectors
    from rockref.conformance.backends import call
    from rockref.conformance.judge import claims, shaken
    from rockref.conformance.judge.findings import NOT_OF_THE_SCHEME, asked_in, of_the_profile

    if layer == "L5":
        windows = () if profile == "scheme" else vectors.window_names()
        return [(RunItem, name, name) for name in windows + vectors.trajectory_names()]
    if layer == "L6":
        return [(PropertyItem, p[1].__name__, p) for p in properties(profile) if call.has(backend, p[0])]
    if layer in ("LE", "LB"):
        judge = claims.judge_claim if layer == "LE" else shaken.judge_vector
        found = () if profile != "float64" else claims.claims() if layer == "LE" else shaken.shaken_vectors()
        return [(ClaimItem, c.id, (judge, c)) for c in found if call.has(backend, getattr(c, "piece", shaken.PIECE))]
    if not of_the_profile(layer, profile):
        return []
    not_asked = NOT_OF_THE_SCHEME if profile == "scheme" else set()
    shown = [v for v in asked_in(layer, backend) if call.has(backend, v.piece) and v.piece not in not_asked]
    return [(VectorItem, v.id, v) for v in shown]


def properties(profile: str) -> tuple[Any, ...]:
    """Return the properties of L6, which are judged in float64 only. Raises UsageError where hypothesis is not
    installed."""
    if profile != "float64":
        return ()
    try:
        from rockref.conformance.judge.properties import PROPERTIES
    except ImportError as e:
        raise pytest.UsageError("L6 (properties) needs hypothesis: pip install hypothesis.") from e
    return PROPERTIES


class Failed(Exception):
    """A result outside its bar; the message says which."""


class _Item(pytest.Item):
    """A test that is not in a file."""

    def __init__(self, *, given: Any, **rest: Any):
        super().__init__(**rest)
        self.given = given

    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        """Return the message alone, where the vector failed."""
        return str(excinfo.value) if isinstance(excinfo.value, Failed) else super().repr_failure(excinfo)

    def reportinfo(self) -> tuple[Any, int | None, str]:
        """Return where the test comes from: from the vectors."""
        return "rockref vectors", None, self.name


class VectorItem(_Item):
    """One vector."""

    def runtest(self) -> None:
        """Put the question, weigh the answer."""
        from rockref.conformance.judge.findings import answered
        from rockref.conformance.reports.terminal import numbers
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
        from rockref.conformance.backends.call import as_mapping
        from rockref.conformance.judge.trajectories import judge_rows
        from rockref.conformance.reports.terminal import run_line
        from rockref.conformance.vectors import trajectory

        backend, name, profile = self.given
        run = trajectory(name)
        if profile not in run.meta["horizon_s"]:
            pytest.skip(f"{name} is not given in the profile {profile}")
        judged = judge_rows(run, as_mapping(backend.simulate(run.problem), "simulate"), profile)
        if judged.failed:
            at = f"; first divergent sample at {judged.first['t_s']:.6g} s" if judged.first else ""
            raise Failed(run_line(judged) + at)


class PropertyItem(_Item):
    """One property, with the examples that hypothesis draws for it."""

    def runtest(self) -> None:
        """Draw the states, look for one that breaks it."""
        from rockref.conformance.judge.properties import judge_one

        backend, (_, rule, drawn), _ = self.given
        judged = judge_one(backend, rule, drawn, EXAMPLES)
        if not judged.holds:
            raise Failed(f"{judged.name}: {judged.note}")


class ClaimItem(_Item):
    """One effect, or one run on a plate that moves; skipped where the backend does not claim it."""

    def runtest(self) -> None:
        """Ask for it, weigh the answer."""
        from rockref.conformance.reports.terminal import bars

        backend, (judge, vector), _ = self.given
        judged = judge(backend, vector)
        if judged.grade == "not shown":
            pytest.skip(f"{judged.effect} is not claimed")
        if judged.failed:
            raise Failed(f"{judged.effect}: {judged.note or bars(judged.worst)}")
