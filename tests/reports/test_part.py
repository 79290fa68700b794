"""What the page shows of the part on the vibrating table: a kept run in words, named as
simulated; and one line where there is none.
"""

from __future__ import annotations

from dataclasses import asdict, replace
from functools import cache
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from juggleproof.judging import report_cache as records
from juggleproof.reports import part
from juggleproof.reports.contents import Entry
from juggleproof.reports.page import build
from juggleproof.reports.part import HEADS, TableResults, kept_results
from tests.reports.browser import Element, read_html, read_whole
from tests.reports.runs import contents

SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8'
    ' 6"><style>*{stroke:#222222}</style><path d="M0 0L8 6"/></svg>'
)
MADE = TableResults(
    "2 ensembles of 91 blocks for each row, 1 s each",
    [["15 Hz 2 mm", "4 s", "3.60 s", "3.10 to 4.20", "0", "1"]],
    ["a rule"],
    [
        ["friction mu", "0.08", "inferred", "the most likely"],
        ["block", "1 x 2 x 4 cm", "given", "section 2.1"],
    ],
    ["15 Hz 4 mm: chaotic in the paper, 0 of 2 ensembles are chaotic here"],
    "-1.39",
    "of the paper's one run of each row",
    [["2x4 cm, peak, phases 0 and 0 degrees, e = 0.7, mu = 0.08", "-4.02", "-3.91", "-3.89"]],
    "last: a rule",
    "Without vibration 27 blocks end upright.",
    {
        "slug": "fig-2",
        "title": "Figure 2. Blocks",
        "caption": "After 3 s, 91 of 91.",
        "alt": "Three grids of 91 rectangles.",
        "svg": SVG,
    },
)


def section_of(scene: TableResults | None) -> Element:
    page = read_whole(
        build(replace(contents(), entries=few(), rules=(), derivations=()), (), scene).decode(
            "utf-8"
        )
    )
    return next(one for one in page.all("section") if one.attributes["id"] == "part-scene")


@cache
def few() -> tuple[Entry, ...]:
    return tuple(entry for entry in contents().entries if entry.claim.section == "part")[:2]


def words(element: Element) -> str:
    return " ".join(element.text().split())


def test_results_stand_beside_the_papers_holds() -> None:
    section = section_of(MADE)
    table, fits, assumed = section.all("table")
    assert [one.text() for one in list(fits.all("tr"))[1].all("th", "td")] == [*MADE.readings[0]]
    assert [one.text() for one in table.all("th")][: len(HEADS)] == [*HEADS]
    cells = [one.text() for one in table.all("tr", "th", "td") if one.tag != "tr"][len(HEADS) :]
    assert cells == [*MADE.rows[0]]
    assert [[one.text() for one in row.all("th", "td")] for row in list(assumed.all("tr"))[1:]] == [
        *map(list, MADE.assumed)
    ]
    for sentence in (
        MADE.run,
        MADE.rules[0],
        MADE.differs[0],
        MADE.likelihood,
        MADE.meaning,
        MADE.names,
        MADE.still,
        MADE.figure["caption"],
    ):
        assert sentence in words(section)
    assert "rules" not in words(section).split("Where it differs")[1].split("Without")[
        0
    ] and "In no row" not in words(section)
    assert "In no row." in words(section_of(replace(MADE, differs=[])))


def test_scene_is_said_to_be_simulated_and_the_impact_law_linked_holds() -> None:
    for scene in (MADE, None):
        section = section_of(scene)
        assert "simulated too, and not proved" in words(
            section
        ) and "2 of 2 hold, with certificates" in words(section)
        assert [one.attributes["href"] for one in section.all("a")] == ["#section-part"]


def test_impact_law_is_called_proved_fails_without_verdicts_that_hold() -> None:
    first, *rest = few()
    lost = replace(
        contents(), entries=(replace(first, verdict="unknown"), *rest), rules=(), derivations=()
    )
    assert "1 of 2 hold, with certificates" in words(read_html(build(lost).decode("utf-8")))
    none = replace(contents(), entries=contents().entries[:1], rules=(), derivations=())
    assert "hold, with certificates" not in words(read_html(build(none).decode("utf-8")))


def test_figure_tells_itself_holds() -> None:
    picture = next(iter(section_of(MADE).all("svg")))
    assert picture.attributes["aria-labelledby"] == "fig-2-title fig-2-desc"
    assert (
        next(picture.all("desc")).text() == MADE.figure["alt"]
        and "currentColor" in next(picture.all("style")).text()
    )
    assert not list(section_of(replace(MADE, figure={})).all("figure"))


def test_how_to_make_it_is_told_where_nothing_is_kept_holds() -> None:
    section = section_of(None)
    assert not list(section.all("table", "figure"))
    assert "juggleproof simulate part" in words(section) and "pip install numba" in words(section)


