"""The search: the map alone is given; found are the point, a function or a norm, and statements for
which the checker takes certificates.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
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
from juggleproof.certificates.states import state_of
from juggleproof.certificates.votes.z3 import vote_and_model
from juggleproof.certificates.work import Budget, Exhausted, unfolded
from juggleproof.proofs.orbit_rules import why
from juggleproof.proofs.stability.by_sign import proof_by_signs
from juggleproof.proofs.stability.chetaev import chetaev_rules
from juggleproof.proofs.stability.domains import middle_of, narrowed
from juggleproof.proofs.stability.envelopes import envelope_rules
from juggleproof.proofs.stability.given import (
    ANYWHERE,
    Map,
    atoms,
    checker_text,
    conjunction,
    conjuncts,
    expression,
    negation,
    renamed,
    symbols,
    value,
    written,
)
from juggleproof.proofs.stability.norms import is_affine, local_rules, norm_rules
from juggleproof.proofs.stability.part_metric import part_metric_rules
from juggleproof.proofs.stability.points import PARAMETERS, FixedPoint, fixed_points
from juggleproof.proofs.stability.refuting import (
    escape_rules,
    instability_rules,
    short_words,
    words_of_stray_orbits,
)
from juggleproof.proofs.stability.samples import (
    around,
    divides,
    licence,
    region,
    with_licences,
    with_point_licences,
)
from juggleproof.proofs.stability.saturated import saturated_rules
from juggleproof.proofs.stability.values import (
    Function,
    Setting,
    equation_rules,
    lyapunov_functions,
    lyapunov_rules,
    quadratic_templates,
    sum_of_quotients,
)

MOST_WORK, SQUARES_COST = 4_000_000, 8  # on all candidates; of a unit at the effort of squares
STATES = 40  # samples for each of the parameters
BUDGET = 2_000_000  # counted work for a premise
LOCAL_BUDGET, LOCAL_TRIED = 200_000, 3
SATURATED_BUDGET = 1_000_000
ENVELOPES, ENVELOPE_BUDGET = 4, 4_000_000  # that are tried, and counted work for a premise of one
GROWTH_BUDGET, GROWTH_WORK = 400_000, 2_000_000  # for instability
MOST_REFUTED, MOST_RATES = 3, 6  # fixed points, and rates of growth from each
EFFORTS = (1, 2, SQUARED)
ROUNDS = (  # efforts, budget, and how many of the candidates get it
    ((1,), 20_000, 24),
    ((1, 2), 50_000, 12),
    (EFFORTS, 100_000, 6),
    (EFFORTS, 400_000, 4),
)
MOST_BOXES, BOX_BUDGET = 3, 300_000
Report = Callable[[str], None]


@dataclass
class Proof:
    """Statements with certificates, in order."""

    rules: list[MapRule] = field(default_factory=list)
    certificates: dict[str, Certificate] = field(default_factory=dict)
    known: dict[str, checker.Statement] = field(default_factory=dict)
    budget: int = BUDGET  # of a premise where nothing less is said; what is less grows with it
    open: tuple[str, str, checker.Statement] | None = None  # the last premise without a proof
    work: int = 0  # that was spent on premises

    def add(
        self,
        rule: MapRule,
        efforts: Sequence[int] = EFFORTS,
        budget: int = BUDGET,
        signs: Mapping[str, Sequence[str]] | None = None,
    ) -> str:
        """Certifies one more statement; the premise that is open, or nothing.  signs: for some
        premises, polynomials whose signs are the cases of a proof.
        """
        text = "\n\n".join(one.text() for one in [*self.rules, rule])
        proofs: dict[str, Premise] = {}
        self.open = None
        try:
            statement = checker.read_statements(text)[rule.name]
            premises = checker.premises_of(statement, self.known)
            # those first that fail most often
            for name in sorted(premises, key=lambda name: not name.startswith("falls")):
                proof = None
                if signs and name in signs:
                    proof = proof_by_signs(premises[name], self.known, signs[name])
                work = budget * self.budget // BUDGET
                proof = proof or self.proof_of(premises[name], efforts, work)
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

    def free_name(self, name: str) -> str:
        """The name, with a number where a statement has it already."""
        count = sum(one == name or one.startswith(f"{name}-") for one in self.known)
        return f"{name}-{count + 1}" if count else name

    def domain(self) -> str:
        """For which parameters the last statement holds."""
        return dict(self.rules[-1].rows)["domain"]

    def add_all(self, rules: Sequence[MapRule], efforts: Sequence[int], report: Report) -> bool:
        """Certifies all of these statements, or none."""
        kept = self.rules.copy(), self.certificates.copy(), self.known.copy()
        for rule in rules:
            if dict(rule.rows).get("value"):
                fault = tried(self, rule, efforts, ENVELOPE_BUDGET, report)
            else:
                fault = self.add(rule, efforts, LOCAL_BUDGET)
            if fault:
                self.rules, self.certificates, self.known = kept
                return False
        return True

    def why(self) -> str:
        """What Z3 says of the last premise without a proof, and its text."""
        if self.open is None:
            return ""
        kind, name, premise = self.open
        line = why(kind, name, premise, vote_and_model(premise), self.budget)
        return f"{line.removesuffix(', or a lemma')}\n{premise.text()}"

    def proof_of(
        self, premise: checker.Statement, efforts: Sequence[int], budget: int
    ) -> Premise | None:
        """A proof of one premise, if one is found."""
        if terms_of_pairs(premise) // 16 > budget:
            return None  # the first program would be too large
        for effort in efforts:
            if effort == SQUARED and premise.get("exists"):
                continue  # there are no squares to find
            part, proof = Budget(budget), None
            try:
                proof = search_proof(premise, self.known, part, effort=effort)
            except Exhausted:
                pass
            self.work += (budget - part.left) * (SQUARES_COST if effort == SQUARED else 1)
            if proof is not None:
                return proof
        return None


def terms_of_pairs(premise: checker.Statement) -> int:
    """How many terms the products of two facts have that a premise without cases begins with."""
    if premise.get("exists"):
        return 0
    unfolding = unfolded(premise)
    state = state_of(unfolding).assume(unfolding.goal(False))
    return 0 if state.choices else sum(len(poly.terms) for poly, _ in state.facts) ** 2 // 2


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
    given, guards = system.domain, [guard for guard, _ in system.pieces]
    system = with_licences(system)
    parameters = region(system.domain, system.parameters, PARAMETERS)
    proof = Proof(budget=budget)
    if not all(map(len, parameters.values())):
        hint = "; put in what an equation fixes" if " = " in given else ""
        none = f"no parameters were found in the domain {given}{hint}"
        return Outcome(proof, "unknown", none, [])
    lines: list[str] = []

    def log(text: str) -> None:
        lines.append(text)
        report(text)

    fault = proof.add(system.rule(f"{system.name}/map"))
    if fault:
        line, _, text = (proof.why() or fault).partition("\n")
        if guards != [guard for guard, _ in system.pieces]:
            line += "; a piece applies only where it divides by nothing that is 0"
        return Outcome(proof, "unknown", f"the map: {line}", [text] if text else [])
    every = [one for one in fixed_points(system) if one.exists(system, parameters).any()]
    if not every:
        if not system.point and not proof.add(without_fixed_point(system)):
            return Outcome(proof, "refuted", "no state of the space is a fixed point", lines)
        what = ", ".join(system.point)
        none = f"{what} is no fixed point in the space"
        if not what:
            none = "no isolated fixed point in square roots was found in the space"
        return Outcome(proof, "unknown", none, lines)
    for fixed in sorted(every, key=lambda one: -one.stable_share(system, parameters)):
        if not fixed.stable_share(system, parameters):
            break
        split = narrowed(system, fixed, parameters)
        closed = narrowed(system, fixed, parameters, closed=True)
        found = None
        if closed != split:  # the multiplier is -1 at the end
            found = settled(proof, system, fixed, closed, given, log, closed=True)
        if found:
            return Outcome(proof, *found, lines)
        log(f"fixed point {name_of(fixed)}" + "".join(f", where {one}" for one in split))
        found = settled(proof, system, fixed, split, given, log)
        if found:
            return Outcome(proof, *found, lines)
    faults = []
    # of several fixed points it says little that one does not attract another
    ways = (by_growth, by_orbit) if len(every) > 1 else (by_orbit, by_growth, by_short_orbit)
    for fixed in every[:MOST_REFUTED]:
        if fixed.exists(system, parameters).all():
            setting = setting_of(system, fixed, system.domain)
            fault = refuted(proof, setting, log, ways)
            if fault:
                where = beyond(given, proof.domain(), system.parameters)
                at = f"at least where {where}, " if where else ""
                faults.append(f"{at}{name_of(fixed)} {fault}")
    if faults:
        return Outcome(proof, "refuted", "; ".join(faults), lines)
    for fixed in every:
        if fixed.stable_share(system, parameters):
            inner = conjunction(system.domain, *narrowed(system, fixed, parameters))
            middle = conjunction(inner, *middle_of(system, inner))
            for domain in dict.fromkeys((inner, middle)):
                setting = setting_of(system, fixed, domain)
                near = near_by(proof, setting, name_of(fixed), given, log)
                if near:
                    sentence = f"{near}; of other states nothing was found"
                    return Outcome(proof, "region", sentence, lines)
    return Outcome(proof, "unknown", "", lines)


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
            where = beyond(given, setting.domain, setting.system.parameters)
            on = with_bars(dict(rule.rows)["on"])
            for one, gap in gaps.items():
                on = on.replace(f"|{one}|", f"|{gap}|")
            on = renamed(on, {one: in_brackets(gap) for one, gap in gaps.items()})
            at = f"at least where {where}, " if where else ""
            return f"{at}{name} is stable, and attracts every state with {on}"
    return ""


def name_of(fixed: FixedPoint) -> str:
    """The point as a person reads it."""
    return in_brackets(", ".join(fixed.point.terms))


def in_brackets(text: str) -> str:
    """The text, in brackets where it is a sum or a list, or has a sign."""
    return f"({text})" if " " in text or text.startswith("-") else text


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
    where = beyond(given, setting.domain, system.parameters)
    name = name_of(fixed)
    if not split:
        fault = by_orbit(proof, setting, log)
        if fault:
            there = beyond(given, proof.domain(), system.parameters)
            more = near_by(proof, setting, name, given, log)
            at = f"at least where {there}, " if there else ""
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
            if not in_boxes(proof, smaller, log):
                return None
            where = beyond(given, smaller.domain, system.parameters)
            return "stable", f"{name} is stable and attracts every state at least where {where}"
        setting, where = smaller, beyond(given, smaller.domain, system.parameters)
    if not where:
        return "stable", f"{name} is stable and attracts every state"
    for parts in ([negation(where)], complement(where)):
        kinds = outside_refuted(proof, system, fixed, parts, log)
        if kinds and sharp(proof, setting, kinds, log):
            inside = beyond(system.domain, setting.domain, system.parameters)
            divides = beyond(given, system.domain, system.parameters)
            of = f", of all parameters with {divides}" if divides else ""
            sentence = f"{name} is stable and attracts every state if and only if {inside}{of}"
            return "exactly", sentence
    return "stable", f"{name} is stable and attracts every state at least where {where}"


COMPLEMENTS = {ast.Gt: "= <", ast.GtE: "<", ast.Lt: "= >", ast.LtE: ">", ast.NotEq: "="}


def complement(conditions: str) -> list[str]:
    """Formulas of which one holds where the conditions do not: for each of them its boundary and
    its strict outside.
    """
    parts = []
    for condition in conjuncts(conditions):
        node = checker.parse(condition)
        if isinstance(node, ast.Compare) and not node.ops[1:] and type(node.ops[0]) in COMPLEMENTS:
            left, right = checker_text(node.left), checker_text(node.comparators[0])
            parts += [f"{left} {op} {right}" for op in COMPLEMENTS[type(node.ops[0])].split()]
        else:
            parts.append(f"not ({condition})")
    return parts


def outside_refuted(
    proof: Proof, system: Map, fixed: FixedPoint, parts: Sequence[str], log: Report
) -> list[tuple[str, str]]:
    """The lines that name the refutations for all of these parts of the domain that have
    parameters; nothing where one of them has none.
    """
    lines = []
    for part in parts:
        setting = setting_of(system, fixed, conjunction(system.domain, part))
        if setting.count:
            if not refuted(proof, setting, log):
                return []
            name = proof.rules[-1].name
            lines.append((NAMED[proof.known[name].kind], name))
    return lines


def sharp(
    proof: Proof, setting: Setting, refutations: Sequence[tuple[str, str]], log: Report
) -> bool:
    """Whether stability and attraction on one part of the domain, and their failure on the rest,
    are put together.
    """
    system, name = setting.system, setting.system.name
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
    ]
    if f"{name}/attracts" in proof.known:
        rows = []
    rows += [
        ("exactly", (("attraction", f"{name}/attracts"), *refutations)),
    ]
    for label, lines in rows:
        if f"{name}/{label}" in proof.known:
            continue
        fault = proof.add(MapRule(f"{name}/{label}", lines))
        if fault:
            log(f"{label}: {fault}")
            return False
    return True


NAMED = {"escapes": "escape", "unstable": "unstable"}  # lines of `exactly` that name such a rule


def by_orbit(proof: Proof, setting: Setting, log: Report) -> str:
    """An orbit that samples tend to, or another fixed point, that the point does not attract, or
    nothing.
    """
    fixed = [(k,) for k in range(len(setting.system.pieces))]
    return escaped(proof, setting, dict.fromkeys([*words_of_stray_orbits(setting), *fixed]), log)


def by_short_orbit(proof: Proof, setting: Setting, log: Report) -> str:
    """A short periodic orbit, stable or not, or nothing."""
    return escaped(proof, setting, short_words(setting), log)


def escaped(proof: Proof, setting: Setting, words: Iterable[tuple[int, ...]], log: Report) -> str:
    """A periodic orbit along one of these words, or nothing."""
    name = proof.free_name(f"{setting.system.name}/escapes")
    for rule in escape_rules(setting, name, words):
        fault = proof.add(rule)
        said = dict(rule.rows)
        log(f"orbit of {said['start']} along {said['word']}: {fault or 'certified'}")
        if not fault:
            what = "periodic" if " " in said["word"] else "a fixed point"
            return f"does not attract {in_brackets(said['start'])}, which is {what}"
    return ""


def by_growth(proof: Proof, setting: Setting, log: Report) -> str:
    """That orbits leave a neighbourhood of the point, or nothing."""
    rules = chetaev_rules if len(setting.system.state) > 1 else instability_rules
    name = proof.free_name(f"{setting.system.name}/unstable")
    before = proof.work
    for rule in islice(rules(setting, name), MOST_RATES):
        if proof.work - before > GROWTH_WORK:
            break
        fault = proof.add(rule, EFFORTS, GROWTH_BUDGET)
        log(f"instability at rate {dict(rule.rows)['rate']}: {fault or 'certified'}")
        if not fault:
            return "is not stable"
    return ""


Way = Callable[[Proof, Setting, Report], str]


def refuted(
    proof: Proof,
    setting: Setting,
    log: Report,
    ways: Sequence[Way] = (by_orbit, by_growth, by_short_orbit),
) -> str:
    """How the point fails to be stable and to attract every state, for all parameters, or
    nothing.
    """
    return next(filter(None, (way(proof, setting, log) for way in ways)), "")


def attracted(proof: Proof, setting: Setting, log: Report) -> bool:
    """Whether the point is certified to be stable and to attract every state."""
    name, space = f"{setting.system.name}/lyapunov", setting.system.space
    if is_affine(setting.system):
        for rule in norm_rules(setting, name):
            if not tried(proof, rule, EFFORTS, BUDGET, log):
                return True
        for rule, signs in saturated_rules(setting, space, name):
            if not tried(proof, rule, (1, 2), SATURATED_BUDGET, log, signs):
                return True
        before = proof.work
        for rule in equation_rules(setting, space, name):
            if proof.work - before < MOST_WORK and not tried(proof, rule, EFFORTS, BUDGET, log):
                return True
    if in_boxes(proof, setting, log):
        return True
    every = {rule: rank for rank, rule in candidates(setting, space, name)}  # each once
    found = sorted(((rank, rule) for rule, rank in every.items()), key=lambda one: one[0])
    before = proof.work
    for count, (efforts, budget, most) in enumerate(ROUNDS):
        for _, rule in found[:most]:
            if proof.work - before < MOST_WORK and not tried(proof, rule, efforts, budget, log):
                return True
        if count == 1 and any(enveloped(proof, setting, log, closed) for closed in (False, True)):
            return True
    if not found:
        log("no quadratic function, by pieces or over bounds of the space, falls at all samples")
        return False
    best = found[0][1]
    fault = proof.add(best, *ROUNDS[0][:2])
    log(f"{function_of(best)}: {proof.why() or fault}")
    return not fault


def enveloped(proof: Proof, setting: Setting, log: Report, closed: bool) -> bool:
    """Whether the point of a map of one variable is certified, by an envelope, to be stable and to
    attract every state; `closed`: with the loss of a multiplier that may be -1.
    """
    rules = islice(envelope_rules(setting, setting.system.name, closed), ENVELOPES)
    return any(proof.add_all(one, (1, 2), log) for one in rules)


def in_boxes(proof: Proof, setting: Setting, log: Report) -> bool:
    """The same, by functions whose sublevel sets are boxes."""
    name, space = f"{setting.system.name}/lyapunov", setting.system.space
    boxes = sorted(part_metric_rules(setting, space, name), key=lambda one: one[0])
    return any(not tried(proof, rule, (1, 2), BOX_BUDGET, log) for _, rule in boxes[:MOST_BOXES])


def tried(
    proof: Proof,
    rule: MapRule,
    efforts: Sequence[int],
    budget: int,
    report: Report,
    signs: Mapping[str, Sequence[str]] | None = None,
) -> str:
    """Tries to certify a candidate."""
    fault = proof.add(rule, efforts, budget, signs)
    report(f"{function_of(rule)}: {fault or 'certified'}")
    return fault


def function_of(rule: MapRule) -> str:
    """The function of a candidate, and its loss."""
    values = "; ".join(text for keyword, text in rule.rows if keyword == "value")
    greatest = f"the greatest of {values}" if "; " in values else values
    return f"V = {greatest}, loss {dict(rule.rows)['loss']}"


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
    templates = [
        *enumerate(quadratic_templates(system, setting.piece, positive)),
        *((0.0, template) for template in sum_of_quotients(system)),
    ]
    for kind, template in templates:
        for terms in lyapunov_functions(template, system, setting.states.points, tests.points):
            function = Function(tuple(terms), template.parts, template.divisor)
            for rank, rule in lyapunov_rules(setting, function, on, name):
                yield rank + kind + len(" ".join(terms)) / 100, rule
