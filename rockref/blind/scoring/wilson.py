"""How sure a share is."""

from __future__ import annotations

import math

#: Half-width of the standard normal that holds 95 %.
Z = 1.959963984540054


def wilson(hits: int, n: int, z: float = Z) -> tuple[float, float]:
    """The Wilson interval of a share of `hits` in `n` (0 to 1 if n is 0).

    Source: E. B. Wilson (1927), J. Am. Stat. Assoc. 22:209-212, doi:10.1080/01621459.1927.10502953.
    """
    if n == 0:
        return 0.0, 1.0
    p, z2 = hits / n, z * z
    middle = (p + z2 / (2 * n)) / (1 + z2 / n)
    half = z / (1 + z2 / n) * math.sqrt(p * (1 - p) / n + z2 / (4 * n * n))
    return max(0.0, middle - half), min(1.0, middle + half)
