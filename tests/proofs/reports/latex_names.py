r"""Which names of the statement language a printed name may stand for.

From the paper's Table II (\gamma gravity, \alpha restitution, T the period, \dot\rho_0 the table's
launch speed, \rho its position, \overline\beta and \dot{\overline\beta} the ball's position and
velocity, sampled; \tau_c the time to collision, \tau_p the time since the table was lowest), its
equations (E_{max}, \Delta E_{max}, \Delta_1 E, \Delta E_{sup}, \tau_w, z_1) and the README's
symbols (r, g, beta, v, T, x, w). What the paper uses for something else is refused: r and b are
states there, and \beta without a bar is the ball between samples. The impact of a corner, of which
the paper prints no formula, has its own: e restitution, mu friction, sigma a direction, omega an
angular velocity, B_1 to B_3, impulses P, velocities S and C.
"""

from __future__ import annotations

import re

from tests.proofs.reports.nodes import NotRead

GREEK = (
    "alpha beta gamma delta epsilon varepsilon lambda rho tau chi xi mu nu eta theta kappa sigma"
    " omega".split()
)
PLAIN = {
    letter: letter for letter in "cdhjJkKmnpqstTuwWxyz" + "BCPS"
}  # the paper gives none to a state or a region; the last are of the corner
BASES = {  # (base, accents) -> name; subscripts and primes are added to it
    **{(letter, ""): name for letter, name in PLAIN.items()},
    (r"\alpha", ""): "alpha",
    (r"\gamma", ""): "g",
    (r"\beta", "bar"): "beta",
    (r"\beta", "bar dot"): "v",
    (r"\rho", ""): "rho",
    (r"\rho", "dot"): "rho_dot",
    (r"\chi", ""): "chi",
    (r"\chi", "dot"): "chi_dot",
    (r"\tau", ""): "tau",
    (r"\delta", ""): "delta",
    (r"\epsilon", ""): "eps",
    (r"\varepsilon", ""): "eps",
    (r"\lambda", ""): "lam",
    ("E", ""): "E",
    **{(rf"\{name}", ""): name for name in ("mu", "sigma", "omega")},
}
WHOLE = {  # (base, accents, subscript) -> names
    (r"\rho", "dot", "0"): ("r",),
    (r"\tau", "", "c"): ("tau",),
    (r"\tau", "", "p"): ("since", "tau_p"),
    ("E", "", ""): (),
    ("e", "", ""): ("e",),  # with a subscript it is a fixed point
}
CHANGES = {  # what \Delta, its subscript and what follows stand for
    (r"\Delta", "", "E", ""): ("change", "dE"),
    (r"\Delta", "1", "E", ""): ("change_1", "dE_1"),
    (r"\Delta", "2", "E", ""): ("change_2", "dE_2"),
    (r"\Delta", "", "E", "max"): ("dE_max",),
    (r"\Delta", "", "E", "sup"): ("dE_sup",),
    (r"\Delta", "", "K", ""): ("change", "dK"),
}
OF_ENERGY, OF_MARGIN = (
    ("change", "change_1"),
    "R",
)  # what the paper differentiates: \Delta_1 E and R
PRIMED = ("_after", "_next")
NEXT = "k+1"
FUNCTIONS = ("max", "min", "sup", "inf", "sqrt", "sin", "cos", "exp", "log")
ON_PAPER = frozenset(BASES.values()) | {
    "r",
    "v",
    "g",
}  # names that have a glyph of their own, so that they are never spelled out


def names_for(base: str, accents: tuple[str, ...], subscript: str, primes: int) -> tuple[str, ...]:
    """The names that a glyph may stand for; NotRead where it is none that statements use."""
    kind = " ".join(sorted(accents))
    if len(set(accents)) != len(accents) or primes > 1:
        raise NotRead("a name with an accent twice, or with two primes")
    if (base, kind, subscript) in WHOLE and not primes:
        names = WHOLE[base, kind, subscript]
    else:
        stem = BASES.get((base, kind)) or spelled(base, kind)
        if not stem:
            raise NotRead(
                f"{' '.join((*accents, base))} is not a name of statements, or the paper gives it"
                " another meaning"
            )
        names = subscripted(stem, subscript)
    if not names:
        raise NotRead(f"{base} alone is a function in the paper")
    return tuple(name + mark for name in names for mark in PRIMED) if primes else names


def subscripted(stem: str, subscript: str) -> tuple[str, ...]:
    if subscript == NEXT:
        return (stem + "_next",)
    if subscript.isdigit():
        return (stem + subscript, f"{stem}_{subscript}")  # a premise of a map rule names states so
    return (stem + "_" * bool(subscript) + subscript,)


def spelled(base: str, kind: str) -> str:
    """A name written out in letters, such as `size` or `ball_after`, and with a dot
    `folded_dot`.
    """
    if (
        kind not in ("", "dot")
        or base in FUNCTIONS
        or not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]+", base, re.ASCII)
    ):
        return ""
    stem = re.match(r"[A-Za-z]+", base)
    if not stem or stem[0] in ON_PAPER and not re.fullmatch(rf"{stem[0]}_[a-z]+", base):
        return ""
    return base + ("_dot" if kind else "")
