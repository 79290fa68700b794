"""A counterexample in words: the values of the two sides that disagree.

A line names the two terms that the statement compares and gives their exact values at the point.  A
term without a noun is shown itself; a long one is called by its side.  A line only states facts at
the point, and draws no conclusion.  A paper may name its terms by a subclass of `Failure`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from juggleproof.certificates import checker
from juggleproof.judging.evaluating import Point, is_true_at, value_at
from juggleproof.papers.paper import opened
from juggleproof.statements.definitions import formula_of
from juggleproof.statements.formulas import RELATIONS, Formula, Term, names_in

LONGEST = 26  # characters of a formula that is shown in a line


class Named(NamedTuple):
    """The name of a term: its noun, the state that it belongs to, and a time."""

    noun: str
    of: str = ""
    when: str = ""

    @property
    def whole(self) -> str:
        """The whole name, for a sentence with two names."""
        return " ".join(part for part in self if part)


def parts_of(formula: Formula) -> Sequence[Formula]:
    """The parts of a conjunction, or the formula alone."""
    return formula.parts if formula.op == "and" else (formula,)


@dataclass(frozen=True)
class Failure:
    """A failure of a statement at a point with rational values."""

    name: str
    point: Point
    premises: tuple[Formula, ...]
    goals: tuple[Formula, ...]

    def truth(self, formula: Formula) -> bool:
        """Whether the formula is true; raises LookupError where it cannot be evaluated."""
        known = is_true_at(str(formula), self.point)
        if known is None:
            raise LookupError(str(formula))
        return known

    def value(self, part: Term) -> Fraction:
        """The value of a term; raises LookupError where it has none."""
        known = value_at(str(part), self.point)
        if known is None:
            raise LookupError(str(part))
        return known

    def assumed(self) -> Iterator[str]:
        """The facts at the point that are stated before the goal that fails; none by default."""
        return iter(())

    # ---------------------------------------------------------------------------------------------
    # The goal that fails.

    def failing(self) -> str:
        """The values that make the first false goal false."""
        return self.why(next(goal for goal in self.goals if not self.truth(goal)), False)

    def why(self, formula: Formula, so: bool) -> str:
        """The values that make a formula true, or false."""
        parts = formula.parts
        if formula.op == "not":
            return self.why(parts[0], not so)
        if formula.op in ("and", "or"):
            if so == (formula.op == "or"):  # one part decides it
                return self.why(next(one for one in parts if self.truth(one) == so), so)
            whys = dict.fromkeys(self.why(one, so) for one in parts)
            return ", and ".join(
                one for one in whys if not any(other.startswith(f"{one},") for other in whys)
            )
        if formula.op == "implies" and not so:
            return f"what is assumed is so, and {self.why(parts[1], False)}"
        if formula.op == "iff" and not so:
            met, other = sorted(parts, key=self.truth, reverse=True)
            return (
                f"one of the two conditions holds: {self.why(met, True)}; the other fails:"
                f" {self.why(other, False)}"
            )
        if formula.op not in RELATIONS:
            raise LookupError(formula.op)
        return self.compared(*formula.sides)

    def compared(self, left: Term, right: Term) -> str:
        """Both sides of a relation with their values, and which one is greater."""
        named = [
            self.named(part, noun or (str(part) if len(str(part)) <= LONGEST else f"the {side}"))
            for part, noun, side in zip((left, right), self.sides(), ("left side", "right side"))
        ]
        values = [self.value(left), self.value(right)]
        if not names_in(left):
            named, values = named[::-1], values[::-1]
        (one, two), (a, b) = named, values
        order = f", {'more' if a > b else 'less'} than"
        if not names_in(left) or not names_in(right):
            text = " ".join(part for part in (one.noun, one.of, "is", str(a), one.when) if part)
            return text if a == b else f"{text}{order} {b}"
        if one.noun == two.noun and (one.when or two.when):
            first, second = one.when or "at first", two.when or "at first"
            if a == b:
                return f"{one.noun} is {a} both {second} and {first}"
            return f"{one.noun} is {a} {first}{order} {b} {second}"
        other = self.beside(one, two)
        if a == b:
            return f"{one.whole} and {other} are both {a}"
        return f"{one.whole} is {a}{order} {other}, {b}"

    def sides(self) -> tuple[str, str]:
        """The nouns of the two sides of the goal; empty where they have none."""
        return "", ""

    def named(self, part: Term, otherwise: str = "") -> Named:
        """The name of a term: the noun `otherwise`, or else its formula."""
        return Named(otherwise or str(part))

    def beside(self, one: Named, two: Named) -> str:
        """The name of the second of two terms, after the first has been named."""
        return two.whole

    @staticmethod
    def state_named(chosen: str) -> str:
        """The names of chosen variables; a paper may replace those of a state by its letter."""
        return chosen


def in_words(text: str, point: Point, of_paper: bool = True) -> str:
    """The sentence on a rational point at which a statement fails, with the paper's nouns if it is
    about the paper's system; empty where terms cannot be evaluated.
    """
    lines = [line.partition(" ")[::2] for line in text.splitlines()]
    premises, goals = (
        tuple(formula_of(checker.parse(one)) for word, one in lines if word == keyword)
        for keyword in ("given", "show")
    )
    kind: type[Failure] = (opened().hook("words", type) if of_paper else None) or Failure
    failure = kind(lines[0][1], point, premises, goals)
    chosen = failure.state_named(next((one for word, one in lines if word == "exists"), ""))
    try:
        what = f"no {chosen.replace(' ', ' and ')} satisfies the assertion"
        what = what if chosen else failure.failing()
        line = "; ".join([*failure.assumed(), what])
    except LookupError:
        return ""
    first = line.partition(" ")[0]
    return (line[0].upper() + line[1:] if first in ("an", "in", "no", "one", "the") else line) + "."
