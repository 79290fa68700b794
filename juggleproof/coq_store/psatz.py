"""The rule psatz as a computation of Coq on terms (see sums.py): a sum of products is 0, though
each product is positive or not negative.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import chain
from math import gcd

from juggleproof.certificates import checker
from juggleproof.coq_store.branch import Branch
from juggleproof.coq_store.text import common_factor, coq_name, numeral, polynomial
from juggleproof.statements.nodes import Cofactor, Product

LONG = 10**60  # the largest weight, when all are whole
Square = tuple[Fraction, checker.Poly]  # a weight, and the polynomial that is squared
Factors = tuple[tuple[int, int], ...]  # numbers of facts, and exponents


def psatz(branch: Branch, products: Sequence[Product], equations: Sequence[Cofactor]) -> list[str]:
    """The tactics for the goal False: the sum of products and of multiples of equations is 0."""
    squares: dict[Factors, list[Square]] = {}
    for coefficient, factors, text in products:
        key = tuple((index, exponent) for index, exponent in factors)
        one = Fraction(checker.rational(coefficient)), branch.poly(text)
        squares.setdefault(key, []).append(one)
    shares = [(branch.state.facts[index][0], branch.poly(text)) for index, text in equations]
    facts = [branch.state.facts[index][0] for key in squares for index, _ in key]
    roots = [root for some in squares.values() for _, root in some]
    # others may be no variables of the proof, such as values that are yet to be found
    together, mask = 0, (1 << checker.BITS) - 1
    for poly in [*facts, *roots, *chain(*shares)]:
        for monomial in poly.terms:
            together |= monomial
    names = branch.names.items()
    sum_ = WeightedProducts(
        branch, [name for name, at in names if together >> (checker.BITS * at) & mask]
    )
    multiples = [Fraction(1, poly.den * cofactor.den) for poly, cofactor in shares]
    below = {key: _denominators(branch, key) for key in squares}
    weights = [
        weight / root.den**2 / below[key] for key, some in squares.items() for weight, root in some
    ]
    is_long = common_factor([*weights, *multiples]) * max(weights) > LONG
    for key, some in squares.items():
        own = [one for one in some if is_long and not one[1].constant()]
        if own:
            content, fact = sum_.not_negative(own)
            sum_.add(content / below[key], key, [fact])
        for weight, root in some:
            if not is_long or root.constant():
                sum_.add(weight / below[key] / root.den**2, key, [], root)
    scale = common_factor([*(weight for weight, _ in sum_.summands), *multiples])
    cofactors = [
        f"(num {numeral(int(share * scale))} * {sum_.expression(cofactor)})%expression"
        for share, (_, cofactor) in zip(multiples, shares)
    ]
    zeros = [sum_.expression(poly) for poly, _ in shares]
    vanish = held([branch.facts[index] for index, _ in equations])
    return [
        *sum_.rows,
        f"refine (no_common_point {sum_.variables()}",
        f"  {sum_.facts()} {listed(zeros)}",
        f"  {sum_.scaled(scale)} {listed(cofactors)}",
        f"  {held(sum_.proofs)} {vanish} _).",
        "vm_cast_no_check (eq_refl true).",
    ]


class WeightedProducts:
    """Weighted products of facts and squares in the variables of these names; rows: the tactics
    that show the facts.
    """

    def __init__(self, branch: Branch, names: Sequence[str]) -> None:
        self.branch = branch
        self.names = names
        self.rows: list[str] = []
        self.texts: list[str] = []
        self.proofs: list[str] = []
        self.places: dict[int, int] = {}
        self.summands: list[tuple[Fraction, str]] = []

    def variables(self) -> str:
        """The list of the variables."""
        return listed([coq_name(name) for name in self.names])

    def expression(self, poly: checker.Poly) -> str:
        """The numerator of a polynomial as a term to compute with."""
        values = {name: f"var {place}" for place, name in enumerate(self.names, 1)}
        text = polynomial(self.branch.names, poly, values=values, number="num ")
        return f"({text})%expression"

    def facts(self) -> str:
        """The facts that it uses: whether each is strict, and its term."""
        return listed(self.texts)

    def fact(self, strict: bool, text: str, proof: str) -> int:
        """Adds a fact, and returns its place."""
        self.texts.append(f"({str(strict).lower()}, {text})")
        self.proofs.append(proof)
        return len(self.proofs) - 1

    def add(
        self,
        weight: Fraction,
        factors: Factors,
        more: Sequence[int],
        root: checker.Poly | None = None,
    ) -> None:
        """Adds a product of powers of facts of the branch, more facts and a square."""
        powers = []
        for index, exponent in factors:
            poly, relation = self.branch.state.facts[index]
            if relation == "!=":
                exponent //= 2
            if index not in self.places:
                text, proof = self.expression(poly), self.branch.facts[index]
                if relation == "!=":
                    text, proof = f"({text} ^ 2)%expression", f"(square_of_nonzero _ {proof})"
                self.places[index] = self.fact(relation != ">=", text, proof)
            powers.append(f"({self.places[index]}%nat, {exponent}%positive)")
        powers += [f"({place}%nat, 1%positive)" for place in more]
        constant, squared = root.constant() if root else Fraction(1), "None"
        if root and not constant:
            squared = f"Some {self.expression(root)}"
        elif root and constant:
            weight *= (constant * root.den) ** 2
        self.summands.append((weight, f"{listed(powers)}, {squared})"))

    def scaled(self, scale: int) -> str:
        """The products, with weights that are multiplied by a factor that makes them whole."""
        return listed(
            [f"({numeral(int(weight * scale))}%positive, {text}" for weight, text in self.summands]
        )

    def not_negative(self, squares: Sequence[Square]) -> tuple[Fraction, int]:
        """Shows that a sum of squares is not negative.  Squares are added from the last to the
        first: sums of fewer squares have shorter coefficients than all weights made whole.  Returns
        (c, the place of the fact); c times the polynomial of the fact is the sum.
        """
        work, text, proof = checker.Work(1 << 60), "", ""
        total, before = checker.number(0, work), Fraction(0)
        for weight, root in reversed(squares):
            own = checker.Poly(root.terms, root.den, root.deg, root.bits, work)
            total = total.plus(own * own, weight)
            number, poly = total.primitive()
            poly, content = poly if number > 0 else -poly, Fraction(abs(number), total.den)
            parts = [content, weight / root.den**2, before]
            scale = common_factor(parts)
            numbers = [int(part * scale) for part in parts]
            whole = [number // gcd(*numbers) for number in numbers]
            step = WeightedProducts(self.branch, self.names)
            step.summands.append((Fraction(whole[1]), f"nil, Some {self.expression(own)})"))
            if proof:
                place = step.fact(False, text, proof)
                step.add(Fraction(whole[2]), (), [place])
            text, proof, before = self.expression(poly), self.branch.fresh(), content
            self.rows += [
                f"assert ({proof} : 0 <= value {self.variables()} {text}).",
                f"{{ refine (sum_not_negative {self.variables()} {step.facts()}",
                f"  {step.scaled(1)} {numeral(whole[0])} _ {held(step.proofs)} _).",
                "vm_cast_no_check (eq_refl true). }",
            ]
        return before, self.fact(False, text, proof)


def _denominators(branch: Branch, factors: Factors) -> int:
    """The denominator of a product of facts, which the facts in Coq do not have."""
    below = 1
    for index, exponent in factors:
        below *= branch.state.facts[index][0].den ** exponent
    return below


def listed(parts: Sequence[str]) -> str:
    """A list of Coq."""
    return f"({' :: '.join([*parts, 'nil'])})%list"


def held(proofs: Sequence[str]) -> str:
    """The proof that all of some facts hold."""
    return "".join(f"(conj {proof} " for proof in proofs) + "I" + ")" * len(proofs)
