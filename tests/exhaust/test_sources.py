"""What a stage depends on is found from the sources, and a change asks for the stages that it can
change and for no other.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from fnmatch import fnmatch
from pathlib import Path

import pytest

from tests.exhaust.sources import RECORD, ROOT, Sources, facts_of, without_prose
from tests.exhaust.stages import EQUIVALENT, FRESH, INDEX, REGISTER, STORE, Stages


@pytest.fixture(scope="module")
def sources() -> Sources:
    if not (ROOT / ".git").exists():
        pytest.skip("no repository")
    return Sources()


@pytest.fixture(scope="module")
def stages(sources: Sources) -> Stages:
    return Stages(sources)


@pytest.fixture(scope="module")
def copied(sources: Sources, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the files of the tree."""
    root = tmp_path_factory.mktemp("tree")
    for file in sources.files:
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(sources.root / file, root / file)
    return root


@contextmanager
def changed(copied: Path, sources: Sources, file: str, more: str) -> Iterator[Sources]:
    """The copy with this at the end of a file of it; what the other files say is known."""
    good = (copied / file).read_bytes()
    (copied / file).write_bytes(good + more.encode())
    other = Sources(copied, sources.files)
    for name, facts in sources.kept_facts.items():
        if sources.modules[name] != file:
            other.kept_facts[name] = facts
    other.kept_digests = {one: kept for one, kept in sources.kept_digests.items() if one != file}
    yield other
    (copied / file).write_bytes(good)


def asked(copied: Path, stages: Stages, file: str, more: str) -> set[str]:
    """The stages that are asked for when this is added to a file, which imports nothing new."""
    before = stages.digests()
    with changed(copied, stages.sources, file, more) as other:
        return {name for name, stage in stages.all.items() if stage.digest(other) != before[name]}


def test_a_module_leads_to_all_that_it_imports_or_names_holds() -> None:
    text = (
        '"""tests.not_this"""\nfrom __future__ import annotations\nimport a.b\n'
        "from typing import TYPE_CHECKING\nfrom ..checker import load\nif TYPE_CHECKING:\n"
        "    from c import d\nelse:\n    NAMES = {'.lazy': 'x'}\n"
        "def f():\n    from e import g\n    return f'{NAMES} juggleproof.h'\n"
    )
    facts = facts_of(text, "juggleproof.x.y.z", False)
    both = {"__future__.annotations", "typing.TYPE_CHECKING", "a.b", "juggleproof.x.checker.load"}
    assert facts.imports == both | {"c.d", "e.g"} and facts.loads == both
    assert {" juggleproof.h", ".lazy"} <= facts.words and not facts.by_name
    assert not any("not_this" in word for word in facts.words)
    assert facts_of("import pytest\n@pytest.mark.exhaust\ndef test(): ...", "t", False).marked
    assert not facts_of("import pytest\n@pytest.mark.skip\ndef test(): ...", "t", False).marked


def test_what_opens_the_paper_leads_to_all_of_it_holds(sources: Sources) -> None:
    """But what is judged of one claim does not."""
    named, _ = sources.closure(["juggleproof.papers.paper"])
    assert {"juggleproof.proofs.paper.s2_models", "juggleproof.proofs.opening"} <= named
    assert "juggleproof.papers.paper" not in sources.closure(["juggleproof.judging.run"])[0]


def test_lazy_packages_and_packages_on_the_way_are_told_apart_holds(sources: Sources) -> None:
    named, every = sources.closure(["juggleproof.symbolic"])
    assert {"juggleproof.symbolic.corner_impact", "juggleproof.lazy"} <= named
    named, every = sources.closure(["juggleproof.proofs.paper.s3_3_local"])
    assert "juggleproof.proofs.theorem" in every - named  # loaded by the package, no more
    assert "juggleproof.proofs.theorem.orbits" not in every
    with pytest.raises(KeyError, match="nowhere"):
        sources.closure(["juggleproof.nowhere"])


CHECKERS = (
    "mutants/*",
    "fresh/*",
    "coq-store/*",
    "sine-wide/*",
    "problems",
    "reports/*",
    "peers/*",
)


