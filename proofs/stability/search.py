"""The search: the map alone is given; found are the point, a function or a norm, and statements for
which the checker takes certificates.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import compress, islice

import sympy

from juggleproof.certificates.cases import conjunction
from juggleproof.certificates.language import MapRule
from juggleproof.proofs.stability.algebraic import MOST_DEGREE, Renamed, by_its_point
from juggleproof.proofs.stability.attracting import attracted, by_shape, enveloped
from juggleproof.proofs.stability.by_equation import by_an_equation
from juggleproof.proofs.stability.certifying import (
    BUDGET,
    LOCAL_BUDGET,
    MORE_WORK,
    MOST_WORK,
    Proof,
    Report,
    beyond,
    is_certified,
    tried,
    where_open,
)
from juggleproof.proofs.stability.domains import middle_of, narrowed
from juggleproof.proofs.stability.failing import (
    WAYS,
    by_growth,
    by_orbit,
    complement,
    in_brackets,
    outsides,
    parts_refuted,
    refuted,
    sharp,
)
from juggleproof.proofs.stability.functions.norms import local_rules
from juggleproof.proofs.stability.functions.values import Setting
from juggleproof.proofs.stability.given import (
    Map,
    expression,
    negation,
    renamed,
    written,
)
from juggleproof.proofs.stability.points import PARAMETERS, FixedPoint, fixed_points
from juggleproof.proofs.stability.samples import (
    divides,
    region,
    with_licences,
)
from juggleproof.proofs.stability.settings import setting_of

HEAD = "fixed point "  # of the lines on what was tried for one
MOST_REFUTED = 3  # fixed points
LOCAL_TRIED = 3  # statements of states close to a point
SAMPLES = 1000  # states, at which pieces apply that are not empty
FEW_PIECES = 3  # of which none is looked at
EMPTY_BUDGET = 20_000  # of counted work for a piece that none of them is in


@dataclass
class Outcome:
    """What was found: the statements with certificates, what they come to, and what was tried.

    verdict: `exactly` (stable and attracting for these parameters and no others), `stable` (for
    all, or at least for these parameters), `refuted`, `region` (stable and attracting a
    neighbourhood at least) or `unknown`.
    """

    proof: Proof
    verdict: str
    sentence: str
    tried: list[str]


def search_stability(
    system: Map, report: Report = lambda text: None, budget: int = BUDGET
) -> Outcome:
    """What `outcome_of` finds, with the roots written out in its sentence."""
    found = outcome_of(system, report, budget)
    rows = [row for rule in found.proof.rules for row in rule.rows]
    roots = (text.split(" = ", 1) for keyword, text in rows if keyword == "root")
    found.sentence = renamed(found.sentence, dict(roots))
    return found


def outcome_of(system: Map, report: Report, budget: int) -> Outcome:
    """A proof that a fixed point is stable and attracts the whole space, or that none does, or what
    comes nearest to either.
    """
    given, guards, original = system.domain, [guard for guard, _ in system.pieces], system
    system = without_empty_pieces(with_licences(system))
    parameters = region(system.domain, system.parameters, PARAMETERS)
    proof = Proof(budget=budget, most=MOST_WORK * budget // BUDGET)
    if not all(map(len, parameters.values())):
        hint = "; put in what an equation fixes" if " = " in given else ""
        none = f"no parameters were found in the domain {given}{hint}"
        if is_certified([f"forall {' '.join(system.parameters)}", f"show {negation(given)}"]):
            none = f"the domain {given} is empty"
        return Outcome(proof, "unknown", none, [])
    lines: list[str] = []

    def log(text: str) -> None:
        note(lines, text)
        report(text)

    fault = proof.add(system.rule(f"{system.name}/map"))
    if fault:
        line, _, text = (proof.why() or fault).partition("\n")
        if guards != [guard for guard, _ in system.pieces]:
            line += "; a piece applies only where it divides by nothing that is 0"
        where = lines_named(system, line)
        return Outcome(proof, "unknown", f"the map{where}: {line}", [text] if text else [])
    every = [one for one in fixed_points(system) if one.exists(system, parameters).any()]
    other = None if every else by_its_point(original) or by_an_equation(original)
    if other:
        outcome = outcome_of(other.system, report, budget)
        if outcome.sentence:
            outcome.sentence += f"; {other.sentence()}{other.doubt(original)}"
        return outcome
    if not every:
        if not system.point and not proof.add(without_fixed_point(system)):
            return Outcome(proof, "refuted", "no state of the space is a fixed point", lines)
        what = ", ".join(system.point)
        none = f"{what} is no fixed point in the space"
        if not what:
            none = (
                "no isolated fixed point in square roots, or by an equation of degree"
                f" {MOST_DEGREE} at most, was found in the space"
            )
        return Outcome(proof, "unknown", none, lines)
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
                    return Outcome(proof, *found, lines)
        log(head_of(fixed, split))
        found = settled(proof, system, fixed, split, given, log)
        if found:
            return Outcome(proof, *found, lines)
    faults = []
    proof.grant(MORE_WORK)
    # of several fixed points it says little that one does not attract another
    ways = (by_growth, by_orbit) if len(every) > 1 else WAYS
    for fixed in every[:MOST_REFUTED]:
        if fixed.exists(system, parameters).all():
            log(head_of(fixed))
            setting = setting_of(system, fixed, system.domain)
            fault = refuted(proof, setting, log, ways)
            if fault:
                at = where_open(given, proof.domain(), system.parameters)
                faults.append(f"{at}{name_of(fixed)} {fault}")
    if faults:
        return Outcome(proof, "refuted", "; ".join(faults), lines)
    other = by_its_point(original, several=True) if len(every) > 1 else None
    none_attracts = of_several(other, budget, log) if other else None
    if none_attracts:
        return Outcome(*none_attracts, lines)
    proof.grant(MORE_WORK)
    for fixed in every:
        if fixed.stable_share(system, parameters):
            split = narrowed(system, fixed, parameters)
            log(head_of(fixed, split))
            inner = conjunction(system.domain, *split)
            middle = conjunction(inner, *middle_of(system, inner))
            for domain in dict.fromkeys((inner, middle)):
                setting = setting_of(system, fixed, domain)
                if not setting.count:
                    continue
                near = near_by(proof, setting, name_of(fixed), given, log)
                if near:
                    sentence = f"{near}; of other states nothing was found"
                    return Outcome(proof, "region", sentence, lines)
    return Outcome(proof, "unknown", "", lines)


def of_several(other: Renamed, budget: int, log: Report) -> tuple[Proof, str, str] | None:
    """That none of several fixed points attracts another, with one of them as a parameter: a domain
    knows no roots, and an orbit may divide by what has them.
    """
    system = with_licences(other.system)
    proof = Proof(budget=budget, most=MORE_WORK * budget // BUDGET)
    if not proof.add(system.rule(f"{system.name}/map")):
        for fixed in fixed_points(system):
            log(head_of(fixed))
            fault = by_orbit(proof, setting_of(system, fixed, system.domain), log)
            if fault:
                (e,), old = system.point, other.parameter
                at = where_open(system.domain, proof.domain(), system.parameters)
                where = f"here {old} = {other.term}, where samples alone say that each {old} has"
                return proof, "refuted", f"{at}{e} {fault}; {where} such {e}"
    return None


def note(lines: list[str], text: str) -> None:
    """Adds a line on what was tried, once for each fixed point.

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
    """The map without the pieces that apply at no state, as it is certified: of cases of abs, max
    and min, many exclude each other.

    >>> from juggleproof.proofs.stability.given import read_rows
    >>> rows = [("state", "x"), ("piece", "max(x - 1, 0) + min(x + 1, 0)")]
    >>> [guard for guard, _ in without_empty_pieces(read_rows("gap", rows)).pieces]
    ['x - 1 >= 0 and 0 < x + 1', '0 > x - 1 and x + 1 <= 0', '0 > x - 1 and 0 < x + 1']
    """
    if len(system.pieces) < FEW_PIECES:
        return system
    inside = conjunction(system.domain, system.space)
    points = region(inside, system.names, SAMPLES)
    lines = [f"forall {' '.join(system.names)}", f"given {inside}"]
    kept = [
        here.any() or not is_certified([*lines, f"show {negation(piece[0])}"], EMPTY_BUDGET)
        for piece, here in zip(system.pieces, system.applying(points))
    ]
    pieces, places = tuple(compress(system.pieces, kept)), tuple(compress(system.lines, kept))
    return replace(system, pieces=pieces, lines=places)


