"""A statement as Coq text, and the same formula at values in two forms.

A lemma is over variables; at given values, its atoms are about the values in place of the
variables.  The checker, which puts values into the statement's text, has atoms without
denominators.  Each atom is a multiple of the other by a positive factor (a nonzero one, for = and
!=), which `Transfer` names.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import combinations, product
from math import prod

from juggleproof.certificates import checker
from juggleproof.coq_store.branch import Branch, Factors, positive, power
from juggleproof.coq_store.text import (
    NotWritten,
    atom,
    conjoined,
    conjunctive,
    coq_name,
    polynomial,
    proposition,
    some,
)

Numbers = Mapping[str, checker.Poly]  # {variable: its value}
APART = "a value divides by what no fact of the branch names"
TURNED = "values turn the sign of an atom"


def denominator(branch: Branch, licence: checker.Poly) -> tuple[int, int]:
    """(number of a fact, c): c times the polynomial that is known to be nonzero is the numerator of
    the fact.
    """
    facts = sorted(enumerate(branch.state.facts), key=lambda entry: entry[1][1] != ">")
    for index, (poly, relation) in facts:
        if relation in (">", "!="):
            content, primitive = poly.primitive()
            if primitive.terms in (licence.terms, (-licence).terms):
                return index, content if primitive.terms == licence.terms else -content
    raise NotWritten(APART)


def value_text(branch: Branch, value: checker.Poly) -> str:
    """A value as a term of Coq over the variables of the branch."""
    factor, below = 1, [str(value.den)] * (value.den != 1)
    for (licence, _), exponent in value.under.items():
        index, content = denominator(branch, licence)
        factor *= content**exponent
        below.append(f"({polynomial(branch.names, branch.state.facts[index][0])}) ^ {exponent}")
    above = polynomial(branch.names, value, factor)
    if not below and re.fullmatch(r"[\w']+", above):
        return above
    above = f"({above})"
    return f"({above} / ({' * '.join(below)}))" if below else above


def nonzero(branch: Branch, values: Numbers) -> list[str]:
    """Hypotheses by which `field` may divide by the divisors of the values."""
    rows = []
    for index in sorted(
        {denominator(branch, licence)[0] for value in values.values() for licence, _ in value.under}
    ):
        relation, name = branch.state.facts[index][1], branch.facts[index]
        if relation == ">":
            rows.append(f"pose proof (Rgt_not_eq _ _ {name}) as {branch.fresh()}.")
    return rows


def substituted(poly: checker.Poly, names: Mapping[str, int], values: Numbers) -> checker.Poly:
    """The numerator of a polynomial, with values in place of all its variables."""
    work = checker.Work()
    total = checker.number(0, work)
    for monomial, coefficient in poly.terms.items():
        term = checker.number(coefficient, work)
        for name, place in names.items():
            exponent = monomial >> (checker.BITS * place) & ((1 << checker.BITS) - 1)
            if exponent:
                term = term * values[name] ** exponent
        total = total + term
    return total


class Transfer:
    """Proofs of P <-> Q: P is a formula of a lemma at values, and Q the checker's form of it."""

    def __init__(self, branch: Branch, names: Mapping[str, int], values: Numbers) -> None:
        self.branch = branch
        self.names = names
        self.values = values
        self.texts = {name: value_text(branch, value) for name, value in values.items()}
        self.rows: list[str] = []

    def same(self, formula: checker.Formula, target: checker.Formula) -> str:
        """The name of a proof that the formula at the values <=> the target, whose tactics are
        added to the rows.
        """
        at_values = proposition(self.names, formula, self.texts)
        if at_values == self.branch.write(target):
            return f"(iff_refl ({at_values}))"
        if isinstance(formula, bool):
            raise NotWritten("values change a constant formula")
        plain: dict[int, checker.Poly] = {}
        folded = self._folded(formula, plain)
        pairs: dict[int, checker.Poly] = {}
        _paired(folded, target, pairs)
        middle, proof = self._proof(formula, plain, pairs)
        if middle == self.branch.write(target):
            return proof
        last = self.branch.fresh()
        self.rows.append(
            f"assert ({last} : {middle} <-> {self.branch.write(target)}) by equivalent."
        )
        return f"(iff_trans {proof} {last})"

    def _folded(
        self, formula: checker.Atom | checker.Join, plain: dict[int, checker.Poly]
    ) -> checker.Formula:
        """The formula at the values without denominators; plain: {id of an atom's polynomial in
        the formula: the polynomial here}.
        """
        if formula[0] != "atom":
            return checker.join(formula[0], [self._folded(part, plain) for part in formula[1]])
        _, poly, relation = formula
        value = substituted(poly, self.names, self.values)
        signless = [
            licence
            for (licence, sign), exponent in value.under.items()
            if exponent % 2 and not sign and ">" in relation
        ]
        plain.setdefault(id(poly), prod(signless, start=value.over({})))
        return checker.fold(plain[id(poly)], relation)

    def _proof(
        self,
        formula: checker.Atom | checker.Join,
        plain: dict[int, checker.Poly],
        pairs: dict[int, checker.Poly],
    ) -> tuple[str, str]:
        """(a formula that is equivalent to the formula at the values, a proof of this)."""
        if formula[0] == "atom":
            _, poly, relation = formula
            own = plain[id(poly)]
            text = f"({polynomial(self.names, poly, values=self.texts)})"
            value = substituted(poly, self.names, self.values)
            return self.atom(text, value, relation, pairs.get(id(own), own))
        parts = [self._proof(part, plain, pairs) for part in formula[1]]
        lemma, sign = ("both", "/\\") if formula[0] == "and" else ("either", "\\/")
        text, proof = parts[-1]
        for before, first in reversed(parts[:-1]):
            text, proof = f"({before}) {sign} ({text})", f"({lemma} _ _ _ _ {first} {proof})"
        return f"({text})", proof

    def whole(self, form: Form, names: Sequence[str]) -> list[str]:
        """Proofs that the values of integer variables are integers."""
        integers = [self.texts[name] for name in names if name in form.integers]
        return [f"(ltac:(wholly) : whole {text})" for text in integers]

    def fact(self, text: str, value: checker.Poly, target: checker.Formula) -> str:
        """A proof that an atom about a text of this value is equivalent to the target."""
        if isinstance(target, bool) or target[0] != "atom":
            raise NotWritten("an adjoined number is the root of a number")
        return self.atom(text, value, target[2], target[1])[1]

    def atom(
        self, text: str, value: checker.Poly, relation: str, target: checker.Poly
    ) -> tuple[str, str]:
        """(the atom about the numerator of the target, a proof that the one about the text, which
        has this value, is equivalent to it).
        """
        wanted = polynomial(self.branch.names, target)
        if f"({wanted})" == text:
            return atom(wanted, relation), f"(iff_refl ({atom(wanted, relation)}))"
        signed = ">" in relation
        under, ratio, exponents = self._multiple(value, target)
        share, above, below = ratio / value.den, Factors(), Factors()
        for licence, exponent in zip(under, exponents):
            index, content = denominator(self.branch, licence)
            known, name = self.branch.state.facts[index][1], self.branch.facts[index]
            share *= Fraction(content) ** exponent
            if signed and known == "!=" and exponent % 2:
                raise NotWritten(TURNED)
            if not signed:
                name = name if known == "!=" else f"(Rgt_not_eq _ _ {name})"
                factor = f"(pow_nonzero _ {abs(exponent)} {name})", True
            else:
                factor = power(known, name, abs(exponent))
            if exponent:
                (below if exponent > 0 else above).append(factor)
        if signed and share < 0:
            raise NotWritten(TURNED)
        # (the factors below) * text = share * (those above) * (the numerator of the target)
        if signed:
            sides = [positive(share.denominator, below), positive(share.numerator, above)]
        else:
            sides = [_apart(share.denominator, below), _apart(share.numerator, above)]
        lemma = {">": "scale_gt", ">=": "scale_ge", "=": "scale_eq", "!=": "scale_ne"}[relation]
        proof = self.branch.fresh()
        self.rows += [
            f"assert ({proof} : {atom(text, relation)} <-> {atom(wanted, relation)}).",
            f"{{ refine ({lemma} _ _ _ _ {' '.join(sides)} _). {self.equal(text)}. }}",
        ]
        return atom(wanted, relation), proof

    def equal(self, text: str) -> str:
        """The tactic that shows that a multiple of the text is a multiple of a polynomial."""
        return "field; repeat split; assumption" if "/" in text else "ring"

    def _multiple(
        self, value: checker.Poly, target: checker.Poly
    ) -> tuple[list[checker.Poly], Fraction, list[int]]:
        """(factors, c, exponents) with (the factors)^exponents * value = c * target, for the
        numerators.  The factors are the divisors of the value, and at most two more that are known
        to be nonzero.
        """
        under = [(licence, exponent) for (licence, _), exponent in value.under.items()]
        known = [licence.terms for licence, _ in under]
        others = [
            (licence, 0)
            for licence, _ in self.branch.state.context.licensed.values()
            if licence.terms not in known
        ]
        for more in ((), *combinations(others, 1), *combinations(others, 2)):
            result = _exponents(value, target, [*under, *more])
            if result:
                return [licence for licence, _ in [*under, *more]], *result
        raise NotWritten("values change an atom by more than what is known to be nonzero")


