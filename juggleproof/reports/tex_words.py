"""The functions that the LaTeX templates call: text, formulas, headings and notes as LaTeX."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import starmap
from typing import TYPE_CHECKING

from juggleproof.certificates import checker
from juggleproof.judging.claims import Claim
from juggleproof.judging.correcting import note_of
from juggleproof.papers.paper import opened
from juggleproof.papers.places import place_of
from juggleproof.papers.remarks import NAMES, PROSE, meanings, names_of
from juggleproof.reading.meaning import read
from juggleproof.reading.tree import Operator, Tree, spelled
from juggleproof.reports.contents import Entry
from juggleproof.reports.errata import WRONG, for_which, is_latex
from juggleproof.reports.latex import glyph, latex_of, narrow, with_macros
from juggleproof.reports.results import has_range
from juggleproof.reports.words import SIGN, pieces
from juggleproof.statements.language import ClaimError

if TYPE_CHECKING:
    from juggleproof.papers.derivations import Derivation

SPECIAL = {
    "\\": r"\textbackslash{}",
    "&": r"\&",
    "%": r"\%",
    "$": r"\$",
    "#": r"\#",
    "_": r"\_",
    "{": r"\{",
    "}": r"\}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": "$<$",
    ">": "$>$",
    "|": r"\textbar{}",
    '"': "''",
    "`": "'",
}


def plain(text: str) -> str:
    r"""The text with LaTeX's special characters escaped.

    >>> plain("50% of f_1")
    '50\\% of f\\_1'
    """
    return "".join(SPECIAL.get(sign, sign) for sign in text)


def code(text: str) -> str:
    r"""A text in typewriter face, which may be broken after each sign such as + or _.

    >>> code("a_1+b")
    '\\texttt{a\\_\\penalty0{}1+\\penalty0{}b}'
    """
    signs = (plain(sign) + (r"\penalty0{}" if sign in "_^+-=(){},/" else "") for sign in text)
    return rf"\texttt{{{''.join(signs)}}}"


def prose(text: str) -> str:
    r"""A sentence with its formulas as LaTeX, and names of claims in typewriter face.

    >>> prose("The maximum of Delta_1 E on H. (eq-37)")
    'The maximum of $\\Delta_1 E$ on $\\jugH$. (\\texttt{eq-\\penalty0{}37})'
    """
    between = re.split(rf"\b({opened().notation.claims})", text)
    return "".join(
        code(part) if place % 2 else "".join(starmap(_set, pieces(part)))
        for place, part in enumerate(between)
    )


def _set(kind: str, content: str) -> str:
    return f"${with_macros(content)}$" if kind == "math" else plain(content).replace("!=", r"$\ne$")


def why(entry: Entry) -> str:
    """The reason why the transcription is not judged; words with LaTeX commands are code."""
    text = re.sub(r"column \d+: ", "", entry.why_restored)
    return " ".join(code(one) if "\\" in one or "_" in one else plain(one) for one in text.split())


def lines(latex: str) -> list[str]:
    r"""The lines of a print, split at each \\ outside of environments.

    >>> lines(r"a = b \\ c = \begin{bmatrix} 1 \\ 2 \end{bmatrix}")
    ['a = b', 'c = \\begin{bmatrix} 1 \\\\ 2 \\end{bmatrix}']
    """
    rows, depth, start = list[str](), 0, 0
    for token in re.finditer(r"\\begin|\\end|\\\\", latex):
        depth += {"\\begin": 1, "\\end": -1}.get(token.group(), 0)
        if token.group() == r"\\" and not depth:
            rows.append(latex[start : token.start()].strip())
            start = token.end()
    return [*rows, latex[start:].strip()]


def formula(latex: str) -> str:
    """The two arguments of a display: the formula as a whole, and in a form that can be broken."""
    rows = [with_macros(row) for row in lines(latex)]
    whole = (
        rows[0] if len(rows) == 1 else "\\begin{gathered}" + r" \\ ".join(rows) + "\\end{gathered}"
    )
    return "{" + whole + "}{" + r" $\newline $ ".join(rows) + "}"


def inline(latex: str) -> str:
    """A print on one line, with its rows one after another."""
    return r",\quad ".join(with_macros(without_stop(row)) for row in lines(latex))


def without_stop(row: str) -> str:
    r"""A row without the full stop or comma at its end.

    >>> without_stop("a = b."), without_stop(r"\left\{ a \right.")
    ('a = b', '\\left\\{ a \\right.')
    """
    return row if row.rstrip().endswith(r"\right.") else row.rstrip(" .,")


def correction(entry: Entry) -> str:
    """The corrected print as LaTeX, or the sentence that is true."""
    if entry.correction is None:
        raise ValueError(f"{entry.claim.id} has no correction")
    text = entry.correction["text"]
    return text if is_latex(entry.correction) else rf"\text{{{prose(text)}}}"


LETTERLESS = re.compile(r"\\(?:mathcal|overline)|[{}\\]")  # the signs that a bookmark leaves out
SET = re.compile(r"(.*\\mid ).+?( *\\(?:right)?\\?\})", re.DOTALL)  # around its condition


def regenerated(entry: Entry) -> str:
    """The print of a claim in the form that is true: the print itself where nothing corrects it.

    A true assertion nearby that refers to the print by its number has the print in place of the
    number; one about the condition of a set stands in the set.
    """
    printed = without_stop(entry.claim.printed)
    if entry.correction is None:
        return printed
    body = correction(entry)
    if entry.correction["kind"] != "nearby" or not is_latex(entry.correction):
        return body
    of_set = SET.fullmatch(printed)
    if of_set:
        return of_set[1] + body + of_set[2]
    return body.replace(rf"\text{{({number(entry.claim)}) or }}", rf"{printed} \text{{ or }}")


def footnote(entry: Entry) -> str:
    """What the equation of a claim among the errata is, as its footnote says."""
    if entry.correction is None:
        return f"As printed ({entry.verdict})"
    return "True instead" if entry.correction["kind"] == "nearby" else "Corrected"


def corrected(entry: Entry) -> str:
    """The corrected print on one line, or the sentence that is true."""
    found = entry.correction
    if found is None or is_latex(found):
        return f"${inline(correction(entry))}$"
    return prose(found["text"])


def change(entry: Entry) -> str:
    """The description of the correction's change, with its letters and signs as formulas."""
    text = note_of(entry.correction["change"]) if entry.correction else ""
    return "".join(
        f"${with_macros(part)}$" if i % 2 else plain(part)
        for i, part in enumerate(SIGN.split(text))
    )


