"""Three-vectors and rotations: the bits of the sums, and the exponential against 40 digits."""

import mpmath
import numpy as np
import pytest

from rockref.model import rotation
from tests.refusal import refused

REALS = (np.float32, np.float64, np.longdouble)
BATCHES = ((), (1,), (2,), (7,), (2, 3))


def orders(batch, core, dtype, seed):
    """The same numbers in the memory orders that occur: of NumPy, of `rotation.empty`, and a slice of more."""
    values = np.random.default_rng(seed).normal(size=batch + core).astype(dtype)
    values[..., 0] *= dtype(1e5)  # unequal sizes, so that another order of summation gives other bits
    fastest = rotation.empty(batch, core, dtype)
    fastest[...] = values
    wide = np.zeros(batch + core[:-1] + (2 * core[-1],), dtype)
    wide[..., ::2] = values
    return values, fastest, wide[..., ::2]


def left_to_right(terms):
    total = terms[0]
    for term in terms[1:]:
        total = total + term
    return total


@pytest.mark.parametrize("batch", BATCHES, ids=str)
@pytest.mark.parametrize("dtype", REALS)
def test_sums_have_the_bits_of_the_sums_written_out(batch, dtype):
    for A, B, a, P in zip(
        orders(batch, (3, 3), dtype, 1),
        orders(batch, (3, 3), dtype, 2),
        orders(batch, (3,), dtype, 3),
        orders(batch, (8, 3), dtype, 4),
        strict=True,
    ):
        of_rows = np.stack([left_to_right([A[..., i, k] * a[..., k] for k in range(3)]) for i in range(3)], -1)
        of_columns = np.stack([left_to_right([A[..., k, i] * a[..., k] for k in range(3)]) for i in range(3)], -1)
        of_points = np.stack([left_to_right([A[..., None, i, k] * P[..., k] for k in range(3)]) for i in range(3)], -1)
        of_matrices = np.stack(
            [
                np.stack([left_to_right([A[..., i, k] * B[..., k, j] for k in range(3)]) for j in range(3)], -1)
                for i in range(3)
            ],
            -2,
        )
        assert np.array_equal(rotation.apply(A, a), of_rows)
        assert np.array_equal(rotation.apply_transposed(A, a), of_columns)
        assert np.array_equal(rotation.apply_to_points(A, P), of_points)
        assert np.array_equal(rotation.product(A, B), of_matrices)
        assert np.array_equal(rotation.dot(a, A[..., 0]), left_to_right([a[..., k] * A[..., k, 0] for k in range(3)]))


@pytest.mark.parametrize("batch", BATCHES, ids=str)
def test_a_sum_in_another_order_would_be_noticed(batch):
    A, a = orders(batch + (50,), (3, 3), np.float64, 1)[0], orders(batch + (50,), (3,), np.float64, 3)[0]
    backwards = np.stack([left_to_right([A[..., i, k] * a[..., k] for k in (2, 1, 0)]) for i in range(3)], -1)
    assert not np.array_equal(rotation.apply(A, a), backwards)


@pytest.mark.parametrize("dtype", REALS)
def test_one_matrix_turns_many_vectors_with_the_bits_of_as_many_matrices(dtype):
    n = rotation.MANY
    for A, a in zip(orders((), (3, 3), dtype, 7), orders((2, n), (3,), dtype, 8), strict=True):
        found = rotation.apply(A, a)
        assert found.dtype == dtype
        assert np.array_equal(found, rotation.apply(np.broadcast_to(A, (2, n, 3, 3)), a))


@pytest.mark.parametrize("batch", BATCHES, ids=str)
@pytest.mark.parametrize("dtype", REALS)
def test_vector_product(batch, dtype):
    for a, r in zip(orders(batch, (3,), dtype, 5), orders(batch, (8, 3), dtype, 6), strict=True):
        c = rotation.cross(a[..., None, :], r)
        assert c.dtype == dtype
        assert c.shape == batch + (8, 3)
        for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
            assert np.array_equal(c[..., k], a[..., None, i] * r[..., j] - a[..., None, j] * r[..., i])
        assert np.array_equal(rotation.cross(r, a[..., None, :]), -c)
        # hat(a) r sums 0 r_x as well, which changes no bit
        assert np.array_equal(rotation.apply_to_points(rotation.hat(a), r), c)


