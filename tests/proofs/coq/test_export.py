"""Stored statements as Coq lemmas: each class compiles, what is forged does not, and what is not
written is counted.  `make test` writes a fixed share of the store and tries one of the forgeries;
with JUGGLEPROOF_MUTANTS=many (make exhaust) all.
"""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.command.main import run
from juggleproof.coq_store import PRELUDE, NotWritten, export, lemmas, share_of, write
from juggleproof.coq_store.files import CLASSES, HEADER
from juggleproof.judging.bounds import LOWER, enclose_minimum
from juggleproof.statements.store import Store
from tests.proofs.coq.development import Answer, Coq, compiled, coqc
from tests.share import share
from tests.stored import STORE, statements

SHARE, OF_STORE = share((3, 8), (1, 1))
OPENED = HEADER.replace("From Store ", "From Juggleproof ")


def certificate(name: str) -> Any:
    return STORE.certificate(name, STORE.texts[name])


def kinds(node: Any) -> set[str]:
    """The rules of a certificate, and `adjoined` where it adjoins a number."""
    if isinstance(node, dict):
        return set().union(*map(kinds, node.values()))
    if not isinstance(node, (list, tuple)):
        return set()
    own = {part for part in node[:1] if isinstance(part, str)}
    if len(node) == 6 and all(isinstance(part, str) for part in node[:4]):
        own.add("adjoined")
    return own.union(*map(kinds, node))


def class_of(name: str) -> str:
    """The class of a statement of the store, by its kind and outcome alone."""
    statement = statements()[name]
    if "refuted" in certificate(name):
        return "refuted"
    if statement.kind == "universal":
        return "exists" if statement.get("exists") else "universal"
    return "sharp" if statement.kind == "sharp" else "orbit"


def smallest(kind: str, rule: str = "", line: str = "") -> str:
    """The statement with the shortest text and certificate of a class whose certificate uses the
    rule and whose text has such a line.
    """
    fitting = [
        name
        for name, statement in statements().items()
        if class_of(name) == (kind if kind in CLASSES else "orbit")
        and (kind in CLASSES or statement.kind == kind)
        and (not rule or rule in kinds(certificate(name)))
        and (not line or statement.get(line))
    ]
    return min(
        fitting,
        key=lambda name: (len(STORE.texts[name] + json.dumps(certificate(name))), name),
    )


CASES = [
    *(("universal", rule, "") for rule in ("psatz", "cases", "sign", "close", "integral")),
    *(("universal", rule, "") for rule in ("boxes", "use", "adjoined")),
    *(("universal", "", line) for line in ("have", "root", "integer")),
    *(("exists", rule, "") for rule in ("", "sign", "empty")),
    ("refuted", "", ""),
    ("refuted", "", "exists"),
    ("refuted", "", "integer"),
    ("sharp", "", ""),
    ("sharp", "adjoined", ""),
    ("sharp", "", "number"),
    *((kind, "", "") for kind in ("iterates", "map", "descends", "contracts", "attracts")),
    *((kind, "", "") for kind in ("escapes", "exactly")),
]


@pytest.mark.exhaust
def test_every_statement_of_the_store_is_written_holds() -> None:
    wanted = share_of(statements(), OF_STORE)
    exported = export(STORE, wanted)
    names = list(exported.texts)
    assert exported.reasons == {} and set(wanted) <= set(names)
    assert names == list(statements()) or OF_STORE > 1
    classes = [class_of(name) for name in names]
    sizes = {kind: classes.count(key) for key, kind in CLASSES.items()}
    assert all(sizes.values()) and exported.table() == [
        *(f"{n:4} of {n:4}  {kind}" for kind, n in sizes.items()),
        f"{len(names):4} of {len(names):4}  statements are written for Coq",
    ]
    heads = re.findall(r"^Lemma (\w+)", "\n".join(exported.texts.values()), re.MULTILINE)
    assert len(heads) == len(set(heads)) > len(names)


@pytest.mark.exhaust
def test_a_store_with_one_statement_of_each_class_compiles(tmp_path: Path, prelude: Coq) -> None:
    small = export(STORE, {smallest(*case) for case in CASES})
    write(small, tmp_path, files=1)
    assert small.reasons == {} and set(small.classes.values()) == set(CLASSES.values())
    assert {path.name for path in tmp_path.iterdir()} == {"Prelude.v", "Part01.v"}
    assert (tmp_path / "Prelude.v").read_text() == PRELUDE
    text = (tmp_path / "Part01.v").read_text()
    assert text.startswith(HEADER)
    answer = coq_of(prelude, text.removeprefix(HEADER))
    assert answer.accepted, answer.output


def coq_of(prelude: Coq, text: str) -> Answer:
    """What Coq says of lemmas."""
    return prelude.ask(f"{OPENED}\n{text}")