def number(claim: Claim) -> str:
    """The number of a claim's equation, without brackets; empty where it has none."""
    match = re.fullmatch(r"\((\d+)\)(?:, .*)?", claim.place)
    return match.group(1) if match and "," not in claim.place else ""


def headline(text: str) -> str:
    r"""A heading as LaTeX; the bookmark of a PDF has its formulas in letters.

    >>> headline(r"Finding $\Delta E_{\sup}$")
    'Finding \\texorpdfstring{$\\Delta E_{\\sup}$}{Delta E_sup}'
    """
    parts = text.split("$")
    return "".join(
        rf"\texorpdfstring{{${with_macros(part)}$}}{{{re.sub(LETTERLESS, '', part)}}}"
        if place % 2
        else plain(part)
        for place, part in enumerate(parts)
    )


def heading(claim: Claim) -> str:
    """The heading of a claim: the number of its equation, or its section and place."""
    numbered = claim.place.startswith("(") and number(claim)
    shown = claim.place if numbered else place_of(claim)
    return plain(shown[:1].upper() + shown[1:])


def entries(one: Derivation) -> str:
    """The result of a derivation as LaTeX: a term, a column or a matrix."""
    shown = [[with_macros(latex_of(entry)) for entry in row] for row in one.shown()]
    if len(shown) == 1:
        return shown[0][0] if len(shown[0]) == 1 else "(" + r",\; ".join(shown[0]) + ")"
    return r"\begin{bmatrix}" + r" \\ ".join(" & ".join(row) for row in shown) + r"\end{bmatrix}"


def in_errata(entry: Entry) -> bool:
    """Whether the display of the claim stands among the errata, and not in an appendix."""
    return (
        entry.group in WRONG
        or bool(entry.group)
        and entry.claim.section[:1] not in opened().appendices
    )


def symbol(one: Derivation) -> str:
    """The paper's name for a derived expression, or empty."""
    return with_macros(opened().notation.derived.get(one.function, ""))


# -------------------------------------------------------------------------------------------------
# The symbols of prints, with their meanings in the ledger.


def symbols(latex: str, section: str) -> list[tuple[str, str]]:
    r"""The symbols of a print, or of its correction, with their meanings in this section of the
    paper, or else in another.

    >>> symbols(r"\tau_p < T \text{ or } \alpha = 1", "3.1")  # doctest: +NORMALIZE_WHITESPACE
    [('\\tau_{p}', 'the time since the period began'), ('T', 'the period of the table'),
     ('\\alpha', 'the coefficient of restitution')]

    Raises ClaimError where the ledger has no meaning of a symbol.
    """
    found, known = dict[str, str](), opened().notation.operators
    for row in re.split(r"\\text\{[^{}]*\}", latex):
        for part in read(row).parts if row.strip() else ():
            found |= {sign: known[sign] for sign in _operators(part.tree)}
            found |= {name: _meaning(name, section) for name in names_of(part.tree)}
    return [(narrow(name), meaning) for name, meaning in found.items()]


def _meaning(name: str, section: str) -> str:
    rows = [row for row in meanings() if row.name == name]
    for at in (section, section + PROSE):
        here = [row.meaning for row in rows if at in row.sections]
        if here:
            return "; or ".join(here)
    if not rows:
        raise ClaimError(
            f"{NAMES.name}: no meaning of {name}; add one for section {section}{PROSE}"
        )
    return rows[0].meaning


