"""MathML (or latex2mathml)."""

from __future__ import annotations

import re
from functools import cache
from html import escape

from juggleproof.certificates.language import ClaimError

# -------------------------------------------------------------------------------------------------
# The LaTeX commands that prints and `latex_of` use, and what each is in MathML.

GREEK = {
    "alpha": "α",
    "beta": "β",
    "gamma": "γ",
    "delta": "δ",
    "epsilon": "ϵ",
    "varepsilon": "ε",
    "eta": "η",
    "theta": "θ",
    "kappa": "κ",
    "lambda": "λ",
    "mu": "μ",
    "nu": "ν",
    "xi": "ξ",
    "pi": "π",
    "rho": "ρ",
    "sigma": "σ",
    "tau": "τ",
    "phi": "ϕ",
    "chi": "χ",
    "psi": "ψ",
    "omega": "ω",
}
UPRIGHT = {  # capitals that TeX sets upright
    "Gamma": "Γ",
    "Delta": "Δ",
    "Theta": "Θ",
    "Lambda": "Λ",
    "Xi": "Ξ",
    "Pi": "Π",
    "Sigma": "Σ",
    "Phi": "Φ",
    "Psi": "Ψ",
    "Omega": "Ω",
    "infty": "∞",
    "partial": "∂",
    "emptyset": "∅",
}
OPERATORS = {
    "le": "≤",
    "leq": "≤",
    "ge": "≥",
    "geq": "≥",
    "ne": "≠",
    "neq": "≠",
    "equiv": "≡",
    "approx": "≈",
    "lt": "<",
    "gt": ">",
    "coloneq": "≔",
    "in": "∈",
    "notin": "∉",
    "subset": "⊂",
    "subseteq": "⊆",
    "cap": "∩",
    "cup": "∪",
    "setminus": "∖",
    "cdot": "⋅",
    "times": "×",
    "circ": "∘",
    "pm": "±",
    "mid": "∣",
    "to": "→",
    "mapsto": "↦",
    "colon": ":",
    "land": "∧",
    "lor": "∨",
    "lnot": "¬",
    "neg": "¬",
    "implies": "⟹",
    "iff": "⟺",
    "forall": "∀",
    "exists": "∃",
    "dots": "…",
    "ldots": "…",
}
CHARACTERS = {
    "+": "+",
    "-": "−",
    "=": "=",
    "<": "<",
    ">": ">",
    ",": ",",
    ";": ";",
    ":": ":",
    "!": "!",
    ".": ".",
    "*": "∗",
}
PREFIX = frozenset("+−±")  # signs that are written closer where nothing stands before them
FENCES = {
    "(": "(",
    ")": ")",
    "[": "[",
    "]": "]",
    "|": "|",
    r"\{": "{",
    r"\}": "}",
    r"\lfloor": "⌊",
    r"\rfloor": "⌋",
    r"\lceil": "⌈",
    r"\rceil": "⌉",
    r"\langle": "⟨",
    r"\rangle": "⟩",
    r"\mid": "|",
    r"\lvert": "|",
    r"\rvert": "|",
    ".": "",
}
SPACES = {
    ",": "0.167em",
    ":": "0.222em",
    ";": "0.278em",
    " ": "0.25em",
    "quad": "1em",
    "qquad": "2em",
}
ACCENTS = {
    "overline": "‾",
    "bar": "‾",
    "dot": "˙",
    "ddot": "¨",
    "hat": "^",
    "tilde": "~",
    "vec": "→",
}
LIMITS = frozenset({"lim", "max", "min", "sup", "inf"})
FUNCTIONS = frozenset({"det", "sin", "cos", "exp", "log", "ln"})
SIZES = frozenset({"big", "Big", "bigl", "bigr", "bigm", "Bigl", "Bigr", "Bigm"})
ALPHABETS = {  # where the letter A would stand in Unicode, and the letters that stand elsewhere
    "mathcal": (
        0x1D49C,
        {"B": "ℬ", "E": "ℰ", "F": "ℱ", "H": "ℋ", "I": "ℐ", "L": "ℒ", "M": "ℳ", "R": "ℛ"},
    ),
    "mathbb": (0x1D538, {"C": "ℂ", "H": "ℍ", "N": "ℕ", "P": "ℙ", "Q": "ℚ", "R": "ℝ", "Z": "ℤ"}),
    "mathbf": (0x1D400, {}),
}
MATRICES = {
    "bmatrix": ("[", "]"),
    "pmatrix": ("(", ")"),
    "matrix": ("", ""),
    "array": ("", ""),
    "cases": ("{", ""),
}
LAYERS = frozenset({"split", "aligned", "gathered"})  # environments that only part lines


