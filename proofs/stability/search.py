"""The search: the map alone is given; found are the point, a function or a norm, and statements for
which the checker takes certificates.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice

import numpy as np
import sympy

from juggleproof.certificates import checker
from juggleproof.certificates.language import MapRule
from juggleproof.certificates.nodes import Certificate
from juggleproof.certificates.nodes import Proof as Premise
from juggleproof.certificates.search.certificate import search_certificate, search_proof
from juggleproof.certificates.search.closing import SQUARED
from juggleproof.certificates.votes.z3 import vote_and_model
from juggleproof.certificates.work import Budget, Exhausted
from juggleproof.proofs.orbit_rules import why
from juggleproof.proofs.stability.by_sign import proof_by_signs
from juggleproof.proofs.stability.domains import narrowed
from juggleproof.proofs.stability.given import (
    ANYWHERE,
    Map,
    atoms,
    conjunction,
    conjuncts,
    expression,
    symbols,
    value,
    written,
)
from juggleproof.proofs.stability.norms import is_affine, local_rules, norm_rules
from juggleproof.proofs.stability.points import FixedPoint, fixed_points
from juggleproof.proofs.stability.refuting import escape_rules, instability_rules
from juggleproof.proofs.stability.samples import (
    Point,
    around,
    licence,
    region,
    with_licences,
)
from juggleproof.proofs.stability.saturated import saturated_rules
from juggleproof.proofs.stability.values import (
    Function,
    Setting,
    equation_rules,
    lyapunov_functions,
    lyapunov_rules,
    quadratic_templates,
)

PARAMETERS, STATES = 150, 40  # samples
BUDGET = 2_000_000  # counted work for a premise
LOCAL_BUDGET, LOCAL_TRIED = 1_000_000, 4
EFFORTS = (1, 2, SQUARED)
ROUNDS = (  # efforts, budget, and how many of the candidates get it
    ((1,), 20_000, 24),
    ((1, 2), 100_000, 16),
    (EFFORTS, 400_000, 4),
)
Report = Callable[[str], None]


@dataclass
class Proof:
    """Statements with certificates, in order."""

    rules: list[MapRule] = field(default_factory=list)
    certificates: dict[str, Certificate] = field(default_factory=dict)
    known: dict[str, checker.Statement] = field(default_factory=dict)
    open: tuple[str, str, checker.Statement] | None = None  # the last premise without a proof

    def add(
        self,
        rule: MapRule,
        efforts: Sequence[int] = EFFORTS,
        budget: int = BUDGET,
        signs: Mapping[str, Sequence[str]] = {},
    ) -> str:
        """Certifies one more statement; the premise that is open, or nothing.  signs: for some
        premises, polynomials whose signs are the cases of a proof.
        """
        text = "\n\n".join(one.text() for one in [*self.rules, rule])
        proofs: dict[str, Premise] = {}
        try:
            statement = checker.read_statements(text)[rule.name]
            premises = checker.premises_of(statement, self.known)
            # those first that fail most often
            for name in sorted(premises, key=lambda name: not name.startswith("falls")):
                proof = None
                if name in signs:
                    proof = proof_by_signs(premises[name], self.known, signs[name])
                proof = proof or self.proof_of(premises[name], efforts, budget)
                if proof is None:
                    self.open = statement.kind, name, premises[name]
                    return f"no proof of the premise {name} was found"
                proofs[name] = proof
        except checker.Rejected as fault:
            return str(fault)
        found: Certificate = {"certified": {name: proofs[name] for name in premises}}
        outcome, reason = checker.check_one(statement, found, self.known, self.known)
        if outcome != "certified":
            return str(reason)
        self.rules.append(rule)
        self.certificates[rule.name] = found
        self.known[rule.name] = statement
        return ""

    def why(self) -> str:
        """What Z3 says of the last premise without a proof."""
        if self.open is None:
            return ""
        kind, name, premise = self.open
        return why(kind, name, premise, vote_and_model(premise), BUDGET)

    def proof_of(
        self, premise: checker.Statement, efforts: Sequence[int], budget: int
    ) -> Premise | None:
        """A proof of one premise, if one is found."""
        for effort in efforts:
            if effort == SQUARED and premise.get("exists"):
                continue  # there are no squares to find
            try:
                proof = search_proof(premise, self.known, Budget(budget), effort=effort)
            except Exhausted:
                continue
            if proof is not None:
                return proof
        return None


def with_point_licences(domain: str, point: Point) -> str:
    """The domain, with what the point's terms divide by said to be positive."""
    for text in (*point.terms, *(under for _, under in point.roots)):
        _, below = sympy.fraction(sympy.together(expression(text)))
        for divisor, _ in sympy.factor_list(below)[1]:
            domain = conjunction(domain, licence(divisor, domain))
    return domain


