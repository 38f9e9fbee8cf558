"""The granite blocks: log loss and accuracy of predictions held out by motion, with intervals of resampled motions.

Needs the data (environment variable ROCKREF_GRANITE) and `pip install 'rockref[fast]'`; some minutes.
"""

from __future__ import annotations

import argparse
from collections import Counter
from typing import Any

import numpy as np
from granite_blocks import CROSSOVER, FELL, load_granite, record_sizes, sessions, sizes
from granite_plane import LADDER, PHYSICAL, STEP, WIDENED, Candidates, critical_angles, falls, probabilities
from granite_space import critical_factors

from rockref.shake.statistics.fragility import fit_fragility
from rockref.shake.statistics.held_out import held_out_choice, held_out_regression
from rockref.shake.statistics.resampling import mean_over_motions, paired_difference
from rockref.shake.statistics.scores import hits, log_losses, repeats


def main() -> None:
    """Print one row a block and prediction."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--crossover", type=float, nargs="*", default=[0.0, CROSSOVER], help="Hz; 0: accelerometer alone"
    )
    parser.add_argument("--widened", action="store_true", help="the range that was widened while looking at outcomes")
    parser.add_argument("--step", type=float, default=STEP, help="s, of the integration in a plane")
    parser.add_argument("--space", action="store_true", help="the law in three dimensions, too")
    parser.add_argument("--blocks", type=int, nargs="+", default=[1, 2])
    given = parser.parse_args()
    data = load_granite()
    tests = data.clean()
    for block in given.blocks:
        y, motion = tests[FELL[block - 1]].to_numpy(float), tests.motion.to_numpy()
        found = regressions(tests, y)
        for crossover in given.crossover:
            found |= mixtures(data, block, crossover, given.step, WIDENED if given.widened else PHYSICAL)
            fell = falls(data, tests.test, block, crossover, given.step, LADDER)
            found |= fragilities(tests, y, f"critical angle, {crossover:g} Hz", critical_angles(fell))
        if given.space:
            factors = critical_factors(data, tests.test, block, say=tell)
            found |= fragilities(tests, y, "inverse of the critical factor in three dimensions", 1.0 / factors)
        bar = log_losses(found["regression, sheets"], y)
        for title, probability in found.items():
            losses = log_losses(probability, y)
            less = paired_difference(losses, bar, motion)
            print(
                f"block {block}, {title}: log loss {mean_over_motions(losses, motion)}, less the sheets' {less}, "
                f"accuracy {mean_over_motions(hits(probability, y), motion)}"
            )
        print(f"block {block}: {repeats(motion, tests.pga_sheet_g, y)}")


def regressions(tests: Any, y: np.ndarray) -> dict[str, np.ndarray]:
    """Return the predictions (n,) that know no block, by name."""
    features = {
        "sheets": np.log(sizes(tests)),
        "record": np.log(record_sizes(tests)),
        "sheets and session": np.column_stack([np.log(sizes(tests)), sessions(tests)]),
    }
    return {f"regression, {key}": held_out_regression(x, y, tests.motion) for key, x in features.items()}


def mixtures(data: Any, block: int, crossover: float, step: float, of: Candidates) -> dict[str, np.ndarray]:
    """Return the predictions (n,) of mixtures of plane blocks, by name, and print the numbers that were chosen."""
    tests, found = data.clean(), {}
    fell = falls(data, tests.test, block, crossover, step, of, say=tell)
    for sessions_of, session in (("one session", None), ("two sessions", sessions(tests))):
        p, numbers = probabilities(fell, session, of)
        title = f"plane blocks, {crossover:g} Hz, {sessions_of}"
        found[title], chosen = held_out_choice(p, tests[FELL[block - 1]], tests.motion)
        for k, times in Counter(chosen.tolist()).most_common(3):
            print(f"block {block}, {title}: {numbers[k]} for {times} of {len(chosen)} motions")
    return found


def fragilities(tests: Any, y: np.ndarray, name: str, size: np.ndarray) -> dict[str, np.ndarray]:
    """Return the predictions (n,) of lognormal fragilities over a size of the motion (n,), alone and beside others."""
    whole = fit_fragility(size, y)
    print(f"fragility over the {name}: median {whole.theta:.2f}, scatter {whole.beta:.2f}")
    beside = {"": [], ", session": [sessions(tests)], ", record": [np.log(record_sizes(tests))]}
    return {
        f"fragility over the {name}{what}": held_out_regression(
            np.column_stack([np.log(size), *columns]), y, tests.motion, "probit"
        )
        for what, columns in beside.items()
    }


def tell(text: str) -> None:
    """Print how far a computation is."""
    print(text, flush=True)


if __name__ == "__main__":
    main()
