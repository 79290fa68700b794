"""Trees printed as LaTeX in many styles, for tests of the reader and of the comparison: one draw of
`Random` for each choice of style.
"""

from __future__ import annotations

from random import Random

from tests.proofs.reports.nodes import (
    Arithmetic,
    Formula,
    Implied,
    Joined,
    Listed,
    Name,
    Neg,
    Node,
    Not,
    Num,
    Related,
    Term,
    Unary,
)

SUM, QUOTIENT, PRODUCT, FACTOR, BASE = range(
    5
)  # how tightly what is printed holds together; a BASE takes an exponent
GLYPHS = {
    "alpha": (r"\alpha", r"{\alpha}"),
    "beta": (r"\bar\beta", r"\overline\beta", r"\overline{\beta}", r"\bar{\beta}"),
    "v": (
        r"\dot{\bar\beta}",
        r"\dot{\overline{\beta}}",
        r"\overline{\dot\beta}",
        r"\dot{\bar{\beta}}",
    ),
    "r": (r"\dot\rho_0", r"\dot{\rho}_0", r"\dot{\rho}_{0}", r"\dot{\rho_0}"),
    "g": (r"\gamma",),
    "beta0": (r"\bar\beta_0", r"\overline{\beta}_{0}"),
    "v0": (r"\dot{\bar\beta}_{0}", r"\dot{\overline\beta}_0", r"\dot{\bar\beta}_{0}"),
    "beta1": (r"\bar\beta_1",),
    "v1": (r"\dot{\overline\beta}_1",),
    "tau": (r"\tau_c", r"\tau_{c}"),
    "E_max": (r"E_{\max}", r"E_{max}", r"E_{\mathrm{max}}"),
    "dE_max": (r"\Delta E_{\max}", r"\Delta E_{max}"),
    "dE_sup": (r"\Delta E_{\sup}", r"\Delta E_{\text{sup}}"),
    "eps": (r"\epsilon", r"\varepsilon"),
    "lam": (r"\lambda",),
    "delta": (r"\delta",),
    "since": (r"\tau_p",),
    "t_R": (r"t_{\mathcal{R}}",),
    "rho": (r"\rho",),
    "chi": (r"\chi",),
    "chi_after": (r"\chi'",),
    "chi_dot": (r"\dot\chi",),
    "chi_dot_after": (r"\dot\chi'", r"\dot{\chi}_{\text{after}}"),
    "v_next": (r"\dot{\bar\beta}_{k+1}", r"\dot{\bar\beta}'", r"\dot{\bar\beta}_{\text{next}}"),
    "change_1": (r"\Delta_1 E", r"\Delta_{1} E"),
    "mu": (r"\mu",),
    "sigma": (r"\sigma",),
    "pi": (r"\pi",),
    "Gamma": (r"\Gamma",),
    "omega": (r"\omega",),
    "omega_after": (r"\omega_{\mathrm{after}}",),
}
BRACKETS = (("(", ")"), (r"\left(", r"\right)"), (r"\bigl(", r"\bigr)"), ("[", "]"))
SIGNS = {
    "<": ("<",),
    "<=": (r"\le", r"\leq"),
    ">": (">",),
    ">=": (r"\ge", r"\geq"),
    "=": ("=",),
    "!=": (r"\ne", r"\neq"),
}
JOINS = {"and": (r"\land", r"\wedge", r"\text{ and }"), "or": (r"\lor", r"\vee", r"\text{ or }")}
ARROWS = {"implies": (r"\Rightarrow", r"\implies"), "iff": (r"\iff", r"\Leftrightarrow")}


def printed(node: Node, random: Random) -> str:
    """The tree as LaTeX."""
    if isinstance(node, Formula):
        return formula(node, random)
    if isinstance(node, Listed):
        if random.random() < 0.5:
            return "(" + ", ".join(printed(entry, random) for entry in node.entries) + ")"
        return (
            r"\begin{bmatrix}"
            + r" \\ ".join(printed(entry, random) for entry in node.entries)
            + r"\end{bmatrix}"
        )
    assert isinstance(node, Term)
    return term(node, random)[0]


