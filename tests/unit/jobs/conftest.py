"""What several tests here look at, computed once."""

from tests.unit.identify.conftest import table_3_1, twin  # noqa: F401
