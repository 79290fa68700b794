"""Cells that are cut: what a certificate says of them, cell by cell, and what it costs to read."""

from __future__ import annotations

import random
import tracemalloc
from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from juggleproof.certificates.checker import Work
from juggleproof.certificates.sine.cells import (
    CUT,
    WHOLE,
    Certificate,
    greatest_rank,
    read_levels,
)
from juggleproof.certificates.sine.flights import Flights, Walk
from tests.certificates.sine.states import STEPS, box

COLUMNS, ROWS, MOST_LEVELS = 16, 3, 3
Cell = tuple[int, int, int]  # how often its like are cut; column; row


def certificate(ranks: bytes, columns: int = COLUMNS, rows: int = ROWS) -> Certificate:
    grid = box("1/20", "197/1000", columns, 1, rows)
    return Certificate(grid, 1, 1, 2, Fraction(1), (0, 1), ranks)


def cut_cells(source: random.Random) -> tuple[bytes, dict[Cell, int]]:
    """The ranks of a certificate in which some cells are cut, and of each cell that is not."""
    data, leaves = bytearray(), {}
    cells = [(i, row) for i in range(COLUMNS) for row in range(ROWS)]
    for level in range(MOST_LEVELS + 1):
        most = min(6, len(cells)) if level < MOST_LEVELS else 0
        cut = sorted(source.sample(cells, source.randrange(most + 1)))
        for i, row in cells:
            rank = CUT if (i, row) in cut else source.randrange(CUT)
            data.append(rank)
            if rank != CUT:
                leaves[level, i, row] = rank
        cells = [
            (side, half)
            for i, row in cut
            for side in (2 * i, 2 * i + 1)
            for half in (2 * row, 2 * row + 1)
        ]
    return bytes(data), leaves


@given(st.integers(0, 1 << 64))
def test_the_greatest_rank_is_that_of_all_cells_in_a_landing_holds(seed: int) -> None:
    source = random.Random(seed)
    ranks, leaves = cut_cells(source)
    levels = read_levels(certificate(ranks), Work(STEPS))
    assert leaves.keys() == {
        (number, i, row)
        for number, level in enumerate(levels)
        for i in level.cells
        for row in level.rows(i, WHOLE)
    }
    for _ in range(10):
        number = source.randrange(len(levels))
        columns, rows, last = COLUMNS << number, ROWS << number, MOST_LEVELS - number
        m, lowest = source.randrange(3 * columns), source.randrange(rows)
        highest = source.randrange(lowest - (number == 0), rows)
        # in units of the narrowest cells
        left, low, top = m % columns << last, lowest << last, highest + 1 << last
        met = [-1]
        for (level, i, row), rank in leaves.items():
            shift = MOST_LEVELS - level
            beside = i << shift < left + (1 << last) and left < i + 1 << shift
            if low < top and beside and row << shift < top and low < row + 1 << shift:
                met.append(rank)
        assert greatest_rank(levels[: number + 1], (m, lowest, highest)) == max(met)


def test_cells_take_a_few_bytes_each_however_they_are_cut_holds() -> None:
    columns, rows = 16, 256
    wide = columns * rows
    for ranks in bytes(wide), bytes([CUT]) * wide + bytes(4 * wide):
        tracemalloc.start()
        read_levels(certificate(ranks, columns, rows), Work(STEPS))
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert most < 6 * len(ranks)


def test_a_walk_that_has_not_begun_has_looked_at_no_column_holds() -> None:
    there = Flights(box("1/20", "197/1000", 256, 8, 11), Work(STEPS))
    held = [value for value in vars(Walk(there, 3)).values() if isinstance(value, (list, dict))]
    assert held == [{}, {}]
