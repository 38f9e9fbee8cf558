"""The oracle: vectors with computed bars, a judge that names the wrong equation, a zoo of faults that proves it.

Ways in: `load(target)`, `Executable(command)`, `Recorded(path)`. Then `judge.judge(backend)` gives findings,
`verdict(findings, backend)` says what they mean, and `text(verdict)` says it in words. What stands here is loaded when
it is first asked for.
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import Any

#: What is asked for here, and the room in which it is.
_ROOMS = {
    "Executable": "backends.executable", "NumpyEngine": "backends.law", "Recorded": "judge.offline",
    "load": "backends.load", "serve": "backends.json_lines", "text": "reports.terminal", "verdict": "judge.verdict",
}  # fmt: skip
#: Modules by the names that programs made from an example may import, and where they stand.
_ALSO = {
    "backend": "backends.load", "executable": "backends.executable", "in_files": "reports.page",
    "in_words": "reports.terminal", "jsonlines": "backends.json_lines", "law_backend": "backends.law",
    "offline": "judge.offline", "pieces": "backends.rule_set", "verdict": "judge.verdict",
}  # fmt: skip


def __getattr__(name: str) -> Any:
    """Return what stands in a room, loaded now. Raises AttributeError."""
    if name in _ROOMS:
        return getattr(import_module(f"{__name__}.{_ROOMS[name]}"), name)
    if name in _ALSO:
        return import_module(f"{__name__}.{_ALSO[name]}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


class _Also(ModuleType):
    """A module under a second name."""

    def __getattr__(self, name: str) -> Any:
        """Return what the module has. Raises AttributeError."""
        module, _, also = self.__name__.rpartition(".")
        return getattr(import_module(f"{module}.{_ALSO[also]}"), name)


sys.modules.update({f"{__name__}.{name}": _Also(f"{__name__}.{name}") for name in _ALSO})
