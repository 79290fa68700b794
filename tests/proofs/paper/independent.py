"""An evaluator of statements that shares nothing with the checker."""

from __future__ import annotations

import ast
import random
import re
from collections.abc import Iterator
from importlib import import_module
from math import isqrt
from typing import Any

from flint import fmpq

# -------------------------------------------------------------------------------------------------
# An evaluator of statement texts that shares nothing with the checker: exact rationals, Python's
# own expressions, random points.

Point = dict[str, fmpq]
NAMES = {
    "Q": fmpq,
    "implies": lambda a, b: (not a) or b,
    "iff": lambda a, b: bool(a) == bool(b),
    "__builtins__": {},
}
MOST_QUESTIONS = 40  # put to Z3 about one statement with `exists`


def python_of(text: str) -> str:
    """A term or formula as a Python expression over fmpq."""
    text = re.sub(
        r" ?\^ ?(\d+)",
        lambda match: "**" + "I" * int(match[1]) if int(match[1]) < 40 else "**0",
        text,
    )
    text = re.sub(r"(?<![<>!=])=(?!=)", "==", text)
    text = re.sub(r"\b\d+\b", lambda match: f"Q({match[0]})", text)
    return re.sub(r"\*\*(I+)", lambda match: f"**{len(match[1])}", text)


def compiled(text: str) -> Any:
    return compile(python_of(text), "statement", "eval")


class ForZ3(ast.NodeTransformer):
    """Python's and, or, not and chains of relations as Z3's functions."""

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.AST:
        return call(
            "And" if isinstance(node.op, ast.And) else "Or",
            [self.visit(value) for value in node.values],
        )

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
        self.generic_visit(node)
        return call("Not", [node.operand]) if isinstance(node.op, ast.Not) else node

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        sides = [self.visit(side) for side in (node.left, *node.comparators)]
        return call(
            "And",
            [
                ast.Compare(left, [op], [right])
                for left, op, right in zip(sides, node.ops, sides[1:])
            ],
        )


def call(name: str, arguments: list[ast.expr]) -> ast.AST:
    return ast.Call(ast.Name(name, ast.Load()), arguments, [])


def for_z3(text: str) -> Any:
    tree = ForZ3().visit(ast.parse(text, mode="eval"))
    return compile(ast.fix_missing_locations(tree), "statement", "eval")


def named_values(found: Any, names: Point) -> Point | None:
    """The values that a witness of the checker's form names at a point; None where it adjoins a
    number or names none.
    """
    if found[0] == "sign":
        value = eval(compiled(found[1]), {**NAMES, **names})
        return named_values(found[2 + (value >= 0) + (value > 0)], names)
    if found[0] == "empty" or found[1]:
        return None
    return {name: eval(compiled(term), {**NAMES, **names}) for name, term in found[2].items()}


