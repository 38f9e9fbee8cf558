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
# # A backend author's first hour
#
# You have a faster rocking block. Is it the same block? The vectors ask it rule by rule; the first rule that is wrong
# is named with its equation.

# %%
import rockref
from rockref.conformance import NumpyEngine

# %% [markdown]
# The law itself passes. A layer holds the vectors of one level: `L1` one contact point, `L2` sums and moments, `L3`
# rotations.

# %%
verdict = rockref.conform(NumpyEngine(), layers="L1,L2,L3")
print(verdict.summary())
assert verdict.passed

# %% [markdown]
# ## A slip, and how it is found
#
# A backend is an object with functions of the law's names. The tangential force of this one is one per cent too large.


# %%
class Slip(NumpyEngine):
    """The law, with tangential forces one per cent too large."""

    def contact_law(self, *args, **kwargs):
        """Return the forces of the law, the tangential ones enlarged."""
        answer = super().contact_law(*args, **kwargs)
        answer["F_T"] = 1.01 * answer["F_T"]
        return answer


# %%
slipped = rockref.conform(Slip(), layers="L1")
print(slipped.summary())
assert not slipped.passed

# %% [markdown]
# The page of a verdict can be sent to others: `slipped.save_page("conformance")`. On the command line the same is
# `rockref conform my_backend.py:Backend --html page.html`; programs in other languages answer as JSON lines.
