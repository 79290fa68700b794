"""What an accepted certificate claims, put to points by the independent evaluator: `contradiction`
names a point where it is wrong.
"""

from __future__ import annotations

import ast
import random
from collections.abc import Mapping
from itertools import islice
from typing import Any

from flint import fmpq

from juggleproof.certificates import checker
from tests.proofs.paper.independent import NAMES, Independent, Point, compiled, named_values

POINTS, PARAMETERS, INSIDE, STEPS = 1_000, 20, 20, 4


def contradiction(
    text: str, outcome: str, certificate: Any, texts: Mapping[str, str], known: Mapping[str, Any]
) -> object:
    """A point where the outcome that a certificate was accepted for is wrong; None where none of
    the sample is one.

    Irrational values are not evaluated: a certificate that adjoins a number says nothing here about
    its point.
    """
    if outcome == "refuted":
        point = named_values(certificate["refuted"], {})
        statement = Independent(text)
        holds = None if point is None else statement.at(point, moving=False)
        return (
            point
            if holds or point is not None and holds is None and not statement.existing
            else None
        )
    if "\nsharp " in text:
        return sharp_contradiction(text, certificate["certified"], texts)
    if "\niterates " in text:
        return iterates_contradiction(text)
    if isinstance(certificate["certified"], dict):
        return premise_contradiction(text, known)
    way, _, last = certificate["certified"]
    statement = Independent(text, last if way == "witness" else None)
    point = named_values(certificate["point"], {})
    if point is not None and statement.at(point, moving=False) is False:
        return point
    return statement.counterexample(POINTS)


def premise_contradiction(text: str, known: Mapping[str, Any]) -> object:
    """A point at which a premise of a map rule is false, of those that are for all."""
    (statement,) = checker.read_statements(text).values()
    for premise in checker.premises_of(statement, known).values():
        if (
            not premise.get("exists")
            and (point := Independent(premise.text()).counterexample(POINTS // 5)) is not None
        ):
            return premise.name, point
    return None


def lines(text: str) -> dict[str, list[str]]:
    """What follows each keyword of a statement."""
    said: dict[str, list[str]] = {}
    for line in text.splitlines():
        keyword, _, rest = line.partition(" ")
        said.setdefault(keyword, []).append(rest)
    return said


def sharp_contradiction(text: str, certificate: Any, texts: Mapping[str, str]) -> object:
    """Parameters in the domain at which the condition and the statements disagree."""
    said = lines(text)
    names = said["over"][0].split()
    numbers = {}
    for row in said.get("number", []):
        name, root = row.split(" = ", 1)
        numbers[name] = root_between(root)
    inner = {
        name: "\n".join(row for row in texts[name].splitlines() if not row.startswith("range "))
        for name in said["sharp"][0].split()
    }
    statements = {name: Independent(one) for name, one in inner.items()}
    chance = random.Random(1)
    for parameters in islice(
        iter(lambda: {name: sampled(name, chance) for name in names}, None), PARAMETERS
    ):
        values: Any = {**NAMES, **numbers, **parameters}
        if not eval(compiled(said["domain"][0]), values):
            continue
        if eval(compiled(said["holds"][0]), values):
            for one in statements.values():
                for point in one.points(INSIDE, 1):
                    if one.at({**point, **parameters}) is False:
                        return {**point, **parameters}
            continue
        found = certificate[1]
        while found[0] == "sign":
            value = eval(compiled(found[1]), values)
            found = found[2 + (value >= 0) + (value > 0)]
        if found[0] == "empty":
            return parameters
        point = named_values(found, values)
        if (
            point is not None
            and statements[found[0]].at({**parameters, **point}, moving=False) is True
        ):
            return {**parameters, **point}
    return None


def sampled(name: str, chance: random.Random) -> fmpq:
    return fmpq(chance.randint(1, 8)) if name == "K" else fmpq(chance.randint(1, 60), 61)


def root_between(text: str) -> fmpq:
    """The root of a polynomial in one variable between two rationals, to within 2^-80: apart from
    every parameter of the sample.
    """
    call = ast.parse(text.replace("^", "**"), mode="eval").body
    if not isinstance(call, ast.Call):
        raise ValueError(f"not a root: {text!r}")
    polynomial, low, high = (ast.unparse(argument).replace(" ** ", "^") for argument in call.args)
    (name,) = {node.id for node in ast.walk(call.args[0]) if isinstance(node, ast.Name)}
    ends = [eval(compiled(end), dict(NAMES)) for end in (low, high)]
    code = compiled(polynomial)
    sign = eval(code, {**NAMES, name: ends[0]}) > 0
    for _ in range(80):
        middle = (ends[0] + ends[1]) / 2
        ends[(eval(code, {**NAMES, name: middle}) > 0) != sign] = middle
    return ends[0]


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
