"""What a command keeps for the ones that follow: also of work that is interrupted."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated

import typer

from rockref.model.errors import Interrupted

if TYPE_CHECKING:
    from rockref.discover.fit_store import FitStore

#: What every command takes that starts from kept fits.
Fresh = Annotated[bool, typer.Option("--fresh", help="Compute anew, whatever an earlier command has kept.")]


@contextmanager
def keeping(fresh: bool = False) -> Iterator[FitStore]:
    """Give the store of kept fits; on an interruption keep what was found, and say so.

    fresh : nothing that was kept before is used. Raises Interrupted.
    """
    from rockref.discover.fit_store import FitStore

    store = FitStore(fresh=fresh)
    try:
        yield store
        store.save()
    except KeyboardInterrupt:
        store.save()
        raise Interrupted(interruption(store)) from None
    finally:
        if store.remark is not None:
            print(f"rockref: {store.remark}", file=sys.stderr)


def interruption(store: FitStore) -> str:
    """Return what was kept of interrupted work, and how to go on."""
    best = store.best()
    if store.path is None or store.remark is not None or best is None:
        return "interrupted. Nothing was found yet that could be kept; no file was written."
    fits = len(store.kept["fits"])
    states = [state["stage"] for state in store.kept["searches"].values()]
    name = " + ".join(best["effects"]) or "the baseline"
    said = f"interrupted. Kept: {fits} {'fit' if fits == 1 else 'fits'}"
    said += f" and the search after stage {states[-1]}" if states else ""
    return (
        f"{said}; best so far: {name}, mean loss {best['loss']:.2f} at stage {best['stage']} (white noise: 0.95). "
        "No file was written. The same command, without --fresh, goes on from them; rockref fit and rockref add start "
        "from them, too."
    )
