"""The part-orienting scene in reports: the tables that `simulate part` prints, and the results that
are kept for the page.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib.util import find_spec
from pathlib import Path

from rich.console import Console

from juggleproof.judging import report_cache
from juggleproof.reports.tables import draw
from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body
from juggleproof.scenes.part.ensemble import EnsembleRun, frames, in_words, no_vibration
from juggleproof.scenes.part.layout import ANGLES
from juggleproof.scenes.part.onsets import (
    ENSEMBLES,
    HORIZON,
    OnsetRow,
    OnsetTable,
    discrepancies,
)
from juggleproof.scenes.part.readings import (
    AMPLITUDES,
    BANDWIDTH,
    ONSETS,
    SCATTER,
    AlikeReadings,
    ReadingOutcome,
    as_good,
    assumptions,
    chosen,
    likelihood,
    most_likely_point,
    recorded,
)
from juggleproof.scenes.part.setting import Scene

# -------------------------------------------------------------------------------------------------
# The tables that `juggleproof simulate part` prints.

POINT_HEADS = (
    "face amplitudes    phases        e     mu   log-likelihood: last, first, stopped;"
    "   median onset of the six rows in s (chaotic ensembles)"
)

RULES = (
    (
        "median: of the onsets; the onset of an ensemble is the last time at which one of its"
        " blocks is nearer to upright than to lying."
    ),
    (
        "chaotic: ensembles in which blocks pass both ways between upright and lying in the second"
        " half of the run; a row is, if more than half are."
    ),
    "censored: ensembles that have not settled at the end of the run.",
)

LIKELIHOOD = (
    "of the paper's one run of each row, summed over the rows: the part of ensembles that are"
    f" chaotic, or the density of ln(onset) at the print by normal kernels of width {BANDWIDTH:g},"
    " with one ensemble more that is spread over all"
)

RULE_NAMES = (
    "last: the onset is the last time at which a block is upright; first: the first at which none"
    " is; stopped: the same where the run is stopped then."
)


def _console() -> Console:
    return Console(highlight=False)


def seconds(value: float, horizon: float) -> str:
    """The text of an onset, or `> horizon` where the run ends before it."""
    return f"> {horizon:g}" if math.isinf(value) else f"{value:.2f}"


def line(row: OnsetRow) -> tuple[str, ...]:
    """A row of table I: vibration, the paper's onset, median or `chaotic`, 16 to 84 percent, and
    the numbers of chaotic and of censored ensembles.
    """
    parts = [seconds(row.quantile(part), row.horizon) for part in (0.5, 0.16, 0.84)]
    verdict = "chaotic" if row.is_chaotic() else f"{parts[0]} s"
    return (
        f"{row.frequency:g} Hz {1000 * row.amplitude:g} mm",
        "chaotic" if row.paper is None else f"{row.paper:g} s",
        verdict,
        f"{parts[1]} to {parts[2]}",
        str(sum(row.chaotic)),
        str(row.censored()),
    )


def table(computed: OnsetTable, setting: Scene, amplitudes: str) -> None:
    """Prints table I beside the paper's, its assumptions, and the rows that differ."""
    count = len(computed.rows[0].chaotic)
    print(
        f"Table I: from when on all blocks lie; {count} ensembles of 91 blocks,"
        f" {computed.rows[0].horizon:g} s each.  Simulated: no certificate."
    )
    draw(
        ("along the table", "paper", "median", "16 to 84 %", "chaotic", "censored"),
        [line(row) for row in computed.rows],
        _console(),
    )
    for rule in RULES:
        print(rule)
    print()
    known = assumptions(setting, amplitudes)
    draw(
        ("assumed", "value", "", "why"),
        [(one.name, one.value, one.standing, one.why) for one in known],
        _console(),
    )
    print()
    differing = discrepancies(computed.rows)
    print("differs from the paper:" if differing else "no row differs from the paper")
    for one in differing:
        print(f"  {one}")
    print(f"log-likelihood {likelihood(computed.rows):.2f}: {LIKELIHOOD}")
    print()
    draw(("stored readings, log-likelihood", *ONSETS), followed(), _console())
    print(RULE_NAMES)


def violations(run: EnsembleRun, setting: Scene) -> bool:
    """Prints how often guarantees of the impact law and of depth were broken; returns whether any
    was.
    """
    broken = run.violations()
    deepest = -float(run.notes[:, body.LEAST_GAP].min())
    print(
        f"{int(run.notes[:, body.IMPACTS].sum())} impacts: "
        + ", ".join(f"{count} {name}" for name, count in broken.items())
    )
    print(
        f"deepest corner {deepest:.3g} m below the table, tolerance {setting.tolerance:g} m;"
        " largest energy taken away by coming to lie"
        f" {float(run.notes[:, body.LARGEST_REMOVED].max()):.3g} J/kg"
    )
    return any(broken.values())


def point(one: ReadingOutcome) -> str:
    """The line of a point of a sweep."""
    rows = "  ".join(
        f"{'-' if m is None else f'{m:.2f}':>6} ({c})" for m, c in zip(one.last, one.chaotic)
    )
    what = one.reading
    return (
        f"{what.face}  {what.amplitudes:12} {what.phase_x:4g},{what.phase_y:4g} {what.e:6.3f}"
        f" {what.mu:6.3f}  {' '.join(f'{lnl:7.2f}' for lnl in one.likelihoods)}  {rows}"
    )


