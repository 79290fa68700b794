"""Claims as test items: one line each, failing where the verdict is not as it should be, never
skipped, judged once a session.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tomllib
from collections.abc import Sequence
from pathlib import Path

import pytest

from juggleproof import pytest_items
from juggleproof.judging.claims import Claim
from juggleproof.judging.register import load_register
from juggleproof.judging.run import Options, Run
from juggleproof.papers.paper import opened
from juggleproof.statements.store import DEFAULT
from tests.reports.runs import FALSE, HOLDS, OPEN, file_with, paper_run

ROOT = Path(__file__).resolve().parents[1]
Result = pytest.RunResult


@pytest.fixture
def inner(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> pytest.Pytester:
    """A folder with a pytest of its own, which loads the plugin whether it is installed or not."""
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    monkeypatch.setenv("PYTEST_PLUGINS", "juggleproof.pytest_plugin")
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.delenv("PYTEST_ADDOPTS", raising=False)
    return pytester


@pytest.fixture(scope="module")
def paper() -> list[Claim]:
    """The claims of the paper, loaded before a pytest inside this one would load them for itself
    and forget them: a claim is loaded once in a process.
    """
    return opened().claims()


def lines(result: Result) -> list[str]:
    return [line.strip() for line in result.outlines]


def test_true_claim_of_a_file_passes_holds(inner: pytest.Pytester) -> None:
    path = file_with(inner.path, HOLDS)
    result = inner.runpytest_subprocess("--juggleproof-claims", str(path), "-v")
    result.assert_outcomes(passed=1)
    result.stdout.fnmatch_lines(["*collected 1 item", "juggleproof::squares PASSED*"])
    assert result.ret == 0


def test_false_claim_of_a_file_fails_with_counterexample_and_hint_holds(
    inner: pytest.Pytester,
) -> None:
    file_with(inner.path, FALSE)
    result = inner.runpytest_inprocess("--juggleproof-claims", "mine.py", "-v")
    result.assert_outcomes(passed=1, failed=2)
    result.stdout.fnmatch_lines(
        [
            "juggleproof::above FAILED*",
            "above/main fails at x = 1/2: *",
            "`juggleproof explain above mine.py` tells more",
            "FAILED juggleproof::above - false",
        ]
    )
    assert "Traceback" not in result.stdout.str() and ".py:" not in result.stdout.str()


def test_unknown_fails_and_is_not_skipped_holds(inner: pytest.Pytester) -> None:
    file_with(inner.path, OPEN)
    result = inner.runpytest_inprocess("--juggleproof-claims", "mine.py")
    result.assert_outcomes(passed=1, failed=1, skipped=0, xfailed=0)
    result.stdout.fnmatch_lines(["unknown: neither proved nor refuted"])


def test_names_and_node_ids_select_holds(inner: pytest.Pytester) -> None:
    path = file_with(inner.path, FALSE)
    for chosen, passed, failed in (
        (["juggleproof::squares"], 1, 0),
        (["juggleproof::squares", "juggleproof::above"], 1, 1),
        (["-k", "above"], 0, 1),
        (["juggleproof"], 1, 2),
        (["juggleproof::squares", "-k", "above"], 0, 0),
    ):
        inner.runpytest_inprocess("--juggleproof-claims", str(path), *chosen).assert_outcomes(
            passed=passed,
            failed=failed,
            deselected=(
                3 - passed - failed
                if "-k" in chosen and len(chosen) == 2
                else 1
                if "-k" in chosen
                else 0
            ),
        )


def test_files_named_beside_the_option_are_judged_holds(inner: pytest.Pytester) -> None:
    file_with(inner.path, FALSE)
    inner.runpytest_inprocess("--juggleproof", "mine.py").assert_outcomes(passed=1, failed=2)
    result = inner.runpytest_inprocess("--juggleproof", "mine.py::squares", "-v")
    result.assert_outcomes(passed=1)
    result.stdout.fnmatch_lines(["juggleproof::squares PASSED*"])


def test_claims_are_judged_however_they_are_written_holds(inner: pytest.Pytester) -> None:
    path = file_with(inner.path, FALSE)
    text = path.read_text(encoding="utf-8").replace("@claim(", "@as_claim(")
    path.write_text("from juggleproof import claim as as_claim\n" + text, encoding="utf-8")
    inner.runpytest_inprocess("--juggleproof", "mine.py").assert_outcomes(passed=1, failed=2)


def test_rejects_named_file_that_is_not_judged(inner: pytest.Pytester) -> None:
    file_with(inner.path, FALSE).rename(inner.path / "test_mine.py")
    result = inner.runpytest_inprocess("--juggleproof", "test_mine.py")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["ERROR: test_mine.py: a test file by its name, *"])
    (inner.path / "empty.py").write_text("x = 1\n", encoding="utf-8")
    result = inner.runpytest_inprocess("--juggleproof", "empty.py")
    assert result.ret != 0 and any("empty.py: no claims" in line for line in lines(result))


def test_claims_stand_beside_tests_holds(inner: pytest.Pytester) -> None:
    file_with(inner.path, HOLDS)
    inner.makepyfile(test_it="def test_it(): pass\n")
    result = inner.runpytest_inprocess("--juggleproof-claims", "mine.py", "-v")
    result.assert_outcomes(passed=2)
    result.stdout.fnmatch_lines(
        ["*collected 2 items", "test_it.py::test_it PASSED*", "juggleproof::squares PASSED*"]
    )
    inner.runpytest_inprocess(
        "--juggleproof-claims", "mine.py", "test_it.py::test_it", "juggleproof::squares"
    ).assert_outcomes(passed=2)


def test_without_the_options_nothing_is_judged_holds(inner: pytest.Pytester) -> None:
    file_with(inner.path, FALSE)
    inner.makepyfile(test_it="def test_it(): pass\n")
    inner.runpytest_inprocess().assert_outcomes(passed=1)


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("def (:\n", "mine.py:1: does not parse"),
        ("x = 1\n", "mine.py: no claims; decorate"),
        (
            (
                "from juggleproof import always, claim, reals\n"
                "x, = reals('x')\n@claim('a')\ndef a():\n "
                "   'A.'\n    return always(x < 0.5)\n"
            ),
            "0.5 is not exact",
        ),
    ],
)
def test_rejects_file_in_one_line(content: str, reason: str, inner: pytest.Pytester) -> None:
    (inner.path / "mine.py").write_text(content, encoding="utf-8")
    result = inner.runpytest_inprocess("--juggleproof-claims", "mine.py")
    assert (
        result.ret != 0
        and any(reason in line for line in lines(result))
        and "Traceback" not in result.stdout.str()
    )


def test_rejects_name_of_no_claim(inner: pytest.Pytester) -> None:
    file_with(inner.path, HOLDS)
    result = inner.runpytest_inprocess("--juggleproof-claims", "mine.py", "juggleproof::other")
    assert result.ret != 0 and any(
        line.startswith("juggleproof::other: no such claim") for line in lines(result)
    )


def test_rejects_claim_of_a_file_with_a_name_of_the_paper(
    inner: pytest.Pytester, paper: list[Claim]
) -> None:
    path = file_with(inner.path, HOLDS)
    path.write_text(path.read_text(encoding="utf-8").replace("squares", "eq-1"), encoding="utf-8")
    result = inner.runpytest_inprocess(
        "--juggleproof", "--juggleproof-claims", "mine.py", "juggleproof::eq-1"
    )
    assert result.ret != 0 and any(
        "eq-1 is the name of two claims" in line for line in lines(result)
    )


def test_paper_passes_as_registered_and_fails_with_before_and_after_holds(
    inner: pytest.Pytester, paper: list[Claim], monkeypatch: pytest.MonkeyPatch
) -> None:
    register, judged = {**load_register()}, list[Options]()
    count = len(register)

    def counted(claims: Sequence[Claim], options: Options) -> Run:
        assert list(claims) == paper_run()[0].claims
        judged.append(options)
        return paper_run()[0]

    monkeypatch.setattr(pytest_items, "run", counted)
    monkeypatch.setattr(pytest_items, "PATH", inner.path / "register.json")
    register["eq-2"], register["vanished"] = {"verdict": "holds"}, {"verdict": "gap"}
    (inner.path / "register.json").write_text(json.dumps(register), encoding="utf-8")
    store = {
        path.name: path.stat().st_mtime_ns for path in (ROOT / "certificates" / "store").iterdir()
    }
    result = inner.runpytest_inprocess("--juggleproof", "-v", "-s")
    result.assert_outcomes(passed=count - 1, failed=2)
    result.stdout.fnmatch_lines(
        [
            f"collecting*collected {count + 1} items",
            "juggleproof::eq-37 PASSED",
            "juggleproof::sB.7-tau-p PASSED",
            "* claim eq-2 *",
            "differs from the register: eq-2: *verdict was holds, is misprint",
            "eq-2/main fails at *",
            "`juggleproof explain eq-2` tells more",
            "differs from the register: vanished: verdict was gap, is absent",
            "the claim is gone from the sources",
        ]
    )
    (options,) = judged  # of a copy of the store, and else as in the run that is given instead
    assert options == Options(options.store, jobs=1) and options.store != DEFAULT
    assert {
        path.name: path.stat().st_mtime_ns for path in (ROOT / "certificates" / "store").iterdir()
    } == store


def test_a_node_id_selects_a_claim_of_the_paper_holds(
    inner: pytest.Pytester, paper: list[Claim]
) -> None:
    result = inner.runpytest_inprocess("--juggleproof", "juggleproof::eq-37", "--collect-only")
    assert result.ret == 0 and "collected 1 item" in result.stdout.str()
    assert "<ClaimItem eq-37>" in result.stdout.str()


def test_plugin_is_registered_and_cheap_to_load_holds() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["entry-points"]["pytest11"] == {"juggleproof": "juggleproof.pytest_plugin"}
    heavy = {
        "sympy",
        "z3",
        "flint",
        "highspy",
        "mpmath",
        "numpy",
        "rich",
        "juggleproof.judging.judge",
        "juggleproof.command",
        "juggleproof.proofs.paper",
    }
    code = f"import sys, juggleproof.pytest_plugin; print(sorted({heavy} & set(sys.modules)))"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout == "[]\n"
