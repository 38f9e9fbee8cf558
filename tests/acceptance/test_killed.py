"""Killed at random moments, a command leaves whole files, and its next run ends as if nothing had been."""

import json
import os
import subprocess
import sys

import pytest

from tests.shipped import ROOT


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are forked, so that they need not load first")
@pytest.mark.parametrize("name, kills", [("diagnose", 100), ("golden", 20), ("report", 30)])
def test_no_file_is_half_and_the_next_run_gives_the_same_bytes(tmp_path, name, kills):
    pytest.importorskip("numba")
    words = [sys.executable, "-m", "tests.acceptance.dying", name, str(tmp_path), str(kills)]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    seen = json.loads(done.stdout.splitlines()[-1])
    assert seen["kills"] == kills and seen["files"] and seen["ended"] >= 1
    assert seen["broken"] == []