class Independent:
    """One universal statement, ready to be put to points.

    What `exists` asks for is first sought among the values that a witness names, if one is given,
    and then by Z3 at the point.
    """

    def __init__(self, text: str, witness: Any = None) -> None:
        self.lines = [line.split(" ", 1) for line in text.splitlines()[1:]]
        self.variables = [
            name for keyword, said in self.lines if keyword == "forall" for name in said.split()
        ]
        self.integers = {
            name for keyword, said in self.lines if keyword == "integer" for name in said.split()
        }
        self.existing = [
            name for keyword, said in self.lines if keyword == "exists" for name in said.split()
        ]
        self.witness, self.questions = witness, MOST_QUESTIONS
        self.code: list[tuple[str, str, Any]] = []
        self.moves: dict[int, tuple[str, str, Any]] = {}
        used: set[str] = set()
        for keyword, said in self.lines:
            if keyword == "exists":
                self.code.append((keyword, "", None))
            elif keyword in ("let", "root"):
                name, value = said.split(" = ", 1)
                value = re.sub(r"^sqrt\((.*)\)$", r"\1", value) if keyword == "root" else value
                self.code.append((keyword, name, compiled(value)))
            elif keyword in ("range", "given", "have", "with", "show"):
                move = self.move(said, used) if keyword == "given" else None
                if move:
                    self.moves[len(self.code)] = move
                self.code.append((keyword, "", compiled(said)))
            used |= (
                set(re.findall(r"[A-Za-z]\w*", said))
                if keyword not in ("forall", "integer", "exists")
                else set()
            )

    def move(self, said: str, used: set[str]) -> tuple[str, str, Any] | None:
        """How a sampled variable that has not been used yet moves to where a premise holds: x =
        term, term <= n or n <= term for an integer n.
        """
        if re.search(r"\b(and|or)\b", said):
            return None
        solved = re.fullmatch(r"([A-Za-z]\w*) = ([^<>=]*)", said)
        low, high = (
            re.fullmatch(r"([^<>=]*) <=? (\w+)", said),
            re.fullmatch(r"(\w+) <=? ([^<>=]*)", said),
        )
        if (
            solved
            and solved[1] in self.variables
            and solved[1] not in used | self.integers
            and not re.search(rf"\b{solved[1]}\b", solved[2])
        ):
            return "solve", solved[1], compiled(solved[2])
        for match, name, term, way in ((low, 2, 1, "from"), (high, 1, 2, "to")):
            if match and match[name] in self.integers - used and not match[term].isdigit():
                return way, match[name], compiled(match[term])
        return None

    def at(self, point: Point, moving: bool = True) -> bool | None:
        """Whether the statement holds at the point; None where its premises fail or cannot be
        evaluated there.
        """
        names: dict[str, Any] = {**NAMES, **point}
        try:
            for place, (keyword, name, code) in enumerate(self.code):
                if keyword == "exists":
                    return self.some(names, place + 1)
                if moving and place in self.moves:
                    way, moved, term = self.moves[place]
                    value, third = eval(term, names), int(names[moved].p) % 3
                    names[moved] = (
                        value
                        if way == "solve"
                        else value.ceil() + third
                        if way == "from"
                        else value.floor() - third
                    )
                value = eval(code, names)
                if keyword in ("range", "given", "have"):
                    if not value:
                        return None
                elif keyword == "root":
                    root = square_root(value)
                    if root is None:
                        return None
                    names[name] = root
                elif keyword == "show":
                    return bool(value)
                else:
                    names[name] = value
        except ZeroDivisionError:
            return None
        return None

    def some(self, names: dict[str, Any], place: int) -> bool | None:
        """Whether some values of the `exists` variables meet what follows: those of the witness, or
        else any, by Z3; None where unknown.
        """
        try:
            values = named_values(self.witness, names) if self.witness else None
            if values is not None:
                there = {**names, **values}
                for keyword, name, code in self.code[place:]:
                    there[name] = eval(code, there)
                    if keyword != "let" and not there[name]:
                        break
                else:
                    return True
        except ZeroDivisionError:
            pass
        self.questions -= 1
        return self.by_z3(names, place) if self.questions >= 0 else None

    def by_z3(self, names: dict[str, Any], place: int) -> bool | None:
        z3 = import_module("z3")
        context = z3.Context()
        there: dict[str, Any] = {
            name: z3.RealVal(f"{value.p}/{value.q}", context)
            for name, value in names.items()
            if isinstance(value, fmpq)
        }
        there |= {
            name: (
                z3.ToReal(z3.Int(name, context))
                if name in self.integers
                else z3.Real(name, context)
            )
            for name in self.existing
        }
        there |= {
            "Q": lambda value: z3.RealVal(value, context),
            "And": z3.And,
            "Or": z3.Or,
            "Not": z3.Not,
            "implies": z3.Implies,
            "iff": lambda a, b: a == b,
        }
        solver = (
            z3.Solver(ctx=context)
            if self.integers & set(self.existing)
            else z3.Tactic("qfnra-nlsat", ctx=context).solver()
        )
        solver.set("rlimit", 200_000)
        for (keyword, name, _), (_, said) in zip(
            self.code[place:], self.lines[-len(self.code[place:]) :]
        ):
            said = said.split(" = ", 1)[1] if keyword == "let" else said
            value = eval(for_z3(python_of(said)), there)
            if keyword == "let":
                there[name] = value
            else:
                solver.add(value)
        return {"sat": True, "unsat": False}.get(str(solver.check()))

    def points(self, count: int, seed: int) -> Iterator[Point]:
        """Random rational points, small and simple ones first; parameters between 0 and 1 more
        often than not.
        """
        chance = random.Random(seed)
        has_root = any(keyword == "root" for keyword, _ in self.lines)
        for number in range(count):
            width = 3 + number * 20 // count
            point: Point = {}
            for name in self.variables:
                if name == "alpha":
                    p, q = chance.randint(1, 12 + width), chance.randint(1, 12 + width)
                    a, b = min(p, q), max(p, q) + (p == q)
                    point[name] = (
                        fmpq(2 * a * a, b * b) - 1 if has_root and 2 * a * a > b * b else fmpq(a, b)
                    )
                elif name in self.integers:
                    point[name] = fmpq(chance.randint(-2, 2 + width))
                else:
                    point[name] = fmpq(
                        chance.randint(-3 * width, 4 * width), chance.randint(1, width)
                    )
            yield point

    def counterexample(self, count: int = 10_000, seed: int = 1) -> Point | None:
        """A point at which the premises hold and the statement fails, if the sample has one."""
        return next((point for point in self.points(count, seed) if self.at(point) is False), None)


def square_root(value: fmpq) -> fmpq | None:
    """The exact square root of a rational, if it is one."""
    p, q = int(value.p), int(value.q)
    if p < 0 or isqrt(p) ** 2 != p or isqrt(q) ** 2 != q:
        return None
    return fmpq(isqrt(p), isqrt(q))


STEPS = 4


def lines(text: str) -> dict[str, list[str]]:
    """What follows each keyword of a statement."""
    said: dict[str, list[str]] = {}
    for line in text.splitlines():
        keyword, _, rest = line.partition(" ")
        said.setdefault(keyword, []).append(rest)
    return said


def iterates_contradiction(text: str) -> Point | None:
    """A point whose first few images under the map differ from what the closed form says."""
    said = lines(text)
    state, images = said["iterates"][0].split(" -> ")
    count, powers = said["after"][0].split(" -> ")
    states = state.strip("()").replace(",", " ").split()
    variables = said["forall"][0].split()
    chance = random.Random(1)

    def values(terms: str, names: dict[str, Any]) -> list[Any]:
        there = {**NAMES, **names}
        for row in said.get("let", []):
            name, term = row.split(" = ", 1)
            there[name] = eval(compiled(term), there)
        found = eval(compiled(terms), there)
        return list(found) if isinstance(found, tuple) else [found]

    for _ in range(50):
        point = {
            name: fmpq(chance.randint(-9, 9), chance.randint(1, 5))
            for name in variables
            if name != count
        }
        now = [point[name] for name in states]
        try:
            for steps in range(STEPS):
                if values(powers, {**point, count: fmpq(steps)}) != now:
                    return {**point, count: fmpq(steps)}
                now = values(images, {**point, **dict(zip(states, now))})
        except ZeroDivisionError:
            continue
    return None