def written(name: str, changed: Any = None) -> str:
    """The lemmas of a stored statement, of another certificate where one is given."""
    return lemmas(statements()[name], changed or certificate(name), statements())


BOUNDS = [("x^2 - x", {"x": (0, 1)}), ("(x*y - 1/3)^2 + x", {"x": (-1, 1), "y": (0, 2)})]


def bounded(polynomial: str, box: Any) -> tuple[checker.Statement, Any]:
    """A statement with a box tree, and its certificate."""
    found = enclose_minimum(polynomial, box, Fraction(1, 10))
    statement = checker.read_statements(found.statements)[LOWER]
    return statement, json.loads(json.dumps(found.certificates[LOWER]))


@pytest.mark.exhaust
@pytest.mark.parametrize("polynomial, box", BOUNDS)
def test_a_box_tree_compiles(polynomial: str, box: Any, prelude: Coq) -> None:
    statement, entry = bounded(polynomial, box)
    assert {"a", "A", "."} <= set(entry["certified"][2][3])
    answer = coq_of(prelude, lemmas(statement, entry, {}))
    assert answer.accepted, answer.output


@pytest.mark.parametrize("tree", [".", "A.", "aA..", "b.."])
def test_rejects_a_wrong_box_tree(tree: str, prelude: Coq) -> None:
    statement, entry = bounded(*BOUNDS[1])
    entry["certified"][2][3] = tree
    assert checker.check_one(statement, entry, {}, {})[0] == "rejected"
    assert coq_of(prelude, lemmas(statement, entry, {})).rejected


USES = """
statement t/inverse
forall x
given x > 0
exists y
show x*y = 1

statement t/sign
forall x z
given x > 0
given x*z = 1
show z > 0

statement t/next
forall n
integer n m
exists m
show m = n + 1

statement t/least
forall n
integer n
given n > 0
show n >= 1
"""


def product(*facts: int) -> Any:
    return ["1", [[fact, 1] for fact in facts], "1"]


def used() -> dict[str, Any]:
    """Certificates that name what an earlier statement says to exist, also an integer."""
    inverse: Any = ["t/inverse", [], {"y": "1/x"}, ["close"]]
    fails = ["psatz", [product(0), product(3)], []]
    holds = ["psatz", [product(0, 2), product()], [[1, "1"]]]
    sign = ["use", "t/inverse", {"x": "x"}, {"y": "y"}, ["cases", 0, [fails, holds]]]
    below = ["psatz", [product(3), product(0)], [[2, "1"]]]
    equal = ["psatz", [product(0)], [[2, "1"], [3, "-1"]]]
    above = ["integral", 3, ["psatz", [product(4), product(1)], [[2, "-1"]]]]
    least = ["use", "t/next", {"n": "n"}, {"m": "m"}, ["sign", "m - 1", below, equal, above]]
    proofs: Any = {
        "t/inverse": (["witness", [], inverse], {"x": "1"}),
        "t/sign": (["proof", [], sign], {"x": "1", "z": "1"}),
        "t/next": (["witness", [], ["t/next", [], {"m": "n + 1"}, ["close"]]], {"n": "0"}),
        "t/least": (["proof", [], least], {"n": "1"}),
    }
    return {
        name: {"certified": proof, "point": [name, [], point, ["close"]]}
        for name, (proof, point) in proofs.items()
    }


def test_an_earlier_statement_with_exists_is_used_in_coq(prelude: Coq) -> None:
    statements = checker.read_statements(USES)
    for name, entry in used().items():
        assert checker.check_one(statements[name], entry, statements, statements) == (
            "certified",
            None,
        )
    texts = [lemmas(statements[name], entry, statements) for name, entry in used().items()]
    answer = coq_of(prelude, "\n".join(texts))
    assert answer.accepted, answer.output
    alone = coq_of(prelude, "\n".join(texts[:-2] + texts[-1:]))
    assert alone.rejected and "statement_t_next" in alone.output


LONG = """
statement t/squares
forall x y
show 10^70*x^2 - x*y + y^2 >= 0
"""


@pytest.mark.parametrize("share, holds", [(4, True), (3, False)])
def test_squares_with_long_weights_are_added_one_by_one_in_coq(
    share: int, holds: bool, prelude: Coq
) -> None:
    (statement,) = checker.read_statements(LONG).values()
    squares = [["1", [], "y - x/2"], [f"{4 * 10**70 - 1}/{share}", [], "x"]]
    entry: Any = {
        "certified": ["proof", [], ["psatz", [product(0), *squares], []]],
        "point": ["t/squares", [], {"x": "0", "y": "0"}, ["close"]],
    }
    assert (checker.check_one(statement, entry, {}, {})[0] == "certified") is holds
    text = lemmas(statement, entry, {})
    assert "sum_not_negative" in text and hex(10**70) in text
    answer = coq_of(prelude, text)
    assert answer.accepted is holds and answer.rejected is not holds


