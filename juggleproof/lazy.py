"""A package whose names load the file that defines them when they are first used (PEP 562)."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def lazy_names(
    package: str, files: Mapping[str, str]
) -> tuple[list[str], Callable[[str], Any], Callable[[], list[str]]]:
    """`__all__`, `__getattr__` and `__dir__` of a package; `files` maps the relative name of a file
    to the names that it defines, separated by spaces.

    `__getattr__` raises AttributeError for any other name.  It returns Any, because a name that is
    looked up as text has no type.

    >>> names, load, _ = lazy_names("juggleproof.symbolic", {".algebra": "alpha state"})
    >>> names, load("alpha")
    (['alpha', 'state'], alpha)
    """
    file_of = {name: file for file, names in files.items() for name in names.split()}

    def load(name: str) -> Any:
        if name not in file_of:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return getattr(import_module(file_of[name], package), name)

    return sorted(file_of), load, lambda: sorted({*vars(sys.modules[package]), *file_of})


def loaded(place: str) -> Any:
    """The object at a place "module:name"; its module is imported.

    >>> loaded("fractions:Fraction")
    <class 'fractions.Fraction'>
    """
    module, _, name = place.partition(":")
    return getattr(import_module(module), name)
