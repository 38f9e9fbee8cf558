"""Table 3.1 and the maps between twelve and fifty-four parameters."""

import numpy as np
import pytest

from rockref.model import parameters as p
from tests.refusal import refused

#: Printed in the source: value, and one unit of its last significant digit.
PRINTED = {
    "K_N": (6e7, 1e7), "K_T": (5e7, 1e7), "beta_int": (0.15, 0.01), "beta_ext": (0.18, 0.01),
    "mu_int": (0.30, 0.01), "mu_ext": (0.25, 0.01), "delta_long_1": (1.0e-5, 1e-6), "delta_long_2": (4.0e-5, 1e-6),
    "delta_long_3": (9.2e-5, 1e-6), "delta_long_4": (5.8e-5, 1e-6), "delta_diag": (6.0e-3, 1e-4),
    "theta_0": (0.1170, 1e-4),
}  # fmt: skip
EXTERNAL = np.arange(8) < 4


def test_table_3_1_as_printed():
    assert list(p.TABLE_3_1) == list(PRINTED)
    for name, (value, digit) in PRINTED.items():
        given = p.TABLE_3_1[name]
        # millimetres times 1e-3 may be off by one rounding
        assert (given.value, given.precision) == pytest.approx((value, digit), rel=2e-16)
        assert given.source == "Table 3.1"


def test_defaults_are_the_table():
    assert np.array_equal(p.chromosome_12(p.Parameters()), [given.value for given in p.TABLE_3_1.values()])


def test_stiffness_is_common():
    assert np.array_equal(p.common_stiffness(6e7, 8), np.full(8, 6e7))


def test_damping_is_twice_the_ratio_times_the_root():
    C = p.viscous_damping(np.array([0.15, 0.18, 1.0]), np.full(3, 6e7), 54.0)
    # 2 * 0.18 * sqrt(6e7 * 54) = 20491.559237891095, as the peer's files have it
    assert C[1] == 20491.559237891095
    assert C[0] == 17076.299364909246
    # critical: C^2 = 4 K m
    assert C[2] ** 2 == pytest.approx(4 * 6e7 * 54.0, rel=1e-15)


def test_the_same_ratio_both_ways():
    beta = np.array([0.15, 0.18])
    beta_N, beta_T = p.common_damping_ratio(beta)
    assert np.array_equal(beta_N, beta)
    assert np.array_equal(beta_T, beta)


def test_point_properties_of_the_table():
    q = p.point_properties(p.Parameters(), 54.0, EXTERNAL)
    assert list(q) == list(p.PROPERTIES)
    assert np.array_equal(q["K_N"], np.full(8, 6e7))
    assert np.array_equal(q["K_T"], np.full(8, 5e7))
    assert np.array_equal(q["mu"], [0.25] * 4 + [0.30] * 4)
    assert np.array_equal(q["mu_0"], q["mu"])
    assert q["mu_0"] is not q["mu"]
    assert np.array_equal(q["C_N"], [20491.559237891095] * 4 + [17076.299364909246] * 4)
    assert np.array_equal(q["C_T"], [18706.148721743873] * 4 + [15588.457268119895] * 4)


def test_twelve_genes_there_and_back():
    genes = np.arange(1.0, 13.0)
    assert np.array_equal(p.chromosome_12(p.from_chromosome_12(genes)), genes)


def test_fifty_four_genes_split():
    table = p.Parameters()
    genes = p.chromosome_54(table, 54.0)
    assert genes.shape == (54,)
    q, delta_long, delta_diag, theta_0 = p.split_54(genes)
    expected = p.point_properties(table, 54.0, EXTERNAL)
    assert all(np.array_equal(q[k], expected[k]) for k in p.PROPERTIES)
    assert np.array_equal(delta_long, table.delta_long)
    assert (delta_diag, theta_0) == (table.delta_diag, table.theta_0)


@pytest.mark.parametrize("call", [p.from_chromosome_12, p.split_54])
def test_wrong_number_of_genes(call):
    error = refused(call, np.ones(13))
    assert error.code == "E-SHAPE"


def test_replace_knows_its_names():
    changed = p.Parameters().replace(K_N=7e7, delta_long=np.array([1, 2, 3, 4]))
    assert (changed.K_N, changed.delta_long) == (7e7, (1.0, 2.0, 3.0, 4.0))
    error = refused(p.Parameters().replace, k_n=7e7)
    assert (error.code, error.where) == ("E-KEY", "k_n")


def test_block_of_54_kg_is_of_steel():
    """The decided size: 0.1 x 0.1 x 0.688 m at the density of steel, 7850 kg/m3, to the precision of the mass."""
    b = {k: given.value for k, given in p.BLOCK.items()}
    assert b["width"] * b["depth"] * b["height"] * 7850 == pytest.approx(b["mass"], abs=0.5)
