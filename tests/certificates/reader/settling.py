"""Outcomes: proofs, found values, sharp ranges, and files of certificates."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.certificates.reader.bernstein import Patch, Tensor
from tests.certificates.reader.meaning import (
    join,
    negation,
    rational,
    variables,
)
from tests.certificates.reader.orbits import PREMISES
from tests.certificates.reader.proofs import (
    Certified,
    State,
    by_sign,
    close,
    goals_of,
    list_of,
    parsed,
    terms_for,
    unfold,
    variables_of,
)
from tests.certificates.reader.statements import OTHERS, Statement, read_statements
from tests.certificates.reader.syntax import Rejected, Tree, is_name, names_in, require

Show = Callable[[State, str, dict[str, Any], list[Any]], None]


def declare_variables(state: State, statement: Statement) -> None:
    integers = statement.names("integer")
    for name in variables_of(statement):
        state.declare(name, name in integers)


def require_meaning(statement: Statement, ranges: list[Tree] | None = None) -> None:
    """No line divides by what may vanish, whatever the variables are."""
    state = State()
    declare_variables(state, statement)
    reader = state.reader()
    unfold(statement, reader, ranges)
    for unknown in statement.names("exists"):
        reader.names[unknown] = state.declare(unknown)
    goals_of(statement, reader)


def prove(
    statement: Statement, proof: Any, certified: Certified, ranges: list[Tree] | None = None
) -> None:
    """A universal statement, with other formulas in place of its `range` lines if there are any."""
    how, steps, last = list_of(proof, 3)
    require_meaning(statement, ranges)
    state = State()
    declare_variables(state, statement)
    reader = state.reader()
    premises, needs = unfold(statement, reader, ranges)
    for (before, need), node in zip(needs, list_of(steps, len(needs))):
        close(state.having(join("and", premises[:before]), negation(need)), node, certified)
    state.assume(join("and", premises))
    if how == "proof":
        require(not statement.names("exists"), "what exists needs a witness")
        close(state.having(negation(join("and", goals_of(statement, reader)))), last, certified)
        return
    require(how == "witness" and bool(statement.names("exists")), "neither proof nor witness")

    def meets_goals(state: State, name: str, terms: dict[str, Any], nodes: list[Any]) -> None:
        require(name == statement.name and len(nodes) == 1, f"a witness of {statement.name}")
        goals = state.reader(reader.names)
        goals.names |= terms_for(statement, state, terms, exists=True)
        close(state.having(negation(join("and", goals_of(statement, goals)))), nodes[0], certified)

    settle_values(state, last, certified, meets_goals)


def settle_values(state: State, found: Any, certified: Certified, show: Show) -> None:
    """Each case of the found values is empty, or is what `show` reads it as."""
    require(isinstance(found, list) and len(found) > 1, "values are a list")
    if found[0] == "empty":
        close(state, list_of(found, 2)[1], certified)
        return
    if found[0] == "sign":
        _, text, *cases = list_of(found, 5)
        for case, one in zip(by_sign(state, text), cases):
            settle_values(case, one, certified, show)
        return
    require(len(found) > 3, "values are a name, numbers, terms and nodes")
    name, adjoined, terms, *nodes = found
    require(isinstance(name, str), "values are those of a statement")
    state = state.copy()
    for one in list_of(adjoined):
        adjoin(state, one, certified)
    show(state, name, terms, nodes)


def adjoin(state: State, adjoined: Any, certified: Certified) -> None:
    """A number with p = 0 and low <= it <= high, by the intermediate value theorem."""
    name, text, low, high, first, second = list_of(adjoined, 6)
    require(isinstance(name, str) and is_name(name) and name not in state.names, "a new name")
    tree, low, high, new = parsed(text), parsed(low), parsed(high), ("name", name)
    require(name not in names_in(low) | names_in(high), "an end in terms of the number")
    reader = state.reader()
    reader.names[name] = reader.value(low)
    zero: Tree = ("number", 0)
    fails = [reader.formula((">", low, high)), reader.formula((">", tree, zero))]
    close(state.having(join("or", fails)), first, certified)
    reader.names[name] = reader.value(high)
    close(state.having(reader.formula(("<", tree, zero))), second, certified)
    reader.names[name] = state.declare(name)
    state.assume(reader.formula(("<=", low, new)), reader.formula(("<=", new, high)))
    state.assume(reader.formula(("=", tree, zero)))


def show_point(
    statement: Statement, certified: Certified, ranges: list[Tree] | None = None
) -> Show:
    """Premises hold at the values."""

    def show(state: State, name: str, terms: dict[str, Any], nodes: list[Any]) -> None:
        require(name == statement.name and len(nodes) == 1, f"a point of {statement.name}")
        reader = state.reader(terms_for(statement, state, terms))
        premises, _ = unfold(statement, reader, ranges)
        close(state.having(negation(join("and", premises))), nodes[0], certified)

    return show


def show_counterexample(
    statements: dict[str, Statement],
    certified: Certified,
    ranges: list[Tree] | None = None,
    parameters: tuple[str, ...] = (),
) -> Show:
    """Premises hold at the values, and what is shown fails; the parameters keep their names."""

    def show(state: State, name: str, terms: dict[str, Any], nodes: list[Any]) -> None:
        require(name in statements and len(nodes) == 2, f"a counterexample of {name}")
        statement = statements[name]
        require(isinstance(terms, dict) and not set(parameters) & set(terms), "a parameter moves")
        own = {name: name for name in parameters}
        reader = state.reader(terms_for(statement, state, {**terms, **own}))
        premises, _ = unfold(statement, reader, ranges)
        close(state.having(negation(join("and", premises))), nodes[0], certified)
        state = state.copy()
        for unknown in statement.names("exists"):
            reader.names[unknown] = state.declare(unknown, unknown in statement.names("integer"))
        state.assume(join("and", goals_of(statement, reader)))
        close(state, nodes[1], certified)

    return show


def settle_universal(statement: Statement, entry: dict[str, Any], certified: Certified) -> str:
    if set(entry) == {"certified", "point"}:
        prove(statement, entry["certified"], certified)
        settle_values(State(), entry["point"], certified, show_point(statement, certified))
        return "certified"
    require(set(entry) == {"refuted"}, "parts of the entry")
    require_meaning(statement)
    show = show_counterexample({statement.name: statement}, certified)
    settle_values(State(), entry["refuted"], certified, show)
    return "refuted"


def settle_sharp(
    sharp: Statement, certificate: Any, statements: dict[str, Statement], certified: Certified
) -> None:
    """The statements hold exactly where the condition does, on the whole domain."""
    inside, outside, points = list_of(certificate, 3)
    named = {name: statements[name] for name in sharp.one("sharp")}
    parameters, domain, condition = sharp.one("over"), sharp.one("domain"), sharp.one("holds")
    names = [*parameters, *(name for name, *_ in sharp.all("number"))]
    require(len(set(names)) == len(names) and all(map(is_name, names)), "a number has its own name")
    for number in sharp.all("number"):
        check_number(number, parameters)
    require(isinstance(inside, dict) and set(inside) == set(named), "a proof of each statement")
    require(isinstance(points, dict) and set(points) == set(named), "a point of each statement")
    for name, statement in named.items():
        require(set(parameters) <= set(statement.names("forall")), "parameters are variables")
        require_meaning(statement, [domain])
        prove(statement, inside[name], certified, [domain, condition])
        settle_values(State(), points[name], certified, show_point(statement, certified, [domain]))
    state = State()
    whole, *others = (set(parameters) & set(one.names("integer")) for one in named.values())
    require(all(other == whole for other in others), "a parameter is an integer in one of them")
    for name in parameters:
        state.declare(name, name in whole)
    reader = state.reader()
    domain_holds = reader.formula(domain)
    reader.license(domain_holds)
    state.assume(domain_holds, reader.formula(condition, False))
    show = show_counterexample(named, certified, [domain], parameters)
    settle_values(state, outside, certified, show)


def check_number(number: tuple[str, Tree, Tree, Tree], parameters: tuple[str, ...]) -> None:
    """One change of sign in the Bernstein coefficients on LOW < HIGH, and no 0 at the ends."""
    _, tree, low, high = number
    state = State()
    for name in parameters:
        state.declare(name)
    reader = state.reader()
    p, a, b = map(reader.polynomial, (tree, low, high))
    require(len(variables(p)) == 1, "no polynomial in one parameter")
    x, first, last = variables(p)[0], rational(a), rational(b)
    if first is None or last is None or first >= last:
        raise Rejected("no numbers LOW < HIGH")
    monomials: Tensor = {(monomial[x],): c for monomial, c in p.terms()}
    row = Patch.on_box(monomials, (p.total_degree(),), [(first, last)]).lines(0)[()]
    signs = [c > 0 for c in row if c != 0]
    once = sum(left != right for left, right in zip(signs, signs[1:])) == 1
    require(row[0] != 0 != row[-1] and once, "not one change of sign")


def settle_orbit(
    statement: Statement, certificate: Any, statements: dict[str, Statement], certified: Certified
) -> None:
    for word in OTHERS:
        require(set(statement.all(word)) <= set(certified), f"the {word} is not certified")
    premises = PREMISES[statement.kind](statement, statements)
    require(isinstance(certificate, dict) and set(certificate) == set(premises), "the premises")
    for name, premise in premises.items():
        prove(premise, certificate[name], certified)


def settle(
    statement: Statement, entry: Any, statements: dict[str, Statement], certified: Certified
) -> str:
    """`certified`, `refuted` or `unknown`; raises Rejected where the entry shows nothing."""
    require(isinstance(entry, dict), "an entry has parts with names")
    if set(entry) == {"unknown"}:
        require(isinstance(entry["unknown"], str), "why it is unknown")
        return "unknown"
    if statement.kind == "universal":
        return settle_universal(statement, entry, certified)
    require(set(entry) == {"certified"}, "parts of the entry")
    if statement.kind == "sharp":
        settle_sharp(statement, entry["certified"], statements, certified)
    else:
        settle_orbit(statement, entry["certified"], statements, certified)
    return "certified"


def load_json(text: str) -> Any:
    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        require(len(dict(pairs)) == len(pairs), "a key stands twice")
        return dict(pairs)

    def no_decimal(text: str) -> Any:
        raise Rejected(f"a decimal: {text}")

    try:
        return json.loads(
            text, object_pairs_hook=once, parse_float=no_decimal, parse_constant=no_decimal
        )
    except (ValueError, RecursionError) as error:
        raise Rejected(f"no JSON: {error}") from None


def read_certificates(text: str) -> dict[str, Any]:
    entries: dict[str, Any] = {}
    last = ""
    for line in text.splitlines():
        name, entry = list_of(load_json(line), 2)
        require(isinstance(name, str) and last < name, f"{name} is out of order")
        entries[name] = entry
        last = name
    return entries


def outcomes(statements: dict[str, Statement], entries: dict[str, Any]) -> dict[str, str]:
    """The outcome of each statement in order, or `rejected: why`."""
    require(set(entries) == set(statements), "a line for each statement, and no other")
    certified: dict[str, Statement] = {}
    found: dict[str, str] = {}
    for name, statement in statements.items():
        earlier = {other: statements[other] for other in found}
        try:
            found[name] = settle(statement, entries[name], earlier, certified)
        except (Rejected, ArithmeticError, RecursionError) as error:
            found[name] = f"rejected: {error}"
        if found[name] == "certified":
            certified[name] = statement
    return found


def read_folder(folder: Path) -> dict[str, str]:
    """The outcomes of `statements.txt` by `certificates.jsonl`."""
    statements = read_statements((folder / "statements.txt").read_text(encoding="ascii"))
    return outcomes(statements, read_certificates((folder / "certificates.jsonl").read_text()))