@pytest.mark.parametrize("dtype", REALS)
def test_vector_product_of_two_vectors_has_the_bits_of_a_batch_of_one(dtype):
    for seed in range(20):
        for a, b in zip(orders((), (3,), dtype, seed), orders((), (3,), dtype, 100 + seed), strict=True):
            c = rotation.cross(a, b)
            assert c.dtype == dtype
            assert np.array_equal(c, [a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1))])
            assert np.array_equal(c, rotation.cross(a[None], b[None])[0])


def test_vector_product_of_two_axes_is_the_third():
    """Right-handed, and with zeros among the components: nothing is divided by."""
    x, y, z = np.eye(3)
    for a, b, c in ((x, y, z), (y, z, x), (z, x, y)):
        assert np.array_equal(rotation.cross(a, b), c)
        assert np.array_equal(rotation.cross(b, a), -c)
        assert np.array_equal(rotation.cross(a, a), np.zeros(3))


def test_one_vector_is_broadcast_over_many():
    a, many = np.array([1.0, -2.0, 3.5]), np.random.default_rng(7).normal(size=(8, 3))
    assert np.array_equal(rotation.cross(many, a), [rotation.cross(b, a) for b in many])
    assert np.array_equal(rotation.cross(a, many), [rotation.cross(a, b) for b in many])


def test_vector_product_keeps_the_batch_fastest_in_memory():
    """Where one of the two has it so, whichever it is: the other may lie in any order."""
    many = rotation.empty((5,), (8, 3), float)
    many[...] = 1
    for one in (np.ones((5, 1, 3)), rotation.empty((5,), (1, 3), float)):
        one[...] = 2
        assert rotation.cross(one, many).strides == rotation.cross(many, one).strides == many.strides


def test_vector_products_with_no_points_are_none():
    a, nothing = np.ones((5, 1, 3)), rotation.empty((5,), (0, 3), float)
    for one in (a, rotation.empty((5,), (1, 3), float)):
        assert rotation.cross(one, nothing).shape == (5, 0, 3)


def test_empty_lets_the_batch_vary_fastest():
    a = rotation.empty((5, 4), (8, 3), np.float32)
    assert a.shape == (5, 4, 8, 3)
    assert a.dtype == np.float32
    assert a.strides == (4 * 4, 4, 5 * 4 * 4 * 3, 5 * 4 * 4)
    assert rotation.empty((), (8, 3), np.float64).flags.c_contiguous


def exact_exponential_minus_identity(Theta):
    """exp(hat(Theta)) - I as a sum of matrix powers, 50 digits."""
    with mpmath.workdps(50):
        x, y, z = map(mpmath.mpf, map(float, Theta))
        H = mpmath.matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        term, total = H, H.copy()
        for k in range(2, 80):
            term = term * H / k
            total += term
        return [[total[i, j] for j in range(3)] for i in range(3)]


@pytest.mark.parametrize("size", [0, 1e-12, 1e-7, 1e-5, 1e-3, 0.00999, 0.01001, 0.3, 1.5, 3.1])
@pytest.mark.parametrize("dtype", REALS)
def test_exponential_against_fifty_digits(size, dtype):
    for seed in range(5):
        axis = np.random.default_rng(seed).normal(size=3)
        Theta = (axis / np.linalg.norm(axis) * size).astype(np.float32).astype(dtype)
        E, exact = rotation.exp_minus_identity(Theta), exact_exponential_minus_identity(Theta)
        assert E.dtype == rotation.exponential(Theta).dtype == dtype
        difference = np.array([[float(mpmath.mpf(float(E[i, j])) - exact[i][j]) for j in range(3)] for i in range(3)])
        # Each entry is a sum of two rounded products of size |Theta| at most; the coefficients are within 2 ulp; at
        # 3.1 rad the alternating series has terms of 3.1^2/6, which costs the factor 8. float() rounds longdouble.
        bound = 8 * max(np.finfo(dtype).eps, np.finfo(float).eps / 2) * max(size, 1e-300)
        assert np.max(np.abs(difference)) <= bound