def _apart(weight: int, factors: Factors) -> str:
    """A proof that a product of factors other than 0 is other than 0."""
    proof = f"(not_0_IZR ({weight}) ltac:(discriminate))"
    for name, _ in factors:
        proof = f"(prod_neq_R0 _ _ {proof} {name})"
    return proof


def _exponents(
    value: checker.Poly, target: checker.Poly, under: Sequence[tuple[checker.Poly, int]]
) -> tuple[Fraction, list[int]] | None:
    """(c, exponents) with (the divisors)^exponents * value = c * target, for the numerators."""
    choices = product(*(range(min(-1, e - 2), e + 2) for _, e in under))
    for powers in sorted(choices, key=lambda one: (sum(map(abs, one)), one)):
        own, other = value.over({}), target.over({})
        for (licence, _), e in zip(under, powers):
            own, other = own * licence ** max(-e, 0), other * licence ** max(e, 0)
        if own.terms.keys() == other.terms.keys():
            ratios = {Fraction(own.terms[m], other.terms[m]) for m in own.terms}
            if len(ratios) < 2:
                exponents = [exponent - e for (_, exponent), e in zip(under, powers)]
                return (ratios.pop() if ratios else Fraction(1)), exponents
    return None


def _paired(own: checker.Formula, target: checker.Formula, pairs: dict[int, checker.Poly]) -> None:
    """Finds for each atom of a formula the atom of another formula of the same shape."""
    if isinstance(own, bool) or isinstance(target, bool):
        same = own is target
    elif own[0] == "atom" and target[0] == "atom":
        same = own[2] == target[2]
        pairs[id(own[1])] = target[1]
    elif own[0] != "atom" and target[0] != "atom":
        same = own[0] == target[0] and len(own[1]) == len(target[1])
        for one, other in zip(own[1], target[1]):
            _paired(one, other, pairs)
    else:
        same = False
    if not same:
        raise NotWritten("values change the shape of a formula")


