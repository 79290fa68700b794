"""The figures of a report: those that need no claims as they are, and those that show ranges and
the trap with what they show.
"""

from __future__ import annotations

from base64 import b64decode, b64encode
from collections.abc import Callable, Collection, Iterable
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from sympy import Expr, Rational, Symbol

from juggleproof.certificates.language import ClaimError, Formula, Term
from juggleproof.proofs import kept as cache
from juggleproof.proofs.extras import needed
from juggleproof.proofs.reports.contents import Contents, gather
from juggleproof.proofs.reports.contents import Entry as Judged
from juggleproof.proofs.reports.results import NO_RANGE
from juggleproof.proofs.reports.words import read
from juggleproof.proofs.restitution.settling import RANGES
from juggleproof.proofs.restitution.unequal import FLIGHTS
from juggleproof.proofs.theorem.definition import TO_THE_POINT, TRAP
from juggleproof.scenes.figures import TABLE, Entry

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from juggleproof.scenes.figures.ours import Row

FORMS = ("svg", "pdf")
Range = tuple[Fraction, Fraction]
Flights = tuple[int, ...]


class Saved(NamedTuple):
    """A figure as a file, with what stands beside it."""

    slug: str
    title: str
    caption: str
    alt: str
    data: bytes


# what these show are verdicts and ranges, which are never read from a cache
OF_VERDICTS = ("fig-attractors", "fig-ranges")


def figures(
    contents: Contents | None = None, leaving_out: Collection[str] = ()
) -> list[tuple[str, str, str, str, Figure]]:
    """Every figure in order but those left out: slug, title, caption, alternative text and the
    figure; raises ClaimError where matplotlib is absent.
    """
    needed("matplotlib")
    entries = (contents or gather()).entries
    given: dict[str, Callable[[], tuple[object, ...]]] = {
        "fig-ranges": lambda: (rows(entries), without_alpha(entries)),
        "fig-trap": what_the_trap_shows,
        "fig-attractors": lambda: what_attracts(entries),
    }
    drawn = (one for one in TABLE if one.slug not in leaving_out)
    return [(*labels(one), one.draw(*given.get(one.slug, tuple)())) for one in drawn]


def rows(entries: Iterable[Judged]) -> list[Row]:
    """A row for each range of each claim that speaks of alpha; entries as `contents` gathers
    them.
    """
    return [
        (f"{entry.claim.id} ({label})" if label else entry.claim.id, entry.verdict, intervals)
        for entry in entries
        if entry.sharp != NO_RANGE
        for label, intervals in read(entry.sharp)
    ]


def without_alpha(entries: Iterable[Judged]) -> int:
    """The number of claims in which alpha does not occur."""
    return sum(entry.sharp == NO_RANGE for entry in entries)


def labels(one: Entry) -> tuple[str, str, str, str]:
    """Slug, title, caption and alternative text of a figure."""
    return (
        one.slug,
        f"Figure {one.number}. {one.title}" if one.number else one.title,
        one.caption,
        one.alt,
    )


def saved(contents: Contents | None = None, form: str = "svg") -> list[Saved]:
    """Every figure in order as a file of this form (svg or pdf); kept beside the records of runs,
    so that unchanged ones need not be drawn again.

    Raises ClaimError where they must be drawn and matplotlib is absent, or for another form.
    """
    if form not in FORMS:
        raise ClaimError(f"{form!r} is no form of figures; choose from {', '.join(FORMS)}")
    contents = contents or gather()
    of_sources = cache.key(cache.version_of("matplotlib"), packages=(*cache.SOURCES, "scenes"))
    key = f"figures-{form}-{of_sources}" if cache.folder() else ""
    kept = _kept(cache.load(key)) if key else {}
    lasting = {one.slug for one in TABLE} - {*OF_VERDICTS}
    there = kept.keys() if kept.keys() == lasting else ()
    made = {slug: _file(figure, slug, form) for slug, *_, figure in figures(contents, there)}
    if key and not there:
        encoded = ((slug, b64encode(made[slug]).decode("ascii")) for slug in sorted(lasting))
        cache.keep(key, [{"slug": slug, "data": data} for slug, data in encoded])
    return [Saved(*labels(one), {**kept, **made}[one.slug]) for one in TABLE]


def _kept(records: list[dict[str, str]]) -> dict[str, bytes]:
    try:
        return {record["slug"]: b64decode(record["data"], validate=True) for record in records}
    except (KeyError, TypeError, ValueError):
        return {}


def _file(figure: Figure, slug: str, form: str) -> bytes:
    from juggleproof.scenes.figures import drawing

    return drawing.svg(figure, slug) if form == "svg" else drawing.pdf(figure)


SETTLED = ("theorem", "theorem-one-third", "restitution-to-a-half", "restitution-half", *RANGES)


def what_attracts(entries: Iterable[Judged]) -> tuple[list[Range], Flights, Range]:
    """The ranges of the claims by which every orbit tends to some e_K; and the flights of another
    orbit, and where it attracts. Raises ClaimError where one of them fails.
    """
    sharp = {entry.claim.id: entry.sharp for entry in entries if entry.verdict == "holds"}

    def span(claim_id: str) -> Range:
        found = read(sharp.get(claim_id, NO_RANGE).removeprefix("at least "))[0][1]
        if not found:
            raise ClaimError(f"{claim_id} holds on no range that can be drawn")
        return found[0][0], found[-1][1]

    return [span(claim_id) for claim_id in SETTLED], FLIGHTS, span("restitution-unequal-room")


def what_the_trap_shows() -> tuple[Expr, tuple[Expr, Expr], list[tuple[Expr, bool]]]:
    """The rank, the root that it is written with and its square, and the margins of the trap, as
    the theorem's definition has them.
    """
    ((root, square),) = TO_THE_POINT.roots
    parts = TRAP.parts if TRAP.op == "and" else (TRAP,)
    return (
        to_sympy(TO_THE_POINT.rank),
        (to_sympy(Term("var", root)), to_sympy(square)),
        [margin(part) for part in parts],
    )


def margin(relation: Formula) -> tuple[Expr, bool]:
    """What is positive where a strict relation holds, or not negative where one that is not strict
    does; and whether it is strict.  Raises ClaimError for what is no inequality.
    """
    less, more = relation.sides if relation.op in ("<", "<=") else reversed(relation.sides)
    if relation.op not in ("<", "<=", ">", ">="):
        raise ClaimError(f"{relation} has no margin; it is no inequality")
    return to_sympy(more) - to_sympy(less), relation.op in ("<", ">")


def to_sympy(expression: Term) -> Expr:
    """The SymPy expression of a term.

    >>> from juggleproof.certificates.language import reals
    >>> x, w = reals("x w")
    >>> to_sympy((x - w) / 2 + 3 * x**2)
    -w/2 + 3*x**2 + x/2
    """
    if expression.op == "var":
        return Symbol(expression.name)
    if expression.op == "num":
        return Rational(expression.value.numerator, expression.value.denominator)
    if expression.op == "neg":
        return -to_sympy(expression.operands[0])
    if expression.op == "^":
        return to_sympy(expression.operands[0]) ** expression.exponent
    left, right = (to_sympy(part) for part in expression.operands)
    return {
        "+": lambda: left + right,
        "-": lambda: left - right,
        "*": lambda: left * right,
        "/": lambda: left / right,
    }[expression.op]()
