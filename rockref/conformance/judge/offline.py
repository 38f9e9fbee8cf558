"""The judge from afar: all questions as one file, answered anywhere, judged here."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any

from rockref.conformance import vectors
from rockref.conformance.backends import json_lines, richardson
from rockref.conformance.backends.executable import Misbehaved
from rockref.conformance.judge.findings import asked_in, of_the_profile
from rockref.conformance.rules import PIECES
from rockref.model.errors import InputError
from rockref.model.problem import Problem
from rockref.model.storage import read_bytes, unpacked

#: Decided: all questions have 0.9 MB and the law's answers 6 MB; JSON takes thirty times its size in memory at worst.
LARGEST_REQUESTS, LARGEST_RESPONSES = 24_000_000, 24_000_000
SMALL = ("L0", "L1", "L2", "L3", "L4", "L5s", "LS", "L7")


def questions(layers: Iterable[str], profile: str = "float64") -> Iterator[dict[str, Any]]:
    """Yield all requests of some layers, the first one `start`."""
    yield {"cmd": "start", "protocol": json_lines.PROTOCOL}
    wanted = tuple(layers)
    for layer in SMALL:
        if layer in wanted and of_the_profile(layer, profile):
            yield from map(json_lines.of_vector, vectors.layer(layer))
        if layer == "LS" and layer in wanted and profile == "scheme":
            yield from with_smaller_steps()
        if layer == "L4" and layer in wanted and profile != "scheme":
            yield from map(json_lines.of_vector, vectors.steps_as_runs())
    if "L5" in wanted:
        names = (
            vectors.trajectory_names() if profile == "scheme" else vectors.window_names() + vectors.trajectory_names()
        )
        for name in names:
            yield json_lines.of_problem(name, "simulate", vectors.trajectory(name).problem)


def with_smaller_steps() -> Iterator[dict[str, Any]]:
    """Yield the requests of LS with half and a quarter of their step."""
    for v in vectors.layer("LS"):
        for parts, name in zip(richardson.parts_of(v)[1:], ("half", "quarter"), strict=False):
            problem = richardson.refined(vectors.problem_of(v.inputs), parts)
            yield json_lines.of_problem(f"{v.id}-{name}", "simulate", problem)


def text(layers: Iterable[str], profile: str = "float64") -> str:
    """Return the requests as JSON lines."""
    return "".join(map(json_lines.line, questions(layers, profile)))


class Recorded:
    """A backend that looks its answers up in a file of responses."""

    language = "offline"

    def __init__(self, path: Path):
        self.answers: dict[str, dict[str, Any]] = {}
        facts: dict[str, Any] = {}
        for number, reply in _replies(path):
            if "cmd" in reply:
                where, cure = f"{path}, line {number}", "Give the file of the answers to it."
                raise InputError("E-RESPONSE", where, "is a question, not an answer", cure)
            if "id" in reply:
                self.answers[str(reply["id"])] = reply
            elif "protocol" in reply:
                facts = reply
            else:
                raise InputError(
                    "E-RESPONSE",
                    f"{path}, line {number}",
                    "has neither id nor protocol",
                    "Answer one line per request.",
                )
        if not self.answers:
            raise InputError("E-RESPONSE", str(path), "has no answers", "Answer the lines of `rockref conform export`.")
        self.name, self.version = str(facts.get("name", path.name)), str(facts.get("version", ""))
        self.precision = str(facts.get("precision", "float64"))
        for piece in self._shown(facts):
            setattr(self, piece, self._piece(piece))
        self.remarks = self._left_out()
        if has_mark(path):
            self.remarks.append("The file begins with a byte order mark, which was dropped.")

    def _shown(self, facts: dict[str, Any]) -> list[str]:
        """Return pieces that it says it has; where it does not say, those that are answered by more than an error."""
        if facts.get("capabilities"):
            return json_lines.capabilities(facts, PIECES)
        asked = [v for layer in SMALL for v in vectors.layer(layer)]
        answered = {v.piece for v in asked if self.answers.get(v.id, {}).get("out")}
        return [p for p in PIECES if p in answered]

    def _left_out(self) -> list[str]:
        """Return a remark for every layer with questions to pieces that are shown which the file does not answer."""
        # What is asked of other integrators alone is not missed.
        of_all = [name for name in SMALL if name != "LS"]
        asked = {name: tuple((v.id, v.piece) for v in asked_in(name, self)) for name in of_all}
        asked["L5"] = tuple((name, "simulate") for name in vectors.window_names() + vectors.trajectory_names())
        remarks = []
        for layer, questions_ in asked.items():
            shown = [id_ for id_, piece in questions_ if callable(getattr(self, piece, None))]
            left = [id_ for id_ in shown if id_ not in self.answers]
            if left:
                which = "None" if len(left) == len(shown) else f"{len(left)}, first {left[0]},"
                some = "is answered" if len(left) == len(shown) else "are not answered"
                remarks.append(f"{which} of the {len(shown)} questions of {layer} {some} in the file.")
        return remarks

    @property
    def layers(self) -> set[str]:
        """Return the layers to which the file has at least one answer."""
        found = {layer for layer in SMALL if any(v.id in self.answers for v in asked_in(layer, self))}
        runs = {*vectors.window_names(), *vectors.trajectory_names()}
        return found | ({"L5"} if runs & self.answers.keys() else set())

    def _piece(self, piece: str) -> Any:
        if piece == "step":
            return lambda problem: self._answer(piece, vectors.flat(problem))
        return lambda **inputs: self._answer(piece, inputs)

    def simulate(self, problem: Problem) -> dict[str, Any]:
        """Return the recorded run."""
        return self._answer("simulate", vectors.flat(problem))

    def _answer(self, piece: str, inputs: dict[str, Any]) -> dict[str, Any]:
        id_ = _by_content().get(_key(piece, inputs), "")
        if id_ not in self.answers:
            raise Misbehaved(f"no answer to {id_ or 'this question'} in the file")
        reply = self.answers[id_]
        if "out" not in reply:
            raise Misbehaved(f"says: {reply.get('error', 'nothing')}")
        try:
            return json_lines.readable(reply["out"], piece)
        except ValueError as e:
            raise Misbehaved(str(e)) from e


@lru_cache
def _by_content() -> dict[str, str]:
    """Return which id a question has, by its content."""
    every = [q for profile in ("float64", "scheme") for q in questions((*SMALL, "L5"), profile)]
    return {_key(q["piece"], q["in"]): q["id"] for q in every if q["cmd"] == "run"}


def _key(piece: str, inputs: dict[str, Any]) -> str:
    if piece not in json_lines.WHOLE:
        return piece + json.dumps(json_lines.plain(inputs), sort_keys=True)
    known = vectors.flat(vectors.problem_of(inputs))
    return piece + json.dumps(json_lines.plain(known), sort_keys=True)


def requests_in(path: Path) -> Iterator[dict[str, Any]]:
    """Yield the requests in a file. Raises InputError (E-REQUEST) that names the line."""
    for number, row in _rows(path, LARGEST_REQUESTS):
        try:
            yield json_lines.object_of(row)
        except ValueError as e:
            cure = "Give the file that `rockref conform export` wrote."
            raise InputError("E-REQUEST", f"{path}, line {number}", str(e), cure) from e


def _replies(path: Path) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yield numbered answers. Raises InputError (E-RESPONSE) that names the line."""
    for number, row in _rows(path, LARGEST_RESPONSES):
        try:
            yield number, json_lines.object_of(row)
        except ValueError as e:
            raise InputError("E-RESPONSE", f"{path}, line {number}", str(e), "Write one JSON object a line.") from e


def has_mark(path: Path) -> bool:
    """Return whether a file, packed or not, begins with a byte order mark of UTF-8."""
    data = read_bytes(path, LARGEST_RESPONSES)
    if data[:2] == b"\x1f\x8b":
        data = unpacked(data, path, LARGEST_RESPONSES)
    return data.startswith(b"\xef\xbb\xbf")


def _rows(path: Path, limit: int) -> Iterator[tuple[int, str]]:
    """Yield the lines of a file, packed or not, with their numbers, blank ones left out.

    A byte order mark is dropped. Raises InputError (E-FILE, E-SIZE, E-GZIP, E-ENCODING).
    """
    data = read_bytes(path, limit)
    if data[:2] == b"\x1f\x8b":
        data = unpacked(data, path, limit)
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise InputError("E-ENCODING", str(path), "is UTF-16 text", "Save it as UTF-8 text.")
    content = data.decode("utf-8-sig", errors="replace")
    for number, row in enumerate(content.split("\n"), 1):
        if row.strip():
            yield number, row
