"""The reader of LaTeX: what texts come to, and what it refuses."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.reports.latex_reader import NotRead, read, value
from tests.reports.nodes import Node

VALUES = {
    name: Fraction(str(found))
    for name, found in {
        **{
            "alpha": "1/8",
            "r": 3,
            "g": 10,
            "beta": "7/2",
            "v": -5,
            "T": "3/5",
            "x": 11,
            "w": 13,
            "u": 17,
            "s": "3/2",
            "tau": "1/4",
            "K": 2,
        },
        **{
            "beta0": "9/2",
            "v0": "-11/3",
            "beta_next": 19,
            "v_next": 23,
            "E_max": 29,
            "dE_max": 31,
            "dE_sup": -37,
            "change_1": 41,
            "tau_w": 43,
        },
        **{
            "chi_dot": 47,
            "chi_dot_after": 53,
            "eps": "1/100",
            "lam": 59,
            "rho": 61,
            "z1": 67,
            "since": "2/5",
            "size": 71,
            "t_R": 73,
            "n": 3,
        },
        **{
            "h": 79,
            "dE_dbeta": 83,
            "dR_dv": 89,
            "delta": "1/10",
            "t": "1/7",
            "folded_dot": 97,
            "v1": 101,
            "k": 5,
        },
    }.items()
}
TERMS = r"""
0                                             0
120                                           120
\frac12                                       1/2
\tfrac{1}{2}                                  1/2
\frac1{10}                                    1/10
\dfrac{-1}{2}                                 -1/2
\frac\alpha2                                  1/16
\alpha                                        1/8
\gamma                                        10
\dot\rho_0                                    3
\dot{\rho}_0                                  3
\dot{\rho}_{0}                                3
\dot{\rho_0}                                  3
{\dot\rho}_0                                  3
\dot\rho_0^2                                  9
\dot\rho^2_0                                  9
\bar\beta                                     7/2
\overline\beta                                7/2
\overline{\beta}                              7/2
\bar{\beta}                                   7/2
\dot{\bar\beta}                               -5
\dot{\overline{\beta}}                        -5
\overline{\dot\beta}                          -5
\bar\beta_0                                   9/2
\overline{\beta}_{0}                          9/2
\dot{\bar\beta}_{0}                           -11/3
\dot{\overline\beta}_0                        -11/3
\dot{\overline{\beta}}_0^2                    121/9
\dot{\bar\beta}_1                             101
\dot{\bar\beta}'                              23
\bar\beta_{k+1}                               19
\dot{\bar\beta}_{\mathrm{next}}               23
\dot\chi                                      47
\dot\chi'                                     53
\dot{\mathit{folded}}                         97
\tau_c                                        1/4
\tau_{c}                                      1/4
\tau_{w}                                      43
\tau_p                                        2/5
t_{\mathcal{R}}                               73
E_{\max}                                      29
E_{max}                                       29
E_{\text{max}}^2                              841
\Delta E_{max}                                31
\Delta E_{\max}                               31
\Delta E_{\sup}                               -37
\Delta E_{\mathrm{sup}}                       -37
\Delta_1 E                                    41
\Delta_{1}E                                   41
\Delta_1 E^2                                  1681
\frac{\partial \Delta_1 E}{\partial \bar\beta}    83
\frac{\partial R}{\partial \dot{\overline\beta}}  89
\epsilon                                      1/100
\varepsilon                                   1/100
\lambda                                       59
\rho                                          61
z_1                                           67
\mathit{size}                                 71
\text{size}                                   71
\mathit{beta\_next}                           19
xw                                            143
x w                                           143
x\,w                                          143
x \cdot w                                     143
x \times w \quad u                            2431
2x                                            22
2 \cdot 3                                     6
2 \cdot 3 x                                   66
2\alpha x                                     11/4
x \cdot 2                                     22
x + w - u                                     7
x - w - u                                     -19
x - (w - u)                                   15
-x^2                                          -121
-x w                                          -143
(-x)^2                                        121
-x + w                                        2
x(w - u)                                      -44
\gamma(1 + \alpha)                            45/4
(1 - \alpha)(1 + \alpha)                      63/64
K(K + 1)                                      6
x^K                                           121
x^{K+1}                                       1331
x^{-1}                                        1/11
2^2 x                                         44
12^2                                          144
{2}^3                                         8
(-\alpha)^n                                   -1/512
(x^2)^3                                       1771561
x/w                                           11/13
2\dot\rho_0/\gamma                            3/5
\alpha T/(1 - \alpha)                         3/35
-x/w                                          -11/13
x/w + u                                       232/13
x/w^2                                         11/169
\frac{1}{2}\frac{1+\alpha}{1-\alpha}\dot\rho_0^2    81/14
\frac{2}{3}\cdot\frac{1}{2}                   1/3
2\frac{x}{w}                                  22/13
\left(\frac{x}{w}\right)^2                    121/169
\bigl[x + w\bigr]^{2}                         576
\Bigg( x \Bigg)                               11
\big(x\big)                                   11
\bigl(\bigl(x\bigr)\bigr)                     11
\sqrt{2(1+\alpha)}                            3/2
\sqrt{2(1+\alpha)}^2                          9/4
\sqrt4                                        2
-\sqrt{2(1+\alpha)} \frac{\dot\rho_0}{1-\alpha}    -36/7
\lfloor x/w \rfloor                           0
\lceil \frac{x}{3} \rceil                     4
\left\lfloor -\frac{x}{3} \right\rfloor       -4
\lfloor x/3 \rfloor^2                         9
\displaystyle x \! w                          143
"""
FORMULAS = r"""
x < w                                         true
x > w                                         false
x \le 11                                      true
x \leq 10                                     false
x \geq 11 \land w \ge 13                      true
x = 11                                        true
x \ne 11                                      false
x \neq w                                      true
0 < \alpha < 1                                true
0 \le x < 11                                  false
w > x \ge 11                                  true
0 = x < w                                     false
(x < w)                                       true
x < w \land w < x                             false
x < w \wedge x \ne u \land u > 0              true
x < w \lor w < x                              true
w < x \vee u < x                              false
x < w \text{ and } u < w                      false
x < w \text{ or } u < w                       true
x < w \text{ and not } u < w                  true
\lnot x < w                                   false
\neg (x < w)                                  false
\lnot\lnot x < w                              true
\text{not } x < w                             false
\text{not } (x < w) \text{ and } u < w        false
\lnot x < w \land u < w                       false
\lnot (x < w \land u < w)                     true
x < w \Rightarrow u < w                       false
u < w \implies x < w                          true
u < w \iff x < w                              false
u < w \Leftrightarrow w < x                   true
x < w \land u < w \Rightarrow w < x           true
x < w \land (u < w \lor x < u)                true
(x < w \land u < w) \lor x < u                true
x < w \text{ if and only if } x < u           true
(x < w \Rightarrow u < w) \Rightarrow w < x   true
(x) < w                                       true
"""
REFUSED = r"""
                                              ends too early
