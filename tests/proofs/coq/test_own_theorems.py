"""Theorems on the orbits of one's own maps, and statements of one's own stores, as files that coqc
accepts by themselves; what is forged or changed it refuses.  `make test` reads what they say,
and compiles the statements; `make exhaust` compiles a theorem of each kind and tries a share of its
changes, and with JUGGLEPROOF_MUTANTS=many all theorems and a larger share.
"""

from __future__ import annotations

import copy
import hashlib
import re
import shutil
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.command.main import run
from juggleproof.command.show import export_coq
from juggleproof.coq_orbits import rules as coq_rules
from juggleproof.coq_orbits.rules import theorem, theorems_in
from juggleproof.coq_store import PRELUDE, NotWritten
from juggleproof.judging.run import by_id, claims_of_file, judge_some
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import DEFAULT, Store
from tests.docs.pages import ROOT, blocks, code
from tests.proofs.coq.development import REALS, Answer, Coq, axioms, compiled
from tests.proofs.coq.maps import WORDS
from tests.rows import each_row
from tests.share import MANY, share

SHARE = share(4, 2)
MAPS = Path(__file__).with_name("maps.py")
SHARP, PLANE, SHIFTED, GROWN = "scaled/exactly", "mixed/all", "shifted/all", "grown/exactly"
TURNED, LARGE, CYCLE = "turned/exactly", "falling/all", "cycle/away"
INPUT, EITHER = "pushed/all", "switched/all"
COUNTED, WALKED, DRAWN, NAMED = "counted/exactly", "walked/all", "drawn/all", "named/all"
PARTED, NEARER, RETURNED = "parted/ends", "nearer/ends", "returned/orbits"
ALONE = SHARP  # compiled as it is written


def settles(point: str, of: str = "a", what: str = "", words: str = "Map.space {} Map.f") -> str:
    """That a point is stable and attracts every state, as it is stated."""
    system = " ".join(f"({word} {of})" for word in words.split(" {} "))
    both = [f"States.{what}{word} {system} ({point} {of})" for word in ("stable", "attracting")]
    return " /\\ ".join(both)


def all_settle(point: str) -> str:
    """The same of the executions of a relation."""
    return settles(point, "a", "executions_", "Relation.space {} Relation.next")


QUANTIFIED = {COUNTED: "n : Z", NAMED: f"{WORDS} : R"}
CONCLUSIONS = {
    SHARP: f"Map.domain a -> (Descent.domain a <-> {settles('Contraction.point')}).",
    PLANE: f"Descent.domain a -> {settles('Contraction.point')} /\\",
    SHIFTED: f"Descent.domain a -> {settles('LyapunovFunction.point')}.",
    GROWN: f"Map.domain a -> (Descent.domain a <-> {settles('LyapunovFunction.point')}).",
    TURNED: f"Map.domain a -> (Descent.domain a <-> {settles('LyapunovFunction.point')}).",
    LARGE: f"Descent.domain a -> {settles('Inner.Contraction.point')}.",
    CYCLE: "Escape.domain a -> Map.space a (Escape.start a) /\\"
    " Rules.iterate (Map.f a) 2 (Escape.start a) = Escape.start a /\\ Escape.start a <>"
    " Escape.point a /\\ ~ States.attracting (Map.space a) (Map.f a) (Escape.point a).",
    INPUT: f"Descent.domain a -> {all_settle('Inner.Contraction.point')}.",
    EITHER: f"Descent.domain a -> {all_settle('LyapunovFunction.point')}.",
    COUNTED: f"Map.domain n -> (Descent.domain n <-> {settles('Contraction.point', 'n')}).",
    WALKED: f"Descent.domain a -> {settles('Inner.Contraction.point')}.",
    DRAWN: f"Descent.domain a -> {all_settle('Inner.Contraction.point')}.",
    PARTED: "Descent.domain a -> (States.stable (Map.space a) (Map.f a) (End_1.Contraction.point a)"
    " /\\ States.stable (Map.space a) (Map.f a) (End_2.Contraction.point a)) /\\ forall of_s,"
    " Map.space a of_s -> exists of_e, In of_e (Settling.points a) /\\ Rules.converges (Map.f a)"
    " States.coordinate (fun of_j => States.coordinate of_j of_e) of_s.",
    NEARER: "Descent.domain a -> (States.stable (Map.space a) (Map.f a) (End_1.Contraction.point a)"
    ") /\\ forall of_s, Map.space a of_s -> exists of_e, In of_e (Settling.points a) /\\"
    " Rules.converges (Map.f a) States.coordinate (fun of_j => States.coordinate of_j of_e) of_s.",
    RETURNED: "Inner.Descent.domain a -> ((Rules.iterate (Map.f a) 2 (Inner.End_1.Contraction.point"
    " a) = Inner.End_1.Contraction.point a /\\ Returns.orbit_stable States.coordinate (Map.f a)"
    " (Map.space a) (Inner.End_1.Contraction.point a))) /\\ forall of_s, Map.space a of_s -> exists"
    " of_e, In of_e (Inner.Settling.points a) /\\ Returns.joins States.coordinate (Map.f a) of_e"
    " of_s.",
    NAMED: f"Descent.domain {WORDS} -> {settles('Contraction.point', WORDS)} /\\",
}
# A contraction, a Lyapunov function, one of instability, an escape, the orbits of a relation, those
# that repeat a word while a rank falls, and those of a map by one that makes two steps at once.
COMPILED = [*CONCLUSIONS] if MANY else [SHARP, SHIFTED, TURNED, CYCLE, INPUT, NEARER, RETURNED]


