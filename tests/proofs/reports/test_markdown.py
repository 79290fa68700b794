"""The summary shows every text as it stands, says the most important first, and keeps to its
limit.
"""

from __future__ import annotations

from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest
from markdown_it import MarkdownIt

from juggleproof.proofs.register import load_register
from juggleproof.proofs.reports.ci import LIMIT, code, escaped, markdown
from juggleproof.proofs.reports.results import Results
from tests.proofs.reports.runs import FALSE, OPEN, gathered, own, paper

NASTY = (
    "a|b",
    "<script>alert(1)</script>",
    "`code` ``two``",
    "*bold* _it_ ~~no~~",
    "[link](http://x.org) ![i](y)",
    "# no heading",
    "a\nb\n\n- c",
    "&amp; &lt;",
    r"\frac{1}{2} \| \\",
    "$x$ $$y$$",
    "</details>",
    "<!-- hidden",
    "--- | ---",
    "1. one",
    "@someone",
    "|",
    "`",
    "\\",
    "a`|`b",
)


class _Read(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.cells: list[str] = []

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.tags.append(tag)
        if tag in ("td", "th", "p"):
            self.cells.append("")

    def handle_data(self, data: str) -> None:
        if self.cells:
            self.cells[-1] += data


def rendered(text: str) -> _Read:
    reader = _Read()
    reader.feed(MarkdownIt("commonmark").enable(["table", "strikethrough"]).render(text))
    reader.cells = [cell.strip() for cell in reader.cells]
    return reader


@pytest.mark.parametrize("text", NASTY)
def test_text_in_a_cell_is_shown_as_it_stands_holds(text: str) -> None:
    read = rendered(f"| a | b |\n| --- | --- |\n| {escaped(text)} | end |\n")
    assert read.cells == ["a", "b", " ".join(text.split()), "end"]
    assert set(read.tags) == {"table", "thead", "tbody", "tr", "th", "td"}


@pytest.mark.parametrize("text", NASTY)
def test_code_is_shown_as_it_stands_holds(text: str) -> None:
    read = rendered(f"so: {code(text)} end")
    assert read.cells == [f"so: {' '.join(text.split())} end"] and read.tags == ["p", "code"]


def test_dollars_and_ats_are_no_marks_of_github_holds() -> None:
    assert "$" not in escaped("$x$") and "@" not in escaped("@someone")


def headings(text: str) -> list[str]:
    return [line for line in text.splitlines() if line.startswith("#")]


def test_summary_of_the_paper_says_that_nothing_changed_holds() -> None:
    results = paper()
    text = markdown(results)
    assert (
        headings(text)[0] == "# The theorem is proved"
        and "\n## Changes of verdicts since the register\n\nNo change.\n" in text
    )
    assert f"{len(load_register())} claims: " in text and "Unknown" not in text
    assert text == markdown(results) == markdown(gathered())
    read = rendered(text)
    assert read.tags.count("tr") == len(results.claims) + 1 and all(
        any(one.id == cell for cell in read.cells) for one in results.claims
    )
    for one in results.claims:
        assert not one.group or f"- **{escaped(one.id)}**" in text


def test_changes_are_shown_before_and_after_holds() -> None:
    register = load_register()
    register["gone"], register["eq-2"] = (
        {"verdict": "gap"},
        {**register["eq-2"], "verdict": "holds"},
    )
    del register["eq-1"]
    text = markdown(paper(register))
    assert "## Changes of verdicts since the register (3)" in text and "No change" not in text
    assert "| eq-2 | verdict | holds | misprint |" in text
    assert (
        "| gone | verdict | gap | no longer in the sources |" in text
        and "| eq-1 | verdict | not registered | holds |" in text
    )
    assert "accepted into the register" in markdown(paper(register, accepted=True))


def test_lost_theorem_is_told_first_holds() -> None:
    lost = replace(
        paper(), theorem="theorem: NOT proved; a/b is not certified, and t/exactly rests on it"
    )
    assert headings(markdown(lost))[
        0
    ] == "# The theorem is NOT proved" and "a/b is not certified" in markdown(lost)
    assert headings(markdown(replace(lost, theorem="")))[0] == "# The theorem is NOT proved"


def test_unknown_and_rejected_come_first_holds(tmp_path: Path) -> None:
    text = markdown(own(tmp_path, OPEN))
    assert headings(text) == ["# 1 of 2 claims holds", "## Unknown (1): neither proved nor refuted"]
    stated = paper().claims[0].statements[0].name
    found = headings(markdown(paper(rejected=[(stated, "the sum | is not 0")])))
    assert [one.split(" (")[0] for one in found[:4]] == [
        "# The theorem is proved",
        "## Unknown",
        "## Rejected by the checker",
        "## Changes of verdicts since the register",
    ]


def test_false_claim_of_ones_own_is_told_with_its_counterexample_holds(tmp_path: Path) -> None:
    text = markdown(own(tmp_path, FALSE))
    assert (
        "- **above**: false; It says so.; fails at `x = 1`" in text
        and "register" not in text
        and "paper" not in text
    )


def test_summary_keeps_to_the_limit_and_tells_what_is_left_out_holds() -> None:
    one = paper().claims[0]
    many = Results(
        tuple(
            replace(one, id=f"claim-{number}", says="é" * 5000, detail="x" * 5000)
            for number in range(2000)
        ),
        own=True,
    )
    text = markdown(many)
    assert len(text.encode()) <= LIMIT and text.count("<details>") == text.count("</details>")
    assert "lines are left out" in text and "(5010 characters)" in text
    assert "left out" not in markdown(paper())
