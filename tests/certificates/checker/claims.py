"""What an accepted certificate claims, tested at sample points by the second reading:
`contradiction` names a point where it is false.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from fractions import Fraction

from tests.certificates.checker.evaluator import Point, formula_at, holds_at, term_at
from tests.certificates.checker.harness import Json

SAMPLES = [
    Fraction(n, d)
    for n, d in (
        (0, 1),
        (1, 1),
        (-1, 1),
        (2, 1),
        (1, 2),
        (-3, 2),
        (9, 4),
        (1, 8),
        (16, 1),
        (-5, 1),
        (10, 1),
        (4, 1),
    )
]


def said(rows: list[str], keyword: str) -> list[str]:
    """What follows a keyword, for every line that begins with it."""
    return [row.partition(" ")[2] for row in rows if row.partition(" ")[0] == keyword]


def points(names: list[str], integers: list[str]) -> Iterator[dict[str, Fraction]]:
    """Sample points: all pairs of samples on two variables, a diagonal beyond."""
    first = SAMPLES if len(names) < 3 else SAMPLES[:6]
    for values in itertools.islice(itertools.product(first, repeat=len(names)), 300):
        if all(
            value.denominator == 1 or name not in integers for name, value in zip(names, values)
        ):
            yield dict(zip(names, values))


def terms_found(found: Json, point: Point) -> dict[str, str] | None:
    """The terms that a witness gives at a point; None where it says that there is no such point."""
    if found[0] == "sign":
        value = term_at(found[1], point)
        return terms_found(found[2 + (value >= 0) + (value > 0)], point)
    return None if found[0] == "empty" else dict(found[2])


def contradiction(text: str, outcome: str, certificate: Json, earlier: dict[str, str]) -> object:
    """A point at which the outcome is wrong; None where none of the samples is one."""
    rows = text.strip().splitlines()[1:]
    if outcome == "refuted":
        return _refutation(rows, certificate["refuted"])
    if said(rows, "sharp"):
        return _sharp(rows, certificate["certified"], earlier)
    if said(rows, "iterates"):
        return _iterates(rows)
    return _certified(rows, certificate["certified"])


def _certified(rows: list[str], certificate: Json) -> object:
    names, integers = (
        " ".join(said(rows, "forall")).split(),
        " ".join(said(rows, "integer")).split(),
    )
    universal = [row for row in rows if row.partition(" ")[0] not in ("with", "show")]
    for point in points(names, integers):
        values: dict[str, Fraction] = dict(point)
        if certificate[0] == "witness":
            if holds_at(universal, point) is not True:
                continue
            terms = terms_found(certificate[2], point)
            if terms is None:
                return point
            values |= {name: term_at(term, point) for name, term in terms.items()}
        if holds_at(rows, values) is False:
            return values
    return None


def _refutation(rows: list[str], found: Json) -> object:
    names = " ".join(said(rows, "forall")).split()
    if found[0] in ("sign", "empty") or found[1]:
        return None  # adjoined numbers are irrational: nothing to evaluate
    values = {name: term_at(found[2][name], {}) for name in names}
    if not said(rows, "exists"):
        return None if holds_at(rows, values) is False else values
    existing = " ".join(said(rows, "exists")).split()
    for point in points(existing, " ".join(said(rows, "integer")).split()):
        if holds_at(rows, values | point) is not False:
            return values | point
    return None


def _sharp(rows: list[str], certificate: Json, earlier: dict[str, str]) -> object:
    (domain,), (condition,), names = (
        said(rows, "domain"),
        said(rows, "holds"),
        " ".join(said(rows, "over")).split(),
    )
    inner = [
        row
        for row in earlier[said(rows, "sharp")[0]].strip().splitlines()[1:]
        if not row.startswith("range ")
    ]
    others = [name for name in " ".join(said(inner, "forall")).split() if name not in names]
    for parameters in points(names, []):
        if not formula_at(domain, parameters):
            continue
        if formula_at(condition, parameters):
            for point in points(others, []):
                if holds_at(inner, parameters | point) is False:
                    return parameters | point
        else:
            terms = terms_found(certificate[1], parameters)
            if (
                terms is None
                or holds_at(
                    inner, parameters | {n: term_at(t, parameters) for n, t in terms.items()}
                )
                is not False
            ):
                return parameters
    return None


def _iterates(rows: list[str]) -> object:
    def images(row: str) -> list[str]:
        return [
            part
            for part in re.split(
                r",(?![^(]*\))", re.sub(r"^\((.*?),?\)$", r"\1", row.partition(" -> ")[2])
            )
            if part.strip()
        ]

    (map_row,), (power_row,) = said(rows, "iterates"), said(rows, "after")
    names, count = " ".join(said(rows, "forall")).split(), said(rows, "integer")[0]
    state = re.sub(r"[(),]", " ", map_row.partition(" -> ")[0]).split()
    for point in itertools.islice(points([n for n in names if n != count], []), 60):
        now = dict(point)
        for steps in range(4):
            if [
                _lets(rows, power, point | {count: Fraction(steps)}) for power in images(power_row)
            ] != [now[name] for name in state]:
                return point | {count: Fraction(steps)}
            now |= dict(zip(state, [_lets(rows, image, now) for image in images(map_row)]))
    return None


def _lets(rows: list[str], term: str, point: Point) -> Fraction:
    values = dict(point)
    for row in said(rows, "let"):
        name, _, value = row.partition(" = ")
        values[name] = term_at(value, values)
    return term_at(term, values)