def lines_named(system: Map, fault: str) -> str:
    """Where the pieces stand that a premise of the map names at the end of its name; all, where it
    names none; nothing where the map is from no file.
    """
    named = re.match(r"(?:apart|stays)((?:-\d+)+),", fault)
    numbers = [int(k) - 1 for k in named[1].split("-")[1:]] if named else range(len(system.pieces))
    rows = sorted({system.lines[k] for k in numbers}) if system.lines else []
    return f", line{'s' * (len(rows) > 1)} {', '.join(map(str, rows))}" if rows else ""


def without_fixed_point(system: Map) -> MapRule:
    """The map with guards that say of each state that its image is another."""
    pieces = []
    for guard, images in system.pieces:
        moved = [
            f"{image} != {name}"
            if not divides(image)
            else f"{written(sympy.numer(sympy.together(expression(f'{image} - {name}'))))} != 0"
            for image, name in zip(images, system.state)
        ]
        pieces.append((conjunction(guard, " or ".join(moved)), images))
    return replace(system, pieces=tuple(pieces)).rule(f"{system.name}/no-fixed-point")


def near_by(proof: Proof, setting: Setting, name: str, given: str, log: Report) -> str:
    """What is certified of states close to the point, or nothing."""
    pairs = zip(setting.system.state, setting.point.terms)
    gaps = {f"{one}_gap": one if e == "0" else f"{one} - {in_brackets(e)}" for one, e in pairs}
    rules = local_rules(setting, f"{setting.system.name}/lyapunov")
    for rule in islice(rules, LOCAL_TRIED):
        if not tried(proof, rule, (1, 2), LOCAL_BUDGET, log):
            at = where_open(given, setting.domain, setting.system.parameters)
            on = with_bars(dict(rule.rows)["on"])
            for one, gap in gaps.items():
                on = on.replace(f"|{one}|", f"|{gap}|")
            on = renamed(on, {one: in_brackets(gap) for one, gap in gaps.items()})
            return f"{at}{name} is stable, and attracts every state with {on}"
    return ""


