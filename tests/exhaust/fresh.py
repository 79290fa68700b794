"""Claims searched anew: what is found has the verdicts of the register.

    python -m tests.exhaust.fresh CLAIM ..

Prints a line for each claim: its stage, its seconds, and `passed`, or `failed` above what differs.
The claims that they may use statements of are loaded too, and these statements are taken from the
store.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from juggleproof.judging.claims import claims_in
from juggleproof.judging.judgement import Judgement
from juggleproof.judging.register import differences, load_register, registered
from juggleproof.judging.run import Options, run
from juggleproof.statements.store import DEFAULT
from tests.exhaust.sources import Sources
from tests.exhaust.stages import Stages


def searched(names: Sequence[str]) -> list[tuple[str, float, str]]:
    """(claim, its part of the CPU seconds of all, what differs from the register or is rejected) of
    each claim.
    """
    claims = claims_in(Stages(Sources()).modules_of(names))
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder, "store")
        shutil.copytree(DEFAULT, store)
        done = run(claims, Options(store, jobs=1, fresh=True, revote=True, only=tuple(names)))
    after = {claim.id: entry(judged) for claim, judged in zip(done.claims, done.judgements)}
    wrong = {one.claim: str(one) for one in differences(load_register(), after, partial=True)}
    for name, reason in done.rejected:
        wrong.setdefault(name.split("/")[0], f"the checker rejects {name}: {reason}")
    rate = time.process_time() / (sum(done.seconds.values()) or 1)
    return [(name, rate * done.seconds[name], wrong.get(name, "")) for name in names]


def entry(judged: Judgement) -> dict[str, str]:
    """What the register has of a claim that is judged so."""
    sharp = [
        (f"{part.rstrip('.')}: " if part else "") + one.text for part, one in judged.sharp.items()
    ]
    return registered(
        judged.verdict.word,
        judged.verdict.detail,
        judged.correction["text"] if judged.correction else "",
        "; ".join(dict.fromkeys(sharp)),
    )


def main(names: Sequence[str]) -> int:
    """Searches the claims; returns 1 where one is not as registered."""
    found = searched(names)
    for name, seconds, why in found:
        print(f"fresh/{name}", f"{seconds:.3f}", "failed" if why else "passed", sep="\t")
        print(why, end="\n" if why else "")
    return int(any(why for _, _, why in found))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