@pytest.mark.parametrize("dtype", REALS)
def test_series_coefficients(dtype):
    for t, terms in ((1e-4, 4), (2e-5, 4), (1e-12, 4), (0.5, 18), (10.24, 18)):
        s, c = rotation.series_coefficients(dtype(t), terms)
        with mpmath.workdps(40):
            theta = mpmath.sqrt(mpmath.mpf(str(dtype(t)) if dtype is np.longdouble else float(dtype(t))))
            exact_s, exact_c = mpmath.sin(theta) / theta, (1 - mpmath.cos(theta)) / theta**2
            # Below 1e-4 all is 1 - small, correct to 1 ulp; at 3.2 rad terms of size 2.5 are subtracted: 4 ulp of them.
            bound = float(np.finfo(dtype).eps) * (1 if t < 1e-3 else 4)
            assert abs(mpmath.mpf(str(s)) - exact_s) <= bound
            assert abs(mpmath.mpf(str(c)) - exact_c) <= bound


def test_short_series_drops_nothing_that_longdouble_could_hold():
    t = np.longdouble(rotation.SHORT_SERIES_ANGLE_SQUARED)
    short, long = rotation.series_coefficients(t, 4), rotation.series_coefficients(t, rotation.LONG_SERIES_TERMS)
    assert short == long


def test_exponential_is_the_matrix_form():
    """The entries written out agree with s H + c H H, the form of the textbooks, to rounding."""
    Theta = np.random.default_rng(0).normal(size=(100, 3)) * np.logspace(-8, 0, 100)[:, None]
    H = rotation.hat(Theta)
    angle = np.sqrt(rotation.dot(Theta, Theta))[:, None, None]
    s, c = np.sin(angle) / angle, 2 * (np.sin(angle / 2) / angle) ** 2
    # three roundings of numbers of size |Theta|
    assert np.all(np.abs(rotation.exp_minus_identity(Theta) - (s * H + c * (H @ H))) <= 3e-16 * angle)


@pytest.mark.parametrize("size", [0, 1e-7, 1e-5, 0.00999, 0.01001, 0.3, 3.1])
@pytest.mark.parametrize("dtype", REALS)
def test_exponential_of_one_vector_has_the_bits_of_a_batch_of_one(size, dtype):
    for seed in range(5):
        axis = np.random.default_rng(seed).normal(size=3)
        Theta = (axis / np.linalg.norm(axis)).astype(dtype) * dtype(size)
        E = rotation.exp_minus_identity(Theta)
        assert E.dtype == dtype
        assert np.array_equal(E, rotation.exp_minus_identity(Theta[None])[0])


@pytest.mark.parametrize("dtype", REALS)
def test_exponential_refuses_half_a_turn(dtype):
    """3.3 rad, of one block or of one among others: the largest turn is named."""
    too_far, near, little = np.array([[0, 3.3, 0], [0, 3.19, 0], [1e-5, 0, 0]], dtype)
    for Theta in (too_far, np.stack([little, too_far, near]), np.stack([[near, little], [little, too_far]])):
        error = refused(rotation.exp_minus_identity, Theta)
        assert error.code == "E-ANGLE"
        assert str(error) == (
            "Theta: a step turns the block by 3.3 rad. Use a smaller step or a smaller angular velocity. [E-ANGLE]"
        )
    rotation.exp_minus_identity(near)
    rotation.exp_minus_identity(np.stack([near, little]))


