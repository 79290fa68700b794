"""The pictures of `juggleproof simulate juggler --picture`, and the lines printed with them."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

from rich.console import Console

from juggleproof.command.outputs import clear, progress, written_aside
from juggleproof.reports.tables import draw
from juggleproof.scenes.juggler import picture
from juggleproof.scenes.juggler.compiled_map import brief
from juggleproof.scenes.juggler.limits import UNDECIDED, Limits, limits
from juggleproof.scenes.juggler.starts import Scene


def orbit(setting: Scene, periods: int, units: str, path: Path) -> int:
    """Draws ball and table against time."""
    return _written(picture.orbit(setting, periods, units), path)


def basin(setting: Scene, units: str, path: Path) -> int:
    """Draws the basins of the periodic orbits over a grid."""
    picture.grid_of(setting)
    found = _followed([setting.alpha], setting)
    counts = found.counts()
    rows = [
        (_called(found, place), str(count), picture.percent(count, counts.total()))
        for place, count in sorted(counts.items(), key=lambda one: (-one[1], one[0]))
    ]
    print(f"alpha = {brief(setting.alpha)}: {picture.how(found)}")
    draw(("tends to", "states", "share"), rows, Console(highlight=False))
    return _written(picture.basin(setting, found, units), path)


def bifurcation(alphas: Sequence[Fraction], setting: Scene, units: str, path: Path) -> int:
    """Draws the limits of the orbits of the starts at each alpha; there are at least two alphas."""
    found = _followed(alphas, setting)
    print(
        f"{len(alphas)} alpha, from {brief(alphas[0])} to {brief(alphas[-1])}: {picture.how(found)}"
    )
    equal = sorted((word, k) for k, word in enumerate(found.words) if len(word) == 1)
    unequal = [k for k, word in enumerate(found.words) if len(word) > 1]
    rows = []
    for name, places in [
        *((_called(found, k), [k]) for _, k in equal),
        (f"unequal flights, {len(unequal)} words", unequal),
        ("undecided", [UNDECIDED]),
    ]:
        span = found.span(places)
        if span is not None:
            rows.append((name, *map(brief, span)))
    draw(("tends to", "orbits", "from alpha", "to alpha"), rows, Console(highlight=False))
    return _written(picture.bifurcation(setting, found, units), path)


def _called(found: Limits, place: int) -> str:
    return "undecided" if place == UNDECIDED else picture.name(found.words[place])


def _followed(alphas: Sequence[Fraction], setting: Scene) -> Limits:
    found = limits(alphas, setting.starts, progress())
    clear()
    return found


def _written(drawn: bytes, path: Path) -> int:
    with written_aside(path) as file:
        file.write(drawn)
    print(f"{path}: written")
    return 0
