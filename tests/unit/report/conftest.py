"""What several tests here look at, computed once."""

import pytest

from rockref import Model
from rockref.discover.compare.models import compare
from tests.unit.discover import fakes


@pytest.fixture(scope="package")
def short():
    """The plain model beside two runs with drag that end after their second main impact, and a held-out one."""
    return compare(fakes.made_experiment(), [Model.table_3_1()], ["plain"])
