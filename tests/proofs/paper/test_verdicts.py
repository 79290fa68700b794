"""Verdicts that were once too good, too soft or too wide: each claim says what is certified of it,
by stored statements that the checker accepts.
"""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache

import pytest

from juggleproof.judging.claims import Assertion, Claim, Reading, Readings, Remark
from juggleproof.judging.correcting import (
    CorrectedPrint,
    coefficients_on_printed_terms,
    differences,
)
from juggleproof.judging.judge import judge
from juggleproof.judging.judgement import Resources
from juggleproof.judging.register import load_register
from juggleproof.papers.paper import opened
from juggleproof.proofs.ledger.unprinted import UNPRINTED
from juggleproof.proofs.paper.names import B1, always, b, energy, f1
from juggleproof.reading.meaning import Printed
from juggleproof.statements.language import ClaimError, reals
from juggleproof.statements.store import DEFAULT, Store
from tests.rows import each_row

REGISTER, STORE = load_register(), Store(DEFAULT)
MOST_AMBIGUOUS = 13


@cache
def claims() -> dict[str, Claim]:
    return {claim.id: claim for claim in opened().claims()}


def outcome(name: str) -> str:
    """The outcome of a stored statement, which the checker accepts in another test."""
    certificate = STORE.certificate(name, STORE.texts[name])
    assert certificate is not None
    return next(word for word in ("certified", "refuted", "unknown") if word in certificate)


def remark(claim_id: str) -> Remark:
    found = claims()[claim_id].remark
    assert found is not None
    return found


# -------------------------------------------------------------------------------------------------
# Wrong or overstated.


def test_s4_1_Emax_maintain_says_one_impact_and_points_to_what_follows_it_holds() -> None:
    assert "over one impact" in claims()["s4.1-Emax-maintain"].says
    assert "sA.1-in-step" in remark("s4.1-Emax-maintain").by
    assert REGISTER["s4.1-Emax-maintain"] == {
        "verdict": "ambiguous",
        "detail": "over-one-impact: holds; for-ever: false",
        "sharp": "over-one-impact: 0 < alpha < 1;"
        " for-ever: alpha = (K - 1)/(K + 1) for a whole number K",
    }
    assert outcome("s4.1-Emax-maintain/for-ever.at-the-next-impact") == "refuted"
    step = REGISTER["sA.1-in-step"]
    assert step["verdict"] == "gap" and step["detail"].startswith("step in-step is false")
    assert step["sharp"] == "in-step: alpha = (K - 1)/(K + 1) for a whole number K"


@each_row("claim_id", ["s4.2-highest-B1plus", "s4.2-adding"])
def test_lost_names_are_told_as_restored_holds(claim_id: str) -> None:
    claim = claims()[claim_id]
    assert r"\ell" in claim.as_it_stands and r"\ell" not in claim.printed
    assert "lost" in remark(claim_id).text and "section 4.1" in remark(claim_id).text


def test_eq_38_is_refuted_by_the_corner_holds() -> None:
    assert REGISTER["eq-38"] == {
        "verdict": "false",
        "correction": r"\text{(38) or } \overline{\beta} = 0",
        "sharp": "nowhere",
    }
    assert outcome("eq-38/main") == "refuted" and outcome("eq-38/corrected.main") == "certified"
    assert "step of A.3.1 that does not follow" in remark("eq-38").text


@each_row(
    "claim_id, sharp",
    [
        ("s4.4-global", "0 < alpha < 1/3"),
        ("s4.4-e1-attracts-K", "at least 0 < alpha < 1/3"),
        ("s4.3.1-approach-constant", "at least 0 < alpha < 1/3"),
        ("s4.3.1-plain-english", "at least 0 < alpha < 1/3"),
        ("s4.3.1-lim-b", "at least 0 < alpha < 1/3"),
        ("s4.3-decay-to-K", "at least 0 < alpha < 1/3"),
        ("sB.7-K-region", "at least 0 < alpha < 1/3"),
        ("prop-1", "0 < alpha < 1"),
    ],
)
def test_range_of_an_orbit_claim_is_sharp_only_where_it_is_refuted_beyond_holds(
    claim_id: str, sharp: str
) -> None:
    assert REGISTER[claim_id]["sharp"] == sharp


