"""`juggleproof simulate` loads nothing that its scene does not need, and pictures alone load
matplotlib.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

LIBRARIES = {"sympy", "mpmath", "flint", "z3", "highspy", "numba", "matplotlib", "jinja2"}
LIBRARIES |= {"pandas", "pyarrow", "scipy"}
SHORT = "--horizon 0.1 --ensembles 1"
PART = f"--e 0.7 --mu 0.08 {SHORT}"
NEEDS = {
    "juggler --alpha 3/10 --state x=1,w=1": {"sympy", "mpmath", "flint"},
    "juggler --alpha 1/2 --state x=1,w=1 --picture orbit -o F.svg": {
        "sympy",
        "mpmath",
        "flint",
        "matplotlib",
    },
    "table --alpha 0.05 --gamma 3": set[str](),
    "table --alpha 0.05 --gamma 3 --picture orbit -o F.svg": {"matplotlib"},
    f"part {PART} --orientation --parts 2 -o F.svg": {"numba", "matplotlib"},
    f"part {PART}": {"numba"},
    f"part {PART} --orientation --parts 2 -o F.csv": {"numba"},
}
CODE = """
import sys
from juggleproof.command.main import run
code = run(sys.argv[1:])
print(*(name for name in sys.modules if name.startswith("juggleproof.scenes.")))
print("juggleproof.certificates.sine" in sys.modules)
print(code, *{name.partition(".")[0] for name in sys.modules})
"""


@pytest.mark.parametrize(
    "command",
    [
        pytest.param(one, marks=[pytest.mark.exhaust] * ("-o" in one or one[:4] == "part"))
        for one in NEEDS
    ],
)
def test_a_scene_loads_nothing_that_it_does_not_need_holds(command: str, tmp_path: Path) -> None:
    needed = NEEDS[command]
    for library in needed:
        pytest.importorskip(library)
    done = subprocess.run(
        [sys.executable, "-c", CODE, "simulate", *command.split()],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    *_, scenes, certificates, loaded = done.stdout.splitlines()
    code, *libraries = loaded.split()
    assert code == "0" and LIBRARIES & {*libraries} == needed
    other = {"juggler", "part", "table"} - {command.split()[0]}
    assert certificates == "False"
    assert not [one for one in scenes.split() if one.split(".")[2] in other]
