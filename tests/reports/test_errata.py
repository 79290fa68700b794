"""`juggleproof errata`: every claim that is not simply true stands in one group, with its print,
what is wrong, and exact values.
"""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from juggleproof.command.main import run
from juggleproof.judging.judgement import Judgement
from juggleproof.judging.register import load_register
from juggleproof.judging.run import FINDINGS, judge_some
from juggleproof.papers.ledger import load_ledger
from juggleproof.papers.paper import Paper, opened
from juggleproof.papers.places import is_heading, place_of
from juggleproof.proofs.theorem import THEOREM
from juggleproof.reports import contents, errata, pages
from juggleproof.reports.contents import errata_text
from juggleproof.reports.tree import STANDS, theorem_line
from juggleproof.statements.store import CERTIFICATES, DEFAULT, Store
from tests.reports.runs import paper_run

TITLES = list(errata.GROUPS.values())


JUDGED = dict[str, Judgement]()  # by the first errata that are made
CHECKED = dict[str, str]()


@pytest.fixture(scope="module")
def everything() -> str:
    """The errata, as they are printed, of what the run of all reports' tests has judged."""
    done, _ = paper_run()
    known = {one.id: one for one in done.judgements}

    def judged(some: Any, *_: Any) -> list[Judgement]:
        JUDGED.update((one.id, known[one.id]) for one in some)
        return [known[one.id] for one in some]

    CHECKED.update(done.outcomes)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(contents, "outcomes_of", lambda *_: CHECKED)
        patch.setattr(contents, "judge_some", judged)
        return errata_text()


@pytest.fixture(scope="module")
def listing(everything: str) -> dict[str, dict[str, str]]:
    """The entries by group and claim."""
    groups: dict[str, dict[str, str]] = {}
    for block in everything.split("\n\n"):
        heading = re.fullmatch(r"(.*) \((\d+)\)", block.strip())
        if heading and heading[1] in TITLES:
            groups[heading[1]] = {}
        elif groups:
            groups[list(groups)[-1]][block.split(",")[0].strip()] = block
    return groups


def wrong(listing: dict[str, dict[str, str]]) -> list[dict[str, str]]:
    """The groups of what is wrong."""
    return [listing[errata.GROUPS[group]] for group in errata.WRONG]


def test_groups_stand_in_order_and_hold_every_claim_that_is_not_true(
    listing: dict[str, dict[str, str]],
) -> None:
    assert list(listing) == TITLES
    named = [name for group in wrong(listing) for name in group]
    register = load_register()
    assert sorted(named) == sorted(
        name
        for name, entry in register.items()
        if entry["verdict"] not in ("holds", "simulated", "unknown")
    )
    noted = {claim.id for claim in opened().claims() if claim.as_it_stands or claim.remark}
    assert {*listing[errata.GROUPS["remarks"]], *listing[errata.GROUPS["restored"]]} == {
        name for name in noted if register[name]["verdict"] == "holds"
    }
    assert all(
        register[name]["verdict"] == "ambiguous" for name in listing[errata.GROUPS["readings"]]
    )


def test_every_entry_says_what_is_wrong_and_where_it_fails(
    listing: dict[str, dict[str, str]],
) -> None:
    register = load_register()
    for group in wrong(listing):
        for name, text in group.items():
            verdict, rows = (
                register[name]["verdict"],
                [line.split()[0] for line in text.splitlines()[1:] if line[4] != " "],
            )
            assert (
                "said" in rows
                and "fails" in rows
                and ("readings" if verdict == "ambiguous" else "wrong") in rows
            ), text
            assert verdict not in ("misprint", "false") or "correction" in rows, text
    for text in listing[errata.GROUPS["restored"]].values():
        assert all(f"\n    {row}" in text for row in ("transcribed", "restored", "why")), text
    for text in listing[errata.GROUPS["remarks"]].values():
        assert "\n    remark" in text, text


def test_every_stored_counterexample_is_printed_holds(listing: dict[str, dict[str, str]]) -> None:
    store, everything = (
        Store(DEFAULT),
        "\n".join(text for group in listing.values() for text in group.values()),
    )
    refuted = [
        name
        for name, text in store.texts.items()
        if "refuted" in (store.certificate(name, text) or {})
    ]
    assert refuted
    for name in refuted:
        assert (
            errata.counterexample(store.certificate(name, store.texts[name])["refuted"])
            in everything
        ), name


