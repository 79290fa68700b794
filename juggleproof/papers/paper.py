"""The description of a paper, and the paper that commands are about.

The tool imports no paper.  A paper is a package that describes itself by a `Paper`; its
hooks name, by module and function, what this paper alone has, such as a page on its theorem.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from importlib import import_module
from typing import TypeVar

from juggleproof.folders import PACKAGE
from juggleproof.judging.claims import Claim, claims_in
from juggleproof.papers.indexed_claims import IndexedClaims
from juggleproof.statements.language import ClaimError

Kind = TypeVar("Kind")


@dataclass(frozen=True)
class Theorem:
    """The main result of a paper: the name of its statement, a digest of that statement and of all
    that it rests on, and the sentence that it proves.

    Only the digest shows that a certified statement of this name is the theorem.
    """

    name: str
    digest: str
    sentence: str

    @property
    def claim(self) -> str:
        """The claim whose statement it is."""
        return self.name.partition("/")[0]


@dataclass(frozen=True)
class Paper:
    """A paper: the modules of its claims, its theorem, and its hooks.

    modules       the modules of its claims, in the paper's order
    checked_apart the modules whose claims another checker settles
    unprinted     claims that the paper itself does not print, each with its reason
    hooks         the places, as "module:name", of what this paper alone has, by name
    """

    modules: tuple[str, ...]
    checked_apart: tuple[str, ...]
    unprinted: Mapping[str, str]
    theorem: Theorem
    hooks: Mapping[str, str]

    def claims(self) -> list[Claim]:
        """The claims in the paper's order."""
        return claims_in(self.modules)

    @cached_property
    def claims_by_id(self) -> Mapping[str, Claim]:
        """The claims by id, in the paper's order; each loads its module when it is first used."""
        return IndexedClaims(self.modules)

    def hook(self, name: str, kind: type[Kind]) -> Kind:
        """The object of a hook; raises ClaimError, one line, where it is not of this type.

        >>> opened().hook("explain-state", object).__name__
        'explain_state'
        """
        module, _, found = self.hooks[name].partition(":")
        value = getattr(import_module(module), found)
        if not isinstance(value, kind):
            raise ClaimError(f"{module}: {found} is no {kind.__name__}, which {name} needs")
        return value


@cache
def opened() -> Paper:
    """The paper that commands are about; raises ClaimError where its package describes none.

    >>> opened().theorem.claim
    'theorem-in-units'
    """
    paper = getattr(import_module(PACKAGE), "PAPER", None)
    if not isinstance(paper, Paper):
        raise ClaimError(f"{PACKAGE}: PAPER describes no paper")
    return paper
