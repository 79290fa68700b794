"""Candidates for the correction of a refuted print."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from fractions import Fraction

from juggleproof.judging.claims import Claim, claims_beside
from juggleproof.reading.edits import one_mark_changes
from juggleproof.reading.lexer import RELATIONS, PrintError, lex
from juggleproof.reading.meaning import Printed
from juggleproof.reading.tree import Chain, Name, spelled
from juggleproof.reading.values import Matrix, Value, Vector
from juggleproof.statements.language import ClaimError, Term, names_in, term

# -------------------------------------------------------------------------------------------------
# Corrections of a print that is refuted: one mark changed, rational coefficients on the printed
# terms, the derived form.
#
# Nothing here is believed: a candidate is a print, which the same claim function reads, and whose
# statements the checker judges.

LINE = r" \\ "  # between two lines of an array
LOST_MARKS = ("dot", "bar", "prime", "sign", "exponent", "half")


@dataclass(frozen=True)
class CorrectedPrint:
    """A corrected print: its kind, the change, its LaTeX, and its reading for the claim."""

    kind: str
    change: str
    text: str
    printed: Printed

    @property
    def possible_transcription_error(self) -> bool:
        """Whether one lost mark mends the print, so that the fault may be the transcription's and
        not the authors'.
        """
        return self.kind in LOST_MARKS

    def unbound(self, claim: Claim) -> list[str]:
        """The names in the print that have no meaning in the claim's section: neither the
        vocabulary, nor a definition printed there, nor its prose gives them one.
        """
        words = claim.vocabulary
        if words.reads is None or words.introduces is None:
            return []
        keys = Printed("", tuple(words.reads().meanings)).names
        known = {*keys, *words.introduces(claim.section)}
        for one in claims_beside(claim):
            for part in one.read_print().parts if one.printed else ():
                if isinstance(part.tree, Chain) and part.tree.rest[0][0] == ":=":
                    known.update(Printed("", (part.tree.first,)).names)
        return [name for name in self.printed.names if not {name, with_any_index(name)} & known]


def with_any_index(name: str) -> str:
    """The name with a placeholder for its index, under which A_t has a meaning for all t."""
    return re.sub(r"_\{.*\}", r"_{\\cdot}", name)


def candidates(claim: Claim, first: tuple[str, str] | None = None) -> Iterator[CorrectedPrint]:
    """The corrections to try, in order: one mark changed, the corrected print that the claim names,
    other coefficients on the printed terms, the derived form.

    `first` is the kind and text of the candidate to try before all others.
    """
    ways = (_one_mark, _mended, _derived)
    if first is not None:
        quick = sorted(ways, key=lambda way: way is not _mended)  # there are many one-mark changes
        yield from (one for way in quick for one in way(claim) if (one.kind, one.text) == first)
    yield from (one for way in ways for one in way(claim) if (one.kind, one.text) != first)


def _one_mark(claim: Claim) -> Iterator[CorrectedPrint]:
    for change, latex in one_mark_changes(claim.printed):
        yield CorrectedPrint(change.split(":")[0], change, latex, Printed(latex))


def _mended(claim: Claim) -> Iterator[CorrectedPrint]:
    if claim.mended:
        change = "; ".join(differences(claim.printed, claim.mended))
        yield CorrectedPrint("marks", f"marks: {change}", claim.mended, Printed(claim.mended))


def _derived(claim: Claim) -> Iterator[CorrectedPrint]:
    """The print with its right side replaced: by its own terms with other coefficients, then by the
    derived form, both written in the paper's notation.
    """
    right, words = _printed_right(claim), claim.vocabulary
    if claim.derived is None or words.reads is None:
        return
    truth, roots = claim.derived(), words.roots
    names = {
        value.name: spelled(key)
        for key, value in words.reads().meanings.items()
        if isinstance(key, Name) and isinstance(value, Term) and value.op == "var"
    }
    fitted = (
        coefficients_on_printed_terms(right, truth, roots)
        if isinstance(right, Term) and isinstance(truth, Term)
        else None
    )
    forms = [("coefficients", "rational coefficients on the printed terms", fitted)]
    for kind, change, form in [*forms, ("derived", "the derived form", truth)]:
        if form is not None:
            try:
                shown = _as_printed(form, names, roots)
                latex = f"{_up_to_the_last_side(claim.printed)} {shown}"
                yield CorrectedPrint(kind, change, latex, Printed(latex))
            except (KeyError, PrintError):  # it has names that the paper does not print
                continue


def _up_to_the_last_side(latex: str) -> str:
    """The print up to and including the sign of its last relation."""
    signs = [token.end for token in lex(latex) if token.text in RELATIONS]
    return latex[: signs[-1]] if signs else latex


def _as_printed(
    value: Term | Vector | Matrix, names: Mapping[str, str], roots: Mapping[str, Term]
) -> str:
    """A term, column or matrix as LaTeX in these names, with roots written out."""
    if isinstance(value, (Vector, Matrix)):
        rows = value.rows if isinstance(value, Matrix) else [(entry,) for entry in value.entries]
        lines = [
            " & ".join(_as_printed(term(entry), names, roots) for entry in row) for row in rows
        ]
        return rf"\begin{{bmatrix}} {LINE.join(lines)} \end{{bmatrix}}"
    return _latex(term(value), names, roots)


def _latex(
    value: Term, names: Mapping[str, str], roots: Mapping[str, Term], inside: str = "+"
) -> str:
    """A term as LaTeX, in the order of its parts; `inside` is the operation that contains it."""
    if value.op == "var":
        root = roots.get(value.name)
        return names[value.name] if root is None else rf"\sqrt{{{_latex(root, names, roots)}}}"
    if value.op == "num":
        number = abs(value.value)
        size = str(number) if number.denominator == 1 else _fraction(*number.as_integer_ratio())
        return size if value.value >= 0 else f"-{size}"
    if value.op == "^":
        return f"{_latex(value.operands[0], names, roots, '^')}^{{{value.exponent}}}"
    if value.op == "/":
        return _fraction(*(_latex(one, names, roots) for one in value.operands))
    if value.op == "*":
        text = " ".join(_latex(one, names, roots, "*") for one in value.operands)
    elif value.op == "neg":
        text = f"-{_latex(value.operands[0], names, roots, '*')}"
    else:
        left, right = value.operands
        text = f"{_latex(left, names, roots)} {value.op} {_latex(right, names, roots, '-')}"
    bare = inside == "+" or (inside, value.op) in (("*", "*"), ("-", "*"))
    return text if bare else f"({text})"


def _fraction(above: object, below: object) -> str:
    return rf"\frac{{{above}}}{{{below}}}"


def differences(printed: str, mended: str) -> list[str]:
    r"""The changes from the printed to the corrected LaTeX, mark by mark.

    >>> differences(r"f_1 := -A x", r"f_2 := A x^2")
    ['1 to 2', '- dropped', '^2 added']
    """
    before, after = ([token.text for token in lex(text)[:-1]] for text in (printed, mended))
    found = []
    for change, i, j, k, n in SequenceMatcher(None, before, after, autojunk=False).get_opcodes():
        old, new = "".join(before[i:j]), "".join(after[k:n])
        if change != "equal":
            found.append(
                f"{old} dropped" if not new else f"{new} added" if not old else f"{old} to {new}"
            )
    return found


# Patterns of changes, with words for a reader of the print; columns are left out, since the
# corrected formula shows where the change is.
NOTES = (
    (r"(?:(dot|bar): put over|(prime): put after) (\S+)", r"\1\2 restored on \3"),
    (r"index: (\S+) put after (\S+)", r"index \1 restored after \2"),
    (r"index: (\S+) to (\S+)", r"index \1 replaced by \2"),
    (r"sign: turned", "sign turned"),
    (r"sign: minus put", "minus sign restored"),
    (r"exponent: brought down", "exponent brought down to the line"),
    (r"exponent: (\S+) put", r"exponent \1 restored"),
    (r"half: put|\\frac\{1\}\{2\} added", "half restored"),
    (r"half: (\S+) dropped", r"factor \1 dropped"),
    (r"(dot|bar|prime|index|exponent|half): dropped", r"\1 dropped"),
    (r"swap: (\S+) and (\S+)", r"\1 and \2 exchanged"),
    (r"_\{?(\w+)\}? (added|dropped)", r"index \1 \2"),
    (r"\^\{?(\w+)\}? (added|dropped)", r"exponent \1 \2"),
    (r"- (added|dropped)", r"minus sign \1"),
    (r"(?:(?:letter|strictness): )?(\S+) to (\S+)", r"\1 replaced by \2"),
)


def note_of(change: str) -> str:
    r"""A candidate's change in words, without columns.

    >>> note_of("half: put at column 18"), note_of("marks: H to B; _1 added")
    ('half restored', 'H replaced by B; index 1 added')
    >>> note_of("swap: y and x at columns 4 and 7"), note_of("a true assertion nearby")
    ('y and x exchanged', 'a true assertion nearby')
    """

    def noted(part: str) -> str:
        matches = ((re.fullmatch(pattern, part), words) for pattern, words in NOTES)
        return next((match.expand(words) for match, words in matches if match), part)

    marks = re.sub(r" at columns? \d+( and \d+)?$", "", change).removeprefix("marks: ")
    return "; ".join(map(noted, marks.split("; ")))


def _printed_right(claim: Claim) -> Value | None:
    """The value of the printed right-hand side; None where the claim's vocabulary does not suffice
    to read it.
    """
    if claim.vocabulary.reads is None:
        return None
    try:
        right: Value = claim.read_print().right(claim.vocabulary.reads())
        return right
    except ClaimError:
        return None


def coefficients_on_printed_terms(
    printed: Term, truth: Term, roots: Mapping[str, Term] | None = None
) -> Term | None:
    """The printed sum with other rational coefficients on its terms, so that it equals the truth;
    None where no coefficients do.  `roots` are names for square roots of terms, each linear in one
    variable.

    >>> from juggleproof.statements.language import reals
    >>> x, y = reals("x y")
    >>> str(coefficients_on_printed_terms((x + y) * 2, x * 2 + y))
    '(x + 1/2*y)*2'
    """
    split = _sum_inside(printed)
    if split is None:
        return None
    terms, rebuild = split
    names = sorted(names_in(printed) | names_in(truth))
    rows = []
    for seed in range(len(terms) + 4):
        point = {
            name: Fraction(7 * (seed + 2) + 3 * i * (seed + 1), 11 + 5 * i + seed)
            for i, name in enumerate(names)
        }
        for name, under in (roots or {}).items():
            variables = names_in(under)
            if name in point and len(variables) == 1:  # solves point[name]**2 = under
                (variable,) = variables
                constant, one = (_value(under, {variable: Fraction(k)}) for k in (0, 1))
                point[variable] = (point[name] ** 2 - constant) / (one - constant)
        try:
            row = [_value(rebuild([one]), point) for one in terms]
            rows.append([*row, _value(truth, point)])
        except ZeroDivisionError:
            continue
    solution = _solve(rows, len(terms))
    if solution is None:
        return None
    fitted: Term = rebuild([_times(c, one) for one, c in zip(terms, solution) if c])
    return fitted


def _times(number: Fraction, addend: Term) -> Term:
    """The multiple of an addend, with at most one minus sign, in front."""
    negative, bare = number < 0, addend
    while bare.op == "neg":
        negative, bare = not negative, bare.operands[0]
    if bare.op == "num":
        bare = term(bare.value * abs(number))
    elif abs(number) != 1:
        bare = term(abs(number)) * bare
    return -bare if negative else bare


def _sum_inside(expression: Term) -> tuple[list[Term], Callable[[Sequence[Term]], Term]] | None:
    """The signed terms of the first sum inside products and quotients, and a function that puts the
    sum of other terms in its place.
    """
    if expression.op in ("+", "-"):
        return _terms_of(expression), _total
    if expression.op in ("*", "/"):
        left, right = expression.operands
        inner = _sum_inside(left)
        if inner is not None:
            terms, rebuild = inner
            return terms, lambda new: Term(expression.op, rebuild(new), right)
        if expression.op == "*":
            inner = _sum_inside(right)
            if inner is not None:
                terms, rebuild = inner
                return terms, lambda new: Term("*", left, rebuild(new))
    return None


def _terms_of(expression: Term) -> list[Term]:
    if expression.op == "+":
        left, right = expression.operands
        return _terms_of(left) + _terms_of(right)
    if expression.op == "-":
        left, right = expression.operands
        return _terms_of(left) + [-one for one in _terms_of(right)]
    return [expression]


def _total(terms: Sequence[Term]) -> Term:
    total = terms[0]
    for one in terms[1:]:
        total = total - one.operands[0] if one.op == "neg" else total + one
    return total


def _value(expression: Term, point: dict[str, Fraction]) -> Fraction:
    if expression.op == "var":
        return point[expression.name]
    if expression.op == "num":
        return expression.value
    parts = [_value(part, point) for part in expression.operands]
    if expression.op == "neg":
        return -parts[0]
    if expression.op == "^":
        return parts[0] ** expression.exponent
    a, b = parts
    arithmetic = {
        "+": operator.add,
        "-": operator.sub,
        "*": operator.mul,
        "/": operator.truediv,
    }
    return Fraction(arithmetic[expression.op](a, b))


def _solve(rows: list[list[Fraction]], unknowns: int) -> list[Fraction] | None:
    """The solution of an overdetermined linear system, or None if it has none or several."""
    rows = [list(row) for row in rows]
    for column in range(unknowns):
        pivot = next((i for i in range(column, len(rows)) if rows[i][column]), None)
        if pivot is None:
            return None
        rows[column], rows[pivot] = rows[pivot], rows[column]
        rows[column] = [value / rows[column][column] for value in rows[column]]
        for i, row in enumerate(rows):
            if i != column and row[column]:
                rows[i] = [a - row[column] * b for a, b in zip(row, rows[column])]
    if any(any(row) for row in rows[unknowns:]):
        return None
    return [row[unknowns] for row in rows[:unknowns]]