def test_a_repeat_follows_a_listed_print_holds(listing: dict[str, dict[str, str]]) -> None:
    claims = {claim.id: claim for claim in opened().claims()}
    listed = {name for group in wrong(listing) for name in group}
    assert listing[errata.GROUPS["repeats"]]
    for title in (errata.GROUPS[name] for name in errata.WRONG):
        for name in listing[title]:
            assert (claims[name].repeats in listed and bool(claims[name].repeats)) == (
                title == errata.GROUPS["repeats"]
            ), name


def test_transcription_errors_are_those_of_the_table_holds(
    listing: dict[str, dict[str, str]],
) -> None:
    findings = json.loads((DEFAULT / FINDINGS).read_text(encoding="utf-8"))
    for name in listing[errata.GROUPS["transcription"]]:
        assert findings[name]["correction"]["possible transcription error"]
    assert not any(
        findings[name].get("correction", {}).get("possible transcription error")
        for group in ("proof", "statement", "mark", "marks")
        for name in listing[errata.GROUPS[group]]
    )


@pytest.mark.parametrize(
    "entry, sharp, lines",
    [
        ({"verdict": "misprint"}, {"": "nowhere"}, ["false as printed, for every alpha"]),
        ({"verdict": "misprint"}, {"": "not found"}, ["false as printed"]),
        (
            {"verdict": "false"},
            {"": "0 < alpha < 1/3"},
            ["false; it would be true exactly for 0 < alpha < 1/3"],
        ),
        (
            {"verdict": "gap", "detail": "step a, b is false; conclusion open"},
            {},
            ["steps a, b are false; the conclusion stays open"],
        ),
        (
            {"verdict": "gap", "detail": "step a is false; conclusion by eq-3"},
            {},
            ["step a is false; the conclusion stands by eq-3"],
        ),
        (
            {"verdict": "false", "detail": "its conclusion is refuted, and step a"},
            {},
            ["the conclusion is false, and so is step a"],
        ),
        (
            {"verdict": "ambiguous", "detail": "a: holds; b: false"},
            {"a.": "0 < alpha < 1/2", "b.": "nowhere"},
            ["read as a: true, exactly for 0 < alpha < 1/2", "read as b: false, for every alpha"],
        ),
    ],
)
def test_what_is_wrong_is_told_in_words(
    entry: dict[str, str], sharp: dict[str, str], lines: list[str]
) -> None:
    assert errata.what_is_wrong(entry, sharp) == lines


SOME = ("eq-36", "eq-37", "eq-38", "s4.3.2-K-attracts")