def known_of(system: Map, fixed: FixedPoint, setting: Setting) -> tuple[str, ...]:
    """What premises are to know of a point whose terms are not simple: that it is a fixed point,
    and on which side of the guard and of the bounds of the space it lies.
    """
    terms = [expression(term) for term in fixed.point.terms]
    if all("/" not in written(t) or not t.free_symbols for t in terms) and not fixed.point.roots:
        return ()
    names = {name: f"{name}_point" for name in system.state}
    lines = []
    for name, image in zip(system.state, system.images[fixed.piece]):
        above, below = sympy.fraction(sympy.together(image))
        left = f"{name}_point" if below == 1 else f"{name}_point*({written(below)})"
        lines.append(f"{left} = {written(above)}")
    state = symbols(system.state)
    if not sympy.Matrix(system.images[fixed.piece]).jacobian(state).free_symbols.isdisjoint(state):
        for name, term in zip(system.state, terms):  # the equations have other solutions
            above, below = sympy.fraction(term)
            lines.append(f"{name}_point*({written(below)}) = {written(above)}")
    guard, _ = system.pieces[fixed.piece]
    points = setting.states.points
    for poly, _ in atoms(conjunction(system.space, guard)):
        if poly.free_symbols & set(symbols(system.state)):
            at_point = points | {name: points[name + "_point"] for name in system.state}
            with np.errstate(all="ignore"):
                at = np.asarray(value(written(poly), at_point), float)
                worst = float(np.min(at, initial=np.inf))
            lines.append(f"{written(poly)} {'>' if worst > 0 else '>='} 0")
    return tuple(dict.fromkeys(renamed(line, names) for line in lines))


def renamed(text: str, names: Mapping[str, str]) -> str:
    """The text with other names in place of some."""
    return re.sub(r"[A-Za-z]\w*", lambda found: names.get(found[0], found[0]), text)


def setting_of(system: Map, fixed: FixedPoint, domain: str, by_samples: bool = False) -> Setting:
    """The samples for a search over parameters in a domain; `by_samples`: where parameters are
    positive at samples, they are taken to be.
    """
    point = fixed.point
    domain = with_point_licences(domain, point)
    parameters = region(domain, system.parameters, PARAMETERS)
    for name in system.parameters:  # so that constants may divide by it
        positive = conjunction(domain, licence(expression(name), domain))
        if (parameters[name] > 0).all():
            if by_samples or not beyond(domain, positive, system.parameters):
                domain = positive
    states = around(system, point, parameters, STATES)
    bare = Setting(system, point, fixed.piece, (), domain, parameters, states)
    return replace(bare, have=known_of(system, fixed, bare))


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


def search_stability(system: Map, report: Report = lambda text: None) -> Outcome:
    """What `outcome_of` finds, with the roots in its sentence."""
    found = outcome_of(system, report)
    rows = [row for rule in found.proof.rules for row in rule.rows]
    for root in dict.fromkeys(text for keyword, text in rows if keyword == "root"):
        if root.partition(" = ")[0] in checker.names_in(found.sentence):
            found.sentence += f"; {root}"
    return found


def outcome_of(system: Map, report: Report) -> Outcome:
    """A proof that a fixed point is stable and attracts the whole space, or that none does, or what
    comes nearest to either.
    """
    given, system = system.domain, with_licences(system)
    parameters = region(system.domain, system.parameters, PARAMETERS)
    proof = Proof()
    if not all(map(len, parameters.values())):
        return Outcome(proof, "unknown", f"no parameters were found in the domain {given}", [])
    lines: list[str] = []

    def log(text: str) -> None:
        lines.append(text)
        report(text)

    fault = proof.add(system.rule(f"{system.name}/map"))
    if fault:
        return Outcome(proof, "unknown", f"the map: {proof.why() or fault}", lines)
    every = fixed_points(system)
    if system.point:
        every = [one for one in every if one.is_at(system.point)]
    every = [one for one in every if one.exists(system, parameters).any()]
    if not every:
        what = ", ".join(system.point)
        none = f"{what} is no fixed point" if what else "no fixed point was found in the space"
        return Outcome(proof, "unknown", none, lines)
    for fixed in sorted(every, key=lambda one: -one.stable_share(system, parameters)):
        if not fixed.stable_share(system, parameters):
            break
        split = narrowed(system, fixed, parameters)
        log(f"fixed point {name_of(fixed)}" + "".join(f", where {one}" for one in split))
        found = settled(proof, system, fixed, split, given, log)
        if found:
            return Outcome(proof, *found, lines)
    for fixed in every:
        if fixed.exists(system, parameters).all():
            setting = setting_of(system, fixed, system.domain)
            fault = refuted(proof, setting, log)
            if fault:
                where = beyond(given, setting.domain, system.parameters)
                sentence = f"{name_of(fixed)} {fault}{where and f' where {where}'}"
                return Outcome(proof, "refuted", sentence, lines)
    for fixed in every:
        if fixed.exists(system, parameters).all():
            setting = setting_of(system, fixed, system.domain)
            near = near_by(proof, setting, name_of(fixed), given, log)
            if near:
                return Outcome(proof, "region", f"{near}; of the others nothing was found", lines)
    return Outcome(proof, "unknown", "", lines)


