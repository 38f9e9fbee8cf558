"""A backend that is a program: it may crash, hang, print rubbish; each question to which it does so counts as
failed."""

from __future__ import annotations

import json
import os
import queue
import re
import shlex
import signal
import subprocess
import threading
import time
from typing import Any

from rockref.conformance.backends import json_lines
from rockref.conformance.backends.call import KEPT, printable
from rockref.conformance.rules import PIECES
from rockref.conformance.vectors import flat
from rockref.model.errors import InputError
from rockref.model.problem import Problem

#: Seconds that a program may take to start, to answer a small question, and to finish a run; decided, to be changed on
#: the command line.
START, SMALL, LONG = 20.0, 10.0, 600.0
#: Runs of so many steps at most are small questions: the short runs have a dozen, a window has two thousand.
FEW_STEPS = 100
#: A piece whose questions have ended so many times in a crash, in silence or in rubbish is not asked again.
PATIENCE = 3
#: So many lines that are no JSON object are passed over before an answer; decided.
MUCH_RUBBISH = 100
#: Longer lines are rubbish: the longest honest answer, a run of 351 rows, has 0.3 MB. JSON takes thirty times its size
#: in memory at worst.
LONGEST_LINE = 16_000_000
#: Seconds in which a program whose input has ended hands out what it kept in a buffer; decided.
AFTER_END = 1.0
#: Seconds for which what an ended program has said is waited for; decided: what it has started may hold the pipe open.
LAST_WORDS = 1.0
#: Lines that wait to be looked at, so that a program that prints without end is stopped by its own full pipe; decided.
WAITING = 3


class Misbehaved(Exception):
    """What the program did in place of answering."""


