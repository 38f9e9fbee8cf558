"""The protocol of executables: one JSON object a line, asked on standard input, answered on standard output.

start -> who it is and which pieces it shows;  run -> the answer to one question;  stop -> nothing. docs: "Judge your
backend".
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable
from typing import Any, TextIO

import numpy as np

from rockref.conformance.backends.call import ANYTHING, as_mapping, has, raised
from rockref.conformance.rules import PIECES
from rockref.conformance.vectors import Vector, flat, problem_of
from rockref.model.problem import Problem

PROTOCOL = 1
WHOLE = ("step", "simulate")
#: Results that are one number: null in their place is what JavaScript writes for NaN, not a result that is left out.
SINGLE = ("F_N", "threshold")
#: Pieces that show effects of the catalogue, and runs on a plate that moves.
CLAIMS = ("effect", "sensor", "shaken")


def plain(value: Any) -> Any:
    """Return arrays and NumPy's numbers as nested lists and plain numbers; doubles keep every bit."""
    if isinstance(value, np.ndarray | np.generic):
        value = np.asarray(value)
        return (value if value.dtype.kind in "bi" else value.astype(float)).tolist()
    if isinstance(value, dict):
        return {k: plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [plain(v) for v in value]
    return value


def line(thing: Any) -> str:
    """Return one line."""
    return json.dumps(plain(thing), separators=(",", ":")) + "\n"


def question(id_: str, piece: str, inputs: dict[str, Any]) -> dict[str, Any]:
    """Return a run request."""
    return {"cmd": "run", "id": id_, "piece": piece, "in": inputs}


def of_vector(vector: Vector) -> dict[str, Any]:
    """Return the request of a vector; the keys are those of its inputs."""
    return question(vector.id, vector.piece, vector.inputs)


def of_problem(id_: str, piece: str, problem: Problem) -> dict[str, Any]:
    """Return the request of a problem."""
    return question(id_, piece, flat(problem))


def readable(answer: Any, piece: str) -> dict[str, Any]:
    """Return the results of an answer, as arrays where they are lists of numbers."""
    if not isinstance(answer, dict):
        raise ValueError(f"'out' is {type(answer).__name__}, not an object")
    return {k: readable(v, piece) if isinstance(v, dict) else _array(v, k) for k, v in answer.items()}


def _array(value: Any, name: str = "") -> Any:
    if value is None and name in SINGLE:
        return float("nan")
    if not isinstance(value, list) or not of_numbers(value):
        return value
    try:
        return np.array(value)
    except ValueError:
        return value


def of_numbers(value: Any) -> bool:
    """Return whether nested lists hold numbers and flags alone: NumPy makes room for the longest text everywhere."""
    left = [value]
    while left:
        thing = left.pop()
        if isinstance(thing, list):
            left.extend(thing)
        elif not isinstance(thing, int | float):
            return False
    return True


def capabilities(facts: dict[str, Any], known: Iterable[str]) -> list[str]:
    """Return the pieces that an answer to `start` names, of those that are known; none where there is no list."""
    said = facts.get("capabilities")
    return [p for p in known if p in said] if isinstance(said, list) else []


def object_of(text: str | bytes) -> dict[str, Any]:
    """Return the object that a line holds. Raises ValueError: what is wrong with it."""
    try:
        thing = json.loads(text)
    except (ValueError, RecursionError) as e:
        raise ValueError("is no JSON") from e
    if not isinstance(thing, dict):
        raise ValueError("is no JSON object")
    return thing


def answer(backend: Any, request: dict[str, Any]) -> dict[str, Any]:
    """Return what a Python backend says to one request; to one that cannot be used, what is wrong with it."""
    command = request.get("cmd")
    if command == "start":
        shown = ["simulate", *(p for p in (*PIECES, *CLAIMS) if has(backend, p))]
        facts = {
            k: str(getattr(backend, k, "")) for k in ("name", "version", "language", "precision") if hasattr(backend, k)
        }
        return {"protocol": PROTOCOL, "name": type(backend).__name__, **facts, "capabilities": shown}
    if command != "run":
        return {"error": f"unknown command {str(command)[:80]!r}"}
    id_, piece, inputs = request.get("id"), request.get("piece"), request.get("in")
    # By name from the list: whoever asks calls no other methods of the backend.
    if piece not in ("simulate", *PIECES, *CLAIMS):
        return {"id": id_, "error": f"unknown piece {str(piece)[:80]!r}"}
    if not isinstance(inputs, dict):
        return {"id": id_, "error": "'in' is no object"}
    try:
        q = {k: _array(v) for k, v in inputs.items()}
        if piece == "effect":
            out = backend.effect(problem_of(q), q["effect"], q["parameters"])
        else:
            whole = piece in (*WHOLE, "shaken")
            out = getattr(backend, piece)(problem_of(q)) if whole else getattr(backend, piece)(**q)
        # Effects that are not claimed are answered with null.
        like = "simulate" if piece in ("effect", "shaken") else piece
        return {"id": id_, "out": None if out is None else as_mapping(out, like)}
    except ANYTHING as e:
        return {"id": id_, "error": raised(e)}


def serve(backend: Any, lines: Iterable[str | bytes] | None = None, out: TextIO | None = None) -> None:
    """Answer requests until `stop` or the end: this makes an executable of any Python backend."""
    out = sys.stdout if out is None else out
    # Bytes: a line that is no UTF-8 is answered like any other that cannot be read.
    for text in getattr(sys.stdin, "buffer", sys.stdin) if lines is None else lines:
        if not text.strip():
            continue
        try:
            request = object_of(text)
        except ValueError as e:
            reply: dict[str, Any] = {"error": f"the request {e}"}
        else:
            if request.get("cmd") == "stop":
                return
            reply = answer(backend, request)
        out.write(line(reply))
        out.flush()
