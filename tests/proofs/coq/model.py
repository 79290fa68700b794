"""Statements and certificates as terms of Coq, for the functions that the rules of the checker are
there.

Terms that divide, and whatever is not a statement that is for all, or not of the shape of a
certificate, are not written: `NotWritten`.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction

from juggleproof.certificates import checker
from juggleproof.statements.states import SearchState
from tests.certificates.checker.harness import Json

HEAD = """From Coq Require Import QArith List Bool.
From Juggleproof Require Import Polynomials Formulas Coefficients Boxes Instances.
From Juggleproof Require Import Leaves Values Settling Ranges.
Import ListNotations.
Open Scope nat_scope.
Definition entry_of s nodes last point :=
  {| stated := s; steps := nodes; inside := last; possible := point |}.
"""
LARGEST = 30  # of an exponent or index: Coq counts in unary
RELATIONS = {">": "Positive", ">=": "Nonnegative", "=": "Zero", "!=": "Nonzero"}
Numbers = Mapping[int, int]  # {place of a variable in a context: its number in Coq}


class NotWritten(Exception):
    """What Coq's functions have no word for."""


def number(value: Json) -> str:
    if type(value) is not int or not 0 <= value <= LARGEST:
        raise NotWritten(value)
    return str(value)


def listed(parts: Collection[str]) -> str:
    return f"[{'; '.join(parts)}]"


def rational(value: Fraction) -> str:
    return f"({value.numerator} # {value.denominator})%Q"


def constant(poly: checker.Poly) -> str:
    value = poly.constant()
    if value is None:
        raise NotWritten("no number")
    return rational(value)


def polynomial(poly: checker.Poly, numbers: Numbers) -> str:
    if poly.under or poly.deg > LARGEST:
        raise NotWritten("a term that divides, or of a large degree")
    terms = []
    for monomial, coefficient in poly.terms.items():
        powers = {
            numbers[place]: monomial >> checker.BITS * place & (1 << checker.BITS) - 1
            for place in numbers
        }
        last = max((n for n, power in powers.items() if power), default=-1)
        exponents = listed([str(powers.get(n, 0)) for n in range(last + 1)])
        terms.append(f"({rational(Fraction(coefficient, poly.den))}, {exponents})")
    return listed(terms)


def formula(value: checker.Formula, numbers: Numbers) -> str:
    if isinstance(value, bool):
        return f"Truth {str(value).lower()}"
    if value[0] == "atom":
        return f"Atom {polynomial(value[1], numbers)} {RELATIONS[value[2]]}"
    return f"{value[0].title()} {listed([formula(part, numbers) for part in value[1]])}"


