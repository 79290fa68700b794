"""Branches of a written proof, and the signs of products as proof terms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from juggleproof.certificates import checker
from juggleproof.coq_store.text import (
    common_factor,
    conjunctive,
    numeral,
    proposition,
)
from juggleproof.statements.states import SearchState

Factors = list[tuple[str, bool]]  # a proof of the sign of each, and whether it is strict
Weighed = tuple[Fraction, Factors, bool]  # a weight, factors, and whether all are strict
Known = Mapping[str, checker.Statement]
Hint = Any  # of a certificate, which anyone may have written: Coq refuses what does not fit


class Branch:
    """A state of the checker beside the names of its hypotheses in Coq.

    facts, choices: the names, numbered as the state has them; absurd: a hypothesis that is false;
    known: the statements that `use` may name.
    """

    def __init__(self, state: SearchState, known: Known, count: list[int]) -> None:
        self.state = state
        self.known = known
        self.count = count
        self.facts: list[str] = []
        self.choices: list[str] = []
        self.absurd = ""

    @property
    def names(self) -> dict[str, int]:
        """The variables and their numbers."""
        return self.state.context.index

    def fresh(self) -> str:
        """A new name of a hypothesis."""
        self.count[0] += 1
        return f"of_{self.count[0]}"

    def copy(self, variables: checker.Context | None = None) -> Branch:
        """The same state, to be changed on its own; `variables`: a context with more of them."""
        other = Branch(self.state.branch(True, variables), self.known, self.count)
        other.facts += self.facts
        other.choices += self.choices
        other.absurd = self.absurd
        return other

    def write(self, formula: checker.Formula) -> str:
        """A formula over the variables of this branch."""
        return proposition(self.names, formula)

    def poly(self, text: str) -> checker.Poly:
        """A polynomial of a certificate."""
        return self.state.context.polynomial(text)

    def assume(self, formula: checker.Formula, name: str) -> list[str]:
        """Takes a hypothesis apart in the order of the checker; returns the tactics."""
        parts = checker.conjuncts(formula)
        names = [name] if len(parts) == 1 else [self.fresh() for _ in parts]
        rows = [] if len(parts) == 1 else [f"destruct {name} as {conjunctive(names)}."]
        self.state.assume(formula)
        for part, own in zip(parts, names):
            if isinstance(part, bool):
                self.absurd = self.absurd or ("" if part else own)
            else:
                (self.facts if part[0] == "atom" else self.choices).append(own)
        return rows

    def assume_number(self, formula: checker.Formula, name: str) -> list[str]:
        """The same for an atom that is written out, though it may be about a number."""
        if formula is not False:
            return [] if formula is True else self.assume(formula, name)
        false = self.fresh()
        return [f"assert ({false} : False) by (clear - {name}; lra).", *self.assume(False, false)]


def contradiction(weighed: Sequence[Weighed]) -> list[str]:
    """The tactic for the goal False, if positive products have the sum 0: one proof term gives the
    signs, and `ring` shows that the sum is 0.
    """
    return [f"exact (no_positive_zero _ {positive_sum(weighed)[0]}\n  ltac:(ring))."]


def positive_sum(weighed: Sequence[Weighed]) -> tuple[str, int]:
    """(a proof that the sum of products is positive, the factor that made the weights whole); the
    sum is only shown to be >= 0 if no product is strict.
    """
    scale = common_factor([weight for weight, _, _ in weighed])
    terms = sorted(
        ((int(weight * scale), factors, strict) for weight, factors, strict in weighed),
        key=lambda entry: not entry[2],
    )
    weight, factors, strict = terms[0]
    proof = positive(weight, factors) if strict else _nonnegative(weight, factors)
    join = "Rplus_lt_le_0_compat" if strict else "Rplus_le_le_0_compat"
    for weight, factors, _ in terms[1:]:
        proof = f"({join} _ _ {proof}\n  {_nonnegative(weight, factors)})"
    return proof, scale


def power(relation: str, name: str, exponent: int) -> tuple[str, bool]:
    """A proof of the sign of a power of a fact, and whether it is strict."""
    strict = relation in (">", "!=")
    if relation == "!=":
        name = f"(pow_lt _ {exponent // 2} (square_of_nonzero _ {name}))"
    elif exponent != 1:
        name = f"({'pow_lt' if strict else 'pow_le'} _ {exponent} {name})"
    return name, strict


def positive(weight: int, factors: Factors) -> str:
    """A proof that a product of positive factors is positive."""
    proof = f"(IZR_lt 0 ({numeral(weight)}) eq_refl)"
    for name, _ in factors:
        proof = f"(Rmult_lt_0_compat _ _ {proof} {name})"
    return proof


def _nonnegative(weight: int, factors: Factors) -> str:
    proof = f"(IZR_le 0 ({numeral(weight)}) ltac:(discriminate))"
    for name, strict in factors:
        proof = f"(Rmult_le_pos _ _ {proof} {f'(Rlt_le _ _ {name})' if strict else name})"
    return proof
