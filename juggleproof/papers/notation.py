"""The notation of a paper, as data: names of statements, of sentences and of prints."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property


@dataclass(frozen=True)
class Notation:
    r"""The notation of a paper; without any, names are shown by their letters.

    symbols      a name in statements, its LaTeX, and its meaning; one without meaning is not listed
    order        names in the order in which products have their factors
    meanings     the meanings of names that `symbols` lacks
    together     names that have their meaning only where all names of `beside` occur
    sentences    the LaTeX of names that only sentences have
    letters      the letters that are names in sentences
    derived      the LaTeX of derived expressions, by the function that derives each
    shown_first  functions whose formulas stand before the errata
    operators    the meanings of operators in prints
    macros       a name, its LaTeX, and a pattern of how prints write it
    claims       a pattern of the claims that sentences name

    >>> Notation(symbols=(("v", r"\dot x", "velocity"),)).glyphs
    {'v': '\\dot x'}
    """

    symbols: tuple[tuple[str, str, str], ...] = ()
    order: tuple[str, ...] = ()
    meanings: Mapping[str, str] = field(default_factory=dict)
    together: frozenset[str] = frozenset()
    beside: frozenset[str] = frozenset()
    sentences: Mapping[str, str] = field(default_factory=dict)
    letters: frozenset[str] = frozenset()
    derived: Mapping[str, str] = field(default_factory=dict)
    shown_first: tuple[str, ...] = ()
    operators: Mapping[str, str] = field(default_factory=dict)
    macros: tuple[tuple[str, str, str], ...] = ()
    claims: str = "(?!)"

    @cached_property
    def glyphs(self) -> Mapping[str, str]:
        """The LaTeX of each symbol, by its name."""
        return {name: latex for name, latex, _ in self.symbols}

    @cached_property
    def listed(self) -> Mapping[str, str]:
        """The meanings of the symbols that have one, by their names."""
        return {name: meaning for name, _, meaning in self.symbols if meaning}

    def is_meant(self, name: str, names: Collection[str]) -> bool:
        """Whether a name has its meaning among these names.

        >>> notation = Notation(together=frozenset("xu"), beside=frozenset("xw"))
        >>> notation.is_meant("u", ["u", "x", "w"]), notation.is_meant("u", ["u", "x"])
        (True, False)
        """
        return name not in self.together or self.beside <= set(names)