# -------------------------------------------------------------------------------------------------
# LaTeX of the paper and of `latex_of` as MathML Core, which browsers draw without a script; what
# is not known is an error, never left out.
#
# A small reader of our own: it knows exactly the commands in `symbols`, takes a tenth of the time
# of
# a general converter, and settles what such converters leave to be mended: lines parted outside of
# tables become a table; an alignment mark there means nothing; `:=` is one sign; words keep a space
# on either side; bars and dots are accents; a sign after an operator is a prefix.

TOKEN = re.compile(
    r"\\(?:begin|end)\s*\{\w+\*?\}|\\(?:text|mathrm|mathit|operatorname|mbox)\s*\{[^{}]*\}|\\[A-Za-z]+|\\.|\d+(?:\.\d+)?|:=|\S"
)
CLOSING = frozenset({")", "]", "!", "|", r"\}", r"\rfloor", r"\rceil"})
ENDS = frozenset({"", "}", "&", r"\\", r"\right", r"\middle"})


@cache
def mathml(latex: str, block: bool = False) -> str:
    r"""The formula as one <math> element, its LaTeX beside it as alternative text.

    Raises ClaimError, one line, where any of it is not known.

    >>> mathml("x_1 < -2")  # doctest: +NORMALIZE_WHITESPACE
    '<math alttext="x_1 &lt; -2"><msub><mi>x</mi><mn>1</mn></msub><mo>&lt;</mo><mo
    form="prefix">−</mo><mn>2</mn></math>'
    """
    said = " ".join(latex.split())
    try:
        inner = _Reader(said).lines()
    except (KeyError, IndexError, ValueError) as problem:
        raise ClaimError(
            f"{said!r} cannot be shown as MathML:"
            f" {problem.args[0] if problem.args else 'it ends too early'}"
        ) from None
    return f'<math{_display(block)} alttext="{escape(said)}">{inner}</math>'


def _display(block: bool) -> str:
    return ' display="block"' if block else ""