def bracketed(text: str, random: Random) -> str:
    opener, closer = random.choice(BRACKETS)
    return f"{opener}{text}{closer}"


def at_least(level: int, node: Term, random: Random) -> str:
    text, found = term(node, random)
    return text if found >= level else bracketed(text, random)


def term(node: Term, random: Random) -> tuple[str, int]:
    if isinstance(node, Num):
        return str(node.number), BASE
    if isinstance(node, Name):
        return glyph(node.stands_for[0], random), BASE
    if isinstance(node, Neg):
        return "-" + at_least(QUOTIENT, node.of, random), SUM
    if isinstance(node, Unary):
        under = term(node.of, random)[0]
        return {
            "sqrt": rf"\sqrt{{{under}}}",
            "floor": rf"\lfloor {under} \rfloor",
            "ceil": rf"\left\lceil {under} \right\rceil",
        }[node.function], BASE
    assert isinstance(node, Arithmetic)
    if node.sign in "+-":
        return (
            (
                f"{at_least(SUM, node.left, random)} {node.sign}"
                f" {at_least(QUOTIENT, node.right, random)}"
            ),
            SUM,
        )
    if node.sign == "^":
        power = printed(node.right, random)
        return (
            at_least(BASE, node.left, random)
            + "^"
            + (power if len(power) == 1 and random.random() < 0.5 else f"{{{power}}}"),
            FACTOR,
        )
    if node.sign == "/":
        if random.random() < 0.3:
            return (
                f"{at_least(PRODUCT, node.left, random)}/{at_least(FACTOR, node.right, random)}",
                QUOTIENT,
            )
        if (
            isinstance(node.left, Num)
            and isinstance(node.right, Num)
            and node.left.number < 10 > node.right.number
        ):
            return rf"\tfrac{node.left.number}{node.right.number}", FACTOR
        return rf"\frac{{{term(node.left, random)[0]}}}{{{term(node.right, random)[0]}}}", FACTOR
    left, right = at_least(PRODUCT, node.left, random), at_least(FACTOR, node.right, random)
    dotted = (
        right[0].isdigit() or left[-1].isdigit() and "frac" in right[:6] or random.random() < 0.2
    )
    return (
        left
        + (
            random.choice((r" \cdot ", r" \times "))
            if dotted
            else random.choice((" ", r"\,", r" \; "))
        )
        + right,
        PRODUCT,
    )


def glyph(name: str, random: Random) -> str:
    if name in GLYPHS:
        return random.choice(GLYPHS[name])
    if name[:-1].isalpha() and len(name) == 2 and name[1].isdigit():
        return f"{name[0]}_{name[1]}"
    return name if len(name) == 1 else r"\mathit{" + name.replace("_", r"\_") + "}"


def formula(node: Formula, random: Random) -> str:
    if isinstance(node, Related):
        return (
            f"{printed(node.left, random)} {random.choice(SIGNS[node.sign])}"
            f" {printed(node.right, random)}"
        )
    if isinstance(node, Not):
        inner = formula(node.of, random)
        if isinstance(node.of, Related) and random.random() < 0.5:
            return rf"\lnot {inner}"
        return random.choice((r"\lnot", r"\neg", r"\text{not }")) + bracketed(inner, random)
    if isinstance(node, Joined):
        sign = random.choice(JOINS[node.how])
        return f" {sign} ".join(kept_apart(part, (Joined, Implied), random) for part in node.parts)
    assert isinstance(node, Implied)
    return f" {random.choice(ARROWS[node.how])} ".join(
        kept_apart(side, (Implied,), random) for side in (node.left, node.right)
    )


def kept_apart(part: Formula, kinds: tuple[type, ...], random: Random) -> str:
    """A formula, in brackets where it is of one of these kinds."""
    return (
        bracketed(formula(part, random), random)
        if isinstance(part, kinds)
        else formula(part, random)
    )
