"""The command line as a test calls it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from rockref import cli


def run(capsys, *words) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of `rockref WORDS`."""
    with pytest.raises(SystemExit) as end:
        cli.main([str(word) for word in words])
    return end.value.code, *capsys.readouterr()


def of(verb: str) -> Callable[..., tuple[int, str, str]]:
    """What takes capsys and the words after `rockref VERB`."""
    return lambda capsys, *words: run(capsys, verb, *words)
