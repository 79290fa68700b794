"""What is installed is one import name: from a wheel, from an sdist and from an editable install of
a clone, with what certifying needs and no more, the command, the API and the pytest plugin work
beside a project that has folders named as ours.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from collections.abc import Mapping
from importlib import metadata
from pathlib import Path
from typing import NamedTuple

import pytest

from juggleproof.command.main import build_parser

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("benchmarks", "certificates", "proofs", "symbolic")
NEEDED = [line.partition("==")[0] for line in (ROOT / "requirements.lock").read_text().split()]
FOR_PYTEST = ["pytest", "iniconfig", "packaging", "pluggy"]
EXTRAS = ("jinja2", "matplotlib", "numba", "latex2mathml", "hypothesis", "mypy", "selenium")
PYTHONS = ("3.11", "3.12", "3.13")
RUNNING = ".".join(map(str, sys.version_info[:2]))
CLAIM = """
from juggleproof import always, claim, reals

x, y = reals("x y")


@claim("squares")
def squares():
    "The product is at most the mean of the squares."
    return always(x * y <= (x**2 + y**2) / 2)
"""
OWN = """
import benchmarks, certificates, proofs, symbolic, tests


def test_the_project_has_its_own_folders():
    for folder in (benchmarks, certificates, proofs, symbolic, tests):
        assert folder.WHOSE == "the project"
"""
API = """
import sys
from importlib.util import find_spec
from pathlib import Path
import juggleproof
assert not [name for name in sys.modules if name.startswith("juggleproof.")]
assert {"certify", "run_part"} <= set(dir(juggleproof))
from juggleproof import *
assert enclose_minimum("x^2 - x", {"x": (0, 1)}, width=0).low.denominator == 4
assert orbit(scene("3/10", point(1000, -41)), "exact", until_trap=True).row(0).end == "trap"
assert not [name for name in sys.argv[2:] if find_spec(name)], "more than certifying needs"
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


def committed() -> list[Path]:
    """The files that git knows and that are still there."""
    told = ran("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", cwd=ROOT)
    return [path for name in told.split("\0") if name and (path := ROOT / name).is_file()]


