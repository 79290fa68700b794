"""Lines of certificates: two that prove their box, and what makes of them lines that do not."""

from __future__ import annotations

import json
import zlib
from base64 import b64decode, b64encode
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from typing import Any

from juggleproof.sine.search import find_certificate, line_of

Q = Fraction
Line = dict[str, Any]


@cache
def proved(name: str) -> str:
    """A line that proves its box: of one pair, of alpha from 0 on, or with cells that are cut."""
    boxes = {
        "pair": ((Q(1, 20), Q(1, 20)), (Q(197, 1000), Q(197, 1000)), 256, 8),
        "plastic": ((Q(0), Q(1, 1000)), (Q(21, 100), Q(21, 100)), 256, 16),
        "cut": ((Q(1, 20), Q(1, 20)), (Q(26, 100), Q(26, 100)), 256, 16),
    }
    found = find_certificate(*boxes[name])
    if found.certificate is None:
        raise ValueError(found.reason)
    return line_of(found.certificate)


def line(name: str = "pair", **fields: Any) -> str:
    """That line with other fields: a value, or what makes it of the old one."""
    data = json.loads(proved(name))
    for key, value in fields.items():
        data[key] = value(data[key]) if callable(value) else value
    return json.dumps(data)


def put(*values: tuple[int, object]) -> Callable[[list[Any]], list[Any]]:
    """Other values at places of a list."""

    def changed(old: list[Any]) -> list[Any]:
        new = list(old)
        for place, value in values:
            new[place] = value
        return new

    return changed


def packed(ranks: bytes) -> str:
    return b64encode(zlib.compress(ranks)).decode("ascii")


def ranked(change: Callable[[bytearray], object]) -> Callable[[str], str]:
    """Ranks after a change."""

    def changed(old: str) -> str:
        ranks = bytearray(zlib.decompress(b64decode(old)))
        change(ranks)
        return packed(bytes(ranks))

    return changed


def rows(number: int) -> Callable[[str], str]:
    """Ranks of so many rows of "pair", all 1."""
    return ranked(lambda one: one.__setitem__(slice(None), bytes([1]) * (256 * number)))


def cut_once(ranks: bytearray, times: int) -> None:
    """Cuts a cell, then one of its parts, and so on."""
    ranks[ALOFT] = 255
    for left in reversed(range(times)):
        ranks += bytes([255 if left else 1, 1, 1, 1])


def cut_across(ranks: bytearray, times: int) -> None:
    """Cuts a cell of each column, then a part of each column, and so on."""
    columns = 256
    ranks[::11] = bytes([255]) * columns
    for left in reversed(range(times)):
        ranks += bytes([255 if left else 1, 1] * (2 * columns))
        columns *= 2


def refuting(kind: str, alpha: str, g: str | list[str], *grid: int) -> str:
    """A line that refutes at a pair, or for an interval of g."""
    ends = g if isinstance(g, list) else [g, g]
    return json.dumps({"refutes": kind, "alpha": alpha, "g": ends, "grid": list(grid)})


A, G, T, K = "alpha", "g", "grid", "ranks"
BOUNCE = 0 * 11 + 7  # the cell that holds the bounce, on the grid of "pair": 256, 8, 11
REST = 10 * 11  # a cell of its arc, and one outside of that
ALOFT = 60 * 11 + 3
OTHER = 60 * 22 + 3  # on that of "plastic"
MAY_REST = 120 * 22 + 3
PART = 256 * 22 + 12  # on that of "cut"

