"""The search for the stability of a map.  It finds the point, a function or a norm, and statements
with certificates that the checker takes.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import compress

from juggleproof.judging.conclusions import STABLE
from juggleproof.map_stability import limits
from juggleproof.map_stability.attracting import (
    BY_SHAPE,
    CLOSE_BY,
    CLOSED,
    attracted,
    settled_by,
)
from juggleproof.map_stability.certifying import ProvedStatements, Report, beyond, is_certified
from juggleproof.map_stability.domains import failing_at_ends, middle_of, narrowed
from juggleproof.map_stability.failing import (
    WAYS,
    by_growth,
    by_orbit,
    complement,
    outsides,
    parts_refuted,
    refuted,
    sharp,
)
from juggleproof.map_stability.findings import (
    MapFinding,
    MapVerdict,
    ParameterMeaning,
    finding_of,
    in_brackets,
    without_fixed_point,
)
from juggleproof.map_stability.functions.candidates import Setting
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.points import FixedPoint, fixed_points
from juggleproof.map_stability.points_as_parameters import MapWithPoint, by_its_point
from juggleproof.map_stability.points_by_equation import by_an_equation
from juggleproof.map_stability.samples import region, with_licences
from juggleproof.map_stability.settings import setting_of
from juggleproof.map_stability.terms import conjuncts, negation
from juggleproof.statements.cases import conjunction

HEAD = "fixed point "  # of the lines on what was tried for one


@dataclass
class Outcome:
    """The statements with certificates, what they say, and what was tried."""

    proof: ProvedStatements
    finding: MapFinding
    tried: list[str]


def search_stability(
    system: Map,
    report: Report = lambda text: None,
    budget: int = limits.PREMISE_WORK,
    meaning: ParameterMeaning | None = None,
) -> Outcome:
    """Return a proof that a fixed point is stable and attracts the whole space, or that none does,
    or what comes nearest to either.  `meaning` relates a parameter to the one that it replaced.
    """
    lines: list[str] = []
    proof = ProvedStatements(budget=budget, most=limits.MAP_WORK * budget // limits.PREMISE_WORK)

    def log(text: str) -> None:
        note(lines, text)
        report(text)

    found = search_proof_of(system, proof, log)
    if isinstance(found, Outcome):
        return found
    finding = finding_of(system, proof.rules, proof.known, meaning)
    return Outcome(proof, finding or MapFinding(MapVerdict.UNKNOWN, found), lines)


def search_proof_of(system: Map, proof: ProvedStatements, log: Report) -> Outcome | str:
    """Add what is certified of the map to the proof.  Return why nothing is certified, or an empty
    text; or the outcome for the map with a coordinate of its point as a parameter.
    """
    given = system
    system = without_empty_pieces(with_licences(system))
    parameters = region(system.domain, system.parameters, limits.PARAMETERS)
    if not all(map(len, parameters.values())):
        hint = "; put in what an equation fixes" if " = " in given.domain else ""
        none = f"no parameters were found in the domain {given.domain}{hint}"
        shown = [f"forall {' '.join(system.parameters)}", f"show {negation(given.domain)}"]
        return f"the domain {given.domain} is empty" if is_certified(shown) else none
    if not proof.add(system.rule(f"{system.name}/map")):
        line, _, text = (proof.why() or proof.fault).partition("\n")
        if [guard for guard, _ in given.pieces] != [guard for guard, _ in system.pieces]:
            line += "; a piece applies only where it divides by nothing that is 0"
        if text:
            log(text)
        return f"the map{lines_named(system, line)}: {line}"
    every = [one for one in fixed_points(system) if one.exists(system, parameters).any()]
    other = None if every else by_its_point(given) or by_an_equation(given)
    if other:
        return search_stability(other.system, log, proof.budget, other.meaning(given))
    if not every:
        if not system.point:
            proof.add(without_fixed_point(system))
            return (
                "no isolated fixed point in square roots, or by an equation of degree"
                f" {limits.MOST_DEGREE} at most, was found in the space"
            )
        return f"{', '.join(system.point)} is no fixed point in the space"
    for fixed in sorted(every, key=lambda one: -one.stable_share(system, parameters)):
        if not fixed.stable_share(system, parameters):
            break
        split = narrowed(system, fixed, parameters)
        if len(system.state) == 1:
            closed = narrowed(system, fixed, parameters, closed=True)
            if closed != split:  # the multiplier is -1 at the end
                left = proof.most - proof.work
                proof.most = proof.work + left // 2
                found = settled(proof, system, fixed, closed, given, log, closed=True)
                proof.most = proof.work + left  # for the open condition, or what is outside
                if found:
                    return ""
        ends = failing_at_ends(system, fixed, parameters)
        split += [one for one in ends if fails_outside(proof, system, fixed, one, log)]
        log(head_of(fixed, split))
        if settled(proof, system, fixed, split, given, log):
            return ""
    count = len(proof.rules)
    proof.grant(limits.REFUTATION_WORK)
    # that one of several fixed points does not attract another says little
    ways = (by_growth, by_orbit) if len(every) > 1 else WAYS
    for fixed in every[: limits.MOST_REFUTED]:
        if fixed.exists(system, parameters).all():
            log(head_of(fixed))
            refuted(proof, setting_of(system, fixed, system.domain), log, ways)
    if len(proof.rules) > count:
        return ""
    other = by_its_point(given, several=True) if len(every) > 1 else None
    outcome = of_several(other, proof.budget, log) if other else None
    if outcome:
        return outcome
    proof.grant(limits.REFUTATION_WORK)
    for fixed in every:
        if fixed.stable_share(system, parameters):
            split = narrowed(system, fixed, parameters)
            log(head_of(fixed, split))
            inner = conjunction(system.domain, *split)
            middle = conjunction(inner, *middle_of(system, inner))
            for domain in dict.fromkeys((inner, middle)):
                setting = setting_of(system, fixed, domain)
                if setting.count and CLOSE_BY.settles(proof, setting, log):
                    return ""
    return f"no fixed point was certified to be {STABLE}, or not to be"


def of_several(other: MapWithPoint, budget: int, log: Report) -> Outcome | None:
    """Return the outcome that none of several fixed points attracts another, with one of them as a
    parameter.  An orbit may divide by a term with a root, which a domain cannot name.
    """
    system = with_licences(other.system)
    proof = ProvedStatements(
        budget=budget, most=limits.REFUTATION_WORK * budget // limits.PREMISE_WORK
    )
    if proof.add(system.rule(f"{system.name}/map")):
        for fixed in fixed_points(system):
            log(head_of(fixed))
            if by_orbit(proof, setting_of(system, fixed, system.domain), log):
                old, e = other.parameter, other.name()
                says = f"here {old} = {other.term}, where samples alone say that each {old} has"
                meaning = ParameterMeaning(f"{says} such {e}", certified=False)
                found = finding_of(other.system, proof.rules, proof.known, meaning)
                return Outcome(proof, found, []) if found else None
    return None


def note(lines: list[str], text: str) -> None:
    """Add a line on what was tried, once for each fixed point.

    >>> lines: list[str] = []
    >>> for text in ("fixed point 0", "V = x", "V = x", "fixed point 1", "V = x"):
    ...     note(lines, text)
    >>> lines
    ['fixed point 0', 'V = x', 'fixed point 1', 'V = x']
    """
    heads = [k for k, line in enumerate(lines) if line.startswith(HEAD)]
    if text not in lines[heads[-1] if heads else 0 :]:
        lines.append(text)


def without_empty_pieces(system: Map) -> Map:
    """The map without the pieces that are certified to apply at no state.  Many cases of abs, max
    and min exclude each other.

    >>> from juggleproof.map_stability.maps import read_rows
    >>> rows = [("state", "x"), ("piece", "max(x - 1, 0) + min(x + 1, 0)")]
    >>> [guard for guard, _ in without_empty_pieces(read_rows("gap", rows)).pieces]
    ['x - 1 >= 0 and 0 < x + 1', '0 > x - 1 and x + 1 <= 0', '0 > x - 1 and 0 < x + 1']
    """
    if len(system.pieces) == 1:
        return system
    inside = conjunction(system.domain, system.space)
    points = region(inside, system.names, limits.PIECE_STATES)
    lines = [f"forall {' '.join(system.names)}", f"given {inside}"]
    kept = [
        here.any()
        or not is_certified([*lines, f"show {negation(piece[0])}"], limits.EMPTY_PIECE_WORK)
        for piece, here in zip(system.pieces, system.applying(points))
    ]
    pieces, places = tuple(compress(system.pieces, kept)), tuple(compress(system.lines, kept))
    return replace(system, pieces=pieces, lines=places)


def lines_named(system: Map, fault: str) -> str:
    """Return the lines of the pieces that a premise of the map names at the end of its name, or of
    all pieces; nothing if the map is from no file.
    """
    named = re.match(r"(?:apart|stays)((?:-\d+)+),", fault)
    numbers = [int(k) - 1 for k in named[1].split("-")[1:]] if named else range(len(system.pieces))
    rows = sorted({system.lines[k] for k in numbers}) if system.lines else []
    return f", line{'s' * (len(rows) > 1)} {', '.join(map(str, rows))}" if rows else ""


def head_of(fixed: FixedPoint, split: Sequence[str] = ()) -> str:
    """The line above what was tried for a fixed point, with the roots in it and the conditions."""
    roots = [f", {name} = sqrt({under})" for name, under in fixed.point.roots]
    point = in_brackets(", ".join(fixed.point.terms))
    return f"{HEAD}{point}{''.join(roots)}" + "".join(f", where {one}" for one in split)


def settled(
    proof: ProvedStatements,
    system: Map,
    fixed: FixedPoint,
    split: Sequence[str],
    given: Map,
    log: Report,
    closed: bool = False,
) -> bool:
    """Return whether something is certified of one fixed point, and add what is certified of it for
    the other parameters.  `given` is the map as the user gives it; `closed`: only envelopes are
    tried, since the multiplier is -1 at the end.
    """
    inner = conjunction(system.domain, *split)
    setting = setting_of(system, fixed, inner)
    if not setting.count:
        return False
    if not split and by_orbit(proof, setting, log):
        CLOSE_BY.settles(proof, setting, log)
        return True
    if closed:
        if not CLOSED.settles(proof, setting, log):
            return False
    elif not attracted(proof, setting, log):
        smaller = setting_of(system, fixed, inner, by_samples=True)
        if smaller.domain == setting.domain or not attracted(proof, smaller, log):
            middle = middle_of(system, inner)
            if not middle:
                return False
            smaller = setting_of(system, fixed, conjunction(inner, *middle), by_samples=True)
            return settled_by(BY_SHAPE, proof, smaller, log)
        setting = smaller
    found = finding_of(given, proof.rules, proof.known)
    if found and found.condition:
        # what a function divides by, or multiplies with, may ask for more than was sought
        domain = conjunction(setting.domain, *conjuncts(found.condition))
        setting = replace(setting, domain=domain)
        search_outside(proof, setting, fixed, system, found.condition, log)
    return True


def fails_outside(
    proof: ProvedStatements, system: Map, fixed: FixedPoint, where: str, log: Report
) -> bool:
    """Return whether it is certified that the point fails where the condition does not hold."""
    count = len(proof.rules)
    outside = replace(system, domain=conjunction(system.domain, negation(where)))
    fails = parts_refuted(proof, system, fixed, complement(where), WAYS, log)
    nowhere = not fails and proof.add(without_fixed_point(outside))
    proof.keep(count)
    return bool(fails) or nowhere


def search_outside(
    proof: ProvedStatements,
    setting: Setting,
    fixed: FixedPoint,
    system: Map,
    where: str,
    log: Report,
) -> None:
    """Add how the point fails if these conditions fail; and, if it follows, that the point is
    stable and attracts every state nowhere else.
    """
    proof.grant(limits.REFUTATION_WORK)
    count, kinds = len(proof.rules), []
    for parts, ways in outsides(where):
        kinds = parts_refuted(proof, system, fixed, parts, ways, log)
        if kinds and sharp(proof, setting, kinds, log):
            return
        proof.keep(count)
    outside = replace(system, domain=conjunction(system.domain, negation(where)))
    if not kinds and proof.add(without_fixed_point(outside)):
        return
    inside = beyond(system.domain, setting.domain, system.parameters)
    for part in complement(inside) if inside else []:
        setting = setting_of(system, fixed, conjunction(system.domain, part))
        if setting.count:
            refuted(proof, setting, log, WAYS)
