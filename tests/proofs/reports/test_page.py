"""The page tells all that is settled, is whole and well formed, fetches nothing, and is the same to
the byte from run to run.
"""

from __future__ import annotations

import json
import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from urllib.parse import unquote

import pytest

from juggleproof.proofs.reports import markup
from juggleproof.proofs.reports.contents import Contents
from juggleproof.proofs.reports.page import build
from tests.proofs.reports.browser import Element, NotNested, read_html
from tests.proofs.reports.runs import contents, drawn, page

ROOT = Path(__file__).resolve().parents[3]


@cache
def text() -> str:
    return page().decode("utf-8")


@cache
def document() -> Element:
    return read_html(text())


def by_id(name: str) -> Element:
    return next(one for one in document().all() if one.attributes.get("id") == name)


def spaced(element: Element) -> str:
    return " ".join(element.text().split())


def test_page_is_well_formed_holds() -> None:
    assert [one.tag for one in document().all()][:2] == ["html", "head"]
    assert by_id("main").tag == "main"


@pytest.mark.parametrize("defect", ["<p><b>a</p></b>", "<div>", "</div>", "<p id='a' id='b'></p>"])
def test_rejects_elements_that_are_not_nested(defect: str) -> None:
    with pytest.raises(NotNested):
        read_html(defect)


def test_ids_are_unique_and_links_have_targets_holds() -> None:
    ids = [one.attributes["id"] for one in document().all() if "id" in one.attributes]
    assert len(ids) == len(set(ids))
    links = [one.attributes["href"] for one in document().all("a")]
    assert len(links) > 1000
    for link in links:
        assert link.startswith("#"), link
        assert link.startswith("#?") or unquote(link[1:]) in ids, link
    named = [
        name
        for one in document().all()
        for key in ("aria-labelledby", "aria-describedby", "for")
        for name in one.attributes.get(key, "").split()
    ]
    assert set(named) <= set(ids)


def test_nothing_is_fetched_holds() -> None:
    assert not list(
        document().all(
            "link", "img", "iframe", "object", "embed", "base", "audio", "video", "source"
        )
    )
    assert not [
        one
        for one in document().all()
        if {"src", "srcset", "action", "data", "poster", "background"} & set(one.attributes)
    ]
    assert not [
        one for one in document().all() if any(name.startswith("on") for name in one.attributes)
    ]
    style = "".join(one.text() for one in document().all("style"))
    assert "@import" not in style and not [
        found
        for found in re.findall(r"url\(([^)]*)\)", text())
        if not found.strip("'\"").startswith("#")
    ]
    assert {*re.findall(r"\bhttps?://[^\s\"'<>)]*", text())} <= {
        "http://www.w3.org/2000/svg",
        "http://www.w3.org/1999/xlink",
    }
    policy = next(
        one.attributes["content"]
        for one in document().all("meta")
        if one.attributes.get("http-equiv") == "Content-Security-Policy"
    )
    assert policy.startswith(
        "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:"
    )


def test_every_claim_statement_and_rule_has_its_place_holds() -> None:
    ids = {one.attributes["id"] for one in document().all() if "id" in one.attributes}
    for entry in contents().entries:
        assert entry.claim.id in ids
        assert {shown.name for shown in entry.statements} <= ids
    for rule in contents().rules:
        assert f"rule-{rule.name}" in ids
        assert {f"premise-{premise.name}" for premise in rule.premises} <= ids
    assert {f"section-{entry.claim.section}" for entry in contents().entries} <= ids


def test_verdicts_are_those_of_the_contents_holds() -> None:
    shown = {one.attributes["id"]: one for one in document().with_class("claim")}
    assert list(shown) and len(shown) == len(contents().entries)
    for entry in contents().entries:
        article = shown[entry.claim.id]
        badge = next(article.with_class("badge"))
        assert (
            article.attributes["data-verdict"]
            == entry.verdict
            == badge.text().strip()
            == badge.attributes["class"].split()[1]
        )
        assert article.attributes["data-section"] == entry.claim.section
    for word, count in contents().verdicts.items():
        assert f"{word} {count}" in [
            spaced(item) for item in next(document().with_class("tally")).all("li")
        ]