# (defect, line, reason)
REJECTED: list[tuple[str, Callable[[], str], str]] = [
    ("alpha upside down", lambda: line(alpha=["1/20", "1/21"]), "alpha is not within"),
    ("alpha of 1", lambda: line(alpha=["1/20", "1"]), "alpha is not within"),
    ("g upside down", lambda: line(g=["1/5", "1/6"]), "g is not within"),
    ("g of 0", lambda: line(g=["0", "1/5"]), "g is not within"),
    ("g beyond 1", lambda: line(g=["1/5", "11/10"]), "g is not within"),
    ("too few columns", lambda: line(grid=[8, 8, 11]), "the columns are not"),
    ("columns that are no power of two", lambda: line(grid=[255, 8, 11]), "the columns are not"),
    ("too many columns", lambda: line(grid=[1 << 16, 8, 11]), "the columns are not"),
    ("columns below 0", lambda: line(grid=[-256, 8, 11]), "the columns are not"),
    ("columns and rows below 0", lambda: line(grid=[-256, 8, -11]), "the columns are not"),
    ("rows that are no power of two", lambda: line(grid=[256, 9, 11]), "the rows of a unit"),
    ("no rows of a unit", lambda: line(grid=[256, 0, 11]), "the rows of a unit"),
    ("too many rows of a unit", lambda: line(grid=[256, 16384, 11]), "the rows of a unit"),
    ("no rows", lambda: line(grid=[256, 8, 0]), "the rows are not"),
    ("too many rows", lambda: line(grid=[16, 8, 8193]), "the rows are not"),
    ("too many cells", lambda: line(ranks=packed(bytes((1 << 21) + 1))), "too many cells"),
    ("ranks of a part of its cells", lambda: line(grid=[512, 8, 11]), "not one rank for each"),
    ("too many cells that are cut", lambda: line(ranks=ranked(lambda one: cut_across(one, 5))),
     "too many cells"),
    ("cells that are cut too often", lambda: line(ranks=ranked(lambda one: cut_once(one, 8))),
     "the columns are not"),
    ("a cell that is cut without parts",
     lambda: line(ranks=ranked(lambda one: one.__setitem__(ALOFT, 255))), "not one rank for each"),
    ("a cell of the last row that is cut without parts",
     lambda: line(ranks=ranked(lambda one: one.__setitem__(ALOFT + 7, 255))),
     "not one rank for each"),
    ("a part too few", lambda: line("cut", ranks=ranked(lambda one: one.pop())), "not one rank"),
    ("a part too many",
     lambda: line("cut", ranks=ranked(lambda one: one.append(1))), "not one rank"),
    ("a part of too low a rank",
     lambda: line("cut", ranks=ranked(lambda one: one.__setitem__(PART, 1))),
     "a rank does not fall"),
    ("rows below the strip",
     lambda: line(grid=[256, 8, 10], ranks=rows(10)), "the rows do not reach"),
    ("a trap without width", lambda: line(trap=put((0, 0))), "the trap is empty"),
    ("a trap as wide as a period", lambda: line(trap=put((0, 33))), "the trap is empty"),
    ("a trap at rest", lambda: line(trap=put((1, 0))), "the trap is empty"),
    ("a trap without rows", lambda: line(trap=put((2, 7))), "the trap is empty"),
    ("a trap beyond the rows", lambda: line(trap=put((2, 12))), "the trap is beyond"),
    ("a trap above the bounce", lambda: line(trap=put((1, 8), (2, 9))), "the bounce is not inside"),
    ("a trap below the bounce", lambda: line(trap=put((1, 6), (2, 7))), "the bounce is not inside"),
    ("a trap below that of the least alpha", lambda: line("plastic", trap=put((1, 14), (2, 15))),
     "the bounce is not inside"),
    ("a trap above that of the greatest alpha", lambda: line("plastic", trap=put((1, 16))),
     "the bounce is not inside"),
    ("a trap below that of the least alpha of a wide box",
     lambda: line(alpha=["1/20", "1/5"], grid=[256, 8, 16], ranks=rows(16),
                  trap=put((1, 6), (2, 7))),
     "the bounce is not inside"),
    ("a trap above that of the greatest alpha of a wide box",
     lambda: line(alpha=["1/20", "1/5"], grid=[256, 8, 16], ranks=rows(16)),
     "the bounce is not inside"),
    ("a bounce on the lower edge of its trap",
     lambda: line(alpha=["1/7", "1/7"], grid=[256, 8, 16], ranks=rows(16)),
     "the bounce is not inside"),
    ("a bounce on the upper edge of its trap", lambda: line(alpha=["0", "0"]),
     "the bounce is not inside"),
    ("a trap where the table rises", lambda: line(trap=put((0, 32))), "the table is too slow"),
    ("a plastic trap where the ball rests", lambda: line("plastic", trap=put((0, 16))),
     "the table is too slow"),
    ("no weight", lambda: line(trap=put((3, "0"))), "the weight is not positive"),
    ("too much weight", lambda: line(trap=put((3, "20"))), "the map does not contract"),
    ("too little weight", lambda: line(trap=put((3, "1/2"))), "the map does not contract"),
    ("an arc that is empty", lambda: line(arc=[97, 97]), "the rest arc is empty"),
    ("an arc that begins before 0", lambda: line(arc=[-159, 6]), "the rest arc is empty"),
    ("an arc that begins after a period", lambda: line(arc=[256, 400]), "the rest arc is empty"),
    ("an arc as long as a period", lambda: line(arc=[97, 353]), "the rest arc is empty"),
    ("an arc that begins late", lambda: line(arc=put((0, 100))), "the rest arc leaves out"),
    ("an arc that ends early", lambda: line(arc=put((1, 240))), "the rest arc leaves out"),
    ("a rank too few", lambda: line(ranks=ranked(lambda one: one.pop())), "not one rank for each"),
    ("a rank too many", lambda: line(ranks=ranked(lambda one: one.append(1))),
     "not one rank for each"),
    ("no rank of rest", lambda: line(ranks=ranked(lambda one: one.__setitem__(97 * 11, 0))),
     "R has rank 0"),
    ("a rank in the trap", lambda: line(ranks=ranked(lambda one: one.__setitem__(BOUNCE, 1))),
     "a cell of the trap has a rank"),
    ("a trap too narrow", lambda: line(trap=put((0, 1))), "a flight leaves the trap"),
    ("a trap too wide", lambda: line(trap=put((0, 12))), "the map does not contract"),
    ("another rank of rest", lambda: line(ranks=ranked(lambda one: one.__setitem__(5 * 11, 9))),
     "a rank does not fit its cell"),
    ("a cell aloft of rank 0", lambda: line(ranks=ranked(lambda one: one.__setitem__(ALOFT, 0))),
     "a rank does not fit its cell"),
    ("a cell aloft of rank 1", lambda: line(ranks=ranked(lambda one: one.__setitem__(ALOFT, 1))),
     "a rank does not fall"),
    ("a cell where a plastic ball rests, of low rank",
     lambda: line("plastic", ranks=ranked(lambda one: one.__setitem__(MAY_REST, 1))),
     "a cell where the ball may rest has no higher rank"),
    ("a longer arc than its ranks", lambda: line(arc=put((1, 270))), "a rank does not fit"),
    ("another g", lambda: line(g=["1/4", "1/4"]), "the map does not contract"),
    ("another alpha", lambda: line(alpha=["1/10", "1/10"]), ""),
    ("a box too wide", lambda: line(alpha=["1/20", "1/10"]), ""),
    # multipliers and saddles
    ("a multiplier within", lambda: refuting("multiplier", "1/20", "289/1000", 256, 16),
     "no multiplier is below -1"),
    ("multipliers, some within", lambda: refuting("multiplier", "1/20", ["289/1000", "1"], 16, 16),
     "no multiplier is below -1"),
    ("a multiplier of alpha 1", lambda: refuting("multiplier", "1", "1", 256, 16),
     "alpha or g is out of range"),
    ("multipliers upside down", lambda: refuting("multiplier", "1/20", ["1/2", "2/5"], 16, 16),
     "alpha or g is out of range"),
    ("a saddle of a plastic ball", lambda: refuting("saddle", "0", "1/10", 256, 16),
     "a ball with alpha = 0"),
    ("a saddle on a line of the grid", lambda: refuting("saddle", "1/50", "1/100", 64, 16),
     "the saddle is not within one column"),
    ("saddles of many columns", lambda: refuting("saddle", "1/5", ["1/10", "1/5"], 256, 16),
     "the saddle is not within one column"),
    ("a saddle that may be caught", lambda: refuting("saddle", "1/20", "78/1000", 256, 16),
     "it may land in two places"),
    ("a saddle that is virtual", lambda: refuting("saddle", "1/20", "197/1000", 256, 16),
     "it does not land one period later"),
    ("a saddle that may touch", lambda: refuting("saddle", "3/10", "13/100", 16, 4),
     "it may touch the table before"),
    ("a saddle on too fine a grid", lambda: refuting("saddle", "1/5", "1/5", 256, 4096),
     "the rows are not"),
    ("a saddle on a grid too large", lambda: refuting("saddle", "1/5", "1/5", 65536, 16),
     "the columns are not"),
    ("a saddle of alpha 1", lambda: refuting("saddle", "1", "1/5", 256, 16), "alpha is not within"),
    # what is written
    ("no line", lambda: "", "not a line of certificates"),
    ("a list", lambda: "[]", "not a line of certificates"),
    ("no end", lambda: "[" * 100_000, "not a line of certificates"),
    ("a number too long to read", lambda: '{"alpha": ' + "9" * 5000 + "}", "not a line"),
    ("a key too many", lambda: line(more=1), "not a line of certificates"),
    ("a key that stands twice", lambda: line()[:-1] + ', "arc": [97, 262]}', "a key stands twice"),
    ("an unknown refutation", lambda: refuting("graze", "1/5", "1/5", 256, 16),
     "an unknown kind of refutation"),
    ("a refutation of a list", lambda: line()[:1] + '"refutes": [], "alpha": "0", "g": ["0", "0"],'
     ' "grid": [1, 1]}', "an unknown kind of refutation"),
    ("a float", lambda: line(alpha=[0.05, 0.05]), "not an exact number"),
    ("a decimal", lambda: line(alpha=["0.05", "0.05"]), "not an exact number"),
    ("a sign", lambda: line(alpha=["-1/20", "1/20"]), "not an exact number"),
    ("a denominator of 0", lambda: line(alpha=["1/0", "1/20"]), "not an exact number"),
    ("digits of another script", lambda: line(alpha=["1/20", "1/2٠"]), "not an exact number"),
    ("a number of 31 digits", lambda: line(alpha=["0", "1/" + "2" * 31]), "not an exact number"),
    ("a weight that is a number", lambda: line(trap=put((3, 1))), "not an exact number"),
    ("a whole number as a float", lambda: line(grid=[256.0, 8, 11]), "not a whole number"),
    ("a truth value", lambda: line(trap=put((0, True))), "not a whole number"),
    ("a whole number too large", lambda: line(arc=[97, 1 << 40]), "not a whole number"),
    ("numbers in a text", lambda: line(alpha="01"), "not a list"),
    ("numbers as keys", lambda: line(alpha={"1/20": 0, "1/19": 0}), "not a list"),
    ("an end too few", lambda: line(alpha=["1/20"]), "malformed (ValueError)"),
    ("an end too many", lambda: line(arc=[97, 262, 263]), "malformed (ValueError)"),
    ("an empty trap", lambda: line(trap=[]), "malformed (ValueError)"),
    ("ranks that are no text", lambda: line(ranks=7), "malformed (TypeError)"),
    ("ranks that are no base64", lambda: line(ranks="*"), "malformed (Error)"),
    ("ranks that are not compressed", lambda: line(ranks="AAAA"), "malformed (error)"),
    ("ranks beyond all memory", lambda: line(ranks=packed(bytes(1 << 24))), "too many cells"),
    ("ranks cut short", lambda: line(ranks=lambda old: old[: len(old) // 8 * 4]), "not one rank"),
]  # fmt: skip

# (name, line): what is true of a certificate in another form
ACCEPTED: list[tuple[str, Callable[[], str]]] = [
    ("a pair", line),
    ("alpha from 0", lambda: line("plastic")),
    ("cells that are cut", lambda: line("cut")),
    ("a smaller box", lambda: line("plastic", alpha=["0", "1/2000"])),
    ("another weight", lambda: line(trap=put((3, "3/2")))),
    ("a higher rank", lambda: line(ranks=ranked(lambda one: one.__setitem__(10, 254)))),
    ("a real saddle", lambda: refuting("saddle", "1/20", "7/100", 256, 16)),
    ("a real saddle near its graze", lambda: refuting("saddle", "1/20", "78/1000", 4096, 128)),
    ("a real saddle of another alpha", lambda: refuting("saddle", "1/10", "15/100", 256, 16)),
    ("a real saddle that coexists", lambda: refuting("saddle", "3/10", "13/100", 32, 8)),
    ("real saddles", lambda: refuting("saddle", "1/5", ["2/10", "2001/10000"], 256, 16)),
    ("a multiplier", lambda: refuting("multiplier", "1/20", "290/1000", 256, 16)),
    ("multipliers", lambda: refuting("multiplier", "0", ["8/25", "7"], 0, 0)),
]
