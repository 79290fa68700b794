"""The action is safe for forks, and its shell steps do what they say, here with a made up
environment of GitHub.  With JUGGLEPROOF_MUTANTS=many (make exhaust) the whole step certifies the
paper; `make test` runs it on files of one's own, and on a run of the paper that is stood in for.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml

from juggleproof.judging.claims import VERDICTS
from juggleproof.judging.register import load_register
from juggleproof.statements.store import DEFAULT
from tests.action.runner import ACTION, ROOT, SCRIPTS, Runner
from tests.reports.runs import FALSE, HOLDS, file_with
from tests.rows import each_row
from tests.share import MANY

WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
PINNED = r"[\w.\-]+/[\w.\-/]+@(v\d+|[0-9a-f]{40})"
FORBIDDEN = (
    "secrets",
    "pull_request_target",
    "workflow_run",
    "github.event",
    "github.head_ref",
    "github.token",
    "GITHUB_TOKEN",
    "actions/cache",
)
EXPRESSIONS = r"inputs\.[\w\-]+|steps\.(certify|tex)\.outputs\.\w+|runner\.temp"


def names() -> list[str]:
    return [step["name"] for step in SCRIPTS]


def test_action_is_composite_and_every_input_and_output_is_described_holds() -> None:
    assert ACTION["runs"]["using"] == "composite" and {"files", "budget", "formats", "pdf"} <= set(
        ACTION["inputs"]
    )
    assert set(ACTION["outputs"]) == {"exit", "theorem", "counts"}
    assert all(
        isinstance(name, str) and one["description"]
        for name, one in [*ACTION["inputs"].items(), *ACTION["outputs"].items()]
    )
    assert all(
        one["default"] is not None and not one.get("required") for one in ACTION["inputs"].values()
    )


@each_row("step", SCRIPTS)
def test_script_takes_nothing_from_outside_into_its_text_holds(step: Any) -> None:
    assert step["shell"] == "bash" and "${{" not in step["run"]
    assert step["run"].startswith("set -euo pipefail\n")
    for value in step.get("env", {}).values():
        assert value == "off" or re.fullmatch(rf"\$\{{\{{ ({EXPRESSIONS}) \}}\}}", value), value


def test_expressions_are_inputs_outputs_and_the_folder_of_the_runner_only_holds() -> None:
    found = re.findall(r"\$\{\{(.*?)\}\}", (ROOT / "action.yml").read_text(encoding="utf-8"))
    assert found and all(re.fullmatch(EXPRESSIONS, one.strip()) for one in found), found


@each_row("step", SCRIPTS)
def test_script_quotes_what_it_expands_holds(step: Any) -> None:
    text = re.sub(r"<<'END'\n.*?\nEND\n", "\n", step["run"], flags=re.S)
    text = re.sub(r"'[^'\n]*'", "", re.sub(r"\$\{(\w+)\[@\]\+\"\$\{\1\[@\]\}\"\}", "", text))
    bare = re.sub(r'"(?:\$\((?:[^()])*\)|[^"\\]|\\.)*"', "", text)
    assert not re.findall(r"\$(?!\?)\S*", bare), re.findall(r"\$(?!\?)\S*", bare)
    assert "eval" not in bare and "`" not in bare
    assert subprocess.run(["bash", "-n"], input=step["run"], text=True, check=False).returncode == 0


@each_row("path", [ROOT / "action.yml", *WORKFLOWS])
def test_no_secret_no_cache_and_no_trigger_with_rights_holds(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    for word in FORBIDDEN:
        assert word not in text, word
    for used in re.findall(r"uses:\s*(\S+)", text):
        assert used == "./" or re.fullmatch(PINNED, used), used


@each_row("path", WORKFLOWS)
def test_workflow_may_only_read_holds(path: Path) -> None:
    workflow = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert workflow["permissions"] == {"contents": "read"}
    assert set(workflow[True]) == {"push", "pull_request"}  # YAML 1.1 reads the key `on` as true
    for job in workflow["jobs"].values():
        assert job["strategy"]["matrix"]["python"] == ["3.11", "3.12", "3.13"]
        assert "permissions" not in job and job["timeout-minutes"] <= 60
        for step in job["steps"]:
            assert step.get("run", ".ci/run") == ".ci/run"
            is_checkout = "checkout" in step.get("uses", "")
            assert not is_checkout or step["with"]["persist-credentials"] is False


@pytest.fixture
def runner(tmp_path: Path) -> Runner:
    return Runner(tmp_path)


@pytest.mark.parametrize(
    ("files", "lock"), [("", "requirements-report.lock"), ("mine.py", "requirements.lock")]
)
def test_installation_takes_the_lock_only_holds(files: str, lock: str, runner: Runner) -> None:
    runner.tool("of-the-venv", runner.recorded("venv python"))
    runner.tool(
        "python",
        runner.recorded(
            "python", f'mkdir -p "$3/bin" && cp "{runner.tools}/of-the-venv" "$3/bin/python"'
        ),
    )
    done = runner.run("Install from the lock", FILES=files)
    assert done.returncode == 0, done.stderr
    made, installed, own = runner.called()
    assert made == f"python -m venv {runner.temp / 'juggleproof-venv'}"
    assert (
        installed.endswith(f"--requirement {ROOT}/{lock}")
        and "--no-deps --no-build-isolation" in own
    )


def test_false_claim_of_ones_own_fails_and_is_in_the_summary_holds(runner: Runner) -> None:
    runner.installed()
    file_with(runner.work, FALSE)
    done = runner.run("Certify", FILES="\nmine.py\n")
    assert done.returncode == 0, done.stderr
    outputs = runner.outputs()
    assert set(outputs) == set(ACTION["outputs"])
    assert outputs["exit"] == "1" and outputs["theorem"] == "none"
    counts = json.loads(outputs["counts"])
    assert counts["claims"] == 3 and counts["changes"] == 0
    assert counts["verdicts"] == {**dict.fromkeys(VERDICTS, 0), "holds": 1, "false": 2}
    assert runner.summary.read_text(encoding="utf-8").startswith("# 1 of 3 claims holds\n")
    made = runner.temp / "juggleproof"
    assert {path.name for path in made.iterdir()} == {
        "juggleproof.json",
        "juggleproof.xml",
        "juggleproof.md",
        "timings.txt",
        "certify.txt",
        "problem.txt",
    }
    assert "3 claims: 1 holds" in done.stdout
    assert runner.run("Result", STATUS=runner.outputs()["exit"]).returncode == 1


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"FILES": "--accept"}, "--accept: no such file"),
        ({"FILES": "$(touch hacked).py\n`touch hacked`"}, "$(touch hacked).py: no such file"),
        ({"FILES": "mine.py", "BUDGET": "1; touch hacked"}, "is not a whole number"),
    ],
)
def test_rejects_input_that_is_no_file_or_number(
    given: dict[str, str], told: str, runner: Runner
) -> None:
    runner.installed()
    file_with(runner.work, HOLDS)
    assert runner.run("Certify", **given).returncode == 0
    assert runner.outputs() == {"exit": "2"} and not (runner.work / "hacked").exists()
    summary = runner.summary.read_text(encoding="utf-8")
    assert summary.startswith("# juggleproof did not run\n\n    juggleproof") and told in summary
    assert runner.run("Result", STATUS="2").returncode == 2


def certified(runner: Runner, **given: str) -> list[str]:
    """The options of the one call of the command that the steps make."""
    runner.tool("juggleproof", runner.recorded("juggleproof"), runner.venv)
    done = runner.run("Certify", **given)
    assert done.returncode == 0, done.stderr
    (call,) = runner.called()
    return call.split()


def test_one_call_certifies_and_makes_every_report_holds(runner: Runner) -> None:
    options = certified(runner, FORMATS=" html  badge ", PDF="true")
    assert options[:2] == ["juggleproof", "certify"]
    reports = [one for one in options if one.startswith("--report")]
    assert reports == ["--report=html", "--report=badge", "--report=pdf"]


def test_no_report_is_made_of_ones_own_file_holds(runner: Runner) -> None:
    options = certified(runner, FILES="mine.py", FORMATS="html", PDF="false")
    assert not [one for one in options if one.startswith("--report")] and options[-1] == "mine.py"


@pytest.mark.parametrize("given", ["$(touch hacked)", "--accept"])
def test_rejects_format(given: str, runner: Runner) -> None:
    runner.installed()
    done = runner.run("Certify", FORMATS=given, PDF="false")
    assert done.returncode == 0 and len(done.stderr.splitlines()) == 1
    assert runner.outputs() == {"exit": "2"} and not (runner.work / "hacked").exists()
    assert "choose from html" in runner.summary.read_text(encoding="utf-8")


@pytest.mark.parametrize("given", ["yes", ""])
def test_rejects_pdf_that_is_neither_true_nor_false(given: str, runner: Runner) -> None:
    done = runner.run("TeX for the PDF", PDF=given)
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1


def bare_path(runner: Runner) -> str:
    """A PATH of shell tools without latexmk and apt-get."""
    folder = runner.work.parent / "bare"
    folder.mkdir()
    for tool in ("bash", "cat", "id", "printf"):
        (folder / tool).symlink_to(str(shutil.which(tool)))
    return str(folder)


def test_tex_is_installed_where_latexmk_is_absent_holds(runner: Runner) -> None:
    runner.tool("apt-get", runner.recorded("apt-get"))
    runner.tool("sudo", runner.recorded("sudo", 'shift; "$@"'))
    runner.tool("id", "echo 1000")
    done = runner.run("TeX for the PDF", path=bare_path(runner), PDF="true")
    assert done.returncode == 0, done.stderr
    calls = runner.called()
    assert calls[0].startswith("sudo --non-interactive apt-get update")
    assert calls[1].startswith("apt-get update")
    assert calls[3].startswith("apt-get install") and "latexmk" in calls[3]
    assert runner.outputs() == {"pdf": "true"}


def test_no_tex_is_installed_for_files_of_ones_own_holds(runner: Runner) -> None:
    runner.tool("apt-get", runner.recorded("apt-get"))
    done = runner.run("TeX for the PDF", path=bare_path(runner), PDF="true", FILES="mine.py")
    assert done.returncode == 0 and runner.outputs() == {"pdf": "false"} and not runner.called()


def test_pdf_is_left_out_and_said_so_where_it_cannot_be_made_holds(runner: Runner) -> None:
    done = runner.run("TeX for the PDF", path=bare_path(runner), PDF="true")
    assert done.returncode == 0 and "::warning::the PDF is left out" in done.stdout
    assert runner.outputs() == {"pdf": "false"}


@pytest.mark.parametrize(
    ("theorem", "told"), [({"proved": True}, "proved"), ({"proved": False}, "lost"), (None, "none")]
)
def test_outputs_are_those_of_the_run_holds(
    theorem: dict[str, bool] | None, told: str, runner: Runner
) -> None:
    written = json.dumps({"counts": {"claims": 312, "changes": 1}, "theorem": theorem})
    runner.installed()
    runner.tool(
        "juggleproof",
        'made="${2#--json=}"; made="${made%/*}"; printf "# The summary\\n" > "$made/juggleproof.md"'
        f"\nprintf '%s' '{written}' > \"$made/juggleproof.json\"; exit 1",
        runner.venv,
    )
    done = runner.run("Certify", PDF="false")
    assert done.returncode == 0, done.stderr
    counts = '{"claims": 312, "changes": 1}'
    assert runner.outputs() == {"exit": "1", "theorem": told, "counts": counts}
    assert runner.summary.read_text(encoding="utf-8") == "# The summary\n"


@pytest.mark.skipif(not MANY, reason="the paper is certified by the step in make exhaust")
def test_paper_is_certified_from_a_copy_of_the_tree_holds(runner: Runner, tmp_path: Path) -> None:
    """The whole step on the paper; the store is a copy, so that a run of the tests leaves the tree
    as it is.
    """
    runner.tool("python", f"exec '{sys.executable}' \"$@\"", runner.venv)
    shutil.copytree(DEFAULT, tmp_path / "store")
    runner.tool(
        "juggleproof",
        f"command=$1; shift\nPYTHONPATH='{ROOT}' exec '{sys.executable}' -P"
        " -m juggleproof.command.main"
        f' "$command" --store \'{tmp_path / "store"}\' "$@"',
        runner.venv,
    )
    done = runner.run("Certify", PATH=os.environ["PATH"], PDF="false")
    assert done.returncode == 0, done.stderr
    assert (runner.outputs()["exit"], runner.outputs()["theorem"]) == ("0", "proved")
    open_claims = [one for one in load_register().values() if one["verdict"] == "unknown"]
    assert all(one["detail"].startswith("not formalised: ") for one in open_claims)
    counts = json.loads(runner.outputs()["counts"])["verdicts"]
    assert counts["unknown"] == len(open_claims)
    summary = runner.summary.read_text(encoding="utf-8")
    assert summary.startswith("# The theorem is proved\n") and "No change." in summary
    made = runner.temp / "juggleproof"
    assert json.loads((made / "juggleproof.json").read_text(encoding="utf-8"))["exit"] == 0
    assert {"juggleproof.html", "juggleproof-badge.json"} <= {one.name for one in made.iterdir()}
