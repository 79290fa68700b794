"""Every command that README.md and the pages show is run, in the form that is shown or in a smaller
one, and what a page shows of its output is what it prints.
"""

from __future__ import annotations

import doctest
import importlib.util
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from juggleproof.statements.store import DEFAULT
from tests.command import running
from tests.command.running import Done
from tests.docs.pages import PAGES, ROOT, blocks, code, name

PROGRAMS = {  # juggleproof itself is run in this process, which has loaded it
    "python": [sys.executable],
    "pytest": [sys.executable, "-m", "pytest", "-p", "no:cacheprovider"],  # with our plugin only
}
VARIABLES = {
    "PYTHONPATH": str(ROOT),
    "NO_COLOR": "1",
    "COLUMNS": "80",
    "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
    "PYTEST_PLUGINS": "juggleproof.pytest_plugin",
}
LONG = (  # commands that take over a CPU second
    "python -m juggleproof.benchmarks.",
    "python -m tests.certificates.checker.fuzz",
    "pytest --juggleproof mine.py",
    "juggleproof explain restitution-unequal --premises",
    "juggleproof explain theorem --bounds",
    "juggleproof certify saturated.py",
    "juggleproof certify sine --",
    "juggleproof simulate juggler --hard-cases",
    "juggleproof simulate table --alpha 0.05 --gamma 3.1 --picture",
)
# What is appended to commands that begin so: the last of two equal options counts.
SMALLER = {
    "juggleproof simulate juggler --alpha 3/10 --random": "--random 1000",
    "juggleproof simulate juggler --picture basin": "--grid x=0:1:20,w=0:4:20",
    "juggleproof simulate juggler --picture bifurcation": "--alpha 1/5:3/5:5",
    "juggleproof simulate part --sweep": "--ensembles 1 --horizon 0.1",
    "juggleproof simulate part --figure": "--horizon 0.05",
    "juggleproof simulate part": "--ensembles 2 --horizon 0.05",
    "juggleproof certify sine --picture wide.svg": "--alpha 0.05 --gamma 3.1",
    "python -m juggleproof.benchmarks.bounds": "--only Caprasse --runs 1 --width 1e-3",
    "python -m juggleproof.benchmarks.classes": "--only divisions --share 3",
    "python -m juggleproof.benchmarks.commands": "--only=--help --runs 1",
    "python -m juggleproof.benchmarks.stability": "--only skew-tent",
}
# Commands that are run elsewhere: a file, and what in it runs them.
ELSEWHERE = {
    "make certify": (".ci/run", "certify > certify.out"),
    "make test": (".ci/run", "make test"),
    "juggleproof certify": (".ci/run", "juggleproof certify --jobs"),
    **{
        f"juggleproof report --format {form} -o DIR": (
            "tests/exhaust/reports.py",
            '"report", "--format", form',
        )
        for form in ("html", "latex", "markdown", "json", "figures", "pdf")
    },
    "pytest --juggleproof": (
        "tests/test_pytest_plugin.py",
        'runpytest_inprocess("--juggleproof", "-v", "-s")',
    ),
    "pytest --juggleproof juggleproof::eq-37": (
        "tests/test_pytest_plugin.py",
        '"--juggleproof", "juggleproof::eq-37"',
    ),
    "juggleproof check": ("tests/command/test_check.py", "check(None)"),
    "python -I -S certificates/sine certificates/sine/wide": (
        ".ci/run",
        '"$python" -I -S certificates/sine certificates/sine/wide',
    ),
    "python -I -S certificates/checker": (
        "tests/proofs/paper/test_claims.py",
        '"-I", "-S", "certificates/checker"',
    ),
    "juggleproof certify --json F --junit G --markdown H": (
        "tests/reports/test_register.py",
        'for option in ("json", "junit", "markdown")',
    ),
    "juggleproof bench --question DE-H --widths 1e-3,1e-9 --seconds 5 -o DIR": (
        "tests/benchmarks/bench/test_bench.py",
        '"--question",',
    ),
    "juggleproof simulate table --wave sine --picture attractors -o attractors.svg": (
        "tests/scenes/table/test_attractors.py",
        '"--picture", "attractors"',
    ),
    "juggleproof errata": ("tests/command/test_show.py", 'running.run("errata")'),
    "juggleproof bench": ("tests/benchmarks/bench/test_bench.py", '"--quick",'),
    "juggleproof bench --quick": ("tests/benchmarks/bench/test_bench.py", '"--quick",'),
    "juggleproof certify --only eq-37": (
        "tests/reports/test_register.py",
        'command("--only", ',
    ),
    "juggleproof explain theorem --premises": (
        "tests/proofs/theorem/test_quantities.py",
        'run(["explain", "theorem", "--premises"]) == 0',
    ),
    "pytest --juggleproof-claims mine.py": (
        "tests/test_pytest_plugin.py",
        'runpytest_subprocess("--juggleproof-claims", str(path), "-v")',
    ),
    "juggleproof certify --only eq-36": (
        "tests/reports/test_register.py",
        'command("--only", ',
    ),
    "juggleproof certify --only eq-36 --accept": (
        "tests/reports/test_register.py",
        "--accept",
    ),
    "python -m tests.certificates.checker.mutate rules.close_by_sign": (
        "tests/certificates/checker/test_mutants.py",
        "judge_all(chosen, follow=False)",
    ),
    "python -m juggleproof.benchmarks.problems": (
        "tests/exhaust/stages.py",
        '"juggleproof.benchmarks.problems", "--votes"',
    ),
    "juggleproof simulate part --sweep readings -o juggleproof/scenes/part/sweep.json": (
        "tests/command/test_simulate_part.py",
        '"--sweep", "readings", "-o", str(path)',
    ),
    "python -m juggleproof.benchmarks.sine": ("tests/benchmarks/test_sine.py", "sine.main()"),
    "python -m juggleproof.benchmarks.words": ("tests/benchmarks/test_words.py", "words.main()"),
}
NEEDS = {
    "simulate part": "numba",
    "--picture": "matplotlib",
    ".svg": "matplotlib",
    "--format pdf": "jinja2",
}


