"""An identification with next to no budget, as a program that can be killed: EXPERIMENT FOLDER, prints the record."""

import json
import sys
from pathlib import Path


def main() -> None:
    """Identify with checkpoints in the folder given, resuming what is there."""
    from rockref.identify.from_experiment import answered, question
    from rockref.identify.polish import Effort
    from rockref.identify.search import Settings
    from rockref.jobs.campaign import campaign

    experiment, folder = map(Path, sys.argv[1:3])
    effort = Effort(windows=(), steps=1, moves=0)
    with campaign(1) as work:
        record, _ = answered(
            question(experiment), Settings(4, 12, seed=3), work, folder, resume=True, effort=effort, rounds=0
        )
    print(json.dumps(record))


if __name__ == "__main__":
    main()
