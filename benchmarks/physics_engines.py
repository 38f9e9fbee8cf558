"""Judge every physics engine that is installed, and write the results as Markdown.

    pip install 'rockref[engines-all]'
    python benchmarks/physics_engines.py                 # all engines that rockref has an adapter for
    python benchmarks/physics_engines.py mujoco mine.py --output page.md

Every engine runs in a process of its own: their libraries do not always bear one another.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

from rockref.conformance.physics.adapter import KNOWN
from rockref.conformance.physics.page import page

PAGE = Path(__file__).with_suffix(".md")


def judged(engine: str) -> dict[str, Any] | str:
    """Return the profile of an engine, or why it did not run."""
    command = [sys.executable, "-m", "rockref", "conform", "physics", engine, "--json"]
    done = subprocess.run(command, capture_output=True, text=True)
    # Some engines greet on standard output before the JSON begins.
    begin = done.stdout.find("[\n {")
    if done.returncode in (0, 1) and begin >= 0:
        return json.loads(done.stdout[begin:])[0]
    return (done.stderr.strip().splitlines() or [f"ended with {done.returncode}"])[-1]


def main() -> None:
    """Judge the engines that are named, or all, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("engines", nargs="*", default=list(KNOWN), help="names or files; all by default")
    parser.add_argument("--output", type=Path, default=PAGE, help="the page to write")
    asked = parser.parse_args()
    profiles, skipped = [], {}
    for engine in asked.engines:
        print(engine, flush=True)
        found = judged(engine)
        if isinstance(found, str):
            skipped[engine] = found
        else:
            profiles.append(found)
    asked.output.write_text(page(profiles, skipped), encoding="utf-8")


if __name__ == "__main__":
    main()
