"""What settles one statement, and a folder of them."""

from __future__ import annotations

import json
import os
import re
import stat
import sys
from collections.abc import Callable
from typing import Literal, NoReturn, TypeVar

from .algebra import MAX_WORK, Kind, Rejected, Work, require
from .language import Context, Known, Statement, Unfolding, read_statements
from .orbits import check_orbit_rule
from .rules import Hint, State, check_sharp, find, prove

MAX_FILE = 16 << 20
MAX_STATEMENTS = 2 << 20  # a syntax tree takes some 500 bytes for a letter
# For all statements of a folder.  The stored ones take 7 * 10**7 units, a third, in 6 seconds.
# The dearest units that were found, of products of two 14th powers in four variables, take half a
# microsecond to one: so a folder of such ends within 100 to 200 seconds.
MAX_FOLDER_WORK = 2 * 10**8
MAX_REFUSED = 1000  # lines of certificates, after which no more are read
STATEMENTS = "statements.txt"
CERTIFICATES = "certificates.jsonl"

Check = Callable[[Statement, Hint, Known, Known, Work], tuple[str, Rejected | None]]
T = TypeVar("T")


# ------------------------------------------------------------ one statement


def settle(
    statement: Statement,
    certificate: Hint,
    known: Known,
    statements: Known,
    work: Work,
) -> str:
    """The outcome: {"unknown": why}, {"refuted": found}, {"certified": proof} or, for all but sharp
    and the orbit rules, {.., "point": found}.

    A certified statement carries a point that meets its premises, so that it says something.  A
    refuted one has a counterexample.
    """
    keys = sorted(certificate) if isinstance(certificate, dict) else []
    if keys == ["unknown"]:
        return "unknown"
    if statement.kind != "universal":
        require(keys == ["certified"], Kind.KEYS, keys)  # such a statement is never refuted
        if statement.kind == "sharp":
            check_sharp(statement, certificate["certified"], known, statements, work)
        else:
            check_orbit_rule(statement, certificate["certified"], known, work)
        return "certified"
    state = State(Context(work=work))
    named = {statement.name: statement}
    if keys == ["refuted"]:
        # else a line could use a root that stands below it, or divide by what a value makes nonzero
        Unfolding(statement, Context(work=work))
        find(state, certificate["refuted"], known, "counterexample", named, {})
        return "refuted"
    # without a point, premises that contradict each other would certify anything
    require(keys == ["certified", "point"], Kind.KEYS, keys)
    prove(statement, certificate["certified"], known, work=work)
    find(state, certificate["point"], known, "point", named, {})
    return "certified"


def check_one(
    statement: Statement,
    certificate: Hint,
    known: Known,
    earlier: Known,
    work: Work | None = None,
) -> tuple[str, Rejected | None]:
    """(outcome, None), or ("rejected", why).

    known: the certified statements before it, by name; earlier: all statements before it; work: the
    meter that it spends from.
    """
    return verdict(settle, statement, certificate, known, earlier, work or Work())


def verdict(
    check: Callable[..., T], *arguments: object
) -> tuple[T | Literal["rejected"], Rejected | None]:
    """(what the check returns, None), or ("rejected", why): whatever is wrong with a certificate is
    a rejection, never a crash.
    """
    try:
        return check(*arguments), None
    except Rejected as reason:
        return "rejected", reason
    except Exception as error:
        return "rejected", Rejected(Kind.MALFORMED, type(error).__name__)


# ------------------------------------------------------------ files


def load(path: str, limit: int = MAX_FILE) -> str:
    """The text of a file of printable ASCII, whose lines end in a newline alone."""
    try:
        # a pipe or a device might never end, and opening a pipe wait for ever
        require(stat.S_ISREG(os.stat(path).st_mode), Kind.FILE, path)
        with open(path, "rb") as file:
            content = file.read(limit + 1)
    except OSError as error:
        raise Rejected(Kind.FILE, f"{path} ({type(error).__name__})") from None
    # a carriage return, or a letter that looks like another, could hide a line from who reads it
    fits = len(content) <= limit and not re.search(rb"[^\x20-\x7e\n]", content)
    require(fits, Kind.CHARACTERS, path)
    return content.decode("ascii")


def unique(pairs: list[tuple[str, Hint]]) -> dict[str, Hint]:
    """A JSON object: a key that stands twice would mean one thing to one reader, and another to
    the next.
    """
    require(len(dict(pairs)) == len(pairs), Kind.KEY_TWICE, lambda: sorted(key for key, _ in pairs))
    return dict(pairs)


