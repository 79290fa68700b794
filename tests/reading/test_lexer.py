"""Tokens: what is dropped, what is another spelling, where a line end joins and where it separates,
what is refused.
"""

from __future__ import annotations

import pytest

from juggleproof.reading.lexer import PrintError, lex
from tests.rows import each_row


def texts(latex: str) -> list[str]:
    return [token.text for token in lex(latex)[:-1]]


@each_row(
    ("spelled", "plain"),
    [
        (r"a \leq b", r"a\le b"),
        (r"a \geqslant b", r"a\ge b"),
        (r"\left( a \right)", "(a)"),
        (r"\bigl[ a \bigr]", "[a]"),
        (r"\left. a \right.", "a"),
        (r"a\,b\;c\quad d~e\ f\!g", "abcdefg"),
        (r"\boldsymbol{b}", "{b}"),
        (r"\overline{b}", r"\bar{b}"),
        (r"a : = b", "a:=b"),
        (r"a \tag{12}", "a"),
        (r"\begin{split} a &= b \end{split}", "a=b"),
        (r"\{ b \,\big|\, c \}", r"\{b|c\}"),
        (r"k \to \infty", r"k\rightarrow\infty"),
        (r"\dfrac12", r"\frac12"),
    ],
)
def test_spacing_fonts_and_other_spellings_are_the_same_tokens(spelled: str, plain: str) -> None:
    assert texts(spelled) == texts(plain)


def test_positions_are_those_of_the_print() -> None:
    latex = r"\left( \dot{\rho}_0 \right)"
    assert [(t.start, t.end) for t in lex(latex)[:-1]] == [
        (0, 6), (7, 11), (11, 12), (12, 16), (16, 17), (17, 18), (18, 19), (20, 27),
    ]  # fmt: skip


@each_row(
    ("latex", "lines"),
    [
        (r"a \\ = b", 0),
        (r"a = b \\ + c", 0),
        (r"a = b \\ - c", 0),
        (r"a = \\ b", 0),
        (r"a = b \times \\ c", 0),
        (r"a = b \\ c = d", 1),
        (r"a = b, \\ c = d", 0),
        (r"a = b \\", 0),
        (r"a = b \\ \\ c = d", 1),
        (r"\begin{bmatrix} 1 \\ -1 \end{bmatrix}", 1),
    ],
)
def test_a_line_end_separates_only_where_nothing_goes_on(latex: str, lines: int) -> None:
    assert sum(token.kind == "line" for token in lex(latex)) == lines


@each_row(
    ("latex", "message"),
    [
        (r"\alpha + \foo", r"column 10: unknown command \foo"),
        (r"a = ß", "column 5: unknown character ß"),
        (r"a \@ b", r"column 3: unknown character \@"),
        (r"\begin{vmatrix} a \end{vmatrix}", "column 1: unknown environment vmatrix"),
        (r"a \end{cases}", r"column 3: \end{cases} closes nothing"),
        (r"\begin{bmatrix} a", r"column 1: \begin{bmatrix} is never closed"),
        (r"\begin{bmatrix} a \end{cases}", r"column 19: \end{cases} closes nothing"),
        (r"$a$", "column 1: unknown character $"),
    ],
)
def test_what_is_unknown_is_refused_by_name_and_column(latex: str, message: str) -> None:
    with pytest.raises(PrintError) as refusal:
        lex(latex)
    assert str(refusal.value) == message