@pytest.fixture(scope="module")
def checkout(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A clone of what is committed, as on a system without symbolic links."""
    folder = tmp_path_factory.mktemp("clones") / "checkout"
    for path in committed():
        copy = folder / path.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        if path.is_symlink():
            copy.write_text(os.readlink(path), encoding="utf-8")
        else:
            shutil.copy(path, copy)
    return folder


def pip(python: Path | str, *arguments: object, cwd: Path) -> None:
    ran(python, "-m", "pip", *arguments, "--quiet", "--no-deps", "--no-build-isolation", cwd=cwd)


@pytest.fixture(scope="module")
def wheel(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    pip(sys.executable, "wheel", checkout, "--wheel-dir", folder, cwd=folder)
    (made,) = folder.glob("*.whl")
    return made


@pytest.fixture(scope="module")
def sdist(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sdist")
    code = f"from setuptools.build_meta import build_sdist; print(build_sdist({str(folder)!r}))"
    return folder / ran(sys.executable, "-c", code, cwd=checkout).splitlines()[-1]


PARTS = """
import sys
from importlib.metadata import distribution
for name in sys.argv[1:]:
    one = distribution(name)
    for top in {file.parts[0] for file in one.files} - {"..", "__pycache__"}:
        print(one.locate_file(top))
"""  # the files and folders in site-packages of the distributions that are named


def interpreter(version: str) -> str:
    """A Python of this version that has what certifying needs."""
    found = sys.executable if version == RUNNING else shutil.which(f"python{version}")
    code = f"import sys; print(*sys.version_info[:2], sep='.'){PARTS}"
    needed = [*NEEDED, *FOR_PYTEST]
    done = found and subprocess.run(
        [found, "-I", "-c", code, *needed], capture_output=True, text=True
    )
    if not done or done.returncode or done.stdout.split()[0] != version:
        pytest.skip(f"there is no python{version} that has {', '.join(needed)}")
    assert found
    return found


def environment(python: str, folder: Path) -> tuple[Path, Path]:
    """A new virtual environment with what certifying needs, and pytest, of what `python` has, and
    with nothing else: (its bin, its site-packages).
    """
    ran(python, "-m", "venv", "--without-pip", folder / "venv", cwd=folder)
    bin = folder / "venv" / "bin"
    code = "import sysconfig; print(sysconfig.get_path('purelib'))"
    site = Path(ran(bin / "python", "-c", code, cwd=folder).strip())
    for part in ran(python, "-c", PARTS, *NEEDED, *FOR_PYTEST, cwd=folder).splitlines():
        (site / Path(part).name).symlink_to(part)
    return bin, site


# each takes minutes, or many seconds; the suite itself runs on an editable install
PLACES = ["editable", *PYTHONS, "sdist"]


@pytest.fixture(
    scope="module", params=[pytest.param(one, marks=pytest.mark.exhaust) for one in PLACES]
)
def place(
    request: pytest.FixtureRequest,
    checkout: Path,
    wheel: Path,
    sdist: Path,
    tmp_path_factory: pytest.TempPathFactory,
) -> Place:
    python = interpreter(request.param if request.param in PYTHONS else RUNNING)
    folder = tmp_path_factory.mktemp("installed")
    bin, site = environment(python, folder)
    what = {"editable": ("--editable", checkout), "sdist": (sdist,)}.get(request.param, (wheel,))
    pip(python, "--python", bin / "python", "install", "--no-index", *what, cwd=folder)
    return Place(bin, checkout if request.param == "editable" else site)


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project whose folders are named as ours, with a claim and a test of its own."""
    for name in (*FOLDERS, "tests"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text('WHOSE = "the project"\n', encoding="utf-8")
    (tmp_path / "mine.py").write_text(CLAIM, encoding="utf-8")
    (tmp_path / "test_own.py").write_text(OWN, encoding="utf-8")
    return tmp_path


def test_the_command_beside_a_project_holds(place: Place, project: Path) -> None:
    assert "eq-37" in ran(place.bin / "juggleproof", "list", cwd=project)
    named = {"PYTHONPATH": "."}  # the project's folders come first
    assert " holds" in ran(place.bin / "juggleproof", "certify", "mine.py", cwd=project, env=named)


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
    ran(place.bin / "python", "-c", API, place.home, *EXTRAS, cwd=project)


TYPED = """
from juggleproof import certify, run_part

reveal_type(certify)
reveal_type(run_part)
"""


@pytest.fixture(scope="module")
def types(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder for what mypy keeps of the standard library, for all environments."""
    return tmp_path_factory.mktemp("types")


def test_types_beside_a_project_hold(
    place: Place, project: Path, types: Path, checkout: Path
) -> None:
    """Of an editable install, by the folder of links that `make lint` lays for such tools."""
    (project / "typed.py").write_text(TYPED, encoding="utf-8")
    python = place.bin / "python"
    options = ("--strict", "--follow-imports=silent", "--cache-dir", types)
    ran("make", "build/imports", cwd=checkout)
    path = {"MYPYPATH": f"{checkout}/build/imports"} if place.home == checkout else None
    seen = ran(
        sys.executable,
        "-m",
        "mypy",
        *options,
        "--python-executable",
        python,
        "typed.py",
        cwd=project,
        env=path,
    )
    types = [line.partition("Revealed type is ")[2] for line in seen.splitlines()[:2]]
    assert types[0].startswith('"def (what: ') and "list[juggleproof.api.Result]" in types[0]
    assert types[1].startswith('"def (setting: juggleproof.scenes.part.setting.Scene')


def test_pytest_beside_a_project_holds(place: Place, project: Path) -> None:
    told = ran(
        place.bin / "python", "-m", "pytest", "-v", "--juggleproof-claims", "mine.py", cwd=project
    )
    assert "test_own.py::test_the_project_has_its_own_folders PASSED" in told
    assert "squares" in told and "2 passed" in told


def test_a_new_file_needs_no_new_install_holds(place: Place, project: Path, checkout: Path) -> None:
    if place.home != checkout:
        pytest.skip("no editable install")
    (checkout / "proofs" / "new").mkdir()
    for file in ("symbolic/new.py", "proofs/new/__init__.py"):
        (checkout / file).write_text("HERE = __name__\n", encoding="utf-8")
    code = (
        "import juggleproof.symbolic.new as a, juggleproof.proofs.new as b; print(a.HERE, b.HERE)"
    )
    told = ran(place.bin / "python", "-c", code, cwd=project)
    assert told.split() == ["juggleproof.symbolic.new", "juggleproof.proofs.new"]


def test_no_symbolic_link_is_committed_holds() -> None:
    assert not [path for path in committed() if path.is_symlink()]


@pytest.mark.exhaust
def test_the_sdist_has_all_that_is_committed_holds(sdist: Path) -> None:
    with tarfile.open(sdist) as archive:
        held = {name.partition("/")[2] for name in archive.getnames()}
    names = {path.relative_to(ROOT).as_posix() for path in committed()}
    assert {name for name in names if not name.startswith(".")} <= held


@pytest.mark.exhaust
def test_all_sources_and_data_are_in_the_wheel_holds(wheel: Path) -> None:
    held = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    wanted = {
        f"juggleproof/{path.relative_to(ROOT).as_posix().removeprefix('juggleproof/')}"
        for folder in (*FOLDERS, "juggleproof")
        for path in (ROOT / folder).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts and path.suffix != ".smt2"
    }
    assert held == wanted
