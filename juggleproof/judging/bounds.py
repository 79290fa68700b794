"""A certified enclosure of the minimum of a polynomial over a box: two statements that the checker
certifies.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from pathlib import Path

from juggleproof.algebra.polynomials import Monomial, Ring, monomials
from juggleproof.certificates import checker
from juggleproof.judging import limits
from juggleproof.search.boxes.descent import BoxProblem
from juggleproof.search.boxes.enclosures import Bounds, search_enclosure
from juggleproof.search.psatz.problem import LeafProblem as FactsOfState
from juggleproof.search.psatz.sums_of_squares import programs_of_facts, search_squares
from juggleproof.statements.language import ClaimError, Term, real
from juggleproof.statements.nodes import Certificate, Node, Point
from juggleproof.statements.states import state_of
from juggleproof.statements.store import (
    CERTIFICATES,
    STATEMENTS,
    canonical,
    certificate_lines,
    plain_file,
    write_file,
)
from juggleproof.statements.work import Budget, Exhausted

LOWER, ATTAINED = "bound/lower", "bound/attained"
Number = int | Fraction
Box = Mapping[str, Sequence[Number]]  # the low and the high end of each variable
Ends = dict[str, tuple[Fraction, Fraction]]
Terms = dict[Monomial, Fraction]


@dataclass(frozen=True)
class Enclosure:
    """An enclosure low <= minimum <= high, certified on both sides: the value at `point` is at most
    high; the checker has certified `statements` by `certificates`.
    """

    low: Fraction
    high: Fraction
    point: dict[str, Fraction]
    boxes: int
    reached: bool
    statements: str
    certificates: dict[str, Certificate]

    @property
    def width(self) -> Fraction:
        """high - low."""
        return self.high - self.low

    @property
    def certificate_bytes(self) -> int:
        """The bytes of the certificate file."""
        return len(certificate_lines(self.certificates))

    def write(self, folder: Path) -> None:
        """Writes statements and certificates as `juggleproof check` reads them; raises ClaimError
        where the folder holds others.
        """
        refuse_other_files(folder)
        write_file(folder / STATEMENTS, self.statements.encode())
        write_file(folder / CERTIFICATES, certificate_lines(self.certificates))


def refuse_other_files(folder: Path) -> None:
    """Raises ClaimError, one line, where the path is not a folder, or the folder has statements or
    certificates that are not of a bound.
    """
    if folder.exists() and not folder.is_dir():
        raise ClaimError(f"{folder} is no folder; name one that is new or empty")
    others = []
    statements = folder / STATEMENTS
    if not statements.exists():
        others += [CERTIFICATES] if (folder / CERTIFICATES).exists() else []
    elif (
        not plain_file(statements)
        .read_text(encoding="utf-8", errors="replace")
        .startswith(f"statement {LOWER}\n")
    ):
        others.append(STATEMENTS)
    if others:
        raise ClaimError(
            f"{folder} holds {others[0]}, which is not of a bound; name a folder that is new or"
            " empty"
        )


def enclose_minimum(
    polynomial: str | Term, box: Box, width: Number, budget: int = limits.BOXES
) -> Enclosure:
    """An enclosure low <= min p <= high with high - low <= width, where p runs over the box {name:
    (low, high)}.

    Numbers are exact (int or Fraction), in the units of the polynomial and of its variables;
    `width` 0 asks for the minimum itself, which is reached only where it is rational and the search
    finds it.  `budget` counts boxes.  Both bounds are certified by the checker before they are
    returned; where the budget ends first, `reached` is False, and the bounds are the best that the
    search has found.

    >>> found = enclose_minimum("x^2 - x*y + y^2/2", {"x": (-1, 1), "y": (Fraction(1, 2), 1)}, 0)
    >>> found.low, found.high, found.point
    (Fraction(1, 16), Fraction(1, 16), {'x': Fraction(1, 4), 'y': Fraction(1, 2)})

    Raises ClaimError, one line, for a width below 0, an empty box, and a text that is not a
    polynomial in the variables of the box, or is too large.
    """
    text, ends, sought = _readable(str(polynomial)), _ends(box), _exact(width, "width")
    if sought < 0:
        raise ClaimError(f"width {sought} is below 0; choose 0 or more")
    if budget < 1:
        raise ClaimError(f"budget {budget} is below 1; choose 1 box or more")
    terms = _terms(text, list(ends))
    used = [k for k in range(len(ends)) if any(exponents[k] for exponents in terms)]
    _refuse_large(terms, ends, used)
    question = _Question(text, ends)
    if not used:
        value = sum(terms.values(), start=Fraction(0))
        return question.enclosure(Bounds(value, value, (), ("close",), 0, True), used)
    problem = BoxProblem(
        {tuple(exponents[k] for k in used): c for exponents, c in terms.items()},
        [list(ends.values())[k] for k in used],
        [list(ends)[k] for k in used],
        [(2 * k, 2 * k + 1) for k in used],
        2 * len(ends),
    )
    found = search_enclosure(problem, sought, budget, question.holds, question.by_squares)
    return question.enclosure(found, used)


class _Question:
    """The two statements about a polynomial on a box, and the checks of their certificates."""

    def __init__(self, text: str, ends: Ends) -> None:
        self.text, self.ends = text, ends
        self.accepted: set[bytes] = set()

    def lower(self, low: Fraction) -> str:
        """The statement that for all points of the box, the polynomial is at least `low`."""
        givens = [
            row
            for name, (first, last) in self.ends.items()
            for row in (f"given {first} <= {name}", f"given {name} <= {last}")
        ]
        return "\n".join(
            [
                f"statement {LOWER}",
                "forall " + " ".join(self.ends),
                *givens,
                f"show {self.text} >= {low}",
                "",
            ]
        )

    def attained(self, high: Fraction) -> str:
        """The statement that at some point of the box, the polynomial is at most `high`."""
        inside = " and ".join(
            f"{first} <= {name} and {name} <= {last}" for name, (first, last) in self.ends.items()
        )
        return "\n".join(
            [
                f"statement {ATTAINED}",
                "exists " + " ".join(self.ends),
                f"show {inside} and {self.text} <= {high}",
                "",
            ]
        )

    def _lower_certificate(self, node: Node) -> Certificate:
        corner = {name: str(first) for name, (first, _) in self.ends.items()}
        return {"certified": ("proof", [], node), "point": Point(LOWER, [], corner, ("close",))}

    def holds(self, low: Fraction, node: Node) -> bool:
        """Whether the checker accepts the bound from below with this proof."""
        return self._reason(self.lower(low), self._lower_certificate(node)) == ""

    def by_squares(self, low: Fraction) -> Node | None:
        """A proof of the bound from below by squares times the facts."""
        (statement,) = checker.read_statements(self.lower(low)).values()
        unfolding = checker.Unfolding(statement, checker.Context())
        state = state_of(unfolding).assume(unfolding.goal(False))
        budget = Budget(limits.SQUARES_WORK)
        try:
            facts = FactsOfState(state, Ring(tuple(state.context.index)), whole=True)
            return search_squares(programs_of_facts(facts, budget, limits.STAGES), budget)
        except Exhausted:
            return None

    def _reason(self, text: str, certificate: Certificate) -> str:
        key = text.encode() + canonical(certificate)
        if key in self.accepted:
            return ""
        (statement,) = checker.read_statements(text).values()
        outcome, reason = checker.check_one(statement, json.loads(canonical(certificate)), {}, {})
        if outcome == "certified":
            self.accepted.add(key)
            return ""
        return str(reason or outcome)

    def enclosure(self, bounds: Bounds, used: list[int]) -> Enclosure:
        """The enclosure, after the checker has certified both statements; raises ArithmeticError
        where it rejects one.
        """
        point = {name: first for name, (first, _) in self.ends.items()} | dict(
            zip((list(self.ends)[k] for k in used), bounds.point)
        )
        values = {name: str(value) for name, value in point.items()}
        certificates: dict[str, Certificate] = {
            LOWER: self._lower_certificate(bounds.node),
            ATTAINED: {
                "certified": ("witness", [], Point(ATTAINED, [], values, ("close",))),
                "point": Point(ATTAINED, [], {}, ("close",)),
            },
        }
        texts = {LOWER: self.lower(bounds.low), ATTAINED: self.attained(bounds.high)}
        for name, text in texts.items():
            reason = self._reason(text, certificates[name])
            if reason:
                raise ArithmeticError(f"the checker rejects {name}: {reason}")
        return Enclosure(
            bounds.low,
            bounds.high,
            point,
            bounds.boxes,
            bounds.reached,
            "\n".join(texts.values()),
            certificates,
        )


def _exact(value: object, name: str) -> Fraction:
    if isinstance(value, bool) or not isinstance(value, (int, Fraction)):
        raise ClaimError(
            f"{name} = {value!r} is not exact; write it as an int or as Fraction(p, q)"
        )
    return Fraction(value)


def _ends(box: Box) -> Ends:
    if not box:
        raise ClaimError("the box has no variables; give each of them as name=low..high")
    ends = {}
    for name, pair in box.items():
        real(name)  # raises ClaimError where it is not a name
        if len(pair) != 2:
            raise ClaimError(f"{name} has {len(pair)} bounds; give low and high")
        low, high = (_exact(value, name) for value in pair)
        if low > high:
            raise ClaimError(
                f"the box is empty: {name} from {low} to {high}; put the lower bound first"
            )
        ends[name] = (low, high)
    if len(ends) > checker.MAX_VARIABLES:
        raise ClaimError(
            f"the box has {len(ends)} variables; at most {checker.MAX_VARIABLES} can be declared"
        )
    return ends


def _terms(text: str, names: list[str]) -> Terms:
    """The polynomial as the checker reads it, {exponents: coefficient}."""
    context = checker.Context(work=checker.Work(checker.MAX_WORK // 4))
    try:
        for name in names:
            context.declare(name)
        poly = context.polynomial(text)
    except checker.Rejected as reason:
        raise ClaimError(
            f"not a polynomial in {', '.join(names)}: {str(reason)[:200]}; write it as x^2 -"
            " 3/2*x*y"
        ) from None
    terms = monomials(poly, len(names))
    return {exponents: Fraction(c, poly.den) for exponents, c in terms.items()}


def _refuse_large(terms: Terms, ends: Ends, used: Sequence[int]) -> None:
    """Raises ClaimError, one line that states the limit, for a polynomial or box that is too large
    for the search or the checker.
    """
    degrees = [max(exponents[k] for exponents in terms) for k in used]
    if max(degrees, default=0) > limits.MOST_DEGREE:
        raise ClaimError(
            f"degree {max(degrees)} in one variable; at most {limits.MOST_DEGREE} can be searched"
        )
    coefficients, total = prod(n + 1 for n in degrees), sum(n + 1 for n in degrees)
    if coefficients * total > limits.MOST_PRODUCTS:
        raise ClaimError(
            f"degree + 1 of the {len(used)} variables has the product {coefficients} and the sum"
            f" {total}; product times sum may be at most {limits.MOST_PRODUCTS}: fewer"
            " variables, or lower degrees, can be searched"
        )
    sizes = [max(abs(low), abs(high), Fraction(1)) for low, high in ends.values()]
    if any(
        abs(c) * prod(size**e for size, e in zip(sizes, exponents)) > limits.MOST_VALUE
        for exponents, c in terms.items()
    ):
        raise ClaimError(
            f"a term of the polynomial exceeds 10^{len(str(limits.MOST_VALUE)) - 1} on the box;"
            " choose other units for the variables"
        )


def _readable(text: str) -> str:
    """The text in the checker's notation: ^ for powers, and 0.1 for exactly 1/10."""
    text = " ".join(text.replace("**", "^").split())
    return re.sub(
        r"(?<![\w.])(\d+\.\d*|\.\d+)(?![\w.])", lambda decimal: f"({Fraction(decimal[0])})", text
    )
