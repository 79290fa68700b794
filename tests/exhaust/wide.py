"""The wide cover of the sine is what a search from nothing finds.

    python -m tests.exhaust.wide 3/24     # each stored box of the third of 24 shares is searched
    python -m tests.exhaust.wide cover    # the cover is made again, and asks the store first

Where both hold, a search from nothing comes to the stored files, to the byte: the cover tries the
same boxes, and what it finds for each is stored, or it finds nothing.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from unittest import mock

from juggleproof.certificates.sine.checker import CERTIFICATES, STATEMENTS, check_line
from juggleproof.sine import cover
from juggleproof.sine.cover import Tried, box_of, try_box
from juggleproof.sine.search import find_certificate
from juggleproof.sine.stored import WIDE, wide_rectangles


def stored_lines() -> list[str]:
    """The stored certificates."""
    return (WIDE / CERTIFICATES).read_text(encoding="utf-8").splitlines()


def tried_by_store(lines: list[str]) -> dict[cover.Box, Tried]:
    """What a search that knows these lines makes of their boxes; none that is rejected."""
    proved = [(line, one) for line in lines if (one := check_line(line)[0]) is not None]
    return {box: Tried(box, line, one, 0) for line, one in proved for box in [box_of(one)]}


def differing_boxes(lines: list[str]) -> list[str]:
    """The boxes of stored certificates for which the search finds another, or none."""
    found = tried_by_store(lines)
    rejected = [f"{len(lines) - len(found)} lines are rejected"] * (len(lines) > len(found))
    return rejected + [
        f"the search finds another certificate, or none, for {box}"
        for box, one in found.items()
        if try_box(find_certificate, box).line != one.line
    ]


def differing_files(lines: list[str]) -> list[str]:
    """The stored files that the cover does not come to, where each box that has a stored line is
    known by it, and each other box is searched.
    """
    known = tried_by_store(lines)

    def first_known(search: cover.Search, box: cover.Box) -> Tried:
        return known.get(box) or try_box(search, box)

    with tempfile.TemporaryDirectory() as folder, mock.patch.object(cover, "try_box", first_known):
        left = [
            str(box) for one in cover.cover(wide_rectangles(), Path(folder)) for box in one.left
        ]
        return [f"{box} is left" for box in left] + [
            f"{name} is not what the cover comes to"
            for name in (STATEMENTS, CERTIFICATES)
            if Path(folder, name).read_bytes() != (WIDE / name).read_bytes()
        ]


def main(share: str) -> int:
    """Asks for a share of the boxes, or for the cover; returns 1 where something differs."""
    lines = stored_lines()
    if share == "cover":
        differ = differing_files(lines)
    else:
        place, shares = map(int, share.split("/"))
        differ = differing_boxes(lines[place - 1 :: shares])
    print("".join(f"certificates/sine/wide: {line}\n" for line in differ), end="")
    return int(bool(differ))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
