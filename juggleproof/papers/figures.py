"""The description of a paper's figure; the function that draws it is loaded on demand."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from juggleproof.lazy import loaded

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class PaperFigure(NamedTuple):
    """A figure: its number in the paper ("" where the paper has none), the stem of its ids and file
    names, its title, its caption, and its alternative text.

    `place` is the "module:function" that draws it; `data`, if not empty, is the "module:function"
    that returns its arguments from the entries of a report.  A figure `of_verdicts` is never read
    from a cache.
    """

    number: str
    slug: str
    title: str
    caption: str
    alt: str
    place: str
    data: str = ""
    of_verdicts: bool = False

    def draw(self, entries: object = ()) -> Figure:
        """The figure, for the entries of a report."""
        given = loaded(self.data)(entries) if self.data else ()
        figure: Figure = loaded(self.place)(*given)
        return figure