def test_a_truth_holds_somewhere_in_one_number_or_in_many():
    for none in (False, np.False_, np.array(False), np.zeros(3, bool), np.zeros((0,), bool)):
        assert rotation.somewhere(none) is False
    for some in (True, np.True_, np.array(True), np.array([False, True]), np.array([[False], [True]])):
        assert rotation.somewhere(some) is True


def test_one_large_angle_in_a_batch_does_not_touch_the_others():
    small = np.array([1e-6, 2e-6, -3e-6])
    both = rotation.exp_minus_identity(np.stack([small, np.array([0.5, 1.0, 1.5])]))
    assert np.array_equal(both[0], rotation.exp_minus_identity(small))
    assert np.array_equal(both[1], rotation.exp_minus_identity(np.array([0.5, 1.0, 1.5])))


def test_logarithm_and_quaternion_undo_the_exponential():
    generator = np.random.default_rng(1)
    axis = generator.normal(size=(300, 3))
    axis /= np.linalg.norm(axis, axis=-1, keepdims=True)
    # every branch of the quaternion: small angles (w largest) and half turns about each axis
    angle = np.concatenate([np.logspace(-9, -1, 100), generator.uniform(0.1, 3.0, 100), np.full(100, 3.1)])
    Theta = axis * angle[:, None]
    Lambda = rotation.exponential(Theta)
    q = rotation.quaternion(Lambda)
    # A rotation matrix holds an angle to some 1e-16 in its entries; 20 roundings on the way.
    assert np.max(np.abs(rotation.logarithm(Lambda) - Theta)) < 4e-15
    assert np.max(np.abs(rotation.from_quaternion(q) - Lambda)) < 2e-15
    assert np.max(np.abs(np.sum(q * q, axis=-1) - 1)) < 1e-15
    assert np.all(q[..., 0] >= 0)
    assert np.max(np.abs(rotation.from_quaternion(3.0 * q) - Lambda)) < 2e-15


def test_quaternion_of_half_turns_and_of_the_identity():
    for k in range(3):
        half_turn = -np.eye(3)
        half_turn[k, k] = 1
        # the largest component is taken first, and with its sign
        assert np.array_equal(rotation.quaternion(half_turn), np.eye(4)[k + 1])
    assert np.array_equal(rotation.quaternion(np.eye(3)), [1, 0, 0, 0])
    assert np.array_equal(rotation.logarithm(np.eye(3)), [0, 0, 0])


def test_rotation_turns_the_way_of_the_right_hand():
    quarter = rotation.exponential(np.array([0, 0, np.pi / 2]))
    # 5e-17 is the rounding of pi/2
    assert np.max(np.abs(rotation.apply(quarter, np.array([1.0, 0, 0])) - [0, 1, 0])) < 3e-16


def test_inverse():
    A = np.random.default_rng(2).normal(size=(20, 3, 3)) + 3 * np.eye(3)
    # condition numbers here are below 100
    assert np.max(np.abs(rotation.product(A, rotation.inverse(A)) - np.eye(3))) < 1e-13
    assert np.array_equal(rotation.transposed(A), A.transpose(0, 2, 1))


def test_logarithm_of_a_rotation_whose_square_vanishes():
    """1e-170 rad: its square is zero, it is not."""
    Theta = np.array([1e-170, -2e-170, 3e-170])
    assert rotation.logarithm(np.eye(3) + rotation.hat(Theta)) == pytest.approx(Theta, rel=1e-15, abs=0)


@pytest.mark.parametrize("dtype", REALS)
@pytest.mark.parametrize("batch", BATCHES, ids=str)
def test_matrix_of_a_quaternion_keeps_batch_and_precision(batch, dtype):
    Lambda = rotation.from_quaternion(np.ones(batch + (4,), dtype))
    assert Lambda.dtype == dtype
    # a third of a turn about the diagonal: x to y, y to z, z to x
    assert np.array_equal(Lambda, np.broadcast_to([[0, 0, 1], [1, 0, 0], [0, 1, 0]], batch + (3, 3)))
