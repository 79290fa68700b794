"""The package loads nothing until a derivation is asked for, and says so where a derivation
fails.
"""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
from sympy import ImmutableMatrix, sqrt

import juggleproof.symbolic as s

MODULES = sorted(
    path.stem for path in Path(s.__file__).parent.glob("*.py") if path.stem != "__init__"
)


def test_importing_the_package_loads_no_sympy_holds() -> None:
    code = "import juggleproof.symbolic, sys; sys.exit('sympy' in sys.modules)"
    assert (
        subprocess.run(
            [sys.executable, "-c", code], cwd=Path(s.__file__).parents[1], check=False
        ).returncode
        == 0
    )


def test_every_listed_name_resolves_to_its_module_holds() -> None:
    for module, names in s.NAMES.items():
        for name in names.split():
            assert getattr(s, name) is getattr(import_module(module, s.__name__), name)
    assert s.__all__ == sorted(" ".join(s.NAMES.values()).split())
    assert set(s.__all__) <= set(dir(s))
    # A function named like a module would be hidden by the module once that is loaded.
    assert not set(s.__all__) & set(MODULES)


def test_unknown_name_is_refused_holds() -> None:
    with pytest.raises(AttributeError, match="no_such_name"):
        s.no_such_name  # noqa: B018


def test_every_public_function_has_an_example_holds() -> None:
    for name in s.__all__:
        found = getattr(s, name)
        if callable(found) and not isinstance(found, type):
            assert ">>>" in (found.__doc__ or ""), name


def test_broken_shapes_are_refused_holds() -> None:
    with pytest.raises(s.DerivationError, match="not affine"):
        s.affine_parts(s.state(s.beta**2, s.v))
    with pytest.raises(s.DerivationError, match="not linear"):
        s.root_of(s.v**2 - 1, s.v)
    with pytest.raises(s.DerivationError, match="not one solution"):
        s.solution_of([s.beta + s.v], [s.beta, s.v])
    with pytest.raises(s.DerivationError, match="not unipotent"):
        s.unipotent_power(ImmutableMatrix([[2, 0], [0, 1]]), s.n)
    with pytest.raises(s.DerivationError, match="not a rational"):
        s.lowest_terms(sqrt(s.alpha))
    with pytest.raises(s.DerivationError, match="shifted"):
        s.time_shift(s.state(s.r, s.v), s.alpha)
