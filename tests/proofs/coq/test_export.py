"""Certified statements as Coq lemmas: they compile, tampered ones do not, and what is not written
is refused by name.
"""

from __future__ import annotations

import copy
import re
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.coq import PRELUDE, lemma
from juggleproof.certificates.language import ClaimError
from juggleproof.certificates.store import DEFAULT, Store
from juggleproof.proofs.command.main import run
from tests.proofs.coq.development import compiled, coqc


@cache
def stored() -> tuple[Store, dict[str, Any]]:
    store = Store(DEFAULT)
    return store, checker.read_statements("\n\n".join(store.texts.values()))


def certificate(name: str) -> Any:
    return stored()[0].certificate(name, stored()[0].texts[name])


def kinds(node: Any) -> set[str]:
    if not isinstance(node, list):
        return set()
    return {part for part in node[:1] if isinstance(part, str)}.union(*map(kinds, node))


@cache
def written() -> dict[str, str]:
    """Every stored statement that is written for Coq."""
    lemmas = {}
    for name in stored()[0].texts:
        try:
            lemmas[name] = lemma(stored()[1][name], certificate(name))
        except ClaimError:
            continue
    return lemmas


def small(rule: str, line: str = "") -> str:
    """The shortest lemma whose certificate uses the rule and whose statement has such a line."""
    fitting = [
        name
        for name in written()
        if rule in kinds(certificate(name)["certified"])
        and (not line or stored()[1][name].get(line))
    ]
    return min(fitting, key=lambda name: (len(written()[name]), name))


def test_most_certified_statements_are_written_under_names_of_their_own_holds() -> None:
    heads = [text.splitlines()[1] for text in written().values()]
    assert len(heads) == len(set(heads)) > 300
    assert {"psatz", "cases", "sign"} <= set().union(
        *(kinds(certificate(name)["certified"]) for name in written())
    )


@pytest.mark.parametrize(
    "rule, line",
    [
        ("psatz", ""),
        ("cases", ""),
        ("sign", ""),
        ("close", ""),
        ("integral", ""),
        ("psatz", "have"),
        ("psatz", "root"),
        ("psatz", "integer"),
    ],
)
def test_a_written_lemma_compiles(rule: str, line: str, tmp_path: Path) -> None:
    coqc()
    result = compiled(tmp_path, "Exported.v", f"{PRELUDE}\n{written()[small(rule, line)]}")
    assert result.returncode == 0, result.stderr


def test_a_file_of_several_lemmas_compiles_on_the_axioms_of_the_reals(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    coqc()
    assert run(["export", "coq", "eq-7", "s3.0-closed-form"]) == 0
    out, err = capsys.readouterr()
    assert (
        out.count("Lemma statement_") == 3
        and "eq-7/strikes: only certified statements without `exists`" in err
    )
    result = compiled(
        tmp_path, "Exported.v", out + "\nPrint Assumptions statement_eq_7_only_these.\n"
    )
    assert (
        result.returncode == 0
        and "Axioms:" in result.stdout
        and "classic" not in result.stdout.replace("Classical", "")
    ), result.stderr


def test_rejects_a_lemma_whose_certificate_was_tampered_with(tmp_path: Path) -> None:
    coqc()
    name = "eq-7/only-these"
    changed = copy.deepcopy(certificate(name))
    changed["certified"][2][2][1][1][0][0] = 5
    result = compiled(tmp_path, "Exported.v", f"{PRELUDE}\n{lemma(stored()[1][name], changed)}")
    assert changed != certificate(name) and result.returncode != 0 and "ring" in result.stderr


def test_rejects_the_proof_of_another_statement(tmp_path: Path) -> None:
    coqc()
    text = written()["eq-7/only-these"]
    assert text.count("0 < - v + r)") == 1
    result = compiled(
        tmp_path, "Exported.v", f"{PRELUDE}\n{text.replace('0 < - v + r)', '0 < - v + 2 * r)')}"
    )
    assert result.returncode != 0


@pytest.mark.parametrize("name", ["eq-7/strikes", "eq-18a/floor.sharp"])
def test_rejects_kinds_that_are_not_written(name: str) -> None:
    if name not in stored()[1]:
        name = next(n for n, statement in stored()[1].items() if statement.kind == "sharp")
    with pytest.raises(ClaimError, match="are written for Coq"):
        lemma(stored()[1][name], certificate(name))


def test_rejects_a_rule_that_is_not_written_by_its_name() -> None:
    changed = copy.deepcopy(certificate("eq-7/only-these"))
    changed["certified"][2] = ["use", "eq-7/strikes", {}, {}, ["close"]]
    with pytest.raises(
        ClaimError,
        match="uses the rule use; only psatz, cases, sign, close and integral are written",
    ):
        lemma(stored()[1]["eq-7/only-these"], changed)


def test_an_integer_lemma_fails_without_its_integers(tmp_path: Path) -> None:
    coqc()
    text = written()[small("integral", "")]
    reals = re.sub(r"  whole \w+ ->\n", "", text).replace("wholly", "fail")
    assert reals != text and compiled(tmp_path, "Exported.v", f"{PRELUDE}\n{reals}").returncode != 0


def test_export_writes_one_file_a_statement_holds(tmp_path: Path) -> None:
    assert run(["export", "coq", "eq-7/only-these", "-o", str(tmp_path)]) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["S_eq_7_only_these.v"]


def test_export_of_nothing_that_is_written_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert (
        run(["export", "coq", "eq-7/strikes"]) == 2
        and "none of the statements named" in capsys.readouterr().err
    )
