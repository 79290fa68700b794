"""The graph of shares with their intervals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from juggleproof.scenes.figures.drawing import Title, axes, on_white, spaced, styled, ticks
from juggleproof.scenes.figures.lines import straight
from juggleproof.scenes.figures.look import B1


@styled
def shares(
    slug: str,
    places: Sequence[float],
    found: Sequence[tuple[float, float, float]],
    label: str,
    title: Title,
    names: Mapping[float, str] | None = None,
    mark: tuple[float, str] | None = None,
) -> bytes:
    """Shares, with the low and the high end of their intervals, over places, which have names or
    are numbers; and a mark at one of them.
    """
    step = min(np.diff(places), default=1.0)
    across = (places[0] - step, places[-1] + step)
    plane = axes((560, 280), 20, across, (0, 1), title)
    plane.frame(names or ticks(spaced(*across)), ticks(spaced(0, 1)), label, "share of parts", 32)
    if mark is not None:
        plane.line(
            [straight((mark[0], 0.0), (mark[0], 1.0))], "mark", linewidth=0.7, linestyle=(0, (4, 3))
        )
        plane.text((mark[0], 1.0), mark[1], (4, -7), ha="left", fontsize=9)
    plane.line(
        [straight((x, low), (x, high)) for x, (_, low, high) in zip(places, found)],
        "intervals",
        edgecolor=B1.colour,
    )
    plane.dots([(x, share) for x, (share, _, _) in zip(places, found)], "shares", colour=B1.colour)
    return on_white(plane.figure, slug)
