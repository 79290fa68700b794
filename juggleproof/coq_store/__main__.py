"""Writes the store as files of Coq: `python -m juggleproof.coq_store FOLDER`."""

from __future__ import annotations

import argparse
from pathlib import Path

from juggleproof.coq_store.files import FILES, export, share_of, write
from juggleproof.statements.store import DEFAULT, Store


def main() -> None:
    """Writes the files, and prints how many statements of each class are in them."""
    parser = argparse.ArgumentParser(prog="python -m juggleproof.coq_store")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--store", type=Path, default=DEFAULT)
    parser.add_argument(
        "--share", type=int, default=1, metavar="N", help="one statement in N, by digest"
    )
    parser.add_argument(
        "--place", type=int, default=0, metavar="K", help="which of the shares, from 0 to N - 1"
    )
    parser.add_argument("--files", type=int, default=FILES, metavar="M", help="write M files")
    parsed = parser.parse_args()
    if not (parsed.files > 0 and 0 <= parsed.place < parsed.share):
        parser.error("--place is from 0 to one less than --share, and --files at least 1")
    store = Store(parsed.store)
    exported = export(store, share_of(store.texts, parsed.share, parsed.place))
    write(exported, parsed.folder, parsed.files)
    print("\n".join(exported.table()))


if __name__ == "__main__":
    main()
