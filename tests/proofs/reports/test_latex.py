"""Every formula that reports set as LaTeX is read back by a reader that shares nothing with the
printer, and has the same values.
"""

from __future__ import annotations

import pytest

from juggleproof.certificates import checker
from juggleproof.proofs.reports.latex import latex_of, narrow, with_macros, without_macros
from juggleproof.proofs.reports.words import formulas_of
from tests.proofs.reports.comparison import differences
from tests.proofs.reports.runs import contents


def texts() -> list[str]:
    found = [one.text for entry in contents().entries for one in entry.statements]
    return found + [premise.text for rule in contents().rules for premise in rule.premises]


def test_every_formula_of_every_statement_reads_back_holds() -> None:
    pairs = dict.fromkeys(pair for text in texts() for pair in formulas_of(text))
    assert len(pairs) > 800
    assert differences(pairs) == []


def test_every_derivation_reads_back_holds() -> None:
    entries = dict.fromkeys(
        entry for one in contents().derivations for row in one.shown for entry in row
    )
    assert len(entries) > 50
    assert differences((entry, latex_of(entry)) for entry in entries) == []


def test_every_corrected_term_reads_back_holds() -> None:
    terms = [
        str(entry.correction["text"])
        for entry in contents().entries
        if entry.correction and entry.correction["kind"] in ("coefficients", "derived")
    ]
    assert terms and differences((text, latex_of(text)) for text in terms) == []


def test_every_formula_is_read_with_its_macros_holds() -> None:
    pairs = dict.fromkeys(pair for text in texts() for pair in formulas_of(text))
    changed = [
        (text, without_macros(with_macros(latex)))
        for text, latex in pairs
        if "\\jug" in with_macros(latex)
    ]
    assert len(changed) > 500 and differences(changed) == []


@pytest.mark.parametrize("text", ["f(x)", "x, y", "x if y else z", "x and", "1.5*x"])
def test_rejects_what_is_no_term(text: str) -> None:
    with pytest.raises((TypeError, KeyError, checker.Rejected)):
        latex_of(text)


def plain(latex: str) -> str:
    """A print without the marks that do not change how it is read: spaces, and braces around one
    sign.
    """
    return "".join(
        narrow(latex).replace(r"\mathcal{", r"\mathcal ").replace("{", "").replace("}", "").split()
    )


def test_macros_stand_for_what_was_printed_holds() -> None:
    prints = [entry.claim.printed for entry in contents().entries if entry.claim.printed]
    assert len(prints) > 100
    for latex in prints:
        assert plain(without_macros(with_macros(latex))) == plain(latex), latex