def with_value(part: Any, name: str, value: str) -> Any:
    """Values found, with another one for a variable."""
    part[2][name] = value
    return part


def in_refutation(entry: Any) -> None:
    with_value(entry["refuted"], "z2", "1")


def in_point(entry: Any) -> None:
    with_value(entry["point"], "r", "-1")


def in_witness(entry: Any) -> None:
    with_value(entry["certified"][2], "S0", "-1/2")


def in_sharp_range(entry: Any) -> None:
    with_value(entry["certified"][1], "z2", "1")


def in_sharp_point(entry: Any) -> None:
    with_value(entry["certified"][2]["s4.3.1-DK-negative/main"], "alpha", "2")


def in_exponent(entry: Any) -> None:
    entry["certified"][2][2][1][1][0][0] = 5


FORGED: list[tuple[str, Callable[[Any], None]]] = [
    ("s4.3.1-DK-negative/main", in_refutation),
    ("eq-7/only-these", in_point),
    ("eq-7/only-these", in_exponent),
    ("part-newton/main", in_witness),
    ("s4.3.1-DK-negative/sharp", in_sharp_range),
    ("s4.3.1-DK-negative/sharp", in_sharp_point),
]


@pytest.mark.parametrize("name, forge", FORGED[::SHARE])
def test_rejects_a_forged_certificate(
    name: str, forge: Callable[[Any], None], prelude: Coq
) -> None:
    changed = copy.deepcopy(certificate(name))
    forge(changed)
    assert changed != certificate(name)
    assert coq_of(prelude, written(name, changed)).rejected
    assert coq_of(prelude, written(name)).accepted


@pytest.mark.parametrize(
    "case, old, new",
    [
        (("universal", "integral"), r"  whole [\w']+ ->\n", ""),
        (("sharp", "", "number"), r" <-> \(forall", r" <-> (False /\\ forall"),
        (("refuted",), r"~ \(", "("),
    ],
)
def test_rejects_the_proof_of_another_statement(
    case: tuple[str, ...], old: str, new: str, prelude: Coq
) -> None:
    text = written(smallest(*case))
    changed = re.sub(old, new, text)
    assert changed != text and coq_of(prelude, changed).rejected


def test_rejects_a_root_that_is_not_the_only_one(tmp_path: Path) -> None:
    name = smallest("sharp", "", "number")
    text = STORE.texts[name]
    ((_, (poly, low, high)),) = statements()[name].get("number")
    wide = text.replace(", 0, 1)", ", -100, 100)")
    assert wide != text
    statement = checker.read_statements(f"{wide}")[name]
    with pytest.raises(NotWritten, match="no polynomial is negative on a part of a box"):
        lemmas(statement, certificate(name), statements())


def test_what_is_not_written_is_counted_by_class(tmp_path: Path) -> None:
    folder = tmp_path / "store"
    folder.mkdir()
    name = "s4.3.1-DK-negative/main"
    (folder / "statements.txt").write_text(STORE.texts[name] + "\n")
    unknown = json.dumps([name, {"unknown": "too hard"}])
    (folder / "certificates.jsonl").write_text(unknown + "\n")
    left_out = export(Store(folder))
    assert left_out.texts == {} and left_out.table()[0] == "   0 of    1  for all"
    assert left_out.table()[-1] == f"not written: {name}: it has no certificate that settles it"


def test_a_share_is_a_part_of_the_store_holds() -> None:
    names = list(STORE.texts)
    share = share_of(names, 12)
    assert len(names) / 24 < len(share) < len(names) / 6 and set(share) < set(names)
    assert share_of(reversed(names), 12) == share[::-1] and share_of(names, 1) == names


@pytest.mark.exhaust
def test_export_writes_lemmas_on_the_axioms_of_the_reals(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    coqc()
    assert run(["export", "coq", "eq-7", "s3.0-closed-form"]) == 0
    out, err = capsys.readouterr()
    assert "4 of    4  statements are written" in err and out.count("Lemma statement_") > 4
    result = compiled(
        tmp_path, "Exported.v", out + "\nPrint Assumptions statement_eq_7_only_these.\n"
    )
    assert (
        result.returncode == 0
        and "Axioms:" in result.stdout
        and "classic" not in result.stdout.replace("Classical", "")
    ), result.stderr


def test_export_writes_one_file_a_statement_holds(tmp_path: Path) -> None:
    assert run(["export", "coq", "eq-7/only-these", "-o", str(tmp_path)]) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["S_eq_7_only_these.v"]


def test_a_file_has_the_lemmas_that_its_certificate_uses(tmp_path: Path, prelude: Coq) -> None:
    name = smallest("universal", "use")
    assert run(["export", "coq", name, "-o", str(tmp_path)]) == 0
    (path,) = tmp_path.iterdir()
    assert coq_of(prelude, path.read_text().removeprefix(PRELUDE)).accepted
