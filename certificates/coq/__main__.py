"""Writes the store as files of Coq: `python -m juggleproof.certificates.coq FOLDER`."""

from __future__ import annotations

import argparse
from pathlib import Path

from juggleproof.certificates.coq.files import export, share_of, write
from juggleproof.certificates.store import DEFAULT, Store


def main() -> None:
    """Writes the files, and prints how many statements of each class are in them."""
    parser = argparse.ArgumentParser(prog="python -m juggleproof.certificates.coq")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--store", type=Path, default=DEFAULT)
    parser.add_argument(
        "--share", type=int, default=1, metavar="N", help="one statement in N, by digest"
    )
    parsed = parser.parse_args()
    store = Store(parsed.store)
    exported = export(store, share_of(store.texts, parsed.share))
    write(exported, parsed.folder)
    print("\n".join(exported.table()))


if __name__ == "__main__":
    main()