class _Reader:
    """Reads tokens from left to right; every method returns markup and leaves `at` behind what it
    read.
    """

    def __init__(self, latex: str) -> None:
        self.tokens: list[str] = [*TOKEN.findall(latex), ""]
        self.at = 0

    @property
    def next(self) -> str:
        return self.tokens[self.at]

    def take(self, wanted: str = "") -> str:
        token = self.tokens[self.at]
        if wanted and token != wanted:
            raise ValueError(f"{wanted} is missing before {token or 'its end'}")
        self.at += 1
        return token

    def lines(self) -> str:
        """A whole print: one row, or a table of several."""
        found = [self.row()]
        while self.next:
            # A mark of alignment outside of a table has no meaning.
            if self.take() not in (r"\\", "&"):
                raise ValueError(f"{self.tokens[self.at - 1]} without its beginning")
            if self.tokens[self.at - 1] == "&":
                found[-1] += self.row()
            else:
                found.append(self.row())
        found = [row for row in found if row]
        if not found:
            raise ValueError("there is nothing in it")
        if len(found) == 1:
            return found[0]
        return (
            '<mtable class="lines" displaystyle="true">'
            + "".join(f"<mtr><mtd>{row}</mtd></mtr>" for row in found)
            + "</mtable>"
        )

    def row(self) -> str:
        """What stands side by side, up to the end of a group, cell, line or print."""
        parts: list[str] = []
        follows = False  # whether something stands before that a sign could join
        while self.next not in ENDS and not self.next.startswith(r"\end"):
            token = self.next
            part = self.scripted(follows)
            parts.append(part)
            if not part.startswith("<mspace"):
                follows = not part.startswith(("<mo>", "<mo ")) or token in CLOSING
        return "".join(parts)

    def scripted(self, follows: bool) -> str:
        """One thing with what stands below and above it."""
        limits = self.next[1:] in LIMITS
        base = self.atom(follows)
        below = above = ""
        while self.next in ("_", "^", "'"):
            sign = self.take()
            if sign == "_":
                below = below + self.argument()
            elif sign == "^":
                above = above + self.argument()
            else:
                above = "<mo>′</mo>" + above
        if above.startswith("<mo>′") and above != "<mo>′</mo>":
            above = f"<mrow>{above}</mrow>"
        if below and limits:
            return f"<munder>{base}{below}</munder>"
        if below and above:
            return f"<msubsup>{base}{below}{above}</msubsup>"
        if below or above:
            tag = "msub" if below else "msup"
            return f"<{tag}>{base}{below or above}</{tag}>"
        return base

    def argument(self) -> str:
        """One element: a group in braces, or a single thing."""
        if self.next != "{":
            return self.atom(False)
        return self.group()

    def group(self) -> str:
        self.take("{")
        row = self.row()
        self.take("}")
        if row[4:-5] in LIMITS:
            return f"<mi>{row[4:-5]}</mi>"
        return row if _is_one(row) else f"<mrow>{row}</mrow>"

    def atom(self, follows: bool) -> str:
        token = self.take()
        if token == "{":
            self.at -= 1
            return self.group()
        if token.isalpha():
            return f"<mi>{token}</mi>"
        if token[0].isdigit():
            return f"<mn>{token}</mn>"
        if token in FENCES and token not in (".", r"\mid"):
            return f'<mo stretchy="false">{FENCES[token]}</mo>'
        if token == "/":
            return '<mo lspace="0" rspace="0">/</mo>'
        if token == ":=":
            return "<mo>≔</mo>"
        if token in CHARACTERS:
            return self.operator(CHARACTERS[token], follows)
        if token[0] != "\\" or len(token) == 1:
            raise ValueError(f"{token} has no meaning there")
        return self.command(token[1:], follows)

    def operator(self, sign: str, follows: bool) -> str:
        form = PREFIXED if sign in PREFIX and not follows else ""
        return f"<mo{form}>{escape(sign, quote=False)}</mo>"

    def command(self, name: str, follows: bool) -> str:
        if name in GREEK:
            return f"<mi>{GREEK[name]}</mi>"
        if name in UPRIGHT:
            return f'<mi mathvariant="normal">{UPRIGHT[name]}</mi>'
        if name in OPERATORS:
            return self.operator(OPERATORS[name], follows)
        if name in SPACES:
            return f'<mspace width="{SPACES[name]}"></mspace>'
        if name in LIMITS | FUNCTIONS:
            return f"<mo>{name}</mo>" if name in LIMITS else f"<mi>{name}</mi>"
        if name in ACCENTS:
            return f'<mover accent="true">{self.argument()}<mo>{ACCENTS[name]}</mo></mover>'
        if name == "frac":
            return f"<mfrac>{self.argument()}{self.argument()}</mfrac>"
        if name == "sqrt":
            return f"<msqrt>{self.argument()}</msqrt>"
        if name in SIZES:
            return f'<mo minsize="1.2em" maxsize="1.2em">{FENCES[self.take()]}</mo>'
        if name in ALPHABETS:
            return self.letter(name)
        if name == "left":
            return self.fenced()
        return self.words(name)

    def letter(self, alphabet: str) -> str:
        start, elsewhere = ALPHABETS[alphabet]
        self.take("{")
        letter = self.take()
        self.take("}")
        if len(letter) != 1 or not letter.isascii() or not letter.isalpha():
            raise ValueError(f"{letter} is no letter of {alphabet}")
        capital = ord(letter) - ord("A") if letter.isupper() else ord(letter) - ord("a") + 26
        return f"<mi>{elsewhere.get(letter) or chr(start + capital)}</mi>"

    def words(self, name: str) -> str:
        kind, brace, said = name.partition("{")
        kind, said = kind.strip(), said.removesuffix("}")
        if brace and kind == "begin":
            return self.environment(said)
        if brace and kind in ("text", "mbox"):
            words = escape(" ".join(said.split()), quote=False)
            return f"<mtext>{KEPT_SPACE}{words}{KEPT_SPACE}</mtext>"
        if brace and kind in ("mathrm", "mathit", "operatorname"):
            variant = (
                ' class="italic"'
                if kind == "mathit"
                else ' mathvariant="normal"'
                if len(said) == 1
                else ""
            )
            return f"<mi{variant}>{escape(said.strip(), quote=False)}</mi>"
        raise ValueError(f"\\{name} is not known")

    def fenced(self) -> str:
        """What stands between \\left and \\right, with fences as tall as it is."""
        shown = _fence(self.take(), "prefix") + self.row()
        while self.next == r"\middle":
            self.take()
            shown += f'<mo stretchy="true">{FENCES[self.take()]}</mo>' + self.row()
        self.take(r"\right")
        return f"<mrow>{shown}{_fence(self.take(), 'postfix')}</mrow>"

    def environment(self, name: str) -> str:
        if name in LAYERS:
            inner = self.lines_until(rf"\end{{{name}}}")
            return (
                "".join(inner) if len(inner) == 1 else _table([[cell] for cell in inner], "lines")
            )
        before, after = MATRICES[name]
        if name == "array":
            self.take("{")
            while self.take() != "}":
                pass
        cells: list[list[str]] = [[self.row()]]
        while self.next in ("&", r"\\"):
            if self.take() == "&":
                cells[-1].append(self.row())
            else:
                cells.append([self.row()])
        self.take(rf"\end{{{name}}}")
        shown = _table(
            [row for row in cells if any(row)], "cases" if name in ("cases", "array") else ""
        )
        opened, closed = (
            f'<mo form="{form}">{sign}</mo>' if sign else ""
            for form, sign in (("prefix", before), ("postfix", after))
        )
        return f"<mrow>{opened}{shown}{closed}</mrow>"

    def lines_until(self, end: str) -> list[str]:
        found = [self.row()]
        while self.next != end:
            if self.take() == "&":
                found[-1] += self.row()
            else:
                found.append(self.row())
        self.take(end)
        return [line for line in found if line]


PREFIXED = ' form="prefix"'
KEPT_SPACE = "\u00a0"  # a space that is kept


def _fence(token: str, form: str) -> str:
    sign = FENCES[token]
    return f'<mo stretchy="true" form="{form}">{sign}</mo>' if sign else ""


def _table(cells: list[list[str]], kind: str) -> str:
    rows = "".join(
        "<mtr>" + "".join(f"<mtd>{cell}</mtd>" for cell in row) + "</mtr>" for row in cells
    )
    return f'<mtable class="{kind}">{rows}</mtable>' if kind else f"<mtable>{rows}</mtable>"


def _is_one(row: str) -> bool:
    """Whether the markup is exactly one element, told by its depth."""
    depth = 0
    for match in re.finditer(r"<(/?)\w+[^>]*>", row):
        depth += -1 if match.group(1) else 1
        if not depth:
            return match.end() == len(row)
    return False
