"""Compile what most tests run, and have numba keep it: ``python -m tests.compile_ahead``.

`make test` does this while lint looks at the text, which needs one core. Workers that find nothing kept would each
compile the same. Where all is kept it takes two seconds.
"""

from rockref import Model, simulate
from rockref.blind.simulator import release
from rockref.blind.simulator.world import TABLE, build
from rockref.effects.catalogue import EFFECTS, IN_STEP_ORDER
from rockref.engines import has_numba


def main() -> None:
    """Run every variant of the compiled loop once: abreast and alone, and the simulator of the blind test."""
    if not has_numba():
        return
    from rockref.engines.compiled import ahead, slots

    for groups in slots.VARIANTS:
        ahead.make(groups)
    alone = [
        (kind.typical(),) for kind in IN_STEP_ORDER if kind.question in ("contact", "friction", "loads", "support")
    ]
    together = tuple(EFFECTS[id].typical() for id in ("quadratic_drag", "viscous_friction"))
    for effects in ((), together, *alone):
        simulate(Model.table_3_1().replace(effects=effects), duration=1e-4, engine="numba")
    release.simulate(build(dict(TABLE)), 0.117, seconds=1e-3)


if __name__ == "__main__":
    main()
