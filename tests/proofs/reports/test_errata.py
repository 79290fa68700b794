"""`juggleproof errata`: every claim that is not simply true stands in one group, with its print,
what is wrong, and exact values.
"""

from __future__ import annotations

import json
import re

import pytest

from juggleproof.certificates.store import DEFAULT, Store
from juggleproof.proofs.paper import paper_claims
from juggleproof.proofs.register import load_register
from juggleproof.proofs.reports import errata
from juggleproof.proofs.run import FINDINGS

TITLES = list(errata.GROUPS.values())


@pytest.fixture(scope="module")
def listing() -> dict[str, dict[str, str]]:
    """The entries by group and claim, as they are printed."""
    groups: dict[str, dict[str, str]] = {}
    for block in errata.as_text().split("\n\n"):
        heading = re.fullmatch(r"(.*) \((\d+)\)", block.strip())
        if heading and heading[1] in TITLES:
            groups[heading[1]] = {}
        elif groups and not block.startswith("Mangled"):
            groups[list(groups)[-1]][block.split(",")[0].strip()] = block
    return groups


def test_groups_stand_in_order_and_hold_every_claim_that_is_not_true(
    listing: dict[str, dict[str, str]],
) -> None:
    assert list(listing) == TITLES
    named = [name for group in listing.values() for name in group]
    register = load_register()
    assert sorted(named) == sorted(
        name
        for name, entry in register.items()
        if entry["verdict"] not in ("holds", "simulated", "unknown")
    )
    assert all(
        register[name]["verdict"] == "ambiguous" for name in listing[errata.GROUPS["readings"]]
    )


def test_every_entry_says_what_is_wrong_and_where_it_fails(
    listing: dict[str, dict[str, str]],
) -> None:
    register = load_register()
    for group in listing.values():
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
    claims = {claim.id: claim for claim in paper_claims()}
    listed = {name for group in listing.values() for name in group}
    assert listing[errata.GROUPS["repeats"]]
    for title, group in listing.items():
        for name in group:
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
        for name in listing[errata.GROUPS["errors"]]
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


def test_rejects_errata_without_a_register(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(errata, "load_register", dict)
    with pytest.raises(errata.ClaimError, match="no verdict is registered yet"):
        errata.as_text()