class Scope:
    """A state in which a certificate is read: the numbers of its variables in Coq, and the
    statements that it may use.

    Facts that a node assumes come after those of the state, so that the numbers of these stay.
    """

    def __init__(
        self, state: SearchState, numbers: Numbers, known: Sequence[checker.Statement]
    ) -> None:
        self.state = state
        self.numbers = numbers
        self.known = known

    @property
    def fresh(self) -> int:
        """The first number that no variable has."""
        return max(self.numbers.values(), default=-1) + 1

    def poly(self, text: str) -> str:
        return polynomial(self.state.context.polynomial(text), self.numbers)

    def term(self, text: str) -> str:
        """The numerator of a term, and the powers of strict facts by which it is divided."""
        value = self.state.context.value(checker.parse(text))
        numerator, under = value.over({}), []
        for (licence, _), power in value.under.items():
            index, scale = self.fact(licence)
            numerator = numerator * self.state.context.number(scale**power)
            under.append(f"({number(index)}, {number(power)})")
        return f"({polynomial(numerator, self.numbers)}, {listed(under)})"

    def fact(self, licence: checker.Poly) -> tuple[int, Fraction]:
        """The first strict fact about a multiple of a polynomial, and that multiple."""
        for index, (poly, relation) in enumerate(self.state.facts):
            if relation in (">", "!="):
                for sign in (1, -1):
                    content, primitive = poly.primitive()
                    multiple = Fraction(sign * content, poly.den)
                    if (licence * self.state.context.number(sign)).terms == primitive.terms:
                        return index, multiple
        raise NotWritten("a term that divides by a factor of a fact")

    def terms(self, values: Mapping[str, str], statement: Written) -> str:
        return listed(
            [f"({statement.index[key]}, {self.term(text)})" for key, text in values.items()]
        )

    def declared(self, names: Mapping[str, int]) -> Scope:
        """The scope with new variables of these numbers; a name that is taken grows."""
        context, numbers = checker.Context(self.state.context, {}), dict(self.numbers)
        for name, own in names.items():
            numbers[len(context.index)] = own
            context.declare(name)
        return Scope(SearchState(context, self.state), numbers, self.known)

    def by_sign(self, text: str) -> list[Scope]:
        return [Scope(case, self.numbers, self.known) for case in self.state.by_sign(text)]

    def node(self, node: Json) -> str:
        """A node of a certificate."""
        if not isinstance(node, list):
            raise NotWritten(node)
        rule, *parts = node
        if rule == "close" and not parts:
            return "Close"
        if rule == "psatz":
            return self.psatz(*parts)
        if rule == "cases":
            return f"Cases {number(parts[0])} {listed([self.node(part) for part in parts[1]])}"
        if rule == "sign":
            text, *nodes = parts
            below, zero, above = (f"({self.node(part)})" for part in nodes)
            return f"Sign {self.poly(text)} {below} {zero} {above}"
        if rule == "boxes":
            index, bounds, tree = parts
            if not isinstance(tree, str):
                raise NotWritten(tree)
            pairs = listed([f"({number(low)}, {number(high)})" for low, high in bounds])
            return f"Boxes {number(index)} {pairs} {listed([letter(mark) for mark in tree])}"
        if rule == "integral":
            index, rest = parts
            return f"Integral {number(index)} ({self.node(rest)})"
        if rule == "use":
            return self.use(*parts)
        raise NotWritten(rule)

    def psatz(self, products: Json, equations: Json) -> str:
        first = []
        for coefficient, factors, root in products:
            powers = listed([f"({number(index)}, {number(power)})" for index, power in factors])
            weight = rational(checker.rational(coefficient))
            first.append(f"({weight}, {powers}, {self.poly(root)})")
        second = [f"({number(index)}, {self.poly(cofactor)})" for index, cofactor in equations]
        return f"Psatz {listed(first)} {listed(second)}"

    def use(self, name: Json, terms: Json, names: Json, rest: Json) -> str:
        places = [place for place, one in enumerate(self.known) if one.name == name]
        if not places:
            raise NotWritten("a statement that is not known")
        statement = Written(self.known[places[0]])
        if set(terms) != set(statement.universal) or set(names) != set(statement.exist):
            raise NotWritten("values for other variables")
        inner = self.declared(
            {names[key]: self.fresh + statement.index[key] for key in sorted(names)}
        )
        values = self.terms(terms, statement)
        return f"Use {places[0]} {values} {self.fresh} ({inner.node(rest)})"

    def found(
        self,
        found: Json,
        statements: Sequence[Written],
        own: Collection[str] = (),
        witness: bool = False,
    ) -> str:
        """Values of a certificate for one of the statements: for all its variables but those that
        keep their own, or for what exists in a witness.
        """
        if found[0] == "sign":
            _, text, *parts = found
            cases = [
                f"({case.found(part, statements, own, witness)})"
                for case, part in zip(self.by_sign(text), parts, strict=True)
            ]
            return f"BySign {self.poly(text)} {' '.join(cases)}"
        if found[0] == "empty":
            _, node = found
            return f"Empty ({self.node(node)})"
        name, adjoined, terms, *nodes = found
        places = [place for place, one in enumerate(statements) if one.name == name]
        if not places:
            raise NotWritten("values for another statement")
        statement = statements[places[0]]
        needed = statement.exist if witness else set(statement.universal) - set(own)
        if set(terms) != set(needed):
            raise NotWritten("values for other variables")
        scope, roots = self, []
        for entry in adjoined:
            root, scope = scope.adjoined(*entry)
            roots.append(root)
        shown = [scope.node(part) for part in nodes[:1]]
        fails = scope.declared({key: scope.fresh + statement.index[key] for key in statement.exist})
        shown += [fails.node(part) for part in nodes[1:]]
        values = scope.terms(terms, statement)
        return f"Found {listed(roots)} {places[0]} {values} {scope.fresh} {listed(shown)}"

    def adjoined(
        self, name: str, text: str, low: str, high: str, below: Json, above: Json
    ) -> tuple[str, Scope]:
        """A root between two terms, and the scope in which it has its name."""
        after = self.declared({name: self.fresh})
        context = after.state.context
        root, ends = (
            context.values[name],
            [context.value(checker.parse(end)) for end in (low, high)],
        )
        after.state.assume(context.atom(root, ">=", ends[0]))
        after.state.assume(context.atom(root, "<=", ends[1]))
        after.state.assume(context.atom(context.polynomial(text), "=", context.number(0)))
        parts = (after.poly(text), self.term(low), self.term(high))
        nodes = (f"({self.node(part)})" for part in (below, above))
        return f"Build_adjoined {' '.join([str(self.fresh), *parts, *nodes])}", after


