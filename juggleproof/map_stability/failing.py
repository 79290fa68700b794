"""Proofs that a point is not stable, or does not attract every state; and the sharp theorem, which
says for the whole domain where the point is stable and attracts every state, and where not.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import islice

from juggleproof.certificates import checker
from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import ProvedStatements, Report
from juggleproof.map_stability.entering import entering_rules
from juggleproof.map_stability.findings import is_fixed_point
from juggleproof.map_stability.functions.candidates import Setting
from juggleproof.map_stability.functions.chetaev import chetaev_rules
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.points import FixedPoint
from juggleproof.map_stability.refuting import (
    escape_rules,
    instability_rules,
    short_words,
    words_of_stray_orbits,
)
from juggleproof.map_stability.settings import setting_of
from juggleproof.map_stability.terms import conjuncts, negation
from juggleproof.statements.cases import conjunction
from juggleproof.statements.definitions import term_of
from juggleproof.statements.language import MapRule

Way = Callable[[ProvedStatements, Setting, Report], bool]
COMPLEMENTS = {ast.Gt: "= <", ast.GtE: "<", ast.Lt: "= >", ast.LtE: ">", ast.NotEq: "="}


def complement(conditions: str) -> list[str]:
    """Return formulas for the boundary and the strict outside of each condition.  Where the
    conditions fail, one of the formulas holds.
    """
    parts = []
    for condition in conjuncts(conditions):
        node = checker.parse(condition)
        if isinstance(node, ast.Compare) and not node.ops[1:] and type(node.ops[0]) in COMPLEMENTS:
            left, right = term_of(node.left), term_of(node.comparators[0])
            parts += [f"{left} {op} {right}" for op in COMPLEMENTS[type(node.ops[0])].split()]
        else:
            parts.append(f"not ({condition})")
    return parts


NAMED = {"escapes": "escape", "unstable": "unstable"}  # the lines of `exactly` that name each kind


def parts_refuted(
    proof: ProvedStatements,
    system: Map,
    fixed: FixedPoint,
    parts: Sequence[str],
    ways: Sequence[Way],
    log: Report,
) -> list[tuple[str, str]]:
    """Return the lines that name a refutation for each part of the domain that has parameters; none
    if a part has no refutation.
    """
    lines = []
    for part in parts:
        setting = setting_of(system, fixed, conjunction(system.domain, part))
        if setting.count:
            if not refuted(proof, setting, log, ways):
                return []
            name = proof.rules[-1].name
            lines.append((NAMED[proof.known[name].kind], name))
    return lines


def sharp(
    proof: ProvedStatements, setting: Setting, refutations: Sequence[tuple[str, str]], log: Report
) -> bool:
    """Return whether one theorem is certified of stability and attraction on a part of the domain,
    and of their failure on the rest.
    """
    name = setting.system.name
    rules = [] if f"{name}/attracts" in proof.known else entering_rules(setting, ())
    exactly = MapRule(f"{name}/exactly", (("attraction", f"{name}/attracts"), *refutations))
    for rule in [*rules, exactly]:
        if rule.name not in proof.known and not proof.add(rule):
            log(f"{rule.name}: {proof.fault}")
            return False
    return True


def by_orbit(proof: ProvedStatements, setting: Setting, log: Report) -> bool:
    """Return whether an orbit is certified that the point does not attract: an orbit that samples
    tend to, or another fixed point.
    """
    fixed = [(k,) for k in range(len(setting.system.pieces))]
    return escaped(proof, setting, dict.fromkeys([*words_of_stray_orbits(setting), *fixed]), log)


def by_short_orbit(proof: ProvedStatements, setting: Setting, log: Report) -> bool:
    """Return whether a short periodic orbit is certified, which may repel."""
    return escaped(proof, setting, short_words(setting), log)


def escaped(
    proof: ProvedStatements, setting: Setting, words: Iterable[tuple[int, ...]], log: Report
) -> bool:
    """Return whether a periodic orbit along one of these words is certified."""
    name = proof.free_name(f"{setting.system.name}/escapes")
    for count, rule in enumerate(escape_rules(setting, name, words)):
        if not count and not is_fixed(setting):
            log("it is not certified that the point is a fixed point")
            return False
        taken, said = proof.add(rule), dict(rule.rows)
        roots = "".join(f", {text}" for keyword, text in rule.rows if keyword == "root")
        log(f"orbit of {said['start']}{roots}, along {said['word']}: {proof.fault or 'certified'}")
        if taken:
            return True
    return False


def is_fixed(setting: Setting) -> bool:
    """Return whether the point is certified to be a fixed point.  The rule `escapes` does not show
    this: its conclusion holds for any other state too.
    """
    system, (guard, images) = setting.system, setting.system.pieces[setting.piece]
    return is_fixed_point(setting.head, system.space, guard, images, system.state)


def by_growth(proof: ProvedStatements, setting: Setting, log: Report) -> bool:
    """Return whether it is certified that orbits leave a neighbourhood of the point."""
    rules = chetaev_rules if len(setting.system.state) > 1 else instability_rules
    name = proof.free_name(f"{setting.system.name}/unstable")
    before = proof.work
    found = list(islice(rules(setting, name), limits.MOST_RATES))
    if not found:
        log("no function grows at all samples close to the point")
    for efforts, budget in limits.GROWTH_ROUNDS:
        for rule in found:
            if proof.work - before > limits.GROWTH_WORK:
                return False
            taken = proof.add(rule, efforts, budget)
            log(f"instability at rate {dict(rule.rows)['rate']}: {proof.fault or 'certified'}")
            if taken:
                return True
    return False


def refuted(proof: ProvedStatements, setting: Setting, log: Report, ways: Sequence[Way]) -> bool:
    """Return whether it is certified in one of these ways, for all parameters, that the point is
    not stable or does not attract every state.
    """
    return any(way(proof, setting, log) for way in ways)


WAYS: tuple[Way, ...] = (by_orbit, by_growth, by_short_orbit)


def outsides(conditions: str) -> Iterator[tuple[Sequence[str], Sequence[Way]]]:
    """Yield formulas for the parameters at which the conditions fail, with the ways to refute them.
    First comes the whole outside with its boundary, on which no rate of growth is above 1; then
    come its parts.
    """
    whole, parts = negation(conditions), complement(conditions)
    if parts != [whole]:
        yield [whole], (by_orbit, by_short_orbit)
    yield parts, WAYS