x +                                           ends too early
a/b c                                         not a name
x/w u                                         after a slash
x/w \cdot u                                   after a slash
x/w/u                                         after a slash
1/2 x                                         after a slash
x/2(1 + \alpha)                               after a slash
x 2                                           number after a factor
x{2}                                          number after a factor
2 3                                           number with a space
1\,000                                        number with a space
\frac12 3                                     number after a factor
\frac123                                      number after a factor
2\frac12                                      number before a fraction
{2}\frac12                                    number before a fraction
x \cdot 2\frac{1}{2}                          number before a fraction
x^12                                          number after a factor
x_12                                          number after a factor
\frac{x}{w}^2                                 beside a fraction
x^2^3                                         more marks
x^-1                                          one sign
x^{(2)}                                       may be an order
x^\frac12                                     one sign
{x + w} u                                     expected }
{x^2}^3                                       expected }
x + -w                                        sign after a sign
x \cdot -w                                    expected a term
--x                                           sign after a sign
+x                                            leading plus
\pm x                                         expected a term
0.5                                           no such sign
007                                           begins with 0
x, w                                          left over
x (w, u)                                      no function is applied
2(w, u)                                       no function is applied
(x, w) + 1                                    formula or list
(x, w) = (u, s)                               formula or list
\sin x                                        expected a term
E(x)                                          a function
E                                             a function
f(x)                                          not a name
R                                             not a name
r                                             not a name
v                                             not a name
g                                             not a name
b                                             not a name
\beta                                         not a name
\dot\beta                                     not a name
\ddot\rho                                     expected a term
\hat\beta                                     expected a term
\theta                                        not a name
\bar\gamma                                    not a name
\bar{\bar\beta}                               accent twice
\dot\bar\beta                                 stands in braces
\dot{\bar\beta}_0{}_0                         expected a name
\dot{\rho_0}_0                                second subscript
\mathcal{B}_1                                 a region
\mathit{beta}                                 not a name
\mathit{beta0}                                not a name
\mathit{r}                                    not a name
\mathrm{and}                                  word between
\text{if } x < w                              neither a word
x \text{ where } w                            neither a word
\text{max}(x)                                 not a name
\operatorname{size}(x)                        expected a term
e_1                                           not a name
b_0                                           not a name
\bar\beta_{k}'''                              two primes
\Delta x                                      no such change
\Delta_3 E                                    no such change
\Delta                                        change of what
\frac{\partial x}{\partial w}                 no such derivative
x_{k-1}                                       not a subscript
(x                                            expected )
x)                                            left over
(x]                                           expected )
\left(x)                                      expected \right
(x\right)                                     expected )
\left(x\bigr)                                 expected \right
\bigl(x\Bigr)                                 expected \bigr
\left.x\right)                                no such sign
\{x\}                                         expected a term
|x|                                           no such sign
x!                                            no such sign
x < w, w < u                                  left over
x < w > u                                     two directions
x \ne w \ne u                                 sign for different
x < w \land u < w \lor x < u                  and beside or
x < w \text{ and } u < w \text{ or } x < u    and beside or
x < w \Rightarrow u < w \Rightarrow x < u     second implication
x < w \iff u < w \iff x < u                   second implication
x < w \land w < u \text{ iff } x < u          in words
\text{not } x < w \text{ and } u < w          word not
\text{not } (x) < w \text{ and } u < w        word not
x < w \text{ and } \text{not } u < w \land x < u    word not
(x < w) u                                     term is expected
(x < w) < u                                   term is expected
(x < w) = (w < u)                             term is expected
x \land w                                     formula is expected
\lnot x                                       formula is expected
x < w (u < s)                                 term is expected
\forall x                                     expected a term
x \in w                                       left over
x \equiv w                                    left over
x := w                                        no such sign
x \not= w                                     left over
x * w                                         no such sign
x − w                                         no such sign
x % w                                         no such sign
x \tag{1}                                     left over
x \\ w                                        left over
x & w                                         left over
\begin{cases} x \\ w \end{cases}              no such environment
\begin{bmatrix} x & w \\ u \end{bmatrix}      different lengths
\begin{bmatrix} x \end{pmatrix}               no end
\begin{bmatrix} x < w \end{bmatrix}           no end
\sqrt[3]{x}                                   one sign
\frac{x}                                      one sign
\frac{}{x}                                    expected a term
\frac x < w                                   one sign
{}_0                                          expected a name
x'^2_0''                                      more marks
(x)_1                                         mark on a bracket
(x)'                                          mark on a bracket
\lfloor x < w \rfloor                         term is expected
\lfloor x \rceil                              expected \rfloor
"""
VALUELESS = r"""
\sqrt{2}                                      not the square
\sqrt{-1}                                     not the square
x^{1/2}                                       no exponent
x^{\alpha}                                    no exponent
\frac{x}{K - 2}                               division by zero
(K - 2)^{-1}                                  division by zero
T_c                                           has no one value
\dot\rho                                      has no one value
\rho_0                                        has no one value
x < w \lor \sqrt{2} < 1                       not the square
"""


def rows(table: str) -> list[tuple[str, str]]:
    """Two columns, which two spaces at least keep apart."""
    lines = [line for line in table.strip("\n").splitlines() if line]
    return [
        (line[: line.rstrip().rindex("  ")].strip(), line.rstrip().rpartition("  ")[2].strip())
        for line in lines
    ]


@pytest.mark.parametrize(("latex", "expected"), rows(TERMS))
def test_term_has_this_value_holds(latex: str, expected: str) -> None:
    found = value(read(latex), VALUES)
    assert found == Fraction(expected) and isinstance(found, Fraction)


@pytest.mark.parametrize(("latex", "expected"), rows(FORMULAS))
def test_formula_has_this_value_holds(latex: str, expected: str) -> None:
    assert value(read(latex), VALUES) is (expected == "true")


@pytest.mark.parametrize(
    ("latex", "expected"),
    [
        (r"(x, w)", (11, 13)),
        (r"\left(x, -\frac{w}{2}\right)", (11, Fraction(-13, 2))),
        (r"\begin{bmatrix} x \\ w + 1 \end{bmatrix}", (11, 14)),
        (r"\begin{pmatrix} 1 & T \\ 0 & 1 \end{pmatrix}", ((1, Fraction(3, 5)), (0, 1))),
        (r"\begin{bmatrix} \frac12\gamma & \dot\rho_0 \end{bmatrix}", ((5, 3),)),
    ],
)
def test_vector_has_these_values_holds(latex: str, expected: tuple[object, ...]) -> None:
    assert value(read(latex), VALUES) == expected


@pytest.mark.parametrize(("latex", "reason"), rows(REFUSED))
def test_rejects_what_is_not_understood(latex: str, reason: str) -> None:
    with pytest.raises(NotRead) as refused:
        read(latex)
    assert (
        reason in refused.value.reason
        and refused.value.position is not None
        and f"position {refused.value.position}" in str(refused.value)
    )


@pytest.mark.parametrize(("latex", "reason"), rows(VALUELESS))
def test_rejects_what_has_no_value(latex: str, reason: str) -> None:
    tree = read(latex)
    with pytest.raises(NotRead, match=reason):
        value(tree, VALUES)


@pytest.mark.parametrize("latex", ["(" * 20000 + "x" + ")" * 20000, "x+" * 60000 + "x"])
def test_rejects_what_is_too_deep_or_too_long(latex: str) -> None:
    with pytest.raises(NotRead, match="too deep|too long"):
        read(latex)


def test_a_glyph_with_two_meanings_takes_the_one_that_has_a_value_holds() -> None:
    tree = read(r"\Delta_1 E")
    assert value(tree, {"change_1": Fraction(2)}) == 2
    assert value(tree, {"dE_1": Fraction(3)}) == 3


def test_rejects_a_glyph_whose_meanings_both_have_values() -> None:
    with pytest.raises(NotRead, match="several of"):
        value(read(r"\Delta_1 E"), {"change_1": Fraction(2), "dE_1": Fraction(3)})


PIECES = (
    r"\frac \sqrt { } ( ) [ ] \left \right \bigl ^ _ ' 1 2 x \bar \dot \beta \rho \alpha \Delta E -"
    r" + / \cdot , < \le = & \\ |".split()
)
MORE = [r"\text{ and }", r"\mathit{size}", r"\begin{bmatrix}", r"\end{bmatrix}", r"\mathcal{R}"]
WORDS = r"\land \lor \lnot \iff \partial \lfloor \rfloor".split()


@settings(deadline=None, max_examples=500)
@given(st.lists(st.sampled_from(PIECES + MORE + WORDS), max_size=14).map(" ".join))
def test_any_text_is_read_or_refused_holds(latex: str) -> None:
    try:
        tree = read(latex)
    except NotRead as refused:
        assert refused.reason
    else:
        assert isinstance(tree, Node) and read(latex) == tree
