"""The tutorial backend in C, compiled once."""

import subprocess
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[3] / "examples/backend_c/backend.c"


@pytest.fixture(scope="session")
def compiled(tmp_path_factory):
    """A function: compiler options -> path of the program. No warning is let through."""
    folder = tmp_path_factory.mktemp("backend_c")

    def compile_with(*options):
        path = folder / ("backend" + "".join(c for c in "".join(options) if c.isalnum()))
        if not path.exists():
            warnings = ["-Wall", "-Wextra", "-Werror"]
            subprocess.run(["gcc", "-O2", *warnings, *options, "-o", str(path), str(SOURCE), "-lm"], check=True)
        return path

    return compile_with
