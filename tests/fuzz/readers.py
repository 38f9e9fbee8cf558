"""Every reader of what strangers give, as a function of bytes alone: for a fuzzer, and for the tests.

A reader takes what it is given, or refuses it by an error of rockref's own with place, reason and cure. Any other
exception is a fault, and so are a file touched outside of its folder and a message that nobody could read.

Several files in one piece of data stand below lines ``%%% name how``, where `how` is nothing, `gz` (packed), `link` (to
the path that is its content), `folder` or `pipe`.
"""

from __future__ import annotations

import contextlib
import gzip
import hashlib
import io
import json
import os
import queue
import re
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any
from unittest import mock
from xml.etree import ElementTree

from rockref.api import Model
from rockref.conformance import vectors
from rockref.conformance.backends import json_lines
from rockref.conformance.backends.executable import Executable, Misbehaved
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge import claims, offline
from rockref.conformance.judge.findings import Findings, answered, described
from rockref.conformance.judge.trajectories import judge_rows
from rockref.conformance.judge.verdict import as_json, verdict
from rockref.conformance.reports import terminal
from rockref.conformance.reports.junit import junit
from rockref.conformance.reports.page import badge
from rockref.conformance.reports.page import page as page_of
from rockref.conformance.vectors import Vector, shipped
from rockref.effects import catalogue
from rockref.measure.experiment import load_experiment
from rockref.measure.reading.table import read_table
from rockref.measure.reading.tensorfile import read_tensor
from rockref.measure.tosses.load import is_toss_folder, load_tosses
from rockref.model.errors import InputError, NumericalError
from tests.fuzz.watch import watched

NEEDED = ("t", "wx", "wy", "wz")
#: Beside the folder of a reader: what it must not read.
DECOY = "secret.csv"
_FILE = re.compile(rb"^%%% ?([^\n]{0,80})\n", re.MULTILINE)
_NAME = re.compile(r"(L5/)?[A-Za-z0-9_.-]{1,40}", re.ASCII)
_CODE = re.compile(r"[EW](-[A-Z0-9]+)+")
#: A message has a page at most; decided. Paths and what was found in a file are in it.
LONGEST_MESSAGE = 2000


@contextmanager
def reading(folder: Path, output: Path | None = None, anywhere: bool = False) -> Iterator[None]:
    """What happens inside may end in an error of rockref's own; it is watched."""
    with watched(folder, output, anywhere):
        try:
            yield
        except (InputError, NumericalError) as e:
            assert _CODE.fullmatch(e.code), e.code
            assert all(part.strip() for part in (e.where, e.what, e.cure)), str(e)
            assert len(str(e)) <= LONGEST_MESSAGE, f"a message of {len(str(e))} characters: {str(e)[:300]}"


def laid_out(data: bytes, folder: Path) -> list[str]:
    """Put the files of the data into the empty folder; their names."""
    head, *parts = _FILE.split(data)
    names = []
    for title, content in zip(parts[::2], parts[1::2], strict=True):
        name, _, how = title.decode("ascii", "replace").partition(" ")
        path = folder / name
        if not _NAME.fullmatch(name) or name in (".", "..", "L5/.", "L5/..") or os.path.lexists(path):
            continue
        path.parent.mkdir(exist_ok=True)
        if how == "link":
            target = os.fsdecode(content.replace(b"\0", b"").strip()[:200])
            if not target:
                continue
            path.symlink_to(target)
        elif how == "folder":
            path.mkdir()
        elif how == "pipe":
            os.mkfifo(path)
        else:
            path.write_bytes(gzip.compress(content, 1, mtime=0) if how == "gz" else content)
        names.append(name)
    return names


