"""The folder of the paper that commands are about; the paper is located, but not imported."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

PACKAGE = f"{__package__}.proofs"  # it has PAPER, and the module `deriving`, which loads SymPy


def folder_of(package: str) -> Path:
    """The folder of a package, which is not imported; only the packages that contain it are.

    >>> folder_of("juggleproof.papers").name
    'papers'
    """
    spec = find_spec(package)
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError(package)
    return Path(spec.origin).parent


FOLDER = folder_of(PACKAGE)
REGISTER = FOLDER / "register.json"
LEDGER = FOLDER / "ledger"  # the ledger, the index of claims, and the stored derivations
