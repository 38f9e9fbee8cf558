"""A long study in pieces, each kept on disk when it is done: a study that was interrupted goes on where it was."""

from __future__ import annotations

import json
from collections.abc import Callable, Hashable, Iterable, Sequence
from pathlib import Path
from typing import Any

from rockref.model.errors import InputError
from rockref.model.storage import write_text

SCHEMA = "rockref-piece-1"


class Pieces:
    """Results in `folder`, a JSON file each, that belong to `identity` (versions) and to what each is `of` (budget,
    digests of inputs). A file of another identity is not used, and is replaced.
    """

    def __init__(self, folder: Path, identity: dict[str, Any]):
        self.folder, self.identity = folder, identity

    def kept(self, name: str, of: Any = None) -> dict[str, Any] | None:
        """Return result of a piece that is done, or None. Raises InputError (E-FILE) where the file cannot be read."""
        path = self._path(name)
        if not path.exists():
            return None
        try:
            stored = json.loads(path.read_text(encoding="utf-8"))
            return stored["result"] if stored["identity"] == self._identity(of) else None
        except (OSError, ValueError, KeyError, TypeError) as e:
            raise InputError("E-FILE", str(path), f"is no piece of a study ({e})", "Remove the file.") from e

    def once(self, name: str, make: Callable[[], dict[str, Any]], of: Any = None) -> dict[str, Any]:
        """Return the result of a piece: kept, or made now and written whole."""
        found = self.kept(name, of)
        if found is None:
            found = self._keep(name, make(), of)
        return found

    def each(
        self,
        name: str,
        keys: Sequence[Hashable],
        make: Callable[[list], Iterable[tuple[int, dict[str, Any]]]],
        of: Any = None,
    ) -> list[dict[str, Any]]:
        """Return the results of pieces of one kind, in the order of their keys.

        make : takes the keys that are left and gives (index, result) as they are done; each is kept at once.
        """
        left = [key for key in keys if self.kept(f"{name}_{key}", of) is None]
        for i, result in make(left) if left else ():
            self._keep(f"{name}_{left[i]}", result, of)
        return [self.once(f"{name}_{key}", dict, of) for key in keys]

    def _path(self, name: str) -> Path:
        return self.folder / f"{name}.json"

    def _identity(self, of: Any) -> Any:
        """Return an item as it comes back from a file."""
        return json.loads(json.dumps({**self.identity, "of": of}))

    def _keep(self, name: str, result: dict[str, Any], of: Any) -> dict[str, Any]:
        text = json.dumps({"schema": SCHEMA, "identity": self._identity(of), "result": result}, indent=1)
        write_text(self._path(name), text + "\n")
        return json.loads(text)["result"]