def test_s3_5_3_locally_stable_fails_just_at_the_left_ends_holds() -> None:
    entry = REGISTER["s3.5.3-locally-stable"]
    assert entry["verdict"] == "false" and "above the left end" in entry["correction"]
    assert entry["sharp"].endswith("conclusion: (K - 1)/(K + 1) < alpha < 1")
    names = [name for name in STORE.texts if name.startswith("s3.5.3-locally-stable/corrected.")]
    assert len(names) == 7 and {outcome(name) for name in names} == {"certified"}


@each_row("claim_id", ["s4.3.1-plain-english", "s4.3.1-approach-constant"])
def test_s4_3_1_each_impact_is_told_of_the_relative_energy_only_holds(claim_id: str) -> None:
    assert "relative to e_1" in claims()[claim_id].says
    assert "closer" not in claims()[claim_id].says


def test_sB_3_f2_is_mended_in_names_that_its_section_binds_holds() -> None:
    mended = r"\overline{f}_2(\overline{b}_k) := A_T \overline{b}_k - \alpha_T"
    assert REGISTER["sB.3-f2"]["correction"] == mended
    assert outcome("sB.3-f2/corrected.main") == "certified"


@each_row(
    "claim_id, latex, unbound",
    [
        ("sB.3-f2", r"\overline{f}_2(\overline{b}_k) := A_T x - \alpha_T", ["x"]),
        ("sB.3-f2", r"\overline{f}_2(\overline{b}_k) := A_T \overline{b}_k - \alpha_T", []),
        ("s2.2.2-newton", r"\ddot{y} = -\gamma", [r"\dot{\dot{y}}"]),
        ("eq-2", r"\dot{\chi}' = -\alpha\dot{\chi} \\ 0 < \alpha < 1 \\ \chi = x - y", []),
    ],
)
def test_rejects_a_correction_with_a_name_that_nothing_binds(
    claim_id: str, latex: str, unbound: list[str]
) -> None:
    candidate = CorrectedPrint("marks", "", latex, Printed(latex))
    assert candidate.unbound(claims()[claim_id]) == unbound


def test_sB_3_f2_would_be_certified_with_x_but_is_not_corrected_so_holds() -> None:
    first = claims()["sB.3-f2"]
    unbound = replace(first, mended=first.mended.replace(r"A_T \overline{b}_k", "A_T x"))
    judged = judge(unbound, Resources(("exact",)))
    assert judged.correction is None and judged.verdict.word == "false"


def test_sB_7_C_is_mended_by_a_swap_holds() -> None:
    assert REGISTER["sB.7-C"]["verdict"] == "misprint"
    assert REGISTER["sB.7-C"]["correction"] == "C_{x}(y)"


def test_sA_3_2_sup3_is_corrected_in_a_print_that_reads_back_holds() -> None:
    text = REGISTER["sA.3.2-sup3"]["correction"]
    assert text == (
        r"\Delta E_{sup} = (-\frac{1 + \alpha}{1 - \alpha} + \frac{1}{2} + \frac{1}{2} \alpha"
        r" + \sqrt{2 (1 + \alpha)} \frac{\alpha}{1 - \alpha}) (1 + \alpha) \dot{\rho}_{0}^{2}"
    )
    (statement,) = claims()["sA.3.2-sup3"].body(Printed(text)).parts  # type: ignore[union-attr]
    stored = STORE.texts["sA.3.2-sup3/corrected.main"].splitlines()
    assert statement.text().splitlines()[1:] == stored[1:]
    assert outcome("sA.3.2-sup3/corrected.main") == "certified"


def test_s4_3_1_LaSalle_needs_continuity_and_would_prove_what_is_false_holds() -> None:
    assert {"s3.3.1-discontinuous", "s4.3.1-DK-negative"} == set(remark("s4.3.1-LaSalle").by)
    assert outcome("s4.3.1-LaSalle/remark.comes-back") == "certified"
    assert "range 2*alpha = 1" in STORE.texts["s4.3.1-LaSalle/remark.comes-back"]