def share(changes: list[tuple[str, ...]]) -> list[tuple[str, ...]]:
    """The changes that are tried: of theorems that are accepted as they are."""
    return [change for change in changes if change[0] in COMPILED][::SHARE]


@cache
def searched() -> tuple[TemporaryDirectory[str], Path]:
    """A folder, which ends with the process, and in it the maps with their store."""
    folder = TemporaryDirectory()
    path = Path(shutil.copy(MAPS, folder.name))
    assert run(["certify", str(path), "--routes", "exact", "--jobs", "1"]) == 0
    return folder, path


@cache
def judged() -> tuple[dict[str, str], dict[str, Any]]:
    """The texts of the statements of the maps, and their certificates."""
    path = searched()[1]
    claims = claims_of_file(path)
    judgements = judge_some(claims, by_id(claims), path.with_suffix(".certificates"))
    assert {word for one in judgements for word in one.outcomes.values()} == {"certified"}
    texts = {name: text for one in judgements for name, text in one.statements}
    return texts, {name: entry for one in judgements for name, entry in one.certificates.items()}


def written(name: str, texts: dict[str, str], certificates: dict[str, Any]) -> str:
    return theorem(name, checker.read_statements("\n\n".join(texts.values())), certificates)


OPENED = "From Coq Require Import Reals ZArith Lra Lia List.\n{}Open Scope R_scope.\n"
THEORY = "\nModule States.\n"  # what is before it says nothing of the map


def alone(folder: Path, text: str) -> Answer:
    """What coqc says of a file in a folder of its own."""
    done = compiled(folder, "Own.v", text)
    return Answer(done.returncode == 0, done.stdout + done.stderr)