# -------------------------------------------------------------------------------------------------
# The Coq text of a statement, and values for its variables.


class Form:
    """A statement for all variables but those of `base`, as Coq text.

    unfolding: that of its lines; universal, existential: the variables; given: the numbers of the
    premises that are assumed, without those that are derived, or stated before it.
    """

    def __init__(
        self,
        statement: checker.Statement,
        base: Sequence[str] = (),
        sharp: Sequence[ast.expr] | None = None,
    ) -> None:
        self.statement = statement
        self.unfolding = checker.Unfolding(statement, checker.Context(), sharp)
        keyword = [key for key, _ in statement.lines if key in ("have", "root")]
        derived = {
            count for (count, _), key in zip(self.unfolding.obligations, keyword) if key == "have"
        } | set(range(len(sharp or ())))
        self.given = [k for k in range(len(self.unfolding.premises)) if k not in derived]
        self.names = self.unfolding.context.index
        self.universal = [name for name in self.unfolding.universal if name not in base]
        self.existential = [name for name in self.names if name not in self.unfolding.universal]
        self.integers = self.unfolding.integers

    def whole(self, names: Sequence[str]) -> list[str]:
        """The formulas that say that variables are integers."""
        return [f"whole {coq_name(name)}" for name in names if name in self.integers]

    def premises(self) -> list[str]:
        """Each premise that is assumed."""
        return [proposition(self.names, self.unfolding.premises[k]) for k in self.given]

    def goal(self) -> str:
        """The formula that is shown."""
        parts = [*self.whole(self.existential), proposition(self.names, self.unfolding.goal(True))]
        return some(self.existential, parts)

    def text(self) -> str:
        """The whole statement, in lines."""
        binder = f"forall ({' '.join(map(coq_name, self.universal))} : R), "
        rows = [binder.rstrip()] if self.universal else []
        rows += [f"{text} ->" for text in self.whole(self.universal)]
        rows += [f"({text}) ->" for text in self.premises()]
        return "\n  ".join([*rows, f"({self.goal()})"])

    def possible(self) -> str:
        """The formula that the premises hold somewhere."""
        return some(self.universal, [*self.whole(self.universal), *self.premises()])


def premise_proofs(
    branch: Branch, form: Form, inner: checker.Unfolding, name: str, values: Numbers
) -> tuple[list[str], list[str]]:
    """Tactics after which the premises of a form hold at the values, and a proof of each; the
    hypothesis `name` says that the premises of an unfolding with these values hold.
    """
    together = checker.join("and", inner.premises)
    count = len(checker.conjuncts(together)) * (together is not True)
    parts = [name] if count == 1 else [branch.fresh() for _ in range(count)]
    transfer = Transfer(branch, form.names, values)
    if count > 1:
        transfer.rows.append(f"pose proof {name} as {conjunctive(parts)}.")
    proofs = []
    for k, premise in enumerate(inner.premises):
        size = 0 if premise is True else len(checker.conjuncts(premise))
        own, parts = parts[:size], parts[size:]
        if k in form.given:
            same = transfer.same(form.unfolding.premises[k], premise)
            proofs.append(f"(proj2 {same} {conjoined(own)})")
    return transfer.rows, proofs
