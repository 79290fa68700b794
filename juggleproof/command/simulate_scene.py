"""The scene that the options of `juggleproof simulate part` give: a reading of table I, another
part, another table.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

from juggleproof.scenes.part.drive import Harmonics, harmonics
from juggleproof.scenes.part.readings import AMPLITUDES, FACES, TableReading, chosen, recorded
from juggleproof.scenes.part.setting import Launch, Scene
from juggleproof.scenes.part.shape import Polygon, polygon
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import plain_file

OTHERS = ("vibration", "shape", "along", "away")
VIBRATION = "30:1"  # the vibration of the paper's figure 2
MOST_BYTES = 1_000_000  # bytes of a file of corners


class SceneOptions(argparse.Namespace):
    """The options that describe the scene."""

    e: str | None
    mu: str | None
    face: str | None
    amplitudes: str | None
    phase: str | None
    launch: Launch
    vibration: str | None
    shape: str | None
    along: str | None
    away: str | None
    tolerance: str
    rest_speed: str


def number(text: str, name: str) -> float:
    """A number of physics, such as 0.7, 1e-3 or 2/3."""
    try:
        return float(Fraction(text)) if len(text) <= 60 else math.nan
    except (ValueError, ZeroDivisionError, OverflowError):
        raise ClaimError(
            f"{name} = {text[:40]!r} is no number; write it as 0.7, 1e-3 or 2/3"
        ) from None


def _known(text: str, name: str, known: Mapping[str, object]) -> str:
    if text not in known:
        raise ClaimError(f"{name} {text[:40]!r}: choose from {', '.join(known)}")
    return text


def reading_of(options: SceneOptions) -> TableReading:
    """The reading of table I by the options; the likeliest stored reading has those left out."""
    likely = chosen(recorded()).reading
    along, up = likely.phase_x, likely.phase_y
    if options.phase is not None:
        first, both, second = options.phase.partition(",")
        along, up = number(first, "phase"), number(second if both else first, "phase")
    return TableReading(
        _known(options.face or likely.face, "--face", FACES),
        _known(options.amplitudes or likely.amplitudes, "--amplitudes", AMPLITUDES),
        along,
        up,
        likely.e if options.e is None else number(options.e, "e"),
        likely.mu if options.mu is None else number(options.mu, "mu"),
    )


def others(options: SceneOptions) -> list[str]:
    """The given options that choose a part, a table or a vibration other than table I's."""
    return [name for name in OTHERS if getattr(options, name) is not None]


def setting_of(options: SceneOptions, reading: TableReading) -> Scene:
    """The scene of the options under a reading."""
    if options.shape is not None and options.face is not None:
        raise ClaimError("--face and --shape do not go together; give one of them")
    frequency, amplitude = _vibration(options.vibration or VIBRATION)
    drive = _drive(options, reading)
    return reading.scene(
        options.launch,
        shape=None if options.shape is None else _shape(options.shape),
        drive=drive,
        **({"A_x": reading.peak * amplitude, "f_x": frequency} if drive is None else {}),
        tolerance=number(options.tolerance, "tolerance"),
        rest_speed=number(options.rest_speed, "rest speed"),
    )


def _vibration(text: str) -> tuple[float, float]:
    pieces = text.split(":")
    if len(pieces) != 2:
        raise ClaimError(f"--vibration {text[:40]!r} is not HERTZ:MILLIMETRES, such as 30:1")
    return number(pieces[0], "the frequency"), number(pieces[1], "the amplitude") / 1000


def _shape(text: str) -> Polygon:
    """The polygon of corners in centimetres; the text has them, or names a file that does."""
    given, name = text, "--shape"
    if not set(text) <= set("0123456789+-.,/eE \t\n"):
        given, name = _read(Path(text)), text
    corners = []
    for corner in given.split():
        pieces = corner.split(",")
        if len(pieces) != 2:
            raise ClaimError(f"{name}: {corner[:40]!r} is not X,Y; write '0,0 4,0 4,2 0,2'")
        corners.append([_exact(piece, f"{name}: {corner[:40]!r}") / 100 for piece in pieces])
    return polygon(corners)


def _exact(text: str, name: str) -> Fraction:
    """The exact number that a text writes."""
    try:
        if len(text) <= 60 and abs(float(Fraction(text))) < 1e6:
            return Fraction(text)
    except (ValueError, ZeroDivisionError, OverflowError):
        pass
    raise ClaimError(f"{name} is no corner; write numbers as 0.7, 1e-3 or 2/3")


def _drive(options: SceneOptions, reading: TableReading) -> Harmonics | None:
    """The motion of the table by --along and --away; None where neither is given.  A harmonic
    without a phase has phase 0; an axis that is not given moves as in the reading.
    """
    if options.vibration is not None and options.along is not None:
        raise ClaimError("--vibration and --along do not go together; give one of them")
    if options.along is None and options.away is None:
        return None
    along = options.along or f"{options.vibration or VIBRATION}:{reading.phase_x}"
    away = options.away or f"60:0.2:{reading.phase_y}"
    return harmonics(*(_sines(text, reading.peak) for text in (along, away)))


def _sines(text: str, peak: float) -> list[tuple[float, float, float]]:
    """The harmonics that a text writes: (metres, hertz, radians)."""
    found = []
    for one in text.split(","):
        pieces = one.split(":")
        if len(pieces) not in (2, 3):
            raise ClaimError(f"{one[:40]!r} is not HERTZ:MILLIMETRES[:DEGREES], such as 30:1:90")
        hertz, size, phase = (number(piece, "a harmonic") for piece in (*pieces, "0")[:3])
        found.append((peak * size / 1000, hertz, math.radians(phase)))
    return found


def _read(path: Path) -> str:
    """The text of a file."""
    try:
        if plain_file(path).stat().st_size > MOST_BYTES:
            raise ClaimError(f"{path}: more than {MOST_BYTES // 10**6} MB")
        return path.read_text(encoding="utf-8")
    except OSError as fault:
        raise ClaimError(f"{path}: {(fault.strerror or 'no file').lower()}") from None
    except UnicodeDecodeError:
        raise ClaimError(f"{path}: no text") from None
