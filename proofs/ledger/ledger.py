"""Load the ledger; check that claims that exist, or a reason from the closed list, settle every
item in order.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from proofs.ledger.reasons import REASONS, REASONS_WITH_KEY, UNPRINTED
from proofs.ledger.scan import KINDS, Item

ROWS = Path(__file__).with_name("rows.tsv")
COLUMNS = ("key", "line", "kind", "digest", "claims", "reason")
KEY = re.compile(r"((?:\d|[AB])(?:\.\d){0,2})-([a-z])(\d{2,})", re.ASCII)
LINE = re.compile(r"[1-9]\d*", re.ASCII)
DIGEST = re.compile(r"[0-9a-f]{16}", re.ASCII)


class LedgerError(ValueError):
    """What is wrong with the ledger, in one line that names the row and the mend."""


@dataclass(frozen=True)
class Row:
    """One item of the paper and what settles it: exactly one of `claims` and `reason` is not
    empty.
    """

    key: str
    line: int
    kind: str
    digest: str
    claims: tuple[str, ...] = ()
    reason: str = ""

    @property
    def section(self) -> str:
        """The section that the key names.

        >>> Row("A.3.1-d04", 694, "display", "0" * 16, ("sA.3.1-35",)).section
        'A.3.1'
        """
        return self.key.rpartition("-")[0]


def load_ledger(path: Path = ROWS) -> list[Row]:
    """The rows of the ledger in the paper's order, checked as far as the ledger alone allows."""
    lines = path.read_text(encoding="utf-8").split("\n")
    if lines[0].split("\t") != list(COLUMNS):
        raise LedgerError(f"{path.name}: the first line must name the columns {', '.join(COLUMNS)}")
    if lines[-1]:
        raise LedgerError(
            f"{path.name}: the last row does not end with a newline; the file may be cut short"
        )
    rows = [_row(line, f"{path.name}:{number}") for number, line in enumerate(lines[1:-1], start=2)]
    check_rows(rows)
    return rows


def check_rows(rows: Sequence[Row]) -> None:
    """Raise unless the rows are settled, in order, and every reason is from the closed list."""
    if not rows:
        raise LedgerError("the ledger has no rows: rebuild it from the paper")
    _check_order(rows)
    settled: dict[str, Row] = {row.key: row for row in rows}
    earlier: set[str] = set()
    for row in rows:
        if bool(row.claims) == bool(row.reason):
            fault = "claims and a reason" if row.claims else "neither claims nor a reason"
            raise LedgerError(f"{row.key}: the row has {fault}; give exactly one of the two")
        if len(set(row.claims)) < len(row.claims):
            raise LedgerError(f"{row.key}: a claim is named twice; name each once")
        if row.reason:
            _check_reason(row, settled, earlier)
        earlier.add(row.key)


def check_claims(rows: Iterable[Row], register: Collection[str]) -> None:
    """Raise unless the rows name registered claims only, and every registered claim that the paper
    prints has a row.
    """
    named: set[str] = set()
    for row in rows:
        for claim in row.claims:
            if claim not in register:
                raise LedgerError(
                    f"{row.key}: no claim is called {claim}; write the claim or correct the row"
                )
            named.add(claim)
    for claim in sorted(set(register) - named - set(UNPRINTED)):
        raise LedgerError(
            f"the claim {claim} stands in no row of the ledger: add it to the row of what it judges"
        )
    for claim in sorted(named & set(UNPRINTED)):
        raise LedgerError(
            f"the claim {claim} has a row although it is listed as unprinted: take it off one of"
            " the two"
        )


def check_against_paper(rows: Sequence[Row], items: Sequence[Item]) -> None:
    """Raise unless key, line, kind and digest of the rows are those of the items that the paper's
    text holds.
    """
    for row, item in zip(
        rows, items, strict=False
    ):  # a difference in length is told below, once the rest agrees
        for name in ("key", "line", "kind", "digest"):
            held, found = getattr(row, name), getattr(item, name)
            if held != found:
                raise LedgerError(
                    f"{row.key}: the ledger holds {name} {held} where the paper has {found};"
                    " rescan it"
                )
    if len(rows) != len(items):
        raise LedgerError(
            f"the ledger has {len(rows)} rows but the paper has {len(items)} items: rescan it"
        )


def _row(line: str, place: str) -> Row:
    cells = line.split("\t")
    if len(cells) != len(COLUMNS):
        raise LedgerError(f"{place}: {len(cells)} columns instead of {len(COLUMNS)}")
    key, number, kind, digest, claims, reason = cells
    if not LINE.fullmatch(number):
        raise LedgerError(f"{place}: {number!r} is no line number")
    if not DIGEST.fullmatch(digest):
        raise LedgerError(f"{place}: {digest!r} is no digest of sixteen hexadecimal digits")
    if claims != " ".join(claims.split()):
        raise LedgerError(f"{place}: the claims must be separated by single spaces")
    return Row(key, int(number), kind, digest, tuple(claims.split()), reason)


def _check_order(rows: Sequence[Row]) -> None:
    """Keys count upward within section and kind, sections are not torn apart, lines never go
    back.
    """
    counts: dict[tuple[str, str], int] = {}
    section, line, closed = "", 0, set[str]()
    for row in rows:
        if not (key := KEY.fullmatch(row.key)):
            raise LedgerError(
                f"{row.key!r} is no key: write section, hyphen, letter of the kind and number"
            )
        if KINDS.get(row.kind) != key[2]:
            raise LedgerError(
                f"{row.key}: the key's letter does not stand for the kind {row.kind!r}"
            )
        if row.section != section:
            closed.add(section)
            section = row.section
        if section in closed:
            raise LedgerError(
                f"{row.key}: section {section} was already closed; keep the rows in the paper's"
                " order"
            )
        expected = counts[section, row.kind] = counts.get((section, row.kind), 0) + 1
        if int(key[3]) != expected:
            raise LedgerError(
                f"{row.key}: the next {row.kind} of section {section} is number {expected}"
            )
        if row.line < line:
            raise LedgerError(
                f"{row.key}: line {row.line} comes after line {line}; keep the rows in the paper's"
                " order"
            )
        line = row.line


def _check_reason(row: Row, settled: dict[str, Row], earlier: set[str]) -> None:
    name, _, key = row.reason.partition(" ")
    if name not in REASONS and name not in REASONS_WITH_KEY:
        raise LedgerError(
            f"{row.key}: the reason {name!r} is not in the closed list of proofs/ledger/reasons.py"
        )
    if name in REASONS:
        if key:
            raise LedgerError(f"{row.key}: the reason {name!r} takes nothing after it")
    elif key not in settled:
        raise LedgerError(f"{row.key}: {name} needs the key of another row, and {key!r} is none")
    elif not settled[key].claims:
        raise LedgerError(f"{row.key}: {name} {key}, but that row has no claims either")
    elif key not in earlier:
        raise LedgerError(f"{row.key}: {name} {key}, but that row comes later")
