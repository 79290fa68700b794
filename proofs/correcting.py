"""A refuted print mended."""

from __future__ import annotations

import operator
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from juggleproof.certificates import checker
from juggleproof.certificates.language import (
    AnyStatement,
    ClaimError,
    Formula,
    SharpRange,
    Term,
    conjunction,
    equal,
    names_in,
    term,
)
from juggleproof.proofs.claims import Body, Claim, as_body, assertions, named_statements
from juggleproof.proofs.forms import read
from juggleproof.proofs.reading.edits import one_mark_changes
from juggleproof.proofs.reading.evaluation import Environment
from juggleproof.proofs.reading.meaning import Printed

# -------------------------------------------------------------------------------------------------
# Corrections of a print that is refuted: one mark changed, rational coefficients on the printed
# terms, the derived form.
#
# Nothing here is believed: a candidate is a print (or a right-hand side) that the same claim
# function
# reads and the checker then judges.

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

    def __init__(self, printed: Printed, right: Any) -> None:
        super().__init__(printed.latex)
        self._right = right

    def relation_chain(self, environment: Environment) -> list[tuple[Any, str, Any]]:
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
            coefficients_on_printed_terms(right, truth)
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
            if hasattr(truth, "entries")
            else str(truth)
        )
        yield Candidate("derived", "the derived form", shown, Amended(claim.read_print(), truth))


def _printed_right(claim: Claim) -> Any:
    """The printed right-hand side in the paper's names, where those suffice to read it."""
    from juggleproof.proofs.paper.names import PAPER

    try:
        return claim.read_print().right(PAPER)
    except ClaimError:
        return None


def coefficients_on_printed_terms(printed: Term, truth: Term) -> Term | None:
    """The printed sum with other rational coefficients on its terms that equals the truth; None
    where there is none.

    >>> from juggleproof.certificates.language import reals
    >>> x, y = reals("x y")
    >>> str(coefficients_on_printed_terms((x + y) * 2, x * 2 + y))
    '(x + y*(1/2))*2'
    """
    found = _sum_inside(printed)
    if found is None:
        return None
    terms, rebuild = found
    names = sorted(names_in(printed) | names_in(truth))
    rows = []
    for seed in range(len(terms) + 4):
        point = {
            name: Fraction(7 * (seed + 2) + 3 * i * (seed + 1), 11 + 5 * i + seed)
            for i, name in enumerate(names)
        }
        if "s" in point:  # the adjoined root of 2 + 2 alpha
            point["alpha"] = point["s"] ** 2 / 2 - 1
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


def _sum_inside(expression: Term) -> tuple[list[Term], Any] | None:
    """The first sum inside products and quotients, as its terms with their signs, and how to put
    another sum in its place.
    """
    if expression.op in ("+", "-"):
        return _terms_of(expression), _total
    if expression.op in ("*", "/"):
        left, right = expression.args
        found = _sum_inside(left)
        if found is not None:
            terms, rebuild = found
            return terms, lambda new: Term(expression.op, rebuild(new), right)
        if expression.op == "*":
            found = _sum_inside(right)
            if found is not None:
                terms, rebuild = found
                return terms, lambda new: Term("*", left, rebuild(new))
    return None


def _terms_of(expression: Term) -> list[Term]:
    if expression.op == "+":
        return _terms_of(expression.args[0]) + _terms_of(expression.args[1])
    if expression.op == "-":
        return _terms_of(expression.args[0]) + [-one for one in _terms_of(expression.args[1])]
    return [expression]


def _total(terms: Sequence[Term]) -> Term:
    total = terms[0]
    for one in terms[1:]:
        total = total - one.args[0] if one.op == "neg" else total + one
    return total


