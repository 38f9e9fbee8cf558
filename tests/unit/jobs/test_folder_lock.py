"""A folder of checkpoints belongs to one process at a time; who comes second is told so, and changes nothing."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rockref.blind.cases import making, sealing
from rockref.jobs.folder_lock import alone_in
from rockref.model.errors import InputError
from tests.command import run
from tests.shipped import two_runs
from tests.tosses import write_tosses

pytest.importorskip("fcntl", reason="this system cannot lock a folder")
#: Another process that holds a folder and says so, until it is ended.
OTHER = """
import sys, time
from pathlib import Path
from rockref.jobs.folder_lock import alone_in
with alone_in(Path(sys.argv[1])):
    print("held", flush=True)
    time.sleep(600)
"""


@pytest.fixture
def other(tmp_path):
    """A process that holds `tmp_path`."""
    process = subprocess.Popen([sys.executable, "-c", OTHER, str(tmp_path)], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "held\n"
    yield process
    process.kill()
    process.wait()
    process.stdout.close()


def test_a_folder_that_another_process_holds_is_refused(tmp_path, other):
    with pytest.raises(InputError) as refused, alone_in(tmp_path):
        pass
    assert refused.value.code == "E-BUSY" and str(tmp_path) in str(refused.value)


def test_it_is_free_when_that_process_is_killed_or_done_and_no_file_is_left(tmp_path, other):
    os.kill(other.pid, signal.SIGKILL)
    other.wait()
    for _ in range(2):
        with alone_in(tmp_path):
            pass
    assert not list(tmp_path.iterdir())


def test_it_is_free_after_an_error(tmp_path):
    with pytest.raises(ZeroDivisionError), alone_in(tmp_path):
        raise ZeroDivisionError
    with alone_in(tmp_path):
        pass


def test_what_cannot_be_locked_is_worked_in_all_the_same(tmp_path, monkeypatch):
    """A network disk may know no locks."""
    import fcntl

    def refuse(descriptor, how):
        raise OSError(37, "No locks available")

    monkeypatch.setattr(fcntl, "flock", refuse)
    with alone_in(tmp_path):
        pass


@pytest.mark.parametrize(
    "words",
    [
        "identify EXPERIMENT -o HERE",
        "reproduce source HERE --quick --data anywhere",
        "reproduce cube HERE --quick --data TOSSES",
        "blind make HERE --seed 1",
        "blind score HERE",
    ],
)
def test_commands_that_work_long_in_a_folder_refuse_it_before_the_work(
    tmp_path, tmp_path_factory, capsys, words, other
):
    data = tmp_path_factory.mktemp("data")
    two_runs(data / "EXPERIMENT")
    write_tosses(data / "TOSSES", np.zeros((1, 30, 3)), np.broadcast_to(np.eye(3), (1, 30, 3, 3)))
    for name in ("EXPERIMENT", "TOSSES"):
        words = words.replace(name, str(data / name))
    (tmp_path / sealing.MANIFEST).write_text("{}")
    (tmp_path / sealing.SEALED).write_text("{}")
    before = {p: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()}
    code, _, err = run(capsys, *words.replace("HERE", str(tmp_path)).split())
    assert code == 2 and "[E-BUSY]" in err
    assert {p: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()} == before


def test_a_test_that_another_process_has_sealed_meanwhile_is_left_alone(tmp_path):
    (tmp_path / sealing.MANIFEST).write_text("{}")
    with pytest.raises(InputError, match="E-SEALED"):
        making.make(tmp_path, 1, 1)
    assert [p.name for p in Path(tmp_path).iterdir()] == [sealing.MANIFEST]