def _operators(tree: object) -> Iterator[str]:
    if isinstance(tree, tuple):
        for one in tree:
            yield from _operators(one)
    elif isinstance(tree, Tree):
        if isinstance(tree, Operator):
            numbered = tree.sign == r"\Delta" and tree.subscripts
            yield tree.sign + (f"_{spelled(tree.subscripts[0])}" if numbered else "")
        for field in tree.__dataclass_fields__:
            yield from _operators(getattr(tree, field))


def names() -> list[tuple[str, str, str]]:
    """The names of prints with their meanings and, where there are several, the sections of each; a
    name of the notation table is left out if it has one meaning.
    """
    rows = [row for row in meanings() if any(not one.endswith(PROSE) for one in row.sections)]
    count = Counter(row.name for row in rows)
    known = {_bare(latex) for _, latex, meaning in opened().notation.symbols if meaning}
    return [
        (
            with_macros(row.name.replace("...", r"\ldots")),
            prose(row.meaning),
            ", ".join(one for one in row.sections if not one.endswith(PROSE))
            if count[row.name] > 1
            else "",
        )
        for row in rows
        if count[row.name] > 1 or _bare(row.name) not in known
    ]


def _bare(latex: str) -> str:
    return re.sub(r"[{} ]|\\(?=max)", "", narrow(latex))


def key(name: str) -> str:
    """The name of a derivation in the characters of a label."""
    return re.sub(r"[^A-Za-z0-9]", "-", name)


def holds(sharp: str) -> str:
    """The words on the values of the parameter in a sharp range."""
    paper = opened()
    if sharp == "nowhere":
        return f"for no ${with_macros(glyph(paper.parameter))}$"
    if ": " not in sharp and "root" not in sharp:
        if sharp == paper.domain:
            return f"for all ${with_macros(latex_of(sharp))}$"
        return prose(for_which(sharp))
    return prose(re.sub(r"(?<=: )nowhere", f"for no {paper.parameter}", sharp))


def values(at: str) -> str:
    """A counterexample as LaTeX: its values, and the roots in them."""
    point, where, root = at.partition(" where ")
    shown = ", ".join(
        f"${with_macros(_value(one))}$" for one in point.split(", ") if " = " in one
    ) or prose(point)
    return shown + (f" where {prose(root)}" if where else "")


def _value(text: str) -> str:
    name, _, value = text.partition(" = ")
    try:
        return f"{latex_of(name)} = {latex_of(value)}"
    except (checker.Rejected, TypeError):
        return text


def settled(entry: Entry) -> str:
    """The evidence for the verdict (`results.settled_by`) as LaTeX."""
    return plain(entry.settled_by)


class ProofSteps:
    """The lines of the written proof: the statements of a claim, by label."""

    def __init__(self, entry: Entry) -> None:
        self.by_label = {one.name.partition("/")[2]: one for one in entry.statements}
        self.used: set[str] = set()

    def show(self, label: str, *parts: int) -> str:
        """The goal of a line, or some of its conjuncts, as LaTeX; raises ClaimError for a line that
        is not certified.
        """
        one = self.by_label[label]
        if one.outcome != "certified":
            raise ClaimError(f"{one.name} is {one.outcome}; the written proof cannot print it")
        self.used.add(label)
        conjuncts = one.text.rpartition("\nshow ")[2].split(" and ")
        return with_macros(
            _chained(
                [latex_of(conjuncts[part]) for part in parts]
                if parts
                else [latex_of(part) for part in conjuncts]
            )
        )

    def given(self, label: str, place: int) -> str:
        """The given of a line at this place, as LaTeX."""
        givens = [
            line.partition(" ")[2]
            for line in self.by_label[label].text.splitlines()
            if line.startswith("given ")
        ]
        return with_macros(latex_of(givens[place]))


def _chained(relations: Sequence[str]) -> str:
    r"""The relations in a row, where a < b and b < c become a < b < c.

    >>> _chained(["0 < x", r"x \le 1", "y = 2"])
    '0 < x \\le 1,\\quad y = 2'
    """
    shown = relations[0]
    for before, one in zip(relations, relations[1:]):
        end = re.split(r" (?:<|>|=|\\le|\\ge|\\ne) ", before)[-1]
        shown += one.removeprefix(end) if one.startswith(end + " ") else r",\quad " + one
    return shown


__all__ = [
    "ProofSteps",
    "change",
    "code",
    "corrected",
    "correction",
    "entries",
    "formula",
    "has_range",
    "heading",
    "headline",
    "holds",
    "in_errata",
    "inline",
    "key",
    "footnote",
    "number",
    "plain",
    "prose",
    "regenerated",
    "settled",
    "symbol",
    "values",
    "why",
]
