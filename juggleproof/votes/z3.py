"""The vote of Z3 on a statement's negation: nlsat for real polynomials, its quantified sibling for
`exists`, counted work only.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from importlib import import_module
from itertools import islice, product
from typing import TYPE_CHECKING, NamedTuple

from juggleproof.algebra import trees
from juggleproof.algebra.number_field import sign_at
from juggleproof.algebra.numbers import AlgebraicNumber, root_number
from juggleproof.algebra.polynomials import with_value
from juggleproof.algebra.trees import OPPOSITE
from juggleproof.certificates import checker
from juggleproof.statements.vote import Vote, VoteBudget
from juggleproof.votes import limits
from juggleproof.votes.questions import (
    Atom,
    Denial,
    Formula,
    VoteQuestion,
    atom,
    branches,
    changed,
    join,
    questions,
    ring_of,
    scale_variables,
    with_scales_one,
)
from juggleproof.votes.smtlib import question_text, symbol

if TYPE_CHECKING:
    from z3 import Context, ExprRef, ModelRef, Solver

Exact = Fraction | AlgebraicNumber
TACTICS = {
    "nlsat": ("simplify", "propagate-values", "qfnra-nlsat"),
    "nlqsat": ("simplify", "nnf", "nlqsat"),
    "smt": ("smt",),
}
SEEDS = {"nlsat": "seed", "smt": "random_seed"}  # nlqsat takes no seed: it draws no random numbers


@dataclass(frozen=True)
class Reply:
    """sat, unsat or unknown; for sat the exact values of the free variables; by which steps."""

    answer: str
    point: dict[str, Exact] | None = None
    how: str = ""


class Model(NamedTuple):
    """Values at which a line of a statement fails, by exact evaluation of our own polynomials;
    `part` names the line as the question does, "goal" or "obligation N".
    """

    part: str
    point: Mapping[str, Exact]


class VoteSession:
    """A fresh Z3 context with a purse of resource units that all the queries of one vote share."""

    def __init__(self, purse: int, outer: VoteSession | None = None) -> None:
        self.z3 = import_module("z3")  # here, since it takes long to load
        self.context: Context = outer.context if outer else self.z3.Context()
        self.outer, self.purse, self.spent = outer, purse, 0
        # the context's counter, which goes on from query to query
        self.before: int = outer.before if outer else 0

    def ask(self, question: VoteQuestion, engine: str, units: int) -> Reply:
        """One query, for at most this number of resource units."""
        units = min(units, self.purse - self.spent)
        if units <= 0:
            return Reply("unknown", how="the budget is spent")
        z3 = self.z3
        steps = [z3.Tactic(name, ctx=self.context) for name in TACTICS[engine]]
        solver = (z3.Then(*steps, ctx=self.context) if len(steps) > 1 else steps[0]).solver()
        solver.set("rlimit", units)
        if engine in SEEDS:
            solver.set(SEEDS[engine], 0)
        solver.from_string(question_text(question))
        try:
            answer = str(solver.check())
        except z3.Z3Exception as error:
            return Reply("unknown", how=f"{engine} stopped: {error}")
        finally:
            self._count(solver, units)
        point = self._point(question, solver.model()) if answer == "sat" else None
        return Reply(answer, point, f"{answer} by {engine}")

    def _count(self, solver: Solver, units: int) -> None:
        table = solver.statistics()
        total = next(
            (int(table.get_key_value(key)) for key in table.keys() if key == "rlimit count"),
            self.before,
        )
        already = self.spent
        self.spent += max(0, min(total - self.before, 2 * units)) + 1
        self.before = max(total, self.before)
        if self.outer:
            self.outer.spent += self.spent - already
            self.outer.before = self.before

    def _point(self, question: VoteQuestion, model: ModelRef) -> dict[str, Exact] | None:
        values = {declared.name(): model[declared] for declared in model.decls()}
        try:
            return {
                name: self._exact(values.get(symbol(name)))
                for name in question.names
                if name not in question.bound
            }
        except ValueError:
            return None

    def _exact(self, value: ExprRef | None) -> Exact:
        if value is None:
            return Fraction(0)  # a variable that the model leaves open may take any value
        if self.z3.is_algebraic_value(value):
            parts = [c.as_fraction() for c in value.poly()]
            scale = max(c.denominator for c in parts)
            if any((c * scale).denominator != 1 for c in parts):
                raise ValueError("a model's polynomial is not over the integers")
            root = root_number([int(c * scale) for c in parts], value.index())
            return root.as_fraction() if root.is_rational else root
        if self.z3.is_rational_value(value):
            return Fraction(str(value.as_fraction()))
        if self.z3.is_int_value(value):
            return Fraction(value.as_long())
        raise ValueError("a model's value is not a number")


def vote(
    statement: checker.Statement,
    earlier: Mapping[str, checker.Statement] | None = None,
    budget: VoteBudget | None = None,
    asked: Sequence[VoteQuestion] | None = None,
) -> Vote:
    """Z3's vote on a statement of the checker: `holds` where every question is unsat, `fails` where
    a model passes exact evaluation.

    >>> from juggleproof.votes.questions import read_statement
    >>> str(vote(read_statement("statement demo/root\\nforall x\\ngiven x > 0\\nshow x^2 != 2")))
    'z3 says fails at x = the root of z^2 - 2 in [181/128, 5793/4096] (goal: sat by nlsat)'
    """
    return vote_and_model(statement, earlier, budget, asked)[0]


def vote_and_model(
    statement: checker.Statement,
    earlier: Mapping[str, checker.Statement] | None = None,
    budget: VoteBudget | None = None,
    asked: Sequence[VoteQuestion] | None = None,
) -> tuple[Vote, Model | None]:
    """Z3's vote, and the values at which what is shown fails, or else a line before it; None where
    there are none, or where Z3 alone says that nothing exists there.
    """
    session = VoteSession((budget or VoteBudget()).rlimit)
    asked, notes, open_lines = asked or questions(statement, earlier), [], False
    model: Model | None = None
    for question in asked:
        if question.beyond_routes:
            open_lines = True
            notes.append("outside: not asked")
            continue
        reply = decide(session, question)
        notes.append(f"{question.part}: {reply.how}")
        if reply.answer == "sat":
            failure = _failure(session, question, reply)
            if failure.decided and not question.quantified:
                model = model or Model(question.part, reply.point or {})
            if question.refutes:
                return failure, model
        open_lines = open_lines or reply.answer != "unsat"
    if open_lines:
        detail = "; ".join(note for note in notes if "unsat" not in note)
        return Vote("z3", "unknown", detail, session.spent), model
    return Vote("z3", "holds", "; ".join(dict.fromkeys(notes)), session.spent), None


def _failure(session: VoteSession, question: VoteQuestion, reply: Reply) -> Vote:
    """`fails` only for a model at which our own polynomials say the same, exactly."""
    point = reply.point
    if point is None:
        return Vote(
            "z3",
            "unknown",
            f"{question.part}: sat, but the model has no exact values",
            session.spent,
        )
    if any(
        isinstance(value := point[name], AlgebraicNumber) or value.denominator != 1
        for name in question.integers & set(point)
    ):
        return Vote(
            "z3",
            "unknown",
            f"{question.part}: sat, but an integer has another value in the model",
            session.spent,
        )
    values = [point.get(name, Fraction(0)) for name in question.names]
    free = join("and", [*question.assumed, *(d.formula for d in question.denials if not d.bound)])
    if _truth_at(free, values) is not True:
        return Vote(
            "z3",
            "unknown",
            f"{question.part}: sat, but the model does not pass exact evaluation",
            session.spent,
        )
    how = reply.how
    for denial in question.denials:
        if denial.bound:
            again = _any_value(session, question, denial, point)
            if again != "unsat":
                return Vote(
                    "z3",
                    "unknown",
                    f"{question.part}: sat, but a second query about its model is {again}",
                    session.spent,
                )
            how += ", and no " + ", ".join(denial.bound) + " there by a second query"
    model = tuple((name, _text(value)) for name, value in point.items())
    return Vote("z3", "fails", f"{question.part}: {how}", session.spent, model)


def _any_value(
    session: VoteSession, question: VoteQuestion, denial: Denial, point: dict[str, Exact]
) -> str:
    """Whether, at the model's values, some values of the bound variables break the denial."""
    facts: list[Formula] = []
    generators = dict(zip(question.names, ring_of(question.names).gens()))
    for name, value in point.items():
        x = generators[name]
        if isinstance(value, AlgebraicNumber):
            low, high = value.enclosure(limits.ROOT_BITS)
            facts += [
                atom(sum(c * x**k for k, c in enumerate(value.coefficients)), "="),
                atom(x * low.denominator - low.numerator, ">"),
                atom(high.numerator - x * high.denominator, ">"),
            ]
        else:
            facts.append(atom(x * value.denominator - value.numerator, "="))
    asked = replace(question, assumed=tuple(facts), denials=(Denial((), negation(denial.formula)),))
    return decide(session, asked).answer


