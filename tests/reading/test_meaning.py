"""Meanings: products told from applications, families, sets, cases, and exact values at a rational
point.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from juggleproof.reading.evaluation import Environment
from juggleproof.reading.lexer import PrintError
from juggleproof.reading.meaning import Printed, read
from juggleproof.reading.values import (
    ExtremalValue,
    LimitValue,
    Matrix,
    Region,
    Restricted,
    Rounded,
    StateFunction,
    Vector,
)
from juggleproof.statements.language import ClaimError, Term, equal, implies, reals
from tests.reading.paper_names import ALL, BETA, KINETIC, PAPER, POINTS, WIDE, V, value_at
from tests.rows import each_row

Q = Fraction
POINT = {
    "alpha": Q(1, 4), "beta": Q(3), "v": Q(-2), "r": Q(5), "g": Q(10), "t": Q(1, 2),
    "beta0": Q(1), "v0": Q(2),
    "K": Q(3), "eps": Q(1), "s": Q(7), "mu": Q(5, 4), "rho_dot": Q(4),
}  # fmt: skip


def exact(latex: str, environment: Environment = PAPER) -> Any:
    return value_at(Printed(latex).value(environment), POINT)


@each_row(
    ("latex", "value"),
    [
        (r"T", 1),
        (r"\tau_c(\overline b)", Q(3, 7)),
        (r"\tau_c", Q(3, 7)),
        (r"\tau_c(\overline\beta, \dot{\overline\beta})", Q(3, 7)),
        (r"\tau_c(\dot{\overline\beta} - \dot\rho_0)", -3),
        (r"\alpha(1 - \alpha)", Q(3, 16)),
        (r"2\alpha^2(1-\alpha)^2", Q(9, 128)),
        (r"E(\overline b)", 32),
        (r"E(\overline b)^2", 1024),
        (r"\alpha E(\overline b) \gamma", 80),
        (r"E \circ \overline f_1(\overline b)", Q(489, 32)),
        (r"E(\overline f_1(\overline b)) - E", Q(-535, 32)),
        (r"\Delta_1 E", Q(-535, 32)),
        (r"\Delta E(\overline b)", Q(-535, 32)),
        (r"\Delta E_{max}", Q(125, 6)),
        (r"\frac{1}{2}(\dot{\overline\beta} - \gamma \tau_c)^2", Q(968, 49)),
        (r"[F^{\tau_c}(\overline b)]_1", Q(3) - 2 * Q(3, 7) - 5 * Q(9, 49)),
        (r"F^t \circ \overline b_0", (Q(3, 4), Q(-3))),
        (r"F^t(F^{-t}(\overline b_0))", (1, 2)),
        (r"A_{t + t}\overline b", (1, -2)),
        (r"A_{[-\tau_c]} A_{\tau_c} \overline b", (3, -2)),
        (r"A_T^2 \overline b", (-1, -2)),
        (r"A_T^{-1} \overline b", (5, -2)),
        (r"(I + \alpha A_T)^{-1}", ((Q(4, 5), Q(-4, 25)), (0, Q(4, 5)))),
        (r"\overline f_1(\overline b)", (1, Q(-13, 4))),
        (
            r"\overline f_1 \circ \overline f_2(\overline b)",
            (Q(1, 4) * 16 + Q(5, 4), Q(3) - Q(15, 4)),
        ),
        (
            (
                r"[\frac12\gamma, \dot\rho_0] \begin{bmatrix} \overline\beta \\"
                r" \dot{\overline\beta} \end{bmatrix}"
            ),
            5,
        ),
        (r"\gamma T \begin{bmatrix} T/2 \\ 1 \end{bmatrix}", (5, 10)),
        (r"r_0/2 + \overline b", (3, Q(1, 2))),
        (r"C_{r_0}(\overline b)", (3, 5 + Q(1, 4) * 5 + Q(1, 4) * 2)),
        (r"\sqrt{2(1+\alpha)}", 7),
        (r"-2^2", -4),
        (r"2^{-1}", Q(1, 2)),
        (r"0.25 \gamma", Q(5, 2)),
    ],
)
def test_a_print_has_this_value_at_an_exact_point(latex: str, value: Any) -> None:
    assert exact(latex) == value


@each_row(
    ("latex", "true"),
    [
        (r"0 < \alpha < \frac{1}{3}", True),
        (r"\frac{1}{4} < \alpha < \frac{1}{3}", False),
        (r"e_1 \in \beta_1", True),
        (r"\overline b \in \mathcal{B}_2", False),
        (r"\overline b \notin \mathcal{H} - \mathcal{B}_1", True),
        (r"\overline b \in \mathcal{B}_1 \cap \mathcal{B}_2", False),
        (r"\overline b \in \mathcal{B}_1 \cup \mathcal{B}_2", True),
        (r"\overline f_1(e_1) = e_1", True),
        (r"\overline f_2(e_1) = e_1", False),
        (r"\overline f_2(e_1) \ne e_1", True),
        (r"\Delta_2 E \equiv 0", True),
        (r"\mathcal{B}_1 \subset \mathcal{H}", True),
        (r"\mathcal{H} \subseteq \mathcal{B}_2", False),
        (r"\overline f_2(\mathcal{H}) \subset \mathcal{H}", False),
        (r"\overline f_1(\mathcal{B}_1) \subseteq \mathcal{H}", True),
        (r"\forall \overline b \in \beta_2, \tau_c < 0", True),
        (r"\forall \overline b \in \beta_1, \tau_c < 0", False),
        (r"E \circ \overline f_1 |_{\mathcal{B}_2} = 0", True),
        (r"E \circ \overline f_1 |_{\mathcal{B}_1} = 0", False),
        (r"\mathcal{B}_1 := \{ \overline b \in \mathcal{H} | \tau_c < T \}", True),
        (
            r"\mathcal{B}_1 := \{ \overline b \in \mathcal{H} | \tau_c < T, \overline\beta < 0 \}",
            False,
        ),
        (r"\overline b(t) = \overline b", None),
    ],
)
def test_a_print_is_true_or_false_at_an_exact_point(latex: str, true: bool | None) -> None:
    if true is None:
        with pytest.raises(
            PrintError, match=r"column 12: \\overline{b} is a vector, not a function"
        ):
            Printed(latex).formula(PAPER)
    else:
        assert value_at(Printed(latex).formula(PAPER), POINT) is true


def test_the_paper_s_energy_change_agrees_with_the_map_at_the_point() -> None:
    print_ = next(latex for where, latex in ALL if where == "16")
    ((left, sign, right),) = Printed(print_).relation_chain(PAPER)
    assert (value_at(left, POINT), sign, value_at(right, POINT)) == (Q(-535, 32), "=", Q(-535, 32))


def test_a_chain_gives_every_relation_with_both_values() -> None:
    print_ = Printed(r"0 \le \tau_c(\overline b) < T \tag{7}")
    chain = print_.relation_chain(PAPER)
    assert [sign for _, sign, _ in chain] == [r"\le", "<"]
    assert [value_at(left, POINT) for left, _, _ in chain] == [0, Q(3, 7)]
    assert value_at(print_.left(PAPER), POINT) == 0 and value_at(print_.right(PAPER), POINT) == 1
    assert all(isinstance(side, Term) for left, _, right in chain for side in (left, right))
    assert str(print_.formula(PAPER)) == "0 <= beta/(r - v) and beta/(r - v) < 2*r/g"


# juxtaposition
# --------------------------------------------------------------------------------------------------

A, X, Y = reals("a x y")
TWICE = Environment(
    {
        "f": lambda value: value * 2,
        "a": A,
        "x": X,
        "y": Y,
        "h": StateFunction(lambda s: s.component(1)),
    }
)


@each_row(
    ("latex", "text"),
    [
        ("a(x + y)", "a*(x + y)"),
        ("f(x + y)", "(x + y)*2"),
        ("a f(x) y", "a*(x*2)*y"),
        ("f(x)^2", "(x*2)^2"),
        ("f(x)(y)", "x*2*y"),
        ("f(f(x))", "x*2*2"),
        ("a/f(x)", "a/(x*2)"),
        ("a x/y", "a*x/y"),
        ("-a x", "-a*x"),
        ("h(x, y)", "x"),
        ("(a)(x)", "a*x"),
    ],
)
def test_a_function_before_a_bracket_is_applied_and_all_else_is_a_product(
    latex: str, text: str
) -> None:
    assert str(read(latex).value(TWICE)) == text


@each_row(
    ("latex", "message"),
    [
        ("a/x y", r"column 2: what / divides by is ambiguous: bracket it, or write \frac"),
        ("a/x(y)", r"column 2: what / divides by is ambiguous: bracket it, or write \frac"),
        ("a f", "column 3: f stands without its argument, and the environment has no state"),
        ("f + x", "column 1: f stands without its argument, and the environment has no state"),
        ("h(x)", "column 1: a function of a state, given something else"),
        ("a x b", "column 5: b has no meaning here"),
        ("x'", "column 1: x' has no meaning here"),
        (r"\dot x", r"column 1: \dot{x} has no meaning here"),
        ("x^y", "column 3: the exponent of x is not an integer, and has no other meaning here"),
        ("x^+", "column 1: x^{+} has no meaning here"),
        ("x/0", "column 2: a division by zero"),
        (r"\frac{x}{1 - 1}", "column 1: a division by zero"),
        (r"a \circ x", r"column 1: a is not a function, which \circ needs on its left"),
        (r"\sqrt{x}", "column 1: this root has no meaning here"),
        ("|x|", "column 1: this absolute has no meaning here"),
        ("(x, y) + a", "column 8: a sum of a vector and a scalar"),
        ("(x, y)(x, y)", "column 7: (...) is a vector, not a function, and a bracket follows it"),
        ("((x, y), a)", "column 2: an entry of a vector or matrix that is not a scalar"),
        ("[(x, y)]_3", "column 1: component 3 of a vector with 2 entries"),
        (r"x \cap y", "column 1: x is not a region"),
        ("a_{1}", "column 1: a_{1} has no meaning here"),
        (r"\cdot", r"column 1: \cdot has no meaning here"),
    ],
)
def test_what_has_no_meaning_is_refused_by_token_and_column(latex: str, message: str) -> None:
    with pytest.raises(PrintError) as refusal:
        read(latex).value(TWICE)
    assert str(refusal.value) == message


# environments
# --------------------------------------------------------------------------------------------------


def test_a_whole_expression_may_be_a_key_and_comes_before_its_pieces() -> None:
    e_of_t = PAPER.extended({r"E(t)": 5, r"\Delta E_{sup}": 3})
    assert exact(r"2E(t) + E(\overline b) + \Delta E_{sup}", e_of_t) == 45
    with pytest.raises(PrintError, match="column 1: a function of a state, given something else"):
        exact(r"E(t)")


def test_a_family_takes_its_sub_and_superscript() -> None:
    names = Environment(
        {r"A_{\cdot}^{\cdot}": lambda s, k: s * 10 + k, "k": 7, r"\sqrt{\cdot}": lambda q: q * q}
    )
    assert value_at(read("A_3^k").value(names), {}) == 37
    assert value_at(read(r"A_{k-2}^{k+1} + \sqrt{k}").value(names), {}) == 58 + 49


def test_a_definition_gives_its_value_to_this_expression_only() -> None:
    print_ = Printed(
        r"\tau_c(\overline b) := \frac{\overline\beta}{\dot\rho_0 - \dot{\overline\beta}}"
    )
    assert value_at(print_.definition(PAPER, of=r"\tau_c(\overline{b})"), POINT) == Q(3, 7)
    with pytest.raises(
        PrintError, match=r"column 1: this juxtaposition stands here, where \\tau_c was expected"
    ):
        print_.definition(PAPER, of=r"\tau_c")
    with pytest.raises(
        PrintError, match="column 1: a definition is one expression, one :=, one value"
    ):
        Printed(r"T < \alpha").definition(PAPER, of="T")


def test_names_are_those_of_the_print_in_order() -> None:
    assert Printed(r"\dot\rho_0 = \alpha T + \alpha").names == (r"\dot{\rho}_{0}", r"\alpha", "T")


def test_a_float_has_no_meaning_anywhere() -> None:
    with pytest.raises(ClaimError, match=r"x is given the float 0.5"):
        Environment({"x": 0.5})


def test_a_state_must_be_among_the_names() -> None:
    with pytest.raises(ClaimError, match=r"the state b has no meaning"):
        Environment({"x": 1}, state="b")


# sets, cases, notions
# ------------------------------------------------------------------------------------------------


def test_a_set_is_a_predicate_of_any_state() -> None:
    region = Printed(r"\mathcal{A} := \{ \overline b \mid \overline\beta \ge 0 \}").set_predicate(
        PAPER
    )
    assert isinstance(region, Region)
    assert str(region(Vector((X, Y)))) == "x >= 0"
    within = Printed(
        r"\beta_2 := \{ \overline b \in \mathcal{A} \mid T \le \tau_c(\overline b) \}"
    ).set_predicate(PAPER, of=r"\beta_2")
    assert str(within(Vector((X, Y)))) == "x >= 0 and 2*r/g <= x/(r - y)"


@each_row(
    ("latex", "message"),
    [
        (
            r"\beta_1 := \{ \overline b \in \mathcal{A} \mid \tau_c < T \}",
            r"column 1: \beta_{1} is defined here, where \beta_2 was expected",
        ),
        (
            r"\beta_2 := \{ r_0 \in \mathcal{A} \mid \tau_c < T \}",
            "column 15: r_{0} is not a point whose components the",
        ),
        (r"\beta_2 := \{ \overline b \in T \mid \tau_c < T \}", "column 31: T is not a region"),
        (
            r"\beta_2 := \{ \overline b \in \mathcal{A} \mid \tau_c \}",
            "column 48: this states nothing",
        ),
        (
            r"\beta_2 := \{ \overline b \in \mathcal{A} \mid \tau_p < T \}",
            r"column 48: \tau_{p} has no meaning here",
        ),
        (r"\beta_2 := T", "column 12: this is not a region"),
        (
            r"\beta_2 := \mathcal{A} = \mathcal{A}",
            "column 1: a definition of a region is one name, one :=, one set",
        ),
    ],
)
def test_every_token_of_a_set_matters(latex: str, message: str) -> None:
    with pytest.raises(PrintError) as refusal:
        Printed(latex).set_predicate(PAPER, of=r"\beta_2")
    assert str(refusal.value).startswith(message)


def test_cases_hold_each_under_its_condition() -> None:
    print_ = Printed(r"x = \begin{cases} a : y < 0 \\ 2a : y \ge 0 \end{cases}")
    assert print_.formula(TWICE) == implies(Y < 0, equal(X, A)) & implies(Y >= 0, equal(X, 2 * A))


def test_a_case_may_itself_define() -> None:
    print_ = Printed(r"x = \begin{cases} a := y : y < 0 \end{cases}")
    assert print_.formula(TWICE) == implies(Y < 0, equal(X, A) & equal(A, Y))


def test_roundings_state_their_defining_inequalities() -> None:
    assert str(Printed(r"x = \lfloor y \rfloor").formula(TWICE)) == "x <= y and y < x + 1"
    assert str(Printed(r"x = \lceil y \rceil").formula(TWICE)) == "y <= x and x < y + 1"
    assert Printed(r"\lfloor y \rfloor").value(TWICE) == Rounded(r"\lfloor", Y)


def test_a_maximum_and_a_limit_keep_what_they_say() -> None:
    top = Printed(r"\max_{x \le y} a x").value(TWICE)
    assert top == ExtremalValue(r"\max", X <= Y, A * X)
    limit = Printed(r"\lim_{k\to\infty} K(z_k)").value(KINETIC)
    assert isinstance(limit, LimitValue) and (limit.variable, limit.destination) == ("k", r"\infty")
    assert str(limit.value) == "1/2*zv^2"
    own = TWICE.extended({r"\max_{\cdot}\cdot": lambda extremum: extremum.value})
    assert str(Printed(r"y = \max_{x \le y} a x").formula(own)) == "y = a*x"
    with pytest.raises(
        PrintError, match="column 1: = between a scalar and ExtremalValue states no formula"
    ):
        Printed(r"y = \max_{x \le y} a x").formula(TWICE)


def test_a_restriction_speaks_inside_its_region_only() -> None:
    value = Printed(r"h|_{\mathcal{H}}").value(
        TWICE.extended({r"\mathcal{H}": Region(lambda state: state.component(2) < 0)})
    )
    assert isinstance(value, Restricted)
    stated = Printed(r"\dot{\overline\beta} = E|_{\mathcal{H}}").formula(PAPER)
    assert stated == implies(BETA >= 0, equal(V, PAPER.meaning_of("E")(Vector((BETA, V)))))


def test_parts_are_prints_of_their_own() -> None:
    print_ = Printed(r"\overline\beta = 0 \\ \dot{\overline\beta} = T")
    assert [str(part.formula(PAPER)) for part in print_.parts] == ["beta = 0", "v = 2*r/g"]
    assert str(print_.formula(PAPER)) == "beta = 0 and v = 2*r/g"
    with pytest.raises(PrintError, match="column 23: this print has 2 parts"):
        print_.relation_chain(PAPER)


def test_columns_count_in_the_whole_print() -> None:
    with pytest.raises(PrintError, match=r"column 27: q has no meaning here"):
        Printed(r"\overline\beta = 0 \\ T = q").parts[1].formula(PAPER)


UNREADABLE_AS_THEY_STAND = {
    "29": "column 116: a sum of a vector and a scalar",
    "B.2": "column 1: = between a scalar and a vector states no formula",
}


def test_displays_that_do_not_fit_together_are_refused_for_what_does_not_fit() -> None:
    latex_of = {where: latex for where, latex in ALL if where == "29" or r"\qquad \beta" in latex}
    assert set(latex_of) == set(UNREADABLE_AS_THEY_STAND)
    for where, latex in latex_of.items():
        with pytest.raises(PrintError) as refusal:
            Printed(latex.replace("\n", " ")).parts[0].formula(PAPER)
        assert str(refusal.value) == UNREADABLE_AS_THEY_STAND[where]


def test_nearly_every_display_evaluates_with_the_names_of_its_context() -> None:
    def evaluates(latex: str) -> bool:
        for environment in (PAPER, WIDE, KINETIC):
            try:
                Printed(latex).formula(environment)
            except PrintError:
                continue
            return True
        return False

    assert sum(evaluates(latex) for _, latex in ALL) >= 95


def test_a_matrix_of_prints_is_exact() -> None:
    assert Printed(r"\begin{bmatrix} 1 & x \\ 0 & \frac12 \end{bmatrix}").value(TWICE) == Matrix(
        ((1, X), (0, Q(1, 2)))
    )


def test_points_name_components_of_the_state() -> None:
    only = Environment(
        {r"\overline\beta": X, r"\dot{\overline\beta}": Y}, points=POINTS, state=r"\overline b"
    )
    assert only.state == Vector((X, Y)) and only.meaning_of(r"\overline b") == Vector((X, Y))