def refuse(text: str) -> NoReturn:
    raise Rejected(Kind.INEXACT, text)


def read_certificate(line: str) -> tuple[str, Hint]:
    """(name, certificate) of one line, ["ID/part", {...}]."""
    try:
        data = json.loads(line, object_pairs_hook=unique, parse_float=refuse, parse_constant=refuse)
    except (ValueError, RecursionError) as error:
        raise Rejected(Kind.CERTIFICATE_LINE, error) from None
    pair = isinstance(data, list) and len(data) == 2 and isinstance(data[0], str)
    require(pair, Kind.CERTIFICATE_LINE)
    name, certificate = data
    return name, certificate


def read_certificates(text: str) -> tuple[dict[str, Hint], list[tuple[int, Rejected]]]:
    """({name: certificate}, [(line, reason)]): what the lines say, and those that are refused.

    The lines are sorted by name, and end in a newline, so that none can be added, doubled or cut
    unseen.
    """
    certificates: dict[str, Hint] = {}
    refused: list[tuple[int, Rejected]] = []
    last = ""
    lines = text.split("\n")
    if lines.pop():
        refused.append((len(lines) + 1, Rejected(Kind.CERTIFICATE_LINE, "no newline at the end")))
    for count, line in enumerate(lines, 1):
        if len(refused) > MAX_REFUSED:
            break  # what is not read certifies nothing
        try:
            name, certificate = read_certificate(line)
            require(name not in certificates, Kind.CERTIFICATE_TWICE, name)
            require(name > last, Kind.CERTIFICATE_ORDER, name)
            certificates[name] = certificate
            last = name
        except Rejected as reason:
            refused.append((count, reason))
    return certificates, refused


def check_folder(folder: str, check: Check = check_one) -> list[tuple[str, str, str]]:
    """[(name, outcome, reason)] for every statement of a folder in order, then for every line of
    certificates that is refused or has no statement.
    """
    left, work = MAX_FOLDER_WORK, Work()
    statements = read_statements(load(os.path.join(folder, STATEMENTS), MAX_STATEMENTS))
    results: list[tuple[str, str, str]] = []
    certificates: dict[str, Hint] = {}
    rest: list[tuple[str, Rejected]] = []
    try:
        certificates, refused = read_certificates(load(os.path.join(folder, CERTIFICATES)))
        rest += [(f"{CERTIFICATES}, line {count}", reason) for count, reason in refused]
    except Rejected as unread:
        rest.append((CERTIFICATES, unread))
    known: dict[str, Statement] = {}
    earlier: dict[str, Statement] = {}
    for name, statement in statements.items():
        outcome: str = "rejected"
        reason: Rejected | None = Rejected(Kind.NO_CERTIFICATE)
        if name in certificates:
            limit = min(MAX_WORK, left)
            work.refill(limit)
            outcome, reason = check(statement, certificates.pop(name), known, earlier, work)
            left -= limit - work.left
        results.append((name, outcome, str(reason) if reason else ""))
        earlier[name] = statement
        if outcome == "certified":
            known[name] = statement
    rest += [(name, Rejected(Kind.LEFT_OVER)) for name in certificates]
    return results + [(name, "rejected", str(why)) for name, why in rest]


def report(results: list[tuple[str, str, str]]) -> int:
    """Prints what is rejected, and how many statements have which outcome; 0 where every one is
    certified or refuted, else 1.
    """
    for name, outcome, reason in results:
        if outcome == "rejected":
            # ascii: a name from a certificate cannot write a line of its own
            print("rejected ", ascii(f"{name}: {reason}")[1:-1])
    counts = []
    for kind in ("certified", "refuted", "unknown", "rejected"):
        counts.append(f"{sum(outcome == kind for _, outcome, _ in results)} {kind}")
    print(f"{len(results)} statements: " + ", ".join(counts))
    return int(not results or any(outcome in ("rejected", "unknown") for _, outcome, _ in results))


def main(arguments: list[str]) -> int:
    """Checks the folder named, or the store beside this folder; the exit code."""
    beside = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "store")
    try:
        require(len(arguments) < 2, Kind.FILE, "name one folder")
        return report(check_folder(arguments[0] if arguments else beside))
    except Rejected as reason:
        print("checker:", ascii(str(reason))[1:-1], file=sys.stderr)
        return 2
