"""A standard error that says it is a terminal, and keeps what it is sent."""

import io
import sys

import pytest


class Terminal(io.StringIO):
    """Text with the answer of a terminal."""

    def isatty(self):
        return True


def put_in_place(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    """A terminal of 200 columns as standard error, whatever the environment of the tests is.

    To be called in the test itself: pytest puts its own standard error in place after the fixtures.
    """
    for name in ("NO_COLOR", "FORCE_COLOR", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "200")
    made = Terminal()
    monkeypatch.setattr(sys, "stderr", made)
    return made
