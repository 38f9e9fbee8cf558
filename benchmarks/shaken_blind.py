"""Blind cases of tests on a shake table: effects are hidden, verdicts are stored, then the truth is opened.

    python benchmarks/shaken_blind.py make FOLDER --seed 1      folders of tests, and the sealed truth
    python benchmarks/shaken_blind.py judge FOLDER              a verdict.json in each; the truth stays sealed
    python benchmarks/shaken_blind.py open FOLDER               verdict beside truth, a line a case

The tests are runs of the law itself, under other draws than those of the diagnosis: they test the inference, not the
law. Needs `pip install 'rockref[fast]'`.
"""

from __future__ import annotations

import argparse
import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from rockref import Model, __version__
from rockref.blind.cases.sealing import seal, unseal, write_json
from rockref.discover.outcomes.candidates import CANDIDATES, Setting, moved
from rockref.discover.outcomes.diagnose import diagnose_outcomes
from rockref.discover.outcomes.likelihood import simulated
from rockref.model.base_motion import BaseMotion
from rockref.shake.ensemble import Draws
from rockref.shake.experiment import load_shaken
from rockref.shake.motion_size import motion_size
from rockref.shake.pulses import envelope, kanai_tajimi

# decided: feet that are soft enough for a step of a tenth of a millisecond, and stiff enough to sink 0.01 mm.
STIFFNESS, DAMPING, STEP, AFTER = 2e7, 0.2, 1e-4, 1.5
#: Motions of a case, and PGA over the acceleration that lifts the block.
MOTIONS, LEVELS = 12, (1.1, 1.4, 1.7, 2.1)
INTERVAL, RISE, STRONG, DECAY, LENGTH = 0.02, 0.3, 1.5, 2.0, 3.0
DRAWS = Draws(heading=10.0, feet=2e-5, friction=0.05)
#: What is hidden: every candidate once, nothing, and what no candidate has.
HIDDEN = (*(c.id for c in CANDIDATES), *["nothing"] * 3, "vertical_motion", "rolling_resistance")


