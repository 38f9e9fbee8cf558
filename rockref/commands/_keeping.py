"""What a command keeps for the ones that follow: also of work that is interrupted."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from rockref.model.errors import Interrupted

if TYPE_CHECKING:
    from rockref.discover.fit_store import FitStore


@contextmanager
def keeping(fresh: bool = False, starts_from: Callable[[], Iterable[set[str]]] | None = None) -> Iterator[FitStore]:
    """Give the store of kept fits; on an interruption keep what was found, and say so.

    fresh : nothing that was kept before is used.  starts_from : gives the sets of effects whose kept fits the command
    starts from; None where it goes on with a search.  Raises Interrupted.
    """
    from rockref.discover.fit_store import FitStore

    store = FitStore(fresh=fresh)
    try:
        yield store
        store.save()
    except KeyboardInterrupt:
        store.save()
        raise Interrupted(interruption(store, starts_from)) from None
    finally:
        if store.remark is not None:
            print(f"rockref: {store.remark}", file=sys.stderr)


@contextmanager
def kept(store: FitStore) -> Iterator[None]:
    """Say of an interruption after the work, while results are written, that the work is kept. Raises Interrupted."""
    try:
        yield
    except KeyboardInterrupt:
        there = store.path is not None and store.remark is None
        said = "What was found is kept: the same command, without --fresh, starts from it." if there else ""
        raise Interrupted(f"interrupted. {said or 'Nothing could be kept: start it again.'}") from None


@contextmanager
def checkpoints_in(folder: Path) -> Iterator[None]:
    """Say of an interrupted search which checkpoints it has left in a folder. Raises Interrupted."""
    try:
        yield
    except KeyboardInterrupt:
        there = sorted(path.name for path in folder.glob("*.json"))
        said = f"Kept in {folder}: {', '.join(there)}; the same command with --resume goes on from there."
        nothing = "No generation was ended, so that nothing is kept: start it again."
        raise Interrupted(f"interrupted. {said if there else nothing}") from None


def interruption(store: FitStore, starts_from: Callable[[], Iterable[set[str]]] | None = None) -> str:
    """Return what was kept of interrupted work, and which command goes on from it."""
    best = store.best()
    if store.path is None or store.remark is not None or best is None:
        return "interrupted. Nothing was found yet that could be kept; no file was written."
    fits = store.kept["fits"].values()
    states = [state["stage"] for state in store.kept["searches"].values()]
    name = " + ".join(best["effects"]) or "the baseline"
    counted = f"{len(fits)} {'fit' if len(fits) == 1 else 'fits'}"
    said = f"interrupted. Kept: {counted}, the best of {name}; no file was written."
    if starts_from is None:
        again = "begins its search anew; rockref fit and rockref add start from kept fits"
        if states:
            again = f"without --fresh, goes on with the search after stage {states[-1]}"
    elif any(set(fit["effects"]) in [*starts_from()] for fit in fits):
        again = "without --fresh, starts from what was kept"
    else:
        again = "starts anew, for none of these fits is of the effects that it fits"
    return f"{said} The same command{',' if again.startswith('without') else ''} {again}."
