"""What README.md and the page on the theorem show for a check by hand is what the checker
certified, and what they show beside it is identically true.
"""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Iterator
from functools import cache
from typing import Any

from juggleproof.certificates import checker
from juggleproof.reading.evaluation import Environment
from juggleproof.reading.meaning import Printed
from juggleproof.reports.latex import latex_of
from juggleproof.reports.markup import conjuncts
from juggleproof.statements.language import reals
from juggleproof.statements.states import SearchState, state_of
from juggleproof.statements.store import DEFAULT
from tests.certificates.checker.harness import CLOSE, proof, verdict
from tests.command import running
from tests.docs.pages import ROOT, code, text_of
from tests.rows import each_row

SIGNS = r" (\\le|\\ge|\\ne|<|>|=) "
DEFINED = ("u", r"\varrho")  # what the proof defines


def certified(claim: str) -> dict[str, tuple[str, str]]:
    """The text of each statement of a claim and its certificate, as `explain` shows them."""
    shown = running.run("explain", claim).stdout
    found = re.findall(
        rf"^    statement {claim}/(\S+)\n((?:    .*\n)*?)    -> certified by (.*)$", shown, re.M
    )
    return {
        name: (f"statement {claim}/{name}\n{textwrap.dedent(text)}", certificate)
        for name, text, certificate in found
    }


def is_identity(left: str, right: str) -> bool:
    """The checker takes both sides for the same polynomial, in the letters of either."""
    letters = " ".join(sorted(set(re.findall(r"[a-z]+", f"{left} {right}"))))
    text = f"statement rule/case\nforall {letters}\nshow {left} = {right}\n"
    at = dict.fromkeys(letters.split(), "0")
    return verdict(text, {"rule/case": proof(CLOSE, at=at)})["rule/case"][0] == "certified"


# -------------------------------------------------------------------------------------------------
# The page on the theorem: every display is a certified line, a definition or an identity.


def relations(display: str) -> set[str]:
    """The relations of a display, in which a chain has one between each two sides."""
    found = set()
    for part in display.rstrip(".,").split(r", \qquad "):
        sides = re.split(SIGNS, part)
        for left, sign, right in zip(sides[::2], sides[1::2], sides[2::2]):
            found.add(f"{left} {sign} {right}")
    return found


def steps() -> Iterator[tuple[list[str], set[str]]]:
    """The names of statements that stand in code between two displays of the proof, and the
    relations of the displays that follow them before the next name.
    """
    text = text_of(ROOT / "docs/theorem.md")
    text = text.split("\n## The proof\n")[1].split("\n## ")[0]
    text = text.partition("\nFor a state ")[2]  # before it the page explains what a name is
    words, *rest = re.split(r"^```math\n(.*?)\n```$", text, flags=re.M | re.S)
    names, found = list[str](), set[str]()
    for display, after in zip(rest[::2], rest[1::2]):
        before = re.findall(r"\(((?:`[\w-]+`(?:,\s)?)+)\)", words)
        if before:
            yield names, found
            names, found = re.findall(r"`([\w-]+)`", before[0]), set()
        found |= relations(display)
        words = after
    yield names, found


STEPS = list(steps())


@cache
def lines() -> dict[str, set[str]]:
    """The relations of every statement of the written proof as LaTeX."""
    return {
        name: {latex_of(part) for part in conjuncts(re.findall(r"^show (.*)$", text, re.M)[0])}
        for name, (text, _) in certified("theorem-by-hand").items()
    }


def test_every_line_of_the_proof_is_named_once_holds() -> None:
    named = [name for names, _ in STEPS for name in names]
    assert len(named) == 25 and sorted(named) == sorted(lines())


