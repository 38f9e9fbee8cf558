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
