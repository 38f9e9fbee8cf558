"""Hypothesis profiles, by HYPOTHESIS_PROFILE (ci where CI is set, else dev); a cache of fits of the tests' own."""

import atexit
import os
import shutil
import tempfile

from hypothesis import Phase, settings
from hypothesis.database import DirectoryBasedExampleDatabase

# No deadline in any: a first call that compiles or a busy machine is not a failure of the law.
# The same examples every time: more of them would only be looked at again. New ones are tried by `nightly`.
settings.register_profile("ci", max_examples=50, derandomize=True, database=None, deadline=None, print_blob=True)
settings.register_profile("dev", max_examples=50, deadline=None)
settings.register_profile(
    "nightly",
    max_examples=5000,
    derandomize=False,
    deadline=None,
    print_blob=True,
    database=DirectoryBasedExampleDatabase(".hypothesis/examples"),
)
# A mutant only has to be noticed: what the smallest failing example is does not matter.
settings.register_profile(
    "mutation",
    max_examples=25,
    derandomize=True,
    database=None,
    deadline=None,
    phases=(Phase.explicit, Phase.reuse, Phase.generate),
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci" if os.environ.get("CI") else "dev"))

# No test reads or writes what a person's own commands have kept.
os.environ["ROCKREF_CACHE"] = tempfile.mkdtemp(prefix="rockref-cache-")
atexit.register(shutil.rmtree, os.environ["ROCKREF_CACHE"], ignore_errors=True)
