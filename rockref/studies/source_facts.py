"""What the source says of the response of Table 3.1, in numbers, beside what the law gives.

Source: the comparison of model and experiment (Fig. 3.4) and the description of the experiment (section 3.3).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.measure.signals import features
from rockref.measure.signals.envelopes import envelope_shape, envelopes
from rockref.measure.signals.phases import phases
from rockref.model.channel import DEGREES
from rockref.model.housner import housner
from rockref.model.response import Response

#: Length of the run that shows all three phases [s].
LONG = 15.0


@dataclass(frozen=True)
class Fact:
    """One statement: about what, as the source states it, what the law gives, and whether they agree (None: the source
    gives no number to hold against)."""

    what: str
    stated: str
    ours: str
    agrees: bool | None


def facts(response: Response) -> list[Fact]:
    """Return the facts of a run of `LONG` [s] from the release of Table 3.1."""
    impacts = response.main_impacts()
    found = phases(response.t, response.W)
    return [
        *_instants(response, impacts, found.onset),
        *_contacts(response, impacts),
        *_shapes(response, impacts),
        *_plane(response, impacts),
        *_late(impacts, found.quasi_2d_from, found.shares),
    ]


def _instants(response: Response, impacts: np.ndarray, onset: float) -> list[Fact]:
    first = float(impacts[0])
    before = first - onset
    return [
        # Its sentence: motion out of the plane starts 0.02 s before the impact, at 0.51 s. Both are read to 0.01 s.
        Fact(
            "first main impact",
            "0.53 s",
            f"{first:.4f} s; the height of the block had to be decided",
            abs(first - 0.53) < 0.01,
        ),
        Fact("second main impact", "not stated", f"{impacts[1]:.4f} s", None),
        Fact(
            "ninth to eleventh main impact",
            "in the window 4.8 to 5.8 s",
            ", ".join(f"{t:.2f}" for t in impacts[8:11]) + " s",
            bool(np.all((impacts[8:11] > 4.8) & (impacts[8:11] < 5.8))),
        ),
        Fact(
            "transverse motion begins before the first main impact by",
            "0.02 s",
            f"{before:.4f} s",
            0.01 < before < 0.03,
        ),
    ]


def _contacts(response: Response, impacts: np.ndarray) -> list[Fact]:
    begins = {name: float(i[0, 0]) if len(i) else np.inf for name, i in response.contacts()}
    inner, outer = max(begins["1int"], begins["2int"]), min(begins["3ext"], begins["4ext"])
    tilt = np.abs(response.tilt)
    early = response.t < impacts[7]
    large, small = early & (tilt > 0.05), early & (tilt < 0.005)
    names = response.problem.points.names
    outside = np.array([name.endswith("ext") for name in names])
    on = response.anchored
    share_large = on[large][:, outside].sum() / max(1, on[large].sum())
    share_small = on[small][:, ~outside].sum() / max(1, on[small].sum())
    return [
        Fact(
            "what starts it",
            "1ext, 2ext hand over to 1int, 2int; then 3ext, 4ext take part",
            f"1int and 2int touch by {inner:.4f} s, 3ext or 4ext from {outer:.4f} s",
            inner < outer,
        ),
        Fact(
            "outer points touch at a big tilt, inner ones at a small one",
            "so identified",
            f"beyond 0.05 rad {100 * share_large:.0f} % of the contacts are outer; below 0.005 rad "
            f"{100 * share_small:.0f} % are inner",
            bool(share_large > 0.5 and share_small > 0.5),
        ),
    ]


def _shapes(response: Response, impacts: np.ndarray) -> list[Fact]:
    rows = (response.t > impacts[0]) & (response.t < impacts[1])
    t, crv = response.t[rows], response.crv[rows]
    e = envelopes(response.t, response.W, impacts[0], impacts[1])
    transverse, longitudinal = (envelope_shape(e.upper[i], e.lower[i]) for i in (0, 1))
    flanks = features.flanks(crv[:, 1])
    bowed = features.flanks(crv[:, 2])
    two = np.count_nonzero((bowed.straightness < 0.9996) & (bowed.bend > 0.8))
    y, z = t[features.extremes(crv[:, 1])], t[features.extremes(crv[:, 2])]
    apart = float(np.max(np.min(np.abs(y[:, None] - z[None, :]), axis=1)))
    inner = (t > t[0] + 0.06) & (t < t[-1] - 0.06)
    ripple = features.ripple(t, crv[:, 0])[inner]
    rhythm, half = features.rhythm(t[inner], ripple), features.rhythm(t, crv[:, 1]) / 2
    near = np.abs(response.t - impacts[0] - 0.02) < 0.02
    peak = float(np.abs(response.crv[near, 2]).max())
    sag = features.curvature(crv[:, 1])
    return [
        Fact(
            "transverse envelope",
            "quasi-constant, slightly convex",
            f"varies by {100 * transverse.variation:.0f} % of its mean, sags by {-100 * sag:.0f} % in the middle",
            bool(transverse.variation < 0.15 and -0.2 < sag < 0),
        ),
        Fact(
            "transverse rate",
            "varies linearly between positive and negative values",
            f"{len(flanks.bounds)} flanks, the least straight one to {np.min(flanks.straightness):.5f} (R²)",
            bool(np.min(flanks.straightness) > 0.999),
        ),
        Fact(
            "longitudinal envelope",
            "highly concave, almost zero at both ends",
            f"{100 * longitudinal.start:.0f} % and {100 * longitudinal.end:.0f} % of its largest at the ends, bow "
            f"{100 * longitudinal.bow:.0f} %",
            bool(max(longitudinal.start, longitudinal.end) < 0.3 and longitudinal.bow > 0.3),
        ),
        Fact(
            "longitudinal oscillations",
            "of two segments",
            f"{two} of {len(bowed.bounds)} flanks are two joined lines",
            bool(two >= 3),
        ),
        Fact(
            "first longitudinal peak, at 0.55 s",
            "measured, but not predicted by the source's model",
            f"{peak:.1f} deg/s within 40 ms of the impact",
            None,
        ),
        Fact(
            "peaks of the rates",
            "concomitant",
            f"transverse and longitudinal within {1e3 * apart:.0f} ms",
            bool(apart < 0.01),
        ),
        Fact(
            "saw-tooth on the main rate",
            "slight, same frequency as the others",
            f"{np.std(ripple):.2f} deg/s, every {1e3 * rhythm:.0f} ms; the others change direction every "
            f"{1e3 * half:.0f} ms",
            bool(abs(rhythm / half - 1) < 0.1),
        ),
    ]


def _plane(response: Response, impacts: np.ndarray) -> list[Fact]:
    from rockref.model.parameters import BLOCK, TABLE_3_1

    block, theta = response.problem.block, TABLE_3_1["theta_0"].value
    width, height = BLOCK["width"].value, BLOCK["height"].value
    J = float(np.asarray(block.inertia)[0, 0])
    plane = housner(float(block.mass), width, height, J, float(block.g), theta, impacts[1], 2000.0)
    n = min(len(plane.t), int(np.searchsorted(response.t, impacts[1])))
    off = np.sqrt(np.mean(np.square(DEGREES * plane.rate[:n] - response.crv[:n, 0])))
    size = np.sqrt(np.mean(np.square(response.crv[:n, 0])))
    words = f"off by {100 * off / size:.0f} % of the main rate up to the second main impact"
    return [Fact("Housner's 2-D model, main motion", "a good approximation", words, bool(off / size < 0.15))]


def _late(impacts: np.ndarray, quasi_2d: float, shares: np.ndarray) -> list[Fact]:
    lasting = float(np.min(shares[1:9]))
    return [
        Fact(
            "three-dimensional motion, repeatable and then erratic",
            "quasi-periodic for 6 to 7 s in the experiment",
            f"arcs 2 to 9 (until {impacts[8]:.1f} s) have out of plane at least {100 * lasting:.0f} % of the main rate",
            lasting > 0.06,
        ),
        Fact(
            "late return to quasi-2-D motion",
            "seen, and reproduced by the eight-point model",
            f"from {quasi_2d:.1f} s on" if np.isfinite(quasi_2d) else f"not within {LONG:g} s",
            bool(np.isfinite(quasi_2d)),
        ),
    ]
