"""From which inputs and with which versions a result was made."""

from __future__ import annotations

import platform
from typing import Any

import numpy as np


def versions(experiment) -> dict[str, Any]:
    """Return versions of the program and its libraries, and the digests of the experiment's files."""
    from rockref import __version__

    return {
        "rockref": __version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "experiment": experiment.digest,
    }
