"""The loops that are not on disk yet, compiled by a process of their own: numba compiles one at a time in a process.

`python -m rockref.engines.compiled.ahead` compiles them; `rockref.engines.compiled_ahead` has that done beside other
work.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from rockref.engines.compiled import abreast, slots
from rockref.engines.compiled import columns as col
from rockref.engines.compiled.batch import Batch, run_batch

#: The variants in this order. Decided: the law is left to whoever asked, who needs it at once; of the others loads are
#: needed first, by what the release shows, and everything at once last, by pairs.
ORDER = (slots.LOADS, slots.CONTACT, slots.FORCES, slots.MOMENTS, slots.PLATE, slots.SHAKEN, slots.ALL)


def missing() -> list[int]:
    """Return the variants of ORDER of which numba has kept no machine code."""
    folder = Path(abreast.LOOPS[slots.ALL].stats.cache_path)
    names = {groups: abreast.LOOPS[groups].py_func.__qualname__.split(".")[-1] for groups in ORDER}
    return [groups for groups in ORDER if not any(folder.glob(f"*.{names[groups]}-*.nbi"))]


def make(groups: int) -> None:
    """Compile the loop of a variant, or load it: by two runs of which no row is wanted."""
    effects, state = np.zeros((2, slots.SLOTS)), np.zeros((2, col.STATE))
    for group, at in slots.GROUPS.items():
        effects[:, at] = float(bool(groups & group))
    state[:, col.GIVEN] = 1.0  # nothing is evaluated
    batch = Batch(
        body=np.zeros((2, col.BODY)), P=np.zeros((2, 1, 3)), props=np.zeros((2, 1, col.PROPS)),
        memory=np.zeros((2, 1, col.MEMORY)), effects=effects, state=state, h=1.0, wanted=np.array([-1]),
    )  # fmt: skip
    run_batch(batch, workers=1)


if __name__ == "__main__":
    for groups in missing():
        make(groups)
