"""The commands that a print may use, in tables: what is dropped, what is another spelling, what is
an operator.
"""

from __future__ import annotations

# Layout and fonts: they carry no meaning and are dropped.
DROPPED = frozenset(
    rf"\{word}"
    for word in (
        "quad qquad displaystyle textstyle limits nolimits nonumber notag allowbreak "
        "mathrm mathbf mathit mathsf boldsymbol pmb bm rm bf it"
    ).split()
)

# Environments that only lay lines out: their line ends and & marks are joins.
LAYOUT = frozenset(
    "split aligned align align* alignedat gathered gather gather* equation equation*"
    " multline".split()
)
# Environments whose & and line ends are cells.
TABLES = frozenset("bmatrix pmatrix matrix array cases".split())

SAME = {
    r"\overline": r"\bar",
    r"\leq": r"\le",
    r"\leqslant": r"\le",
    r"\geq": r"\ge",
    r"\geqslant": r"\ge",
    r"\neq": r"\ne",
    r"\to": r"\rightarrow",
    r"\mid": "|",
    r"\vert": "|",
    r"\lvert": "|",
    r"\rvert": "|",
    r"\lbrace": r"\{",
    r"\rbrace": r"\}",
    r"\dfrac": r"\frac",
    r"\tfrac": r"\frac",
    r"\ast": "*",
    r"\mathscr": r"\mathcal",
    r"\colon": ":",
}

LETTERS = frozenset(
    rf"\{word}"
    for word in (
        "alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa lambda mu nu"
        " xi pi rho varrho sigma tau upsilon phi varphi chi psi omega Gamma Theta Lambda Xi Pi"
        " Sigma Upsilon Phi Psi Omega ell infty emptyset"
    ).split()
)

# What stands over or around a letter and makes another name of it.  Two dots are `dot` twice: \ddot
# x = \dot{\dot x}.
ACCENTS = {
    r"\bar": ("bar",),
    r"\dot": ("dot",),
    r"\ddot": ("dot", "dot"),
    r"\hat": ("hat",),
    r"\tilde": ("tilde",),
    r"\vec": ("vec",),
    r"\mathcal": ("script",),
    r"\mathbb": ("blackboard",),
}
ACCENT_COMMANDS = {
    "bar": r"\overline",
    "dot": r"\dot",
    "hat": r"\hat",
    "tilde": r"\tilde",
    "vec": r"\vec",
    "script": r"\mathcal",
    "blackboard": r"\mathbb",
}

RELATIONS = frozenset(
    (
        "=",
        ":=",
        "<",
        ">",
        r"\le",
        r"\ge",
        r"\ne",
        r"\in",
        r"\notin",
        r"\subset",
        r"\subseteq",
        r"\equiv",
        r"\rightarrow",
    )
)

# Infix operators and how tightly they bind; juxtaposition binds more tightly than all of them.
BINARY = {
    r"\cup": 20,
    r"\cap": 22,
    "+": 30,
    "-": 30,
    r"\setminus": 30,
    "*": 40,
    r"\cdot": 40,
    r"\times": 40,
    "/": 40,
    r"\circ": 45,
}
SIGN = 35  # -a b + c is (-(a b)) + c

EXTREMA = frozenset((r"\max", r"\min", r"\sup", r"\inf"))
OPERATORS = frozenset((r"\Delta", r"\partial", r"\nabla"))
BRACKETS = {"(": ")", "[": "]", r"\lfloor": r"\rfloor", r"\lceil": r"\rceil"}

OTHER = frozenset((r"\frac", r"\sqrt", r"\forall", r"\lim", r"\prime", r"\{", r"\}"))
KNOWN = (
    LETTERS
    | ACCENTS.keys()
    | {sign for sign in RELATIONS if sign[0] == "\\"}
    | {sign for sign in BINARY if sign[0] == "\\"}
    | EXTREMA
    | OPERATORS
    | {r"\lfloor", r"\rfloor", r"\lceil", r"\rceil"}
    | OTHER
)
