"""An evaluator of statement texts that shares nothing with the checker: exact rationals, Python's own expressions, random points."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from math import isqrt
from typing import Any

from flint import fmpq

Point = dict[str, fmpq]
NAMES = {"Q": fmpq, "implies": lambda a, b: (not a) or b, "iff": lambda a, b: bool(a) == bool(b), "__builtins__": {}}


def python_of(text: str) -> str:
    """A term or formula as a Python expression over fmpq."""
    text = re.sub(r"\^(\d+)", lambda match: "**" + "I" * int(match[1]) if int(match[1]) < 40 else "**0", text)
    text = re.sub(r"(?<![<>!=])=(?!=)", "==", text)
    text = re.sub(r"\b\d+\b", lambda match: f"Q({match[0]})", text)
    return re.sub(r"\*\*(I+)", lambda match: f"**{len(match[1])}", text)


class Independent:
    """One universal statement, ready to be put to points."""

    def __init__(self, text: str) -> None:
        self.lines = [line.split(" ", 1) for line in text.splitlines()[1:]]
        self.variables = [name for keyword, said in self.lines if keyword == "forall" for name in said.split()]
        self.integers = {name for keyword, said in self.lines if keyword == "integer" for name in said.split()}
        self.existential = any(keyword == "exists" for keyword, _ in self.lines)
        self.code: list[tuple[str, str, Any]] = []
        for keyword, said in self.lines:
            if keyword in ("range", "given", "have", "show"):
                self.code.append((keyword, "", compile(python_of(said), "statement", "eval")))
                solved = re.fullmatch(r"([A-Za-z]\w*) = (.*)", said)
                if keyword == "given" and solved and solved[1] in self.variables and not re.search(rf"\b{solved[1]}\b|[<>=]|and|or", solved[2]):
                    self.code[-1] = ("solve", solved[1], compile(python_of(solved[2]), "statement", "eval"))
            elif keyword in ("let", "root"):
                name, value = said.split(" = ", 1)
                value = re.sub(r"^sqrt\((.*)\)$", r"\1", value) if keyword == "root" else value
                self.code.append((keyword, name, compile(python_of(value), "statement", "eval")))

    def at(self, point: Point) -> bool | None:
        """Whether the statement holds at the point; None where its premises fail or cannot be evaluated there."""
        names: dict[str, Any] = {**NAMES, **point}
        try:
            for keyword, name, code in self.code:
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

    def points(self, count: int, seed: int) -> Iterator[Point]:
        """Random rational points, small and simple ones first; parameters between 0 and 1 more often than not."""
        chance = random.Random(seed)
        has_root = any(keyword == "root" for keyword, _ in self.lines)
        for number in range(count):
            width = 3 + number * 20 // count
            point: Point = {}
            for name in self.variables:
                if name == "alpha":
                    p, q = chance.randint(1, 12 + width), chance.randint(1, 12 + width)
                    a, b = min(p, q), max(p, q) + (p == q)
                    point[name] = fmpq(2 * a * a, b * b) - 1 if has_root and 2 * a * a > b * b else fmpq(a, b)
                elif name in self.integers:
                    point[name] = fmpq(chance.randint(-2, 2 + width))
                else:
                    point[name] = fmpq(chance.randint(-3 * width, 4 * width), chance.randint(1, width))
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
