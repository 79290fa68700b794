"""Libraries of the optional extras, imported where they are used."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from juggleproof.statements.language import ClaimError

# The packages of each extra, as in pyproject.toml, for pip in a checkout and beside a wheel alike.
EXTRAS = {"report": "jinja2 matplotlib latex2mathml", "part": "numba"}


def needed(module: str, purpose: str = "report", extra: str = "report") -> ModuleType:
    """The module, imported; raises ClaimError, one line that says how to install it, where it is
    absent.
    """
    try:
        return import_module(module)
    except ImportError:
        raise ClaimError(
            f"{module.partition('.')[0]} is needed for this {purpose}; install it with pip install"
            f" {EXTRAS[extra]}"
        ) from None
