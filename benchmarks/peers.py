"""The same statements by our search with its check, and by peers: Z3, cvc5, QEPCAD B and Coq's nra; absent ones are named.

Run: python benchmarks/peers.py [--every 20] [--seconds 10].  A peer's answer is no certificate; ours is checked, and that time is counted.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from certificates import checker
from certificates.routes.questions import questions
from certificates.routes.smtlib import script
from certificates.search.budget import Budget, Exhausted
from certificates.search.certificate import search_certificate
from certificates.store import DEFAULT, Store


def ours(statement: checker.Statement, seconds: float) -> bool:
    try:
        found = search_certificate(statement, {}, Budget(int(seconds * 1_000_000)))
    except Exhausted:
        return False
    return checker.check_one(statement, found, {}, {})[0] in ("certified", "refuted")


def z3(statement: checker.Statement, seconds: float) -> bool:
    import z3 as solver

    context = solver.Context()
    one = solver.SolverFor("QF_NRA", ctx=context)
    one.set("timeout", int(seconds * 1000))
    one.add(solver.parse_smt2_string(script(statement), ctx=context))
    return str(one.check()) in ("sat", "unsat")


def cvc5(statement: checker.Statement, seconds: float) -> bool:
    with tempfile.NamedTemporaryFile("w", suffix=".smt2") as file:
        file.write(script(statement))
        file.flush()
        code = ("import cvc5,sys\ns=cvc5.Solver()\ns.setOption('tlimit',sys.argv[2])\np=cvc5.InputParser(s)\n"
                "p.setFileInput(cvc5.InputLanguage.SMT_LIB_2_6,sys.argv[1])\nm=p.getSymbolManager()\n"
                "while True:\n c=p.nextCommand()\n if c.isNull(): break\n o=c.invoke(s,m)\n print(o)")
        done = subprocess.run([sys.executable, "-c", code, file.name, str(int(seconds * 1000))], capture_output=True, text=True, check=False)
    return "sat" in done.stdout.split() or "unsat" in done.stdout.split()


def coq(statement: checker.Statement, seconds: float) -> bool:
    text = nra_goal(statement)
    if text is None:
        return False
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "goal.v"
        path.write_text(text, encoding="utf-8")
        try:
            return subprocess.run(["coqc", str(path)], capture_output=True, timeout=seconds, check=False).returncode == 0
        except subprocess.TimeoutExpired:
            return False


def nra_goal(statement: checker.Statement) -> str | None:
    """The statement as a Coq goal for nra: conjunctions of polynomial atoms imply one atom; None for other shapes."""
    story = checker.Unfolding(statement, checker.Context())
    premises = list(story.premises)
    atoms = [a for p in premises if not isinstance(p, bool) for a in (p[1] if p[0] == "and" else [p])]
    goal = story.goal(True)
    if isinstance(goal, bool) or goal[0] != "atom" or any(a[0] != "atom" for a in atoms):
        return None
    shown = [f"({story.context.show(p).replace('^', ' ^ ')} {'<>' if r == '!=' else r} 0)%R" for _, p, r in [*atoms, goal]]
    if any("/" in one for one in shown):
        return None
    names = " ".join(story.context.index)
    return ("Require Import Reals Lra Psatz.\nOpen Scope R_scope.\n"
            f"Goal forall {names} : R, {' -> '.join(shown)}.\nProof. intros. nra. Qed.\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--every", type=int, default=20, help="one statement in so many")
    parser.add_argument("--seconds", type=float, default=10.0, help="limit for each statement")
    options = parser.parse_args()
    store = Store(DEFAULT)
    chosen = [name for name in store.texts if not any(f"\n{k} " in store.texts[name] for k in ("sharp", "iterates", "exists", "integer"))]
    statements = checker.read_statements("\n\n".join(store.texts.values()))
    methods = {"juggleproof, checked": ours, "Z3": z3}
    absent = []
    try:
        import cvc5 as _  # noqa: F401
        methods["cvc5 (own process)"] = cvc5
    except ImportError:
        absent.append("cvc5 (pip install cvc5)")
    if shutil.which("coqc"):
        methods["Coq nra (own process)"] = coq
    else:
        absent.append("coqc (Debian package coq)")
    if not shutil.which("qepcad"):
        absent.append("QEPCAD B (Debian package qepcad)")
    print(f"{'method':24} {'settled':>9} {'median s':>9} {'total s':>9}")
    names = [name for name in chosen[::options.every] if questions(statements[name])]
    for title, method in methods.items():
        seconds, settled = [], 0
        for name in names:
            began = time.perf_counter()
            settled += method(statements[name], options.seconds)
            seconds.append(time.perf_counter() - began)
        print(f"{title:24} {settled:4}/{len(names):<4} {statistics.median(seconds):9.3f} {sum(seconds):9.2f}")
    print("absent: " + (", ".join(absent) or "none"))


if __name__ == "__main__":
    main()