def _value(expression: Term, point: dict[str, Fraction]) -> Fraction:
    if expression.op == "var":
        return point[str(expression.args[0])]
    if expression.op == "num":
        return Fraction(expression.args[0])
    parts = [_value(part, point) if isinstance(part, Term) else part for part in expression.args]
    if expression.op == "neg":
        return -Fraction(parts[0])
    a, b = parts
    arithmetic = {
        "+": operator.add,
        "-": operator.sub,
        "*": operator.mul,
        "/": operator.truediv,
        "^": operator.pow,
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


# -------------------------------------------------------------------------------------------------
# Corrects a claim that is refuted: the first candidate print, or the true assertion nearby, whose
# statements are all certified.

if TYPE_CHECKING:
    from juggleproof.proofs.judging import Judge


def correct(judge: Judge) -> None:
    """Keeps the first correction that is certified; what an earlier run found is tried first, of
    whichever kind.
    """
    claim, found = judge.claim, judge.found
    remembered = (judge.options.findings.get(claim.id) or {}).get("correction")
    if remembered and remembered["kind"] == "nearby" and _nearby_is_certified(judge):
        return
    first = (remembered["kind"], remembered["text"]) if remembered else None
    for candidate in candidates(claim, first) if claim.printed else ():
        if _certifies(judge, candidate):
            found.correction = {
                "kind": candidate.kind,
                "change": candidate.change,
                "text": candidate.text,
                "possible transcription error": candidate.possible_transcription_error,
            }
            return
    if not (remembered and remembered["kind"] == "nearby"):
        _nearby_is_certified(judge)


def _nearby_is_certified(judge: Judge) -> bool:
    """Whether the claim names a true assertion nearby that is certified; if so it is the
    correction.
    """
    if judge.claim.true_nearby is None:
        return False
    text, state = judge.claim.true_nearby
    if not _certifies_body(judge, as_body(state(), judge.claim.id)):
        return False
    judge.found.correction = {
        "kind": "nearby",
        "change": "a true assertion nearby",
        "text": text,
        "possible transcription error": False,
    }
    return True


def _certifies(judge: Judge, candidate: Candidate) -> bool:
    """Whether the claim, read with this print, is certified; if so its statements are kept as
    ID/corrected...
    """
    try:
        return _certifies_body(judge, judge.claim.body(candidate.printed))
    except (ClaimError, checker.Rejected):
        return False


def _certifies_body(judge: Judge, body: Body) -> bool:
    """Whether every statement of a corrected body is certified; if so they are kept."""
    try:
        statements = [
            _renamed(part, f"{judge.claim.id}/corrected.{part.name.split('/')[1]}")
            for prefix, assertion in assertions(body)
            for part in named_statements("x", prefix, assertion)
        ]
        if not all(_is_stored_certified(judge, part) for part in statements) and any(
            judge.is_refuted_by_sampling(read(part.text(), part.name)) for part in statements
        ):
            return False
    except (ClaimError, checker.Rejected):
        return False
    trial = judge.trial()
    try:
        for part in statements:
            if trial.settle(part) != "certified":
                return False
    except (
        ClaimError
    ):  # a candidate that contradicts itself, or divides by what may vanish, corrects nothing
        return False
    found, tried = judge.found, trial.found
    found.statements += tried.statements
    found.certificates.update(tried.certificates)
    found.outcomes.update(tried.outcomes)
    for name, text in tried.statements:
        found.votes[name] = judge.votes(name, text, tried.outcomes[name])
    found.reused += tried.reused
    return True


def _is_stored_certified(judge: Judge, statement: AnyStatement) -> bool:
    """Whether the store holds this very statement, and the checker accepted its proof there: no
    point can then refute it.
    """
    store, name = judge.options.store, statement.name
    return (
        store is not None
        and store.texts.get(name) == statement.text()
        and judge.options.checked.get(name) == "certified"
    )


def _renamed(statement: AnyStatement, name: str) -> AnyStatement:
    if isinstance(statement, SharpRange):
        raise ClaimError("a sharp range cannot be renamed")
    return replace(statement, name=name)
