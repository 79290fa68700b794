"""Changed prints: what is changed of each token, and one changed mark mends a lost one.  That each
change is refused or changes the statement is asked of the paper's prints, in paper/test_prints.py.
"""

from __future__ import annotations

import sys
from collections import Counter
from fractions import Fraction

from juggleproof.reading import evaluation, lexer, parser
from juggleproof.reading.edits import ALTERNATIVES, mutations, one_mark_changes
from juggleproof.reading.lexer import PrintError
from juggleproof.reading.meaning import Printed
from juggleproof.reading.parser import parse
from juggleproof.statements.language import Formula
from tests.reading.paper_names import ALL, KINETIC, PAPER, WIDE, value_at
from tests.rows import each_row


def formula_of(latex: str) -> tuple[Formula, evaluation.Environment] | None:
    for names in (PAPER, WIDE, KINETIC):
        try:
            return Printed(latex).formula(names), names
        except PrintError:
            continue
    return None


def test_every_token_that_means_something_is_changed() -> None:
    latex = r"0 \le \tau_c(\overline b) < T \tag{7}"
    changed = dict(mutations(latex))
    columns = {int(change.split()[1].rstrip(":")) for change in changed}
    assert columns == {1, 3, 7, 11, 12, 13, 14, 24, 25, 27, 29}
    assert all(text != latex for text in changed.values()) and len(set(changed.values())) == len(
        changed
    )


@each_row(
    ("latex", "changed"),
    [
        (r"a + b", r"a - b"),
        (r"a < b", r"a \le b"),
        (r"a \ge b", r"a > b"),
        (r"\frac{1+a}{b}", r"\frac{b}{1+a}"),
        (r"\frac{1}{2}", r"\frac{2}{1}"),
        (r"\frac12", r"\frac13"),
        (r"a^{2} b", r"a b"),
        (r"a_{2} b", r"a b"),
        (r"\dot{a}", r"{a}"),
        (r"\dot\rho", r"\rho"),
        (r"a'", r"a"),
        (r"a", r"a'"),
        (r"\beta", r"{\dot{\beta}}"),
        (r"\alpha b", r"\gamma b"),
        (r"(a+b)c", r" a+b c"),
        (r"x \in \mathcal{B}", r"x \notin \mathcal{B}"),
        (r"E_{max}", r"E_{sup}"),
        (r"x^{-1}", r"x^{1}"),
    ],
)
def test_this_change_is_among_them(latex: str, changed: str) -> None:
    assert changed in {text for _, text in mutations(latex)}


def test_the_alternatives_are_tokens_that_are_read() -> None:
    for sign, others in ALTERNATIVES.items():
        for text in (sign, *others):
            assert len(lexer.lex(text)) == 2


@each_row(
    ("lost", "mended", "kind"),
    [
        (r"T = \frac{2\rho_0}{\gamma}", r"T = \frac{2\dot\rho_0}{\gamma}", "dot"),
        (r"\tau_c = \frac{\beta}{\dot\rho_0 - \dot{\overline\beta}}",
         r"\tau_c = \frac{\overline\beta}{\dot\rho_0 - "
         r"\dot{\overline\beta}}", "bar"),
        (r"\overline{f}_1(\overline b) := \alpha A_T \overline b + (\alpha - 1) A_{-\xi_1} r_0",
         r"\overline{f}_1(\overline b) := -\alpha A_T \overline b + (\alpha - 1) A_{-\xi_1} r_0",
         "sign"),
        (r"E_{max} = \frac{1}{2} \left(\frac{1+\alpha}{1-\alpha} \dot\rho_0\right)",
         r"E_{max} = \frac{1}{2} \left(\frac{1+\alpha}{1-\alpha} \dot\rho_0\right)^2", "exponent"),
        (r"E_{max} = \left(\frac{1+\alpha}{1-\alpha} \dot\rho_0\right)^2",
         r"E_{max} = \frac{1}{2} \left(\frac{1+\alpha}{1-\alpha} \dot\rho_0\right)^2", "half"),
        (r"\overline f_2(e_1) = e_1", r"\overline f_1(e_1) = e_1", "index"),
        (r"0 < 0", r"0 \le 0", "strictness"),
    ],
)  # fmt: skip
def test_a_lost_mark_is_found_by_one_change(lost: str, mended: str, kind: str) -> None:
    points = [
        {
            "alpha": Fraction(1, 4),
            "beta": Fraction(3),
            "v": Fraction(-2),
            "r": Fraction(5),
            "g": Fraction(10),
        },
        {
            "alpha": Fraction(2, 7),
            "beta": Fraction(1, 3),
            "v": Fraction(1),
            "r": Fraction(4),
            "g": Fraction(9),
        },
    ]

    def true_everywhere(latex: str) -> bool:
        try:
            stated = Printed(latex).formula(PAPER)
            return all(value_at(stated, point) for point in points)
        except (PrintError, KeyError):
            return False

    assert not true_everywhere(lost)
    change, first = next(
        (change, changed) for change, changed in one_mark_changes(lost) if true_everywhere(changed)
    )
    assert change.startswith(kind + ": ")
    assert Printed(first).formula(PAPER) == Printed(mended).formula(PAPER)


def test_simpler_marks_come_first_and_all_can_be_read() -> None:
    order = [
        "dot",
        "bar",
        "prime",
        "sign",
        "exponent",
        "half",
        "index",
        "strictness",
        "letter",
        "swap",
    ]
    latex = next(latex for where, latex in ALL if where == "20")
    changes = list(one_mark_changes(latex))
    kinds = [order.index(change.split(":")[0]) for change, _ in changes]
    assert kinds == sorted(kinds) and set(kinds) >= set(range(9))
    trees = [parse(changed) for _, changed in changes]
    assert len(set(trees)) == len(trees) and parse(latex) not in trees


def test_all_displays_are_lexed_parsed_and_evaluated_quickly() -> None:
    """Counted in calls of Python's functions, which no other load of the machine changes: 10^5 take
    a tenth of a second.
    """
    for cached in (lexer.lex, parser.parse, evaluation._key):
        cached.cache_clear()
    calls = Counter[str]()
    sys.setprofile(lambda _frame, event, _of: calls.update([event]) if event == "call" else None)
    try:
        for _, latex in ALL:
            formula_of(latex)
    finally:
        sys.setprofile(None)
    assert 0 < calls["call"] < 100_000
