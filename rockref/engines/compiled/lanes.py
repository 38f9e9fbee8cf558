"""Numbers of several runs in the lanes of one vector register, as a type of compiled code beside float64.

A function of this folder is written once. Compiled with float64 it makes the step of one run; compiled with lanes it
makes the same operations, in the same order, for as many runs as a register holds. Where runs may differ in what they
do, the text asks `anyof` whether some run does it, and takes by `choose` what is each run's own. With one run `anyof`
is the condition itself, and the compiler takes the choice away.

The type is LLVM's vector of doubles. Each operation on it is that of IEEE 754, lane by lane, and nothing is contracted:
the bits are those of one run. `exp`, `cos`, `sin` and powers call the scalar function for each lane.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any

from llvmlite import binding, ir
from numba.core import cgutils, types
from numba.core.typeconv import Conversion
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, lower_cast, models, register_model


def _width() -> int:
    """Return how many doubles a vector register holds; four where it holds fewer: the compiler pairs them."""
    features = binding.get_host_cpu_features()
    return 8 if features.get("avx512f") else 4


#: How many runs go abreast.
LANES = _width()

DOUBLES, BITS = ir.VectorType(ir.DoubleType(), LANES), ir.VectorType(ir.IntType(1), LANES)
_NUMBERS = (types.Float, types.Integer)


class Lanes(types.Type):
    """The numbers of LANES runs."""

    def __init__(self) -> None:
        super().__init__(name=f"lanes{LANES}")

    def can_convert_from(self, typingctx: Any, other: Any) -> Any:
        """Say that a plain number is the same in every lane."""
        return Conversion.safe if isinstance(other, _NUMBERS) else None

    def unify(self, typingctx: Any, other: Any) -> Any:
        """Make lanes of a variable that holds a plain number and lanes."""
        return self if isinstance(other, _NUMBERS) else None


class Mask(types.Type):
    """Truths of LANES runs."""

    def __init__(self) -> None:
        super().__init__(name=f"mask{LANES}")


lanes, mask = Lanes(), Mask()


@register_model(Lanes)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, DOUBLES)


@register_model(Mask)
class _MaskModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, BITS)


def choose(truth, yes, no):
    """Choose `yes` where it is true, `no` elsewhere; both are computed."""
    return yes if truth else no


def anyof(truth):
    """Return whether it is true in any lane."""
    return bool(truth)


def both(a, b):
    """Return whether both are true, lane by lane."""
    return bool(a) and bool(b)


def negated(truth):
    """Return whether it is not true, lane by lane."""
    return not truth


def whole(number):
    """Return the largest whole number that is not above it, as a float."""
    return float(math.floor(number))


def entry(table, row, column):
    """Return the entry of a table (n, m) of numbers in a row that is given as a float, for each lane its own."""
    return table[int(row), column]


def _typed(function: Any, typer: Callable[..., Any]) -> None:
    """Give compiled code the type of what the function returns: `typer` of the types of its arguments, or None."""

    class Template(AbstractTemplate):
        # That of this processor is asked before those of any, of which some operators have a dozen.
        metadata = {"target": "CPU"}

        def generic(self, args: Any, kws: Any) -> Any:
            return typer(*args) if not kws else None

    Template.__name__ = f"Lanes_{getattr(function, '__name__', function)}"
    infer_global(function)(Template)


def _is_number(kind: Any) -> bool:
    return isinstance(kind, (Lanes, *_NUMBERS))


def _two_to(result: Any) -> Callable[..., Any]:
    """Give the type of an operation on two numbers, at least one of them lanes."""

    def typer(*args: Any) -> Any:
        if len(args) == 2 and all(map(_is_number, args)) and any(isinstance(a, Lanes) for a in args):
            return signature(result, lanes, lanes)
        return None

    return typer


def _one_to(result: Any) -> Callable[..., Any]:
    def typer(*args: Any) -> Any:
        return signature(result, lanes) if len(args) == 1 and isinstance(args[0], Lanes) else None

    return typer


def _two(function: Any, result: Any, emit: Callable[..., Any]) -> None:
    _typed(function, _two_to(result))
    lower_builtin(function, Lanes, Lanes)(lambda context, builder, sig, args: emit(builder, *args))


def _one(function: Any, emit: Callable[..., Any]) -> None:
    _typed(function, _one_to(lanes))
    lower_builtin(function, Lanes)(lambda context, builder, sig, args: emit(builder, *args))


def _of_llvm(name: str) -> Callable[..., Any]:
    """Call LLVM's function of lanes."""

    def emit(builder: Any, *args: Any) -> Any:
        kind = ir.FunctionType(DOUBLES, [DOUBLES] * len(args))
        return builder.call(builder.module.declare_intrinsic(f"llvm.{name}.v{LANES}f64", (), kind), args)

    return emit


