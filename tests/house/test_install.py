"""What is installed is one import name: from a wheel and from an editable install, the command, the
API and the pytest plugin work beside a project that has folders named as ours.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tomllib
import zipfile
from collections.abc import Mapping
from importlib import metadata
from pathlib import Path
from typing import NamedTuple

import pytest

from juggleproof.proofs.command.main import build_parser

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("benchmarks", "certificates", "proofs", "scenes", "symbolic")
DEPENDENCIES = "flint, highspy, mpmath, numpy, pytest, rich, setuptools, sympy, z3"
PYTHONS = ("3.11", "3.12", "3.13")
RUNNING = ".".join(map(str, sys.version_info[:2]))
CLAIM = """
from juggleproof.proofs import always, claim, reals

x, y = reals("x y")


@claim("squares")
def squares():
    "The product is at most the mean of the squares."
    return always(x * y <= (x**2 + y**2) / 2)
"""
OWN = """
import benchmarks, certificates, proofs, scenes, symbolic, tests


def test_the_project_has_its_own_folders():
    for folder in (benchmarks, certificates, proofs, scenes, symbolic, tests):
        assert folder.WHOSE == "the project"
"""
API = """
import sys
from pathlib import Path
import juggleproof
from juggleproof.proofs import always, claim, reals
from juggleproof.proofs.api import certify
assert Path(juggleproof.__file__).parents[0].parent == Path(sys.argv[1]), juggleproof.__file__
assert [(one.name, one.answer) for one in certify(Path("mine.py"))] == [("squares", "holds")]
"""


class Place(NamedTuple):
    """A virtual environment and the folder that `juggleproof` is imported from in it."""

    bin: Path
    home: Path


def ran(*command: object, cwd: Path, env: Mapping[str, str] | None = None) -> str:
    """What a command prints, in an environment that names no other place to import from."""
    clean = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("PYTHON", "PYTEST", "JUGGLEPROOF", "COV"))
    }
    done = subprocess.run(
        [str(part) for part in command],
        cwd=cwd,
        env={
            **clean,
            "JUGGLEPROOF_CACHE": "off",
            "PIP_DISABLE_PIP_VERSION_CHECK": "1",
            **(env or {}),
        },
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def checkout(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of what is installed, so that building leaves nothing in the checkout."""
    folder = tmp_path_factory.mktemp("checkout")
    for name in (*FOLDERS, "juggleproof"):
        shutil.copytree(
            ROOT / name,
            folder / name,
            symlinks=True,
            ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"),
        )
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, folder)
    return folder


def pip(python: Path | str, *arguments: object, cwd: Path) -> None:
    ran(python, "-m", "pip", *arguments, "--quiet", "--no-deps", "--no-build-isolation", cwd=cwd)


@pytest.fixture(scope="module")
def wheel(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    pip(sys.executable, "wheel", checkout, "--wheel-dir", folder, cwd=folder)
    (made,) = folder.glob("*.whl")
    return made


def interpreter(version: str) -> str:
    """A Python of this version that has what certifying needs."""
    found = sys.executable if version == RUNNING else shutil.which(f"python{version}")
    code = f"import sys, {DEPENDENCIES}; print(*sys.version_info[:2], sep='.')"
    done = found and subprocess.run([found, "-I", "-c", code], capture_output=True, text=True)
    if not done or done.stdout.strip() != version:
        pytest.skip(f"there is no python{version} that has {DEPENDENCIES}")
    assert found
    return found


def environment(python: str, folder: Path) -> tuple[Path, Path]:
    """A new virtual environment that sees what `python` has installed, but not what is editable
    there: (its bin, its site-packages).
    """
    code = "import sysconfig; print(sysconfig.get_path('purelib'))"
    there = ran(python, "-c", code, cwd=folder).strip()
    ran(python, "-m", "venv", "--without-pip", folder / "venv", cwd=folder)
    bin = folder / "venv" / "bin"
    site = Path(ran(bin / "python", "-c", code, cwd=folder).strip())
    (site / "dependencies.pth").write_text(there + "\n", encoding="utf-8")
    return bin, site


@pytest.fixture(scope="module", params=[*PYTHONS, "editable"])
def place(
    request: pytest.FixtureRequest,
    checkout: Path,
    wheel: Path,
    tmp_path_factory: pytest.TempPathFactory,
) -> Place:
    editable = request.param == "editable"
    python = sys.executable if editable else interpreter(request.param)
    folder = tmp_path_factory.mktemp("installed")
    bin, site = environment(python, folder)
    what = ("--editable", checkout) if editable else (wheel,)
    pip(bin / "python", "install", "--no-index", *what, cwd=folder)
    return Place(bin, checkout if editable else site)


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project whose folders are named as ours, with a claim and a test of its own."""
    for name in (*FOLDERS, "tests"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text('WHOSE = "the project"\n', encoding="utf-8")
    (tmp_path / "mine.py").write_text(CLAIM, encoding="utf-8")
    (tmp_path / "test_own.py").write_text(OWN, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("more", [{}, {"PYTHONPATH": "."}], ids=["as it is", "PYTHONPATH=."])
def test_the_command_beside_a_project_holds(
    place: Place, project: Path, more: dict[str, str]
) -> None:
    assert "eq-37" in ran(place.bin / "juggleproof", "list", cwd=project, env=more)


def test_the_version_is_that_of_the_metadata_holds(place: Place, project: Path) -> None:
    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    told = ran(place.bin / "juggleproof", "--version", cwd=project)
    assert told == f"juggleproof {version}\n"


def test_rejects_a_question_for_the_version_where_nothing_is_installed(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def missing(name: str) -> str:
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "version", missing)
    with pytest.raises(SystemExit) as ended:
        build_parser().parse_args(["--version"])
    assert ended.value.code == 2 and "not installed" in capsys.readouterr().err


def test_the_api_beside_a_project_holds(place: Place, project: Path) -> None:
    ran(place.bin / "python", "-c", API, place.home, cwd=project)


def test_pytest_beside_a_project_holds(place: Place, project: Path) -> None:
    told = ran(
        place.bin / "python", "-m", "pytest", "-v", "--juggleproof-claims", "mine.py", cwd=project
    )
    assert "test_own.py::test_the_project_has_its_own_folders PASSED" in told
    assert "squares" in told and "2 passed" in told


def test_all_sources_and_data_are_in_the_wheel_holds(wheel: Path) -> None:
    held = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    wanted = {
        f"juggleproof/{path.relative_to(ROOT).as_posix()}"
        for folder in FOLDERS
        for path in (ROOT / folder).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts and path.suffix != ".smt2"
    }
    wanted |= {
        f"juggleproof/{path.name}" for path in (ROOT / "juggleproof").iterdir() if path.is_file()
    }
    assert held == wanted
