"""Parts of the stored folder, which are read sooner than the whole."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

from juggleproof.judging.run import FINDINGS, findings_in
from juggleproof.statements.store import CERTIFICATES, DEFAULT, STATEMENTS, canonical


def part_of_store(folder: Path, is_kept: Callable[[str], bool]) -> Path:
    """A new folder with what is stored of the claims that are kept, and with all definitions."""
    folder.mkdir()
    blocks = list[str]()
    for block in (DEFAULT / STATEMENTS).read_text(encoding="utf-8").split("\n\n"):
        claim = re.match(r"statement ([^/]*)/", block)
        if is_kept(claim[1]) if claim else "\ndefine " in block:
            blocks.append(block.strip("\n"))
    (folder / STATEMENTS).write_text("\n\n".join(blocks) + "\n", encoding="utf-8")
    lines = (DEFAULT / CERTIFICATES).read_bytes().splitlines(keepends=True)
    own = [line for line in lines if is_kept(json.loads(line)[0].split("/")[0])]
    (folder / CERTIFICATES).write_bytes(b"".join(own))
    findings = {name: one for name, one in findings_in(DEFAULT).items() if is_kept(name)}
    (folder / FINDINGS).write_bytes(canonical(findings))
    return folder
