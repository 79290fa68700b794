r"""Sentences of claims and derivations, in which formulas stand as in statements, parted into text
and LaTeX.

What is a formula is told by its words: names of the notation, numerals beside signs, and what joins
them.  The rest stays text.
"""

from __future__ import annotations

import re
from functools import cache

from certificates import checker
from proofs.reports.latex import is_bracketed, latex_of
from proofs.reports.names import GLYPHS, glyph

# Names of sentences that no statement has: regions, maps, and quantities with marks that the
# statement language lacks.
NAMED = {
    "B1^0": r"\mathcal{B}_1^0",
    "B1^+": r"\mathcal{B}_1^+",
    "B1^-": r"\mathcal{B}_1^-",
    "B1": r"\mathcal{B}_1",
    "B2": r"\mathcal{B}_2",
    "Delta_1 E": r"\Delta_1 E",
    "Delta_2 E": r"\Delta_2 E",
    "Delta E_max": r"\Delta E_{\max}",
    "Delta E_sup": r"\Delta E_{\sup}",
    "Delta E": r"\Delta E",
    "E_max": r"E_{\max}",
    "E_sup": r"E_{\sup}",
    "tau_c": r"\tau_c",
    "tau_w": r"\tau_w",
    "xi_1": r"\xi_1",
    "epsilon_1": r"\epsilon_1",
    "e_1": "e_1",
    "e_2": "e_2",
    "e_K": "e_K",
    "b_0": r"\bar b_0",
    "r_0": "r_0",
    "z_k": "z_k",
    "A_T": "A_T",
    "A_t": "A_t",
    "R_alpha": r"R_\alpha",
    "u_1": "u_1",
    "u_2": "u_2",
    "f1": r"\bar f_1",
    "f2": r"\bar f_2",
    "F^t": "F^t",
    "f^n": "f^n",
    "C_y": "C_y",
    "z1": "z_1",
    "z2": "z_2",
    "a_t": "a_t",
    "alpha^n": r"\alpha^n",
    "(-alpha)^n": r"(-\alpha)^n",
    "R(b)": r"R(\bar b)",
    "b": r"\bar b",
    "epsilon": r"\epsilon",
    "kappa": r"\kappa",
    "alpha^k": r"\alpha^k",
    "A_-xi": r"A_{-\xi}",
    "A_-epsilon": r"A_{-\epsilon}",
}
REGIONS = {"H": r"\mathcal{H}", "R": r"\mathcal{R}"}
LETTERS = {
    "C",
    "D",
    "E",
    "F",
    "K",
    "N",
    "T",
    "W",
    "c",
    "f",
    "m",
    "n",
    "p",
    "q",
    "r",
    "t",
    "u",
    "v",
    "w",
    "x",
    "y",
    "z",
}
WORD = re.compile(
    r"""
    \(-alpha\)\^n | Delta_[12]\ E | Delta\ E_(?:max|sup) | Delta\ E\b | B1\^[0+\-](?!\w) | R\(b\)
  | '[a-z]+\b | A_-(?:xi|epsilon) | [A-Za-z]\w*(?:-\w+)+
  | [A-Za-z][A-Za-z0-9]*(?:_[A-Za-z0-9]+)?(?:\^[A-Za-z0-9]+)?
  | \d+(?:/\d+)? | <=|>=|=|<|>|\+|-|\*|/|\^|\(|\)|, | \S
""",
    re.VERBOSE,
)
JOINING = {
    "<=": r"\le",
    ">=": r"\ge",
    "=": "=",
    "<": "<",
    ">": ">",
    "+": "+",
    "-": "-",
    "*": "",
    "/": "/",
    "^": "^",
}


@cache
def pieces(sentence: str) -> tuple[tuple[str, str], ...]:
    r"""The sentence as ("text", words) and ("math", LaTeX), in order.

    >>> text = "For 0 < alpha < 1/3 every orbit is attracted to R."
    >>> pieces(text)  # doctest: +NORMALIZE_WHITESPACE
    (('text', 'For '), ('math', '0 < \\alpha < \\frac{1}{3}'),
     ('text', ' every orbit is attracted to '), ('math', '\\mathcal{R}'), ('text', '.'))
    """
    found: list[tuple[str, str]] = []
    at = 0
    for start, end in _formulas(sentence):
        if sentence[at:start]:
            found.append(("text", sentence[at:start]))
        found.append(("math", _formula(sentence[start:end])))
        at = end
    return (*found, ("text", sentence[at:])) if sentence[at:] else tuple(found)