@each_row("claim_id", ["s4.2-count", "sA.4-count", "eq-26"])
def test_counts_say_which_loss_they_use_holds(claim_id: str) -> None:
    assert "derived least loss" in claims()[claim_id].says
    assert "theorem-count" in remark(claim_id).by


def test_eq_26_is_too_early_for_samples_at_every_alpha_holds() -> None:
    for label in ("counted", "outside-in-flight"):
        name = f"eq-26/remark.{label}"
        assert outcome(name) == "certified"
        assert "range alpha > 0\nrange alpha < 1\n" in STORE.texts[name]
    assert "not found" not in REGISTER["eq-26"]["sharp"]


# -------------------------------------------------------------------------------------------------
# Readings and remarks.


def test_few_claims_are_ambiguous_and_each_reading_has_its_passage_holds() -> None:
    ambiguous = [name for name, entry in REGISTER.items() if entry["verdict"] == "ambiguous"]
    assert 0 < len(ambiguous) <= MOST_AMBIGUOUS
    for name in ambiguous:
        body = claims()[name].body()
        assert isinstance(body, Readings)
        for reading in body.of.values():
            assert re.search(r"\((\d+)\)|\b[234AB]\.\d", reading.passage), (name, reading.passage)


def test_claims_of_our_own_have_one_reading_holds() -> None:
    own = [claim for claim in claims().values() if not re.match(r"[0-9AB]", claim.section)]
    assert {*UNPRINTED} <= {claim.id for claim in own}
    assert not [claim.id for claim in own if isinstance(claim.body(), Readings)]


SOME = Assertion((always(energy(f1(b)) >= 0, given=[B1(b)]),))


@each_row(
    "readings",
    [
        {},
        {"one": Reading(SOME, "section 4.1")},
        {"one": Reading(SOME, "section 4.1"), "other": Reading(SOME, " ")},
    ],
)
def test_rejects_a_second_reading_without_a_passage(readings: dict[str, Reading]) -> None:
    with pytest.raises(ClaimError, match="one reading alone|no passage"):
        Readings(readings)


def test_remarks_rest_on_claims_that_are_settled_holds() -> None:
    for claim in claims().values():
        for name in claim.remark.by if claim.remark else ():
            assert REGISTER[name]["verdict"] != "unknown", (claim.id, name)


def test_rejects_a_claim_whose_remark_is_false() -> None:
    first = claims()["eq-14"]
    false = Remark("nonsense", lambda: always(energy(b) < 0))
    judged = judge(replace(first, remark=false), Resources(("exact",)))
    assert (judged.verdict.word, judged.verdict.detail) == (
        "unknown",
        "its remark is not certified",
    )


@each_row(
    "claim_id",
    ["s2.2.2-newton", "sA.3-sup", "sB.1-collision", "sB.1-tau", "sB.1-period", "sB.7-C"],
)
def test_what_is_clear_in_meaning_is_a_misprint_holds(claim_id: str) -> None:
    entry = REGISTER[claim_id]
    assert entry["verdict"] == "misprint" and entry["correction"]


@each_row(
    "claim_id",
    ["s4.2-less-energy-shorter", "sA.3.1-not-on-R0", "sA.4-not-on-boundary"],
)
def test_what_is_false_as_printed_is_told_so_with_what_is_true_holds(claim_id: str) -> None:
    entry = REGISTER[claim_id]
    assert entry["verdict"] == "false" and entry["correction"]
    corrected = [name for name in STORE.texts if name.startswith(f"{claim_id}/corrected.")]
    assert corrected and {outcome(name) for name in corrected} == {"certified"}


def test_coefficients_draw_signs_and_numbers_together_holds() -> None:
    x, y = reals("x y")
    assert str(coefficients_on_printed_terms(1 - x + y, 3 * x + y / 2 + 2)) == "2 + 3*x + 1/2*y"


def test_differences_name_each_mark_holds() -> None:
    first = claims()["sB.3-f2"]
    assert differences(first.printed, first.mended) == [
        "1 to 2",
        "- dropped",
        r"x to \bar{b}_k",
    ]
