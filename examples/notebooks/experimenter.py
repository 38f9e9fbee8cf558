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
# # An experimenter's first hour
#
# From a measured block to the place where the model fails, and to an effect that mends it. The data are those of a
# shipped experiment: six releases of a block of 54 kg, recorded by a gyroscope. Your own come from `rockref new`.

# %%
from pathlib import Path

import rockref

root = next(p for p in (Path.cwd(), *Path.cwd().resolve().parents) if (p / "data/experiments").is_dir())
experiment = rockref.load(root / "data/experiments/mystery-05")
experiment

# %% [markdown]
# Runs marked `holdout` are read by no fit. What the gyroscope can do stands in the data sheet.

# %%
for run in experiment.runs:
    print(run.id, run.use, f"{run.release_tilt:.3f} rad", "turned" if run.block_turned else "")
experiment.gyro

# %% [markdown]
# ## Where does the model of Table 3.1 fail?
#
# A comparison judges nothing. It says when the model leaves the band of noise and run-to-run spread, about which axis,
# and which energy it loses where.

# %%
baseline = rockref.compare(experiment)
print(baseline.summary())

# %%
figure = baseline.plot()
figure

# %% [markdown]
# The block loses about twice as much energy in its free arcs as the model does. What acts between impacts? Among others
# a moment that resists rolling. An effect is written in words, with the size that it shall have.

# %%
rolling = rockref.Model.table_3_1().replace(effects="rolling_resistance:lever=3e-4")
compared = rockref.compare(experiment, ["table_3_1", rolling], names=["Table 3.1", "with rolling resistance"])
compared

# %%
for one in compared.to_dict()["models"]:
    print(one["name"], one["error_deg_s"])

# %% [markdown]
# A size that was guessed is no finding. `rockref.fit` fits the parameters of the block, `rockref.diagnose` tries every
# effect of the catalogue and confirms on the held-out runs, `rockref.add` fits one effect with all the rest. They take
# minutes:
#
# ```python
# found = rockref.diagnose(experiment)
# print(found.summary())
# found.save_page("report")
# ```
