"""From six files of a logger to a named effect: four commands, nothing edited, a block that another simulator made."""

import os
import re
import shlex
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rockref.blind.cases.generator import make_case
from rockref.measure import load_experiment
from tests import foreign

ROCKREF = str(Path(sys.executable).with_name("rockref"))
#: Feet off Table 3.1 by a third (log-normal), and what is hidden.
SPREAD, HIDDEN, SEED = 0.35, "rolling_resistance", 7


@pytest.mark.slow
def test_six_foreign_files_lead_to_the_hidden_effect(tmp_path):
    truth = make_case(tmp_path / "made", [HIDDEN], SEED, spread=SPREAD, other_form=False)
    made = load_experiment(tmp_path / "made")
    assert len(foreign.write_logs(made, tmp_path / "logs", "semicolons")) == 6
    sides = f"--mass {made.mass}kg --width {made.width}m --height {made.height}m"
    typed = f"rockref new block logs {sides} --bandwidth 300Hz"
    commands, said = [], ""
    while typed is not None and len(commands) < 6:
        commands.append(typed)
        began = time.monotonic()
        done = subprocess.run(
            [ROCKREF, *shlex.split(typed)[1:]], cwd=tmp_path, capture_output=True, text=True,
            env={**os.environ, "ROCKREF_CACHE": str(tmp_path / "kept")},
        )  # fmt: skip
        print(f"$ {typed}\n{done.stdout}{done.stderr}({time.monotonic() - began:.0f} s)\n")
        assert done.returncode == 0, done.stderr
        assert typed.startswith("rockref new") or len(done.stdout.splitlines()) <= 14
        said += done.stdout
        # A newcomer types what the last line proposes, until the effect is added.
        proposed = re.search(r"^Next: (rockref .*)$", done.stdout, re.MULTILINE)
        typed = None if typed.startswith("rockref add") or proposed is None else proposed[1]
    assert [line.split()[1] for line in commands] == ["new", "compare", "diagnose", "add"]
    assert f"NAMED (probability 1.00). {HIDDEN} is missing" in said
    (effect,) = truth["effects"]
    found = float(re.search(rf"{HIDDEN}\.lever = ([\d.]+) mm", said)[1])
    # The recovery is exact to a few per cent where the form is that of the catalogue.
    assert found == pytest.approx(1e3 * effect["parameters"]["lever"], rel=0.2)
    assert (tmp_path / "report" / "index.html").is_file()
