"""The results of SymPy for the claims, stored as text with a digest of the sources that derive
them, so that a claim is stated without SymPy.

`certify --accept` writes the file.  `certify --rederive` derives everything again and compares.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Hashable, Iterable, Mapping
from fractions import Fraction
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TypeVar, Union

from juggleproof.folders import LEDGER, folder_of
from juggleproof.reading.values import Matrix, Vector
from juggleproof.statements.formulas import Argument, Expression
from juggleproof.statements.language import ClaimError, Formula, Term, real, term
from juggleproof.statements.store import canonical, write_file

PATH = LEDGER / "derived.json"
ENCODER = "juggleproof.encoding"
DERIVATIONS = "juggleproof.symbolic"  # the package that derives expressions
RELATIONS = ("<", "<=", "=", "!=", ">=", ">")
JOINED = ("and", "or", "not", "implies", "iff")
Value = Union[Term, Formula, Vector, Matrix, str, tuple["Value", ...]]
Plain = Union[str, int, list["Plain"]]  # as JSON has it
Kind = TypeVar("Kind", Term, Formula, Vector, Matrix, str, tuple[Value, ...])


class Kept:
    """The stored results of one file: `held` has all that the file holds (nothing where the sources
    have changed), `asked` those that were used or derived since.
    """

    def __init__(self, path: Path = PATH) -> None:
        self.path, self.asked = path, dict[str, Plain]()
        self.held = self._read()

    def _read(self) -> dict[str, Plain]:
        try:
            data = json.loads(self.path.read_text(encoding="utf-8"))
            held: dict[str, Plain] = data["derived"]
            return held if data["sources"] == digest_of(held) else {}
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            return {}

    def value(self, function: str, *arguments: Hashable) -> Value:
        """The value of a function, given with its module: the stored value, or else the result of
        calling it.

        Raises ClaimError where the value as text is not read back as the same value.
        """
        name = f"{function}({', '.join(map(repr, arguments))})"
        if name in self.held and name not in self.asked:
            self.asked[name] = self.held[name]
        if name in self.asked:  # stored, or derived before
            return unpacked(self.asked[name])
        module, _, called = function.rpartition(".")
        value: Value = getattr(import_module(module), called)(*arguments)
        self.asked[name] = packed(value)
        if unpacked(self.asked[name]) != value:
            raise ClaimError(f"{name} comes to what its text is not read as")
        return value

    def write(self) -> bool:
        """Writes the values in `asked` in canonical bytes; returns whether the file changed."""
        data = {"derived": self.asked, "sources": digest_of(self.asked)}
        return write_file(self.path, canonical(data))

    def otherwise(self) -> str:
        """The first name whose value in the file differs from the one in `asked`; empty where the
        file is as `write` would write it.
        """
        data = {"derived": self.asked, "sources": digest_of(self.asked)}
        if self.path.is_file() and self.path.read_bytes() == canonical(data):
            return ""
        held = self._read()
        differs = (
            one for one in sorted({*held, *self.asked}) if held.get(one) != self.asked.get(one)
        )
        return next(differs, "its digest of the sources")


@cache
def kept() -> Kept:
    """The stored results for the paper."""
    return Kept()


def derive_again() -> None:
    """Makes every value be derived from now on, even if it is stored."""
    kept().held = {}


def derived_by(kind: type[Kind], function: str, *arguments: Hashable) -> Kind:
    """The value of a function, as by `Kept.value`; raises ClaimError where it has another type.

    >>> str(derived_by(Formula, "juggleproof.proofs.deriving.margin", "normal_margin"))
    'x < w'
    """
    value = kept().value(function, *arguments)
    if not isinstance(value, kind):
        raise ClaimError(f"{function}{arguments} comes to {type(value).__name__}")
    return value


def digest_of(names: Iterable[str]) -> str:
    """A digest of the sources that derive values: the encoder, the modules of the named
    functions, and all of the package that derives the paper's expressions.
    """
    modules = {name.partition("(")[0].rpartition(".")[0] for name in names} | {ENCODER}
    patterns = [
        (DERIVATIONS, "*.py"),
        *((package, f"{name}.py") for package, _, name in (m.rpartition(".") for m in modules)),
    ]
    paths = dict[str, Path]()
    for package, pattern in patterns:
        paths |= {f"{package}/{path.name}": path for path in folder_of(package).glob(pattern)}
    digest = hashlib.sha256()
    for name in sorted(paths):
        content = paths[name].read_bytes()
        digest.update(f"{name} {len(content)}\n".encode())
        digest.update(content)
    return digest.hexdigest()


def packed(value: Value) -> Plain:
    """The value as plain data: a name, a number, or a list of its kind and its parts.

    >>> packed(Vector((real("x") / 2, term(Fraction(1, 3)))))
    ['column', ['/', 'x', '2'], '1/3']
    """
    if isinstance(value, str):
        return ["text", value]
    if isinstance(value, (Term, Formula)):
        return _packed(value)
    if isinstance(value, Vector):
        return ["column", *(_packed(term(one)) for one in value.entries)]
    if isinstance(value, Matrix):
        return ["matrix", *(["row", *(_packed(term(one)) for one in row)] for row in value.rows)]
    return ["parts", *map(packed, value)]


def _packed(part: Argument) -> Plain:
    if isinstance(part, Expression) and part.op not in ("var", "num"):
        return [part.op, *map(_packed, part.args)]
    if isinstance(part, Expression):
        return str(part.args[0])
    return part if isinstance(part, int) else str(part)


def unpacked(plain: Plain) -> Value:
    """The value of such plain data.

    >>> str(unpacked(["<", ["^", "x", 2], "1/3"]))
    'x^2 < 1/3'
    """
    if isinstance(plain, list) and plain[0] in UNPACKED:
        return UNPACKED[str(plain[0])](plain[1:])
    return _expression(plain)


def _expression(plain: Plain) -> Term | Formula:
    if isinstance(plain, str):
        return term(Fraction(plain)) if plain.lstrip("-")[0].isdigit() else real(plain)
    if isinstance(plain, int):
        raise ClaimError(f"{plain} stands where a term is expected")
    op, *parts = plain
    if op == "^":
        base, exponent = parts
        return Term("^", _expression(base), int(str(exponent)))
    kind = Formula if op in RELATIONS or op in JOINED else Term
    return kind(str(op), *map(_expression, parts))


def _terms(plain: list[Plain]) -> tuple[Term, ...]:
    return tuple(one for one in map(_expression, plain) if isinstance(one, Term))


UNPACKED: Mapping[str, Callable[[list[Plain]], Value]] = {
    "text": lambda parts: str(parts[0]),
    "column": lambda parts: Vector(_terms(parts)),
    "matrix": lambda parts: Matrix(
        tuple(_terms(row[1:]) for row in parts if isinstance(row, list))
    ),
    "parts": lambda parts: tuple(map(unpacked, parts)),
}