def _text(value: Exact) -> str:
    if isinstance(value, Fraction):
        return str(value)
    low, high = value.enclosure(limits.ROOT_BITS)
    return f"the root of {value.polynomial_text('z')} in [{low}, {high}]"


def _truth_at(formula: Formula, point: Sequence[Exact]) -> bool | None:
    """The exact truth value of the formula at the point; None where a sign takes too many bits."""

    def decide(fact: Atom) -> bool | None:
        sign = sign_at(fact.poly, point)
        return None if sign is None else fact.holds(sign)

    return trees.truth(formula, decide)


def negation(formula: Formula) -> Formula:
    """The negated formula, with `not` driven down to the atoms."""
    return trees.negated(formula, lambda one: atom(-one.poly, OPPOSITE[one.relation]), join)


def decide(session: VoteSession, question: VoteQuestion) -> Reply:
    """The question's answer, by steps that are each sound for the whole question, cheap ones first.

    As it stands; with scales set to 1, which loses nothing; branch by branch, or with witnesses
    tried for what is to exist, which only makes them harder to find.  Integers are first let
    be reals, after p > 0 has become p >= 1: unsat then settles the whole; a solution in reals
    counts only if its integers are integers, and otherwise small integers are tried in turn.
    """
    if question.integers & set(question.occurring()):
        return _with_integers(session, question)
    question = replace(question, integers=frozenset())
    engine = "nlqsat" if question.quantified else "nlsat"
    reply = session.ask(question, engine, session.purse // 16)
    if False in (*question.assumed, *(denial.formula for denial in question.denials)):
        return Reply(
            reply.answer, reply.point, reply.how + ", where expanding leaves nothing to ask"
        )
    if reply.answer != "unknown":
        return reply
    scales = scale_variables(question)
    with_scales = f" with {', '.join(scales)} = 1" if scales else ""
    question = with_scales_one(question, scales)
    reply = session.ask(question, engine, session.purse // 4)
    if reply.answer == "unknown":
        reply = (
            _with_witnesses(session, question)
            if question.quantified
            else _by_branches(session, question, engine)
        )
    if (
        reply.answer == "unknown" and not question.quantified
    ):  # never smt, whose simplex does work on reals that no unit counts
        reply = session.ask(question, engine, session.purse // 2)
    point = (
        {**reply.point, **{name: Fraction(1) for name in scales}}
        if reply.point is not None
        else None
    )
    return Reply(reply.answer, point, reply.how + with_scales)


def _with_integers(session: VoteSession, question: VoteQuestion) -> Reply:
    if question.integers & question.bound:
        return session.ask(question, "smt", session.purse)
    relaxed, names = (
        replace(_tightened(question), integers=frozenset()),
        [n for n in question.occurring() if n in question.integers],
    )
    reply = decide(VoteSession(session.purse // 4, session), relaxed)
    if reply.answer == "unsat":
        return Reply("unsat", how=reply.how + " even for reals")
    if reply.point is not None and all(_is_integer(reply.point[name]) for name in names):
        return reply
    for values in islice(product(range(4), repeat=len(names)), limits.MOST_TRIES):
        tried = relaxed
        for name, value in zip(names, values):
            tried = at_integer(tried, name, value)
        reply = session.ask(tried, "nlqsat" if tried.quantified else "nlsat", session.purse // 32)
        if reply.answer == "sat" and reply.point is not None:
            return Reply(
                "sat",
                {**reply.point, **dict(zip(names, map(Fraction, values)))},
                f"{reply.how} at small integers",
            )
    return session.ask(question, "smt", session.purse // 8)


def _is_integer(value: Exact) -> bool:
    return isinstance(value, Fraction) and value.denominator == 1


def _tightened(question: VoteQuestion) -> VoteQuestion:
    """p >= 1 in place of p > 0 where p has integer coefficients and integer variables only."""

    def change(fact: Atom) -> Formula:
        own = {question.names[i] for i in fact.used}
        if fact.relation != ">" or not own <= question.integers:
            return fact
        return atom(fact.poly - 1, ">=")

    return changed(question, change)


def at_integer(question: VoteQuestion, name: str, value: int) -> VoteQuestion:
    """The question with an integer in place of one variable, which no denial binds any more."""
    i = question.names.index(name)
    new = changed(
        question, lambda fact: atom(with_value(fact.poly, i, Fraction(value)), fact.relation)
    )
    return replace(
        new,
        denials=tuple(
            Denial(tuple(n for n in d.bound if n != name), d.formula) for d in new.denials
        ),
    )


def _by_branches(session: VoteSession, question: VoteQuestion, engine: str) -> Reply:
    parts = branches(question.matrix(), limits.MOST_BRANCHES)
    if parts is None or len(parts) < 2:
        return Reply("unknown", how="undecided within the budget")
    share = max(1, (session.purse - session.spent) // len(parts))
    for facts in parts:
        reply = session.ask(replace(question, assumed=facts, denials=()), engine, share)
        if reply.answer != "unsat":
            return (
                reply
                if reply.answer == "sat"
                else Reply("unknown", how="undecided within the budget")
            )
    return Reply("unsat", how=f"unsat by {engine} in each of {len(parts)} branches")


def _with_witnesses(session: VoteSession, question: VoteQuestion) -> Reply:
    """Tries the value 0 for one variable that is to exist, and asks again: unsat then settles
    the whole.
    """
    if not question.refutes or question.part == "outside":
        return Reply("unknown", how="undecided within the budget")
    for name in (name for name in question.names if name in question.bound):
        tried = at_integer(question, name, 0)
        reply = session.ask(tried, "nlqsat" if tried.quantified else "nlsat", session.purse // 4)
        if reply.answer == "unsat":
            return Reply("unsat", how=f"{reply.how} with the witness {name} = 0")
    return Reply("unknown", how="undecided within the budget")
