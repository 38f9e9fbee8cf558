"""From which inputs and with which versions a result was made."""

from __future__ import annotations

import platform
from typing import Any

import numpy as np

#: What is left of the gyroscope's zero in a run [rad/s], about the axes of the block.
ZERO_OFFSETS = ("zero_offset_x", "zero_offset_y", "zero_offset_z")
#: Notes about one release in the origin of a model, which are no properties of the block.
OF_ONE_RELEASE = ("tilt_offset", "roll_offset", *ZERO_OFFSETS)


def versions(experiment) -> dict[str, Any]:
    """Return versions of the program and its libraries, and the digests of the experiment's files."""
    from rockref import __version__

    return {
        "rockref": __version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "experiment": experiment.digest,
    }