def emptied(folder: Path) -> Path:
    """The folder with nothing in it."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def experiment(data: bytes, folder: Path) -> None:
    """An experiment folder: experiment.toml and the tables of its runs."""
    laid_out(data, folder)
    with reading(folder):
        is_toss_folder(folder)
        found = load_experiment(folder)
        assert found.fit_runs() and found.digest


def table(data: bytes, folder: Path) -> None:
    """A table of a run, packed where the first byte is odd."""
    packed, content = data[:1] and data[0] % 2, data[1:]
    path = folder / ("run.csv.gz" if packed else "run.csv")
    path.write_bytes(content)
    with reading(folder):
        assert read_table(path, NEEDED).rows


def tosses(data: bytes, folder: Path) -> None:
    """A folder of tosses: one table, or an experiment of kind toss."""
    laid_out(data, folder)
    with reading(folder):
        is_toss_folder(folder)
        found = load_tosses(folder)
        assert found.tosses and found.rate > 0


def tensor(data: bytes, folder: Path) -> None:
    """A file of a tensor."""
    path = folder / "0.pt"
    path.write_bytes(data)
    with reading(folder):
        read_tensor(path)


def model(data: bytes, folder: Path) -> None:
    """A model file. What loads is written, and what was written reads back and is written the same."""
    path, out = folder / "model.toml", folder / "out"
    out.mkdir()
    path.write_bytes(data)
    with reading(folder, out):
        found = Model.load(path)
        found.save(out / "model.toml")
        Model.load(out / "model.toml").save(out / "again.toml")
        assert (out / "model.toml").read_bytes() == (out / "again.toml").read_bytes()
        found.problem(duration=0.01)


def effect(data: bytes, folder: Path) -> None:
    """An effect in words, as on the command line, which may name a file anywhere; in a folder without any."""
    with contextlib.chdir(folder), reading(folder, anywhere=True):
        found = catalogue.parse(os.fsdecode(data))
        found.values()
        found.is_absent()


def stored(data: bytes, folder: Path) -> None:
    """Files of vectors. Where the data has no manifest, one with their digests is made: what lies behind is reached."""
    names = laid_out(data, folder)
    if "MANIFEST.json" not in names:
        whole = [n for n in names if (folder / n).is_file() and not (folder / n).is_symlink()]
        digests = {n: {"sha256": hashlib.sha256((folder / n).read_bytes()).hexdigest()} for n in whole}
        text = json.dumps({"files": digests, "trajectories": ["run"], "windows": []})
        (folder / "MANIFEST.json").write_text(text)
    try:
        with mock.patch.object(shipped, "folder", lambda: folder):
            forgotten()
            for name in [n[:-5] for n in names if n.endswith(".json") and n != "MANIFEST.json"]:
                with reading(folder):
                    if name.startswith("L5/"):
                        vectors.trajectory(name[3:])
                    elif name == "LE":
                        claims.claims()
                    else:
                        vectors.layer(name)
    finally:
        forgotten()


def forgotten() -> None:
    """Forget what was read of the vectors."""
    for kept in (vectors.manifest, vectors.layer, vectors.trajectory, claims.claims):
        kept.cache_clear()


@lru_cache
def questions() -> tuple[Vector, ...]:
    """One vector for every piece, which a program is asked in this order."""
    every = [v for layer in offline.SMALL for v in vectors.layer(layer)]
    return tuple({v.piece: v for v in every}.values())


class Canned(Executable):
    """A program that prints what it was given, whatever it is asked."""

    def __init__(self, lines: list[str]):
        self.given = lines
        super().__init__(["canned"], small=0.2, long=0.2)

    def _spawn(self) -> None:
        self.process: Any = mock.Mock(stdin=io.StringIO())
        self.process.wait.return_value = 0
        self.lines = queue.Queue()
        for text in [*self.given, None]:
            self.lines.put(text)

    def close(self) -> None:
        """Nothing runs."""
        self.process = None


def program(data: bytes, folder: Path) -> None:
    """What a program answers on its standard output, through the judge to the verdict in words and files."""
    questions()
    lines = data.decode("utf-8", "replace").splitlines(keepends=True)
    with reading(folder):
        backend = Canned(lines)
        findings = Findings(described(backend), "float64", ("L1", "L5"))
        for vector in questions():
            if callable(getattr(backend, vector.piece, None)):
                findings.checks += answered(backend, vector, "float64")
        run = vectors.trajectory(RUN)
        try:
            findings.runs = [judge_rows(run, backend.simulate(run.problem), "float64")]
        except Misbehaved:
            pass
        findings.effects = claims.judge_claims(backend) if len(data) % 8 == 0 else []
        told(findings)


#: The run that a program is asked for.
RUN = "window_spinning_0050ms"


def told(findings: Findings) -> None:
    """A verdict in every form: words, JSON, JUnit that a parser reads, badge, page."""
    found = verdict(findings)
    terminal.text(found, True).encode()
    json.dumps(as_json(found), allow_nan=False)
    ElementTree.fromstring(junit(found))
    ElementTree.fromstring(badge(found))
    page_of(found).encode()


def answers(data: bytes, folder: Path) -> None:
    """A file of answers, as `rockref conform judge` reads it."""
    path = folder / "responses.jsonl"
    path.write_bytes(data)
    offline._by_content()
    questions()
    with reading(folder):
        backend = offline.Recorded(path)
        assert isinstance(backend.layers, set)
        for vector in questions():
            if callable(getattr(backend, vector.piece, None)):
                answered(backend, vector, "float64")


class Reading(NumpyEngine):
    """A backend that reads what it is asked, and does not run it: how long a run is, is the asker's affair."""

    def simulate(self, problem: Any) -> Any:
        """Facts of the problem in place of a run."""
        return {"t": [problem.duration]}

    def step(self, problem: Any) -> Any:
        """The same."""
        return {"t": [problem.step]}

    def effect(self, problem: Any, effect: str, parameters: Any) -> Any:
        """Nothing is claimed."""
        return None


def requests(data: bytes, folder: Path) -> None:
    """Questions to a backend, on its standard input and as a file: every line is answered by one line of JSON."""
    path, out = folder / "requests.jsonl", io.StringIO()
    path.write_bytes(data)
    lines = data.decode("utf-8", "replace").split("\n")
    with watched(folder):
        json_lines.serve(Reading(), lines, out)
    said = [json.loads(line) for line in out.getvalue().splitlines()]
    assert len(said) <= len(lines) and all(isinstance(reply, dict) for reply in said)
    with reading(folder):
        for request in offline.requests_in(path):
            json_lines.line(json_lines.answer(Reading(), request))


READERS: dict[str, Callable[[bytes, Path], None]] = {
    reader.__name__: reader
    for reader in (experiment, table, tosses, tensor, model, effect, stored, program, answers, requests)
}


def tried(name: str, data: bytes, folder: Path) -> None:
    """Give the data to a reader, in a folder of its own beside a decoy."""
    here = Path.cwd()
    READERS[name](data, emptied(folder))
    assert Path.cwd() == here
