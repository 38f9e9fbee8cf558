# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # A reviewer's first hour
#
# Are the equations what they say? Three questions that a physicist asks of any code for a rocking block, each answered
# by a few lines that can be changed.

# %%
import math

import numpy as np

import rockref

model = rockref.Model.table_3_1()
model

# %% [markdown]
# ## 1. The first swing
#
# A rigid block on its edge, let go at the tilt $\theta_0$ and free of loss, comes upright after
# $T = \operatorname{arcosh}\big(\alpha/(\alpha-\theta_0)\big)/p$ with $p^2 = 3g/4R$, in the linear theory of
# Housner (1963).

# %%
alpha = math.atan2(model.depth, model.height)
p = math.sqrt(0.75 * model.g / (0.5 * math.hypot(model.depth, model.height)))
theta_0 = model.parameters.theta_0
expected = math.acosh(alpha / (alpha - theta_0)) / p
response = rockref.simulate(model, duration=1.6)
first = response.main_impacts()[0]
print(f"expected {expected:.4f} s, simulated {first:.4f} s")
# The feet stand proud of the corners by less than a tenth of a millimetre, and contacts give way: a part in a hundred.
assert abs(first / expected - 1.0) < 0.01

# %% [markdown]
# ## 2. The energy
#
# What the block loses is what contacts dissipate. The ledger closes to the error of the scheme.

# %%
energy = response.energy()
{name: np.round(values[[0, -1]], 4) for name, values in energy.items()}

# %%
lost = energy["dissipated"]
print(f"{lost[-1]:.3f} J of {energy['potential'][0] - energy['potential'].min():.3f} J were dissipated in 1.6 s")
assert np.all(np.diff(lost) > -1e-3)

# %% [markdown]
# ## 3. Turned by 180 degrees
#
# The plate does not know which way the block faces: with even feet, a block that is turned moves as the other one does,
# its rates about X and Y with the other sign.

# %%
even = model.replace(delta_long=(0.0, 0.0, 0.0, 0.0))
one, other = (rockref.simulate(even, duration=0.6, turned=turned) for turned in (False, True))
difference = np.abs(one.crv[:, 0] + other.crv[:, 0]).max()
print(f"largest difference {difference:.1e} deg/s")
assert difference < 1e-6

# %% [markdown]
# Each rule with its equation, its code and what holds the two together stands on one page of the site (`make docs`).
