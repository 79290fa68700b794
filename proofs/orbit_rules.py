"""The rules for orbits of maps as a claim writes them: lines that make no rule, the premises of one
that does, and why a premise has no proof.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Mapping, Sequence
from difflib import get_close_matches
from fractions import Fraction

from juggleproof.certificates import checker
from juggleproof.certificates.algebra.numbers import AlgebraicNumber
from juggleproof.certificates.definitions import formula_of
from juggleproof.certificates.language import ClaimError, MapRule
from juggleproof.certificates.votes.vote import Vote
from juggleproof.certificates.votes.z3 import Model
from juggleproof.proofs.conclusions import RULES, meaning
from juggleproof.proofs.evaluating import Ends, ends_of, is_surely

# -------------------------------------------------------------------------------------------------
# Lines that make no rule.


def read_rule(rule: MapRule) -> checker.Statement:
    """The rule as the checker reads it.

    Raises ClaimError, which names the line and what is wanted, where it cannot.
    """
    try:
        keywords = [keyword for keyword, _ in rule.lines]
    except (TypeError, ValueError):
        raise ClaimError(f"{rule.name}: each line of a rule is a pair (keyword, text)") from None
    fault = _fault(keywords)
    if fault:
        raise ClaimError(f"{rule.name}: {fault}")
    try:
        return checker.read_statements(rule.text())[rule.name]
    except checker.Rejected as reason:
        count = re.search(r"line (\d+)$", reason.place)
        at = int(count[1]) - 2 if count else len(keywords)  # the first line is `statement`
        row = f"the line `{' '.join(rule.lines[at])}`: " if at < len(keywords) else ""
        raise ClaimError(
            f"{rule.name}: {row}{checker.Rejected(reason.kind, reason.offender)}"
        ) from None


def premises_of(
    rule: checker.Statement, known: Mapping[str, checker.Statement], stated: Collection[str]
) -> dict[str, checker.Statement] | str:
    """The premises by name, or why there are none: a rule that it names is stated, and not among
    those known to be certified.

    Raises ClaimError for a name that is not stated before it, or is that of another kind of rule;
    and for lines of which the checker makes no premises.
    """
    for keyword, name in ((key, text) for key, text in rule.lines if key in checker.NAMED):
        if name not in stated:
            part = name.partition("/")[1:]
            similar = get_close_matches(name, stated, 1) or [
                one for one in stated if one.partition("/")[1:] == part
            ]
            hint = f"did you mean {similar[0]}?" if similar else "state it first, in this claim"
            raise ClaimError(
                f"{rule.name}: the line `{keyword} {name}` names no rule that stands before it;"
                f" {hint}"
            )
        if name not in known:
            return f"it rests on {name}, which is not certified"
    try:
        return checker.premises_of(rule, known)
    except checker.Rejected as reason:
        kind, _, name = reason.offender.rpartition(" ")
        if reason.kind is checker.Kind.EARLIER and name in known:
            own = known[name].kind
            mend = f"name one of the kind `{kind}`"
            if {own, kind} == {"map", "relation"}:
                mend = f"write the line `{own} {name}`"
            raise ClaimError(f"{rule.name}: {name} is a rule `{own}`; {mend}") from None
        raise ClaimError(f"{rule.name}: {reason}") from None


def _fault(keywords: Sequence[str]) -> str:
    """What keeps lines with these keywords from being a rule; nothing where they are one."""
    row = "".join(f"{keyword} " for keyword in keywords)
    if any(re.fullmatch(rule.lines, row) for rule in RULES.values()):
        return ""

    def parts(kind: str) -> list[tuple[list[str], str]]:
        """The keywords of which one stands at each place, and how often: once, or *, + or ?."""
        found = re.findall(r"\(([a-z| ]+)\) ?([*+?]?)|([a-z]+) ", RULES[kind].lines)
        return [
            ((group or word).replace(" ", "").split("|"), often) for group, often, word in found
        ]

    def missing(kind: str) -> list[str]:
        return [
            f"`{'` or `'.join(words)}`"
            for words, often in parts(kind)
            if often not in ("*", "?") and not {*words} & {*keywords}
        ]

    def foreign(kind: str) -> list[str]:
        own = {word for words, _ in parts(kind) for word in words}
        return [f"`{keyword}`" for keyword in dict.fromkeys(keywords) if keyword not in own]

    kind = min(RULES, key=lambda one: len(missing(one)) + len(foreign(one)))
    faults = [f"{', '.join(missing(kind))} missing"] if missing(kind) else []
    faults += [f"{', '.join(foreign(kind))} left over"] if foreign(kind) else []
    places = [
        next((k for k, (words, _) in enumerate(parts(kind)) if keyword in words), -1)
        for keyword in keywords
    ]
    for before, after, one, other in zip(places, places[1:], keywords, keywords[1:]):
        if 0 <= after < before:
            faults.append(f"`{other}` after `{one}`")
        elif after == before >= 0 and parts(kind)[after][1] in ("", "?"):
            faults.append(f"`{other}` twice")
    often = {"": "", "*": " (any number)", "+": " (at least one)", "?": " (at most one)"}
    order = ", ".join(" or ".join(words) + often[count] for words, count in parts(kind))
    return f"{', '.join(faults)}; the lines of `{kind}` are, in this order: {order}"


# -------------------------------------------------------------------------------------------------
# Why a premise has no proof: values at which it is false, or what Z3 says.

LONGEST, LONGEST_NUMBER = 80, 24  # characters of a formula, and of a number, in a line
BITS, PLACES = 64, 6  # of an irrational value: after the point of its ends, and decimals shown
MORE = 10  # times the budget that is proposed


def why(
    kind: str,
    name: str,
    premise: checker.Statement,
    answer: tuple[Vote, Model | None],
    budget: int,
    cut: bool = True,
) -> str:
    """A line on a premise for which no proof was found within the budget, from Z3's answer; `cut`:
    whether it was the budget that ended the search.
    """
    vote, model = answer
    about = f"{name}, {meaning(kind, name)}:"
    if model is not None:
        # a root that is not known to exist has no value
        names = model.point if model.part == "goal" else premise.get("forall")[0]
        values = ", ".join(f"{one} = {_value(model.point[one])}" for one in names)
        numbers = _numbers(premise, model)
        parts = ["false", f" at {values}" * bool(values), f", where {numbers}" * bool(numbers)]
        return f"{about} {''.join(parts)}"
    if vote.answer == "fails":
        return f"{about} Z3 says that it is false"
    says = "Z3 says that it holds" if vote.answer == "holds" else "Z3 gives no answer"
    if not cut:
        return f"{about} {says}; no certificate was found, and not for want of budget"
    return (
        f"{about} {says}; no certificate was found within the budget: try --budget"
        f" {MORE * budget}, or a lemma"
    )


def _value(value: Fraction | AlgebraicNumber) -> str:
    if isinstance(value, Fraction):
        return str(value)
    return f"about {value.decimal(PLACES)} (a root of {value.polynomial_text('z')})"


def _numbers(premise: checker.Statement, model: Model) -> str:
    """What is false at the values, with the numbers that its two sides come to; nothing where that
    is 0 = 1, or where the ends of irrational values do not tell.
    """
    point = {
        name: (value, value) if isinstance(value, Fraction) else value.enclosure(BITS)
        for name, value in model.point.items()
    }
    obligations = 0
    try:
        for keyword, line in premise.lines:
            if keyword == "let":
                point[line[0]] = ends_of(line[1], point)
            elif keyword == "show":
                return _false_part(line, point)
            elif keyword in ("have", "root"):
                obligations += 1
                if model.part != f"obligation {obligations}":
                    continue
                if keyword == "have":
                    return _false_part(line, point)
                name, (under,) = line
                defined = ast.Compare(under, [ast.GtE()], [ast.Constant(0)])
                return f"under the root {name}, {_false_part(defined, point)}"
    except ZeroDivisionError:  # between ends that are not close enough
        return ""
    return ""


def _false_part(node: ast.expr, point: Mapping[str, Ends]) -> str:
    """The first false part of a conjunction, all parts of a disjunction that is false."""
    if not is_surely(False, node, point):
        return ""
    if isinstance(node, ast.BoolOp):
        parts = list(filter(None, (_false_part(part, point) for part in node.values)))
        return ", ".join(parts if isinstance(node.op, ast.Or) else parts[:1])
    if not isinstance(node, ast.Compare):
        return f"{formula_of(node)} is false"
    sides = [node.left, *node.comparators]
    pairs = (
        ast.Compare(left, [sign], [right]) for left, sign, right in zip(sides, node.ops, sides[1:])
    )
    pair = next(one for one in pairs if is_surely(False, one, point))
    relation = formula_of(pair)
    if not checker.names_in(str(relation)):
        return "" if str(relation) == "0 = 1" else f"{relation} is false"
    left, right = (_number(ends_of(side, point)) for side in (pair.left, *pair.comparators))
    numbers = f"{left} {relation.op} {right}"
    return f"{relation} comes to {numbers}" if len(str(relation)) <= LONGEST else numbers


def _number(ends: Ends) -> str:
    if ends[0] == ends[1] and len(str(ends[0])) <= LONGEST_NUMBER:
        return str(ends[0])
    return f"about {AlgebraicNumber.rational(ends[0]).decimal(PLACES)}"
