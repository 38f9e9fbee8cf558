"""A command that is killed at random moments, each time by the program that has forked it.

``python -m tests.acceptance.dying NAME FOLDER KILLS`` prints what was seen, as JSON. What a command needs is loaded and
compiled before, so that the moments fall into its work and its writing.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import sys
import time
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from rockref import cli
from rockref.discover import diagnose as engine
from rockref.identify.from_experiment import answered, question
from rockref.identify.polish import Effort
from rockref.identify.search import Settings
from rockref.jobs.campaign import campaign
from rockref.model.storage import write_text
from tests.shipped import two_runs


def identify(experiment: Path, folder: Path) -> None:
    """An identification with a small budget; it goes on from what is there."""
    effort = Effort(windows=(), steps=1, moves=0)
    settings = Settings(4, 12, seed=3)
    with campaign(1) as work:
        record, model = answered(question(experiment), settings, work, folder, resume=True, effort=effort, rounds=0)
    write_text(folder / "result.json", json.dumps(record))
    model.save(folder / "model.toml")


def report(experiment: Path, folder: Path) -> None:
    """Comparing, and the page with its figures."""
    cli.main(["compare", str(experiment), "--report", str(folder / "page")])


@lru_cache
def made_up() -> Any:
    """A diagnosis without the minutes of work, in which nothing is written."""
    from tests.unit.discover import fakes

    return fakes.diagnosis("named", fakes.made_experiment())


def diagnose(experiment: Path, folder: Path) -> None:
    """Writing a diagnosis: page, record, model."""
    engine.diagnose = lambda *a, **k: made_up()  # type: ignore[assignment]
    out = ["-o", str(folder / "record.json"), "--save-model", str(folder / "model.toml")]
    cli.main(["diagnose", "anywhere", "--report", str(folder / "page"), *out])


def golden(experiment: Path, folder: Path) -> None:
    """The vectors of two pieces and the manifest, made anew beside those that are shipped."""
    from golden.generator import make

    if not (folder / "MANIFEST.json").exists():
        for path in make.FOLDER.glob("*.*"):
            write_text(folder / path.name, path.read_text()) if path.suffix == ".json" else None
    make.FOLDER = folder
    make.small_layers.LAYERS = make.small_layers.LAYERS[:1]
    make.make(("small",))


COMMANDS: dict[str, Callable[[Path, Path], None]] = {c.__name__: c for c in (identify, report, diagnose, golden)}


def born(command: Callable[[Path, Path], None], experiment: Path, folder: Path) -> int:
    """A process that runs the command in silence and ends."""
    pid = os.fork()
    if pid:
        return pid
    try:
        quiet = os.open(os.devnull, os.O_WRONLY)
        os.dup2(quiet, 1)
        command(experiment, folder)
    except SystemExit as end:
        os._exit(int(end.code or 0))
    except BaseException:
        import traceback

        traceback.print_exc()
        os._exit(99)
    os._exit(0)


def visible(folder: Path) -> dict[str, bytes]:
    """The files that a user sees (what is hidden is not whole yet)."""
    paths = (p for p in folder.rglob("*") if p.is_file() and not p.name.startswith("."))
    return {str(p.relative_to(folder)): p.read_bytes() for p in paths}


def whole(name: str, data: bytes, expected: dict[str, bytes]) -> bool:
    """Whether a file is what an undisturbed command leaves, or a checkpoint on the way to it."""
    if data == expected.get(name):
        return True
    try:
        return name.endswith(".json") and name != "result.json" and isinstance(json.loads(data), dict)
    except ValueError:
        return False


def main(name: str, place: Path, kills: int) -> dict[str, object]:
    """Run undisturbed, then be killed so many times, in a new folder whenever a run came to its end."""
    command, experiment = COMMANDS[name], two_runs(place / "experiment")
    if name == "diagnose":
        made_up()
    (place / "undisturbed").mkdir()
    for _ in range(2):  # the first one compiles
        shutil.rmtree(place / "undisturbed")
        (place / "undisturbed").mkdir()
        begun = time.monotonic()
        _, status = os.waitpid(born(command, experiment, place / "undisturbed"), 0)
        assert os.waitstatus_to_exitcode(status) in (0, 1), status
        seconds = time.monotonic() - begun
    expected = visible(place / "undisturbed")
    rng, done, ended, broken = np.random.default_rng(kills), 0, 0, set[str]()
    while True:
        folder = place / f"life{ended}"
        folder.mkdir(exist_ok=True)
        pid = born(command, experiment, folder)
        if done < kills:
            time.sleep(rng.random() * seconds)
            os.kill(pid, signal.SIGKILL)
        _, status = os.waitpid(pid, 0)
        found = visible(folder)
        broken |= {file for file, data in found.items() if not whole(file, data, expected)}
        if os.waitstatus_to_exitcode(status) == -signal.SIGKILL:
            done += 1
            continue
        ended += 1
        broken |= {f"{file} differs" for file in expected | found if expected.get(file) != found.get(file)}
        if done >= kills:
            return {"files": sorted(expected), "kills": done, "ended": ended, "broken": sorted(broken)}


if __name__ == "__main__":
    print(json.dumps(main(sys.argv[1], Path(sys.argv[2]), int(sys.argv[3]))))
