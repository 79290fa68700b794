"""One verdict and one sentence on the map that is given.  They are made from the certified
statements: their rules, domains, points, sets and roots, and nothing that the search meant to show.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

import sympy

from juggleproof.certificates import checker
from juggleproof.judging import conclusions
from juggleproof.judging.conclusions import ATTRACT, ATTRACTS, STABLE, RuleLines, terms_of
from juggleproof.map_stability.certifying import beyond, is_certified
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.samples import divides
from juggleproof.map_stability.terms import conjuncts, expression, renamed, written
from juggleproof.statements.cases import ANYWHERE, conjunction
from juggleproof.statements.definitions import formula_of
from juggleproof.statements.language import MapRule, bounds_of, interval_text

OF_SETS = {"lyapunov", "contracts"}  # kinds of statements: a point attracts a set
OF_SPACES = {"attracts", "into"}  # it attracts the whole space
OF_FAILURES = {"escapes", "unstable"}  # it does not, or is not stable
NO_FIXED_POINT = "no state of the space is a fixed point"


class MapVerdict(StrEnum):
    """What is certified on whether some point is stable and attracts every state.  PROVED and
    REFUTED are about the whole domain and space that are given; IN_PART is about less, which the
    sentence says.
    """

    PROVED = conclusions.PROVED
    REFUTED = conclusions.REFUTED
    IN_PART = "in part"
    UNKNOWN = "unknown"

    @property
    def exit_code(self) -> int:
        """The exit code of a command."""
        return {MapVerdict.PROVED: 0, MapVerdict.IN_PART: 3}.get(self, 1)


@dataclass(frozen=True)
class MapFinding:
    """A verdict with its sentence, and what they are about.

    point: the point; condition: the parameters of the given domain for which it attracts, or an
    empty text for all; attracted: the set that it attracts, or an empty text for the whole space.
    """

    verdict: MapVerdict
    sentence: str
    point: str = ""
    condition: str = ""
    attracted: str = ""


@dataclass(frozen=True)
class ParameterMeaning:
    """A sentence on a parameter that replaced another one: it says how they are related.
    `certified`: whether every value of the given parameters is certified to have a value of it.
    """

    sentence: str
    certified: bool


@dataclass(frozen=True)
class PointFact:
    """A certified statement about a point of the given map."""

    kind: str
    lines: RuleLines
    given: Map

    @property
    def rule(self) -> RuleLines:
        """The statement that has the domain and names the map."""
        return self.lines.named("descent") if self.kind in OF_SPACES else self.lines

    @property
    def domain(self) -> str:
        """The condition on the parameters under which the statement holds."""
        return self.rule.one("domain")

    @cached_property
    def condition(self) -> str:
        """The conditions of the domain beyond the domain that is given."""
        return beyond(self.given.domain, self.domain, self.given.parameters)

    @cached_property
    def point(self) -> str:
        """The point, with its roots written out."""
        return named(self.lines.around(), "point")

    @cached_property
    def attracted(self) -> str:
        """The set that the point attracts; empty where it is the whole space."""
        on = self.lines.one("on") if self.kind in OF_SETS else ANYWHERE
        over = " ".join((*self.given.parameters, *self.given.state))
        inside = conjunction(self.domain, self.given.space)
        lines = [f"forall {over}", f"given {inside}", f"show {on}"]
        return "" if on in (ANYWHERE, self.given.space) or is_certified(lines) else on

    def sentence(self) -> str:
        """Return the sentence that the point attracts the set, with the distances to the point
        written out.
        """
        terms = map(self.lines.without_roots, terms_of(self.lines.one("point")))
        ends = dict(zip(self.given.state, map(in_brackets, terms)))
        gaps = {name: name if e == "0" else f"{name} - {e}" for name, e in ends.items()}
        on = with_bars(self.attracted)
        for name, gap in gaps.items():
            on = on.replace(f"|{name}_gap|", f"|{gap}|")
        names = {f"{name}_gap": in_brackets(gap) for name, gap in gaps.items()}
        on = renamed(on, names | {f"{name}_point": e for name, e in ends.items()})
        says = f"{self.point} is {STABLE}, and {ATTRACTS} every state with"
        return f"{begun(self.condition)}{says} {self.lines.without_roots(on)}"

    def failure(self) -> str:
        """Return how the point fails."""
        if self.kind == "unstable":
            return f"is not {STABLE}"
        what = "periodic" if " " in self.lines.one("word") else "a fixed point"
        return f"does not {ATTRACT} {named(self.lines, 'start')}, which is {what}"

    def is_fixed(self) -> bool:
        """Return whether it is certified, for the whole domain of the statement, that the point
        is a fixed point of the map.  The rules on failures do not show this.
        """
        of_map, state = self.lines.of_map(), self.given.state
        head = [
            *([f"forall {' '.join(self.given.parameters)}"] if self.given.parameters else []),
            f"range {self.domain}",
            *(f"root {one}" for one in self.lines.all("root")),
            *(f"let {name} = {e}" for name, e in zip(state, terms_of(self.lines.one("point")))),
        ]
        return any(
            is_fixed_point(head, of_map.one("space"), guard, images, state)
            for guard, images in pieces_of(of_map)
        )


def finding_of(
    given: Map,
    rules: Sequence[MapRule],
    known: Mapping[str, checker.Statement],
    meaning: ParameterMeaning | None = None,
) -> MapFinding | None:
    """Return what these certified statements say of the given map; None if they say nothing of its
    fixed points.  `meaning` relates a parameter to the one that it replaced.
    """
    texts = {rule.name: rule.text() for rule in rules}
    lines = {name: RuleLines(name, texts) for name in texts}
    facts = [PointFact(known[name].kind, rows, given) for name, rows in lines.items()]
    every = OF_SETS | OF_SPACES | OF_FAILURES
    facts = [one for one in facts if one.kind in every and is_of(given, one.rule.of_map())]
    failing = [one for one in facts if one.kind in OF_FAILURES]
    whole = [one for one in facts if one.kind not in OF_FAILURES and not one.attracted]
    near = [one for one in facts if one.kind not in OF_FAILURES and one.attracted]
    nowhere = [
        rows.one("domain")
        for name, rows in lines.items()
        if known[name].kind == "map" and is_of(given, rows) and moves_everywhere(rows)
    ]
    if whole:
        exactly = (rows for name, rows in lines.items() if known[name].kind == "exactly")
        sharp = [rows for rows in exactly if is_of(given, rows.of_map())]
        found = of_attraction(given, whole, failing, nowhere, sharp)
    elif failing or nowhere:
        found = of_failure(given, failing, nowhere, near)
    elif near:
        says = f"{near[0].sentence()}; of other states nothing was found"
        parts = near[0].point, near[0].condition, near[0].attracted
        found = MapFinding(MapVerdict.IN_PART, says, *parts)
    else:
        return None
    if meaning is None:
        return found
    verdict = found.verdict if meaning.certified else MapVerdict.IN_PART
    return replace(found, verdict=verdict, sentence=f"{found.sentence}; {meaning.sentence}")


def is_of(given: Map, lines: RuleLines) -> bool:
    """Return whether the lines are those of a map with these parameters, this state and this
    space.
    """
    names = ("over", given.parameters), ("state", given.state)
    same = all(lines.one(keyword).split() == [*each] for keyword, each in names)
    return same and lines.one("space") == given.space


def of_attraction(
    given: Map,
    whole: Sequence[PointFact],
    failing: Sequence[PointFact],
    nowhere: Sequence[str],
    sharp: Sequence[RuleLines],
) -> MapFinding:
    """Return the finding on a point that attracts every state, for all parameters or for some."""
    fact = next((one for one in whole if not one.condition), whole[-1])
    says = f"{fact.point} is {STABLE} and {ATTRACTS} every state"
    if not fact.condition:
        return MapFinding(MapVerdict.PROVED, says, fact.point)
    if sharp:
        inner = PointFact("attracts", sharp[-1].named("attraction"), given)
        before = inner.rule.of_map().one("domain")
        only = readable(beyond(before, inner.domain, given.parameters))
        licences = beyond(given.domain, before, given.parameters)
        of = f", of all parameters with {readable(licences)}" if licences else ""
        says = f"{inner.point} is {STABLE} and {ATTRACTS} every state if and only if {only}{of}"
        return MapFinding(MapVerdict.IN_PART, says, inner.point, inner.condition)
    others = [one for one in failing if one.point == fact.point]
    where = [(one.domain, f"it {one.failure()}") for one in others]
    where += [(domain, NO_FIXED_POINT) for domain in nowhere]
    lines = [*dict.fromkeys(f"where {asked_beyond(given, one)}, {fails}" for one, fails in where)]
    covered = is_covered(given, [fact.domain, *(domain for domain, _ in where)])
    if len(where) == 1 and covered:
        lines = [f"elsewhere {where[0][1]}"]
    elif lines and not covered:
        lines.append("elsewhere nothing is known")
    at = "where" if lines else "at least where"
    says = "; ".join([f"{says} {at} {readable(fact.condition)}", *lines])
    return MapFinding(MapVerdict.IN_PART, says, fact.point, fact.condition)


def of_failure(
    given: Map, failing: Sequence[PointFact], nowhere: Sequence[str], near: Sequence[PointFact]
) -> MapFinding:
    """Return the finding on fixed points that are not stable, or do not attract every state.  No
    point attracts another fixed point: where a point that fails is certified to be fixed, none
    attracts every state.
    """
    asked = [asked_beyond(given, domain) for domain in nowhere]
    lines = [f"{begun(where)}{NO_FIXED_POINT}" for where in asked]
    lines += [f"{begun(one.condition)}{one.point} {one.failure()}" for one in failing]
    lines += [one.sentence() for one in near]
    domains = [*nowhere, *(one.domain for one in failing if one.is_fixed())]
    whole = is_covered(given, domains)
    return MapFinding(MapVerdict.REFUTED if whole else MapVerdict.IN_PART, "; ".join(lines))


def asked_beyond(given: Map, domain: str) -> str:
    """Return the conditions beyond the domain that is given, as a person reads them."""
    where = beyond(given.domain, domain, given.parameters)
    return readable(where) if where else ""


def begun(condition: str) -> str:
    """The condition as the beginning of a sentence."""
    return f"at least where {readable(condition)}, " if condition else ""


def is_covered(given: Map, domains: Sequence[str]) -> bool:
    """Return whether it is certified that the domains make up the given domain."""
    if any(not beyond(given.domain, one, given.parameters) for one in domains):
        return True
    each = " or ".join(f"({one})" for one in domains)
    over = f"forall {' '.join(given.parameters)}"
    return len(domains) > 1 and is_certified([over, f"given {given.domain}", f"show {each}"])


# -------------------------------------------------------------------------------------------------
# A map without fixed points, as a map whose guards say so.


def without_fixed_point(system: Map) -> MapRule:
    """The map with guards that say that the image of each state is a different state."""
    pieces = tuple(
        (conjunction(guard, moves(images, system.state)), images) for guard, images in system.pieces
    )
    return replace(system, pieces=pieces).rule(f"{system.name}/no-fixed-point")


def moves(images: Sequence[str], state: Sequence[str]) -> str:
    """Return the formula that the image differs from the state in some coordinate."""
    return " or ".join(
        f"{numerator(f'{image} - {name}')} != 0" if divides(image) else f"{image} != {name}"
        for image, name in zip(images, state)
    )


def numerator(term: str) -> str:
    """Return the numerator of a quotient."""
    return written(sympy.numer(sympy.together(expression(term))))


def moves_everywhere(lines: RuleLines) -> bool:
    """Return whether each guard of a map says that the image is another state."""
    state = lines.one("state").split()
    return all(
        str(formula_of(checker.parse(moves(images, state)))) in conjuncts(guard)
        for guard, images in pieces_of(lines)
    )


def is_fixed_point(
    head: Sequence[str], space: str, guard: str, images: Sequence[str], state: Sequence[str]
) -> bool:
    """Return whether it is certified that the state that these lines name is in the space, that
    the guard holds there, and that it is its own image.
    """
    shown = []
    for name, image in zip(state, images):
        above, below = map(written, sympy.fraction(sympy.together(expression(image))))
        shown += [f"{below} != 0", f"{above} = {name}*({below})"]
    known = [f"have {space}"] if space != ANYWHERE else []  # guards may divide
    return is_certified([*head, *known, f"show {conjunction(guard, *shown)}"])


def pieces_of(lines: RuleLines) -> Iterator[tuple[str, list[str]]]:
    """Yield the guard and the images of each piece of a map."""
    for piece in lines.all("piece"):
        guard, _, images = piece.partition(" -> ")
        yield guard, terms_of(images)


# -------------------------------------------------------------------------------------------------
# Formulas as a person reads them.


def readable(condition: str) -> str:
    """The condition, with linear inequalities of one parameter as intervals.

    >>> readable("1 - a > 0 and a > -1 and a*b < 1")
    '-1 < a < 1 and a*b < 1'
    """
    alone: dict[str, list[str]] = {}
    rest = []
    for part in conjuncts(condition):
        name, *others = sorted(checker.names_in(part)) or [""]
        if name and not others and bounds_of(part, name):
            alone.setdefault(name, []).append(part)
        else:
            rest.append(part)
    ends = [(name, bounds_of(conjunction(*parts), name)) for name, parts in alone.items()]
    return conjunction(*(interval_text(name, *both) for name, both in ends if both), *rest)


def in_brackets(text: str) -> str:
    """The text, in brackets where it is a sum or a list, or has a sign."""
    return f"({text})" if " " in text or text.startswith("-") else text


def named(lines: RuleLines, keyword: str) -> str:
    """The state that the line of this keyword names, with its roots written out."""
    return lines.without_roots(in_brackets(lines.one(keyword)))


def with_bars(formula: str) -> str:
    """The formula with |t| <= r in place of t <= r and -t <= r."""
    rows = [part.split(" <= ") for part in formula.split(" and ")]
    if any(len(row) != 2 for row in rows):
        return formula
    known = [(expression(left), right) for left, right in rows]
    lines = []
    for k, ((left, right), (term, _)) in enumerate(zip(rows, known)):
        if (-term, right) not in known:
            lines.append(f"{left} <= {right}")
        elif (-term, right) not in known[:k]:
            lines.append(f"|{left}| <= {right}")
    return " and ".join(lines)
