"""Where the folder of the paper is that commands are about; it is found, and not imported."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

PACKAGE = f"{__package__}.proofs"  # it has PAPER, and the module `deriving`, which loads SymPy


def folder_of(package: str) -> Path:
    """The folder of a package; of those above it, and of no other, the code runs.

    >>> folder_of("juggleproof.papers").name
    'papers'
    """
    spec = find_spec(package)
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError(package)
    return Path(spec.origin).parent


FOLDER = folder_of(PACKAGE)
REGISTER = FOLDER / "register.json"
LEDGER = FOLDER / "ledger"  # the ledger, the index of claims, and what is derived for them
