"""MuJoCo on the tosses of the cube: identified on the fit tosses as the law is, judged on the held-out ones.

    python benchmarks/cube_mujoco.py tosses -o cube_mujoco.json

Same starts, same frames, same measure as `rockref compare`. The contact's numbers are found by a simplex search on the
mean of position [%] plus rotation [deg]; once with the stated body, once with the body as rockref measures it without
any contact model (flight arcs and impulse balance of the fit tosses), so that contact models are compared alone.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy as np

from rockref.api import Model
from rockref.discover.tosses.body import frames_of, nominal_model, throw_frame
from rockref.discover.tosses.compare import measured
from rockref.discover.tosses.errors import Errors, errors
from rockref.discover.tosses.fit import cut, picked
from rockref.discover.tosses.predict import Prediction, starts_of
from rockref.effects.shape.inertia_deviation import InertiaDeviation
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.measure.records.toss import Tosses
from rockref.measure.tosses.flight import Poses, side_by_side
from rockref.measure.tosses.load import load_tosses
from rockref.model.rotation import from_quaternion, quaternion

#: Steps a frame; three times as many change the error of the default contact by less than a hundredth of it.
STEPS = 8
#: Simulations of the searched tosses, decided: a third more than the law's fit of its five numbers makes of all the fit
#: tosses, 186, half of them over the first 40 frames only.
BUDGET = 250
#: Every so many fit tosses are searched on.
EVERY = 4
#: Contact numbers, their start and the spread of their logarithm in the first simplex. friction 0.18 is stated;
#: solref and solimp start where MuJoCo's defaults are; the torsional and rolling radii are those of a small patch.
NUMBERS = {
    "friction": (0.18, 0.2), "torsion_m": (0.002, 0.7), "rolling_m": (0.0001, 0.7), "time_constant_s": (0.02, 0.7),
    "damping_ratio": (1.0, 0.5), "d_0": (0.9, 0.02), "width_m": (0.001, 0.7), "impratio": (1.0, 0.7),
}  # fmt: skip
XML = """
<mujoco>
  <option timestep="{dt}" gravity="0 0 -{g}" cone="elliptic" impratio="{impratio}" integrator="implicitfast"/>
  <default>
    <geom friction="{friction} {torsion_m} {rolling_m}" condim="6" solref="{time_constant_s} {damping_ratio}"
      solimp="{d_0} {d_1} {width_m} 0.5 2"/>
  </default>
  <worldbody>
    <geom type="plane" size="5 5 1"/>
    <body><freejoint/><inertial pos="0 0 0" mass="{mass}" diaginertia="{J[0]} {J[1]} {J[2]}"/>
      <geom type="box" size="{half} {half} {half}" pos="{at[0]} {at[1]} {at[2]}" mass="0"/></body>
  </worldbody>
</mujoco>
"""


def compiled(body: Model, numbers: dict[str, float], rate: float):
    """MuJoCo's model of the cube: its origin is the centre of mass, the box lies off it."""
    import mujoco

    block, points = body.body()
    corners = np.asarray(points.P)
    low, high = corners.min(axis=0), corners.max(axis=0)
    text = XML.format(
        dt=1 / (rate * STEPS), g=float(block.g), mass=float(block.mass), J=np.diag(np.asarray(block.inertia)),
        half=float((high - low)[0] / 2), at=(low + high) / 2, d_1=max(numbers["d_0"], 0.95), **numbers,
    )  # fmt: skip
    return mujoco.MjModel.from_xml_string(text)


def predict(body: Model, numbers: dict[str, float], poses: Poses, start: str, rate: float) -> Prediction:
    """What `rockref.discover.tosses.predict` does, with MuJoCo's step."""
    import mujoco

    frames = frames_of(body, throw_frame(poses))
    starts = starts_of(body, poses, frames, start)
    model = compiled(body, numbers, rate)
    data = mujoco.MjData(model)
    B, F = poses.x.shape[:2]
    q = np.empty((B, F, 7))
    first = quaternion(starts.Lambda)
    for i in range(B):
        mujoco.mj_resetData(model, data)
        data.qpos[:3], data.qpos[3:] = starts.x[i], first[i]
        data.qvel[:3], data.qvel[3:] = starts.v[i], starts.W[i]
        q[i, 0] = data.qpos
        n = int(poses.frames[i])
        for f in range(1, n):
            mujoco.mj_step(model, data, STEPS)
            q[i, f] = data.qpos
        q[i, n:] = q[i, n - 1]
    size = np.linalg.norm(q[..., 3:], axis=-1, keepdims=True)
    Lambda = from_quaternion((q[..., 3:] / size).reshape(-1, 4)).reshape(B, F, 3, 3)
    return Prediction(*frames.to_tracked(q[..., :3], Lambda), starts, frames)