def near_by(proof: Proof, setting: Setting, name: str, given: str, log: Report) -> str:
    """What is certified of states close to the point, or nothing."""
    pairs = zip(setting.system.state, setting.point.terms)
    gaps = {f"{one}_gap": one if e == "0" else f"({one} - ({e}))" for one, e in pairs}
    rules = local_rules(setting, f"{setting.system.name}/lyapunov")
    for rule in islice(rules, LOCAL_TRIED):
        if not tried(proof, rule, EFFORTS, LOCAL_BUDGET, log):
            where = beyond(given, setting.domain, setting.system.parameters)
            on = renamed(dict(rule.rows)["on"], gaps)
            at = f" where {where}" if where else ""
            return f"{name} is stable{at}, and attracts every state with {on}"
    return ""


def name_of(fixed: FixedPoint) -> str:
    """The point as a person reads it."""
    terms = ", ".join(fixed.point.terms)
    return f"({terms})" if len(fixed.point.terms) > 1 or " " in terms else terms


def beyond(given: str, domain: str, parameters: Sequence[str]) -> str:
    """What the domain asks of the parameters that the checker does not certify to hold on the given
    one: a licence rests on samples, which miss an end point.
    """
    before, open_ = conjuncts(given), []
    facts = [f"given {one}" for one in before]
    for condition in conjuncts(domain):
        if condition in before or condition == ANYWHERE:
            continue
        lines = [f"forall {' '.join(parameters)}", *facts, f"show {condition}"]
        try:
            statement = checker.read_statements("\n".join(["statement a/a", *lines]))["a/a"]
            found = search_certificate(statement, {}, Budget(BUDGET))
        except checker.Rejected:  # it divides by what may be 0
            open_.append(condition)
            continue
        if checker.check_one(statement, found, {}, {})[0] != "certified":
            open_.append(condition)
    return " and ".join(open_)


def settled(
    proof: Proof, system: Map, fixed: FixedPoint, split: Sequence[str], given: str, log: Report
) -> tuple[str, str] | None:
    """Verdict and sentence for one fixed point, where something is certified; `given` is the domain
    as the user gives it.
    """
    inner = conjunction(system.domain, *split)
    setting = setting_of(system, fixed, inner)
    where = beyond(given, setting.domain, system.parameters)
    name = name_of(fixed)
    if not split:
        fault = refuted(proof, setting, log, STRAY_ONLY)
        if fault:
            more = near_by(proof, setting, name, given, log)
            sentence = f"{name} {fault}{where and f' where {where}'}"
            return "refuted", sentence + (f"; {more}" if more else "")
    if not attracted(proof, setting, log):
        smaller = setting_of(system, fixed, inner, by_samples=True)
        if smaller.domain == setting.domain or not attracted(proof, smaller, log):
            return None
        setting, where = smaller, beyond(given, smaller.domain, system.parameters)
    if not where:
        return "stable", f"{name} is stable and attracts every state"
    outer = conjunction(system.domain, f"not ({where})")
    outside = setting_of(system, fixed, outer)
    fault = refuted(proof, outside, log) if outside.count else ""
    kind = "escape" if f"{system.name}/escapes" in proof.known else "unstable"
    if fault and sharp(proof, setting, kind, log):
        return "exactly", f"{name} is stable and attracts every state if and only if {where}"
    return "stable", f"{name} is stable and attracts every state at least where {where}"


