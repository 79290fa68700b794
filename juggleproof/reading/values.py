"""The values of a print: scalars, vectors, matrices, functions of a state and regions, with their
arithmetic.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Generic, TypeGuard, TypeVar, Union, overload

from juggleproof.statements.language import ClaimError, Formula, Term, implies

# -------------------------------------------------------------------------------------------------
# Exact values of prints: scalars are Terms (or rational numbers), vectors and matrices are tuples
# of them.

Scalar = Union[int, Fraction, Term]


class ShapeError(ClaimError):
    """The error for values that do not fit together, such as the sum of a vector and a scalar, or
    the product of matrices of different sizes.
    """


def is_scalar(value: object) -> TypeGuard[Scalar]:
    """Whether the value is a term or an exact number."""
    return isinstance(value, (Term, int, Fraction)) and not isinstance(value, bool)


def scalar(value: object) -> Scalar:
    """The value itself, which has to be a scalar; anything else raises ShapeError."""
    if is_scalar(value):
        return value
    raise ShapeError("an entry of a vector or matrix that is not a scalar")


def plus(left: Scalar, right: Scalar) -> Scalar:
    """left + right; if one side is a literal zero, the other side unchanged."""
    if not isinstance(left, Term) and left == 0:
        return right
    return left if not isinstance(right, Term) and right == 0 else left + right


def times(left: Scalar, right: Scalar) -> Scalar:
    """left * right, simplified where a side is a literal zero or one."""
    for one, other in ((left, right), (right, left)):
        if not isinstance(one, Term) and one in (0, 1):
            return other if one == 1 else 0
    return left * right


def over(left: Scalar, right: Scalar) -> Scalar:
    """left / right, exact; a literal zero below raises ShapeError."""
    if isinstance(right, Term):
        return left / right
    if right == 0:
        raise ShapeError("a division by zero")
    return left / right if isinstance(left, Term) else Fraction(left) / right


def _dot(left: tuple[Scalar, ...], right: tuple[Scalar, ...]) -> Scalar:
    if len(left) != len(right):
        raise ShapeError(f"a product of {len(left)} entries with {len(right)}")
    total: Scalar = 0
    for one, other in zip(left, right, strict=True):
        total = plus(total, times(one, other))
    return total


@dataclass(frozen=True, slots=True)
class Vector:
    """A column of scalars.

    >>> (Vector((1, 2)) - Vector((0, 5))) * 3
    Vector(entries=(3, -9))
    """

    entries: tuple[Scalar, ...]

    def __post_init__(self) -> None:
        for entry in self.entries:
            scalar(entry)

    def __iter__(self) -> Iterator[Scalar]:
        return iter(self.entries)

    def component(self, index: int) -> Scalar:
        """The entry of this number, from 1."""
        if not 1 <= index <= len(self.entries):
            raise ShapeError(f"component {index} of a vector with {len(self.entries)} entries")
        return self.entries[index - 1]

    def __add__(self, other: Vector) -> Vector:
        return Vector(tuple(a + b for a, b in self._pairs(other)))

    def __sub__(self, other: Vector) -> Vector:
        return Vector(tuple(a - b for a, b in self._pairs(other)))

    def __neg__(self) -> Vector:
        return Vector(tuple(-entry for entry in self.entries))

    def scaled(self, scalar: Scalar) -> Vector:
        """Every entry times the scalar, which stands on its left."""
        if not is_scalar(scalar):
            raise ShapeError("a product of a vector with something that is not a scalar")
        return Vector(tuple(times(scalar, entry) for entry in self.entries))

    __mul__ = scaled
    __rmul__ = scaled

    def __truediv__(self, scalar: Scalar) -> Vector:
        return Vector(tuple(over(entry, scalar) for entry in self.entries))

    def _pairs(self, other: Vector) -> Iterator[tuple[Scalar, Scalar]]:
        if not isinstance(other, Vector) or len(other.entries) != len(self.entries):
            raise ShapeError("a sum of a vector with something that is not a vector of its length")
        return zip(self.entries, other.entries, strict=True)


@dataclass(frozen=True, slots=True)
class Matrix:
    """Rows of scalars; a single row times a vector is a scalar.

    >>> Matrix(((1, 2), (3, 4))) * Vector((1, 1))
    Vector(entries=(3, 7))
    >>> Matrix(((1, 2), (3, 4))).inverse() * Matrix(((1, 2), (3, 4)))
    Matrix(rows=((Fraction(1, 1), Fraction(0, 1)), (Fraction(0, 1), Fraction(1, 1))))
    """

    rows: tuple[tuple[Scalar, ...], ...]

    def __post_init__(self) -> None:
        for row in self.rows:
            for entry in row:
                scalar(entry)

    @property
    def shape(self) -> tuple[int, int]:
        """The numbers of rows and of columns."""
        return len(self.rows), len(self.rows[0])

    def __add__(self, other: Matrix) -> Matrix:
        return self._entrywise(other, lambda a, b: a + b)

    def __sub__(self, other: Matrix) -> Matrix:
        return self._entrywise(other, lambda a, b: a - b)

    def __neg__(self) -> Matrix:
        return Matrix(tuple(tuple(-entry for entry in row) for row in self.rows))

    @overload
    def __mul__(self, other: Vector) -> Vector | Scalar: ...
    @overload
    def __mul__(self, other: Matrix | Scalar) -> Matrix: ...
    def __mul__(self, other: Vector | Matrix | Scalar) -> Vector | Matrix | Scalar:
        if isinstance(other, Vector):
            entries = tuple(_dot(row, other.entries) for row in self.rows)
            return entries[0] if len(entries) == 1 else Vector(entries)
        if isinstance(other, Matrix):
            columns = tuple(zip(*other.rows, strict=True))
            return Matrix(
                tuple(tuple(_dot(row, column) for column in columns) for row in self.rows)
            )
        return self.scaled(other)

    def scaled(self, scalar: Scalar) -> Matrix:
        """Every entry times the scalar, which stands on its left."""
        if not is_scalar(scalar):
            raise ShapeError(
                "a product of a matrix with something that is neither matrix, vector nor scalar"
            )
        return Matrix(tuple(tuple(times(scalar, entry) for entry in row) for row in self.rows))

    __rmul__ = scaled

    def __truediv__(self, scalar: Scalar) -> Matrix:
        return Matrix(tuple(tuple(over(entry, scalar) for entry in row) for row in self.rows))

    def transpose(self) -> Matrix:
        """Rows and columns exchanged."""
        return Matrix(tuple(zip(*self.rows, strict=True)))

    def determinant(self) -> Scalar:
        """a d - b c, of a 2 by 2 matrix."""
        if self.shape != (2, 2):
            raise ShapeError("a determinant of a matrix that is not 2 by 2")
        (a, b), (c, d) = self.rows
        return a * d - b * c

    def inverse(self) -> Matrix:
        """The inverse of a 2 by 2 matrix, by its adjugate over its determinant."""
        below = self.determinant()
        (a, b), (c, d) = self.rows
        return Matrix(((over(d, below), over(-b, below)), (over(-c, below), over(a, below))))

    def power(self, exponent: int) -> Matrix:
        """The integer power of a square matrix."""
        rows, columns = self.shape
        if rows != columns:
            raise ShapeError("a power of a matrix that is not square")
        base = self.inverse() if exponent < 0 else self
        if abs(exponent) > 9:
            raise ShapeError(f"a power {exponent} of a matrix, which is beyond 9")
        result = Matrix(tuple(tuple(int(i == j) for j in range(rows)) for i in range(rows)))
        for _ in range(abs(exponent)):
            result = result * base
        return result

    def _entrywise(self, other: Matrix, join: Callable[[Scalar, Scalar], Scalar]) -> Matrix:
        if not isinstance(other, Matrix) or other.shape != self.shape:
            raise ShapeError("a sum of a matrix with something that is not a matrix of its shape")
        pairs = zip(self.rows, other.rows, strict=True)
        return Matrix(
            tuple(tuple(join(a, b) for a, b in zip(*rows, strict=True)) for rows in pairs)
        )


# -------------------------------------------------------------------------------------------------
# Values that are not numbers: functions of a state, regions, restrictions, cases, limits and
# extrema.


def applied(function: object, *arguments: Value) -> Value:
    """The value of the function at these arguments; raises ShapeError where it is not a function,
    or cannot take them.
    """
    if not callable(function):
        raise ShapeError(f"{kind_of(function)} where a function is expected")
    try:
        value: Value = function(*arguments)
        return value
    except (TypeError, AttributeError) as problem:
        kinds = ", ".join(type(argument).__name__.lower() for argument in arguments)
        raise ShapeError(f"a function that cannot take ({kinds})") from problem


Result = TypeVar("Result", bound="Value")


@dataclass(frozen=True, slots=True)
class StateFunction(Generic[Result]):
    """A function of a state, applied to a bracketed state; a bracketed scalar after it is refused.

    With `factor` set, a bracketed scalar makes a product: tau_c(b) is an application, and in tau_c
    (v - r) the function stands for its value at the present state.
    """

    call: Callable[..., Result]
    factor: bool = False

    def __call__(self, *arguments: Value) -> Result:
        for argument in arguments:
            if not isinstance(argument, Vector):
                raise ShapeError("a function of a state, given something else")
        return self.call(*arguments)


@dataclass(frozen=True, slots=True)
class Region:
    """A set of states: `holds` returns the formula that a state is in it."""

    holds: Callable[[Vector], Formula]

    def __call__(self, state: Vector) -> Formula:
        return self.holds(state)

    def __and__(self, other: Region) -> Region:
        return Region(lambda state: self(state) & other(state))

    def __or__(self, other: Region) -> Region:
        return Region(lambda state: self(state) | other(state))

    def __sub__(self, other: Region) -> Region:
        return Region(lambda state: self(state) & ~other(state))


@dataclass(frozen=True, slots=True)
class Image:
    """The image of a region under a function, which may stand only on the left of an inclusion."""

    function: Callable[..., Value]
    region: Region


@dataclass(frozen=True, slots=True)
class Restricted:
    """A function on a region only."""

    function: Callable[..., Value]
    region: Region

    def __call__(self, state: Vector) -> Guarded:
        return Guarded(self.region(state), applied(self.function, state))


@dataclass(frozen=True, slots=True)
class Guarded:
    """A value about which relations are stated only under a condition."""

    condition: Formula
    value: Value

    def under(self, conclusion: Formula) -> Formula:
        """The formula that the condition implies the conclusion."""
        return implies(self.condition, conclusion)


@dataclass(frozen=True, slots=True)
class Piece:
    """One line of a list of cases: a value, its condition, and, where the line has a chain of
    relations in place of a value, the formula of that chain.
    """

    value: Value
    condition: Formula
    besides: Formula | None = None


@dataclass(frozen=True, slots=True)
class Piecewise:
    """A list of cases."""

    pieces: tuple[Piece, ...]


@dataclass(frozen=True, slots=True)
class Rounded:
    r"""The greatest integer below (\lfloor) or the least above (\lceil)."""

    bracket: str
    value: Value


@dataclass(frozen=True, slots=True)
class ExtremalValue:
    r"""\max, \min, \sup or \inf of a value under a condition."""

    sign: str
    condition: Formula | None
    value: Value


@dataclass(frozen=True, slots=True)
class LimitValue:
    r"""The limit of a value as the named variable goes to the named destination (both as LaTeX)."""

    variable: str
    destination: str
    value: Value


# the values of expressions in a print; a relation is a formula
Value = Union[
    Scalar,
    Vector,
    Matrix,
    Formula,
    Region,
    Image,
    Restricted,
    Guarded,
    Piecewise,
    Rounded,
    ExtremalValue,
    LimitValue,
    Callable[..., "Value"],
]


# -------------------------------------------------------------------------------------------------
# Sums, products and powers of values of any kind; errors name the operation that does not fit.


def kind_of(value: object) -> str:
    """The kind of a value in a word, for messages."""
    if is_scalar(value):
        return "a scalar"
    if isinstance(value, (Formula, Vector, Matrix, Region)):
        return f"a {type(value).__name__.lower()}"
    return "a function" if callable(value) else f"{type(value).__name__}"


def add(left: Value, right: Value) -> Value:
    """left + right."""
    if is_scalar(left) and is_scalar(right):
        return left + right
    if isinstance(left, Vector) and isinstance(right, Vector):
        return left + right
    if isinstance(left, Matrix) and isinstance(right, Matrix):
        return left + right
    raise ShapeError(f"a sum of {kind_of(left)} and {kind_of(right)}")


def subtract(left: Value, right: Value) -> Value:
    """left - right, of numbers or of regions."""
    if is_scalar(left) and is_scalar(right):
        return left - right
    if isinstance(left, Vector) and isinstance(right, Vector):
        return left - right
    if isinstance(left, Matrix) and isinstance(right, Matrix):
        return left - right
    if isinstance(left, Region) and isinstance(right, Region):
        return left - right
    raise ShapeError(f"a difference of {kind_of(left)} and {kind_of(right)}")


def union(left: Value, right: Value) -> Region:
    """The union of two regions."""
    if isinstance(left, Region) and isinstance(right, Region):
        return left | right
    raise ShapeError(f"a union of {kind_of(left)} and {kind_of(right)}")


def negate(value: Value) -> Value:
    """-value."""
    if isinstance(value, (int, Fraction, Term, Vector, Matrix)):
        return -value
    raise ShapeError(f"minus {kind_of(value)}")


def multiply(left: Value, right: Value) -> Value:
    """left right: scalars, a scalar and a vector or matrix, a matrix and a vector or matrix."""
    if is_scalar(left) and is_scalar(right):
        return left * right
    if is_scalar(left) and isinstance(right, (Vector, Matrix)):
        return right.scaled(left)
    if isinstance(left, (Vector, Matrix)) and is_scalar(right):
        return left.scaled(right)
    if isinstance(left, Matrix) and isinstance(right, (Vector, Matrix)):
        return left * right
    raise ShapeError(f"a product of {kind_of(left)} and {kind_of(right)}")


def raised(base: Value, exponent: int) -> Value:
    """base to an integer power."""
    if isinstance(base, Matrix):
        return base.power(exponent)
    if isinstance(base, Term):
        return base**exponent if exponent >= 0 else over(1, base**-exponent)
    if isinstance(base, (int, Fraction)):
        return Fraction(base) ** exponent if exponent >= 0 else over(1, Fraction(base) ** -exponent)
    raise ShapeError(f"a power of {kind_of(base)}")
