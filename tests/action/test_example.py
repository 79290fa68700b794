"""The repository that docs/ci.md shows, end to end: its workflow, its suite and its hook pass on
it, change nothing that is committed, and fail where the claim is false.
"""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

from tests.action.runner import ACTION, ROOT, Runner
from tests.docs.pages import blocks

FILE = "claims/bounds.py"
HOOKS = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))


@pytest.fixture
def runner(tmp_path: Path) -> Runner:
    """A runner whose working folder is the repository."""
    runner = Runner(tmp_path)
    runner.installed()
    for block in blocks(ROOT / "docs" / "ci.md"):
        if block.title:
            path = runner.work / block.title
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text, encoding="utf-8")
    return runner


def by_workflow(runner: Runner) -> int:
    """What the steps of the action exit with, called as the workflow calls it."""
    workflow = yaml.safe_load((runner.work / ".github/workflows/claims.yml").read_text())
    assert workflow["permissions"] == {"contents": "read"}
    checkout, step = workflow["jobs"]["claims"]["steps"]
    assert checkout["with"]["persist-credentials"] is False
    assert step["uses"] == "OWNER/juggleproof@REF" and set(step["with"]) <= set(ACTION["inputs"])
    given = {name.upper(): text for name, text in step["with"].items()}
    tex = runner.run("TeX for the PDF", **given)
    assert tex.returncode == 0 and runner.outputs() == {"pdf": "false"}
    done = runner.run("Certify", **given, PDF="false")
    assert done.returncode == 0, done.stderr
    return runner.run("Result", STATUS=runner.outputs()["exit"]).returncode


def by_suite(runner: Runner) -> int:
    """What pytest exits with, which is not told of claims but by pyproject.toml."""
    environment = {
        **{name: text for name, text in os.environ.items() if name != "PYTEST_ADDOPTS"},
        "PYTHONPATH": str(ROOT),
        "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
        "PYTEST_PLUGINS": "juggleproof.pytest_plugin",
    }
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-v"],
        cwd=runner.work,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert "juggleproof::product-bound" in done.stdout, done.stdout + done.stderr
    return done.returncode


def by_hook(runner: Runner) -> int:
    """What the hook exits with, which pre-commit calls so."""
    config = yaml.safe_load((runner.work / ".pre-commit-config.yaml").read_text())
    ((used,),) = (repository["hooks"] for repository in config["repos"])
    (hook,) = (one for one in HOOKS if one["id"] == used["id"])
    hook = {**hook, **used}
    assert hook["pass_filenames"] is False and hook["language"] == "python"
    program, *arguments = [*shlex.split(hook["entry"]), *hook["args"]]
    return subprocess.run(
        [runner.venv / program, *arguments], cwd=runner.work, check=False
    ).returncode


def committed(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def test_workflow_suite_and_hook_pass_and_change_nothing_holds(runner: Runner) -> None:
    shown = committed(runner.work)
    assert by_hook(runner) == 0
    first = committed(runner.work)
    assert set(first) - set(shown) == {
        f"claims/bounds.certificates/{name}"
        for name in ("statements.txt", "certificates.jsonl", "findings")
    }
    assert (by_workflow(runner), by_suite(runner), by_hook(runner)) == (0, 0, 0)
    assert committed(runner.work) == first
    (case,) = ElementTree.parse(runner.temp / "juggleproof/juggleproof.xml").getroot()[0]
    line = first[FILE].decode().splitlines().index('@claim("product-bound")') + 1
    assert case.attrib["classname"] == "claims.bounds" and float(case.attrib["time"]) > 0
    assert (case.attrib["file"], case.attrib["line"]) == (FILE, str(line))


@pytest.mark.exhaust
def test_rejects_a_claim_that_is_false(runner: Runner) -> None:
    path = runner.work / FILE
    text = path.read_text(encoding="utf-8")
    assert text.count("** 2 / 4") == 1
    path.write_text(text.replace("** 2 / 4", "** 2 / 5"), encoding="utf-8")
    assert (by_workflow(runner), by_suite(runner), by_hook(runner)) == (1, 1, 1)
    (case,) = ElementTree.parse(runner.temp / "juggleproof/juggleproof.xml").getroot()[0]
    assert "product-bound/main fails at " in str(case.find("failure").attrib["message"])


def test_rejects_a_hook_that_names_no_file(runner: Runner) -> None:
    (hook,) = HOOKS
    command = [runner.venv / "juggleproof", "certify", *hook["args"]]
    done = subprocess.run(command, cwd=runner.work, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr == ("juggleproof: claims.py: no such file; name a Python file with claims\n")