def taken(coq: Coq, text: str) -> Answer:
    """What Coq says of a file, of whose theory it is told once what many files share."""
    theory, begins, own = text.partition(THEORY)
    assert begins
    parts = re.split(r"^(?=Module )", theory[theory.index("Open Scope") :], flags=re.MULTILINE)
    imports = ""
    for count, part in enumerate(parts):
        digest = hashlib.sha256("".join(parts[: count + 1]).encode()).hexdigest()
        name = f"Theory_{digest[:12]}"
        if name not in coq.told:
            assert coq.tell(name, OPENED.format(imports) + part).accepted
        imports += f"Import {name}.\n"
    return coq.ask(OPENED.format(imports) + begins + own)


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with a file for each theorem of the maps."""
    folder = tmp_path_factory.mktemp("theorems")
    assert run(["export", "coq", str(searched()[1]), "-o", str(folder)]) == 0
    return folder


def test_export_writes_a_file_for_each_theorem_holds(files: Path) -> None:
    names = {f"S_{one.replace('/', '_')}.v" for one in CONCLUSIONS}
    assert {path.name for path in files.iterdir()} == names
    assert (files / "S_mixed_all.v").read_text() == written(PLANE, *judged())


@pytest.fixture(scope="module")
def answers(files: Path, coq: Coq) -> dict[str, Answer]:
    """What Coq says of each file but the one alone, and of the axioms of all that it is told."""
    said, asked = {}, []
    for name in (one for one in COMPILED if one != ALONE):
        text = (files / f"S_{name.replace('/', '_')}.v").read_text()
        own, last, end = text.rpartition(f"Print Assumptions {coq_rules.theorem_name(name)}.")
        assert last and end.strip() == ""
        said[name] = taken(coq, own)
        asked.append(f"@Question_{coq.asked}.{coq_rules.theorem_name(name)}")
    text = f"Definition all_theorems := ({', '.join(asked)}).\nPrint Assumptions all_theorems.\n"
    return {**said, "all": coq.ask(text)}


@pytest.mark.parametrize("name", CONCLUSIONS)
def test_a_theorem_says_what_is_proved_and_admits_nothing_holds(name: str, files: Path) -> None:
    text = (files / f"S_{name.replace('/', '_')}.v").read_text()
    says = " ".join(text.split(f"Theorem {coq_rules.theorem_name(name)} :")[1].split())
    if name == NAMED:
        says = says.replace("'", "")
    assert says.startswith(f"forall {QUANTIFIED.get(name, 'a : R')}, {CONCLUSIONS[name]}")
    assert not re.search(r"\b(Admitted|admit|Axiom|Parameter|Conjecture)\b(?!')", text)


@pytest.mark.exhaust
def test_coqc_accepts_a_theorem_as_it_is_written_holds(files: Path, tmp_path: Path) -> None:
    answer = alone(tmp_path, (files / f"S_{ALONE.replace('/', '_')}.v").read_text())
    assert answer.accepted and answer.output.startswith("Axioms:\n"), answer.output
    assert axioms(answer) <= REALS


@pytest.mark.exhaust
@pytest.mark.parametrize("name", [one for one in COMPILED if one != ALONE])
def test_coqc_accepts_a_theorem_holds(name: str, answers: dict[str, Answer]) -> None:
    assert answers[name].accepted, answers[name].output
    head, _, _ = answers[name].output.partition("Axioms:\n")
    assert head.strip() == ""


@pytest.mark.exhaust
def test_the_theorems_rest_on_the_axioms_of_the_reals_alone_holds(
    answers: dict[str, Answer],
) -> None:
    assert [name for name in answers if "Axioms:" in answers[name].output] == ["all"]
    assert axioms(answers["all"]) <= REALS


@pytest.mark.skipif(not MANY, reason="takes minutes of coqc; make exhaust runs it")
@pytest.mark.parametrize("name", ["restitution-to-a-half/returns", "restitution-half/returns"])
def test_coqc_accepts_that_all_orbits_up_to_a_half_tend_to_one_of_two_holds(
    name: str, tmp_path: Path
) -> None:
    """Of the ball's map itself, on all of x >= 0, but for four states at 1/2."""
    store, claim_id = Store(DEFAULT), name.partition("/")[0]
    texts = {one: text for one, text in store.texts.items() if one.startswith(f"{claim_id}/")}
    answer = alone(
        tmp_path, written(name, texts, {one: store.certificate(one, texts[one]) for one in texts})
    )
    assert answer.accepted, answer.output
    assert axioms(answer) <= REALS


