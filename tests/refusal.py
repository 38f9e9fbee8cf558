"""What the package refuses, as a test asks for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from rockref.model.errors import InputError


def refused(call: Callable[..., Any], *arguments: Any, **named: Any) -> InputError:
    """The error by which the call is refused."""
    with pytest.raises(InputError) as caught:
        call(*arguments, **named)
    return caught.value


def refusal(call: Callable[..., Any], *arguments: Any) -> tuple[str, str, str, str]:
    """The four parts of that error: code, place, what is wrong, cure."""
    error = refused(call, *arguments)
    return error.code, error.where, error.what, error.cure
