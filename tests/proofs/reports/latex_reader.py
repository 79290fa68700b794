r"""LaTeX in the notation of the paper, read back into something that has a value: the independent
half of the test of what reports print.

`read` understands a text completely or raises NotRead, with the position and the reason.  Nothing
is shared with the printer, with the parser of prints or with the checker.  Decisions, strict
wherever a human reader might hesitate:

    -x^2           -(x^2); a sign takes the whole product after it; two signs in a row are refused
    a/b c          refused, as are a/b/c, a/b \cdot c and 1/2 x: after a slash stands one factor,
    and then the product ends x 2, 2\frac12  refused: a number is the first factor of a product, or
    follows \cdot or \times \frac{a}{b}^2  refused; {x+1} c refused, for plain braces cannot be
    seen; x^12 refused x (a + b)      a product; x (a, b) a function applied, which is refused
    and, or        never side by side without parentheses; neither are \implies and \iff; a relation
    is never in a relation a < b \le c    a chain in one direction; \ne stands alone
    \sqrt{a}       has a value where a is the square of a rational number; x^K where K has an
    integer as value
"""

from __future__ import annotations

from tests.proofs.reports.latex_terms import Terms
from tests.proofs.reports.nodes import Formula, Implied, Joined, Node, Not, NotRead, chain, value
from tests.proofs.reports.statement_text import evaluate_statement_text

__all__ = ["Node", "NotRead", "evaluate_statement_text", "read", "value"]

RELATIONS = {
    **dict.fromkeys(("<", r"\lt"), "<"),
    **dict.fromkeys((r"\le", r"\leq", r"\leqslant"), "<="),
    **dict.fromkeys((">", r"\gt"), ">"),
    **dict.fromkeys((r"\ge", r"\geq", r"\geqslant"), ">="),
    "=": "=",
    **dict.fromkeys((r"\ne", r"\neq"), "!="),
}
DIRECTIONS = ({"<", "<=", "="}, {">", ">=", "="})  # what one chain may hold
CONNECTIVES = {
    **dict.fromkeys((r"\land", r"\wedge"), "and"),
    **dict.fromkeys((r"\lor", r"\vee"), "or"),
    **dict.fromkeys((r"\lnot", r"\neg"), "not"),
    **dict.fromkeys((r"\Rightarrow", r"\implies", r"\Longrightarrow"), "implies"),
    **dict.fromkeys((r"\Leftrightarrow", r"\iff", r"\Longleftrightarrow"), "iff"),
}
LONGEST = 100_000


def read(latex: str) -> Node:
    """The term, formula or vector that the text says."""
    if len(latex) > LONGEST:
        raise NotRead("too long")
    try:
        return _Reading(latex).whole()
    except RecursionError:
        raise NotRead("too deep") from None


class _Reading(Terms):
    """Formulas."""

    def connective(self) -> str:
        token = self.next()
        return (
            token.text
            if token.kind == "word"
            else CONNECTIVES.get(token.text, "")
            if token.kind == "command"
            else ""
        )

    def whole(self) -> Node:
        found = self.statement()
        if self.next().kind != "stop":
            raise self.fail("something is left over")
        return found

    def statement(self) -> Node:
        """One implication or equivalence at most; another needs parentheses."""
        at = self.next().at
        left = self.joined()
        how, in_words = self.connective(), self.next().kind == "word"
        if how not in ("implies", "iff"):
            return left
        several = self.several
        self.at += 1
        right_at = self.next().at
        right = self.joined()
        if self.connective() in ("implies", "iff"):
            raise self.fail("ambiguous: a second implication or equivalence without parentheses")
        if in_words and (several or self.several):
            raise self.fail(
                "ambiguous: an implication in words beside and, or without parentheses", at
            )
        return Implied(how, self.formula(left, at), self.formula(right, right_at))

    def joined(self) -> Node:
        """Formulas joined by `and` alone or by `or` alone."""
        at, how = self.next().at, ""
        parts = [self.negation()]
        while (found := self.connective()) in ("and", "or"):
            if how and found != how:
                raise self.fail("ambiguous: and beside or without parentheses")
            how = found
            self.at += 1
            parts.append(self.negation())
        self.several = bool(how)  # whether what was read last is joined without parentheses
        return Joined(how, tuple(self.formula(part, at) for part in parts)) if how else parts[0]

    def negation(self) -> Node:
        if self.connective() != "not":
            return self.relation()
        in_words = self.next().kind == "word"
        self.at += 1
        at = self.next().at
        if in_words and (bracketed := self.formula_in_brackets()):
            return Not(bracketed)
        denied = Not(self.formula(self.negation(), at))
        if in_words and self.connective():
            raise self.fail("ambiguous: the word not before formulas without parentheses")
        return denied

    def formula_in_brackets(self) -> Formula | None:
        """A formula in brackets of its own; nothing is read where something else stands here."""
        start = self.at
        if self.opens():
            inner = self.bracketed()
            if isinstance(inner, Formula):
                return inner
        self.at = start
        return None

    def relation(self) -> Node:
        at = self.next().at
        sides, signs = [self.sum()], []
        while (token := self.next()).kind in ("mark", "command") and token.text in RELATIONS:
            signs.append(RELATIONS[token.text])
            self.at += 1
            sides.append(self.sum())
        if not signs:
            return sides[0]
        if len(signs) > 1 and not any(set(signs) <= one_way for one_way in DIRECTIONS):
            raise self.fail(
                "ambiguous: a chain of relations in two directions, or with a sign for different",
                at,
            )
        return chain([self.term(side, at) for side in sides], signs)