def test_statements_stand_as_the_checker_reads_them_holds() -> None:
    for entry in contents().entries:
        for shown in entry.statements:
            block = by_id(shown.name) if shown.name in SAMPLE else None
            if block:
                assert shown.text in [pre.text() for pre in block.all("pre")]
                assert [b.text() for b in block.all("b")] == [shown.outcome]
    texts = {pre.text() for pre in document().all("pre")}
    assert {shown.text for entry in contents().entries for shown in entry.statements} <= texts


SAMPLE = {"eq-37/bound", "eq-26/sampled.enters-later", "theorem-in-units/descends"}


def test_certificates_are_whole_or_named_by_their_file_holds() -> None:
    for block in document().with_class("statement"):
        name = block.attributes["id"]
        shown = (
            next(
                one for entry in contents().entries for one in entry.statements if one.name == name
            )
            if name in SAMPLE
            else None
        )
        labels = [spaced(one) for one in block.with_class("label")]
        whole = next(
            (
                re.fullmatch(r"certificate, (\d+) characters", label)
                for label in labels
                if label.startswith("certificate,")
            ),
            None,
        )
        stored = next(
            (
                re.fullmatch(r"certificate: (\d+) characters, in (\S+)", label)
                for label in labels
                if label.startswith("certificate:")
            ),
            None,
        )
        assert bool(whole) != bool(stored), name
        if whole:
            assert len(list(block.all("pre"))[1].text()) == int(whole.group(1))
        if stored:
            assert (ROOT / stored.group(2)).is_file()
        if shown:
            length = whole or stored
            assert length
            assert len(json.dumps(shown.certificate, separators=(",", ":"))) == int(length[1])


def test_certificates_of_the_theorem_are_whole_holds() -> None:
    premises = [premise for rule in contents().rules for premise in rule.premises]
    assert len(premises) > 30
    for premise in premises:
        shown = [pre.text() for pre in by_id(f"premise-{premise.name}").all("pre")]
        assert shown[0] == premise.text and json.loads(shown[1]) == premise.certificate


def test_errata_stand_first_and_whole_holds() -> None:
    wanted_order = [
        "errata",
        "the-theorem",
        "figures",
        "part-scene",
        "claims",
        "derived",
        "notation",
        "settled",
        "tools",
    ]
    assert [
        one.attributes["id"]
        for one in by_id("main").all("section")
        if one.attributes["id"] in wanted_order
    ] == wanted_order
    wanted = {f"erratum-{entry.claim.id}" for entry in contents().entries if entry.group}
    assert wanted and {one.attributes["id"] for one in document().with_class("erratum")} == wanted


def test_every_counterexample_is_in_words_holds() -> None:
    """In the errata and beside the statement; a formula stands in the line as MathML."""
    counted = 0
    for entry in contents().entries:
        for shown in (one for one in entry.statements if one.at):
            line = markup.prose(shown.words)
            places = [f'id="{shown.name}"', f'id="erratum-{entry.claim.id}"']
            assert shown.words and all(
                f"<p>{line}</p>" in text().partition(place)[2].partition("</article>")[0]
                for place in places
            ), shown.name
            counted += 1
    assert counted > 50


def test_prints_are_drawn_where_they_are_told_holds() -> None:
    for article in document().with_class("claim"):
        claim = next(
            entry.claim
            for entry in contents().entries
            if entry.claim.id == article.attributes["id"]
        )
        drawn = [one.attributes["alttext"] for one in article.all("math")]
        assert not claim.printed or " ".join(claim.printed.split()) in drawn
        assert not claim.as_it_stands or claim.as_it_stands in [
            one.text() for one in article.all("code")
        ]


