"""Where the sentence of a claim names a set or a condition, the claim's statements have it under a
definition of that name, so that words and formula share it.

`sentences.tsv` lists the sentences for which this is not so, each with the reason.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.judging.claims import Argument, Claim, Following
from juggleproof.papers.paper import opened
from juggleproof.proofs.paper.names import definitions, sets
from juggleproof.statements.definitions import formula_of, short_line, shortened
from juggleproof.statements.store import DEFAULT, Store, WrittenOut
from tests.rows import each_row

EXCEPTIONS = Path(__file__).with_name("sentences.tsv")
SETS_OF_RULES = ("space", "stage", "on")  # the lines of an orbit rule that are sets of states

# What a sentence names, and what stands for it in a statement: definitions by name, or a pattern.
# A longer name stands before those that are a part of it.
NAMES: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("boundary of R", "boundary (states )?of R", ("on_boundary_of_R", r"region_margin\(.*\) = 0")),
    ("level line of R", "level line of R", ("at_corner_of_R", r"region_margin\(.*\) = 0")),
    ("level of R", "level of R", ("level_of_R", r"value_of_E_max \+ value_of_dE_max")),
    ("corner of R", "([Aa]t|[Ff]rom) the corner( of R)?", ("at_corner_of_R",)),
    (
        "outside R",
        "[Oo]utside R",
        ("outside_R", "in_B1_outside_R", "not in_R", r"> 2\*level_of_R\(1\)"),
    ),
    (
        "R(b)",
        r"R\(b\)",
        ("region_margin", "at_corner_of_R", "margin =", r"\(level_of_R\(r\) - v0?\^2/2\)/g"),
    ),
    ("narrow", "narrow|does not reach up to where R leaves B1", ("narrow",)),
    ("R leaves B1", "where R leaves B1", ("R_leaves_B1_at",)),
    ("boundary of the band", "boundary of the band", ("on_boundary_of_band",)),
    ("band", "band|region K", ("in_band", r"K_from_e_1\(.*\) <= eps")),
    (
        "B1 with its boundary",
        "B1 or on the line between B1 and B2|B1 or its boundary",
        ("in_closed_B1",),
    ),
    (
        "line between B1 and B2",
        "line between B1 and B2",
        ("on_line", "height_on_line", "R_leaves_B1_at", r"tau_c\(.*\) = T"),
    ),
    ("B1^0", r"B1\^0", ("in_B1_0",)),
    (
        "B1",
        "B1",
        ("in_B1", "in_B1_plus", "in_B1_minus", "in_B1_0", "in_B1_outside_R")
        + ("in_band", "at_corner_of_R", r"collision_margin\(.*\) > 0")
        + (r"1/2\*g\*beta \+ r\*v < r\^2",),  # as (7) prints it
    ),
    ("B2", "B2", ("in_B2", r"not collision_margin\(.*\) > 0")),
    (
        "R",
        "R",
        ("in_R", "in_band", "on_boundary_of_R", r"in_B[12]\(.*\) and region_margin\(.*\) >= 0"),
    ),
    (
        "H",
        "H",
        ("in_R", "in_B1", "in_B2", "outside_R", "in_closed_B1", "in_B1_outside_R", "0 <= x")
        + (r"(beta|beta0|x|height|edge) >=? 0",),
    ),
    ("Delta E_max", "Delta E_max", ("dE_max", "value_of_dE_max")),
    ("Delta E_sup", "Delta E_sup", ("dE_sup", "value_of_dE_sup", "at_corner_of_R")),
    ("E_max", "E_max", ("E_max", "value_of_E_max")),
    ("time to collision", "time to collision|tau_c", ("tau_c", "meet")),
    (
        "meet",
        "meets? the table|[Bb]all and table meet|strikes? the table",
        ("meet", "on_line"),
    ),
    ("trap", "trap", ("in_trap",)),
)
NARROWING = ("narrow", "outside R", "boundary of the band")  # a claim about these has to say so


def named(sentence: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """The names in a sentence, each with what stands for it."""
    for name, words, stands in NAMES:
        rest = re.sub(rf"(?<![\w^])(?:{words})(?![\w^])", " ", sentence)
        if rest != sentence:
            yield name, stands
        sentence = rest


def missing(sentence: str, text: str) -> list[str]:
    """The names in a sentence that the statements in this text do not have."""
    return [
        name
        for name, stands in named(sentence)
        if not any(re.search(rf"(?<!\w)(?:{one})(?![\w'])", text) for one in stands)
    ]


def unsaid(sentence: str, text: str) -> list[str]:
    """The definitions in the statements of this text that narrow a claim, though its sentence does
    not say so.
    """
    said, defined = dict(named(sentence)), {row[0] for row in sets()}
    return [
        one
        for name, _, stands in NAMES
        if name in NARROWING and name not in said
        for one in stands
        if one in defined and re.search(rf"\b{one}\b", text)
    ]


@cache
def with_definitions(line: str) -> str:
    """A line of a statement with definitions by name, also that of a set in an orbit rule."""
    keyword, _, text = line.partition(" ")
    if keyword in SETS_OF_RULES:
        return f"{keyword} {shortened(formula_of(checker.parse(text)), definitions())}"
    return short_line(line, definitions())


@cache
def stored() -> WrittenOut:
    texts = Store(DEFAULT).texts
    assert isinstance(texts, WrittenOut)
    return texts


def statements(claim: Claim, rules: bool = True) -> str:
    """The stored statements of a claim, and of the rules that it rests on, without their names."""
    body = claim.body()
    others = body.rests_on if rules and isinstance(body, (Argument, Following)) else ()
    owners = {claim.id, *(rule.split("/")[0] for rule in others)}
    lines = [
        with_definitions(line) if line.startswith(SETS_OF_RULES) else line
        for name in stored()
        if name.split("/")[0] in owners
        for line in stored().shortened[name][1:]
    ]
    return "\n".join(lines)


def exceptions() -> dict[tuple[str, str], str]:
    """Claim and name, with the reason."""
    head, *rows = EXCEPTIONS.read_text(encoding="ascii").splitlines()
    assert head.split("\t") == ["claim", "name", "reason"]
    found = {(claim, name): reason for claim, name, reason in (row.split("\t") for row in rows)}
    assert len(found) == len(rows)
    return found


def test_what_a_sentence_names_is_defined_in_its_statements_holds() -> None:
    """No sentence is listed that has what it names: an exception that is not needed fails too."""
    found = {
        (claim.id, name)
        for claim in opened().claims()
        for text in [statements(claim)]
        if text
        for name in missing(claim.says, text)
    }
    assert found == set(exceptions())


def test_a_sentence_says_what_narrows_its_statements_holds() -> None:
    found = {
        claim.id: unsaid(claim.says, statements(claim, rules=False)) for claim in opened().claims()
    }
    assert {claim: names for claim, names in found.items() if names} == {}


def test_rejects_a_sentence_that_does_not_say_what_narrows() -> None:
    """As that of s4.3.2-K-invariant did not."""
    said = "The band is mapped into itself."
    assert unsaid(said, "given narrow(eps)\nshow in_band(f1(beta, v), eps)") == ["narrow"]
    assert unsaid("A narrow band is.", "given narrow(eps)") == []


def test_every_exception_has_a_reason_holds() -> None:
    assert all(reason.endswith(".") for reason in exceptions().values())


@each_row("name", [row[0] for row in sets()])
def test_a_definition_of_a_set_stands_in_statements_and_for_words_holds(name: str) -> None:
    used = re.compile(rf"\b{name}\b")
    assert any(used.search(line) for lines in stored().shortened.values() for line in lines)
    assert any(name in stands for _, _, stands in NAMES) or name == "K_from_e_1"


# The line of a statement, written out; the line that is put in its place; what is found missing.
CHANGED = (
    (
        "s4.3.2-f1-boundary/near-e_1.main",
        "given (alpha*r - r)/(alpha + 1) < c and (c - (alpha*r - r)/(alpha + 1))^2/2 > eps",
        "given (c - (alpha*r - r)/(alpha + 1))^2/2 > eps",
        "narrow",
    ),
    (
        "s4.3.2-f1-boundary/near-e_1.main",
        "given (alpha*r - r)/(alpha + 1) < c and (c - (alpha*r - r)/(alpha + 1))^2/2 > eps",
        "given (alpha*r - r)/(alpha + 1) < c and (c - (alpha*r - r)/(alpha + 1))^2/2 >= eps",
        "narrow",
    ),
    (
        "s3.3-e1-in-B1/main",
        "show beta >= 0 and -beta*g/2 + r^2 - r*v > 0",
        "show beta >= 0 and -beta*g/2 + r^2 - r*v >= 0",
        "B1",
    ),
)


@each_row(("statement", "line", "other", "found"), CHANGED)
def test_rejects_a_statement_with_another_condition(
    statement: str, line: str, other: str, found: str
) -> None:
    (claim,) = (one for one in opened().claims() if one.id == statement.split("/")[0])
    rows = stored()[statement].split("\n")
    assert line in rows
    changed = [other if row == line else row for row in rows]
    before, after = (
        set(missing(claim.says, "\n".join(map(with_definitions, one[1:]))))
        for one in (rows, changed)
    )
    assert after - before == {found}


@each_row(("name", "words", "stands"), NAMES)
def test_rejects_a_statement_without_what_is_named(
    name: str, words: str, stands: tuple[str, ...]
) -> None:
    """Some claim names it, and the statements of that claim do not without it."""
    naming = [claim for claim in opened().claims() if name in dict(named(claim.says))]
    claims = [(claim, text) for claim in naming if (text := statements(claim))]
    assert claims
    without = re.compile("|".join(rf"(?<!\w)(?:{one})(?![\w'])" for one in stands))
    for claim, text in claims:
        assert name in missing(claim.says, without.sub("other", text)), words