def forged(own: str, premise: str, other: str) -> dict[str, Any]:
    """The certificates, with that of another premise in place of one."""
    certificates = copy.deepcopy(judged()[1])
    proofs = certificates[own]["certified"]
    assert proofs[premise] != proofs[other]
    proofs[premise] = proofs[other]
    return certificates


@pytest.mark.exhaust
@pytest.mark.parametrize(
    "name, own, premise, other",
    share(
        [
            (SHARP, "scaled/near", "closer-1", "stays-1"),
            (SHARP, "scaled/map", "stays-1", "covers"),
            (PLANE, "mixed/down", "stage-1-1", "falls-1"),
            (SHIFTED, "shifted/near", "falls-1-1", "falls-2-2"),
            (GROWN, "grown/away", "grows-1-1", "grows-1-2"),
            (EITHER, "switched/near", "falls-1-2", "falls-2-1"),
            (TURNED, "turned/swings", "bounded-1", "grows-1-1"),
        ]
    ),
)
def test_rejects_a_forged_certificate(
    name: str, own: str, premise: str, other: str, coq: Coq
) -> None:
    assert taken(coq, written(name, judged()[0], forged(own, premise, other))).rejected


@pytest.mark.exhaust
@pytest.mark.parametrize(
    "name, old, new",
    share(
        [
            (SHARP, "State :=\n  a * x.", "State :=\n  a * x / 2."),
            (
                SHARP,
                "domain (a : R) : Prop :=\n  0 < a /\\ a < 1.",
                "domain (a : R) : Prop := 0 < a.",
            ),
            (SHARP, "then image_1 a of_s\n  else of_s", "then of_s\n  else image_1 a of_s"),
            (PLANE, "(x / 4, (x + y) / 4)", "(x / 4, (x - y) / 4)"),
            (CYCLE, "(a + 1 - u) / (2 * a)", "(a + 1 + u) / (3 * a)"),
            (
                NEARER,
                "rank_1 (a : R) (x : State) : R :=\n  x.",
                "rank_1 (a x : R) : R :=\n  x / 2.",
            ),
            (NEARER, "(1 :: nil)%nat 0%nat 0%nat 1%nat", "(1 :: nil)%nat 0%nat 0%nat 0%nat"),
            (RETURNED, "9 + 10 / x", "9 + 9 / x"),
            (RETURNED, "1%nat => (1 :: 2 :: nil)%nat", "1%nat => (1 :: nil)%nat"),
            (INPUT, "- a <= u /\\ u <= a /\\ x < 1.", "u <= a /\\ x < 1."),
            (COUNTED, "let n := IZR n in n > 0 /\\ n > 1.", "let n := IZR n in n > 0."),
            (COUNTED, "(x / n, x ^ 2 - x)", "(x, x ^ 2 - x)"),
            (WALKED, "Descent.rank_1_1 a of_s + INR 0 <= INR of_n ->\n  ", ""),
        ]
    ),
)
def test_rejects_a_changed_map(name: str, old: str, new: str, coq: Coq) -> None:
    text = written(name, *judged())
    assert old in text
    assert taken(coq, text.replace(old, new)).rejected


def test_rejects_a_certificate_of_another_shape() -> None:
    with pytest.raises(NotWritten, match="a part of its certificate is not understood"):
        written(PLANE, judged()[0], forged("mixed/down", "falls-1", "bounded"))


@pytest.mark.exhaust
def test_rejects_another_map_with_the_certificates_of_one(coq: Coq) -> None:
    texts = {**judged()[0]}
    texts["scaled/map"] = texts["scaled/map"].replace("a*x", "a*x^2 + a*x/8")
    assert taken(coq, written(SHARP, texts, judged()[1])).rejected


def test_rests_on_decides_what_is_a_theorem_holds() -> None:
    texts = judged()[0]
    assert theorems_in(checker.read_statements("\n\n".join(texts.values()))) == [*CONCLUSIONS]
    del texts[SHARP]
    assert theorems_in(checker.read_statements("\n\n".join(texts.values()))) == [
        "scaled/all",
        "scaled/away",
        *[*CONCLUSIONS][1:],
    ]