@each_row(("names", "shown"), STEPS)
def test_a_display_of_the_proof_is_certified_or_an_identity_holds(
    names: list[str], shown: set[str]
) -> None:
    expected = set[str]().union(*(lines()[name] for name in names))
    assert expected <= shown
    alpha, w, u = reals("alpha w u")
    letters = Environment({r"\alpha": alpha, "w": w, "u": u})
    for more in shown - expected:
        left, sign, right = re.split(SIGNS, more)
        if left in DEFINED:
            assert not names and right == definitions()[left]
        else:
            formula = str(Printed(more).formula(letters))
            assert sign == "=" and is_identity(*formula.split(" = "))


def rows(part: str, keyword: str) -> list[str]:
    """What the lines of a statement of the theorem say that begin with the keyword."""
    stored = (DEFAULT / "statements.txt").read_text(encoding="utf-8")
    statement = stored.split(f"\nstatement theorem/{part}\n")[1].split("\n\n")[0]
    return re.findall(rf"^{keyword} (.*)$", statement, re.M)


def definitions() -> dict[str, str]:
    """What the letters of the page stand for in the statement that the checker joins."""
    root = rows("descends", "root")[0].removeprefix("u = sqrt(").removesuffix(")")
    (rank,) = rows("descends", "rank")
    return dict(zip(DEFINED, (rf"\sqrt{{{latex_of(root)}}}", latex_of(rank))))


def test_the_model_has_the_map_and_the_point_of_the_checker_holds() -> None:
    shown = "".join(code(ROOT / "docs/theorem.md", "math"))
    pieces = [row.split(" -> ") for row in rows("map", "piece")]
    assert len(pieces) == 2
    for guard, image in pieces:
        entries = r",\; ".join(map(latex_of, image.split(", ")))
        assert rf"({entries}) & \text{{if }} {latex_of(guard)}" in shown
    point = r",\; ".join(map(latex_of, rows("contracts", "point")[0].split(", ")))
    assert rf"e_1 = \left({point}\right)" in shown


# -------------------------------------------------------------------------------------------------
# README.md: the identities of its certificate.


def summands(line: str) -> list[tuple[str, str]]:
    """The coefficients and the brackets of a line that ends in `= 0`."""
    total = re.fullmatch(r"[^:]*: +(.*) = 0", line)
    assert total, line
    found = re.findall(r"(?:^| \+ )(?:(\d+)\*)?\(([^()]+)\)", total[1])
    assert total[1] == " + ".join(f"{c}*({one})" if c else f"({one})" for c, one in found)
    return [(c or "1", one) for c, one in found]


def leaves(state: SearchState, node: Any) -> Iterator[tuple[SearchState, Any]]:
    """The cases that a certificate tells apart, each with what closes it."""
    if node[0] == "cases":
        _, choice, nodes = node
        rest = state.branch()
        for alternative, one in zip(rest.choices.pop(choice), nodes, strict=True):
            yield from leaves(rest.branch(alternative), one)
    else:
        yield state, node


def test_the_identities_of_readme_are_its_certificate_holds() -> None:
    text, certificate = certified("s3.2-bounds")["corrected.main"]
    assert text.splitlines()[-1] in text_of(ROOT / "README.md")
    (statement,) = checker.read_statements(text).values()
    unfolding = checker.Unfolding(statement, checker.Context())
    state = state_of(unfolding).assume(unfolding.goal(False))
    _, _, root = json.loads(certificate)
    assert state.is_closed_by(root, {})
    shown = [summands(line) for line in code(ROOT / "README.md", "text")[-1].splitlines()]
    assert len(shown) == 3
    for line, (case, node) in zip(shown, leaves(state, root), strict=True):
        rule, products, equations = node
        assert rule == "psatz" and equations == []
        facts = []
        for (ours, bracket), (coefficient, ((fact, power),), square) in zip(line, products):
            poly, relation = case.facts[fact]
            assert (ours, power, square) == (coefficient, 1, "1")
            assert is_identity(bracket, case.context.show(poly))
            facts.append(relation)
        assert sorted(facts) == [">", ">="] and len(line) == len(products)
        assert is_identity(" + ".join(f"{c}*({one})" for c, one in line), "0")
