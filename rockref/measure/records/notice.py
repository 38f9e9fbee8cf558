"""What is odd in the input, but can be worked with."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Notice:
    """A warning about the input: nothing is refused, but a person should know.

    Parameters
    ----------
    code : stable identifier, for example ``"W-GAP-FILLED"``
    where : the file, and the line, column or key in it
    what : what was found
    cure : what to do about it, or what was done
    """

    code: str
    where: str
    what: str
    cure: str

    def __str__(self) -> str:
        return f"{self.where}: {self.what}. {self.cure} [{self.code}]"


def shown(text: str, width: int = 40) -> str:
    """Return `text` as one short quoted piece for a message."""
    return repr(text if len(text) <= width else text[: width - 3] + "...")