def total(e: Errors) -> float:
    """Position [%] plus rotation [deg], mean over the tosses."""
    return float(np.mean(100 * e.position + e.rotation))


def identified(body: Model, poses: Poses, tosses: Tosses) -> tuple[dict[str, float], float]:
    """The contact numbers that a simplex search finds, and their error on the searched tosses."""
    from scipy.optimize import minimize

    names = list(NUMBERS)

    def numbers(z: np.ndarray) -> dict[str, float]:
        found = {k: NUMBERS[k][0] * float(np.exp(NUMBERS[k][1] * v)) for k, v in zip(names, z, strict=True)}
        # Two steps are MuJoCo's least time constant; its impedance lies below one.
        found["time_constant_s"] = max(found["time_constant_s"], 2.0 / (tosses.rate * STEPS))
        found["d_0"] = min(found["d_0"], 0.9999)
        return found

    def cost(z: np.ndarray) -> float:
        return total(errors(predict(body, numbers(z), poses, "flight", tosses.rate), poses, tosses.width))

    simplex = np.vstack([np.zeros(len(names)), np.eye(len(names))])
    simplex[1 + names.index("time_constant_s")] *= -1
    found = minimize(
        cost, np.zeros(len(names)), method="Nelder-Mead",
        options={"maxfev": BUDGET, "initial_simplex": simplex, "adaptive": True, "xatol": 1e-3, "fatol": 1e-3},
    )  # fmt: skip
    return numbers(found.x), float(found.fun)


def measured_body(tosses: Tosses) -> Model:
    """The stated body with centre and inertia from flight arcs and impulse balance of the fit tosses."""
    base = nominal_model(tosses)
    found = measured(tosses.used("fit"), tosses, base)
    centre = [found["flight_arcs"]["values"][f"centre_{a}"]["value"] for a in "xyz"]
    stated = np.diag(np.asarray(base.body()[0].inertia))
    J = [found["measured_centre"]["inertia_kg_m2"][a] for a in ("xx", "yy", "zz")]
    return base.replace(effects=(MassEccentricity(*centre), InertiaDeviation(*(np.array(J) / stated))))


def main() -> None:
    """Identify, judge, print and write."""
    import mujoco

    read = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    read.add_argument("tosses", type=Path)
    read.add_argument("-o", "--output", type=Path, default=Path("cube_mujoco.json"))
    given = read.parse_args()
    tosses = load_tosses(given.tosses)
    fit = side_by_side(tosses.used("fit"), tosses.rate)
    held = side_by_side(tosses.used("holdout"), tosses.rate)
    searched = cut(picked(fit, np.arange(0, len(fit.x), EVERY)), 120)
    rows = []
    for name, body in (("stated body", nominal_model(tosses)), ("measured body", measured_body(tosses))):
        for how in ("default contact", "identified contact"):
            numbers = {k: v[0] for k, v in NUMBERS.items()}
            if how.startswith("identified"):
                numbers, _ = identified(body, searched, tosses)
            for start in ("flight", "raw"):
                e = errors(predict(body, numbers, held, start, tosses.rate), held, tosses.width)
                rows.append({"body": name, "contact": how, "start": start, "numbers": numbers} | e.summary())
                p, r = rows[-1]["position_percent"], rows[-1]["rotation_deg"]
                print(
                    f"{name:14s} {how:19s} {start:7s} {p['mean']:5.1f} ± {p['sd']:4.1f} % ({p['median']:4.1f})  "
                    f"{r['mean']:5.1f} ± {r['sd']:4.1f} deg ({r['median']:4.1f})", flush=True
                )  # fmt: skip
    text = json.dumps({"mujoco": mujoco.__version__, "sha256": tosses.sha256, "rows": rows}, indent=1)
    given.output.write_text(text + "\n")


if __name__ == "__main__":
    main()