def first_two() -> str:
    """The maps that come first."""
    text = MAPS.read_text()
    return text[: text.index('@claim("shifted")')] + text[text.index("def norm(") :]


def test_rejects_what_cannot_be_written_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own = tmp_path / "own.py"
    own.write_text(first_two().replace('rate="1/2", radius="u"', 'rate="1/9", radius="u"'))
    assert run(["export", "coq", str(own), "-o", str(tmp_path / "coq")]) == 1
    assert [path.name for path in (tmp_path / "coq").iterdir()] == ["S_scaled_exactly.v"]
    assert capsys.readouterr().err == (
        f"juggleproof: {own}: mixed/all: it is unknown; `juggleproof certify {own}` says why\n"
    )


INEQUALITY = """
from juggleproof import always, claim, real

@claim("square")
def squares_are_not_negative():
    '''No square is negative.'''
    return always(real("x")**2 >= 0)
"""


SCRIPT = """
(declare-const x Real)
(declare-const y Real)
(assert (= (* x x x) 2))
(check-sat)
(push)(assert (< (+ (* x x) (* y y)) (* 2 x y)))(check-sat)(pop)
(check-sat-assuming ((> (* 2 x y) 1)))
"""
COMMAND = ["bound", "x^2*y - x*y^2 + x/10", "--box", "x=0..1,y=-1/2..3", "--width", "1e-3"]


def test_every_store_is_written_with_its_box_trees_and_compiles_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own, script, bound = tmp_path / "own.py", tmp_path / "mean.smt2", tmp_path / "bound"
    own.write_text(INEQUALITY)
    script.write_text(SCRIPT)
    assert run([*COMMAND, "-o", str(bound)]) == 0
    assert '["boxes",' in (bound / checker.CERTIFICATES).read_text()
    texts, _ = list[str](), capsys.readouterr()
    for name in (own, script, script.with_suffix(".certificates"), bound):
        assert export_coq([str(name)], None) == 0
        output = capsys.readouterr()
        assert "not written" not in output.err
        texts.append(output.out)
    of_claim, of_script, of_folder, of_bound = texts
    assert of_script == of_folder and of_script.count("\nLemma statement_") == 4
    whole = PRELUDE + "".join(
        text.removeprefix(PRELUDE) for text in (of_claim, of_folder, of_bound)
    )
    done = compiled(tmp_path, "All.v", whole)
    assert done.returncode == 0, done.stderr


def test_rejects_a_folder_without_statements(tmp_path: Path) -> None:
    with pytest.raises(ClaimError, match="no statements; name a folder that `juggleproof` wrote"):
        export_coq([str(tmp_path / "none.certificates")], None)


def test_rejects_several_theorems_without_a_folder(tmp_path: Path) -> None:
    own = tmp_path / "own.py"
    own.write_text(first_two())
    with pytest.raises(ClaimError, match="several theorems, scaled/exactly, mixed/all; give -o"):
        export_coq([str(own)], None)


@each_row(
    "names, says",
    [
        ([str(MAPS), "eq-37"], "files and claims of the paper together"),
        (["none.py"], "none.py: no such file"),
        (["none.smt2"], "none.smt2: no such file"),
        (["a.smt2", "b.smt2"], "b.smt2: a second store; export them one after the other"),
    ],
)
def test_rejects_what_is_no_question(names: list[str], says: str) -> None:
    with pytest.raises(ClaimError, match=re.escape(says)):
        export_coq(names, None)


def test_the_theorem_that_the_page_shows_is_written_holds(tmp_path: Path) -> None:
    page = ROOT / "docs/your-own.md"
    (source,) = (block.text for block in blocks(page) if block.title == "map.py")
    (tmp_path / "map.py").write_text(source)
    assert run(["export", "coq", str(tmp_path / "map.py"), "-o", str(tmp_path)]) == 0
    (shown,) = code(page, "coq")
    assert shown in (tmp_path / "S_halving_near.v").read_text()
