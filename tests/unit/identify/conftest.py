"""What several tests here look at, computed once."""

import pytest

import rockref
from rockref.identify import target as targets


@pytest.fixture(scope="package")
def table_3_1():
    return rockref.Model.table_3_1()


@pytest.fixture(scope="package")
def twin(table_3_1):
    """A record of Table 3.1 by the step of the source, without noise."""
    pytest.importorskip("numba")
    return targets.twin(table_3_1, 1e-5, None)


@pytest.fixture(scope="package")
def noisy_twin(table_3_1):
    """A record of Table 3.1 by a tenth of the step of the source, with the noise of a gyroscope."""
    pytest.importorskip("numba")
    return targets.twin(table_3_1, 1e-6, 1)
