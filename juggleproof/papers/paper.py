"""A paper described, and the one that commands are about, opened.

The tool imports no paper.  A paper is a package that describes itself by a `Paper`; what it alone
has, such as a page on its theorem, is named there by module and function, and loaded when asked.
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
    """The main result of a paper: its statement's name, a digest of that statement and of all that
    it rests on, as the sources write them, and what it says.

    A certified statement of the same name may say anything; the digest tells.
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
    """A paper: the modules of its claims in order, its theorem, and what hangs in from it.

    modules       of its claims, in the paper's order
    checked_apart those of them whose claims another checker settles
    unprinted     claims that the paper itself does not print, each with its reason
    hooks         by name, what this paper alone has: a module and a name in it, as "module:name"
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
        """What hangs in under a name; raises ClaimError, one line, for what is not of this kind.

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
