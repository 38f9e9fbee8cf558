"""What a check found, as plain values."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any

#: A check passes, fails, remarks on something that is no fault, or could not judge.
VERDICTS = ("pass", "fail", "remark", "not judged")


@dataclass(frozen=True)
class Finding:
    """The answer of one check.

    check : its name;  verdict : one of `VERDICTS`
    measured : what the engine showed;  reference : what mechanics says;  bar : the tolerance, each as text
    seen : a failure or remark in words;  cause : a key of `causes.CAUSES`, where the signature is known
    numbers : the raw figures, SI units
    """

    check: str
    verdict: str
    measured: str
    reference: str = ""
    bar: str = ""
    seen: str = ""
    cause: str = ""
    numbers: dict[str, float] = field(default_factory=dict)

    def as_dict(self) -> dict[str, Any]:
        """Return the finding as plain values for JSON."""
        return asdict(self)


def judged(check: str, good: bool, measured: str, reference: str, bar: str, seen: str, cause: str = "",
           numbers: dict[str, float] | None = None) -> Finding:  # fmt: skip
    """Return a pass without words, or a failure with words and cause."""
    if good:
        return Finding(check, "pass", measured, reference, bar, numbers=numbers or {})
    return Finding(check, "fail", measured, reference, bar, seen, cause, numbers or {})


def percent(ratio: float) -> str:
    """Return a relative deviation in percent with two digits, "+41 %"."""
    value = 100 * ratio
    digits = 0 if abs(value) >= 10 else 1 if abs(value) >= 1 else 2 if abs(value) >= 0.1 else 3
    return f"{value:+.{digits}f} %"
