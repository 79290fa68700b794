"""Table I and sweeps as files: CSV with a line an ensemble, and NumPy arrays; the same to the byte
from run to run.
"""

from __future__ import annotations

import csv
import io
from typing import BinaryIO

import numpy as np

from scenes.part import body
from scenes.part.onsets import Table

HEADS = ("f_x [Hz]", "A_x [m]", "paper [s]", "ensemble", "onset [s]", "chaotic", "censored")


def as_csv(table: Table, file: BinaryIO) -> None:
    """Writes a line for each row and ensemble; the onset is left out where the ensemble is chaotic
    or censored.
    """
    text = io.TextIOWrapper(file, encoding="utf-8", newline="", write_through=True)
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow(HEADS)
    for row in table.rows:
        for k, (onset, chaotic) in enumerate(zip(row.onsets.tolist(), row.chaotic)):
            settled = np.isfinite(onset)
            lines.writerow(
                [
                    row.frequency,
                    row.amplitude,
                    "chaotic" if row.paper is None else row.paper,
                    k,
                    repr(onset) if settled else "",
                    int(chaotic),
                    int(not settled and not chaotic),
                ]
            )
    text.detach()


def as_npz(table: Table, file: BinaryIO) -> None:
    """Writes arrays: f_x and A_x of shape (6,), paper (6,) with nan for chaotic, onset and chaotic
    (6, ensembles), and of each block, in shape

    (6, ensembles, 91), the last time near upright, the number of impacts, and its angle at the end.
    """
    rows, ensembles = table.rows, len(table.rows[0].chaotic)
    shape = (len(rows), ensembles, -1)
    arrays = {
        "f_x": np.array([row.frequency for row in rows]),
        "A_x": np.array([row.amplitude for row in rows]),
        "paper": np.array([np.nan if row.paper is None else row.paper for row in rows]),
        "onset": np.array([row.onsets for row in rows]),
        "chaotic": np.array([row.chaotic for row in rows]),
        "last_upright": table.run.notes[:, body.LAST_UPRIGHT].reshape(shape),
        "impacts": table.run.notes[:, body.IMPACTS].reshape(shape),
        "theta": table.run.states[:, body.THETA].reshape(shape),
    }
    np.savez_compressed(file, allow_pickle=False, **arrays)