class Executable:
    """A program that speaks JSON lines. Its pieces appear as methods, as it has named them."""

    def __init__(self, command: list[str], small: float = SMALL, long: float = LONG):
        self.command, self.small, self.long = command, small, long
        self.process: subprocess.Popen[str] | None = None
        self.keeper: threading.Thread | None = None
        self.lines: queue.Queue[str | None] = queue.Queue(WAITING)
        self.ended = threading.Event()
        self.complaints: list[str] = []
        self.failures: dict[str, int] = {}
        self.asked = 0
        self.remarks: list[str] = []
        try:
            facts = self._started()
        except Misbehaved as e:
            self.close()
            raise InputError(
                "E-BACKEND", shlex.join(command), str(e), 'It must answer {"cmd":"start"} with one JSON line.'
            ) from e
        self.name = str(facts.get("name") or command[0])
        self.version, self.language = str(facts.get("version", "")), str(facts.get("language", "executable"))
        self.precision = str(facts.get("precision", "float64"))
        for piece in json_lines.capabilities(facts, (*PIECES, *json_lines.CLAIMS)):
            setattr(self, piece, self._piece(piece))

    def _piece(self, piece: str) -> Any:
        if piece == "step":
            return lambda problem: self._run(json_lines.of_problem(self._new_id(), piece, problem), self.small)
        if piece == "effect":
            return self._effect
        if piece == "sensor":
            return self._sensor
        if piece == "shaken":
            return lambda problem: self._run(json_lines.question(self._new_id(), piece, flat(problem)), self.small)
        return lambda **inputs: self._run(json_lines.question(self._new_id(), piece, inputs), self.small)

    def _effect(self, problem: Problem, effect: str, parameters: dict[str, Any]) -> dict[str, Any] | None:
        inputs = flat(problem) | {"effect": effect, "parameters": parameters}
        return self._run(json_lines.question(self._new_id(), "effect", inputs), self.small)

    def _sensor(self, effect: str, parameters: dict[str, Any], t: Any, crv_deg_s: Any) -> dict[str, Any] | None:
        inputs = {"effect": effect, "parameters": parameters, "t": t, "crv_deg_s": crv_deg_s}
        return self._run(json_lines.question(self._new_id(), "sensor", inputs), self.small)

    def _new_id(self) -> str:
        self.asked += 1
        return f"q{self.asked}"

    def simulate(self, problem: Problem) -> dict[str, Any]:
        """Return a run."""
        few = problem.duration <= FEW_STEPS * problem.step
        request = json_lines.of_problem(self._new_id(), "simulate", problem)
        return self._run(request, self.small if few else self.long)

    def _run(self, request: dict[str, Any], patience: float) -> Any:
        piece = request["piece"]
        if self.failures.get(piece, 0) >= PATIENCE:
            raise Misbehaved(f"not asked any more: {PATIENCE} questions to {piece} ended badly")
        try:
            if self.process is None:
                self._started()
            reply = self._asked(request, patience)
        except Misbehaved:
            self.failures[piece] = self.failures.get(piece, 0) + 1
            self.close()
            raise
        if reply.get("id") != request["id"]:
            self.failures[piece] = self.failures.get(piece, 0) + 1
            self.close()
            said = printable(repr(reply.get("id")))
            raise Misbehaved(f"answered to id {said}, not {request['id']!r}: give the question's id back, once")
        if "error" in reply:
            raise Misbehaved(f"says: {printable(reply['error'])}")
        if piece in json_lines.CLAIMS and reply.get("out", 0) is None:
            return None
        if "out" not in reply:
            raise Misbehaved(f"the answer has no 'out', but {', '.join(map(printable, reply))}")
        try:
            return json_lines.readable(reply["out"], piece)
        except ValueError as e:
            raise Misbehaved(str(e)) from e

    def _started(self) -> dict[str, Any]:
        self.lines, self.complaints, self.ended = queue.Queue(WAITING), [], threading.Event()
        self._spawn()
        facts = self._asked({"cmd": "start", "protocol": json_lines.PROTOCOL}, START)
        if facts.get("protocol") != json_lines.PROTOCOL:
            raise Misbehaved(f"speaks protocol {printable(repr(facts.get('protocol')))}, not {json_lines.PROTOCOL}")
        return facts

    def _spawn(self) -> None:
        """Start the program, and the threads that read what it prints."""
        try:
            self.process = subprocess.Popen(
                self.command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                encoding="utf-8",
                errors="replace",
                # A group of its own: what the program starts (a shell, mpirun) is ended with it.
                start_new_session=True,
            )
        except OSError as e:
            raise InputError(
                "E-BACKEND", shlex.join(self.command), f"cannot be started ({e.strerror})", "Give a program."
            ) from e
        threading.Thread(target=_pump, args=(self.process.stdout, self.lines, self.ended), daemon=True).start()
        keeper = threading.Thread(target=_keep, args=(self.process.stderr, self.complaints), daemon=True)
        keeper.start()
        self.keeper = keeper

    def _asked(self, request: dict[str, Any], patience: float) -> dict[str, Any]:
        assert self.process is not None and self.process.stdin is not None
        # Written beside: a program that does not read would block us once the pipe is full.
        threading.Thread(target=_write, args=(self.process.stdin, json_lines.line(request)), daemon=True).start()
        rubbish: list[str] = []
        end = time.monotonic() + patience
        while len(rubbish) < MUCH_RUBBISH:
            try:
                text = self.lines.get(timeout=max(end - time.monotonic(), 0.0))
            except queue.Empty:
                kept = "" if rubbish else self._kept_back()
                self.close()
                raise Misbehaved(f"no answer within {patience:g} s{kept}{_and(rubbish)}") from None
            if text is None:
                raise Misbehaved(self._end() + _and(rubbish))
            if len(text) >= LONGEST_LINE:
                raise Misbehaved(f"printed {len(text)} characters without an end of line")
            reply = self._heard(text)
            # A line of a log may be JSON, too.
            if reply is not None and _is_answer(reply, request):
                self._remark(rubbish)
                return reply
            rubbish.append(text[:KEPT])
        raise Misbehaved(f"no answer in {MUCH_RUBBISH} lines{_and(rubbish)}")

    def _heard(self, text: str) -> dict[str, Any] | None:
        """Return the object that a line holds, or None; a byte order mark is dropped, and said once."""
        if text.startswith("\ufeff"):
            text = text[1:]
            self.remarks.append("It begins with a byte order mark, which was dropped.")
        try:
            reply = json.loads(text)
        except (ValueError, RecursionError):
            return None
        return reply if isinstance(reply, dict) else None

    def _kept_back(self) -> str:
        """Say whether the answer comes once the input ends: then the program keeps it in a buffer."""
        assert self.process is not None
        threading.Thread(target=_close, args=(self.process.stdin,), daemon=True).start()
        try:
            text = self.lines.get(timeout=AFTER_END)
        except queue.Empty:
            return ""
        return "" if text is None else ", and then, when its input had ended: flush standard output after every line"

    def _remark(self, rubbish: list[str]) -> None:
        """Say once that there were lines that are no answers."""
        if rubbish and not any("passed over" in remark for remark in self.remarks):
            self.remarks.append(f"Lines that are no JSON object were passed over, first {rubbish[0][:80]!r}.")

    def _end(self) -> str:
        assert self.process is not None
        try:
            code: Any = self.process.wait(timeout=2)
        except subprocess.TimeoutExpired:
            code = "closed its output"
        if self.keeper is not None:
            self.keeper.join(timeout=LAST_WORDS)
        self.close()
        said = " ".join(self.complaints[-3:]).strip()[-200:]
        place = _frame(self.complaints)
        at = f" at {place}" if place else ""
        return f"ended (exit code {code}){at}" + (f", saying {said!r}" if said else "")

    def close(self) -> None:
        """End the program and what it has started, if it runs.

        Its pipes are closed by the threads that read them: whoever still holds their other end must not hold us.
        """
        if self.process is None:
            return
        process, self.process = self.process, None
        self.ended.set()
        _end_group(process)
        try:
            process.wait(timeout=5)
        except subprocess.TimeoutExpired:
            pass
        threading.Thread(target=_close, args=(process.stdin,), daemon=True).start()


