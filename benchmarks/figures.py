"""Plots as SVG, where matplotlib is installed."""

from __future__ import annotations

from importlib.util import find_spec
from io import BytesIO
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ABSENT = "no plots: matplotlib is absent (pip install matplotlib)"


def can_plot() -> bool:
    """Whether matplotlib is installed."""
    return find_spec("matplotlib") is not None


def new_figure() -> Figure:
    """An empty figure of matplotlib."""
    from matplotlib.figure import Figure

    return Figure(figsize=(7.2, 4.8), layout="constrained")


def as_svg(figure: Figure) -> bytes:
    """The figure as SVG, the same bytes each time."""
    from matplotlib import rc_context

    with rc_context({"svg.hashsalt": "bench", "svg.fonttype": "path"}):
        written = BytesIO()
        figure.savefig(written, format="svg", metadata={"Date": None})
        return written.getvalue()
