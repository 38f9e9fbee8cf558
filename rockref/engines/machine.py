"""What this machine is, and whether its arithmetic is the one for which trajectories are promised by bits."""

import importlib.metadata
import importlib.util
import os
import platform
import sys
from typing import Any

import numpy as np

# (1 + 2^-27)(1 - 2^-27) = 1 - 2^-54 lies halfway between two doubles and rounds to 1: product and sum rounded
# one after the other give 0, a fused multiply-add gives -2^-54.
_A, _B, _C = 1.0 + 2.0**-27, 1.0 - 2.0**-27, -1.0

_PACKAGES = ("numpy", "numba", "scipy", "pandas", "matplotlib")


def describe() -> dict[str, Any]:
    """Return versions (None for what is not installed), platform, SIMD features and width of longdouble, for JSON."""
    simd = np.show_config(mode="dicts").get("SIMD Extensions", {})
    return {
        "rockref": _installed("rockref"),
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        **{name: _installed(name) for name in _PACKAGES},
        "platform": platform.platform(),
        "cpu": _cpu_name(),
        "cores": os.cpu_count(),
        "byte_order": sys.byteorder,
        "simd_baseline": list(simd.get("baseline", [])),
        "simd_found": list(simd.get("found", [])),
        "longdouble_mantissa_bits": int(np.finfo(np.longdouble).nmant) + 1,
    }


def check_arithmetic() -> dict[str, bool | None]:
    """Return what the arithmetic of NumPy, and of numba where it is installed (else None), does.

    ``numpy_fuses``: an elementwise ``a * b + c`` is contracted; ``numpy_dot_fuses``: ``np.dot`` is (the law does not
    use it); ``numba_fuses``: compiled code is; ``*_flushes_subnormals``: results or operands below the smallest
    normal number become zero; ``rounds_half_to_even``. Source: IEEE 754-2008, sections 4.3.1 and 5.4.1.
    """
    findings: dict[str, bool | None] = {
        "rounds_half_to_even": _rounds_half_to_even(),
        "numpy_fuses": bool(np.any(np.full(64, _A) * np.full(64, _B) + np.full(64, _C))),
        "numpy_dot_fuses": _dot_fuses(),
        "numpy_flushes_subnormals": _flushes(_halve),
        "numba_fuses": None,
        "numba_flushes_subnormals": None,
    }
    if importlib.util.find_spec("numba") is not None:
        findings.update(_check_numba())
    return findings


def is_sound(findings: dict[str, bool | None]) -> bool:
    """Tell whether `findings` of :func:`check_arithmetic` are those of plain IEEE 754 double arithmetic.

    ``np.dot`` may fuse: nothing that is promised by bits uses it.
    """
    faults = ("numpy_fuses", "numpy_flushes_subnormals", "numba_fuses", "numba_flushes_subnormals")
    return bool(findings["rounds_half_to_even"]) and not any(findings[name] for name in faults)


def _installed(name: str) -> str | None:
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return None


def _cpu_name() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    except OSError:
        names = []
    return names[0] if names else platform.processor() or platform.machine()


def _rounds_half_to_even() -> bool:
    half_ulp = np.full(2, 2.0**-53)  # of 1: once it is a tie with 1, three times with 1 + 2^-51
    return bool(np.all(1.0 + half_ulp == 1.0) and np.all(1.0 + 3.0 * half_ulp == 1.0 + 2.0**-51))


def _dot_fuses() -> bool:
    left, right = np.zeros(64), np.zeros(64)
    left[0], right[0] = _C, 1.0
    for k in range(1, 64):  # the kernel's lanes are not known: try every distance
        left[k], right[k] = _A, _B
        if np.dot(left, right) != 0.0:
            return True
        left[k] = right[k] = 0.0
    return False


def _halve(x: np.ndarray) -> np.ndarray:
    return x * 0.5


def _flushes(halve: Any) -> bool:
    smallest_normal = np.full(8, np.finfo(np.float64).tiny)
    subnormal = halve(smallest_normal)
    return not (np.all(subnormal > 0.0) and np.all(halve(subnormal) > 0.0))


def _check_numba() -> dict[str, bool | None]:
    import numba

    multiply_add = numba.njit(lambda a, b, c: a * b + c)
    return {
        "numba_fuses": multiply_add(_A, _B, _C) != 0.0,
        "numba_flushes_subnormals": _flushes(numba.njit(_halve)),
    }