def letter(mark: str) -> str:
    if mark == ".":
        return "Signs"
    if not ("A" <= mark <= "Z" or "a" <= mark <= "z"):
        raise NotWritten(mark)
    return f"Face {ord(mark) - ord('A')}" if mark <= "Z" else f"Halve {ord(mark) - ord('a')}"


class Written:
    """A statement that is for all.  The parameters of a sharp range have the first numbers; its
    domain, and the condition, stand in place of `range` lines.
    """

    def __init__(
        self,
        statement: checker.Statement,
        over: Sequence[str] = (),
        sharp: Sequence[ast.expr] | None = None,
    ) -> None:
        unfolding = checker.Unfolding(statement, checker.Context(), sharp)
        self.name = statement.name
        self.index = {
            name: over.index(name) if name in over else len(over) + place
            for name, place in unfolding.context.index.items()
        }
        self.numbers = {unfolding.context.index[name]: own for name, own in self.index.items()}
        self.context = unfolding.context
        self.universal = unfolding.universal
        self.exist = [name for said in statement.get("exists") for name in said]
        self.integers = sorted(unfolding.integers)
        self.goals = unfolding.goals
        self.premises = unfolding.premises
        self.obligations = unfolding.obligations
        premises = iter(unfolding.premises[len(sharp or ()) :])
        self.lines = []
        for keyword, said in statement.lines:
            if keyword in ("given", "have") or keyword == "range" and sharp is None:
                word = "Have" if keyword == "have" else "Given"
                self.lines.append(f"{word} ({formula(next(premises), self.numbers)})")
            elif keyword == "root":
                next(premises), next(premises)
                self.lines.append(f"Root {self.index[said[0]]} {self.radicand(said)}")

    def radicand(self, said: Json) -> str:
        return polynomial(self.context.value(said[1][0]), self.numbers)

    def proof(self, proof: Json, known: Sequence[checker.Statement]) -> str:
        """The nodes of `have` and `root` lines, and the last part of a proof."""
        way, steps, last = proof
        if way != ("witness" if self.exist else "proof"):
            raise NotWritten(way)
        scopes = [self.scope(self.premises[:count], known) for count, _ in self.obligations]
        nodes = listed([scope.node(step) for scope, step in zip(scopes, steps, strict=True)])
        scope = self.scope(self.premises, known)
        if way == "proof":
            return f"{nodes} (Proof ({scope.node(last)}))"
        return f"{nodes} (Witness {scope.fresh} ({scope.found(last, [self], witness=True)}))"

    def scope(
        self, premises: Sequence[checker.Formula], known: Sequence[checker.Statement]
    ) -> Scope:
        state = SearchState(self.context).assume(checker.join("and", premises))
        return Scope(state, self.numbers, known)

    def text(self) -> str:
        """The statement in Coq."""
        integers = listed([str(self.index[name]) for name in self.integers])
        exist = listed([str(self.index[name]) for name in self.exist])
        goals = listed([formula(goal, self.numbers) for goal in self.goals])
        return f"Build_statement {integers} {listed(self.lines)} {exist} {goals}"


