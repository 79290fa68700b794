"""The premises of rules on orbits as Coq lemmas in the terms of the statements, with quotients and
square roots.  Each is proved from its polynomial lemma, which a certificate proves.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence
from itertools import groupby
from math import prod
from typing import NamedTuple

from juggleproof.certificates import checker
from juggleproof.coq_orbits.terms import ATOM, formula_of, names_of, term_of
from juggleproof.coq_store import NotWritten, lemmas
from juggleproof.coq_store.branch import Branch, Hint, Known
from juggleproof.coq_store.lemmas import certified
from juggleproof.coq_store.text import (
    conjoined,
    coq_name,
    lemma_name,
    polynomial,
    proposition,
)
from juggleproof.coq_store.transfer import Form, Transfer
from juggleproof.statements.states import SearchState

AND, OR = "/\\", "\\/"


def reading_name(name: str) -> str:
    """The name of the lemma in the terms of a statement."""
    return "of_" + lemma_name(name)


def readings(statement: checker.Statement, certificate: Hint, known: Known) -> str:
    """The premises of a rule on orbits, each as a polynomial lemma and in its own terms.

    Raises NotWritten if a part of a certificate is not written for Coq.
    """
    written = [lemmas(statement, certificate, known)]
    shown: dict[str, str] = {}
    for name, premise in checker.premises_of(statement, known).items():
        written.append(
            StatementReading(premise, certificate["certified"][name], known, shown).text()
        )
    return "\n".join(written)


class _Read(NamedTuple):
    """A proof of `reads N P Q` (Readings.v): N is a formula, P and Q are the polynomial formulas of
    N and of its negation.
    """

    holds: str
    fails: str
    proof: str


class _Texts(Transfer):
    """Atoms about terms as they stand, in which a name may be a `let` of the goal, or be given by
    an equation.
    """

    lets: Sequence[str] = ()
    sums: Sequence[str] = ()

    def equal(self, text: str) -> str:
        unfolded = f"unfold {', '.join(reversed(self.lets))}; " if self.lets else ""
        unfolded += f"rewrite {', '.join(f'?{one}' for one in self.sums)}; " if self.sums else ""
        return f"{unfolded}field; nonzero" if unfolded or "/" in text else "ring"


class StatementReading:
    """A universal statement, in the terms of its lines, as a lemma that its polynomial lemma
    proves.

    A root is written as `sqrt`.  This needs the sign of the term under it, which the certificate
    proves, and which has a lemma of its own.  Lines `have` have such lemmas too, and so do formulas
    in variables alone that several premises assume; shown: {such a text: the name of its lemma}.
    """

    def __init__(
        self, statement: checker.Statement, proof: Hint, known: Known, shown: dict[str, str]
    ) -> None:
        self.statement = statement
        self.proof = proof
        self.known = known
        self.shown = shown
        self.form = Form(statement)
        self.branch = Branch(SearchState(self.form.unfolding.context), known, [0])
        self.walk = checker.Context()  # the values of names, line by line
        self.stated: list[str] = []  # the statement up to the line
        self.rows: list[str] = []
        self.universal: list[str] = []
        self.integers: dict[str, str] = {}  # {integer variable: its name in Z}
        self.whole: list[str] = []  # proofs that these are integers
        self.assumed: list[str] = []  # names of the lines assumed, as they stand
        self.premises: list[str] = []  # and as polynomial formulas
        self.defined: set[str] = set()  # names that stand for terms
        self.lets: list[str] = []
        self.sums: list[str] = []  # equations of states around a point
        self.before: list[str] = []  # lemmas on roots and on lines `have`

    def text(self) -> str:
        """The lemmas."""
        name = self.statement.name
        for count, (keyword, said) in enumerate(self.statement.lines):
            if keyword == "forall":
                for is_integer, names in groupby(said, self.form.integers.__contains__):
                    self._forall([*names], is_integer)
            elif keyword in ("range", "given"):
                self._assume(said)
            elif keyword == "let":
                self._let(*said)
            elif keyword == "root":
                self._root(count, said[0], said[1][0])
            elif keyword == "have":
                self._have(count, said)
        if self.form.existential:
            self._exhibit()
        else:
            self._show()
        rows = ["Proof.", *self.rows, "Qed."]
        head = f"Lemma {reading_name(name)} :\n  " + "\n  ".join(self.stated) + "."
        return "\n".join([*self.before, head, *rows]) + "\n"

    def _forall(self, names: Sequence[str], are_integers: bool) -> None:
        own = [*map(coq_name, names)]
        if are_integers:
            for name, variable in zip(names, own):
                self.integers[name], is_whole = self.branch.fresh(), self.branch.fresh()
                self.stated.append(f"forall {variable} : Z, let {variable} := IZR {variable} in")
                self.rows += [
                    f"intros {self.integers[name]} {variable}.",
                    f"assert ({is_whole} : whole {variable})"
                    f" by exact (whole_constant {self.integers[name]}).",
                ]
                self.whole.append(is_whole)
        else:
            self.stated.append(f"forall {' '.join(own)} : R,")
            self.rows.append(f"intros {' '.join(own)}.")
        self.universal += own
        self._declare(names)

    def _declare(self, names: Sequence[str]) -> None:
        for name in names:
            self.walk.declare(name)

    def _let(self, name: str, term: ast.expr) -> None:
        own, value = coq_name(name), term_of(term, 0)
        self.walk.define(name, self.walk.value(term))
        self.defined.add(name)
        if ast.unparse(term) == f"{name}_point + {name}_gap":  # by an equation it can be any state
            equation = self.branch.fresh()
            self.stated.append(f"forall {own} : R, {own} = {value} ->")
            self.rows.append(f"intros {own} {equation}.")
            if self.lets:
                self.rows.append(f"unfold {', '.join(reversed(self.lets))} in {equation}.")
            self.assumed += [own, equation]
            self.sums.append(equation)
        else:
            self.stated.append(f"let {own} := {value} in")
            self.rows.append(f"intro {own}.")
            self.lets.append(own)

    def _assume(self, node: ast.expr) -> None:
        own, formula = self.branch.fresh(), self.walk.formula(node)
        self.stated.append(f"({formula_of(node, 0)}) ->")
        self.rows.append(f"intro {own}.")
        self.assumed.append(own)
        self._hold(f"(proj1 {self._same(node, formula)} {own})", formula)

    def _have(self, count: int, node: ast.expr) -> None:
        """A line that the certificate proves."""
        proof, formula = self._shown(count, node), self.walk.formula(node)
        self._hold(f"(proj1 {self._same(node, formula)} {proof})", formula)
        self.premises.pop()  # the polynomial lemma does not assume it

    def _hold(self, proof: str, formula: checker.Formula) -> None:
        """Takes a premise, as a polynomial formula, into the branch."""
        held, copy = self.branch.fresh(), self.branch.fresh()
        self.rows += [f"pose proof {proof} as {held}.", f"pose proof {held} as {copy}."]
        self.rows += self.branch.assume(formula, copy)
        self.premises.append(held)
        self.walk.license(formula)

    def _root(self, count: int, name: str, under: ast.expr) -> None:
        """A root: it is not negative, and its square is the term under it."""
        own = coq_name(name)
        below = self._shown(count, ast.Compare(under, [ast.GtE()], [ast.Constant(0)]))
        radicand, value = term_of(under, 0), self.walk.value(under)
        signed, squared = self.branch.fresh(), self.branch.fresh()
        self.stated.append(f"let {own} := sqrt ({radicand}) in")
        self.rows += [
            f"intro {own}.",
            f"assert ({signed} : 0 <= {own}) by apply sqrt_pos.",
            f"assert ({squared} : {own} * {own} = {radicand})"
            f" by exact (sqrt_sqrt _ (Rge_le _ _ {below})).",
        ]
        self._declare([name])
        self.universal.append(own)
        root, zero = self.walk.values[name], self.walk.number(0)
        self._hold(signed, self.walk.atom(root, ">=", zero))
        square = ast.BinOp(ast.Name(name), ast.Mult(), ast.Name(name))
        node = ast.Compare(square, [ast.Eq()], [under])
        formula = self.walk.atom(root * root, "=", value)
        self._hold(f"(proj1 {self._same(node, formula)} {squared})", formula)

    def _shown(self, count: int, node: ast.expr) -> str:
        """A proof of the formula that the certificate shows before a line; its lemma is first."""
        lines = self.statement.text().splitlines()[1 : count + 1]
        shown = ast.unparse(node).replace("**", "^").replace("==", "=")
        text = "\n".join([*lines, f"show {shown}"])
        if text not in self.shown:
            name = f"{self.statement.name}.line-{count}"
            part = checker.read_statements(f"statement {name}\n{text}")[name]
            before = sum(line.startswith(("root ", "have ")) for line in lines)
            proof = ["proof", self.proof[1][:before], self.proof[1][before]]
            self.before.append(certified(part, proof, self.known))
            self.before.append(StatementReading(part, proof, self.known, self.shown).text())
            self.shown[text] = reading_name(name)
        variables = [self.integers.get(name) or coq_name(name) for name in self._variables()]
        arguments = [*variables, *self.assumed]
        return f"({' '.join([self.shown[text], *arguments])})"

    def _variables(self) -> list[str]:
        """The variables that are not roots."""
        return [name for line in self.statement.get("forall") for name in line]

    def _show(self) -> None:
        """The conclusion, proved from the polynomial lemma."""
        (node,) = self.statement.get("show")
        self.stated.append(formula_of(node, 0))
        same = self._same(node, self.form.unfolding.goal(True))
        self.rows.append(f"exact (proj2 {same} ({self._applied()})).")

    def _applied(self) -> str:
        """The polynomial lemma, applied to what is assumed."""
        name = lemma_name(self.statement.name)
        return " ".join([name, *self.universal, *self.whole, *self.premises])

    def _exhibit(self) -> None:
        """The existence of values, proved from the polynomial lemma."""
        names, own = [*map(coq_name, self.form.existential)], self.branch.fresh()
        integers = self.form.whole(self.form.existential)
        whole = [self.branch.fresh() for _ in integers]
        applied = self._applied()
        self._declare(self.form.existential)
        nodes = [said for keyword, said in self.statement.lines if keyword in ("with", "show")]
        node = nodes[0] if len(nodes) == 1 else ast.BoolOp(ast.And(), nodes)
        formula, kept = self.form.unfolding.goal(True), self.branch.fresh()
        shown = " /\\ ".join([*integers, formula_of(node, 3 if integers else 0)])
        self.stated.append(f"exists {' '.join(names)} : R, {shown}")
        self.rows += [
            f"destruct ({applied}) as ({' & '.join([*names, *whole, own])}).",
            f"pose proof {own} as {kept}.",
            *self.branch.assume(formula, kept),
        ]
        self.walk.license(formula)
        same = self._same(node, formula)
        proof = conjoined([*whole, f"(proj2 {same} {own})"])
        self.rows += [*(f"exists {name}." for name in names), f"exact {proof}."]

    # -------------------------------------------------------------------------------------------
    # A formula as it stands, and the polynomial formula that is equivalent to it.

    def _same(self, node: ast.expr, formula: checker.Formula) -> str:
        """A proof that a formula as it stands is equivalent to its polynomial formula."""
        texts = _Texts(self.branch, {}, {})
        is_shared = not (names_of(node) & self.defined or _divides(node))
        if not is_shared:
            texts.lets, texts.sums = self.lets, self.sums
        read = self._read(node, texts)
        target = proposition(self.branch.names, formula)
        proof = f"(reads_holds _ _ _ {read.proof})"
        if read.holds != target:
            same = self.branch.fresh()
            texts.rows.append(f"assert ({same} : {read.holds} <-> {target}) by equivalent.")
            proof = f"(iff_trans {proof} {same})"
        if not is_shared:
            self.rows += texts.rows
            return proof
        names = [coq_name(name) for name in self.branch.names if name in names_of(node)]
        forall = [f"forall {' '.join(names)} : R,"] * bool(names)
        text = " ".join([*forall, f"({formula_of(node, 0)}) <-> ({target})"])
        if text not in self.shown:
            self.shown[text] = reading_name(f"{self.statement.name}.formula-{len(self.shown) + 1}")
            head = [f"Lemma {self.shown[text]} :", f"  {text}.", "Proof."]
            rows = [" ".join(["intros", *names]) + ".", *texts.rows, f"exact {proof}.", "Qed."]
            self.before.append("\n".join([*head, *rows]))
        return f"({' '.join([self.shown[text], *names])})"

    def _read(self, node: ast.expr, texts: _Texts) -> _Read:
        if isinstance(node, ast.UnaryOp):
            part = self._read(node.operand, texts)
            return _Read(part.fails, part.holds, f"(reads_not _ _ _ {part.proof})")
        if isinstance(node, ast.BoolOp):
            joined = isinstance(node.op, ast.And)
            parts = [self._read(part, texts) for part in node.values]
            return _chain(parts, "reads_and" if joined else "reads_or")
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            atoms = [
                self._atom(left, type(op), right, texts)
                for left, op, right in zip(sides, node.ops, sides[1:])
            ]
            return _chain(atoms, "reads_and")
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            left, right = (self._read(part, texts) for part in node.args)
            return _joined(left, right, f"reads_{node.func.id}")
        raise NotWritten(f"no Coq proposition for {ast.unparse(node)}")

    def _atom(self, left: ast.expr, op: type[ast.cmpop], right: ast.expr, texts: _Texts) -> _Read:
        if op in (ast.Lt, ast.Gt):
            low, high = (left, right) if op is ast.Lt else (right, left)
            pair, order, lemma, relation = (high, low), (low, high), "reads_lt", ">"
        elif op in (ast.LtE, ast.GtE):
            pair = (right, left) if op is ast.LtE else (left, right)
            order, lemma, relation = (left, right), f"reads_{'le' if op is ast.LtE else 'ge'}", ">="
        else:
            pair, order = (left, right), (left, right)
            lemma, relation = ("reads_eq", "=") if op is ast.Eq else ("reads_ne", "!=")
        more, less = (self.walk.value(side) for side in pair)
        value = more - less
        target = _numerator(value, relation)
        text = f"({term_of(pair[0], 1)} - {term_of(pair[1], 2)})"
        holds, same = texts.atom(text, value, relation, target)
        arguments = [term_of(side, ATOM) for side in order]
        names = self.branch.names
        arguments.append(f"({polynomial(names, target)})")
        fails = proposition(names, checker.negate(("atom", target, relation)))
        arguments.append(same)
        if ">" in relation:
            arguments.insert(-1, f"({polynomial(names, -target)})")
            arguments.append("ltac:(ring)")
        return _Read(holds, fails, f"({' '.join([lemma, *arguments])})")


def _numerator(value: checker.Poly, relation: str) -> checker.Poly:
    """The polynomial that has the sign of a quotient, or vanishes with it, as in the checker."""
    signless = [
        licence
        for (licence, positive), exponent in value.under.items()
        if exponent % 2 and not positive and ">" in relation
    ]
    return prod(signless, start=value.over({}))


def _divides(node: ast.AST) -> bool:
    """Whether a term with a name is divided by; a branch has to know that it is not 0."""
    return any(
        isinstance(one, ast.BinOp) and isinstance(one.op, ast.Div) and names_of(one.right)
        for one in ast.walk(node)
    )


def _chain(parts: Sequence[_Read], lemma: str) -> _Read:
    """A conjunction or disjunction of several."""
    last = parts[-1]
    for count, part in enumerate(reversed(parts[:-1])):
        last = _joined(part, last, lemma, count > 0)
    return last


def _joined(one: _Read, two: _Read, lemma: str, is_tail: bool = False) -> _Read:
    """Two formulas joined as the lemma of Readings.v says; the tail of a chain needs no
    parentheses.
    """

    def both(left: str, op: str, right: str) -> str:
        return f"{_enclosed(left)} {op} {right if is_tail else _enclosed(right)}"

    holds, fails = {
        "reads_and": (both(one.holds, AND, two.holds), both(one.fails, OR, two.fails)),
        "reads_or": (both(one.holds, OR, two.holds), both(one.fails, AND, two.fails)),
        "reads_implies": (both(one.fails, OR, two.holds), both(one.holds, AND, two.fails)),
        "reads_iff": (
            f"({both(one.fails, OR, two.holds)}) {AND} ({both(one.holds, OR, two.fails)})",
            f"({both(one.holds, AND, two.fails)}) {OR} ({both(one.fails, AND, two.holds)})",
        ),
    }[lemma]
    return _Read(holds, fails, f"({lemma} _ _ _ _ _ _ {one.proof} {two.proof})")


def _enclosed(text: str) -> str:
    return f"({text})" if "\\" in text else text
