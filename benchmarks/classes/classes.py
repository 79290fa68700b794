"""The classes of problems, each with the functions that make its random problems; and the problems
that these make from counted seeds.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from random import Random
from typing import NamedTuple

from juggleproof.benchmarks.classes import polynomials, scripts

Maker = Callable[[Random, bool], str]  # whether it is to be solvable

CLASSES: Mapping[str, Sequence[Maker]] = {
    "divisions": (
        scripts.ratio_and_inverse,
        scripts.sum_of_ratios,
        scripts.mediant,
        scripts.divisor_that_vanishes,
    ),
    "size": (scripts.nested, scripts.doubled, scripts.linear_system, scripts.differences),
    "boxes": (
        polynomials.over_a_box,
        polynomials.above_a_bound,
        polynomials.box_and_constraints,
        polynomials.bonferroni,
        polynomials.product_below_mean,
    ),
    "many variables": (scripts.bilinear, scripts.clauses, scripts.zero_or_one),
    "commands": (scripts.assumed, scripts.lasting, scripts.logics),
    "forms": (
        polynomials.published_form,
        polynomials.moved_form,
        polynomials.agiform,
        polynomials.sum_of_squares,
    ),
    "one variable": (
        polynomials.between_roots,
        polynomials.beside_a_root,
        polynomials.chebyshev,
        polynomials.sparse,
        polynomials.clauses_on_a_line,
    ),
    "equations": (
        polynomials.touching,
        polynomials.tower,
        polynomials.symmetric,
        polynomials.ideal,
    ),
    "several constraints": (
        polynomials.planted_certificate,
        polynomials.balls,
        polynomials.bent,
        polynomials.above_and_below,
        polynomials.binomials,
    ),
}
SEEDS = 24  # problems of each class


class Made(NamedTuple):
    """A problem that a function made: its class and name, sat or unsat, and its script."""

    group: str
    name: str
    status: str
    script: str


def made(group: str, seed: int) -> Made:
    """The problem of a class for a seed: the functions of the class take turns, and each makes
    problems with and without a solution in turn.

    >>> made("one variable", 5).name, made("one variable", 5).status
    ('between-roots-5', 'sat')
    """
    makers = CLASSES[group]
    maker, solvable = makers[seed % len(makers)], seed // len(makers) % 2 == 1
    text = maker(Random(f"{maker.__name__} {seed}"), solvable)
    name = f"{maker.__name__.replace('_', '-')}-{seed}"
    return Made(group, name, "sat" if solvable else "unsat", text)


def every_problem(seeds: int = SEEDS) -> list[Made]:
    """The problems of all classes, `seeds` of each."""
    return [made(group, seed) for group in CLASSES for seed in range(seeds)]
