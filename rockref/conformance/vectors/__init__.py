"""The vectors as they are shipped, and what their results are called."""

from rockref.conformance.vectors.shipped import (
    AS_RUN,
    LARGEST,
    SCHEMA,
    Expected,
    Trajectory,
    Vector,
    as_shipped,
    flat,
    from_hex,
    layer,
    manifest,
    problem_of,
    read_bytes,
    steps_as_runs,
    trajectory,
    trajectory_names,
    value_of,
    vector_of,
    window_names,
)

__all__ = [
    "AS_RUN", "LARGEST", "SCHEMA", "Expected", "Trajectory", "Vector", "as_shipped", "flat", "from_hex", "layer",
    "manifest", "problem_of", "read_bytes", "steps_as_runs", "trajectory", "trajectory_names", "value_of", "vector_of",
    "window_names",
]  # fmt: skip
