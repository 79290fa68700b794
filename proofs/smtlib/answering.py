"""Answers problems: unsat by a certificate that the checker accepted, sat by an exact model that it
accepted, else unknown.

A question and its answer are plain text and data, so that they pass between processes and machines.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from certificates import checker
from certificates.search.budget import Budget, Exhausted
from certificates.search.certificate import SQUARES_FIRST, search_certificate
from certificates.store import Store

from .script import Problem
from .stating import denial, givens, statement_of

BUDGET = 2_000_000
WORDS = {"certified": "unsat", "refuted": "sat"}


@dataclass(frozen=True)
class Question:
    """A statement that is certified where a problem has no solution; where it has givens, also that
    these contradict one another.

    `stored` holds certificates of an earlier run, by the text of the statement.
    """

    name: str
    texts: tuple[str, ...]
    budget: int = BUDGET
    stored: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Answer:
    """sat, unsat or unknown, the statement that was settled, and its certificate."""

    name: str
    word: str
    text: str
    certificate: Any

    @property
    def reason(self) -> str:
        """Why nothing was found; nothing where something was."""
        return str(self.certificate.get("unknown", ""))

    @property
    def model(self) -> tuple[tuple[str, str], ...]:
        """The value of every variable of the statement, where there is a model."""
        return tuple(sorted(self.certificate["refuted"][2].items())) if self.word == "sat" else ()

    @property
    def numbers(self) -> tuple[str, ...]:
        """The algebraic numbers that the model speaks of, each as the root of a polynomial between
        two bounds.
        """
        entries = self.certificate["refuted"][1] if self.word == "sat" else []
        return tuple(
            f"{low} <= {name} <= {high}, {poly} = 0" for name, poly, low, high, *_ in entries
        )


def question(
    problem: Problem, name: str, budget: int = BUDGET, store: Store | None = None
) -> Question:
    """The question that a problem comes to; raises ClaimError, one line, for a division by what may
    vanish.
    """
    whole = statement_of(problem, name)
    parts = [whole, denial(problem, name, givens(whole))] if givens(whole) else [whole]
    texts = tuple(part.text() for part in parts)
    stored = {text: store.certificate(name, text) for text in texts} if store else {}
    return Question(name, texts, budget, {text: found for text, found in stored.items() if found})


def answer(asked: Question) -> Answer:
    """The answer, which the checker has accepted.

    >>> text = "statement f/check-1\\nforall x\\nshow not x^2 = 2"
    >>> answer(Question("f/check-1", (text,))).numbers
    ('-3/2 <= theta <= -7/5, -theta^2 + 2 = 0',)
    """
    for text, certificate in asked.stored.items():
        word = settled(asked.name, text, certificate)
        if word != "unknown" and not (word == "sat" and text != asked.texts[0]):
            return Answer(asked.name, word, text, certificate)
    first: Answer | None = None
    for text in asked.texts:
        certificate = _searched(asked.name, text, asked.budget)
        word = settled(asked.name, text, certificate)
        if word == "unsat" or word == "sat" and text == asked.texts[0]:
            return Answer(asked.name, word, text, certificate)
        told = (
            certificate
            if "unknown" in certificate
            else {"unknown": "the checker rejects what was found"}
        )
        first = first or Answer(asked.name, "unknown", text, told)
    return first or Answer(asked.name, "unknown", "", {"unknown": "nothing was asked"})


def settled(name: str, text: str, certificate: Any) -> str:
    """sat or unsat where the checker accepts the certificate, else unknown."""
    outcome, _ = checker.check_one(checker.read_statements(text)[name], certificate, {}, {})
    return WORDS.get(str(outcome), "unknown")


def _searched(name: str, text: str, budget: int) -> dict[str, Any]:
    try:
        return search_certificate(
            checker.read_statements(text)[name], {}, Budget(budget), attempts=SQUARES_FIRST
        )
    except Exhausted:
        return {"unknown": f"the budget of {budget} units ran out"}
    except (OverflowError, ValueError) as error:
        if isinstance(error, ValueError) and "integer string conversion" not in str(error):
            raise
        return {
            "unknown": "its numbers grow too long for the search"
        }  # beyond floats, or beyond what Python writes


def in_script(answered: Answer, problem: Problem) -> list[tuple[str, str]]:
    """The model in the script's own symbols, in its order; a variable that no assertion mentions is
    0.

    A Bool is told by the sign of the real that stands for it, where that is a number.
    """
    values, told = dict(answered.model), []
    for variable in problem.variables:
        value = values.get(variable.name, "0")
        if variable.sort == "Bool":
            value = (
                f"{value} > 0"
                if re.search("[A-Za-z]", value)
                else "true"
                if Fraction(value) > 0
                else "false"
            )
        told.append((variable.symbol, value))
    return told
