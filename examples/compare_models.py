"""Two models beside one experiment, from Python: sentences, numbers, a page.

Run it in the folder of the project: ``python examples/compare_models.py`` (half a minute, with compiling).
"""

from pathlib import Path

from rockref import Model
from rockref.discover.compare.models import compare
from rockref.discover.compare.sentences import findings
from rockref.measure import load_experiment
from rockref.report.views.comparison_page import comparison_page

EXPERIMENT = Path(__file__).resolve().parents[1] / "data/experiments/mystery-09"


def main() -> None:
    """Compare the four-point model and the eight-point one with a shipped experiment."""
    experiment = load_experiment(EXPERIMENT)
    models = [Model.four_points(), Model.table_3_1()]
    comparison = compare(experiment, models, ["four points", "eight points"])
    for finding in findings(comparison):
        print(f"{finding.model or 'both'}: {finding.text}")
    for k, name in enumerate(comparison.names):
        error = comparison.rms(k, "between", "transverse", use="holdout")
        print(
            f"{name}: {error:.4f} rad/s about the transverse axis on holdout runs, between the first two main impacts"
        )
    print(comparison_page(comparison).write("comparison.html"))


if __name__ == "__main__":
    main()
