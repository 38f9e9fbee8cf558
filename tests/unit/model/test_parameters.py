"""Table 3.1 and the maps between twelve and fifty-four parameters."""

import numpy as np
import pytest

from rockref.model import parameters as p
from rockref.model.errors import InputError

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


def test_fifty_four_genes_split_and_reduce():
    table = p.Parameters()
    genes = p.chromosome_54(table, 54.0)
    assert genes.shape == (54,)
    q, delta_long, delta_diag, theta_0 = p.split_54(genes)
    expected = p.point_properties(table, 54.0, EXTERNAL)
    assert all(np.array_equal(q[k], expected[k]) for k in p.PROPERTIES)
    assert np.array_equal(delta_long, table.delta_long)
    assert (delta_diag, theta_0) == (table.delta_diag, table.theta_0)
    # 2 beta sqrt(K m) / (2 sqrt(K m)) rounds twice, the means once more
    assert p.chromosome_12(p.reduce_54(genes, 54.0)) == pytest.approx(p.chromosome_12(table), rel=1e-15)


def test_reduction_takes_the_means_of_the_right_points():
    genes = p.chromosome_54(p.Parameters(), 54.0)
    mu = genes[5:48:6]
    mu[:4] = 0.1, 0.2, 0.3, 0.4
    genes[5:48:6] = mu
    reduced = p.reduce_54(genes, 54.0)
    # external: mean of mu_0 = 0.25 and of mu = 0.25; internal untouched
    assert (reduced.mu_ext, reduced.mu_int) == pytest.approx((0.25, 0.30), rel=1e-15)
    genes[0] = 14e7
    assert p.reduce_54(genes, 54.0).K_N == pytest.approx(7e7, rel=1e-15)


@pytest.mark.parametrize("call", [p.from_chromosome_12, p.split_54, lambda g: p.reduce_54(g, 54.0)])
def test_wrong_number_of_genes(call):
    with pytest.raises(InputError) as refused:
        call(np.ones(13))
    assert refused.value.code == "E-SHAPE"


def test_replace_knows_its_names():
    changed = p.Parameters().replace(K_N=7e7, delta_long=np.array([1, 2, 3, 4]))
    assert (changed.K_N, changed.delta_long) == (7e7, (1.0, 2.0, 3.0, 4.0))
    with pytest.raises(InputError) as refused:
        p.Parameters().replace(k_n=7e7)
    assert (refused.value.code, refused.value.where) == ("E-KEY", "k_n")


def test_block_of_54_kg_is_of_steel():
    """The decided size: 0.1 x 0.1 x 0.688 m at the density of steel, 7850 kg/m3, to the precision of the mass."""
    b = {k: given.value for k, given in p.BLOCK.items()}
    assert b["width"] * b["depth"] * b["height"] * 7850 == pytest.approx(b["mass"], abs=0.5)


@pytest.mark.parametrize("point", range(8))
def test_every_point_counts_in_the_mean(point):
    """One point changed by a tenth changes the mean over its four by a fortieth, and that of the others not at all."""
    table = p.Parameters()
    genes = p.chromosome_54(table, 54.0)
    mu = slice(6 * point + 4, 6 * point + 6)
    genes[mu] *= 1.1
    reduced = p.reduce_54(genes, 54.0)
    external = point < 4
    assert reduced.mu_ext / table.mu_ext == pytest.approx(1.025 if external else 1, rel=1e-14)
    assert reduced.mu_int / table.mu_int == pytest.approx(1 if external else 1.025, rel=1e-14)
