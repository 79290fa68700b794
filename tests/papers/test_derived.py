"""What is kept of derivations is what the sources derive, and is not read where they have changed;
claims are stated from it without SymPy.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.folders import folder_of
from juggleproof.papers import derived
from juggleproof.papers.derived import Kept, digest_of, packed, unpacked
from juggleproof.proofs import deriving
from juggleproof.reading.values import Matrix, Vector
from juggleproof.statements.language import ClaimError, Term, real, term

STATED = """import sys
from juggleproof.judging.claims import stated_texts
from juggleproof.papers.paper import opened
print(sum(len(stated_texts(claim)) for claim in opened().claims()), "sympy" in sys.modules)
"""
NAME = "juggleproof.proofs.deriving.value('E_max')"

terms = st.recursive(
    st.one_of(st.sampled_from(["x", "w", "alpha"]).map(real), st.fractions().map(term)),
    lambda inner: st.one_of(
        st.tuples(inner, inner).map(lambda two: two[0] + two[1]),
        st.tuples(inner, inner).map(lambda two: two[0] - two[1]),
        st.tuples(inner, inner).map(lambda two: two[0] * two[1]),
        st.tuples(inner, inner).map(lambda two: two[0] / (two[1] ** 2 + 1)),
        st.tuples(inner, st.integers(2, 9)).map(lambda two: two[0] ** two[1]),
        inner.map(lambda one: -one),
    ),
)


@given(terms, terms)
def test_what_is_kept_is_read_as_it_was_holds(left: Term, right: Term) -> None:
    formula = (left < right) & ~(left >= right) | (right >= left)
    values = (left, formula, Vector((left, right)), Matrix(((left, right), (right, left))), "1/3")
    assert unpacked(json.loads(json.dumps(packed(values)))) == values


@pytest.mark.exhaust
def test_claims_are_stated_without_sympy_holds() -> None:
    done = subprocess.run(
        [sys.executable, "-c", STATED], capture_output=True, text=True, check=True
    )
    count, loaded = done.stdout.split()
    assert int(count) > 800 and loaded == "False"


def kept_in(folder: Path) -> tuple[Path, dict[str, object]]:
    """A copy of what is kept, and what it holds."""
    path = folder / "derived.json"
    shutil.copy(derived.PATH, path)
    return path, json.loads(path.read_text())


def test_a_kept_value_is_taken_while_its_sources_are_the_same_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, data = kept_in(tmp_path)
    held = data["derived"]
    assert isinstance(held, dict) and data["sources"] == digest_of(held)
    path.write_text(json.dumps({**data, "derived": {**held, NAME: "x"}}))
    assert Kept(path).value("juggleproof.proofs.deriving.value", "E_max") == real("x")
    monkeypatch.setattr(derived, "digest_of", lambda names: "of other sources")
    plain = Kept(path).value("juggleproof.proofs.deriving.value", "E_max")
    assert str(plain) == "r^2*(alpha + 1)^2/(2*(alpha - 1)^2)"


@pytest.mark.parametrize("place", ["symbolic/maps.py", "encoding.py", "proofs/deriving.py"])
def test_a_change_of_a_source_changes_the_digest_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    def copied(package: str) -> Path:
        inner = tmp_path / package.partition(".")[2]
        if not any(inner.glob("*.py")):
            shutil.copytree(folder_of(package), inner, dirs_exist_ok=True)
        return inner

    before = digest_of([NAME])
    monkeypatch.setattr(derived, "folder_of", copied)
    assert digest_of([NAME]) == before
    (tmp_path / place).write_text((tmp_path / place).read_text() + "\n")
    assert digest_of([NAME]) != before


def test_rejects_a_kept_value_that_is_not_derived(tmp_path: Path) -> None:
    """As `certify --rederive` says it."""
    path, data = kept_in(tmp_path)
    held = data["derived"]
    assert isinstance(held, dict)
    again = Kept(path)
    again.asked = dict(held)
    assert again.otherwise() == ""
    path.write_text(json.dumps({**data, "derived": {**held, NAME: "x"}}))
    assert again.otherwise() == NAME
    del again.asked[NAME]
    assert again.otherwise() == NAME


def test_a_value_is_derived_once_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = list[str]()
    monkeypatch.setattr(deriving, "value", lambda name: calls.append(name) or real(name))
    anew = Kept(Path("none.json"))
    found = [anew.value("juggleproof.proofs.deriving.value", "x") for _ in range(2)]
    assert found == [real("x")] * 2 and calls == ["x"]


def test_rejects_a_value_of_another_kind() -> None:
    with pytest.raises(ClaimError, match="comes to Term"):
        derived.derived_by(Vector, "juggleproof.proofs.deriving.value", "E_max")
