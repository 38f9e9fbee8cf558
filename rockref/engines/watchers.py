"""Who is told when the compiled engine begins to compile."""

from __future__ import annotations

from collections.abc import Callable

#: Called, without arguments, when the compiled engine begins to compile, which it does once on a machine.
compile_watchers: list[Callable[[], None]] = []