def head_of(fixed: FixedPoint, split: Sequence[str] = ()) -> str:
    """The line above what was tried for a fixed point, with the roots in it and the conditions."""
    roots = [f", {name} = sqrt({under})" for name, under in fixed.point.roots]
    return f"{HEAD}{name_of(fixed)}{''.join(roots)}" + "".join(f", where {one}" for one in split)


def name_of(fixed: FixedPoint) -> str:
    """The point as a person reads it."""
    return in_brackets(", ".join(fixed.point.terms))


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


def settled(
    proof: Proof,
    system: Map,
    fixed: FixedPoint,
    split: Sequence[str],
    given: str,
    log: Report,
    closed: bool = False,
) -> tuple[str, str] | None:
    """Verdict and sentence for one fixed point, where something is certified; `given` is the domain
    as the user gives it; `closed`: by envelopes alone, the multiplier being -1 at the end.
    """
    inner = conjunction(system.domain, *split)
    setting = setting_of(system, fixed, inner)
    if not setting.count:
        return None
    where = beyond(given, setting.domain, system.parameters)
    name = name_of(fixed)
    if not split:
        fault = by_orbit(proof, setting, log)
        if fault:
            at = where_open(given, proof.domain(), system.parameters)
            more = near_by(proof, setting, name, given, log)
            return "refuted", f"{at}{name} {fault}" + (f"; {more}" if more else "")
    if closed:
        if not enveloped(proof, setting, log, closed):
            return None
    elif not attracted(proof, setting, log):
        smaller = setting_of(system, fixed, inner, by_samples=True)
        if smaller.domain == setting.domain or not attracted(proof, smaller, log):
            middle = middle_of(system, inner)
            if not middle:
                return None
            smaller = setting_of(system, fixed, conjunction(inner, *middle), by_samples=True)
            if not by_shape(proof, smaller, log):
                return None
            where = beyond(given, smaller.domain, system.parameters)
            return "stable", f"{name} is stable and attracts every state at least where {where}"
        setting, where = smaller, beyond(given, smaller.domain, system.parameters)
    if not where:
        return "stable", f"{name} is stable and attracts every state"
    proof.grant(MORE_WORK)
    licences, count, kinds = beyond(given, system.domain, system.parameters), len(proof.rules), []
    for parts, ways in outsides(where):
        kinds = parts_refuted(proof, system, fixed, parts, ways, log)
        if kinds and sharp(proof, setting, kinds, log):
            inside = beyond(system.domain, setting.domain, system.parameters)
            of = f", of all parameters with {licences}" if licences else ""
            sentence = f"{name} is stable and attracts every state if and only if {inside}{of}"
            return "exactly", sentence
        proof.keep(count)
    outside = replace(system, domain=conjunction(system.domain, negation(where)))
    if not kinds and not licences and not proof.add(without_fixed_point(outside)):
        sentence = f"{name} is stable and attracts every state where {where}"
        return "exactly", f"{sentence}; elsewhere no state of the space is a fixed point"
    sentence = f"{name} is stable and attracts every state at least where {where}"
    inside = beyond(system.domain, setting.domain, system.parameters)
    return "stable", "; ".join([sentence, *said_outside(proof, system, fixed, inside, log)])


def said_outside(
    proof: Proof, system: Map, fixed: FixedPoint, inside: str, log: Report
) -> Iterator[str]:
    """Of each part of the domain outside of these conditions that has parameters, how the point
    fails there, or that nothing is known; nothing where it is not known to fail on any part.
    """
    lines, known = [], False
    for part in complement(inside) if inside else []:
        setting = setting_of(system, fixed, conjunction(system.domain, part))
        if setting.count:
            fault = refuted(proof, setting, log, WAYS)
            if fault:
                more = beyond(conjunction(system.domain, part), proof.domain(), system.parameters)
                lines.append(f"where {conjunction(part, more)}, it {fault}")
                known = True
            else:
                lines.append(f"where {part}, nothing is known")
    yield from lines if known else []