def _is_answer(reply: dict[str, Any], request: dict[str, Any]) -> bool:
    """Return whether an object is an answer, right or wrong, and not a line of a log.

    To a start it says who it is; to a question it has its id, or a result, or an error and nothing else.
    """
    if request["cmd"] == "start":
        return bool(reply.keys() & {"protocol", "capabilities", "name", "version", "language", "precision"})
    return reply.get("id") == request["id"] or "out" in reply or ("error" in reply and reply.keys() <= {"id", "error"})


#: Where a complaint says it was: a frame of Python, or file and line as compilers and most runtimes write them.
_FRAMES = (re.compile(r'File "([^"]+)", line (\d+)'), re.compile(r"([\w./\\-]+\.\w{1,4}):(\d+)"))


def _frame(complaints: list[str]) -> str:
    """Return the last place, file and line, that complaints name; empty where they name none."""
    for said in reversed(complaints):
        for pattern in _FRAMES:
            if places := pattern.findall(said):
                name, line = places[-1]
                return f"{os.path.basename(name)}, line {line}"
    return ""


def _end_group(process: subprocess.Popen[str]) -> None:
    """End a program with all of its group; also where it has ended itself and left children behind."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except AttributeError:  # no groups on this system
        process.kill()
    except (ProcessLookupError, PermissionError):
        pass


def _close(pipe: Any) -> None:
    """Close a pipe."""
    try:
        pipe.close()
    except (OSError, ValueError):
        pass


def _and(rubbish: list[str]) -> str:
    """Return what was printed in place of an answer."""
    if not rubbish:
        return ""
    first = rubbish[0].strip()
    if first in ("{", "["):
        return ", printed an answer over several lines: write one JSON object a line"
    if first.startswith('{"') and first.endswith("}"):
        return f", printed an object with neither the question's id nor 'out': {first[:80]!r}"
    return f", printed rubbish: {rubbish[0][:80]!r}"


def _write(pipe: Any, text: str) -> None:
    """Write a request into a program."""
    try:
        pipe.write(text)
        pipe.flush()
    except (OSError, ValueError):
        pass


def _pump(pipe: Any, lines: queue.Queue[str | None], ended: threading.Event) -> None:
    """Put lines of a program into a queue, then None."""
    try:
        while text := pipe.readline(LONGEST_LINE):
            if not _put(lines, text, ended):
                break
    except (OSError, ValueError):
        pass
    _put(lines, None, ended)
    _close(pipe)


def _put(lines: queue.Queue[str | None], text: str | None, ended: threading.Event) -> bool:
    """Put a line where somebody may still take it; whether that was so."""
    while not ended.is_set():
        try:
            lines.put(text, timeout=0.1)
            return True
        except queue.Full:
            pass
    return False


def _keep(pipe: Any, complaints: list[str]) -> None:
    """Keep the last complaints of a program."""
    try:
        while text := pipe.readline(LONGEST_LINE):
            complaints.append(text.strip()[-KEPT:])
            del complaints[:-20]
    except (OSError, ValueError):
        pass
    _close(pipe)
