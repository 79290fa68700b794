"""A question as plain data, which a process of its own can read without SymPy: the least upper
bound of a fraction of polynomials on a box.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import permutations
from math import lcm

from certificates.search.plain_polynomials import Exponents, Terms, value_at


@dataclass(frozen=True)
class Problem:
    """The supremum of over/under on the box; under > 0 inside it, and where under = 0 on its
    boundary, over < 0.

    So over/under <= m everywhere if and only if m under - over >= 0 on the closed box.  `sign` is
    -1 where the question is for the infimum of
    -over/under.  `statement` says the same of the set itself as the paper has it, in the checker's
    language, with {bound} for the bound of the question as it is asked; `smt` asks in SMT-LIB for
    what exceeds it.
    """

    name: str
    names: tuple[str, ...]
    box: tuple[tuple[Fraction, Fraction], ...]
    over: Terms
    under: Terms
    sign: int
    statement: str
    smt: str

    def excess(self, bound: Fraction) -> dict[Exponents, Fraction]:
        """bound * under - over, which is >= 0 on the box if and only if the supremum is at most the
        bound.
        """
        total = {exponents: c * bound for exponents, c in self.under.items()}
        for exponents, c in self.over.items():
            total[exponents] = total.get(exponents, Fraction(0)) - c
        return {exponents: c for exponents, c in total.items() if c}

    def at(self, point: Sequence[Fraction]) -> Fraction | None:
        """over/under at a point; None where under is 0."""
        under = value_at(self.under, point)
        return value_at(self.over, point) / under if under else None

    def of_set(self, bound: Fraction) -> str:
        """The statement that nothing in the set exceeds the bound (or is below its negative, where
        the question is for the infimum).
        """
        return self.statement.format(bound=self.sign * bound)

    def asked(self, bound: Fraction) -> str:
        """Whether something in the set exceeds the bound (is below its negative), in SMT-LIB
        without a check.
        """
        value = self.sign * bound
        size = f"(/ {abs(value.numerator)}.0 {value.denominator}.0)"
        return self.smt.format(bound=size if value >= 0 else f"(- {size})")

    def of_box(self, low: Fraction, high: Fraction) -> str:
        """The statement that over/under is at most `high` at every point of the box where it is at
        least `low`, in the checker's language.

        A certificate of it holds a point where what is given is true.  So the supremum is at least
        `low`, and at most `high`.
        """
        (a, b), (c, d) = low.as_integer_ratio(), high.as_integer_ratio()
        return self.boxed.format(low=a, below=b, high=c, above=d)

    @cached_property
    def boxed(self) -> str:
        """The text of `of_box`, with the bounds low/below and high/above still to be put in."""
        unit = lcm(*(c.denominator for terms in (self.over, self.under) for c in terms.values()))
        over, under = (
            _shortest({e: c * unit for e, c in terms.items()}, self.names)
            for terms in (self.over, self.under)
        )
        return "\n".join(
            [
                f"statement bench/{self.name}",
                "forall " + " ".join(self.names),
                *(
                    f"given {low} <= {name} <= {high}"
                    for name, (low, high) in zip(self.names, self.box)
                ),
                f"let over = {over}",
                f"let under = {under}",
                "given under > 0",
                "given {below}*over >= {low}*under",
                "show {above}*over <= {high}*under",
                "",
            ]
        )


def _shortest(terms: Terms, names: Sequence[str]) -> str:
    """The polynomial nested by its variables in the order in which the text is shortest, where they
    are few.
    """
    orders = permutations(range(len(names))) if len(names) < 5 else [tuple(range(len(names)))]
    texts = [
        horner(
            {tuple(e[i] for i in order): c for e, c in terms.items()},
            [names[i] for i in order],
            str,
        )
        for order in orders
    ]
    return min(texts, key=len) or "0"


def horner(terms: Terms, names: Sequence[str], write: Callable[[Fraction], str]) -> str:
    """The polynomial nested by its variables: short, and enclosed by intervals more tightly than a
    sum of monomials; nothing for 0.

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