@pytest.mark.exhaust
@pytest.mark.parametrize(
    ("file", "more", "all_of", "none_of"),
    [
        ("certificates/checker/rules.py", "x = 1", CHECKERS, ()),
        ("juggleproof/votes/spans.py", "x = 1", ("fresh/*",), ("mutants/*", "coq-store/*")),
        (
            "juggleproof/search/certificate.py",
            "x = 1",
            ("fresh/*", "problems"),
            ("mutants/*", "coq-store/*"),
        ),
        (
            "juggleproof/sine/search.py",
            "x = 1",
            ("sine-wide/*",),
            ("mutants/checker/*", "fresh/eq*"),
        ),
        ("certificates/sine/wide/statements.txt", "x", ("sine-wide/*",), ("mutants/checker/*",)),
        (
            "proofs/restitution/unequal.py",
            "x = 1",
            ("fresh/restitution-unequal", "reports/html"),
            ("fresh/eq*", "mutants/*", "coq-*"),
        ),
        (
            "proofs/coq/physics/Bouncing.v",
            " ",
            ("tests/proofs/coq/test_physics.py",),
            ("fresh/*", "mutants/*"),
        ),
        (
            "tests/certificates/sine/mutants.txt",
            " ",
            ("mutants/sine/*",),
            ("mutants/checker/*", "fresh/*", "tests/proofs/*"),
        ),
        (
            "tests/share.py",
            "x = 1",
            ("tests/proofs/paper/test_prints.py",),
            ("fresh/*", "mutants/*"),
        ),
        ("requirements.lock", "x", ("*",), ()),
    ],
)
def test_a_change_asks_for_what_it_can_change_holds(
    copied: Path,
    stages: Stages,
    file: str,
    more: str,
    all_of: tuple[str, ...],
    none_of: tuple[str, ...],
) -> None:
    names = asked(copied, stages, file, f"\n{more}\n")
    for pattern in all_of:
        wanted = {name for name in stages.all if fnmatch(name, pattern)}
        assert wanted and wanted <= names, pattern
    for pattern in none_of:
        assert not [name for name in names if fnmatch(name, pattern)], pattern


@pytest.mark.exhaust
def test_mutants_of_a_file_depend_on_those_listed_of_it_alone_holds(
    copied: Path, stages: Stages
) -> None:
    before = stages.digests()
    with changed(copied, stages.sources, EQUIVALENT, "text.parse: a -> b\n") as other:
        after = Stages(other).digests()
    due = {name for name in before if before[name] != after[name]}
    assert {name for name in due if fnmatch(name, "mutants/*")} == {"mutants/checker/text"}
    assert not [name for name in due if fnmatch(name, "fresh/*")]


@pytest.mark.exhaust
def test_no_stage_depends_on_the_record_holds(stages: Stages) -> None:
    assert RECORD in stages.sources.data(["tests.exhaust.reports"])
    assert not [name for name, stage in stages.all.items() if RECORD in stage.files]


@pytest.mark.exhaust
@pytest.mark.parametrize("file", ["README.md", "CHANGELOG.md", "docs/trust.md", "docs/formulas.py"])
def test_prose_asks_for_nothing_holds(copied: Path, stages: Stages, file: str) -> None:
    assert not asked(copied, stages, file, "\nx = 1\n")


@pytest.mark.exhaust
def test_a_comment_asks_for_nothing_holds(copied: Path, stages: Stages) -> None:
    assert not asked(copied, stages, "certificates/checker/rules.py", "\n\n# x = 1\n")


def test_a_module_without_prose_has_what_is_run_and_what_decorators_read_holds() -> None:
    text = (
        '"""Of the module."""\n# why\nimport a  # here\n\n\n'
        '@claim("c")\ndef c():\n    """Read."""\n'
        '    return """#\n\n    x"""\n\n\nclass D:\n    """Of\n    a class."""\n    E = "#"\n'
        '\ndef f(): "Of one line."; return 1\n'
    )
    assert without_prose(text) == (
        'import a\n@claim("c")\ndef c():\n    """Read."""\n    return """#\n    x"""\n'
        'class D:\n    E = "#"\ndef f(): "Of one line."; return 1\n'
    )


