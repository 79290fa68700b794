"""The trap of the scene, which holds for every alpha, is certified by the checker: it is mapped
into itself and every state of it strikes.
"""

from __future__ import annotations

from pathlib import Path

from juggleproof.proofs.command.main import run

CLAIM = '''from juggleproof.proofs import always, claim, reals

a, x, w = reals("a x w")


@claim("trap")
def the_trap_is_invariant():
    """The image of the trap under f1 lies in the trap."""
    above, after = a * (w - x), 2 - a * w
    trap = [a > 0, a < 1, x >= 0, x < w, a * w < 1, {third}]
    kept = (a * after < 1) & (a * (2 - a * after) < 1)
    return always((above >= 0) & (above < after) & kept, given=trap)
'''


def certified(third: str, folder: Path) -> int:
    path = folder / "trap.py"
    path.write_text(CLAIM.format(third=third), encoding="utf-8")
    return run(["certify", str(path), "--routes", "exact", "--jobs", "1"])


def test_trap_is_invariant_holds(tmp_path: Path) -> None:
    assert certified("a * (2 - a * w) < 1", tmp_path) == 0


def test_trap_is_invariant_fails_without_its_third_condition(tmp_path: Path) -> None:
    assert certified("w > 0", tmp_path) == 1
