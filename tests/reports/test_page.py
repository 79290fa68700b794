"""The page tells all that is settled, is whole and well formed, and fetches nothing: that of one
claim in six and of what is singled out, and with JUGGLEPROOF_MUTANTS=many (make exhaust) the whole.
"""

from __future__ import annotations

import json
import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from urllib.parse import unquote

import pytest

from juggleproof.certificates import checker
from juggleproof.judging.conclusions import RULES
from juggleproof.papers.paper import opened
from juggleproof.proofs.opening import PROOF
from juggleproof.reports import markup, tex_words
from juggleproof.reports.contents import Contents, ShownText
from juggleproof.reports.errata import is_latex
from juggleproof.reports.latex import glyph
from juggleproof.reports.page import LONGEST, build, statement
from tests.certificates.checker.maps import DOUBLE, FLIP, NEST, PUSH, SUBTRACT, TURN, read
from tests.certificates.checker.test_returns import LOOP
from tests.reports import runs
from tests.reports.browser import Element, NotNested, parts_of, read_html, read_whole
from tests.share import MANY, share

ROOT = Path(__file__).resolve().parents[2]
contents, page = share((runs.some_contents, runs.page_of_some), (runs.contents, runs.page))


@cache
def text() -> str:
    return page().decode("utf-8")


@cache
def document() -> Element:
    """The page with everything that it holds in its place."""
    return read_whole(text())


@cache
def static() -> Element:
    """The page as it is without a script, and until something is opened."""
    return read_html(text())


@cache
def with_ids() -> dict[str, Element]:
    return {one.attributes["id"]: one for one in document().all() if "id" in one.attributes}


