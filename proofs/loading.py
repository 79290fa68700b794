"""Loads claims: the paper's, or those of a user's own file."""

from __future__ import annotations

import importlib.util
import sys
import traceback
from pathlib import Path

from certificates.terms import ClaimError
from proofs.claims import Claim, claims_of


def paper_claims() -> list[Claim]:
    """The claims of the paper in its order."""
    from proofs.paper import load_claims

    return claims_of(load_claims)


def claims_of_file(path: Path) -> list[Claim]:
    """The claims of a Python file.

    Raises ClaimError, one line with file and line, where it does not parse, fails, or holds no
    claim.
    """
    if path.is_dir():
        raise ClaimError(f"{path}: a folder; name a Python file with claims")
    if not path.is_file():
        raise ClaimError(f"{path}: no such file; name a Python file with claims")

    def load() -> None:
        spec = importlib.util.spec_from_file_location(f"claims_of_{path.stem}", path)
        if spec is None or spec.loader is None:
            raise ClaimError(f"{path}: not a Python file; its name must end with .py")
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module
        try:
            spec.loader.exec_module(module)
        except ClaimError as problem:
            raise ClaimError(f"{path}:{_line_in(path)}: {problem}") from None
        except SyntaxError as problem:
            raise ClaimError(
                f"{path}:{problem.lineno}: does not parse ({problem.msg}); mend the syntax"
            ) from None
        except (Exception, SystemExit) as problem:
            raise ClaimError(
                f"{path}:{_line_in(path)}: {type(problem).__name__}: {problem}; mend this line"
            ) from None

    claims = claims_of(load)
    if not claims:
        raise ClaimError(f'{path}: no claims; decorate a function with @claim("its-name")')
    return claims


def _line_in(path: Path) -> int:
    """The last line of the file on the stack of the error at hand."""
    frames = traceback.extract_tb(sys.exc_info()[2])
    lines = [frame.lineno for frame in frames if frame.filename == str(path) and frame.lineno]
    return lines[-1] if lines else 1
