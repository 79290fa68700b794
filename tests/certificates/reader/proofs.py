"""States, and the rules that close them: a node shows that a state has no point."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from flint import fmpq
from flint import fmpq_mpoly as Poly

from tests.certificates.reader.bernstein import Patch
from tests.certificates.reader.meaning import (
    GENERATORS,
    MAX_VARIABLES,
    ONE,
    ZERO,
    Licences,
    Normal,
    Reader,
    Value,
    atom,
    conjuncts,
    join,
    negation,
    rational,
    univariate,
    variables,
)
from tests.certificates.reader.statements import Statement
from tests.certificates.reader.syntax import Parser, Rejected, Tree, is_name, require

Certified = Mapping[str, Statement]  # statements that were certified before
RATIONAL = re.compile(r"-?[0-9]+(/[0-9]+)?")


def parsed(text: Any) -> Tree:
    """A term of a certificate, which knows no definitions."""
    require(isinstance(text, str), "a term is text")
    parser = Parser(text, {})
    tree = parser.disjunction()
    parser.end()
    return tree


def number_of(what: Any) -> fmpq:
    if isinstance(what, str) and RATIONAL.fullmatch(what):
        top, _, under = what.partition("/")
        require(int(under or 1) != 0, "a denominator is 0")
        return fmpq(int(top), int(under or 1))
    return fmpq(integer_of(what))


def integer_of(what: Any) -> int:
    require(isinstance(what, int) and not isinstance(what, bool), f"no integer: {what!r}")
    return int(what)


def list_of(what: Any, length: int | None = None) -> list[Any]:
    require(isinstance(what, list), f"no list: {str(what)[:40]}")
    require(length is None or len(what) == length, "a list of another length")
    return list(what)


class State:
    """Facts that all hold, disjunctions that are open, and the variables they are about."""

    def __init__(self) -> None:
        self.facts: list[tuple[str, Poly]] = []
        self.choices: list[list[Normal]] = []
        self.closed = False
        self.names: dict[str, Value] = {}  # what a certificate calls the variables
        self.integers: set[int] = set()
        self.licences = Licences([], [])

    def copy(self) -> State:
        other = State()
        other.facts = list(self.facts)
        other.choices = list(self.choices)
        other.closed = self.closed
        other.names = dict(self.names)
        other.integers = set(self.integers)
        other.licences = self.licences.copy()
        return other

    def declare(self, name: str, integer: bool = False) -> Value:
        """A new variable; underscores are added until the name is free."""
        while name in self.names:
            name += "_"
        number = len(self.names)
        require(number < MAX_VARIABLES, "too many variables")
        if integer:
            self.integers.add(number)
        self.names[name] = Value(GENERATORS[number])
        return self.names[name]

    def assume(self, *normals: Normal) -> State:
        for normal in normals:
            for part in conjuncts(normal):
                if part is False:
                    self.closed = True
                elif part is not True and part[0] == "or":
                    self.choices.append(part[1])
                elif part is not True:
                    self.facts.append(part)
                    self.licences.add(*part)
        return self

    def having(self, *normals: Normal) -> State:
        return self.copy().assume(*normals)

    def reader(self, values: Mapping[str, Value] | None = None) -> Reader:
        """A reader with the licences of this state, for its own names or for others."""
        return Reader(self.names if values is None else values, self.licences.copy())

    def polynomial(self, text: Any) -> Poly:
        return self.reader().polynomial(parsed(text))

    def fact(self, number: Any) -> tuple[str, Poly]:
        at = integer_of(number)
        require(0 <= at < len(self.facts), f"there is no fact {at}")
        return self.facts[at]

    def are_integers(self, p: Poly) -> bool:
        """Integer coefficients and integer variables only."""
        return all(c.q == 1 for c in p.coeffs()) and set(variables(p)) <= self.integers


def close(state: State, node: Any, certified: Certified) -> None:
    """Raises Rejected where the node does not show that the state has no point."""
    require(isinstance(node, list) and len(node) > 0, "a node is a list")
    rule, *rest = node
    require(isinstance(rule, str) and rule in RULES, f"no rule: {rule!r}")
    count, apply = RULES[rule]
    require(len(rest) == count, f"{rule} has {count} parts")
    apply(state, certified, *rest)


def _close(state: State, certified: Certified) -> None:
    require(state.closed, "nothing false is assumed")


def _psatz(state: State, certified: Certified, products: Any, cofactors: Any) -> None:
    total, strict = ZERO, False
    for product in list_of(products):
        coefficient, powers, root = list_of(product, 3)
        c, q = number_of(coefficient), state.polynomial(root)
        require(c > 0, "a coefficient is not positive")
        positive = rational(q) is not None and bool(q)
        term = q * q * c
        for power in list_of(powers):
            number, exponent = list_of(power, 2)
            relation, p = state.fact(number)
            e = integer_of(exponent)
            require(0 < e <= 4000, "an exponent is not positive")
            require(relation != "=", "an equation among the factors")
            require(relation != "!=" or e % 2 == 0, "an odd power of what is only nonzero")
            positive = positive and relation in (">", "!=")
            term *= p**e
        total += term
        strict = strict or positive
    for cofactor in list_of(cofactors):
        number, text = list_of(cofactor, 2)
        relation, p = state.fact(number)
        require(relation == "=", "a cofactor of what is no equation")
        total += p * state.polynomial(text)
    require(strict, "no term is strictly positive")
    require(not total, "the sum is not zero")


def _cases(state: State, certified: Certified, choice: Any, nodes: Any) -> None:
    k = integer_of(choice)
    require(0 <= k < len(state.choices), f"there is no choice {k}")
    without = state.copy()
    alternatives = without.choices.pop(k)
    for alternative, node in zip(alternatives, list_of(nodes, len(alternatives))):
        close(without.having(alternative), node, certified)


def by_sign(state: State, text: Any) -> list[State]:
    """The states in which a polynomial is below, at and above 0."""
    p = state.polynomial(text)
    return [state.having(atom(">", -p)), state.having(atom("=", p)), state.having(atom(">", p))]


def _sign(state: State, certified: Certified, text: Any, *nodes: Any) -> None:
    for case, node in zip(by_sign(state, text), nodes):
        close(case, node, certified)


def _bound(state: State, number: Any, x: int, sign: int) -> fmpq:
    """The bound that fact a x + b >= 0 is for x, from below where a > 0."""
    relation, p = state.fact(number)
    require(relation in (">", ">=") and variables(p) == [x], "no bound of the variable")
    require(p.degrees()[x] == 1, "a bound is linear")
    line = univariate(p, x)
    require(line[1] * sign > 0, "a bound from the other side")
    return -line[0] / line[1]


def _boxes(state: State, certified: Certified, i: Any, bounds: Any, tree: Any) -> None:
    relation, p = state.fact(i)
    require(relation in (">", ">="), "no inequality")
    axes = variables(p)
    box = [
        (_bound(state, low, x, 1), _bound(state, high, x, -1))
        for x, (low, high) in zip(
            axes, [list_of(pair, 2) for pair in list_of(bounds, len(axes))], strict=True
        )
    ]
    require(isinstance(tree, str), "a tree of boxes is text")
    degrees = tuple(p.degrees()[x] for x in axes)
    monomials = {tuple(monomial[x] for x in axes): c for monomial, c in p.terms()}
    todo = [Patch.on_box(monomials, degrees, box)]
    for letter in tree:
        require(bool(todo), "more boxes than there are")
        patch = todo.pop()
        axis = "abcdefghijklmnopqrstuvwxyz".find(letter.lower())
        if letter == ".":
            signs = [c < 0 or (c == 0 and relation == ">") for c in patch.at.values()]
            require(all(signs), "a Bernstein coefficient has the other sign")
            continue
        require(letter.isascii() and 0 <= axis < len(patch.degrees), f"there is no axis {letter!r}")
        if letter.islower():
            lower, upper = patch.halves(axis)
            todo += [upper, lower]
        else:
            face = patch.face(axis)
            if face is None:
                raise Rejected("the coefficients are not monotone")
            todo.append(face)
    require(not todo, "fewer boxes than there are")


def _integral(state: State, certified: Certified, i: Any, node: Any) -> None:
    relation, p = state.fact(i)
    require(relation == ">" and state.are_integers(p), "no strict inequality of integers")
    close(state.having(atom(">=", p - ONE)), node, certified)


def _use(state: State, certified: Certified, name: Any, terms: Any, fresh: Any, node: Any) -> None:
    require(isinstance(name, str) and name in certified, f"{name!r} was not certified before")
    statement = certified[name]
    require(statement.kind == "universal", f"{name} is not universal")
    later = state.copy()
    values = terms_for(statement, state, terms)
    own = statement.names("exists")
    require(isinstance(fresh, dict) and set(fresh) == set(own), "names for what exists")
    news = list(fresh.values())
    require(all(isinstance(new, str) and is_name(new) for new in news), "a name")
    require(len({*news, *state.names}) == len(news) + len(state.names), "a name is taken")
    for old in own:
        later.declare(fresh[old], old in statement.names("integer"))
    reader = later.reader(values)
    premises, _ = unfold(statement, reader)
    reader.names |= {old: later.names[fresh[old]] for old in own}
    goals = goals_of(statement, reader)
    later.assume(join("or", [negation(join("and", premises)), join("and", goals)]))
    close(later, node, certified)


RULES: dict[str, tuple[int, Callable[..., None]]] = {
    "close": (0, _close),
    "psatz": (2, _psatz),
    "cases": (2, _cases),
    "sign": (4, _sign),
    "boxes": (3, _boxes),
    "integral": (2, _integral),
    "use": (4, _use),
}


def variables_of(statement: Statement) -> tuple[str, ...]:
    """Of `forall` and `root` lines."""
    return (*statement.names("forall"), *(name for name, _ in statement.all("root")))


def terms_for(
    statement: Statement, state: State, terms: Any, exists: bool = False
) -> dict[str, Value]:
    """Values for the variables of a statement; those of integers are integers."""
    require(isinstance(terms, dict), "terms stand under names")
    wanted = statement.names("exists") if exists else variables_of(statement)
    require(set(terms) == set(wanted), f"terms for {', '.join(wanted)} and for no other")
    reader = state.reader()
    values = {name: reader.value(parsed(text)) for name, text in terms.items()}
    for name, value in values.items():
        if name in statement.names("integer"):
            require(not value.under and state.are_integers(value.top), f"{name} is an integer")
    return values


def unfold(
    statement: Statement, reader: Reader, ranges: list[Tree] | None = None
) -> tuple[list[Normal], list[tuple[int, Normal]]]:
    """The premises in order, and what each `have` and `root` line needs: the number of premises
    before it and a formula.  `ranges` stand in place of the `range` lines.
    """
    premises: list[Normal] = []
    needs: list[tuple[int, Normal]] = []

    def add(normal: Normal) -> None:
        premises.append(normal)
        reader.license(normal)

    for tree in ranges or []:
        add(reader.formula(tree))
    for word, says in statement.lines:
        if word == "exists":
            break
        if word == "range" and ranges is None or word == "given":
            add(reader.formula(says))
        elif word == "have":
            normal = reader.formula(says)
            needs.append((len(premises), normal))
            add(normal)
        elif word == "let":
            reader.names[says[0]] = reader.value(says[1])
        elif word == "root":
            needs.append((len(premises), reader.formula((">=", says[1], ("number", 0)))))
            name: Tree = ("name", says[0])
            add(reader.formula((">=", name, ("number", 0))))
            add(reader.formula(("=", ("^", name, 2), says[1])))
    return premises, needs


def goals_of(statement: Statement, reader: Reader) -> list[Normal]:
    """The `with` lines and the `show` line, read after the premises."""
    goals: list[Normal] = []
    after = False
    for word, says in statement.lines:
        after = after or word == "exists"
        if word == "let" and after:
            reader.names[says[0]] = reader.value(says[1])
        elif word in ("with", "show"):
            goals.append(reader.formula(says))
            reader.license(goals[-1])
    return goals
