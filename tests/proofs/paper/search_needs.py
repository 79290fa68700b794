"""What a hypothesis of a certified statement is for, searched: none of this is believed, the
checker judges what it finds.

A certified statement says P and H => S.  Without H it says P => S, that is, P and not H => S as
well.  So a counterexample to it meets P and not H, and a proof of P and not H => S shows that H is
not needed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Any

from juggleproof.algebra.conditions import Condition, ring_of
from juggleproof.certificates import checker
from juggleproof.proofs.paper.names import STANDING
from juggleproof.search.certificate import search_proof
from juggleproof.search.points import assignments, search_values, values_of_assignment
from juggleproof.search.witness_terms import TermTask
from juggleproof.statements.language import Roles
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted
from juggleproof.votes.z3 import vote

NEEDED, LICENSES, NOT_NEEDED, UNDECIDED = "needed", "licenses a division", "not needed", "undecided"
BUDGET = 2_000_000
ATTEMPTS = (
    (True, 0, 20),
    (False, 1, 20),
    (True, 1, 40),
    (False, 2, 60),
    (True, 2, 100),
)  # (refutes, effort, percent of what is left)


@dataclass(frozen=True)
class Hypothesis:
    """One conjunct of a range or given line of a statement: its line, its place in the line, and
    what it says.
    """

    row: int
    part: int
    keyword: str
    said: str


def conjuncts(said: str) -> list[str]:
    """The parts of a conjunction, split where `and` stands outside all parentheses.

    >>> conjuncts("x > 0 and (y > 0 and z > 0 or x = 1)"), conjuncts("x > 0 and y > 0 or z > 0")
    (['x > 0', '(y > 0 and z > 0 or x = 1)'], ['x > 0 and y > 0 or z > 0'])
    """
    depth, parts, begin = 0, [], 0
    for match in re.finditer(r"[()]| and | or ", said):
        depth += {"(": 1, ")": -1}.get(match[0], 0)
        if depth == 0 and match[0] == " or ":
            return [said]
        if depth == 0 and match[0] == " and ":
            parts.append(said[begin : match.start()])
            begin = match.end()
    return [*parts, said[begin:]]


def hypotheses(text: str) -> Iterator[Hypothesis]:
    """Every conjunct of the range and given lines of a statement."""
    for row, line in enumerate(text.splitlines()):
        keyword, _, said = line.partition(" ")
        if keyword in ("range", "given"):
            for part, one in enumerate(conjuncts(said)):
                yield Hypothesis(row, part, keyword, one)


def without(text: str, one: Hypothesis, *instead: str) -> str:
    """The statement without this hypothesis, or with others in its place."""
    rows = text.splitlines()
    parts = conjuncts(rows[one.row].partition(" ")[2])
    parts[one.part : one.part + 1] = instead
    rows[one.row : one.row + 1] = [f"{one.keyword} " + " and ".join(parts)] if parts else []
    return "\n".join(rows)


def obligations(text: str) -> Iterator[tuple[str, str]]:
    """(what is to be shown, statement that shows it) for every have and root line: each follows
    from what stands before it.
    """
    rows = text.splitlines()
    for row, line in enumerate(rows):
        keyword, _, said = line.partition(" ")
        if keyword in ("have", "root"):
            shown = said if keyword == "have" else re.sub(r".*? = sqrt\((.*)\)", r"\1 >= 0", said)
            yield shown, "\n".join([*rows[:row], f"show {shown}"])


def statement_of(text: str) -> checker.Statement:
    """The one statement of a text, read and unfolded by the checker; raises Rejected where it
    cannot be read.
    """
    (statement,) = checker.read_statements(text).values()
    checker.Unfolding(statement, checker.Context())
    return statement


def is_refuted(text: str, refutation: Any) -> bool:
    """Whether the checker accepts these exact values as a counterexample."""
    return bool(
        checker.check_one(statement_of(text), {"refuted": refutation}, {}, {})[0] == "refuted"
    )


def roles_without(one: Hypothesis) -> Roles:
    """What the paper's variables stand for, but for a variable that the hypothesis alone bounds:
    without r > 0, r is no scale that a change of units makes 1.
    """
    roles = Roles(STANDING.domains, STANDING.scales)
    bounded = set(re.findall(r"[A-Za-z]\w*", one.said))
    if len(bounded) > 1:
        return roles
    domains = {} if roles.parameter in bounded else roles.domains
    return Roles(domains, (roles.scales or frozenset()) - bounded)


def search_need(text: str, one: Hypothesis, budget: int = BUDGET) -> tuple[str, str, Any]:
    """(need, what fails without the hypothesis if not what is shown, counterexample to that or a
    reason).
    """
    plain, roles = without(text, one), roles_without(one)
    try:
        statement_of(plain)
    except checker.Rejected as reason:
        if "division" not in str(reason):
            raise
        return LICENSES, "", None
    for shown, obligation in obligations(plain):
        if len(obligation.splitlines()) > one.row and (
            refutation := refuted_among(
                obligation, [negated_in(obligation, one)], roles, budget // 8
            )
        ):
            return NEEDED, shown, refutation
    opposite = statement_of(without(text, one, f"not ({one.said})"))
    whole = Budget(budget)
    for refutes, effort, share in ATTEMPTS:
        try:
            part = whole.part(whole.left * share // 100)
            if not refutes:
                if search_proof(opposite, {}, part, effort=effort, roles=roles) is not None:
                    return NOT_NEEDED, "", None
            elif (
                refutation := search_values(
                    opposite,
                    SearchState(checker.Context()),
                    "counterexample",
                    {},
                    {},
                    part,
                    effort=effort,
                    roles=roles,
                )
            ) is not None and is_refuted(plain, refutation):
                return NEEDED, "", refutation
        except Exhausted:
            continue
    if refutation := refuted_among(plain, list(special(text, one)), roles, budget // 8):
        return NEEDED, "", refutation
    return (NOT_NEEDED if is_not_needed(text, one, budget) else UNDECIDED), "", None


def is_not_needed(text: str, one: Hypothesis, budget: int = BUDGET) -> bool:
    """Whether the search proves, and the checker accepts, that the statement holds where the
    hypothesis fails as well: with its negation in its place, or with nothing there.
    """
    roles = roles_without(one)
    for instead in ([f"not ({one.said})"], []):
        other = statement_of(without(text, one, *instead))
        for effort in (1, 2):
            try:
                if search_proof(other, {}, Budget(budget), effort=effort, roles=roles):
                    return True
            except Exhausted:
                continue
    return False


def negated_in(text: str, one: Hypothesis) -> str:
    """A statement without the hypothesis, with its negation in its place."""
    rows = text.splitlines()
    return "\n".join([*rows[: one.row], f"{one.keyword} not ({one.said})", *rows[one.row :]])


def special(text: str, one: Hypothesis) -> Iterator[str]:
    """The statement with simple values in place of the hypothesis: for its own variable, for r and
    g, and for alpha (2 + 2/8 is a square).
    """
    bound = re.fullmatch(r"(\w+) (?:<|<=|>|>=|!=) (\d+(?:/\d+)?)|(\d+) < (\w+)", one.said)
    own = [f"not ({one.said})"]
    if bound:
        name, limit = bound[1] or bound[4], bound[2] or bound[3]
        own = [f"{name} = {limit}{move}" for move in ("", " - 1", " + 1", " - 1/2", " - 3", " + 3")]
    variables = text.split("\nforall ")[1].split("\n")[0].split()
    units = [
        f"{name} = 1" for name in ("r", "g") if name in variables and f"{name} > 0" != one.said
    ]
    for first in own:
        for alpha in (
            ("1/2", "1/4", "3/4", "1/8", "")
            if "alpha" in variables and "alpha" not in one.said
            else ("",)
        ):
            yield without(text, one, *([first, *units] + ([f"alpha = {alpha}"] if alpha else [])))


def refuted_among(plain: str, narrowed: list[str], roles: Roles, budget: int) -> Any:
    """A counterexample to the statement among the points of its narrower forms, by samples and by
    Z3's models.
    """
    for text in narrowed:
        try:
            answer = vote(statement_of(text))
            points = [
                f"given {name} = {value}"
                for name, value in answer.model
                if re.fullmatch(r"-?\d+(/\d+)?", value)
            ]
            forms = (
                [with_givens(text, points)]
                if answer.answer == "fails"
                else [text]
                if answer.answer == "unknown"
                else []
            )
            for form in forms:
                refutation = refuted_there(
                    statement_of(plain), statement_of(form), roles, Budget(budget)
                )
                if refutation is not None and is_refuted(plain, refutation):
                    return refutation
        except (checker.Rejected, Exhausted):
            continue
    return None


def with_givens(text: str, givens: list[str]) -> str:
    """The statement with more premises, after all of its own."""
    rows = text.splitlines()
    last = next(row for row, line in enumerate(rows) if line.startswith(("exists ", "show ")))
    return "\n".join([*rows[:last], *givens, *rows[last:]])


def refuted_there(
    plain: checker.Statement, narrow: checker.Statement, roles: Roles, budget: Budget
) -> Any:
    """A counterexample to the plain statement at a point that meets the premises of the narrow one
    and, without `exists`, breaks its goal.
    """
    story = checker.Unfolding(narrow, checker.Context())
    parts = [*story.premises, *([] if narrow.get("exists") else [story.goal(False)])]
    condition = Condition.of(story.context, checker.join("and", parts), ring_of(story.context))
    names, integers = list(story.universal), frozenset(story.integers)
    for effort in (0, 1):
        some = assignments(condition, names, integers, budget, effort, roles=roles)
        for assignment in islice(some, 8):
            task = TermTask(plain, "counterexample", {}, {}, budget, effort=1)
            refutation = values_of_assignment(
                task, SearchState(checker.Context()), assignment, names
            )
            if refutation is not None:
                return refutation
    return None
