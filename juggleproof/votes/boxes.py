"""The vote of interval boxes: a proof that no box holds a counterexample, an exact counterexample,
or the enclosure of a bound.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from juggleproof.algebra.intervals import working_precision
from juggleproof.certificates import checker
from juggleproof.statements.vote import Vote, VoteBudget
from juggleproof.votes import limits
from juggleproof.votes.box_search import GoalBound, enclose_goal, refute
from juggleproof.votes.branches import regions
from juggleproof.votes.questions import (
    VoteQuestion,
    questions,
    scale_variables,
    with_scales_one,
)


@dataclass
class BoxFinding:
    """The outcome of one question: an exact solution, reasons why nothing was decided, or neither,
    where it has no solution.
    """

    point: list[Fraction] | None = None
    reasons: list[str] = field(default_factory=list)
    unbounded: bool = False
    # an equation or its negation is among the facts: boxes only approach such sets
    thin: bool = False


@dataclass
class Tally:
    """Boxes looked at so far, and how many were discarded in regions that were settled."""

    boxes: int = 0
    leaves: int = 0


def vote(
    statement: checker.Statement,
    earlier: Mapping[str, checker.Statement] | None = None,
    budget: VoteBudget | None = None,
    asked: Sequence[VoteQuestion] | None = None,
) -> Vote:
    """The boxes' vote on a universal statement in reals.

    `holds`: on every box some premise or the negated goal surely fails; `fails`: an exact point;
    `enclosed`: the infimum of what is to be positive lies between two rationals, where equality is
    attained or approached; `not applicable`, with the reason.

    >>> from juggleproof.votes.questions import read_statement
    >>> text = "statement demo/disc\\nforall x y\\ngiven x^2 + y^2 <= 1\\nshow x*y < 3/5"
    >>> v = vote(read_statement(text))
    >>> v.answer, v.detail
    ('holds', '44 boxes discarded')
    """
    budget = budget or VoteBudget()
    if statement.kind != "universal":
        return Vote(
            "boxes", "not applicable", "the statement is not about all points of one region"
        )
    *lines, goal = asked or questions(statement, earlier)
    if goal.quantified or goal.integers:
        return Vote(
            "boxes",
            "not applicable",
            "something is said to exist" if goal.quantified else "a variable is an integer",
        )
    with working_precision():
        return _vote(lines, goal, budget)


def _vote(lines: Sequence[VoteQuestion], goal: VoteQuestion, budget: VoteBudget) -> Vote:
    tally, reasons, unbounded = Tally(), list[str](), True
    for line in lines:
        finding = _settle(line, budget.boxes // 8, tally)
        if finding.point is not None or finding.reasons:
            reasons.append(
                f"{line.part}: "
                + ("; ".join(dict.fromkeys(finding.reasons)) or "this line does not follow")
            )
            unbounded = unbounded and finding.unbounded
    scales = scale_variables(goal)
    goal = with_scales_one(goal, scales)
    finding, bound = _settle(goal, budget.boxes // 8, tally), None
    if finding.reasons:
        bound = enclose_goal(goal, budget.width, 3 * budget.boxes // 8)
        tally.boxes += bound.boxes if bound else 0
        finding.point = bound.point if bound else None
        if bound.room if bound else not (finding.unbounded or finding.thin):
            finding = _settle(goal, budget.boxes - tally.boxes, tally)
    if finding.point is not None:
        return _failure(goal, finding.point, tally, scales)
    if bound is not None and not reasons and finding.reasons:
        return _enclosed(bound, tally)
    reasons += [
        f"goal: {reason}"
        for reason in dict.fromkeys(finding.reasons)
        if not (bound and bound.positive)
    ]
    if reasons:
        undecided = not unbounded or finding.reasons and not finding.unbounded
        return Vote(
            "boxes", "unknown" if undecided else "not applicable", "; ".join(reasons), tally.boxes
        )
    return _success(tally)


def _settle(question: VoteQuestion, allowance: int, tally: Tally) -> BoxFinding:
    """Whether the question has a solution, branch by branch; what it is, or why nothing was
    decided.
    """
    matrix, finding = question.matrix(), BoxFinding()
    parts = regions(question.names, matrix)
    if parts is None:
        return BoxFinding(reasons=[f"more than {limits.MOST_BRANCHES} branches"])
    leaves = 0
    for region in parts:
        unbounded = region.unbounded()
        outcome = refute(
            region.facts,
            region.box(),
            limits.TRIAL if unbounded else max(limits.TRIAL, allowance // len(parts)),
            region.test(matrix),
        )
        tally.boxes += outcome.boxes
        if outcome.point is not None:
            return BoxFinding(point=region.complete(outcome.point))
        if unbounded:
            finding.unbounded = True
            finding.reasons.append(f"the region is not bounded in {', '.join(unbounded)}")
        elif not outcome.empty:
            finding.thin = finding.thin or any(
                fact.relation in ("=", "!=") for fact in region.facts
            )
            finding.reasons.append(
                "undecided after the counted boxes" + (", near an equation" if finding.thin else "")
            )
        else:
            leaves += outcome.leaves
    if not finding.reasons:
        tally.leaves += leaves
    return finding


def _failure(
    question: VoteQuestion, point: list[Fraction], tally: Tally, scales: tuple[str, ...]
) -> Vote:
    model = tuple(
        (name, "1" if name in scales else str(value)) for name, value in zip(question.names, point)
    )
    detail = f"an exact point after {tally.boxes} boxes"
    return Vote("boxes", "fails", detail, tally.boxes, model)


def _enclosed(bound: GoalBound, tally: Tally) -> Vote:
    answer = "holds" if bound.positive else "enclosed" if bound.narrow else "unknown"
    detail = f"the bound of what is shown, {tally.boxes} boxes in all"
    return Vote("boxes", answer, detail, tally.boxes, enclosures=bound.enclosures)


def _success(tally: Tally) -> Vote:
    detail = (
        f"{tally.leaves} boxes discarded"
        if tally.leaves
        else "the facts contradict each other before any box is cut"
    )
    return Vote("boxes", "holds", detail, tally.boxes)