def likeliest(stages: Sequence[AlikeReadings]) -> str:
    """A line on the most likely point of a sweep, the way to read its onset, and the number of
    points that are as likely within scatter.
    """
    best = most_likely_point(stages)
    rule = ONSETS[best.likelihoods.index(best.likelihood)]
    return (
        f"most likely: {name_of(best)}, onset by the {rule} time, log-likelihood"
        f" {best.likelihood:.2f}; {len(as_good(stages))} of {len(stages[-1].points)} points within"
        f" {SCATTER:g}"
    )


def followed() -> list[list[str]]:
    """The readings of the last stored stage, the likeliest first: name, and the logarithm of the
    likelihood by each way to read an onset.
    """
    return [
        [name_of(one), *(f"{lnl:.2f}" for lnl in one.likelihoods)]
        for one in sorted(recorded()[-1].points, key=lambda one: -one.likelihood)
    ]


def name_of(one: ReadingOutcome) -> str:
    """A reading in words."""
    what = one.reading
    return (
        f"{what.face} cm, {what.amplitudes}, phases {what.phase_x:g} and {what.phase_y:g} degrees,"
        f" e = {what.e:g}, mu = {what.mu:g}"
    )


# -------------------------------------------------------------------------------------------------
# The results of `simulate part` for the page; they are kept in the cache while the sources are the
# same.
#
# They are simulated, not proved.  A report never computes them, since this needs numba and takes
# long.

SWEEP = (
    Path(__file__).resolve().parents[1] / "scenes" / "part" / "sweep.json"
)  # where e and mu of the scene come from
HEADS = ("along the table", "paper", "median onset", "16 to 84 %", "chaotic", "censored")
SEED = 1
Lines = Sequence[Sequence[str]]


@dataclass(frozen=True)
class TableResults:
    """The results of table I as texts: its rows (columns `HEADS`), the rules for judging them, the
    assumptions (name, value, standing, why), the logarithm of its likelihood, and the likeliest
    stored readings with theirs.
    """

    run: str
    rows: Lines
    rules: Sequence[str]
    assumed: Lines
    differs: Sequence[str]
    likelihood: str
    meaning: str
    readings: Lines
    names: str
    still: str
    figure: Mapping[
        str, str
    ]  # slug, title, caption, alt and svg; empty where matplotlib was absent


def is_of_the_report(setting: Scene, computed: OnsetTable, amplitudes: str, seed: int) -> bool:
    """Whether a run of table I is the one that the report shows: the likeliest stored reading, full
    ensembles, and no other choices.
    """
    try:
        likely = chosen(recorded()).reading
    except SceneError:  # no readable sweep is stored
        return False
    # table I takes the vibrations along the table from its rows
    wanted = likely.scene(A_x=setting.A_x, f_x=setting.f_x)
    return (setting, amplitudes, seed) == (wanted, likely.amplitudes, SEED) and all(
        (len(row.chaotic), row.horizon) == (ENSEMBLES, HORIZON) for row in computed.rows
    )


def results(setting: Scene, computed: OnsetTable, amplitudes: str) -> TableResults:
    """The results of a run as texts, with figure 2 and the still table of the same scene."""
    first = computed.rows[0]
    return TableResults(
        f"{len(first.chaotic)} ensembles of 91 blocks for each row, {first.horizon:g} s each",
        [[*line(row)] for row in computed.rows],
        [*RULES],
        [[one.name, one.value, one.standing, one.why] for one in assumptions(setting, amplitudes)],
        discrepancies(computed.rows),
        f"{likelihood(computed.rows):.2f}",
        LIKELIHOOD,
        followed(),
        RULE_NAMES,
        in_words(no_vibration(setting)),
        figure_two(setting, AMPLITUDES[amplitudes]),
    )


def figure_two(setting: Scene, peak: float) -> dict[str, str]:
    """Figure 2 with title, caption and alternative text; empty where matplotlib is absent."""
    if find_spec("matplotlib") is None:
        return {}
    from juggleproof.scenes.part import picture

    shaken = picture.as_in_figure_two(setting, peak)
    seen = frames(shaken, ANGLES, picture.TIMES)
    return {
        "slug": picture.SLUG,
        "title": picture.TITLE,
        "caption": picture.caption(shaken, seen),
        "alt": picture.alt(shaken, seen),
        "svg": picture.as_svg(picture.drawn(shaken, seen)).decode("utf-8"),
    }


def keep_results(setting: Scene, computed: OnsetTable, amplitudes: str, seed: int) -> bool:
    """Keeps the results of a run of table I if the report shows it; returns whether it does."""
    if report_cache.folder() is None or not is_of_the_report(setting, computed, amplitudes, seed):
        return False
    report_cache.keep(key(), [asdict(results(setting, computed, amplitudes))])
    return True


def kept_results() -> TableResults | None:
    """The results that a run with the present sources and sweep kept; None where there is no such
    run.
    """
    records = report_cache.load(key()) if report_cache.folder() else []
    try:
        return TableResults(**records[0])
    except (IndexError, TypeError):
        return None


def key() -> str:
    """The key under which results are kept: a digest of the sources, the stored sweep and the
    libraries that compute and draw.
    """
    sweep = hashlib.sha256(SWEEP.read_bytes()).hexdigest() if SWEEP.is_file() else ""
    return "part-" + report_cache.key(
        sweep,
        report_cache.version_of("numba"),
        report_cache.version_of("matplotlib"),
    )