for _functions, _name in [
    ((operator.add, operator.iadd), "fadd"), ((operator.sub, operator.isub), "fsub"),
    ((operator.mul, operator.imul), "fmul"), ((operator.truediv, operator.itruediv), "fdiv"),
]:  # fmt: skip
    for _function in _functions:
        _two(_function, lanes, lambda builder, a, b, name=_name: getattr(builder, name)(a, b))
for _function, _name in [
    (operator.lt, "<"), (operator.le, "<="), (operator.gt, ">"), (operator.ge, ">="), (operator.eq, "=="),
]:  # fmt: skip
    _two(_function, mask, lambda builder, a, b, name=_name: builder.fcmp_ordered(name, a, b))
_two(operator.ne, mask, lambda builder, a, b: builder.fcmp_unordered("!=", a, b))
# As Python's and numba's: the second of two where it is greater, or less.
_two(max, lanes, lambda builder, a, b: builder.select(builder.fcmp_ordered(">", b, a), b, a))
_two(min, lanes, lambda builder, a, b: builder.select(builder.fcmp_ordered("<", b, a), b, a))
_one(operator.neg, lambda builder, a: builder.fneg(a))
_one(math.sqrt, _of_llvm("sqrt"))
_one(abs, _of_llvm("fabs"))


def _lane_by_lane(function: Any, n: int) -> None:
    """Call a function that has no twin with the same bits in vectors once for each lane."""
    scalar = signature(types.float64, *[types.float64] * n)

    def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        call = context.get_function(function, scalar)
        result = ir.Constant(DOUBLES, ir.Undefined)
        for lane in range(LANES):
            at = ir.Constant(ir.IntType(32), lane)
            value = call(builder, [builder.extract_element(a, at) for a in args])
            result = builder.insert_element(result, value, at)
        return result

    _typed(function, _one_to(lanes) if n == 1 else _two_to(lanes))
    lower_builtin(function, *[Lanes] * n)(lower)


_lane_by_lane(math.exp, 1)
_lane_by_lane(math.cos, 1)
_lane_by_lane(math.sin, 1)
_lane_by_lane(operator.pow, 2)


_typed(
    whole,
    lambda *args: signature(*[lanes if isinstance(args[0], Lanes) else types.float64] * 2) if len(args) == 1 else None,
)
lower_builtin(whole, Lanes)(lambda context, builder, sig, args: _of_llvm("floor")(builder, *args))


