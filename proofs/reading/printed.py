r"""A print as a claim receives it: its LaTeX, its tree, and what it states in an environment."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from certificates.terms import Formula, Term, conjunction, term
from proofs.reading import tree as t
from proofs.reading.environment import Environment
from proofs.reading.errors import PrintError
from proofs.reading.meaning import Meaning
from proofs.reading.notions import Region
from proofs.reading.parser import parse, parse_name
from proofs.reading.tree import Tree, spelled
from proofs.reading.values import is_scalar


class Printed:
    r"""The reading of one display, or of one part of it.

    >>> from certificates.terms import reals
    >>> alpha, v, r = reals("alpha v r")
    >>> names = Environment({r"\alpha": alpha, r"\dot{\overline\beta}": v, r"\dot\rho_0": r})
    >>> gain = Printed(r"\dot{\overline{\beta}} = \frac{1+\alpha}{1-\alpha} \dot\rho_0 \tag{33}")
    >>> str(gain.formula(names))
    'v = (1 + alpha)/(1 - alpha)*r'
    >>> Printed(r"\dot\beta = \dot\rho_0").formula(names)
    Traceback (most recent call last):
    proofs.reading.errors.PrintError: column 1: \dot{\beta} has no meaning here
    """

    __slots__ = ("latex", "_parts")

    def __init__(self, latex: str, parts: tuple[Tree, ...] | None = None) -> None:
        self.latex = latex
        self._parts = parse(latex) if parts is None else parts

    def __repr__(self) -> str:
        return f"Printed({self.latex!r})"

    @property
    def parts(self) -> tuple[Printed, ...]:
        """The parts of a display of several lines, each a print of its own (columns count in the
        whole).
        """
        return tuple(Printed(self.latex, (part,)) for part in self._parts)

    @property
    def tree(self) -> Tree:
        """The tree of a display of one part."""
        if len(self._parts) != 1:
            raise PrintError(
                self._parts[1].at, f"this print has {len(self._parts)} parts; take them from .parts"
            )
        return self._parts[0]

    @property
    def names(self) -> tuple[str, ...]:
        """The names that occur, as LaTeX, in order of first appearance."""
        return tuple(
            dict.fromkeys(spelled(name) for part in self._parts for name in _names_in(part))
        )

    def relation_chain(self, environment: Environment) -> list[tuple[Any, str, Any]]:
        """(left value, relation sign, right value) for each relation of the chain, in order."""
        chain = self._chain()
        return [
            (_as_term(a), sign, _as_term(b)) for a, sign, b in Meaning(environment).triples(chain)
        ]

    def left(self, environment: Environment) -> Any:
        """The value of what stands before the first relation."""
        return self.relation_chain(environment)[0][0]

    def right(self, environment: Environment) -> Any:
        """The value of what stands after the last relation."""
        return self.relation_chain(environment)[-1][2]

    def definition(self, environment: Environment, of: str) -> Any:
        """The value that the print gives to the expression `of`, which must stand before its only
        relation, := or =.
        """
        chain = self._chain()
        if chain.first != parse_name(of):
            raise PrintError(
                chain.first.at, f"{spelled(chain.first)} stands here, where {of} was expected"
            )
        if len(chain.rest) != 1 or chain.rest[0][0] not in (":=", "=", r"\equiv"):
            raise PrintError(chain.at, "a definition is one expression, one :=, one value")
        return _as_term(Meaning(environment).side(chain.rest[0][1]))

    def value(self, environment: Environment) -> Any:
        """The value of a print that is a single expression, without a relation."""
        if isinstance(self.tree, (t.Chain, t.ForAll)):
            raise PrintError(
                self.tree.at,
                "this is a relation, not one value; take .left, .right or .relation_chain",
            )
        return _as_term(Meaning(environment).side(self.tree))

    def formula(self, environment: Environment) -> Formula:
        """All that the print states: every relation of every part."""
        meaning = Meaning(environment)
        return conjunction([meaning.formula(part) for part in self._parts])

    def set_predicate(self, environment: Environment, of: str | None = None) -> Region:
        """The region that the print defines: state -> formula.

        The head must be the name `of`, or, where none is given, a name of the environment.  Base
        set, element and condition all go into the formula; nothing else may stand there.
        """
        chain = self._chain()
        if len(chain.rest) != 1 or chain.rest[0][0] not in (":=", "="):
            raise PrintError(chain.at, "a definition of a region is one name, one :=, one set")
        if of is None:
            Meaning(environment).of(chain.first)
        elif chain.first != parse_name(of):
            raise PrintError(
                chain.first.at, f"{spelled(chain.first)} is defined here, where {of} was expected"
            )
        meaning, right = Meaning(environment), chain.rest[0][1]
        region = meaning.of(right)
        if not isinstance(region, Region):
            raise PrintError(right.at, "this is not a region")
        for (
            point,
            components,
        ) in environment.points.items():  # refuse now, not when the region is first asked
            if point in environment.meanings and len(components) > 1:
                region(environment.meanings[point])
        return region

    def _chain(self) -> t.Chain:
        tree = self.tree
        if not isinstance(tree, t.Chain):
            raise PrintError(tree.at, "this states nothing: a relation is expected")
        return tree


def read(latex: str) -> Printed:
    """The reading of a print."""
    return Printed(latex)


def _as_term(value: Any) -> Any:
    return term(value) if is_scalar(value) and not isinstance(value, Term) else value


def _names_in(tree: Any) -> Iterator[Tree]:
    if isinstance(tree, t.Name):
        yield tree
    elif isinstance(tree, tuple):
        for item in tree:
            yield from _names_in(item)
    elif isinstance(tree, Tree):
        for field in tree.__dataclass_fields__:
            yield from _names_in(getattr(tree, field))