def _formulas(sentence: str) -> list[tuple[int, int]]:
    """The stretches that are formulas: the longest runs of names, numerals, signs and balanced
    brackets that hold a name or a sign.
    """
    words = [(one.group(), one.start(), one.end()) for one in WORD.finditer(sentence)]
    found, place = [], 0
    while place < len(words):
        if not _begins(words, place):
            place += 1
            continue
        last = _run(words, place)
        tokens = [word for word, _, _ in words[place:last]]
        if any(_is_name(word) for word in tokens) or len(tokens) > 1:
            found.append((words[place][1], words[last - 1][2]))
        place = last
    return found


def _is_name(word: str) -> bool:
    base, raised, exponent = word.partition("^")
    if raised:
        return word in NAMED or _is_name(base) and (exponent.isdigit() or exponent in LETTERS)
    return (
        word in NAMED
        or word in REGIONS
        or word in GLYPHS
        or word in LETTERS
        or bool(re.fullmatch(r"[a-z]\d", word))
    )


def _is_atom(word: str) -> bool:
    return _is_name(word) or bool(re.fullmatch(r"\d+(/\d+)?", word))


def _begins(words: list[tuple[str, int, int]], place: int) -> bool:
    word = words[place][0]
    following = words[place + 1][0] if place + 1 < len(words) else ""
    if word in ("-", "("):
        return (
            _is_atom(following) and _closes(words, place)
            if word == "("
            else _is_atom(following) and words[place + 1][1] == words[place][2]
        )
    return _is_atom(word)


def _closes(words: list[tuple[str, int, int]], place: int) -> bool:
    """Whether what the bracket holds is a formula, and not a number of an equation or a remark."""
    inside = list[str]()
    for word, _, _ in words[place + 1 :]:
        if word == ")":
            return (any(map(_is_name, inside)) or "," in inside) and all(
                _is_atom(one) or one in JOINING or one in ",(" for one in inside
            )
        inside.append(word)
    return False


def _run(words: list[tuple[str, int, int]], place: int) -> int:
    """Where the formula that begins at this word ends."""
    depth, last, expects = 0, place, True
    while place < len(words):
        word = words[place][0]
        following = words[place + 1][0] if place + 1 < len(words) else ""
        if expects and (_is_atom(word)):
            expects, place = False, place + 1
        elif expects and word == "-":
            place += 1
        elif word == "(" and (expects or words[place][1] > 0) and _closes(words, place):
            depth, expects, place = depth + 1, True, place + 1
        elif not expects and word == ")" and depth:
            depth, place = depth - 1, place + 1
        elif not expects and word in JOINING and (_is_atom(following) or following in ("(", "-")):
            expects, place = True, place + 1
        elif (
            not expects
            and word == ","
            and depth
            and (_is_atom(following) or following in ("(", "-"))
        ):
            expects, place = True, place + 1
        elif (
            not expects
            and _is_atom(word)
            and words[place - 1][2] + 1 == words[place][1]
            and _is_factor(words[place - 1][0], True)
            and (_is_factor(word, False))
        ):
            place += 1
        else:
            break
        if not expects and not depth:
            last = place
    return max(last, 1)


def _is_factor(word: str, first: bool) -> bool:
    """Whether the word can stand beside another one as a factor."""
    return (
        word in LETTERS
        or word in GLYPHS
        or (word == ")" or word.isdigit() if first else word in NAMED)
    )


def _formula(text: str) -> str:
    """The LaTeX of a stretch: of the statement language where it is one, else word by word."""
    words = [found.group() for found in WORD.finditer(text)]
    if not any(word in NAMED or word in REGIONS for word in words):
        try:
            return rf"({latex_of(text)})" if is_bracketed(text) else latex_of(text)
        except (checker.Rejected, TypeError):
            pass
    shown = ""
    for found in WORD.finditer(text):
        word = found.group()
        piece = (
            NAMED.get(word) or REGIONS.get(word) or JOINING.get(word) if word != "/" else "/"
        ) or (
            _raised(word) if "^" in word[1:] else glyph(word) if _is_name(word) else _numeral(word)
        )
        if word == "*":
            continue
        spaced = (
            word in ("<=", ">=", "=", "<", ">", "+")
            or word == "-"
            and shown
            and shown[-1] not in "(,= "
        )
        if spaced:
            piece = f" {piece} "
        elif re.search(r"\\[A-Za-z]+$", shown) and piece[:1].isalnum():
            piece = " " + piece
        shown += piece + (" " if word == "," else "")
    return shown.strip()


def _raised(word: str) -> str:
    base, _, exponent = word.partition("^")
    return f"{NAMED.get(base) or REGIONS.get(base) or glyph(base)}^{exponent}"


def _numeral(word: str) -> str:
    above, slash, below = word.partition("/")
    return rf"\frac{{{above}}}{{{below}}}" if slash and below else word
