r"""What the names of a print mean: LaTeX keys, in which \cdot is the place of an argument.

    Environment(
        {r"\alpha": alpha, r"\dot\rho_0": r, r"\overline\beta": beta, r"\dot{\overline\beta}": v,
         r"A_{\cdot}": lambda t: Matrix(((1, t), (0, 1))),      # A_T, A_{-\xi_1}: a family by its
         subscript r"F^{\cdot}": flow,                                    # F^t is flow(t), a
         function of states r"E": StateFunction(energy), r"\mathcal{B}_1": Region(in_B1),
         r"\sqrt{\cdot}": adjoin_root, r"\Delta_1 E": StateFunction(gain)},
        points={r"\overline b": (r"\overline\beta", r"\dot{\overline\beta}")},
        state=r"\overline b",
    )

`points` says which names are the components of a state, so that a set {b | ..} can be asked about
any state; `state` is the present one, which stands in where a print leaves the argument of a
function out.  A key may be any expression (`\Delta E_{max}`, `\sqrt{2(1+\alpha)}`, `E(t)`):
wherever the print says the same, the key's value is meant, before its pieces are looked at.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

from certificates.terms import ClaimError
from proofs.reading.parser import parse_name
from proofs.reading.tree import Name, Tree
from proofs.reading.values import Vector

_key = lru_cache(maxsize=4096)(parse_name)


class Environment:
    """The meanings of names and of other expressions."""

    __slots__ = ("meanings", "kinds", "points", "state")

    def __init__(
        self,
        names: Mapping[str, Any],
        *,
        points: Mapping[str, Sequence[str]] | None = None,
        state: str | None = None,
    ) -> None:
        self.meanings: dict[Tree, Any] = {
            _key(latex): _exact(latex, value) for latex, value in names.items()
        }
        self.points = {
            _key(point): tuple(map(_key, names)) for point, names in (points or {}).items()
        }
        for point, components in self.points.items():
            if point not in self.meanings and all(name in self.meanings for name in components):
                self.meanings[point] = Vector(tuple(self.meanings[name] for name in components))
        self.state: Any = None
        if state is not None:
            if _key(state) not in self.meanings:
                raise ClaimError(f"the state {state} has no meaning in its own environment")
            self.state = self.meanings[_key(state)]
        self.kinds = frozenset(type(tree) for tree in self.meanings) - {Name}

    def extended(self, names: Mapping[str, Any]) -> Environment:
        """This environment with more names, or other meanings of them."""
        return self._with(
            {_key(latex): _exact(latex, value) for latex, value in names.items()}, self.state
        )

    def meaning_of(self, latex: str) -> Any:
        """The value bound to this very key."""
        if _key(latex) not in self.meanings:
            raise ClaimError(f"{latex} is no key of this environment")
        return self.meanings[_key(latex)]

    def at(self, point: Tree, state: Vector) -> Environment:
        """This environment with the point, and its components, and the present state, being this
        state.
        """
        components = self.points.get(point)
        if components is None or len(components) != len(state.entries):
            raise ClaimError("the environment names no such components of a state")
        return self._with(
            {point: state, **dict(zip(components, state.entries, strict=True))}, state
        )

    def _with(self, meanings: Mapping[Tree, Any], state: Any) -> Environment:
        other = object.__new__(Environment)
        other.meanings = {**self.meanings, **meanings}
        other.points, other.state = self.points, state
        other.kinds = self.kinds | {type(tree) for tree in meanings} - {Name}
        return other


def _exact(latex: str, value: Any) -> Any:
    if isinstance(value, (float, complex)):
        raise ClaimError(
            f"{latex} is given the float {value!r}; only exact numbers and terms have a meaning"
        )
    return value