def sharp(proof: Proof, setting: Setting, kind: str, log: Report) -> bool:
    """Whether stability and attraction on one part of the domain, and their failure on the rest,
    are put together.
    """
    system, name = setting.system, setting.system.name
    of = "escapes" if kind == "escape" else kind
    rows: list[tuple[str, tuple[tuple[str, str], ...]]] = [
        (
            "descends",
            (
                ("map", f"{name}/map"),
                ("domain", setting.domain),
                ("rank", "0"),
                ("stage", system.space),
            ),
        ),
        ("attracts", (("descent", f"{name}/descends"), ("lyapunov", f"{name}/lyapunov"))),
        ("exactly", (("attraction", f"{name}/attracts"), (kind, f"{name}/{of}"))),
    ]
    for label, lines in rows:
        fault = proof.add(MapRule(f"{name}/{label}", lines))
        if fault:
            log(f"{label}: {fault}")
            return False
    return True


STRAY_ONLY = True


def refuted(proof: Proof, setting: Setting, log: Report, stray: bool = False) -> str:
    """How the point fails to be stable and to attract every state, for all parameters, or nothing;
    `stray`: by an orbit alone.
    """
    name = f"{setting.system.name}/"
    for rule in escape_rules(setting, name + "escapes"):
        fault = proof.add(rule)
        said = dict(rule.rows)
        log(f"orbit of {said['start']} along {said['word']}: {fault or 'certified'}")
        if not fault:
            return f"does not attract ({said['start']}), which is periodic"
    if stray:
        return ""
    for rule in islice(instability_rules(setting, name + "unstable"), 6):
        fault = proof.add(rule)
        log(f"instability at rate {dict(rule.rows)['rate']}: {fault or 'certified'}")
        if not fault:
            return "is not stable"
    return ""


def attracted(proof: Proof, setting: Setting, log: Report) -> bool:
    """Whether the point is certified to be stable and to attract every state."""
    name, space = f"{setting.system.name}/lyapunov", setting.system.space
    if is_affine(setting.system):
        for rule in norm_rules(setting, name):
            if not tried(proof, rule, EFFORTS, BUDGET, log):
                return True
        for rule, signs in saturated_rules(setting, space, name):
            if not tried(proof, rule, (1, 2), LOCAL_BUDGET, log, signs):
                return True
        for rule in equation_rules(setting, space, name):
            if not tried(proof, rule, EFFORTS, BUDGET, log):
                return True
    every = {rule: rank for rank, rule in candidates(setting, space, name)}  # each once
    found = sorted(((rank, rule) for rule, rank in every.items()), key=lambda one: one[0])
    for efforts, budget, most in ROUNDS:
        for _, rule in found[:most]:
            if not tried(proof, rule, efforts, budget, log):
                return True
    if found:  # of the candidate that fits best
        proof.add(found[0][1], (1,))
        log(proof.why())
    return False


def tried(
    proof: Proof,
    rule: MapRule,
    efforts: Sequence[int],
    budget: int,
    report: Report,
    signs: Mapping[str, Sequence[str]] = {},
) -> str:
    """Tries to certify a candidate."""
    fault = proof.add(rule, efforts, budget, signs)
    said = dict(rule.rows)
    report(f"V = {said['value']}, loss {said['loss']}: {fault or 'certified'}")
    return fault


def divisors(setting: Setting) -> list[str]:
    """What is positive inside the space, for functions that grow without bound at its ends: each
    of its strict bounds times the same at the point, which has no units, then their product.
    """
    system = setting.system
    put = {name: f"{name}_point" for name in system.state}
    found = []
    for poly, strict in atoms(system.space):
        text = written(poly)
        if strict and poly.is_polynomial() and checker.names_in(text) & set(system.state):
            found.append(text if text.isidentifier() else f"({text})")
    several = ["*".join(found)] if len(found) > 1 else []
    both = [f"{one}*{renamed(one, put)}" for one in found if setting.have]
    return several + found + both


def candidates(setting: Setting, on: str, name: str) -> Iterator[tuple[float, MapRule]]:
    """Statements `lyapunov` that samples do not refute, each with a number that is small where it
    is simple and fits well.
    """
    system, point = setting.system, setting.point
    tests = around(system, point, region(setting.domain, system.parameters, 500), 20)
    positive = divisors(setting)
    for kind, template in enumerate(quadratic_templates(system, setting.piece, positive)):
        for terms in lyapunov_functions(template, system, setting.states.points, tests.points):
            function = Function(tuple(terms), template.parts, template.divisor)
            for rank, rule in lyapunov_rules(setting, function, on, name):
                yield rank + kind + len(" ".join(terms)) / 40, rule
