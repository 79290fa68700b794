"""The certificate of one statement, and of an orbit rule."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping, Sequence

from juggleproof.algebra.trees import HOLDS
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.closing import SQUARED, Hints, search_closing
from juggleproof.search.points import search_values
from juggleproof.search.psatz.basis import last_basis
from juggleproof.search.ranges import Violation
from juggleproof.search.small_proofs.linear_system import search_linear
from juggleproof.statements.language import NO_ROLES, Roles
from juggleproof.statements.nodes import (
    Certificate,
    Counterexample,
    Node,
    Point,
    Proof,
    Values,
    by_sign,
)
from juggleproof.statements.states import SearchState, proves, state_of
from juggleproof.statements.work import Budget, Exhausted, unfolded

# -------------------------------------------------------------------------------------------------
# The certificate of one statement: a proof with a point, a counterexample, or the reason why
# neither was found.

_made: dict[
    tuple[tuple[str, str], ...], tuple[str, Certificate]
] = {}  # an assertion made twice under two names is settled once
# (whether a refutation is sought, effort, share of the budget left in percent), in order
Attempts = tuple[tuple[bool, int, int], ...]

RAN_OUT = "the budget of counted work ran out"


def search_certificate(
    statement: checker.Statement,
    known: dict[str, checker.Statement],
    budget: Budget,
    hints: Hints | None = None,
    confirm: bool = True,
    attempts: Attempts = limits.ATTEMPTS,
    roles: Roles = NO_ROLES,
) -> Certificate:
    """{"certified": .., "point": ..}, {"refuted": ..} or {"unknown": reason}, each accepted by the
    checker.

    `confirm=False` leaves it to the caller to have a proof checked, and to search again where the
    checker rejects it.  Where the budget ends, that is the reason; nothing is raised.

    >>> text = "statement demo/square\\nforall x\\ngiven x > 1\\nshow x^2 > x"
    >>> statement = checker.read_statements(text)["demo/square"]
    >>> rule, steps, node = search_certificate(statement, {}, Budget(10**6))["certified"]
    >>> rule, steps, node[1]
    ('proof', [], [('1', ((0, 1),), '1'), ('1', ((1, 1),), '1'), ('1', ((0, 2),), '1')])
    """
    settings = (
        str(budget.left),
        str(hints),
        str(confirm),
        str(attempts),
        str(roles),
        *sorted(known),
    )
    key = (
        *((keyword, written(content)) for keyword, content in statement.lines),
        *(("", setting) for setting in settings),
    )
    if key not in _made:
        while len(_made) >= limits.MOST_CERTIFICATES:
            del _made[next(iter(_made))]
        _made[key] = (
            statement.name,
            _search(statement, known, budget, hints, confirm, attempts, roles),
        )
    name, certificate = _made[key]
    return certificate if name == statement.name else renamed(certificate, statement.name)


def written(content: object) -> str:
    """The content of a line of a statement, as text."""
    if isinstance(content, ast.AST):
        return ast.unparse(content)
    if isinstance(content, (list, tuple)):
        return "(" + ", ".join(map(written, content)) + ")"
    return str(content)


def renamed(certificate: Certificate, name: str) -> Certificate:
    """The certificate of the same statement under another name."""
    changed = certificate.copy()
    proof = certificate.get("certified")
    if isinstance(proof, tuple) and proof[0] == "witness":
        changed["certified"] = ("witness", proof[1], renamed_values(proof[2], name))
    if "point" in certificate:
        changed["point"] = renamed_values(certificate["point"], name)
    if "refuted" in certificate:
        changed["refuted"] = renamed_values(certificate["refuted"], name)
    return changed


def renamed_values(values: Values, name: str) -> Values:
    """The same values for a statement of another name."""
    if isinstance(values, (Point, Counterexample)):
        return values._replace(statement=name)
    if values[0] == "empty":
        return values
    return by_sign(values[1], [renamed_values(case, name) for case in values[2:]])


def _search(
    statement: checker.Statement,
    known: dict[str, checker.Statement],
    budget: Budget,
    hints: Hints | None,
    confirm: bool,
    attempts: Attempts,
    roles: Roles,
) -> Certificate:
    linear = search_linear(statement, budget.part(budget.left // 2), last_basis)
    if linear is not None and checker.check_one(statement, linear, {}, {})[1] is None:
        return linear
    cut: set[tuple[bool, int]] = set()  # attempts that the budget cut short
    ended: set[tuple[bool, int]] = set()  # those that it did not: more work would not help them
    is_false: bool | None = None  # as Z3 sees it, asked where the first search for a proof fails
    try:
        for refutes, effort, share in attempts:
            if (refutes, effort) in ended or effort == SQUARED and statement.get("exists"):
                continue  # in vain, or for goals that no terms make true
            if not refutes and is_false:
                continue
            part = budget.part(budget.left * share // 100)
            try:
                if refutes:
                    refuted = search_values(
                        statement,
                        SearchState(checker.Context()),
                        "counterexample",
                        {},
                        known,
                        part,
                        effort=effort,
                        roles=roles,
                    )
                    if refuted is not None:
                        return {"refuted": refuted}
                    ended.add((refutes, effort))
                    continue
                proof = search_proof(statement, known, part, None, effort, hints, confirm, roles)
            except Exhausted:
                cut.add((refutes, effort))
                continue
            ended.add((refutes, effort))
            if proof is not None:
                return with_point(statement, proof, known, budget, roles)
            if is_false is None:
                is_false = Violation.of(statement, None, roles).absent_everywhere(budget) is False
    except Exhausted:
        return {"unknown": RAN_OUT}
    return {"unknown": RAN_OUT if cut - ended else "neither a proof nor a counterexample was found"}


def with_point(
    statement: checker.Statement,
    proof: Proof,
    known: dict[str, checker.Statement],
    budget: Budget,
    roles: Roles,
) -> Certificate:
    """The certificate of a proved statement: its proof and a point that meets its hypotheses."""
    point = search_point(statement, known, budget, roles)
    if point is None:
        return {"unknown": "shown, but no point was found that meets the hypotheses"}
    return {"certified": proof, "point": point}


def search_point(
    statement: checker.Statement,
    known: dict[str, checker.Statement],
    budget: Budget,
    roles: Roles,
    sharp: list[ast.expr] | None = None,
) -> Values | None:
    """A point that meets the hypotheses of a statement, and lies in the domain of a range; None
    where none was found.

    Raises Exhausted where the budget ends.
    """
    start = SearchState(checker.Context())
    for effort in (0, 1, 2):
        point = search_values(statement, start, "point", {}, known, budget, sharp, effort, roles)
        if point is not None:
            return point
    return None


def search_proof(
    statement: checker.Statement,
    known: dict[str, checker.Statement],
    budget: Budget,
    sharp: list[ast.expr] | None = None,
    effort: int = 2,
    hints: Hints | None = None,
    confirm: bool = True,
    roles: Roles = NO_ROLES,
    lemmas: Sequence[str] = (),
) -> Proof | None:
    """A proof that the checker accepts, or None; `confirm=False` leaves that to the caller.

    Inside a sharp range, `sharp` has its domain and its condition.  The lemmas, formulas without
    `or`, are proved first, each from those before it, and then used.  Raises Exhausted where the
    budget ends, and Rejected for a lemma that cannot be read, or has an `or`.
    """
    unfolding = unfolded(statement, sharp)
    steps: list[Node] = []
    proof: Proof | None = None
    for count, negation in unfolding.obligations:
        node = search_closing(
            state_of(unfolding, count).assume(negation),
            known,
            budget,
            effort,
            None,
            confirm=False,
        )
        if (
            node is None and hints is not None
        ):  # as a rule a side condition needs no lemma, and cases of one only delay it
            node = search_closing(
                state_of(unfolding, count).assume(negation),
                known,
                budget,
                effort,
                hints,
                confirm=False,
            )
        if node is None:
            return None
        steps.append(node)
    if statement.get("exists"):
        base = {name: unfolding.context.values[name] for name in unfolding.universal}
        values = search_values(
            statement,
            state_of(unfolding),
            "witness",
            base,
            known,
            budget,
            sharp,
            effort,
            roles,
        )
        if values is not None:
            proof = "witness", steps, values
    else:
        atoms = [atom for lemma in lemmas for atom in lemma_atoms(unfolding.context, lemma)]
        node = search_by_lemmas(
            state_of(unfolding).assume(unfolding.goal(False)),
            atoms,
            lambda state: search_closing(state, known, budget, effort, hints, confirm=False),
        )
        if node is not None:
            proof = "proof", steps, node
    if proof is None or not confirm or proves(statement, proof, known, sharp):
        return proof
    return None


def lemma_atoms(context: checker.Context, text: str) -> list[checker.Atom]:
    """The atoms of a lemma, which are about the variables, and what is named, of a statement."""
    atoms: list[checker.Atom] = []
    for part in checker.conjuncts(context.formula(checker.parse(text))):
        if part is True:  # as of what is named: it says nothing new
            continue
        if part is False:
            raise checker.Rejected(checker.Kind.FORMULA, f"{text}, as a lemma, which is false")
        if part[0] != "atom":
            raise checker.Rejected(checker.Kind.FORMULA, f"{text}, as a lemma without `or`")
        atoms.append(part)
    return atoms


def search_by_lemmas(
    state: SearchState, lemmas: Sequence[checker.Atom], close: Callable[[SearchState], Node | None]
) -> Node | None:
    """A node that closes the state: by the signs of each polynomial, first those signs that its
    lemma rules out.
    """
    if not lemmas:
        return close(state)
    (_, poly, relation), *others = lemmas
    text = state.context.show(poly)
    cases = [(HOLDS[relation](k - 1), case) for k, case in enumerate(state.by_sign(text))]
    nodes: dict[int, Node] = {}
    for k in sorted(range(3), key=lambda k: cases[k][0]):
        holds, case = cases[k]
        node = search_by_lemmas(case, others, close) if holds else close(case)
        if node is None:
            return None
        nodes[k] = node
    return ("sign", text, nodes[0], nodes[1], nodes[2])


# -------------------------------------------------------------------------------------------------
# Certificates of the map rules: a proof for each premise that the checker writes.


def search_premises(
    premises: Mapping[str, checker.Statement],
    known: dict[str, checker.Statement],
    budget: int,
    lemmas: Mapping[str, Sequence[str]] | None = None,
    is_false: Callable[[str], bool] = lambda name: False,
    confirm: bool = True,
) -> Iterator[tuple[str, Proof | None]]:
    """The premises of a map rule in order, each with a proof or None; each may take the whole
    budget, and one that `is_false`, which is asked after a cheap attempt, takes no more.
    `confirm=False` leaves it to the caller to have the proofs checked, and to search again.

    Raises Rejected, with the name of the premise, where one cannot be read.
    """
    for name, premise in premises.items():
        proof = None
        shares = {1: budget // 4, 2: budget, SQUARED: budget}
        for effort in (1, 2) if premise.get("exists") else shares:
            if proof is not None or effort == 2 and is_false(name):
                break
            part, own = Budget(shares[effort]), (lemmas or {}).get(name, ())
            try:
                proof = search_proof(
                    premise, known, part, effort=effort, confirm=confirm, lemmas=own
                )
            except Exhausted:
                continue
            except checker.Rejected as reason:
                raise reason.within(f"premise {name}") from None
        yield name, proof
