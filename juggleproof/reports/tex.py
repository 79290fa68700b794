"""The report in LaTeX: fragments and documents, single equations, and the PDF."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from types import FunctionType
from typing import TYPE_CHECKING

from juggleproof.judging.extras import needed
from juggleproof.papers.paper import opened
from juggleproof.papers.places import place_of
from juggleproof.reports import tex_words
from juggleproof.reports.contents import Contents, Entry
from juggleproof.reports.errata import FIRST, GROUPS
from juggleproof.reports.latex import with_macros
from juggleproof.reports.results import has_range
from juggleproof.statements.language import ClaimError

if TYPE_CHECKING:
    from jinja2 import Environment

    from juggleproof.papers.derivations import Derivation

# -------------------------------------------------------------------------------------------------
# The LaTeX report: fragments that an author can input, and documents with all of them, made from
# templates without formulas of the paper.

TEMPLATES = Path(__file__).parent / "templates"
BIBLIOGRAPHY = "paper.bib"


def files(contents: Contents, figures: Sequence[tuple[str, str, str]] = ()) -> dict[str, bytes]:
    """The files of the LaTeX report by name: macros, fragments, bibliography, and the documents for
    one and for two columns.

    `figures` are (slug, title, caption); a document shows those whose PDFs stand in the folder
    figures beside it. Raises ClaimError, one line, where a template's library is absent or a
    written line is not certified.
    """
    made, paper = _environment(), opened()
    notation = paper.notation
    fragments: dict[str, Mapping[str, object]] = {
        "notation": {
            "notation": [
                (notation.glyphs[name], tex_words.prose(meaning))
                for name, meaning in notation.listed.items()
            ],
            "names": tex_words.names(),
        },
        "errata": _errata(contents),
        "derivations": {"derivations": _behind_the_appendices(contents)},
        "juggleproof-macros": {"macros": [(name, means) for name, means, _ in notation.macros]},
    }
    of_theorem = paper.hook("theorem-tex", FunctionType)
    if of_theorem is not None:
        fragments["theorem"] = of_theorem(contents)
    texts = {name: _render(made, name, contents, values) for name, values in fragments.items()}
    appendices = {f"appendix-{letter.lower()}": letter for letter in paper.appendices}
    for name, letter in appendices.items():
        texts[name] = _render(
            made, "appendix", contents, _appendix(contents, letter, paper.appendices[letter])
        )
    if figures:
        captions = [
            (slug, tex_words.prose(title), tex_words.prose(text)) for slug, title, text in figures
        ]
        texts["figures"] = _render(made, "figures", contents, {"figures": captions})
    parts = ["appendices"] if appendices else []
    parts += ["theorem"] if of_theorem is not None else []
    cited = bool(paper.templates and paper.publication.key)
    values = {
        "title": _listed([f"the {one}" for one in [*parts, "errata"]]).capitalize(),
        "of_title": _listed([*parts, "errata"]),
        "cited": cited,
        "summary": summary(contents),
        "versions": tex_words.plain(
            ", ".join(f"{tool} {one}" for tool, one in contents.tools.items())
        ),
        "inputs": [
            *(name for name in ("notation", "theorem", "errata") if name in fragments),
            *appendices,
            "derivations",
        ],
        "first_figure": f"figures/{figures[0][0]}.pdf" if figures else "none",
    }
    for name, twocolumn in (("juggleproof", False), ("juggleproof-twocolumn", True)):
        texts[name] = _render(made, "document", contents, {**values, "twocolumn": twocolumn})
    written = {f"{name}.tex": text.encode() for name, text in texts.items()}
    if not cited or paper.templates is None:
        return written
    return {BIBLIOGRAPHY: (paper.templates / BIBLIOGRAPHY).read_bytes(), **written}


def _listed(names: Sequence[str]) -> str:
    return " and ".join(part for part in (", ".join(names[:-1]), names[-1]) if part)


def summary(contents: Contents) -> str:
    """The counts of verdicts and outcomes in a sentence."""
    verdicts = ", ".join(f"{count} {word}" for word, count in contents.verdicts.items())
    outcomes = ", ".join(f"{count} {word}" for word, count in sorted(contents.outcomes.items()))
    return (
        f"In all {len(contents.entries)} claims: {verdicts}; {sum(contents.outcomes.values())}"
        f" statements: {outcomes}."
    )


@cache
def _environment() -> Environment:
    jinja2 = needed("jinja2")
    made: Environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader([one for one in (opened().templates, TEMPLATES) if one]),
        block_start_string="<%",
        block_end_string="%>",
        variable_start_string="<<",
        variable_end_string=">>",
        comment_start_string="<#",
        comment_end_string="#>",
        undefined=jinja2.StrictUndefined,
        autoescape=False,
        trim_blocks=True,
        keep_trailing_newline=True,
    )
    made.globals.update(
        {name: getattr(tex_words, name) for name in tex_words.__all__ if name != "ProofSteps"},
        counterexamples=_counterexamples,
    )
    return made


def _render(made: Environment, name: str, contents: Contents, values: Mapping[str, object]) -> str:
    template = (
        "document" if name.startswith("juggleproof") and name != "juggleproof-macros" else name
    )
    text = made.get_template(f"{template}.tex.j2").render(
        paper=opened(), tools=contents.tools, with_steps=name == "appendix", **values
    )
    return (
        re.sub(r"\n{3,}", "\n\n", "\n".join(line.rstrip() for line in text.strip().splitlines()))
        + "\n"
    )


def _counterexamples(entry: Entry) -> list[str]:
    """The counterexamples as LaTeX, the strongest first, each once."""
    shown = (
        tex_words.values(one.at)
        + (f": {tex_words.prose(one.numbers)}." if one.numbers else ".")
        + (f" {tex_words.prose(one.words)}" if one.words else "")
        for one in entry.refuted
    )
    return list(dict.fromkeys(shown))


def _appendix(contents: Contents, letter: str, title: str) -> dict[str, object]:
    return {"letter": letter, "title": title, "sections": contents.appendix(letter)}


def _behind_the_appendices(contents: Contents) -> list[Derivation]:
    """The derivations that the entries of the appendices name, and all that these use."""
    by_name = {one.function: one for one in contents.derivations}
    needed = {
        one.function
        for entry in contents.entries
        if entry.claim.section[:1] in opened().appendices
        for one in entry.steps
    }
    for one in reversed(contents.derivations):  # each comes after those that it uses
        if one.function in needed:
            needed |= set(one.uses) & set(by_name)
    return [one for one in contents.derivations if one.function in needed]


def _errata(contents: Contents) -> dict[str, object]:
    groups = [
        (
            tex_words.plain(title.partition(":")[0]),
            [one for one in contents.entries if one.group == group],
        )
        for group, title in GROUPS.items()
    ]
    counted = "; ".join(
        f"{title[:1].lower()}{title[1:]}, {len(claims)}" for title, claims in groups if claims
    )
    return {
        "groups": [one for one in groups if one[1]],
        "counts": f"The errata by kind: {counted}.",
        "first_title": FIRST,
        "theorem_stands": contents.theorem_stands,
        "first_page": contents.first_page(),
    }


# -------------------------------------------------------------------------------------------------
# One equation of the paper as a LaTeX fragment.


def equation(entry: Entry) -> str:
    """A fragment with the labelled equation of one claim and the meanings of its symbols; the
    equation is the correction where the print is false, else the print.

    Raises ClaimError where the paper prints no formula for the claim, or where a symbol has no
    meaning.
    """
    if not entry.claim.printed:
        raise ClaimError(
            f"{entry.claim.id} has no printed formula; `juggleproof explain {entry.claim.id}` shows"
            " its statements"
        )
    number, body = tex_words.number(entry.claim), tex_words.regenerated(entry)
    mended = tex_words.correction(entry) if entry.correction else body
    read = body if body == mended else rf"{entry.claim.printed} \text{{;}} {mended}"
    rows = [with_macros(tex_words.without_stop(row)) for row in tex_words.lines(body)]
    shown = (
        rows[0]
        if len(rows) == 1
        else "\\begin{gathered}\n" + " \\\\\n".join(rows) + "\n\\end{gathered}"
    )
    tag = f"\\tag{{{number}}}" if number else ""
    head = [
        f"% {entry.claim.id}, {place_of(entry.claim)}: {entry.verdict_text}",
        *([f"% holds as printed: {entry.sharp}"] if has_range(entry.sharp) else []),
        *(
            [
                f"% {tex_words.footnote(entry).lower()};"
                f" printed was: {' '.join(entry.claim.printed.split())}"
            ]
            if entry.correction
            else []
        ),
        "% where",
        *(
            f"%   {symbol}: {meaning}"
            for symbol, meaning in tex_words.symbols(read, entry.claim.section)
        ),
    ]
    numbered = "equation" if not tag else "equation*"
    macros = [
        f"\\providecommand{{\\jug{name}}}{{{means}}}"
        for name, means, _ in opened().notation.macros
        if f"\\jug{name}" in shown
    ]
    return (
        "\n".join(
            [
                *head,
                *macros,
                f"\\begin{{{numbered}}}\\label{{jug:{entry.claim.id}}}{tag}",
                shown,
                f"\\end{{{numbered}}}",
            ]
        )
        + "\n"
    )


# -------------------------------------------------------------------------------------------------
# The PDF of the LaTeX report, by latexmk in a temporary folder, without dates and ids, so that
# equal sources make equal bytes.

TOO_WIDE = 5.0  # points by which a line may be too wide


def compiled(files: Mapping[str, bytes], document: str) -> tuple[bytes, list[str]]:
    """The PDF of a document among the files, and the complaints of the log: undefined references,
    lines that are too wide.

    Raises ClaimError, one line, where latexmk is absent or finds an error.
    """
    if not shutil.which("latexmk") or not shutil.which("pdflatex"):
        raise ClaimError(
            "latexmk and pdflatex are needed for the PDF; Debian's packages are latexmk,"
            " texlive-latex-recommended and lmodern"
        )
    with tempfile.TemporaryDirectory() as folder:
        for name, content in files.items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        done = subprocess.run(
            ["latexmk", "-pdf", "-interaction=nonstopmode", "-halt-on-error", f"{document}.tex"],
            cwd=folder,
            capture_output=True,
            check=False,
            env={
                **os.environ,
                "SOURCE_DATE_EPOCH": "0",
                "FORCE_SOURCE_DATE": "1",
                "max_print_line": "10000",
            },
        )
        log_file, made = Path(folder) / f"{document}.log", Path(folder) / f"{document}.pdf"
        log = log_file.read_text(encoding="latin-1") if log_file.exists() else ""
        if done.returncode or not made.exists():
            errors = (
                re.findall(r"^! .*", log, re.MULTILINE)
                or done.stderr.decode("utf-8", "replace").splitlines()[-1:]
            )
            raise ClaimError(
                f"{document}.tex: LaTeX stops: {' '.join(errors[:1]) or 'no reason is given'}; the"
                " .tex files are written"
            )
        return made.read_bytes(), complaints(log)


def complaints(log: str) -> list[str]:
    """The complaints of a log that a reader would see.

    >>> log = "LaTeX Warning: Reference `a' on page 1 undefined on input line 2.\\n"
    >>> log += "Overfull \\\\hbox (7.3pt too wide) in paragraph\\n"
    >>> print(*complaints(log), sep="\\n")
    LaTeX Warning: Reference `a' on page 1 undefined on input line 2.
    Overfull \\hbox (7.3pt too wide) in paragraph
    """
    found = re.findall(
        r"^LaTeX Warning: (?:Reference|Citation|Label).*|^.*multiply[- ]defined.*|^.*undefined"
        r" references.*",
        log,
        re.MULTILINE,
    )
    wide = re.findall(r"^Overfull \\[hv]box \(([\d.]+)pt too (?:wide|high)\).*", log, re.MULTILINE)
    lines = re.findall(r"^(Overfull \\[hv]box \([\d.]+pt too (?:wide|high)\).*)", log, re.MULTILINE)
    return [
        *dict.fromkeys(found),
        *(line for width, line in zip(wide, lines) if float(width) > TOO_WIDE),
    ]
