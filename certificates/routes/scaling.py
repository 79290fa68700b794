"""Units: which positive variables may be set to 1, because every fact is homogeneous in some
grading of the variables.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from certificates.routes.polynomials import Atom, Formula, atom, atoms, map_atoms
from certificates.routes.questions import Denial, Question, flat


def fixed_by_units(question: Question) -> tuple[str, ...]:
    """The variables that may be set to 1 without loss.

    Formula: if every fact is homogeneous for the weights W_i of a grading, then x_i -> t^(W_i) x_i
    keeps all signs for every t > 0. Positive variables whose columns of W are independent can so be
    brought to 1 together, whatever the others are. Source: the quotient of the positive torus by
    its action on the solutions (dimensional analysis).
    """
    positive = [
        next(iter(f.poly.used))
        for f in question.assumed
        if isinstance(f, Atom) and f.relation == ">" and _is_variable(f)
    ]
    free = [
        i
        for i in dict.fromkeys(positive)
        if question.names[i] not in question.bound | question.integers
    ]
    if not free:
        return ()
    chosen: list[int] = []
    basis = _gradings(question)
    for i in sorted(free):
        if _rank([[row[j] for j in [*chosen, i]] for row in basis]) == len(chosen) + 1:
            chosen.append(i)
    return tuple(question.names[i] for i in sorted(chosen))


def at_unit_values(question: Question, names: tuple[str, ...]) -> Question:
    """The question with 1 in place of the named variables."""
    places = [question.names.index(name) for name in names]

    def change(fact: Atom) -> Formula:
        poly = fact.poly
        for i in places:
            poly = poly.with_value(i, Fraction(1))
        return atom(poly, fact.relation)

    assumed = flat([map_atoms(formula, change) for formula in question.assumed])
    return replace(
        question,
        assumed=assumed,
        denials=tuple(Denial(d.bound, map_atoms(d.formula, change)) for d in question.denials),
    )


def _is_variable(fact: Atom) -> bool:
    (exponents, c), *rest = fact.poly.terms
    return not rest and c > 0 and sum(exponents) == 1


def _gradings(question: Question) -> list[list[Fraction]]:
    """A basis of the weights for which every polynomial of the question is homogeneous: the null
    space of all differences of exponents.

    Integers have weight 0: they keep their values.
    """
    differences: dict[tuple[int, ...], None] = {}
    for formula in (*question.assumed, *(denial.formula for denial in question.denials)):
        for fact in atoms(formula):
            first = fact.poly.terms[0][0]
            differences.update(
                dict.fromkeys(
                    tuple(a - b for a, b in zip(e, first)) for e, _ in fact.poly.terms[1:]
                )
            )
    loose, width = [], len(question.names)
    whole = [
        [Fraction(int(i == j)) for j in range(width)]
        for i, name in enumerate(question.names)
        if name in question.integers
    ]
    rows, pivots = _reduced([*whole, *([Fraction(x) for x in row] for row in differences)])
    for free in (i for i in range(width) if i not in pivots):
        vector = [Fraction(int(i == free)) for i in range(width)]
        for row, pivot in zip(rows, pivots):
            vector[pivot] = -row[free]
        loose.append(vector)
    return loose


def _reduced(rows: list[list[Fraction]]) -> tuple[list[list[Fraction]], list[int]]:
    """The nonzero rows of the reduced echelon form, and the columns of their leading ones."""
    kept: list[list[Fraction]] = []
    pivots: list[int] = []
    for row in rows:
        for done, pivot in zip(kept, pivots):
            if row[pivot]:
                row = [a - row[pivot] * b for a, b in zip(row, done)]
        lead = next((i for i, a in enumerate(row) if a), None)
        if lead is None:
            continue
        row = [a / row[lead] for a in row]
        kept = [[a - done[lead] * b for a, b in zip(done, row)] for done in kept]
        kept.append(row)
        pivots.append(lead)
    return kept, pivots


def _rank(rows: list[list[Fraction]]) -> int:
    return len(_reduced([list(row) for row in rows])[1])
