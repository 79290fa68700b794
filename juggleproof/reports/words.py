"""Sentences and statements as words and LaTeX, and the intervals of sharp ranges."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from functools import cache

from juggleproof.certificates import checker
from juggleproof.papers.paper import opened
from juggleproof.reports.latex import glyph, is_bracketed, latex_of

# -------------------------------------------------------------------------------------------------
# Sentences of claims and derivations, whose formulas are written as in statements, split into text
# and LaTeX.
#
# A formula is recognized by its words: names of the notation, numerals beside signs, and joining
# signs. The rest is text.

NAME = r"[A-Za-z][A-Za-z0-9]*(?:_[A-Za-z0-9]+)?(?:\^[A-Za-z0-9]+)?"


@cache
def _word() -> re.Pattern[str]:
    """The pattern of a word of a sentence: a name of the paper that has spaces or signs, a word, a
    numeral, or a sign.
    """
    names = [one for one in opened().notation.sentences if not re.fullmatch(NAME, one)]
    signed = "".join(rf"{re.escape(one)}(?!\w)|" for one in sorted(names, key=len, reverse=True))
    return re.compile(
        rf"{signed}\|[A-Za-z]\w*\||'[a-z]+\b|[A-Za-z]\w*(?:\.\w+)*(?:-\w+)+|{NAME}"
        r"|\d+(?:/\d+)?|<=|>=|=|<|>|\+|-|\*|/|\^|\(|\)|\S"
    )


SIGN = re.compile(  # a letter or sign in the description of a change; `a` is the article
    r"(\\[A-Za-z]+(?:\{[^{}]*\})*(?:_\w)?|\b[A-Zb-z]\b|[<>])"
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
    r"""The sentence as pairs ("text", words) and ("math", LaTeX), in order.

    >>> text = "For 0 < alpha < 1/3 every orbit is attracted to R."
    >>> pieces(text)  # doctest: +NORMALIZE_WHITESPACE
    (('text', 'For '), ('math', '0 < \\alpha < \\frac{1}{3}'),
     ('text', ' every orbit is attracted to '), ('math', '\\mathcal{R}'), ('text', '.'))
    >>> pieces("2 alpha^12 times nearer to e_6")
    (('math', '2\\alpha^{12}'), ('text', ' times nearer to '), ('math', 'e_6'))
    """
    parts: list[tuple[str, str]] = []
    at = 0
    for start, end in _formulas(sentence):
        if sentence[at:start]:
            parts.append(("text", sentence[at:start]))
        parts.append(("math", _formula(sentence[start:end])))
        at = end
    return (*parts, ("text", sentence[at:])) if sentence[at:] else tuple(parts)


def _formulas(sentence: str) -> list[tuple[int, int]]:
    """The spans (start, end) of formulas: the longest runs of names, numerals, signs and balanced
    brackets that contain a name or a sign.
    """
    words = [(one.group(), one.start(), one.end()) for one in _word().finditer(sentence)]
    spans, place = [], 0
    while place < len(words):
        if not _begins(words, place):
            place += 1
            continue
        last = max(_run(words, place), place + 1)
        tokens = [word for word, _, _ in words[place:last]]
        if any(_is_name(word) for word in tokens) or len(tokens) > 1:
            spans.append((words[place][1], words[last - 1][2]))
        place = last
    return spans


def _is_name(word: str) -> bool:
    notation, word = opened().notation, word.strip("|")
    base, raised, exponent = word.partition("^")
    if raised:
        is_power = exponent.isdigit() or exponent in notation.letters
        return word in notation.sentences or _is_name(base) and is_power
    numbered = re.fullmatch(r"([a-z]+)\d", word)
    return (
        word in notation.sentences
        or word in notation.glyphs
        or word in notation.letters
        or numbered is not None
        and (len(numbered[1]) == 1 or numbered[1] in notation.glyphs)
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
    """Whether the bracket contains a formula, and not the number of an equation or a remark."""
    inside = list[str]()
    for word, _, _ in words[place + 1 :]:
        if word == ")":
            return (any(map(_is_name, inside)) or "," in inside) and all(
                _is_atom(one) or one in JOINING or one in ",(" for one in inside
            )
        inside.append(word)
    return False


def _run(words: list[tuple[str, int, int]], place: int) -> int:
    """The index after the last word of the formula that begins at this word."""
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
    return last


def _is_factor(word: str, first: bool) -> bool:
    """Whether the word can stand beside another one as a factor."""
    notation, name = opened().notation, word.strip("|")
    base = name.partition("^")[0]
    return (
        base in notation.letters
        or base in notation.glyphs
        or (word == ")" or word[0].isdigit() if first else name in notation.sentences)
    )


def _formula(text: str) -> str:
    """The LaTeX of a formula: as in statements, if the statement language can read it, else word by
    word.
    """
    known = opened().notation.sentences
    words = [found.group() for found in _word().finditer(text)]
    if not any(word in known for word in words):
        try:
            return rf"({latex_of(text)})" if is_bracketed(text) else latex_of(text)
        except (checker.Rejected, TypeError):
            pass
    shown = ""
    for found in _word().finditer(text):
        word = found.group().strip("|")
        bar = "|" if word != found.group() else ""
        piece = (known.get(word) or JOINING.get(word) if word != "/" else "/") or (
            _raised(word) if "^" in word[1:] else glyph(word) if _is_name(word) else _numeral(word)
        )
        piece = bar + piece + bar
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
    power = exponent if len(exponent) == 1 else f"{{{exponent}}}"
    return f"{opened().notation.sentences.get(base) or glyph(base)}^{power}"


def _numeral(word: str) -> str:
    above, slash, below = word.partition("/")
    return rf"\frac{{{above}}}{{{below}}}" if slash and below else word


# -------------------------------------------------------------------------------------------------
# Sharp ranges, read from their text into intervals that can be drawn.

# low, high, and whether each belongs to the interval; for a single number low = high
Interval = tuple[Fraction, Fraction, bool, bool]

NUMBERS_SHOWN = (2, 3)  # the values put for K or n, where the range depends on one
_READING = re.compile(r"([A-Za-z][\w-]*): (.*)", re.DOTALL)
_END = re.compile(r"(c\d+) = (-?\d+\.\d+)\.\.\., a root of .*", re.DOTALL)
_POINT = re.compile(r"(\w+) = (.+)")
_BETWEEN = re.compile(r"(.+?) (<=?) (\w+) (<=?) (.+)")
_WHOLE_NUMBER = re.compile(r"(.*) for a whole number ([A-Za-z]\w*)")


def read(text: str) -> list[tuple[str, list[Interval] | None]]:
    """The intervals of each reading with its label, and for each number put for K or n; None where
    the range cannot be drawn.

    >>> read("0 < alpha < 1/3")
    [('', [(Fraction(0, 1), Fraction(1, 3), False, False)])]
    >>> several = read("K/(K + 2) <= alpha < 1; as-in-11: nowhere")
    >>> [(label, [str(one[1]) for one in intervals]) for label, intervals in several]
    [('K = 2', ['1']), ('K = 3', ['1']), ('as-in-11', [])]
    >>> read("sampled: not found")
    [('sampled', None)]
    """
    ranges: list[tuple[str, str, dict[str, Fraction]]] = []
    for piece in text.split("; "):
        end, reading = _END.fullmatch(piece), _READING.fullmatch(piece)
        if end and ranges:
            ranges[-1][2][end[1]] = Fraction(end[2])
        else:
            ranges.append((reading[1], reading[2], {}) if reading else ("", piece, {}))
    return [
        (", ".join(part for part in (label, name) if part), intervals)
        for label, sharp, ends in ranges
        for name, intervals in _for_each_number(sharp, ends)
    ]


def _for_each_number(
    sharp: str, ends: Mapping[str, Fraction]
) -> list[tuple[str, list[Interval] | None]]:
    match = _WHOLE_NUMBER.fullmatch(sharp)
    sharp, number = (match[1], match[2]) if match else (sharp, "K")
    if not re.search(rf"\b{number}\b", sharp):
        return [("", _intervals(sharp, ends))]
    return [
        (f"{number} = {one}", _intervals(sharp, {**ends, number: Fraction(one)}))
        for one in NUMBERS_SHOWN
    ]


def _intervals(sharp: str, values: Mapping[str, Fraction]) -> list[Interval] | None:
    if sharp == "nowhere":
        return []
    intervals, parameter = [], opened().parameter
    for piece in sharp.split(" or "):
        point, between = _POINT.fullmatch(piece), _BETWEEN.fullmatch(piece)
        try:
            if point and point[1] == parameter:
                number = _value(point[2], values)
                intervals.append((number, number, True, True))
            elif between and between[3] == parameter:
                low, high = _value(between[1], values), _value(between[5], values)
                intervals.append((low, high, between[2] == "<=", between[4] == "<="))
            else:
                return None
        except (SyntaxError, LookupError, ZeroDivisionError):
            return None
    return intervals


def _value(text: str, values: Mapping[str, Fraction]) -> Fraction:
    """The value of an end, which may have whole numbers, names, + - * / and parentheses; raises
    LookupError for anything else.
    """
    return _walk(ast.parse(text, mode="eval").body, values)


def _walk(node: ast.expr, values: Mapping[str, Fraction]) -> Fraction:
    if isinstance(node, ast.Constant) and type(node.value) is int:
        return Fraction(node.value)
    if isinstance(node, ast.Name):
        return values[node.id]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -_walk(node.operand, values)
    if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub, ast.Mult, ast.Div)):
        left, right = _walk(node.left, values), _walk(node.right, values)
        kind = type(node.op)
        return (
            left + right
            if kind is ast.Add
            else (
                left - right
                if kind is ast.Sub
                else left * right
                if kind is ast.Mult
                else left / right
            )
        )
    raise LookupError(ast.dump(node))


# -------------------------------------------------------------------------------------------------
# The lines of a statement as words and formulas.

WORDS = {
    "forall": "for all",
    "integer": "whole numbers",
    "range": "given",
    "given": "given",
    "have": "so that",
    "let": "where",
    "root": "where",
    "exists": "there are",
    "with": "with",
    "show": "then",
    "iterates": "the map",
    "after": "after",
    "over": "for all",
    "input": "for all inputs",
    "domain": "given",
    "holds": "exactly if",
    "number": "where",
    "state": "of the state",
    "space": "in",
    "piece": "the map",
    "word": "pieces",
    "never": "impossible pieces",
}


def _bare(text: str) -> str:
    return text[1:-1].rstrip(",") if text.startswith("(") and text.endswith(")") else text


def parts_of(text: str) -> list[str]:
    """The parts of a text between commas outside of brackets."""
    parts, depth, start = list[str](), 0, 0
    for place, sign in enumerate(text):
        depth += (sign == "(") - (sign == ")")
        if sign == "," and not depth:
            parts.append(text[start:place].strip())
            start = place + 1
    return [*parts, text[start:].strip()]


def formulas_of(text: str) -> Iterator[tuple[str, str]]:
    """Every formula of a statement with its LaTeX, for comparison."""
    for line in text.splitlines()[1:]:
        keyword, _, content = line.partition(" ")
        if keyword in (
            "range",
            "given",
            "have",
            "with",
            "show",
            "domain",
            "holds",
            "space",
            "rank",
            "stage",
            "on",
            "rate",
            "radius",
            "size",
            "loss",
            "least",
            "upper",
        ):
            yield content, latex_of(content)
        elif keyword in ("point", "weights", "start", "direction"):
            yield from ((part, latex_of(part)) for part in parts_of(content))
        elif keyword in ("let", "root", "number"):
            value = content.partition(" = ")[2]
            rooted = re.fullmatch(r"(?:sqrt|root)\((.*)\)", value)
            for part in parts_of(rooted.group(1)) if rooted else [value]:
                yield part, latex_of(part)
        elif keyword == "value":
            yield from ((part, latex_of(part)) for part in content.split(" -> "))
        elif keyword in ("piece", "iterates", "after") and "->" in content:
            source, _, image = content.partition(" -> ")
            for part in [
                *(parts_of(_bare(source)) if keyword != "after" else []),
                *parts_of(_bare(image)),
            ]:
                yield part, latex_of(part)