def test_words_are_escaped_holds() -> None:
    hostile = "<script>alert('x')</script> & </style>"
    section = section_of(
        replace(
            MADE, still=hostile, rows=[[hostile] * 6], figure={**MADE.figure, "caption": hostile}
        )
    )
    assert not list(section.all("script")) and hostile in words(section)


def test_results_are_kept_under_the_sources_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(records.VARIABLE, str(tmp_path))
    assert kept_results() is None
    records.keep(part.key(), [asdict(MADE)])
    small = replace(contents(), entries=few(), rules=(), derivations=())
    assert kept_results() == MADE and build(small, (), kept_results()) == build(small, (), MADE)
    monkeypatch.setattr(part, "SWEEP", tmp_path / "other.json")
    (tmp_path / "other.json").write_text("{}", encoding="utf-8")
    assert kept_results() is None


@pytest.mark.parametrize("found", [[], [{}], [{"run": "", "more": ""}]])
def test_rejects_records_that_are_no_results(
    found: list[records.Record], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(records.VARIABLE, str(tmp_path))
    records.keep(part.key(), found)
    assert kept_results() is None


def run_of(ensembles: int, horizon: float) -> Any:
    """What is asked of a run of table I: ensembles and length of its rows."""
    row = SimpleNamespace(chaotic=(False,) * ensembles, horizon=horizon)
    return SimpleNamespace(rows=[row, row])


def test_rejects_a_run_of_table_one_that_is_not_the_reports() -> None:
    likely, whole = part.chosen(part.recorded()).reading, run_of(part.ENSEMBLES, part.HORIZON)
    setting = likely.scene(A_x=1e-3, f_x=30.0)
    assert likely.amplitudes == "peak-to-peak"
    assert part.is_of_the_report(setting, whole, "peak-to-peak", part.SEED)
    for other in (
        (replace(setting, mu=0.1), whole, "peak-to-peak", part.SEED),
        (setting, run_of(part.ENSEMBLES - 1, part.HORIZON), "peak-to-peak", part.SEED),
        (setting, run_of(part.ENSEMBLES, part.HORIZON / 2), "peak-to-peak", part.SEED),
        (setting, whole, "peak", part.SEED),
        (setting, whole, "peak-to-peak", part.SEED + 1),
    ):
        assert not part.is_of_the_report(*other)


@pytest.mark.exhaust
def test_run_of_table_one_in_words_holds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A run as short as can be: it is shown and kept where it is the report's, which a longer one
    would be, and not where something was chosen.
    """
    pytest.importorskip("numba")
    pytest.importorskip("matplotlib")
    from juggleproof.scenes.part import scene

    onsets = import_module("juggleproof.scenes.part.onsets")
    readings = import_module("juggleproof.scenes.part.readings")
    monkeypatch.setenv(records.VARIABLE, str(tmp_path))
    points = tuple(
        readings.ReadingOutcome(
            readings.TableReading("2x4", "peak", 0, 0, e, 0.08), (), (), (), (lnl,) * 3, 1
        )
        for e, lnl in ((0.7, -1.0), (0.5, -3.0))
    )
    stored = (readings.AlikeReadings(2, 0, 0.5, 2, 2, points),)
    for module in (part, readings):
        monkeypatch.setattr(module, "recorded", lambda: stored)
    setting = scene(e=0.7, mu=0.08, A_x=1e-3, f_x=30.0)
    found = onsets.table_one(setting, ensembles=2, horizon=0.5)
    assert not part.keep_results(setting, found, "peak", 1) and kept_results() is None
    monkeypatch.setattr(part, "ENSEMBLES", 2)
    monkeypatch.setattr(part, "HORIZON", 0.5)
    for other, amplitudes, seed in (
        (setting, "peak", 2),
        (setting, "peak-to-peak", 1),
        (replace(setting, mu=0.1), "peak", 1),
    ):
        assert not part.keep_results(other, found, amplitudes, seed)
    assert part.keep_results(setting, found, "peak", 1)
    kept = kept_results()
    assert kept is not None and [row[0] for row in kept.rows] == [
        f"{f:g} Hz {1000 * a:g} mm" for f, a, _ in onsets.PAPER
    ]
    assert (
        all(len(row) == len(HEADS) for row in kept.rows)
        and "27 blocks, 0 to 26 degrees" in kept.still
    )
    assert ["friction mu", "0.08", "inferred"] in [[*line][:3] for line in kept.assumed]
    assert (
        kept.figure["alt"].startswith("3 grids of 91")
        and words(section_of(kept)).count("nearer to lying") > 0
    )


def test_nothing_is_kept_where_keeping_is_off_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(records.VARIABLE, "off")
    assert kept_results() is None