def accepted(
    statement: checker.Statement,
    certificate: Json,
    known: Mapping[str, checker.Statement],
    earlier: Mapping[str, checker.Statement],
) -> str:
    """Whether Coq's functions accept a certificate: a term whose value is true or false.

    known, earlier: as for `checker.check_one`.
    """
    lemmas = [one for one in known.values() if one.kind == "universal"]
    before = listed([Written(one).text() for one in lemmas])
    free = Scope(SearchState(checker.Context()), {}, lemmas)
    if statement.kind == "sharp" and sorted(certificate) == ["certified"]:
        return sharp(statement, certificate["certified"], earlier, before, free)
    if statement.kind != "universal":
        raise NotWritten(statement.kind)
    own = Written(statement)
    if sorted(certificate) == ["refuted"]:
        return f"refute {before} ({own.text()}) ({free.found(certificate['refuted'], [own])})"
    if sorted(certificate) != ["certified", "point"]:
        raise NotWritten("keys")
    point = f"meets_premises {before} ({own.text()}) ({free.found(certificate['point'], [own])})"
    return f"prove {before} ({own.text()}) {own.proof(certificate['certified'], lemmas)} && {point}"


def sharp(
    statement: checker.Statement,
    certificate: Json,
    earlier: Mapping[str, checker.Statement],
    before: str,
    free: Scope,
) -> str:
    """Whether they accept a sharp range, and each of its `number` lines."""
    ((names,), (over,)) = statement.get("sharp"), statement.get("over")
    ((domain,), (condition,)) = statement.get("domain"), statement.get("holds")
    inside, outside, points = certificate
    if not set(inside) == set(points) == set(names):
        raise NotWritten("proofs and points of other statements")
    whole = {name for line in earlier[names[0]].get("integer") for name in line}
    context = checker.Context()
    for name in over:
        context.declare(name, name in whole)
    numbers = {place: place for place in context.index.values()}
    written = [Written(earlier[name], over, [domain]) for name in names]
    entries = []
    for name, own in zip(names, written):
        proof = Written(earlier[name], over, [domain, condition]).proof(inside[name], free.known)
        point = free.found(points[name], [own])
        entries.append(f"entry_of ({own.text()}) {proof} ({point})")
    state = SearchState(context).assume(context.formula(domain))
    state.assume(checker.negate(context.formula(condition)))
    fails = Scope(state, numbers, free.known).found(outside, written, over)
    parts = [formula(context.formula(part), numbers) for part in (domain, condition)]
    integers = listed([str(context.index[name]) for name in sorted(context.integers)])
    places = listed([str(place) for place in numbers])
    tests = [
        f"sharp {before} {places} {integers} ({parts[0]}) ({parts[1]}) {listed(entries)}"
        f" {len(over)} ({fails})"
    ]
    taken = checker.Context(context)
    for name, (tree, *ends) in statement.get("number"):
        taken.declare(name)  # a name that is taken is refused
        poly = context.value(tree)
        (place,) = poly.places()
        low, high = (constant(context.value(end)) for end in ends)
        tests.append(f"one_root_between {place} {polynomial(poly, numbers)} {low} {high}")
    return " && ".join(tests)
