"""Libraries of the optional extra `report`, asked for where they are used."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from certificates.terms import ClaimError


def needed(module: str) -> Any:
    """The module, imported; raises ClaimError, one line that says how to install it, where it is
    absent.
    """
    try:
        return import_module(module)
    except ImportError:
        raise ClaimError(
            f"{module.partition('.')[0]} is needed for this report; install it with pip install -e"
            " '.[report]'"
        ) from None
