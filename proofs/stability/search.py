"""The search: the map alone is given; found are the point, a function or a norm, and statements for
which the checker takes certificates.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np
import sympy

from juggleproof.certificates import checker
from juggleproof.certificates.language import MapRule
from juggleproof.certificates.nodes import Certificate
from juggleproof.certificates.search.certificate import search_map_rule
from juggleproof.proofs.stability.given import (
    Map,
    atoms,
    conjunction,
    expression,
    symbols,
    value,
    written,
)
from juggleproof.proofs.stability.norms import is_affine, norm_rules
from juggleproof.proofs.stability.points import FixedPoint, fixed_points
from juggleproof.proofs.stability.samples import (
    Point,
    around,
    ends_of,
    licence,
    region,
    with_licences,
)
from juggleproof.proofs.stability.values import (
    Function,
    Setting,
    lyapunov_functions,
    lyapunov_rules,
    quadratic_templates,
)

PARAMETERS, STATES = 150, 40  # samples
BUDGET = 300_000  # counted work for a premise
Report = Callable[[str], None]


@dataclass
class Proof:
    """Statements with certificates, in order."""

    rules: list[MapRule] = field(default_factory=list)
    certificates: dict[str, Certificate] = field(default_factory=dict)
    known: dict[str, checker.Statement] = field(default_factory=dict)

    def add(self, rule: MapRule, budget: int = BUDGET) -> str:
        """Certifies one more statement; the premise that is open, or nothing."""
        text = "\n\n".join(one.text() for one in [*self.rules, rule])
        statement = checker.read_statements(text)[rule.name]
        try:
            found = search_map_rule(statement, self.known, budget)
        except checker.Rejected as reason:
            return str(reason)
        if "certified" not in found:
            return str(found["unknown"])
        outcome, reason_ = checker.check_one(statement, found, self.known, self.known)
        if outcome != "certified":
            return str(reason_)
        self.rules.append(rule)
        self.certificates[rule.name] = found
        self.known[rule.name] = statement
        return ""


def with_point_licences(domain: str, point: Point) -> str:
    """The domain, with what the point's terms divide by said to be positive."""
    for text in (*point.terms, *(under for _, under in point.roots)):
        _, below = sympy.fraction(sympy.together(expression(text)))
        for divisor, _ in sympy.factor_list(below)[1]:
            domain = conjunction(domain, licence(divisor, domain))
    return domain


def known_of(system: Map, fixed: FixedPoint, setting: Setting) -> tuple[str, ...]:
    """What premises are to know of a point whose terms are not simple: that it is a fixed point, and
    on which side of the guard and of the bounds of the space it lies.
    """
    simple = all("/" not in term for term in fixed.point.terms) and not fixed.point.roots
    if simple:
        return ()
    names = {name: f"{name}_point" for name in system.state}
    lines = []
    for name, image in zip(system.state, system.images[fixed.piece]):
        above, below = sympy.fraction(sympy.together(image))
        left = f"{name}_point" if below == 1 else f"{name}_point*({written(below)})"
        lines.append(f"{left} = {written(above)}")
    guard, _ = system.pieces[fixed.piece]
    points = setting.states.points
    for poly, _ in atoms(conjunction(system.space, guard)):
        if poly.free_symbols & set(symbols(system.state)):
            at_point = points | {name: points[name + "_point"] for name in system.state}
            with np.errstate(all="ignore"):
                worst = float(np.min(np.asarray(value(written(poly), at_point), float)))
            lines.append(f"{written(poly)} {'>' if worst > 0 else '>='} 0")
    put = [re.sub(r"[A-Za-z]\w*", lambda m: names.get(m[0], m[0]), line) for line in lines]
    return tuple(dict.fromkeys(put))


def setting_of(system: Map, fixed: FixedPoint) -> Setting:
    """The samples for a search."""
    point = fixed.point
    domain = with_point_licences(system.domain, point)
    parameters = region(domain, system.parameters, PARAMETERS)
    states = around(system, point, parameters, STATES)
    bare = Setting(system, point, fixed.piece, (), domain, parameters, states)
    return replace(bare, have=known_of(system, fixed, bare))


def search_stability(system: Map, report: Report = lambda text: None) -> tuple[Proof, str]:
    """A proof that the fixed point is stable and attracts the whole space, if one is found, and
    what was tried.
    """
    system = with_licences(system)
    parameters = region(system.domain, system.parameters, PARAMETERS)
    every = [p for p in fixed_points(system) if p.exists(system, parameters).all()]
    proof = Proof()
    fault = proof.add(system.rule(f"{system.name}/map"))
    if fault:
        return proof, fault
    for fixed in every:
        if fixed.multiplier(system, parameters).max() > 1:
            continue
        setting = setting_of(system, fixed)
        for rule in candidates(setting, system.space, f"{system.name}/lyapunov", report):
            fault = proof.add(rule)
            report(f"  {fault or 'certified'}")
            if not fault:
                return proof, ""
    return proof, "no function found"


def candidates(setting: Setting, on: str, name: str, report: Report) -> Iterator[MapRule]:
    """Statements `lyapunov` that samples do not refute, the simplest kind first."""
    system, point = setting.system, setting.point
    if is_affine(system):
        for rule in norm_rules(setting, on, name):
            report("norm of " + " | ".join(t for key, t in rule.rows if key == "value"))
            yield rule
    tests = around(system, point, region(setting.domain, system.parameters, 500), 20)
    positive = [n for n in system.state if ends_of(system.space, n)[0] == 0]
    for template in quadratic_templates(system, setting.piece, positive):
        for terms in lyapunov_functions(template, system, setting.states.points, tests.points):
            function = Function(tuple(terms), template.parts, template.divisor)
            for rule in lyapunov_rules(setting, function, on, name):
                said = dict(rule.rows)
                report(f"V = {' | '.join(terms)}, loss {said['loss']}, radius {said['radius']}")
                yield rule