def test_all_that_is_told_was_checked_now_holds(
    listing: dict[str, dict[str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of the claims of a smaller paper, by the command's own ways."""
    claims = [one for one in opened().claims() if one.id.startswith("theorem") or one.id in SOME]
    now, own = dict[str, str](), list[Judgement]()

    def judged(*arguments: Any) -> list[Judgement]:
        now.update(arguments[-1])
        own.extend(judge_some(*arguments))
        return own

    monkeypatch.setattr(Paper, "claims", lambda _: claims)
    monkeypatch.setattr(contents, "judge_some", judged)
    text = errata_text()
    assert STANDS in theorem_line(Store(DEFAULT), now) and {one.id for one in own} >= {*SOME[2:]}
    for one in own:
        assert one.outcomes == {name: now[name] for name in one.outcomes}, one.id
    for group in wrong(listing):
        assert all((entry in text) == (name in SOME) for name, entry in group.items())


@pytest.mark.parametrize("is_refuted", [False, True])
def test_a_claim_that_holds_without_a_proof_in_the_store_is_judged_holds(
    is_refuted: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, everything: str
) -> None:
    """Its proof is taken out, or replaced by a point at which it is said to be false."""
    folder, asked = spoilt_store(tmp_path / "store", "eq-37/member"), set[str]()
    if is_refuted:
        lines = (folder / CERTIFICATES).read_text().splitlines(keepends=True)
        line = json.dumps(["eq-37/member", {"refuted": ["point", {}, ["close"]]}]) + "\n"
        (folder / CERTIFICATES).write_text("".join(sorted([*lines, line])))

    def judged(some: Any, *_: Any) -> list[Judgement]:
        asked.update(one.id for one in some)
        return [JUDGED[one.id] for one in some if one.id != "eq-37"]

    monkeypatch.setattr(contents, "DEFAULT", folder)
    monkeypatch.setattr(contents, "outcomes_of", lambda *_: CHECKED)
    monkeypatch.setattr(contents, "judge_some", judged)
    errata_text()
    assert "eq-37" not in JUDGED and asked == {*JUDGED, "eq-37"}


def test_rejects_errata_without_a_register(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(contents, "load_register", dict)
    with pytest.raises(errata.ClaimError, match="no verdict is registered yet"):
        errata_text()


def test_errors_stand_by_their_weight_holds(listing: dict[str, dict[str, str]]) -> None:
    for group, names in {
        "proof": ["s4.3.1-LaSalle", "s4.3.1-B2-approach", "s4.3.2-K-attracts"],
        "statement": ["eq-38", "s3.5.3-locally-stable", "sA.3.1-not-on-R0"],
        "readings": ["s2.1-impact-velocity", "prop-1-B2-to-B1", "sA.3.1-not-satisfied"],
        "mark": ["s3.3-e1-closed", "s4.3.1-DK-negative", "sB.1-tau", "sB.7-C"],
        "marks": ["sA.3.2-sup3", "sB.1-collision", "sA.3-sup"],
    }.items():
        entries = listing[errata.GROUPS[group]]
        assert {*names} <= {*entries}, group
        assert all(errata.WEIGHTS[group] in text.splitlines()[0] for text in entries.values())


def test_first_page_tells_what_bears_on_the_theorem_in_three_lines_holds(
    everything: str,
) -> None:
    text = everything
    page = text[text.index(errata.FIRST) : text.index(errata.GROUPS["proof"])]
    first, stands, *entries = page.strip().split("\n\n")
    assert first == errata.FIRST and stands.startswith("The theorem survives all of these")
    assert entries[0].startswith("s4.3.1-LaSalle, section 4.3.1")
    assert "0 < 0" not in page and "[falls-in-flight]: 49/50 < 9/50" in entries[0]
    for entry in entries:
        titles = [line.split()[0] for line in entry.splitlines()[1:] if line[4] != " "]
        assert titles == ["said", "wrong", "true"], entry


def spoilt_store(folder: Path, *names: str) -> Path:
    """A copy of the store with the certificates of these statements taken out."""
    shutil.copytree(DEFAULT, folder)
    kept = [
        line
        for line in (folder / CERTIFICATES).read_bytes().splitlines(keepends=True)
        if json.loads(line)[0] not in names
    ]
    (folder / CERTIFICATES).write_bytes(b"".join(kept))
    return folder


def test_rejects_that_the_theorem_survives_where_it_is_not_certified(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    claims, not_certified = opened().claims(), "The theorem is not certified (theorem-in-units)."
    assert errata.theorem_stands(claims, "") == not_certified
    store = Store(spoilt_store(tmp_path / "store", THEOREM))
    lost = theorem_line(store, {name: "certified" for name in store.texts if name != THEOREM})
    assert errata.theorem_stands(claims, lost) == not_certified
    monkeypatch.setattr(pages, "DEFAULT", tmp_path / "store")
    assert not_certified in pages.printed_wrongly()


def test_a_refuted_print_that_the_register_lets_hold_is_listed_holds(
    monkeypatch: pytest.MonkeyPatch, everything: str
) -> None:
    forged = {name: {**entry, "verdict": "holds"} for name, entry in load_register().items()}
    monkeypatch.setattr(contents, "load_register", lambda: forged)
    # what is judged, and what the checker says, has no register in it
    monkeypatch.setattr(contents, "outcomes_of", lambda *_: CHECKED)
    monkeypatch.setattr(contents, "judge_some", lambda some, *_: [JUDGED[one.id] for one in some])
    assert errata_text() == everything


@pytest.mark.parametrize(
    "name, place",
    [
        ("eq-38", "section A.3.1, equation (38)"),
        ("s4.3.2-p-not-R", "section 4.3.2, sentence 1 after (31)"),
        ("s2.2.1-H", "section 2.2.1, sentence 1"),
        ("s4.3.2-K-invariant", "section 4.3.2, sentence 3 after (32)"),
        ("sA.3.1-not-on-R0", "section A.3.1, heading"),
        ("prop-1", "section 4.2, Proposition 1"),
        ("region-K", "inclusions, section 4.3.2, sentence 3 after (32)"),
        ("s4.3.1-DK1", "section 4.3.1, display 2 after (28)"),
        ("s4.2-note9-equal", "section 4.2, footnote 9"),
        ("sB.7-T", "section B.7, row of the table 3"),
        ("sB.7-tau-p", "section B.7, row of the table 6"),
        ("theorem", "theorem, normal form"),
    ],
)
def test_places_are_as_a_reader_finds_them_holds(name: str, place: str) -> None:
    (claim,) = [one for one in opened().claims() if one.id == name]
    assert place_of(claim) == place


def test_a_counted_place_leads_back_to_the_claim_holds() -> None:
    """Counted again from the heading, or from the equation that is named, in the ledger."""
    counted, ledger = 0, load_ledger()
    for claim in opened().claims():
        found = re.fullmatch(
            r".*section ([\w.]+), (sentence|display|row of the table) (\d+)(?: after \((\d+)\))?",
            place_of(claim),
        )
        if not found:
            assert not re.search(r"line \d", place_of(claim))
            continue
        section, word, count, number = found.groups()
        rows = [row for row in ledger if row.section == section]
        if number:
            names = {f"eq-{number}", f"eq-{number}a", f"eq-{number}b"}
            ends = [i for i, row in enumerate(rows) if names & {*row.claims} and "-d" in row.key]
            rows = rows[ends[-1] + 1 :]
        kind = {"row of the table": "tablerow"}.get(word, word)
        asked = [i for i, row in enumerate(rows) if row.kind == kind and not is_heading(row)]
        at = asked[int(count) - 1]
        end = next((i for i in range(at + 1, len(rows)) if rows[i].kind != "inline"), len(rows))
        assert claim.id in {name for row in rows[at:end] for name in row.claims}, claim.id
        counted += 1
    assert counted > 150


def test_lines_of_the_transcription_are_told_where_asked_for_holds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    for arguments, place in [
        (["explain", "s4.3.2-K-invariant"], "section 4.3.2, sentence 3 after (32)"),
        (["explain", "s4.3.2-K-invariant", "--lines"], "section 4.3.2 line 565"),
        (["list"], "4.3.2, sentence 3 after (32)"),
        (["list", "--lines"], "4.3.2 line 565"),
    ]:
        assert run(arguments) == 0
        (line,) = [
            line
            for line in capsys.readouterr().out.splitlines()
            if line.startswith("s4.3.2-K-invariant ")
        ]
        assert place in line
        assert ("line 565" in line) == ("--lines" in arguments)


@pytest.mark.parametrize(
    "name, numbers",
    [
        ("s4.3.1-B2-approach", "49/50 < 9/50"),
        ("s4.3.2-K-attracts", "49/50 < 9/50"),
        ("s4.3.1-LaSalle", "0 < 0"),
        ("sA.1-in-step", "10/3 = 2"),
        ("s4.2-less-energy-shorter", "2 <= 5/3"),
    ],
)
def test_counterexamples_show_the_numbers_that_disagree_holds(
    listing: dict[str, dict[str, str]], name: str, numbers: str
) -> None:
    (text,) = [group[name] for group in listing.values() if name in group]
    assert f"in numbers: {numbers}" in map(str.strip, text.splitlines())


def test_every_counterexample_is_in_words_holds(listing: dict[str, dict[str, str]]) -> None:
    for text in (text for group in listing.values() for text in group.values()):
        rows = [line.split("  ")[2] for line in text.splitlines()[1:] if line[4] != " "]
        assert rows.count("in words") == rows.count("fails at"), text


def test_counterexamples_are_in_simple_rationals_holds() -> None:
    store = Store(DEFAULT)
    for name, text in store.texts.items():
        refuted = (store.certificate(name, text) or {}).get("refuted")
        if refuted and refuted[0] != "sign":
            _, adjoined, terms, *_ = refuted
            assert not adjoined, name
            numbers = [int(n) for value in terms.values() for n in re.findall(r"\d+", value)]
            assert max(numbers, default=0) <= 31, name


@pytest.mark.parametrize(
    "name, why",
    [
        ("eq-29", "a sum of a vector and a scalar"),
        ("sB.2-line", "= between a scalar and a vector states no formula"),
        ("sA.4-on-edge", "= between a vector and a scalar states no formula"),
        ("s4.3.1-DK1", "z_{z} has no meaning here"),
    ],
)
def test_what_was_restored_stands_beside_what_was_transcribed_holds(
    listing: dict[str, dict[str, str]], name: str, why: str
) -> None:
    text = listing[errata.GROUPS["restored"]][name]
    (claim,) = [one for one in opened().claims() if one.id == name]
    assert claim.as_it_stands in text and claim.printed in text and why in text