def by_id(name: str) -> Element:
    return with_ids()[name]


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
    for page_read in (static(), document()):
        ids = [one.attributes["id"] for one in page_read.all() if "id" in one.attributes]
        assert len(ids) == len(set(ids))
    ids = [one.attributes["id"] for one in static().all() if "id" in one.attributes]
    links = [one.attributes["href"] for one in document().all("a")]
    assert len(links) > 1000
    for link in links:
        assert link.startswith("#"), link
        assert link.startswith("#?") or unquote(link[1:]) in ids, link
    named = [
        name
        for one in static().all()
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
    """So that every link leads somewhere, with a script or without."""
    ids = {one.attributes["id"] for one in static().all() if "id" in one.attributes}
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
    within = {
        one.attributes["id"]: section.attributes["id"]
        for section in document().with_class("of-section")
        for one in section.with_class("claim")
    }
    for entry in contents().entries:
        article = shown[entry.claim.id]
        badge = next(article.with_class("badge"))
        assert (
            article.attributes["data-verdict"]
            == entry.verdict
            == badge.text().strip()
            == badge.attributes["class"].split()[1]
        )
        assert within[entry.claim.id] == f"section-{entry.claim.section}"
    for word, count in contents().verdicts.items():
        assert f"{word} {count}" in [
            spaced(item) for item in next(document().with_class("tally")).all("a")
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


def test_theorem_stands_first_and_errata_before_the_rest_holds() -> None:
    wanted_order = [
        "what-moves",
        "the-theorem",
        "errata",
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
    ] == [one for one in wanted_order if MANY or one != "figures"]
    wanted = {f"erratum-{entry.claim.id}" for entry in contents().entries if entry.group}
    assert wanted and {one.attributes["id"] for one in document().with_class("erratum")} == wanted


def test_every_equation_of_the_appendices_stands_in_its_place_as_it_is_true_holds() -> None:
    mended = 0
    for entry in contents().entries:
        if entry.claim.section[0] not in opened().appendices:
            continue
        block = by_id(f"equation-{entry.claim.id}")
        assert any(one is block for one in by_id(f"regenerated-{entry.claim.section}").children)
        shown = [one.attributes["alttext"] for one in block.all("math")]
        wrong, correction = tex_words.in_errata(entry), entry.correction
        assert ("mended" in block.attributes["class"]) == wrong
        if not entry.claim.printed:
            continue
        printed = " ".join(entry.claim.printed.split())
        if not wrong:
            assert shown[-1] == printed
        elif correction is None:
            assert entry.verdict in spaced(block) and printed in shown
        elif is_latex(correction):
            assert shown[-2:] == [" ".join(tex_words.regenerated(entry).split()), printed]
            mended += 1
    assert mended > 5


def test_every_counterexample_is_in_words_holds() -> None:
    """In the errata and beside the statement; a formula stands in the line as MathML."""
    counted, parts = 0, parts_of(static())
    for entry in contents().entries:
        for shown in (one for one in entry.statements if one.at):
            line = markup.prose(shown.words)
            places = [
                parts[entry.claim.id].partition(f'id="{shown.name}"')[2],
                parts[f"erratum-{entry.claim.id}"],
            ]
            assert shown.words and all(f"<p>{line}</p>" in one for one in places), shown.name
            counted += 1
    assert counted > 25


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


def test_sentences_leave_no_formula_as_text_holds() -> None:
    for article in (*document().with_class("claim"), *document().with_class("derived")):
        for one in (*article.with_class("says"), *article.all("summary")):
            words = spaced(one)
            for math in one.all("math"):
                words = words.replace(spaced(math), " ", 1)
            assert not re.search(r"`|\b[A-Za-z]\w*_\w|\^", words), words


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


def test_every_part_has_its_place_holds() -> None:
    places = [
        one.attributes["data-part"] for one in static().all() if "data-part" in one.attributes
    ]
    assert sorted(places) == sorted(parts_of(static()))
    for one in static().all("details"):
        inside = [child for child in one.all() if "data-part" in child.attributes]
        assert len(inside) == 1 and spaced(inside[0])


def test_list_without_a_script_says_each_outcome_holds() -> None:
    articles = {one.attributes["id"]: one for one in static().with_class("claim")}
    for entry in contents().entries:
        listed = [
            (one.attributes["id"], "".join(b.text() for b in one.all("b")) or "certified")
            for one in articles[entry.claim.id].all("li")
            if "id" in one.attributes
        ]
        assert listed == [(shown.name, shown.outcome) for shown in entry.statements]


def test_every_line_of_a_rule_is_a_formula_or_a_link_holds() -> None:
    kinds = set()
    for text in (SUBTRACT, TURN, FLIP, NEST, DOUBLE, PUSH, LOOP):
        for name, rule in read(text).items():
            kinds.add(rule.kind)
            shown = statement(ShownText(name, rule.text(), "certified", None, "", "", "", {}))
            for row in shown.rows:
                formulas = [part for part in row.parts if part.startswith(("<math", "<code>"))]
                assert row.links or formulas == list(row.parts) or "pieces" in row.word, row
    assert {*kinds, "iterates"} == checker.orbit_rules().keys() == RULES.keys()


def test_map_and_theorem_are_those_of_the_statements_holds() -> None:
    opening = by_id("what-moves")
    drawn = [one.attributes["alttext"] for one in opening.all("math")]
    for piece in (
        r"(\alpha w - \alpha x, 2 - \alpha w) & \text{if } x < w",
        r"(x - w, w + 2) & \text{if } w \le x",
    ):
        assert any(piece in one for one in drawn)
    assert r"\left(\frac{2\alpha}{(1 + \alpha)^2}, \frac{2}{1 + \alpha}\right)" in drawn
    assert contents().theorem.split(": ")[1] in spaced(next(opening.with_class("headline"))).lower()


def test_each_line_of_the_proof_leads_to_its_certificate_holds() -> None:
    cited = list(by_id("the-theorem").with_class("cite"))
    proof = contents().entry(PROOF)
    assert {one.attributes["href"] for one in cited} == {f"#{one.name}" for one in proof.statements}
    assert {one.attributes["class"] for one in cited} == {"cite certified"}
    for one, shown in [(one, by_id(one.attributes["href"][1:])) for one in cited]:
        assert next(shown.all("b")).text() == "certified", one.text()


def test_line_of_the_proof_that_is_not_certified_says_so_holds() -> None:
    proof = contents().entry(PROOF)
    lost = replace(proof.statements[3], outcome="unknown")
    broken = replace(proof, statements=(*proof.statements[:3], lost, *proof.statements[4:]))
    others = (one for one in contents().entries if one.claim.id.startswith("theorem"))
    entries = tuple(broken if one is proof else one for one in others)
    found = page_of(replace(contents(), entries=entries))
    cited = [one for one in found.with_class("cite") if one.attributes["href"] == f"#{lost.name}"]
    assert [one.text() for one in cited] == [
        f"{lost.name.partition('/')[2]}: not certified, unknown"
    ]
    section = next(one for one in found.all("section") if one.attributes["id"] == "the-theorem")
    assert "Not every line is certified" in spaced(section)
    assert "Not every line is certified" not in spaced(by_id("the-theorem"))
    assert "theorem_from_physics" in spaced(by_id("the-theorem"))
    assert "theorem_from_physics" not in spaced(section)


def test_derived_formulas_have_left_sides_holds() -> None:
    derived = list(document().with_class("derived"))
    assert len(derived) == len(contents().derivations)
    for one in derived:
        formula = next(one.with_class("formula"))
        shown = [math.attributes["alttext"] for math in formula.all("math")]
        assert len(shown) == 1 and re.match(r"\S.* = \S", shown[0]) or len(formula.text()) > LONGEST


def test_each_letter_of_a_statement_has_a_meaning_holds() -> None:
    articles = {one.attributes["id"]: one for one in document().with_class("claim")}
    for entry in contents().entries:
        if not entry.statements:
            continue
        article = articles[entry.claim.id]
        meant = {
            name
            for one in article.all("div")
            if [spaced(term) for term in one.all("dt")] == ["letters"]
            for math in one.all("math")
            for name in math.attributes["alttext"].split(", ")
        }
        for shown in entry.statements:
            listed = re.findall(
                r"^(?:forall|exists|integer|over|state|input) (.*)$", shown.text, re.MULTILINE
            )
            wanted = {glyph(name) for names in listed for name in names.split()}
            assert wanted <= meant, (shown.name, wanted - meant)


def page_of(changed: Contents) -> Element:
    return read_whole(build(changed).decode("utf-8"))


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
    assert [one.attributes.get("id") for one in found.all("script")] == ["parts", None]
    assert len(list(found.all("style"))) == 1
    assert hostile in [one.text() for one in found.all("code")]


def test_lost_theorem_is_told_holds() -> None:
    lost = "theorem: NOT proved; theorem/x is not certified, and theorem/exactly rests on it"
    found = page_of(replace(contents(), entries=contents().entries[:1], theorem=lost))
    assert replace(contents(), theorem=lost).theorem_stands.startswith(
        "The theorem is not certified"
    )
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
    rules = (broken, *contents().rules[1:])
    found = page_of(replace(contents(), entries=contents().entries[:1], rules=rules))
    picture = next(found.with_class("tree"))
    labels = [one.attributes["aria-label"] for one in picture.all("a")]
    assert f"premise {rule.premises[0].name.rpartition('.')[2]} of {rule.name}; rejected" in labels
    assert sum(one.text().startswith("✓") for one in picture.all("text")) == len(labels) - 2
