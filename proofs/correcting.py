"""Prints and right-hand sides that may mend a print that is refuted."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from juggleproof.certificates.language import (
    ClaimError,
    Formula,
    Term,
    conjunction,
    equal,
    names_in,
    term,
)
from juggleproof.proofs.claims import Claim
from juggleproof.proofs.reading.edits import one_mark_changes
from juggleproof.proofs.reading.evaluation import Environment
from juggleproof.proofs.reading.meaning import Printed
from juggleproof.proofs.reading.values import Value, Vector

# -------------------------------------------------------------------------------------------------
# Corrections of a print that is refuted: one mark changed, rational coefficients on the printed
# terms, the derived form.
#
# Nothing here is believed: a candidate is a print (or a right-hand side) that the same claim
# function reads and the checker then judges.

DERIVED = ("coefficients", "derived")
LOST_MARKS = ("dot", "bar", "prime", "sign", "exponent", "half")


@dataclass(frozen=True)
class Candidate:
    """A corrected print: its kind, what was changed, the LaTeX or the text of the corrected right
    side, and what the claim reads.
    """

    kind: str
    change: str
    text: str
    printed: Printed

    @property
    def possible_transcription_error(self) -> bool:
        """One lost mark mends the print, so the fault may be the transcription's and not the
        authors'.
        """
        return self.kind in LOST_MARKS


class Amended(Printed):
    """A print whose last side is replaced by a term."""

    __slots__ = ("_right",)

    def __init__(self, printed: Printed, right: Value) -> None:
        super().__init__(printed.latex)
        self._right = right

    def relation_chain(self, environment: Environment) -> list[tuple[Value, str, Value]]:
        """The printed chain with the amended value at its end."""
        chain = super().relation_chain(environment)
        left, relation, _ = chain[-1]
        return [*chain[:-1], (left, relation, self._right)]

    def formula(self, environment: Environment) -> Formula:
        """The relations of the amended chain."""
        parts = []
        for left, relation, right in self.relation_chain(environment):
            if relation not in ("=", ":="):
                raise ClaimError("only an equation can be amended on its right")
            pairs = zip(
                getattr(left, "entries", (left,)), getattr(right, "entries", (right,)), strict=True
            )
            parts += [equal(term(a), term(b)) for a, b in pairs]
        return conjunction(parts)


def candidates(claim: Claim, first: tuple[str, str] | None = None) -> Iterator[Candidate]:
    """Corrections to try, in order: one mark, then the derived form (after coefficients on the
    printed terms).

    `first` is the kind and text of one to try before all others.
    """
    if first is not None:
        ways = (_derived,) if first[0] in DERIVED else (_one_mark,)
        yield from (one for way in ways for one in way(claim) if (one.kind, one.text) == first)
    yield from (
        one for way in (_one_mark, _derived) for one in way(claim) if (one.kind, one.text) != first
    )


def _one_mark(claim: Claim) -> Iterator[Candidate]:
    for change, latex in one_mark_changes(claim.printed):
        yield Candidate(change.split(":")[0], change, latex, Printed(latex))


def _derived(claim: Claim) -> Iterator[Candidate]:
    if claim.derived is not None:
        truth = claim.derived()
        right = _printed_right(claim)
        fitted = (
            coefficients_on_printed_terms(right, truth, claim.vocabulary.roots)
            if isinstance(right, Term) and isinstance(truth, Term)
            else None
        )
        if fitted is not None:
            yield Candidate(
                "coefficients",
                "rational coefficients on the printed terms",
                str(fitted),
                Amended(claim.read_print(), fitted),
            )
        shown = (
            ", ".join(str(term(e)) for e in truth.entries)
            if isinstance(truth, Vector)
            else str(truth)
        )
        yield Candidate("derived", "the derived form", shown, Amended(claim.read_print(), truth))


def _printed_right(claim: Claim) -> Value | None:
    """The printed right-hand side in the names of the claim's vocabulary, where those suffice to
    read it.
    """
    if claim.vocabulary.reads is None:
        return None
    try:
        right: Value = claim.read_print().right(claim.vocabulary.reads())
        return right
    except ClaimError:
        return None


def coefficients_on_printed_terms(
    printed: Term, truth: Term, roots: Mapping[str, Term] | None = None
) -> Term | None:
    """The printed sum with other rational coefficients on its terms that equals the truth; None
    where there is none.  `roots` are names for square roots of terms, each linear in one variable.

    >>> from juggleproof.certificates.language import reals
    >>> x, y = reals("x y")
    >>> str(coefficients_on_printed_terms((x + y) * 2, x * 2 + y))
    '(x + y*(1/2))*2'
    """
    split = _sum_inside(printed)
    if split is None:
        return None
    terms, rebuild = split
    names = sorted(names_in(printed) | names_in(truth))
    rows = []
    for seed in range(len(terms) + 4):
        point = {
            name: Fraction(7 * (seed + 2) + 3 * i * (seed + 1), 11 + 5 * i + seed)
            for i, name in enumerate(names)
        }
        for name, under in (roots or {}).items():
            variables = names_in(under)
            if name in point and len(variables) == 1:  # its square has to be what is under the root
                (variable,) = variables
                constant, one = (_value(under, {variable: Fraction(k)}) for k in (0, 1))
                point[variable] = (point[name] ** 2 - constant) / (one - constant)
        try:
            row = [_value(rebuild([one]), point) for one in terms]
            rows.append([*row, _value(truth, point)])
        except ZeroDivisionError:
            continue
    solution = _solve(rows, len(terms))
    if solution is None:
        return None
    fitted: Term = rebuild([one if c == 1 else one * c for one, c in zip(terms, solution) if c])
    return fitted


def _sum_inside(expression: Term) -> tuple[list[Term], Callable[[Sequence[Term]], Term]] | None:
    """The first sum inside products and quotients, as its terms with their signs, and how to put
    another sum in its place.
    """
    if expression.op in ("+", "-"):
        return _terms_of(expression), _total
    if expression.op in ("*", "/"):
        left, right = expression.operands
        inner = _sum_inside(left)
        if inner is not None:
            terms, rebuild = inner
            return terms, lambda new: Term(expression.op, rebuild(new), right)
        if expression.op == "*":
            inner = _sum_inside(right)
            if inner is not None:
                terms, rebuild = inner
                return terms, lambda new: Term("*", left, rebuild(new))
    return None


def _terms_of(expression: Term) -> list[Term]:
    if expression.op == "+":
        left, right = expression.operands
        return _terms_of(left) + _terms_of(right)
    if expression.op == "-":
        left, right = expression.operands
        return _terms_of(left) + [-one for one in _terms_of(right)]
    return [expression]


def _total(terms: Sequence[Term]) -> Term:
    total = terms[0]
    for one in terms[1:]:
        total = total - one.operands[0] if one.op == "neg" else total + one
    return total


def _value(expression: Term, point: dict[str, Fraction]) -> Fraction:
    if expression.op == "var":
        return point[expression.name]
    if expression.op == "num":
        return expression.value
    parts = [_value(part, point) for part in expression.operands]
    if expression.op == "neg":
        return -parts[0]
    if expression.op == "^":
        return parts[0] ** expression.exponent
    a, b = parts
    arithmetic = {
        "+": operator.add,
        "-": operator.sub,
        "*": operator.mul,
        "/": operator.truediv,
    }
    return Fraction(arithmetic[expression.op](a, b))


def _solve(rows: list[list[Fraction]], unknowns: int) -> list[Fraction] | None:
    """The only solution of an overdetermined linear system, or None."""
    rows = [list(row) for row in rows]
    for column in range(unknowns):
        pivot = next((i for i in range(column, len(rows)) if rows[i][column]), None)
        if pivot is None:
            return None
        rows[column], rows[pivot] = rows[pivot], rows[column]
        rows[column] = [value / rows[column][column] for value in rows[column]]
        for i, row in enumerate(rows):
            if i != column and row[column]:
                rows[i] = [a - row[column] * b for a, b in zip(row, rows[column])]
    if any(any(row) for row in rows[unknowns:]):
        return None
    return [row[unknowns] for row in rows[:unknowns]]
