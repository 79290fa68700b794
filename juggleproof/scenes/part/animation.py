"""The blocks in motion, as one HTML file that fetches nothing: a canvas with play, pause, a slider
of time, speeds and keys.

States stand in it at 60 frames a second of model time, rounded to 1e-5 m and 1e-4 rad, each as its
change since the last frame.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
from base64 import b64encode
from collections.abc import Iterable, Sequence
from concurrent.futures import Executor
from html import escape
from pathlib import Path
from typing import BinaryIO

import numpy as np

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body
from juggleproof.scenes.part.drive import Record
from juggleproof.scenes.part.ensemble import frames
from juggleproof.scenes.part.layout import COLUMNS, lying, noun, pitch, rows, vibration, ways
from juggleproof.scenes.part.setting import Array, Scene
from juggleproof.scenes.part.shape import balances

HERE = Path(__file__).parent
RATE = 60  # frames a second
LENGTH, ANGLE = 1e-5, 1e-4  # what metres and radians are rounded to
MOST_FRAMES = 3600
HORIZON = 3.0


def animation(
    setting: Scene,
    angles: Sequence[float] | Array,
    horizon: float,
    file: BinaryIO,
    executor: Executor | None = None,
) -> None:
    """Writes blocks that start at these angles, in radians, up to the horizon, in seconds; the same
    to the byte for the same states.  SceneError for a horizon or a number of blocks out of range.
    """
    rows(len(angles))
    if not 0 < horizon <= MOST_FRAMES / RATE:
        raise SceneError(
            f"horizon = {horizon:.6g} s is outside 0 .. {MOST_FRAMES / RATE:g}, which is what a"
            " file has room for"
        )
    seen = frames(
        setting, angles, np.arange(math.floor(horizon * RATE + 1e-9) + 1) / RATE, executor
    )
    file.write(page(setting, seen))


def page(setting: Scene, seen: Array) -> bytes:
    """The file, of states at 60 frames a second, shape (frames, n, 10)."""
    style, script = (
        (HERE / f"animation.{kind}").read_text(encoding="utf-8") for kind in ("css", "js")
    )
    words = vibration(setting)
    shown = {
        "title": f"{seen.shape[1]} blocks on the vibrating table",
        "vibration": escape(words[:1].upper() + words[1:]),
        "upright": ways(setting)[0],
        "lying": ways(setting)[1],
        "alt": escape(alt(setting, seen)),
        "horizon": repr((len(seen) - 1) / RATE),
        "step": repr(1 / RATE),
        "rate": str(RATE),
        "style": style,
        "script": script,
        "style_hash": digest(style),
        "script_hash": digest(script),
        "states": packed(setting, seen),
    }
    text = (HERE / "animation.html").read_text(encoding="utf-8")
    return re.sub(r"\{(\w+)\}", lambda name: shown[name[1]], text).encode()


def digest(text: str) -> str:
    """How a policy names a style or a script that may stand in the file."""
    return "sha256-" + b64encode(hashlib.sha256(text.encode()).digest()).decode()


def alt(setting: Scene, seen: Array) -> str:
    """A description for readers who do not see the picture."""
    first, last = (int((~lying(setting, one)).sum()) for one in (seen[0], seen[-1]))
    upright, lies = ways(setting)
    return (
        f"{seen.shape[1]} {noun(setting)} in rows bounce and turn on a table that vibrates: {first}"
        f" {upright} at the start, {last} after {(len(seen) - 1) / RATE:.3g} s; all others are"
        f" {lies}."
    )


def packed(setting: Scene, seen: Array) -> str:
    """All that the script draws, as JSON."""
    places = [
        np.rint(seen[:, :, column] / unit).astype(np.int64)
        for column, unit in ((body.X, LENGTH), (body.Y, LENGTH), (body.THETA, ANGLE))
    ]
    X, Y, theta = (
        b64encode(varied(np.diff(place, axis=0, prepend=0).ravel().tolist())).decode()
        for place in places
    )
    sides = balances(setting.polygon(), setting.tilt)
    return json.dumps(
        {
            "blocks": seen.shape[1],
            "frames": len(seen),
            "rate": RATE,
            "columns": COLUMNS,
            "pitch": round(pitch(setting), 6),
            "corners": setting.polygon().corners,
            "sides": [angle for angle, _ in sides],
            "ways": ways(setting),
            "lies": [below in setting.lying() for _, below in sides],
            "length": LENGTH,
            "angle": ANGLE,
            "X": X,
            "Y": Y,
            "theta": theta,
            "table": table(setting, len(seen)),
        },
        separators=(",", ":"),
    )


def table(setting: Scene, count: int) -> dict[str, object]:
    """How the table moves: sines (metres, hertz, radians) along it and away from it, or of a record
    its places at the frames.
    """
    drive = setting.drive
    if isinstance(drive, Record):
        p, times = setting.parameters().tolist(), [k / RATE for k in range(count)]
        return {
            "recorded": True,
            "x": [round(body.table_place(p, t), 7) for t in times],
            "y": [round(body.table_height(p, t), 7) for t in times],
        }
    along = [(setting.A_x, setting.f_x, setting.phase_x)] if drive is None else drive.along
    away = [(setting.A_y, setting.f_y, setting.phase_y)] if drive is None else drive.away
    return {"x": along, "y": away}


def varied(numbers: Iterable[int]) -> bytes:
    """Whole numbers in as few bytes as each needs: seven bits a byte, the low ones first; n >= 0
    stands as 2 n, n < 0 as -2 n - 1.

    >>> varied([0, -1, 64, -64]).hex()
    '000180017f'
    """
    encoded = bytearray()
    for number in numbers:
        rest = 2 * number if number >= 0 else -2 * number - 1
        while rest > 127:
            encoded.append(rest & 127 | 128)
            rest >>= 7
        encoded.append(rest)
    return bytes(encoded)