def test_formulas_hold_no_latex_but_their_alternative_text_holds() -> None:
    found = list(document().all("math"))
    assert len(found) > 5000
    for one in found:
        assert one.attributes["alttext"], one.line
        assert "\\" not in one.text(), one.line


def test_headings_are_in_order_holds() -> None:
    levels = [int(one.tag[1]) for one in document().all("h1", "h2", "h3", "h4", "h5", "h6")]
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(after <= before + 1 for before, after in zip(levels, levels[1:]))


def test_readers_who_do_not_see_are_told_what_things_are_holds() -> None:
    assert next(document().all("html")).attributes["lang"] == "en"
    labels = {one.attributes.get("for") for one in document().all("label")}
    for control in document().all("input", "select"):
        inside = any(
            control in list(label.all("input", "select")) for label in document().all("label")
        )
        assert control.attributes.get("id") in labels or inside, control.line
    assert by_id("shown").attributes["aria-live"] == "polite"
    assert all(one.attributes.get("aria-label") for one in document().all("nav"))
    for picture in document().all("svg"):
        assert picture.attributes.get("role") in ("img", "group")
        assert picture.attributes.get("aria-label") or picture.attributes.get("aria-labelledby")
    for figure in document().all("figure"):
        assert (
            len(next(figure.all("desc")).text()) > 40
            and next(figure.all("figcaption")).text().strip()
        )


def test_page_is_small_holds() -> None:
    assert len(page()) < 4_000_000


def test_page_is_the_same_from_run_to_run_holds() -> None:
    """Of the same contents; `.ci/run` compares two whole runs of every report in processes of their
    own.
    """
    assert build(contents(), drawn()) == page()


def page_of(changed: Contents) -> Element:
    return read_html(build(changed).decode("utf-8"))


def test_words_of_claims_are_escaped_holds() -> None:
    first = contents().entries[0]
    hostile = "<script>alert('x')</script> \" & </style>"
    claim = replace(first.claim, says=hostile, as_it_stands=hostile)
    entry = replace(
        first, claim=claim, reading=hostile, settled_by=hostile, wrong=(hostile,), sharp=hostile
    )
    found = page_of(
        replace(
            contents(),
            entries=(entry,),
            rules=(),
            theorem=f"theorem: {hostile}",
            tools={hostile: hostile},
            changes=(hostile,),
        )
    )
    assert len(list(found.all("script"))) == 1 and len(list(found.all("style"))) == 1
    assert hostile in [one.text() for one in found.all("code")]


def test_lost_theorem_is_told_holds() -> None:
    lost = "theorem: NOT proved; theorem/x is not certified, and theorem/exactly rests on it"
    found = page_of(replace(contents(), entries=contents().entries[:1], theorem=lost))
    assert [spaced(one) for one in found.with_class("headline")][0].startswith(
        "NOT proved; theorem/x is not certified"
    )


def test_changed_verdicts_are_told_holds() -> None:
    change = "eq-1: verdict was holds, is false"
    found = page_of(
        replace(contents(), entries=contents().entries[:1], rules=(), changes=(change,))
    )
    assert change in [one.text() for one in found.all("li")]
    assert "1 verdict differs from the register" in " ".join(
        spaced(one) for one in found.with_class("warning")
    )


def test_premise_that_is_not_certified_is_told_by_word_and_mark_holds() -> None:
    rule = contents().rules[0]
    broken = replace(
        rule,
        outcome="rejected",
        premises=(replace(rule.premises[0], outcome="rejected"), *rule.premises[1:]),
    )
    found = page_of(replace(contents(), rules=(broken, *contents().rules[1:])))
    picture = next(one for one in found.all("svg"))
    labels = [one.attributes["aria-label"] for one in picture.all("a")]
    assert f"premise {rule.premises[0].name.rpartition('.')[2]} of {rule.name}; rejected" in labels
    assert sum(one.text().startswith("✓") for one in picture.all("text")) == len(labels) - 2
