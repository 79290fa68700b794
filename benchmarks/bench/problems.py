"""A question as plain data, which a process of its own can read without SymPy: the least upper bound of a fraction of polynomials on a box."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

Terms = Mapping[tuple[int, ...], Fraction]  # a polynomial: exponents and coefficient
Box = Sequence[tuple[Fraction, Fraction]]


@dataclass(frozen=True)
class Problem:
    """The supremum of over/under on the box; under > 0 inside it, and where under = 0 on its boundary, over < 0.

    So over/under <= m everywhere if and only if m under - over >= 0 on the closed box.  `sign` is -1 where the question is for the infimum of
    -over/under.  `statement` says the same of the set itself as the paper has it, in the checker's language, with {bound} for the bound of the
    question as it is asked; `smt` asks in SMT-LIB for what exceeds it.
    """

    name: str
    names: tuple[str, ...]
    box: tuple[tuple[Fraction, Fraction], ...]
    over: Terms
    under: Terms
    sign: int
    statement: str
    smt: str

    def excess(self, bound: Fraction) -> dict[tuple[int, ...], Fraction]:
        """bound * under - over, which is >= 0 on the box if and only if the supremum is at most the bound."""
        return combined(self.under, bound, self.over)

    def at(self, point: Sequence[Fraction]) -> Fraction | None:
        """over/under at a point; None where under is 0."""
        under = value_of(self.under, point)
        return value_of(self.over, point) / under if under else None

    def of_set(self, bound: Fraction) -> str:
        """The statement that nothing in the set exceeds the bound (or is below its negative, where the question is for the infimum)."""
        return self.statement.format(bound=self.sign * bound)

    def asked(self, bound: Fraction) -> str:
        """Whether something in the set exceeds the bound (is below its negative), in SMT-LIB without a check."""
        value = self.sign * bound
        size = f"(/ {abs(value.numerator)}.0 {value.denominator}.0)"
        return self.smt.format(bound=size if value >= 0 else f"(- {size})")

    def of_box(self, bound: Fraction) -> str:
        """The same statement of the box, as text in the checker's language."""
        givens = [row for name, (low, high) in zip(self.names, self.box) for row in (f"given {low} <= {name}", f"given {name} <= {high}")]
        shown = f"show {self.text(self.excess(bound))} >= 0"
        return "\n".join([f"statement bench/{self.name}", "forall " + " ".join(self.names), *givens, shown, ""])

    def text(self, terms: Terms) -> str:
        """A polynomial times the denominators of its coefficients, which changes no relation to 0, in the checker's language."""
        unit = lcm(*(c.denominator for c in terms.values()))
        return horner({e: c * unit for e, c in terms.items()}, self.names, str) or "0"


def horner(terms: Terms, names: Sequence[str], write: Callable[[Fraction], str]) -> str:
    """The polynomial nested by its variables: short, and enclosed by intervals more tightly than a sum of monomials; nothing for 0.

    >>> F = Fraction
    >>> horner({(0, 1): F(2), (2, 0): F(1), (2, 1): F(-3)}, ["x", "y"], str)
    'y*2 + x*(x*(1 + y*(-3)))'
    """
    if not names:
        (value,) = terms.values()
        return write(value)
    rest = {(e[0] - 1, *e[1:]): c for e, c in terms.items() if e[0]}
    without = {e[1:]: c for e, c in terms.items() if not e[0]}
    parts = [horner(without, names[1:], write)] if without else []
    if rest:
        inside = horner(rest, names, write)
        parts.append(f"{names[0]}*{inside}" if inside.isalnum() else f"{names[0]}*({inside})")
    return " + ".join(parts)


def combined(first: Terms, factor: Fraction, second: Terms) -> dict[tuple[int, ...], Fraction]:
    """factor * first - second."""
    total = {exponents: c * factor for exponents, c in first.items()}
    for exponents, c in second.items():
        total[exponents] = total.get(exponents, Fraction(0)) - c
    return {exponents: c for exponents, c in total.items() if c}


def value_of(terms: Terms, point: Sequence[Fraction]) -> Fraction:
    """The exact value of a polynomial at a point."""
    total = Fraction(0)
    for exponents, c in terms.items():
        for x, e in zip(point, exponents):
            c = c * x**e if e else c
        total += c
    return total
