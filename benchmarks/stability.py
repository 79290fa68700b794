"""The maps in examples, settled by `juggleproof stability`, beside a quadratic Lyapunov function by
a semidefinite program: the outcomes, CPU seconds and bytes.

    python -m juggleproof.benchmarks.stability [--only TEXT]
    python -m juggleproof.benchmarks.stability --accept    # writes the table into docs/stability.md

The exit code is 1 if an outcome is not that in the page.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import numpy as np

from juggleproof.benchmarks.generated import DOCS, Generated
from juggleproof.benchmarks.processes import cpu_seconds
from juggleproof.map_stability.maps import Map, read_file
from juggleproof.map_stability.samples import Floats, matrices_of, region
from juggleproof.statements.cases import ANYWHERE, conjunction

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "examples"
TABLE = Generated(DOCS / "stability.md", "stability")
PEERS: dict[str, Callable[[], bool]] = {  # each fills a column, which is empty without it
    "coqc": lambda: shutil.which("coqc") is not None,
    "cvxpy": lambda: find_spec("cvxpy") is not None,
}
HEADS = ("map", "parameters", "outcome", "CPU s", "bytes", "check", "coqc", "SDP")
SAMPLES = 20  # of the parameters, for the semidefinite program
MARGIN = 1e-6  # by which A'PA has to be less than P


class Settled(NamedTuple):
    """The outcome of the command on an example, the CPU seconds and bytes that it took, and the CPU
    seconds of the bare checker and of coqc; None if there is no theorem, or no coqc.
    """

    outcome: str
    seconds: float
    size: int
    checked: float
    compiled: float | None


def examples() -> list[Path]:
    """The maps, by name."""
    return sorted(FOLDER.glob("*.map"))


def ran(*arguments: str | Path, cwd: Path | None = None) -> tuple[float, str]:
    """CPU seconds of a program, and the text that it prints.

    Raises RuntimeError if it ends with an exit code that is no answer.
    """
    began = cpu_seconds()
    done = subprocess.run(arguments, cwd=cwd, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1, 3):
        raise RuntimeError(f"{' '.join(map(str, arguments))}: {done.stderr}")
    return cpu_seconds() - began, done.stdout


def outcome_of(printed: str) -> str:
    """Verdict and sentence, from the text that `juggleproof stability` prints.

    >>> outcome_of("proved   tent: 0 is stable and attracts every state")
    'proved: 0 is stable and attracts every state'
    """
    head, _, sentence = printed.partition("\n")[0].partition(": ")
    return f"{head.rsplit(None, 1)[0]}: {sentence}"


def settled(path: Path) -> Settled:
    """Settles the example, checks its certificates by the bare checker, compiles its theorems."""
    ours = (sys.executable, "-m", "juggleproof.command.main")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        seconds, printed = ran(*ours, "stability", path, "-o", folder)
        claims = folder / f"{path.stem.replace('-', '_')}.py"
        store = claims.with_suffix(".certificates")
        size = (store / "certificates.jsonl").stat().st_size
        checked, _ = ran(sys.executable, "-I", "-S", ROOT / "certificates/checker", store)
        compiled = None
        if PEERS["coqc"]() and not printed.startswith("unknown"):
            ran(*ours, "export", "coq", claims, "-o", folder)
            compiled = 0.0
            for theorem in sorted(folder.glob("S_*.v")):
                spent, axioms = ran("coqc", "-q", theorem.name, cwd=folder)
                compiled += spent
                if not theorem.with_suffix(".vo").exists():
                    raise RuntimeError(f"coqc does not take the theorem of {path.name}: {axioms}")
    return Settled(outcome_of(printed), seconds, size, checked, compiled)


def is_stable_by_program(matrices: Floats) -> bool:
    """Whether Clarabel, through CVXPY, has a P > 0 with A'PA < P for all matrices A (count, n, n).

    The answer is in floats, and nobody checks it.
    """
    import cvxpy

    n = matrices.shape[1]
    P = cvxpy.Variable((n, n), symmetric=True)
    falls = [A.T @ P @ A << P - MARGIN * np.eye(n) for A in matrices]
    problem = cvxpy.Problem(cvxpy.Minimize(0), [P >> np.eye(n), *falls])
    try:
        problem.solve(solver=cvxpy.CLARABEL)
    except cvxpy.SolverError:  # numbers that it cannot handle
        return False
    return bool(problem.status == cvxpy.OPTIMAL)


def quadratic(system: Map) -> str:
    """At how many samples of the parameters a common quadratic Lyapunov function of all pieces is
    found, such as `20/20`; an empty text if a piece is not affine.
    """
    if not system.is_affine:
        return ""
    samples = region(system.domain, system.parameters, SAMPLES)
    count = len(next(iter(samples.values()))) if samples else 1
    n, pieces = len(system.state), len(system.pieces)
    matrices = matrices_of(system, samples, count).reshape(pieces, count, n, n)
    applying = matrices[[applies(system, guard) for guard, _ in system.pieces]]
    yes = sum(is_stable_by_program(applying[:, k]) for k in range(count))
    return f"{yes}/{count}"


def applies(system: Map, guard: str) -> bool:
    """Whether the guard holds at a sample: some cases of abs, max and min exclude each other."""
    samples = region(conjunction(system.domain, system.space, guard), system.names, SAMPLES)
    return bool(len(samples[system.state[0]]))


def row(path: Path) -> tuple[str, ...]:
    """The cells of an example, under HEADS."""
    system, done = read_file(path), settled(path)
    return (
        path.stem,
        "" if system.domain == ANYWHERE else f"`{system.domain}`",
        done.outcome,
        f"{done.seconds:.2g}",
        f"{done.size}",
        f"{done.checked:.2g}",
        "" if done.compiled is None else f"{done.compiled:.2g}",
        quadratic(system) if PEERS["cvxpy"]() else "",
    )


def line(cells: Sequence[str]) -> str:
    """A line of a table in Markdown."""
    escaped = (cell.replace("|", "\\|") for cell in cells)
    return f"| {' | '.join(escaped)} |"


def outcomes(table: str) -> dict[str, str]:
    """The outcome that a table has for each map.

    >>> outcomes(TABLE.text())["switched"]
    'proved: (0, 0) is stable and attracts every state'
    """
    rows = [text.strip("| ").split(" | ") for text in table.splitlines()[2:]]
    return {cells[0]: cells[2].replace("\\|", "|") for cells in rows}


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints the table, or writes it into the page."""
    parser = argparse.ArgumentParser(prog="python -m juggleproof.benchmarks.stability")
    parser.add_argument("--accept", action="store_true")
    parser.add_argument("--only", default="", metavar="TEXT")
    options = parser.parse_args(arguments)
    if options.only and options.accept:
        parser.error("--accept goes with the whole table")
    missing = [name for name, found in PEERS.items() if not found()]
    if missing and options.accept:
        parser.error(f"--accept: install {' and '.join(missing)}, of which the table has a column")
    lines = [line(HEADS), line(["---"] * len(HEADS))]
    print("\n".join(lines))
    for path in examples():
        if options.only not in path.stem:
            continue
        lines.append(line(row(path)))
        print(lines[-1], flush=True)
    done = "\n".join(lines)
    if options.accept:
        TABLE.write(done)
    return int(not outcomes(done).items() <= outcomes(TABLE.text()).items())


if __name__ == "__main__":
    sys.exit(main())
