"""What the page tells of the part-orienting scene: results of `simulate part`, kept beside the
records of runs while the sources are the same.

They are simulated, not proved; a report never computes them, so that it needs neither numba nor the
time.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from proofs import cache

if TYPE_CHECKING:
    from scenes.part.onsets import Table
    from scenes.part.setting import Scene

SWEEP = (
    Path(__file__).resolve().parents[2] / "scenes" / "part" / "sweep.json"
)  # where e and mu of the scene come from
HEADS = ("along the table", "paper", "median onset", "16 to 84 %", "chaotic", "censored")
SEED, AMPLITUDES = 1, "peak"
Lines = Sequence[Sequence[str]]


@dataclass(frozen=True)
class Results:
    """Table I and what belongs to it, in words: its rows as `HEADS` says, the rules they are judged
    by, assumptions (name, value, standing, why).
    """

    run: str
    rows: Lines
    rules: Sequence[str]
    assumed: Lines
    differs: Sequence[str]
    misfit: str
    still: str
    figure: Mapping[
        str, str
    ]  # slug, title, caption, alt and svg; empty where matplotlib was absent


def is_of_the_report(setting: Scene, found: Table, amplitudes: str, seed: int) -> bool:
    """Whether a run of table I is the one that the report tells: nothing chosen, (e, mu) of the
    stored sweep, full ensembles.
    """
    from scenes.errors import SceneError
    from scenes.part.onsets import ENSEMBLES, HORIZON
    from scenes.part.setting import scene
    from scenes.part.sweeping import chosen, recorded

    try:
        pair = chosen(recorded())
    except SceneError:  # no sweep is stored, or none that can be read
        return False
    wanted = scene(
        e=pair.e, mu=pair.mu, A_x=setting.A_x, f_x=setting.f_x
    )  # table I has its own vibrations along the table
    return (setting, amplitudes, seed) == (wanted, AMPLITUDES, SEED) and all(
        (len(row.chaotic), row.horizon) == (ENSEMBLES, HORIZON) for row in found.rows
    )


def results(setting: Scene, found: Table, amplitudes: str) -> Results:
    """A run in words, with figure 2 and the still table of the same scene."""
    from proofs.command import part_tables
    from scenes.part.assumptions import assumptions, discrepancies
    from scenes.part.split import in_words, no_vibration
    from scenes.part.sweeping import misfit

    first = found.rows[0]
    return Results(
        f"{len(first.chaotic)} ensembles of 91 blocks for each row, {first.horizon:g} s each",
        [[*part_tables.line(row)] for row in found.rows],
        [*part_tables.RULES],
        [
            [one.name, one.value, one.standing, one.why]
            for one in assumptions(setting, amplitudes, True)
        ],
        discrepancies(found.rows),
        f"{misfit(found):.3f}",
        in_words(no_vibration(setting)),
        figure_two(setting),
    )


def figure_two(setting: Scene) -> dict[str, str]:
    """Figure 2 with what is said beside it; nothing where matplotlib is absent."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        return {}
    from scenes.figures.drawing import svg
    from scenes.part import picture
    from scenes.part.frames import frames
    from scenes.part.grid import ANGLES

    shaken = picture.as_in_figure_two(setting)
    seen = frames(shaken, ANGLES, picture.TIMES)
    return {
        "slug": picture.SLUG,
        "title": picture.TITLE,
        "caption": picture.caption(shaken, seen),
        "alt": picture.alt(shaken, seen),
        "svg": svg(picture.drawn(shaken, seen), picture.SLUG).decode("utf-8"),
    }


def keep_results(setting: Scene, found: Table, amplitudes: str, seed: int) -> bool:
    """Keeps what the report tells of a run of table I, where it is the report's; whether it is."""
    if cache.folder() is None or not is_of_the_report(setting, found, amplitudes, seed):
        return False
    cache.keep(key(), [asdict(results(setting, found, amplitudes))])
    return True


def kept_results() -> Results | None:
    """What a run kept under the sources and the sweep as they are; None where there is no such
    run.
    """
    records = cache.load(key()) if cache.folder() else []
    try:
        return Results(**records[0])
    except (IndexError, TypeError):
        return None


def key() -> str:
    """Under which results are kept: a digest of the sources, the stored sweep and the libraries
    that compute and draw.
    """
    sweep = hashlib.sha256(SWEEP.read_bytes()).hexdigest() if SWEEP.is_file() else ""
    return "part-" + cache.key(
        sweep,
        cache.version_of("numba"),
        cache.version_of("matplotlib"),
        packages=(*cache.SOURCES, "scenes"),
    )