def shown(page: Path) -> list[str]:
    """The commands of a page, one line each, without their comments."""
    lines = "".join(code(page, "sh")).replace("\\\n", " ").splitlines()
    return [shlex.join(shlex.split(line, comments=True)) for line in lines if line.strip()]


FIRST = {one: page for page in reversed(PAGES) for one in shown(page)}  # a command is run once
COMMANDS = [(page, one) for one, page in FIRST.items()]


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_records: None) -> None:
    """With the records that other tests keep."""


Run = Callable[[str, Path], Done]


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs a command in a folder with the files that a page shows and a copy of the store."""
    for variable, value in VARIABLES.items():
        monkeypatch.setenv(variable, value)

    def run(command: str, page: Path) -> Done:
        first, *rest = arguments(command, page, tmp_path)
        if first == "juggleproof":
            return running.run(*rest, cwd=tmp_path)
        done = subprocess.run(
            [*PROGRAMS[first], *rest],
            capture_output=True,
            text=True,
            cwd=ROOT if first == "python" else tmp_path,
            timeout=600,
            check=False,
        )
        return Done(done.returncode, done.stdout, done.stderr)

    return run


@pytest.fixture(scope="module")
def lozi(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the page on stability has the command write for a map."""
    folder, page = tmp_path_factory.mktemp("lozi"), ROOT / "docs/stability.md"
    command = "juggleproof stability lozi.map -o lozi"
    assert running.run(*arguments(command, page, folder)[1:], cwd=folder).returncode == 0
    return folder / "lozi"


def arguments(command: str, page: Path, folder: Path) -> list[str]:
    """The words of a command, when the folder has what it reads."""
    for block in [*blocks(ROOT / "docs/your-own.md"), *blocks(page)]:
        if block.title:
            path = folder / block.title
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text, encoding="utf-8")
    first, *rest = shlex.split(command)
    own = len(rest) > 1 and ("." in rest[1] or rest[1] == "sine")
    paper = rest[:1] == ["certify"] and not own
    if paper:  # what is judged here must not write into the store
        shutil.copytree(DEFAULT, folder / "store")
        rest += ["--store", "store"]
    # what is written goes to the folder of the test, wherever the command runs
    return [first, *(str(folder / word) if word == "DIR" else word for word in rest)]


@pytest.mark.parametrize(
    ("page", "command"),
    [
        pytest.param(
            page,
            one,
            marks=[pytest.mark.exhaust] * (one.startswith(LONG) and one not in ELSEWHERE),
            id=f"{name(page)}: {one}",
        )
        for page, one in COMMANDS
    ],
)
def test_a_command_that_is_shown_runs(
    page: Path, command: str, tmp_path: Path, run: Run, lozi: Path
) -> None:
    if command in ELSEWHERE:
        file, text = ELSEWHERE[command]
        assert text in (ROOT / file).read_text(encoding="utf-8")
        return
    for part, module in NEEDS.items():
        if part in command and importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not installed")
    if "--format pdf" in command and shutil.which("latexmk") is None:
        pytest.skip("latexmk is needed")
    stored = command.startswith("juggleproof check mine.") or " mean.certificates" in command
    if stored:  # what the line above it has written
        source = "mine.py" if "mine." in command else "mean.smt2"
        assert run(f"juggleproof certify {source}", page).returncode == 0
    if " lozi/" in command:
        shutil.copytree(lozi, tmp_path / "lozi")
    less = next((more for begin, more in SMALLER.items() if command.startswith(begin)), "")
    done = run(f"{command} {less}", page)
    assert done.returncode == 0, done.stdout + done.stderr


SESSIONS = [
    # a basin takes as long as all others
    pytest.param(page, one, marks=[pytest.mark.exhaust] * ("--basin" in one), id=name(page))
    for page in PAGES
    for one in code(page, "console")
]


@pytest.mark.parametrize(("page", "session"), SESSIONS)
def test_what_is_shown_of_an_output_is_printed(page: Path, session: str, run: Run) -> None:
    command, _, expected = session.removeprefix("$ ").partition("\n")
    printed = run(command, page).stdout
    checker = doctest.OutputChecker()
    assert checker.check_output(expected, printed, doctest.ELLIPSIS), printed


def test_nothing_that_runs_elsewhere_is_kept_without_need() -> None:
    commands = {command for _, command in COMMANDS}
    assert set(ELSEWHERE) <= commands
    assert all(any(one.startswith(begin) for one in commands) for begin in SMALLER)


def test_python_that_is_shown_reads_holds() -> None:
    claims = (ROOT / "proofs/paper").glob("*.py")
    sources = "\n".join(path.read_text(encoding="utf-8") for path in claims)
    for page in PAGES:
        for text in code(page, "python"):
            compile(text, name(page), "exec")
            if re.match(r'@claim\(\n    "eq-', text):
                assert text in sources, "a claim that is shown is one of the paper's, word for word"
