"""One equation of the paper as LaTeX of its own."""

from __future__ import annotations

from certificates.terms import ClaimError
from proofs.reports.contents import Entry
from proofs.reports.notation import MACROS, with_macros
from proofs.reports.tex import words


def equation(entry: Entry) -> str:
    """One claim's equation with its label, as a fragment of its own: the correction where the print
    is false, else the print.

    Raises ClaimError where the paper prints no formula for the claim.
    """
    if not entry.claim.printed:
        raise ClaimError(
            f"{entry.claim.id} has no printed formula; `juggleproof explain {entry.claim.id}` shows"
            " its statements"
        )
    body = words.correction(entry) if entry.correction else entry.claim.printed
    rows = [with_macros(words.without_stop(row)) for row in words.lines(body)]
    shown = (
        rows[0]
        if len(rows) == 1
        else "\\begin{gathered}\n" + " \\\\\n".join(rows) + "\n\\end{gathered}"
    )
    tag = f"\\tag{{{words.number(entry.claim)}}}" if words.number(entry.claim) else ""
    head = [
        (
            f"% {entry.claim.id}, {entry.claim.section} {entry.claim.place}: {entry.verdict_text};"
            f" as printed it holds {words_of(entry)}"
        ),
        *(
            [f"% corrected; printed was: {' '.join(entry.claim.printed.split())}"]
            if entry.correction
            else []
        ),
    ]
    numbered = "equation" if not tag else "equation*"
    macros = [
        f"\\providecommand{{\\jug{name}}}{{{means}}}"
        for name, means, _ in MACROS
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


def words_of(entry: Entry) -> str:
    """The sharp range in plain words."""
    return "for all the parameters that it names" if entry.sharp == "no alpha" else entry.sharp
