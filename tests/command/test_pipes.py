"""A named pipe in place of a file is refused at once, in one line: to open one waits for ever."""

from __future__ import annotations

import os
import re
import shutil
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from juggleproof.sine.stored import STORE
from juggleproof.statements.store import CERTIFICATES, STATEMENTS
from tests.command.running import run

SINE = "certify sine --alpha 0.05 --gamma 3.10 --jobs 1 --store own.certificates"
CLAIM = (
    "from juggleproof import always, claim, reals\nx, = reals('x')\n"
    "@claim('mine')\ndef one():\n    '''A square.'''\n    return always(x * x >= 0)\n"
)
SCRIPT = "(declare-const x Real)(assert (< (* x x) 0))(check-sat)\n"
FILES = (
    "stability pipe",
    "stability pipe.map",
    "stability pipe.py",
    "certify pipe.py",
    "certify pipe.smt2",
    "explain mine pipe.py",
    "export coq pipe.py",
    "export coq pipe.smt2",
    "simulate part --e 0.7 --mu 0.08 --orientation --shape pipe.csv",
)
FOLDERS = (
    ("check own.certificates", STATEMENTS),
    ("certify mine.py --store own.certificates", STATEMENTS),
    ("certify mine.py --jobs 1 --store own.certificates", CERTIFICATES),
    ("certify mine.py --jobs 2 --store own.certificates", CERTIFICATES),
    ("certify mine.smt2 --store own.certificates", STATEMENTS),
    ("certify mine.smt2 --store own.certificates", CERTIFICATES),
    (SINE, STATEMENTS),
    (SINE, CERTIFICATES),
    ("export coq own.certificates", STATEMENTS),
    ("bound x^2 --box x=0..1 --width 1/2 -o own.certificates", STATEMENTS),
)


@pytest.fixture(autouse=True)
def ended() -> Iterator[None]:
    """What waits is interrupted."""

    def stop(*_: object) -> None:
        raise TimeoutError("it waits")

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(100)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("command", FILES)
def test_rejects_a_pipe_as_file(tmp_path: Path, command: str) -> None:
    (name,) = re.findall(r"pipe\S*", command)
    os.mkfifo(tmp_path / name)
    done = run(*command.split(), cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"juggleproof: {name}: is no plain file; name one that is\n"


@pytest.mark.parametrize(("command", "name"), FOLDERS)
def test_rejects_a_pipe_in_a_folder(tmp_path: Path, command: str, name: str) -> None:
    folder = tmp_path / "own.certificates"
    folder.mkdir()
    (tmp_path / "mine.py").write_text(CLAIM)
    (tmp_path / "mine.smt2").write_text(SCRIPT)
    if command == SINE:
        shutil.copy(STORE / CERTIFICATES, folder)
        (folder / name).unlink(missing_ok=True)
    elif name == CERTIFICATES:
        (folder / STATEMENTS).write_text("statement mine/main\nforall x\nshow x*x >= 0\n")
    os.mkfifo(folder / name)
    done = run(*command.split(), cwd=tmp_path)
    assert done.returncode == 2, done
    assert re.fullmatch(
        rf"juggleproof: [^\n]*own.certificates/{re.escape(name)}[^\n]*; name [^\n]+\n", done.stderr
    )
