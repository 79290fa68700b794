"""The scanner on small texts of our own: what becomes an item, what does not, and in which
order.
"""

import pytest

from juggleproof.proofs.ledger.ledger import Item, scan


def shape(text: str) -> list[tuple[str, int, str]]:
    return [(item.key, item.line, item.text.strip()) for item in scan(text)]


def test_only_the_sections_in_scope_give_items() -> None:
    text = (
        "2. Out\nNo.\n2.1. Out\nNo.\n2.2. In\n3.1.2. Deep. Yes.\n5. OUT\nNo.\nAPPENDIX A."
        " BACK\nA.1. More\n"
    )
    assert shape(text) == [
        ("2.2-s01", 5, "In"),
        ("3.1.2-s01", 6, "Deep."),
        ("3.1.2-s02", 6, "Yes."),
        ("A-s01", 9, "BACK"),
        ("A.1-s01", 10, "More"),
    ]


def test_references_close_the_scope_and_a_number_after_its_heading_opens_a_section() -> None:
    text = (
        "4.4. In\nReferences\n- 1. A. Author. A book.\nAPPENDIX B. TABLES\nHow Many B.1.\nSome.\n"
    )
    assert [item.key for item in scan(text)] == ["4.4-s01", "B-s01", "B.1-s01", "B.1-s02"]


def test_the_proposition_opens_the_section_whose_heading_is_lost() -> None:
    assert [item.section for item in scan("4.1. Edge\nProposition 1. It stays.\n")] == [
        "4.1",
        "4.2",
        "4.2",
    ]


def test_a_display_over_several_lines_is_one_item_with_its_first_line() -> None:
    assert shape("3.2. A\n$$a\n= b$$\n (9)\n\nand\n$$c$$\n.\n") == [
        ("3.2-s01", 1, "A"),
        ("3.2-d01", 2, "a\n= b"),
        ("3.2-s02", 6, "and"),
        ("3.2-d02", 7, "c"),
    ]


def test_a_sentence_comes_before_its_formulas_and_no_dot_inside_a_formula_ends_it() -> None:
    assert shape("3.2. A\nLet $x. Y$ be small. So $z$ is.\n") == [
        ("3.2-s01", 1, "A"),
        ("3.2-s02", 2, "Let $x. Y$ be small."),
        ("3.2-i01", 2, "x. Y"),
        ("3.2-s03", 2, "So $z$ is."),
        ("3.2-i02", 2, "z"),
    ]


def test_abbreviations_decimals_and_numbers_of_sections_do_not_end_a_sentence() -> None:
    assert len(scan("3.2. A\nSee it (i.e., now) in section 3.4 and 0.5 of Fig. 7, as said.\n")) == 2


def test_captions_notes_and_table_rows_are_told_apart_from_prose() -> None:
    text = (
        "B.7. Names\nFigure 3 shows much.\nFigure 3 Much.\n⁷ Mind this. And so.\n$^{^{10}}$"
        " Note.\nT\tperiod $T$\n"
    )
    assert [(item.key, item.kind) for item in scan(text)] == [
        ("B.7-s01", "sentence"),
        ("B.7-s02", "sentence"),
        ("B.7-c01", "caption"),
        ("B.7-n01", "note"),
        ("B.7-n02", "note"),
        ("B.7-n03", "note"),
        ("B.7-t01", "tablerow"),
        ("B.7-i01", "inline"),
    ]


def test_a_display_that_is_never_closed_is_refused() -> None:
    with pytest.raises(ValueError, match="never closed"):
        scan("3.2. A\n$$a\n")


def test_the_digest_sees_every_mark_but_no_spacing() -> None:
    def digest(text: str) -> str:
        return Item("3.2-d01", "3.2", 1, "display", text).digest

    assert digest("a <\n b ") == digest("a < b")
    assert digest("a < b") != digest("a > b")
    assert digest("a") == "ca978112ca1bbdca"  # the published SHA-256 of the letter a
