"""The description of a paper, and the paper that commands are about.

The tool imports no paper.  A paper is a package that describes itself by a `Paper`; its
hooks name, by module and function, what this paper alone has, such as a page on its theorem.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib import import_module
from pathlib import Path
from typing import TypeVar

from juggleproof.folders import PACKAGE
from juggleproof.judging.claims import Claim, claims_in
from juggleproof.lazy import loaded
from juggleproof.papers.indexed_claims import IndexedClaims
from juggleproof.papers.notation import Notation
from juggleproof.statements.language import ClaimError

Kind = TypeVar("Kind")


@dataclass(frozen=True)
class Theorem:
    """The main result of a paper: the name of its statement, a digest of that statement and of all
    that it rests on, and the sentence that it proves.

    Only the digest shows that a certified statement of this name is the theorem.  `witness` tells
    in lines who proves it too, and `explained` where its proof can be read; both may be empty.
    """

    name: str
    digest: str
    sentence: str
    witness: tuple[str, ...] = ()
    explained: str = ""

    @property
    def claim(self) -> str:
        """The claim whose statement it is."""
        return self.name.partition("/")[0]


@dataclass(frozen=True)
class Publication:
    """A paper as reports name it: `topic` names its subject in a few words, `about` in a sentence,
    and `key` is the key of its entry in paper.bib, if its templates have that file.
    """

    title: str
    authors: str
    year: int
    topic: str
    about: str
    keywords: str = ""
    key: str = ""

    @property
    def short_title(self) -> str:
        """The title up to its colon."""
        return self.title.partition(":")[0]


@dataclass(frozen=True)
class Paper:
    """A paper: the modules of its claims, its theorem, what reports say of it, and its hooks.

    modules        the modules of its claims, in the paper's order
    publication    its title, authors and subject
    checked_apart  the modules whose claims another checker settles
    unprinted      claims that the paper itself does not print, each with its reason
    theorem        its main result, if that is proved
    principles     the laws from which they are derived, as LaTeX
    parameter      the parameter whose sharp ranges are sought, and `domain`, where it lies
    letters        the letters that the errata use, explained in sentences
    enters         the claims whose values enter other results of the paper
    appendices     the titles of the parts that reports regenerate, by their letter
    headings       the headings of their sections, in order, with formulas between dollars
    pages          the pages of this project that have a part which is generated
    templates      the folder of its own templates for reports
    hooks          the places, as "module:name", of what this paper alone has, by name
    """

    modules: tuple[str, ...]
    publication: Publication
    checked_apart: tuple[str, ...] = ()
    unprinted: Mapping[str, str] = field(default_factory=dict)
    theorem: Theorem | None = None
    principles: str = ""
    parameter: str = ""
    domain: str = ""
    letters: str = ""
    enters: tuple[str, ...] = ()
    appendices: Mapping[str, str] = field(default_factory=dict)
    headings: Mapping[str, str] = field(default_factory=dict)
    pages: tuple[str, ...] = ()
    templates: Path | None = None
    hooks: Mapping[str, str] = field(default_factory=dict)

    def claims(self) -> list[Claim]:
        """The claims in the paper's order."""
        return claims_in(self.modules)

    @cached_property
    def claims_by_id(self) -> Mapping[str, Claim]:
        """The claims by id, in the paper's order; each loads its module when it is first used."""
        return IndexedClaims(self.modules)

    @cached_property
    def notation(self) -> Notation:
        """The notation of its hook; an empty one where it has none."""
        return self.hook("notation", Notation) or Notation()

    def hook(self, name: str, kind: type[Kind]) -> Kind | None:
        """The object of a hook, None where the paper lacks the hook; raises ClaimError, one line,
        where the object is not of this type.

        >>> opened().hook("explain-state", object).__name__
        'explain_state'
        """
        if name not in self.hooks:
            return None
        value = loaded(self.hooks[name])
        if not isinstance(value, kind):
            raise ClaimError(f"{self.hooks[name]} is no {kind.__name__}, which {name} needs")
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
