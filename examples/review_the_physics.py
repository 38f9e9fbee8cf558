"""Review the physics: six questions put to the law, with the answer beside what a hand or a book gives.

Run it cell by cell, or whole: ``python examples/review_the_physics.py`` (a quarter of a minute; it writes energy.png).
"""

# %% The block of Table 3.1, and the numbers behind it
from dataclasses import replace

import numpy as np

from rockref import Model, simulate
from rockref.model.contact import norm, radial_return, sticks, threshold, trial_force
from rockref.model.energy_balance import balance
from rockref.model.housner import first_impact, frequency_parameter
from rockref.model.problem import State
from rockref.model.release import tipping_angle
from rockref.model.rotation import apply, exponential

model = Model.table_3_1()
block, points = model.body()
start = model.problem().start

# %% Does the release stand in equilibrium? Half the weight on each of two springs: m g / (2 K_N)
height = start.x[2] + apply(start.Lambda, points.P)[:, 2]
print(f"deepest feet at the release  {np.sort(-height)[-2:] * 1e6} um, by hand {54 * 9.81 / 2 / 6e7 * 1e6:.4f} um")

# %% Is friction Coulomb's? 0.1 mm beside the anchor the spring wants 5000 N, and 1000 N of load allow 250 N (3.6)
one = points.names.index("1ext")
K_T, C_T, mu = points.K_T[[one]], points.C_T[[one]], points.mu[[one]]
wanted = trial_force(np.array([[1e-4, 0.0]]), np.zeros((1, 2)), np.zeros((1, 2)), K_T, C_T)
limit = threshold(np.array([1000.0]), np.array([False]), mu, mu)
given = radial_return(wanted, norm(wanted), sticks(norm(wanted), limit), limit)
print(f"friction                     wanted {wanted[0, 0]:.0f} N, given {given[0, 0]:.0f} N")

# %% Is the first swing that of a block on its edge? Housner's planar block knows no springs
alpha = tipping_angle(block, points)
R = np.hypot(points.P[0, 1], points.P[0, 2])
p = frequency_parameter(54.0, block.inertia[0, 0], R, 9.81)
response = simulate(model, duration=0.56, output_rate=1e5, engine="auto")
ours, book = response.main_impacts()[0], first_impact(0.117, alpha, p)
print(f"first main impact            {ours:.4f} s, Housner's block {book:.4f} s")

# %% Is energy created? What the block has, what the springs hold and what was dissipated add up to the start
account = balance(response)
print(f"energy, start to 0.56 s      {account.mechanical[0]:.3f} J to {account.mechanical[-1]:.3f} J")
print(f"dissipated                   {account.dissipated_normal[-1]:.3f} J by impact, ", end="")
print(f"{account.dissipated_friction[-1]:.3f} J by friction")
print(f"made by the step itself      {np.max(np.abs(account.residual)) * 1e6:.1f} uJ")

# %% Is angular momentum conserved in free flight?
flight = State.at_rest(np.array([0, 0, 50.0]), exponential(np.array([0.3, 0.2, 0.1])), 8, W=np.array([3.0, 2.0, 5.0]))
flying = simulate(replace(model.problem(duration=1.0), start=flight), engine="auto")
momentum = apply(flying.Lambda, apply(block.inertia, flying.W))
drift = np.abs(momentum - momentum[0]).max() / np.linalg.norm(momentum[0])
print(f"drift of angular momentum    {drift:.0e} of it, after 1 s of tumbling")

# %% Is the scheme of second order where nothing lands? Half the step, a quarter of the error
swings = [simulate(model, duration=0.45, step=h, output_rate=2000, engine="auto").W for h in (5e-5, 2.5e-5, 1e-6)]
errors = [np.abs(swing - swings[2]).max() for swing in swings[:2]]
print(f"error of 5e-5 over 2.5e-5 s  {errors[0] / errors[1]:.2f}, expected 4")

# %% The energy account as a picture
import matplotlib  # noqa: E402  (a reader without Matplotlib has come this far)

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

figure, panel = plt.subplots(figsize=(8, 3.6), layout="constrained")
near = account.t > 0.48
panel.plot(account.t[near], (account.mechanical - account.mechanical[0])[near], label="block, since the release")
panel.plot(account.t[near], (account.stored_normal + account.stored_friction)[near], label="stored in the springs")
panel.plot(account.t[near], account.dissipated_normal[near], "--", label="dissipated by impacts")
panel.plot(account.t[near], account.dissipated_friction[near], ":", label="dissipated by friction")
panel.plot(account.t[near], account.residual[near], color="0.5", linewidth=0.8, label="made by the step")
panel.set_xlabel("time since release [s]")
panel.set_ylabel("energy [J]")
panel.legend(frameon=False, fontsize=8)
figure.savefig("energy.png", dpi=100)