@lower_builtin(whole, types.Float)
def _whole_number(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return builder.call(builder.module.declare_intrinsic("llvm.floor", [ir.DoubleType()]), args)


def _entry_type(*args: Any) -> Any:
    if len(args) != 3 or not isinstance(args[0], types.Array):
        return None
    kind = lanes if isinstance(args[1], Lanes) else types.float64
    return signature(kind, args[0], kind, types.intp)


def _load(context: Any, builder: Any, sig: Any, args: Any, row: Any) -> Any:
    table = context.make_array(sig.args[0])(context, builder, args[0])
    at = [builder.fptosi(row, context.get_value_type(types.intp)), args[2]]
    return builder.load(cgutils.get_item_pointer(context, builder, sig.args[0], table, at, wraparound=False))


_typed(entry, _entry_type)
lower_builtin(entry, types.Array, types.Float, types.Integer)(
    lambda context, builder, sig, args: _load(context, builder, sig, args, args[1])
)


@lower_builtin(entry, types.Array, Lanes, types.Integer)
def _entries(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    result = ir.Constant(DOUBLES, ir.Undefined)
    for lane in range(LANES):
        at = ir.Constant(ir.IntType(32), lane)
        value = _load(context, builder, sig, args, builder.extract_element(args[1], at))
        result = builder.insert_element(result, value, at)
    return result


def _splat(builder: Any, number: Any) -> Any:
    nowhere, first = ir.Constant(DOUBLES, ir.Undefined), ir.Constant(ir.IntType(32), 0)
    everywhere = ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES)
    return builder.shuffle_vector(builder.insert_element(nowhere, number, first), nowhere, everywhere)


def _number_to_lanes(context: Any, builder: Any, given: Any, wanted: Any, value: Any) -> Any:
    return _splat(builder, context.cast(builder, value, given, types.float64))


for _kind in _NUMBERS:
    lower_cast(_kind, Lanes)(_number_to_lanes)


def _choice(*args: Any) -> Any:
    if len(args) != 3:
        return None
    truth, *values = args
    if isinstance(truth, Mask):
        return signature(lanes, mask, lanes, lanes)
    kind = lanes if any(isinstance(value, Lanes) for value in values) else types.float64
    return signature(kind, types.boolean, kind, kind)


_typed(choose, _choice)
for _kinds in [(Mask, Lanes, Lanes), (types.Boolean, Lanes, Lanes), (types.Boolean, types.Float, types.Float)]:
    lower_builtin(choose, *_kinds)(lambda context, builder, sig, args: builder.select(*args))


def _truths(function: Any, n: int, emit: Callable[..., Any]) -> None:
    """Make a function of truths to truths, of one run or of lanes."""

    def typer(*args: Any) -> Any:
        kind = mask if all(isinstance(a, Mask) for a in args) else types.boolean
        return signature(kind, *[kind] * n) if len(args) == n else None

    _typed(function, typer)
    for kind in (Mask, types.Boolean):
        lower_builtin(function, *[kind] * n)(lambda context, builder, sig, args: emit(builder, *args))


_truths(both, 2, lambda builder, a, b: builder.and_(a, b))
_truths(negated, 1, lambda builder, a: builder.not_(a))


def _reduction(truth: Any) -> Any:
    return signature(types.boolean, truth) if isinstance(truth, (Mask, types.Boolean)) else None


_typed(anyof, _reduction)
lower_builtin(anyof, types.Boolean)(lambda context, builder, sig, args: args[0])


@lower_builtin(anyof, Mask)
def _any_lane(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    together = ir.IntType(LANES)
    return builder.icmp_unsigned("!=", builder.bitcast(args[0], together), ir.Constant(together, 0))


def _as_lanes(typingctx, numbers):
    """Return the array (..., LANES) of numbers as an array (...) of lanes, in the same memory.

    It holds no reference: the array of numbers has to live longer. It need not begin at a multiple of a register.
    """
    kind = types.Array(lanes, numbers.ndim - 1, "C", aligned=False)

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        given = context.make_array(numbers)(context, builder, args[0])
        result = context.make_array(kind)(context, builder)
        context.populate_array(
            result,
            data=builder.bitcast(given.data, ir.PointerType(DOUBLES)),
            shape=cgutils.unpack_tuple(builder, given.shape)[:-1],
            strides=cgutils.unpack_tuple(builder, given.strides)[:-1],
            itemsize=context.get_constant(types.intp, 8 * LANES),
            meminfo=None,
        )
        return result._getvalue()

    return signature(kind, numbers), emit


#: Made at once, so that a checker of types sees a function of compiled code.
as_lanes: Any = intrinsic(_as_lanes)
