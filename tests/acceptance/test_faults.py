"""Faults of the machine: killed at any moment, no room on the disk, two at once, Ctrl-C. What is there is whole."""

import json
import os
import resource
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from tests.shipped import ROOT

EXPERIMENT = str(ROOT / "data/experiments/mystery-02")
ROCKREF = (sys.executable, "-m", "rockref")
#: A short run with many rows, by the engine that loads least: what is at stake is the file.
SIMULATE = ("simulate", "--engine", "numpy", "--duration", "0.01", "--rate", "1e5", "-o", "response.csv")
#: Commands and the file or folder they are told to write.
COMMANDS = {
    "simulate": SIMULATE,
    "compare": ("compare", EXPERIMENT, "--report", "page"),
}
NAMES = ["simulate", pytest.param("compare", marks=pytest.mark.slow)]
#: The command line in a process that is killed at the n-th call of the system that makes a file whole.
DYING = (sys.executable, "-c", """
import os, signal, sys
from rockref.cli import main
left = int(sys.argv.pop(1))
def dying(call):
    def at(*given, **named):
        global left
        if left == 0:
            os.kill(os.getpid(), signal.SIGKILL)
        left -= 1
        return call(*given, **named)
    return at
for name in ("fsync", "chmod", "replace"):
    setattr(os, name, dying(getattr(os, name)))
main()
""")  # fmt: skip


def files(folder: Path) -> dict[str, bytes]:
    """The files that a user sees there (what is hidden is not whole yet), with their bytes."""
    paths = (p for p in folder.rglob("*") if p.is_file() and not p.name.startswith("."))
    return {str(p.relative_to(folder)): p.read_bytes() for p in paths}


def run(folder: Path, *words: str, **options) -> subprocess.CompletedProcess:
    return subprocess.run((*ROCKREF, *words), cwd=folder, capture_output=True, text=True, **options)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """What a command writes when nothing happens to it, and how long that takes [s]; made when it is asked for."""
    found: dict[str, tuple[dict[str, bytes], float]] = {}

    def of(name: str) -> tuple[dict[str, bytes], float]:
        if name not in found:
            folder = tmp_path_factory.mktemp(name)
            begun = time.monotonic()
            assert run(folder, *COMMANDS[name]).returncode == 0
            found[name] = files(folder), time.monotonic() - begun
            assert found[name][0]
        return found[name]

    return of


def assert_whole(folder: Path, expected: dict[str, bytes]) -> None:
    for path, data in files(folder).items():
        assert data == expected[path], f"{path} is not whole"


@pytest.mark.parametrize("name", NAMES)
def test_killed_while_it_writes_leaves_whole_files_and_the_next_run_is_as_ever(tmp_path, whole, name):
    expected, _ = whole(name)
    for n in range(3 * len(expected)):  # three calls a file
        done = subprocess.run((*DYING, str(n), *COMMANDS[name]), cwd=tmp_path, capture_output=True)
        assert done.returncode == -signal.SIGKILL, done.stderr
        assert_whole(tmp_path, expected)
    assert run(tmp_path, *COMMANDS[name]).returncode == 0
    assert files(tmp_path) == expected


@pytest.mark.slow
@pytest.mark.parametrize("name", COMMANDS)
def test_killed_at_fifty_random_moments_leaves_whole_files(tmp_path, whole, name):
    expected, seconds = whole(name)
    rng = np.random.default_rng(50)
    kills = 0
    for share in rng.random(50):
        process = subprocess.Popen((*ROCKREF, *COMMANDS[name]), cwd=tmp_path, stdout=subprocess.DEVNULL)
        time.sleep(share * seconds)
        kills += process.poll() is None
        process.kill()
        process.wait()
        assert_whole(tmp_path, expected)
    assert kills > 0
    assert run(tmp_path, *COMMANDS[name]).returncode == 0
    assert files(tmp_path) == expected


def limited(most: int) -> None:
    """No file of this process may grow beyond `most` bytes: what a full disk is to it."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))


@pytest.mark.parametrize("name", NAMES)
def test_no_room_ends_with_2_and_leaves_earlier_results(tmp_path, whole, name):
    expected, _ = whole(name)
    path = max(expected, key=lambda p: len(expected[p]))
    earlier = tmp_path / path
    earlier.parent.mkdir(exist_ok=True)
    earlier.write_bytes(b"an earlier result")
    # The tables and pages are larger.
    done = run(tmp_path, *COMMANDS[name], preexec_fn=partial(limited, 20_000))
    assert done.returncode == 2 and "cannot be written" in done.stderr and "Traceback" not in done.stderr
    assert earlier.read_bytes() == b"an earlier result"
    assert not [p for p in tmp_path.rglob(".*") if p.is_file()], "no remains beside it"


def mounted(options: str, first: str, *words: str) -> list[str]:
    """Words of a command that runs in `disk`, a disk of its own; `first` comes before it in a shell, the list of files
    and the beginning of the response after it."""
    script = f'mount -t tmpfs -o {options} tmpfs disk && cd disk && {first} && "$@"; code=$?'
    script += "; ls -A; head -c 8 response.csv; exit $code"
    return ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", script, "sh", *ROCKREF, *words]


def can_mount() -> bool:
    words = ["unshare", "--user", "--map-root-user", "--mount", "mount", "-t", "tmpfs", "tmpfs", "/mnt"]
    try:
        return subprocess.run(words, capture_output=True).returncode == 0
    except OSError:
        return False


@pytest.mark.skipif(not can_mount(), reason="mounting a disk takes a user namespace, which this machine does not allow")
@pytest.mark.parametrize(
    "first", ["head -c 1900000 /dev/zero > full", "mount -o remount,ro ."], ids=["full", "read-only"]
)
def test_a_disk_of_two_megabytes_that_is_full_or_read_only(tmp_path, first):
    (tmp_path / "disk").mkdir()
    before = f"echo precious > response.csv && {first}"
    words = mounted("size=2m", before, *SIMULATE)
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2 and "[E-WRITE]" in "".join(done.stderr.split()), done.stderr
    assert "Traceback" not in done.stderr
    # what was there is there, and nothing beside it
    assert done.stdout.split() == [*(["full"] if "full" in first else []), "response.csv", "precious"]


@pytest.mark.slow
def test_two_at_once_in_one_folder_both_end_well(tmp_path, whole):
    words = COMMANDS["compare"]
    both = [subprocess.Popen((*ROCKREF, *words), cwd=tmp_path, stdout=subprocess.DEVNULL) for _ in range(2)]
    assert [process.wait() for process in both] == [0, 0]
    assert files(tmp_path) == whole("compare")[0]


def as_in_a_terminal():
    """A shell has its background jobs ignore Ctrl-C, these tests perhaps among them, and children inherit that."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


def test_ctrl_c_leaves_a_resumable_search_and_says_so(tmp_path):
    words = ("identify", EXPERIMENT, "-o", "found", "--generations", "2000", "--population", "8", "--workers", "2")
    process = subprocess.Popen(
        (*ROCKREF, *words), cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        start_new_session=True, preexec_fn=as_in_a_terminal,
    )  # fmt: skip
    deadline = time.monotonic() + 300
    while not list(tmp_path.glob("found/**/*.json")):
        assert process.poll() is None and time.monotonic() < deadline, process.communicate()
        time.sleep(0.1)
    os.killpg(process.pid, signal.SIGINT)  # a terminal sends it to the workers, too
    _, err = process.communicate(timeout=120)
    assert process.returncode == 130
    assert "--resume" in err and "Traceback" not in err
    for checkpoint in tmp_path.glob("found/**/*.json"):
        json.loads(checkpoint.read_text())
