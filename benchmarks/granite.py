"""The granite blocks: log loss and accuracy of predictions held out by motion, with intervals of resampled motions.

Needs the data (environment variable ROCKREF_GRANITE) and `pip install 'rockref[fast]'`; some minutes.
"""

from __future__ import annotations

import argparse
from collections import Counter

import numpy as np
from granite_blocks import CROSSOVER, FELL, load_granite, record_sizes, sessions, sizes
from granite_plane import LADDER, PHYSICAL, STEP, WIDENED, critical_angles, falls, probabilities
from granite_space import fall_shares

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
    parser.add_argument("--step", type=float, default=STEP, help="s, of the integration")
    parser.add_argument("--reach", type=float, nargs="*", default=[], help="of the feet in three dimensions")
    parser.add_argument("--rounds", type=int, default=4, help="runs of each test in three dimensions")
    parser.add_argument("--blocks", type=int, nargs="+", default=[1, 2])
    given = parser.parse_args()
    data, of = load_granite(), WIDENED if given.widened else PHYSICAL
    tests = data.clean()
    for block in given.blocks:
        name = FELL[block - 1]
        y, motion = tests[name].to_numpy(float), tests.motion.to_numpy()
        found = {
            "regression, sheets": held_out_regression(np.log(sizes(tests)), y, motion),
            "regression, record": held_out_regression(np.log(record_sizes(tests)), y, motion),
            "regression, sheets and session": held_out_regression(
                np.column_stack([np.log(sizes(tests)), sessions(tests)]), y, motion
            ),
        }
        for crossover in given.crossover:
            fell = falls(data, tests.test, block, crossover, given.step, of, say=lambda text: print(text, flush=True))
            for title, session in (("one session", None), ("two sessions", sessions(tests))):
                p, numbers = probabilities(fell, session, of)
                title = f"plane blocks, {crossover:g} Hz, {title}"
                found[title], chosen = held_out_choice(p, y, motion)
                for k, times in Counter(chosen.tolist()).most_common(3):
                    print(f"block {block}, {title}: {numbers[k]} for {times} of {len(chosen)} motions")
            title = f"fragility over the critical angle, {crossover:g} Hz"
            critical = np.log(critical_angles(falls(data, tests.test, block, crossover, given.step, LADDER)))
            beside = {"": [], ", session": [sessions(tests)], ", record": [np.log(record_sizes(tests))]}
            for of_what, columns in beside.items():
                found[title + of_what] = held_out_regression(np.column_stack([critical, *columns]), y, motion, "probit")
            whole = fit_fragility(np.exp(critical), y)
            print(f"block {block}, {title}: median {whole.theta:.2f} degrees, scatter {whole.beta:.2f}")
        for reach in given.reach:
            share = fall_shares(data, tests.test, block, reach, given.rounds)
            # Jeffreys' prior of a share: half a run more on either side.
            found[f"three dimensions, reach {reach:g}"] = (given.rounds * share + 0.5) / (given.rounds + 1)
        bar = log_losses(found["regression, sheets"], y)
        for title, probability in found.items():
            losses = log_losses(probability, y)
            less = paired_difference(losses, bar, motion)
            print(
                f"block {block}, {title}: log loss {mean_over_motions(losses, motion)}, less the sheets' {less}, "
                f"accuracy {mean_over_motions(hits(probability, y), motion)}"
            )
        print(f"block {block}: {repeats(motion, tests.pga_sheet_g, y)}")


if __name__ == "__main__":
    main()
