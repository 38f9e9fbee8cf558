"""Runs of the law in NumPy, hundreds of them: a minute in all, so these tests belong to `make test-all`."""

from pathlib import Path

import pytest

RUNS = [Path(__file__).parent / name for name in ("test_runs.py", "test_symmetries.py")]


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    for item in items:
        if item.path in RUNS:
            item.add_marker(pytest.mark.slow)
