"""Error against seconds, both logarithmic, as SVG; matplotlib is optional."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from importlib.util import find_spec
from io import BytesIO

from benchmarks.bench.methods import Method
from benchmarks.bench.table import Results

ABSENT = "no plots: matplotlib is absent (pip install matplotlib)"
LOOKS = {
    "certificate": ("o", "-"),
    "rigorous": ("s", "--"),
    "unchecked": ("^", ":"),
    "no proof": ("x", ":"),
}
FLOOR = 1e-20  # where an error of 0, or one below it, is drawn


def can_plot() -> bool:
    """Whether matplotlib is there."""
    return find_spec("matplotlib") is not None


def plot(title: str, methods: Sequence[Method], results: Results, truth: Fraction) -> bytes:
    """The plot: a line a method, its warm seconds across, its errors upwards; filled marks and full
    lines are certificates.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    with rc_context({"svg.hashsalt": "bench", "svg.fonttype": "path"}):
        figure = Figure(figsize=(7.2, 4.8), layout="constrained")
        axes = figure.add_subplot()
        for method in methods:
            own = [
                one
                for one in results.get(method.name, {}).values()
                if one.answer is not None and one.seconds
            ]
            mark, line = LOOKS[method.worth]
            if own:
                errors = [
                    max(float(one.answer.error(truth)), FLOOR)
                    for one in own
                    if one.answer is not None
                ]
                axes.loglog(
                    [one.seconds or 0.0 for one in own],
                    errors,
                    marker=mark,
                    linestyle=line,
                    markersize=4,
                    linewidth=1,
                    label=f"{method.title} ({method.worth})",
                )
        axes.set(
            xlabel="seconds, warm, with check",
            ylabel=f"error (0 drawn at {FLOOR:.0e})",
            title=title,
        )
        axes.grid(True, which="major", linewidth=0.3)
        if axes.lines:
            figure.legend(loc="outside right upper", fontsize=7, frameon=False)
        written = BytesIO()
        figure.savefig(written, format="svg", metadata={"Date": None})
        return written.getvalue()