def hidden(setting: Setting, name: str, rng: np.random.Generator) -> tuple[Setting, float]:
    """Return a setting with a hidden effect, and its size in its own unit: half to twice what is typical."""
    size = math.exp(rng.uniform(math.log(0.5), math.log(2.0))) * rng.choice([-1.0, 1.0])
    own = {c.id: c for c in CANDIDATES}.get(name)
    if own is not None:
        size = own.typical * (size if own.signed else abs(size))
        return own.apply(setting, size), size
    if name == "vertical_motion":
        size *= 0.5
        share = np.array([[1.0, 0.0, size], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
        return moved(setting, lambda base: base.a @ share), size
    if name == "rolling_resistance":
        size = 2e-3 * abs(size)
        return replace(setting, model=setting.model.replace(effects=f"{name}:lever={size:g}")), size
    return setting, 0.0


def signal(seed: int) -> BaseMotion:
    """Return noise of Kanai and Tajimi along x, and half as much along y, with a PGA of 1 m/s2."""
    window = envelope(RISE, STRONG, DECAY)
    x, y = (kanai_tajimi(2 * seed + k, 1.0, LENGTH, INTERVAL, low_cut=0.3, window=window).a[:, 0] for k in (0, 1))
    made = BaseMotion(0.0, INTERVAL, np.column_stack([x, 0.5 * y, 0.0 * x]), f"motion{seed}")
    return made.scaled(1.0 / motion_size(made)[0])


def make_case(folder: Path, name: str, rng: np.random.Generator) -> dict[str, Any]:
    """Write the folder of one case and return its truth."""
    width, height = rng.uniform(0.09, 0.13), rng.uniform(0.4, 0.6)
    model = Model(mass=rng.uniform(40.0, 80.0), width=width, depth=width, height=height, points="four_points")
    model = model.replace(K_N=STIFFNESS, K_T=0.7 * STIFFNESS, beta_ext=DAMPING, mu_ext=rng.uniform(0.3, 0.5))
    seeds = rng.integers(1, 10**6, MOTIONS).tolist()
    signals = [signal(seed) for seed in seeds]
    factors = [9.81 * width / height * level for level in LEVELS]
    motions = tuple(base.scaled(round(factor, 6)) for base in signals for factor in factors)
    made, size = hidden(Setting(model, motions, DRAWS), name, rng)
    found = {key: values[0] for key, values in simulated(made, 1, STEP, AFTER, int(rng.integers(10**9)), 1).items()}
    folder.mkdir(parents=True)
    model.save(folder / "model.toml")
    draws = f"heading_deg = {DRAWS.heading}\nfeet_m = {DRAWS.feet}\nfriction = {DRAWS.friction}"
    text = f'name = "{folder.name}"\nkind = "shaken"\n\n[draws]\n{draws}\n'
    (folder / "experiment.toml").write_text(text, encoding="utf-8")
    for base in signals:
        t = INTERVAL * np.arange(len(base.a))
        rows = [f"{s:.2f},{x!r},{y!r}" for s, (x, y, _) in zip(t.tolist(), base.a.tolist(), strict=True)]
        (folder / f"{base.name}.csv").write_text("\n".join(["t [s],ax [m/s2],ay [m/s2]", *rows]) + "\n", "utf-8")
    lines = ["record,factor,fell,tilt_rad,slide_m,twist_rad"]
    for k, (base, factor) in enumerate((b, f) for b in signals for f in factors):
        maxima = ",".join(repr(float(found[q][k])) for q in ("tilt", "slide", "twist"))
        lines.append(f"{base.name}.csv,{factor:.6f},{int(found['fell'][k])},{maxima}")
    (folder / "tests.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return {"effect": name, "size": size, "fell": int(found["fell"].sum())}


def make(root: Path, seed: int, names: tuple[str, ...]) -> None:
    """Write all cases in an order that is drawn, and seal their truth."""
    rng = np.random.default_rng(seed)
    order = rng.permutation(len(names)).tolist()
    truth = {f"case-{k + 1:02d}": make_case(root / f"case-{k + 1:02d}", names[i], rng) for k, i in enumerate(order)}
    seal(root, truth, {}, __version__)
    print(f"wrote {root}: {len(truth)} cases, truth sealed")


def judge(root: Path, runs: int, workers: int | None) -> None:
    """Write a verdict for every case that has none."""
    for folder in sorted(root.glob("case-*")):
        if (folder / "verdict.json").exists():
            continue
        experiment, model = load_shaken(folder), Model.load(folder / "model.toml")
        found = diagnose_outcomes(experiment, model, runs=runs, step=STEP, after=AFTER, workers=workers)
        write_json(folder / "verdict.json", found.to_dict())
        print(folder.name, found.sentence(), flush=True)


def opened(root: Path, partly: bool) -> None:
    """Print verdict beside truth. Refuses while a case has no verdict; `partly` gives such cases up for good."""
    missing = [folder.name for folder in root.glob("case-*") if not (folder / "verdict.json").exists()]
    if missing and not partly:
        raise SystemExit(f"no verdict yet: {', '.join(sorted(missing))}")
    truth, same = unseal(root)
    print(f"the truth is {'the sealed one' if same else 'NOT the one that was sealed'}")
    for name, hid in ((n, h) for n, h in truth.items() if n not in missing):
        said = json.loads((root / name / "verdict.json").read_text(encoding="utf-8"))
        ranked = ", ".join(
            f"{' '.join(a['effects']) or 'nothing'} {a['probability']:.2f}" for a in said["alternatives"][:3]
        )
        print(f"| {name} | {hid['effect']} {hid['size']:.3g} | {hid['fell']} | {said['verdict']} "
              f"{' '.join(said['effects'])} | {ranked} |")  # fmt: skip


def main() -> None:
    """Do one of the three steps."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("step", choices=("make", "judge", "open"))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--controls", type=int, default=0, help="make so many cases with nothing hidden, and no others")
    parser.add_argument("--runs", type=int, default=8, help="of each test at each size")
    parser.add_argument("--workers", type=int)
    parser.add_argument(
        "--partly", action="store_true", help="open although some cases have no verdict, and never will"
    )
    given = parser.parse_args()
    if given.step == "make":
        make(given.folder, given.seed, ("nothing",) * given.controls or HIDDEN)
    elif given.step == "judge":
        judge(given.folder, given.runs, given.workers)
    else:
        opened(given.folder, given.partly)


if __name__ == "__main__":
    main()