@pytest.mark.exhaust
def test_an_import_inside_a_function_asks_for_what_it_brings_holds(
    copied: Path, stages: Stages
) -> None:
    """From then on, the stage depends on what is imported."""
    more = "\ndef late():\n    from juggleproof.symbolic import alpha\n    return alpha\n"
    file = "certificates/sine/flights.py"
    with changed(copied, stages.sources, file, more) as other:
        after = {stage.name: stage for stage in Stages(other).mutants()}
    brought = "symbolic/corner_impact.py"  # by the lazy package
    assert brought in after["mutants/sine/flights"].files
    assert brought not in stages.all["mutants/sine/flights"].files
    assert after["mutants/sine/flights"].digest(other) != stages.all["mutants/sine/flights"].digest(
        stages.sources
    )


@pytest.mark.exhaust
def test_a_statement_asks_for_its_claim_and_its_certificate_for_its_share_holds(
    sources: Sources, stages: Stages
) -> None:
    before = {stage.name: stage.digest(sources) for stage in (*stages.fresh(), *stages.coq())}

    def due(name: str, text: str) -> set[str]:
        other = Stages(sources)
        other.store = {**stages.store, name: text}
        return {
            stage.name
            for stage in (*other.fresh(), *other.coq())
            if stage.digest(sources) != before[stage.name]
        }

    rows, _, certificate = stages.store["eq-37/bound"].rpartition("\n")
    (share,) = due("eq-37/bound", f"{rows}\n{certificate} ")
    assert share.startswith("coq-store/")
    assert due("eq-37/bound", f"{rows}\nshow 1 > 0\n{certificate}") == {share, f"{FRESH}eq-37"}


# ------------------------------------------------------------ what is really opened

WATCH = """
import json, runpy, sys
from importlib.util import source_from_cache
opened = set()

def watch(event, arguments):
    if event == "open" and isinstance(arguments[0], str):
        path = arguments[0]
        opened.add(source_from_cache(path) if path.endswith(".pyc") else path)

sys.addaudithook(watch)
sys.argv = sys.argv[1:]
module = sys.argv[0]
try:
    runpy.run_module(module, run_name=__RUN__, alter_sys=True)
finally:
    print("\\n" + json.dumps(sorted(opened)))
"""


def opened(sources: Sources, run: str, *arguments: str) -> set[str]:
    """The files of the tree that a module opens when it is run under a name."""
    code = WATCH.replace("__RUN__", repr(run))
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    paths = (Path(name).resolve() for name in json.loads(done.stdout.splitlines()[-1]))
    names = {path.relative_to(ROOT).as_posix() for path in paths if path.is_relative_to(ROOT)}
    return names & set(sources.files)


@pytest.mark.exhaust
def test_a_fresh_search_opens_nothing_else_holds(sources: Sources, stages: Stages) -> None:
    seen = opened(sources, "__main__", "tests.exhaust.fresh", "eq-3")
    told = {f"{STORE}/{name}" for name in ("statements.txt", "certificates.jsonl", "findings")}
    around = {name for name in sources.files if name.startswith("tests/exhaust/")}
    loaded = {
        sources.modules[stages.claims["eq-3"]],
        "juggleproof/judging/judge.py",
        "juggleproof/statements/store.py",
    }
    assert loaded <= seen
    assert seen - set(stages.all[f"{FRESH}eq-3"].files) <= told | around | {INDEX, REGISTER}


@pytest.mark.exhaust
@pytest.mark.parametrize(
    ("module", "stage"),
    [
        ("tests.certificates.checker.mutate", "mutants/checker/rules"),
        ("tests.certificates.sine.mutants", "mutants/sine/cells"),
        ("juggleproof.benchmarks.problems", "problems"),
        ("juggleproof.coq_store.__main__", "coq-store/1"),
    ],
)
def test_loading_a_stage_opens_nothing_else_holds(
    sources: Sources, stages: Stages, module: str, stage: str
) -> None:
    seen = opened(sources, "loaded", module)
    assert sources.modules[module] in seen
    assert seen <= set(stages.all[stage].files)
