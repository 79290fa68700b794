"""LaTeX: every formula that reports set is read back by a reader that shares nothing with the
printer, and has the same values; fragments hold what they should, and compile in one and in two
columns without a fault.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

import pytest

from juggleproof.certificates import checker
from juggleproof.command import formats
from juggleproof.command.main import run
from juggleproof.judging.claims import Claim
from juggleproof.judging.judgement import Judgement
from juggleproof.judging.run import judge_some
from juggleproof.papers.ledger import load_ledger
from juggleproof.reading.meaning import read
from juggleproof.reports import contents as contents_module
from juggleproof.reports import tex_words
from juggleproof.reports.errata import WRONG
from juggleproof.reports.latex import latex_of, narrow, with_macros, without_macros
from juggleproof.reports.tex import compiled, complaints, equation, files
from juggleproof.reports.words import formulas_of
from juggleproof.statements.language import ClaimError
from tests.reports.read_back import NotRead, difference, differences, python_of
from tests.reports.runs import contents, made_of
from tests.rows import each_row
from tests.share import share

# -------------------------------------------------------------------------------------------------
# Formulas.


def texts() -> list[str]:
    found = [one.text for entry in contents().entries for one in entry.statements]
    return found + [premise.text for rule in contents().rules for premise in rule.premises]


@cache
def pairs() -> dict[tuple[str, str], None]:
    """The formulas of all statements, each with its LaTeX."""
    return dict.fromkeys(pair for text in texts() for pair in formulas_of(text))


def test_every_formula_of_every_statement_reads_back_holds() -> None:
    assert len(pairs()) > 800
    assert differences([*pairs()][:: share(4, 1)]) == []


@each_row(
    ("text", "latex"),
    [
        ("not x < w", r"x \ge w"),
        ("not (x < w and w != 2)", r"x \ge w \lor w = 2"),
        ("0 <= x and x < w", r"0 \le x < w"),
        ("x = w", r"x = w^{1}\cdot 1 + 0"),
        ("beta0*r^2 != v_next", r"\bar\beta_0\dot\rho_0^2 \ne \dot{\bar\beta}_{\mathrm{next}}"),
        ("not iff(x < w, w < u)", r"\lnot (x < w \iff w < u)"),
        ("not implies(x < w, w < u)", r"x < w \land w \ge u"),
        ("-x^2/(2*w)", r"-\frac{x^2}{2w}"),
    ],
)
def test_what_means_the_same_agrees_holds(text: str, latex: str) -> None:
    assert difference(text, latex) == ""


@each_row(
    ("text", "latex"),
    [
        ("x <= w", "x < w"),
        ("x < w", "w > x"),
        ("x = w", "x = 2w"),
        ("x < w and w < u", r"x < w \lor w < u"),
        ("x < w or w < u", r"w < u \lor x < w"),
        ("implies(x < w, w < u)", r"x < w \iff w < u"),
        ("not iff(x < w, w < u)", r"x < w \iff w < u"),
        ("x < w", "x"),
        ("x", "u"),
        ("x^2", "x^3"),
        ("x - (w - u)", "x - w - u"),
        ("(-x)^2", "-x^2"),
        ("beta", r"\dot{\bar\beta}"),
        ("v0", r"\dot{\bar\beta}"),
        ("x/(w - w)", r"\frac{x}{w - w}"),
    ],
)
def test_what_means_another_thing_differs_holds(text: str, latex: str) -> None:
    assert difference(text, latex)


@each_row(
    "latex",
    ["x 2", "2 3", r"\frac{x}{w}^2", "x + ^2", "(x", "x)", r"\left(x)", r"\hat x", "E(", "0.5",
     r"x < w \implies w < u \implies u < x"],
)  # fmt: skip
def test_rejects_what_has_no_meaning_or_two(latex: str) -> None:
    with pytest.raises(NotRead):
        python_of(latex)


@pytest.mark.exhaust
def test_every_derivation_reads_back_holds() -> None:
    entries = dict.fromkeys(
        entry for one in contents().derivations for row in one.shown() for entry in row
    )
    assert len(entries) > 50
    assert differences((entry, latex_of(entry)) for entry in entries) == []


def test_every_correction_reads_back_holds() -> None:
    prints = [
        entry.correction["text"]
        for entry in contents().entries
        if entry.correction and entry.correction["kind"] != "nearby"
    ]
    assert prints and all(read(text).names for text in prints)


def test_every_change_is_told_in_the_words_of_mathematics_holds() -> None:
    changes = [tex_words.change(one) for one in contents().entries if one.correction]
    assert r"dot restored on $\beta$" in changes and r"$>$ replaced by $\ge$" in changes
    assert not [one for one in changes if re.search(r"\b(put|turned|column|marks)\b", one)]


@pytest.mark.parametrize(
    ("sentence", "set_as"),
    [
        ("E(t) and the time t_R", r"$E(t)$ and the time $t_{\jugR}$"),
        ("where B_2 < mu |B_3|:", r"where $B_2 < \mu|B_3|$:"),
        ("1 - (1 - alpha) w^2 / 2", r"$1 - (1 - \jugrestitution)w^2/2$"),
        ("as (w - (a b x)) is", r"as ($w$ - (a $\jugstate$ $x$)) is"),
    ],
)
def test_a_sentence_is_set_holds(sentence: str, set_as: str) -> None:
    assert tex_words.prose(sentence) == set_as


def test_every_formula_is_read_with_its_macros_holds() -> None:
    changed = [latex for _, latex in pairs() if "\\jug" in with_macros(latex)]
    assert len(changed) > 500
    for latex in changed:
        assert python_of(latex) == python_of(without_macros(with_macros(latex)))


@pytest.mark.parametrize("text", ["f(x)", "x, y", "x if y else z", "x and", "1.5*x"])
def test_rejects_what_is_no_term(text: str) -> None:
    with pytest.raises((TypeError, KeyError, checker.Rejected)):
        latex_of(text)


def plain(latex: str) -> str:
    """A print without the marks that do not change how it is read: spaces, and braces around one
    sign.
    """
    return "".join(
        narrow(latex).replace(r"\mathcal{", r"\mathcal ").replace("{", "").replace("}", "").split()
    )


def test_macros_stand_for_what_was_printed_holds() -> None:
    prints = [entry.claim.printed for entry in contents().entries if entry.claim.printed]
    assert len(prints) > 100
    for latex in prints:
        assert plain(without_macros(with_macros(latex))) == plain(latex), latex


# -------------------------------------------------------------------------------------------------
# The report.

latex = pytest.mark.skipif(
    not (shutil.which("latexmk") and shutil.which("pdflatex")),
    reason="latexmk or pdflatex is absent",
)


@cache
def made() -> dict[str, str]:
    return {name: content.decode() for name, content in files(contents()).items()}


def test_every_claim_of_the_appendices_stands_in_them_once_holds() -> None:
    for letter in "AB":
        text = made()[f"appendix-{letter.lower()}.tex"]
        wanted = [
            entry.claim.id for entry in contents().entries if entry.claim.section.startswith(letter)
        ]
        found = re.findall(r"\\jugclaim\{[^{}]*\}\{([^{}]*)\}", text)
        assert len(wanted) > 20 and sorted(found) == sorted(wanted)


def test_every_erratum_stands_with_its_verdict_and_its_counterexample_holds() -> None:
    text = made()["errata.tex"]
    blocks = {
        re.findall(r"\]\{[^{}]*\}\{([^{}]*)\}", block)[0]: block
        for block in re.split(r"(?=\\jugclaim\[errata:)", text)[1:]
    }
    listed = [entry for entry in contents().entries if entry.group]
    assert len(listed) > 50 and set(blocks) == {entry.claim.id for entry in listed}
    for entry in listed:
        block = blocks[entry.claim.id]
        assert f"{{{entry.verdict}}}" in block
        assert (entry.group in WRONG) == (r"\jugnote{Fails}{at " in block)
        for one in entry.statements:
            assert not one.at or one.words and tex_words.prose(one.words) in block
        assert (entry.group == "restored") == (r"\jugnote{Transcribed}" in block)
        assert bool(entry.claim.remark) == (r"\jugnote{Remark}" in block)


def test_errata_begin_with_what_bears_on_the_theorem_holds() -> None:
    page = made()["errata.tex"].partition(r"\jugclaim[errata:]")[0]
    assert re.findall(r"\{first:([^{}]*)\}", page) == [
        entry.claim.id for entry, _ in contents().first_page()
    ]
    assert page.count(r"\jugnote{True}") == len(contents().first_page()) == 4


def test_labels_are_unique_and_every_reference_has_one_holds() -> None:
    text = "".join(made().values())
    labels = [
        prefix + name
        for prefix, name in re.findall(r"\\jugclaim(?:\[([^]]*)\])?\{[^{}]*\}\{([^{}]*)\}", text)
    ]
    labels += re.findall(r"\\jugitem\{D\d+\}\{([^{}]*)\}", text)
    labels += re.findall(r"\\jugsection\{\w+\}\{([^{}]*)\}", text)
    assert len(labels) > 150 and len(set(labels)) == len(labels)
    references = set(re.findall(r"\\(?:page)?ref\{jug:([^{}#]*)\}", text))
    assert len(references) > 80 and references <= set(labels)


def blocks_of(name: str) -> dict[str, str]:
    """The claims of a file of the report: what stands of each, by its name."""
    return {
        re.findall(r"^\{[^{}]*\}\{([^{}]*)\}", block)[0]: block
        for block in re.split(r"\\jugclaim(?:\[errata:\])?(?=\{)", made()[name])[1:]
    }


def test_every_equation_of_the_appendices_stands_in_its_place_as_it_is_true_holds() -> None:
    appendices = {**blocks_of("appendix-a.tex"), **blocks_of("appendix-b.tex")}
    wrong = 0
    for entry in contents().entries:
        if entry.claim.section[0] not in "AB" or not entry.claim.printed:
            continue
        block = appendices[entry.claim.id]
        wrong_print, number = tex_words.in_errata(entry), tex_words.number(entry.claim)
        shown = tex_words.regenerated(entry) if wrong_print else entry.claim.printed
        beside = f"[{number}]" if number else ""
        assert (
            rf"\jugdisplay{beside}{tex_words.formula(shown)}" in block
            and block.count(r"\jugdisplay") == 1
        )
        mended = re.findall(r"\\jugmended\{([^{}]*)\}", block)
        assert mended == ([tex_words.footnote(entry)] if wrong_print else [])
        if mended:
            assert rf"{{{tex_words.inline(entry.claim.printed)}}}{{{entry.claim.id}}}" in block
            wrong += 1
    assert wrong > 15


def test_every_display_of_the_appendices_is_that_of_a_claim_holds() -> None:
    """The paper's displays, as the ledger counts them, against those of the report."""
    text = made()["appendix-a.tex"] + made()["appendix-b.tex"]
    displayed = {
        name
        for part in ("appendix-a.tex", "appendix-b.tex")
        for name, block in blocks_of(part).items()
        if r"\jugdisplay" in block
    }
    rows = [row for row in load_ledger() if row.kind == "display" and row.section[0] in "AB"]
    assert len(rows) > 35
    assert not [row.key for row in rows if not displayed & set(row.claims)]
    assert text.count(r"\jugdisplay") >= len(rows)


def test_what_is_true_instead_stands_whole_holds() -> None:
    by_name = {entry.claim.id: entry for entry in contents().entries}
    assert tex_words.regenerated(by_name["sB.2-B1"]) == (
        r"\mathcal{B}_1 := \{ \overline{b} \in \mathcal{H} \mid"
        r" \tau_c < T \text{ and } \dot{\overline\beta} < \dot\rho_0 \}"
    )
    of_38 = tex_words.regenerated(by_name["eq-38"])
    assert "(38)" not in of_38 and of_38.endswith(r"\text{ or } \overline{\beta} = 0")


def test_errata_show_each_wrong_print_beside_what_is_true_holds() -> None:
    shown = {
        name
        for name, block in blocks_of("errata.tex").items()
        if r"\jugdisplay" in block or r"\jugsides" in block
    }
    wanted = {
        one.claim.id
        for one in contents().entries
        if one.claim.printed and one.group and tex_words.in_errata(one)
    }
    assert len(wanted) > 20 and shown == wanted
    for one in contents().derivations:
        label = f"{{derived:{tex_words.key(one.function)}}}"
        assert made()["derivations.tex"].count(label) <= 1
    assert r"\jugdisplay" not in made()["notation.tex"]


def test_every_line_of_the_written_proof_is_certified_and_printed_holds() -> None:
    entry = contents().entry("theorem-by-hand")
    assert len(entry.statements) == 25 and all(
        one.outcome == "certified" for one in entry.statements
    )
    text, steps = made()["theorem.tex"], tex_words.ProofSteps(entry)
    left = [
        label
        for label in steps.by_label
        if label != "fixed" and steps.show(label) not in text and steps.show(label, 0) not in text
    ]
    assert left == []


def test_rejects_a_line_that_is_not_certified() -> None:
    from dataclasses import replace

    entry = contents().entry("theorem-by-hand")
    broken = replace(
        entry, statements=tuple(replace(one, outcome="unknown") for one in entry.statements)
    )
    with pytest.raises(ClaimError, match="theorem-by-hand/units is unknown"):
        tex_words.ProofSteps(broken).show("units")


def test_templates_hold_no_formula_of_the_paper_holds() -> None:
    """Between their slots the templates name things, and count from 0 or 1; every other number or
    relation comes from a statement.
    """
    folder = Path(str(tex_words.__file__)).parent / "templates"
    paths = sorted(folder.glob("*.j2"))
    assert len(paths) > 5
    for path in paths:
        bare = re.sub(r"<<.*?>>|<%.*?%>", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
        for formula in re.findall(r"\$([^$]*)\$", bare) if "macros" not in path.name else []:
            squares_aside = re.sub(r"(?:u|\\juglaunch)\^2", "", formula)
            assert not re.search(
                r"[2-9]|\\frac|\\beta|\\gamma|\\alpha|w <|x <|\\jugrestitution.*<", squares_aside
            ), (path.name, formula)


def test_an_equation_stands_corrected_where_the_print_is_false_holds() -> None:
    text = equation(contents().entry("sB.3-f1"))
    assert (
        r":= -\jugrestitution A_T" in text
        and r"\label{jug:sB.3-f1}" in text
        and "% corrected; printed was:" in text
    )
    assert r"\tag{37}" in equation(contents().entry("eq-37"))


def test_the_column_of_gravity_is_not_set_by_the_macro_of_the_restitution_holds() -> None:
    assert with_macros(r"A_T - \alpha_T + \alpha r_0") == r"A_T - \alpha_T + \jugrestitution r_0"
    text = equation(contents().entry("sB.3-aT"))
    assert r"\alpha_T" in text and r"\jugrestitution" not in text


def test_an_equation_of_a_set_names_what_it_is_of_holds() -> None:
    text = equation(contents().entry("sA.3-sup"))
    assert r"\sup" in text and r"\Delta E_{" in text


def test_an_export_judges_only_what_is_asked_for_holds(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    judged = list[str]()

    def recorded(
        chosen: Sequence[Claim], claims: Mapping[str, Claim], folder: Path
    ) -> list[Judgement]:
        judged.extend(one.id for one in chosen)
        return judge_some(chosen, claims, folder)

    monkeypatch.setattr(contents_module, "judge_some", recorded)
    assert run(["export", "latex", "sB.3-f1", "37"]) == 0 and judged == ["sB.3-f1", "eq-37"]
    wanted = [equation(contents().entry(name)) for name in judged]
    assert capsys.readouterr().out == "".join(f"{one}\n" for one in wanted)


def test_rejects_an_equation_that_the_paper_does_not_print(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["export", "latex", "theorem"]) == 2
    assert "theorem has no printed formula" in capsys.readouterr().err
    assert run(["export", "latex", "no-such"]) == 2


@pytest.mark.exhaust
@latex
@pytest.mark.parametrize("document", ["juggleproof", "juggleproof-twocolumn"])
def test_documents_compile_without_a_fault_holds(document: str) -> None:
    pdf, faults = compiled(files(contents()), document)
    assert pdf.startswith(b"%PDF") and faults == []


@pytest.mark.exhaust
@latex
def test_the_fragments_need_only_amsmath_holds() -> None:
    given = {
        name: content for name, content in files(contents()).items() if "juggleproof." not in name
    }
    names = ["juggleproof-macros", "notation", "theorem", "errata", "appendix-a", "appendix-b"]
    body = "".join(f"\\input{{{name}}}\n" for name in [*names, "derivations"])
    source = (
        rf"\documentclass{{article}}\usepackage{{amsmath}}\begin{{document}}{body}\end{{document}}"
    )
    pdf, faults = compiled({**given, "own.tex": source.encode()}, "own")
    assert pdf.startswith(b"%PDF") and not [one for one in faults if "Warning" in one]


def equations() -> dict[str, str]:
    return {one.claim.id: equation(one) for one in contents().entries if one.claim.printed}


@pytest.mark.exhaust
@latex
def test_every_equation_compiles_alone_holds() -> None:
    """Each in a group, which ends what it defines."""
    every = equations().values()
    assert len(every) > 100
    body = (
        "\\documentclass{article}\\usepackage{amsmath,amssymb}\\begin{document}\n"
        + "\n".join(f"\\begingroup\n{one}\\endgroup" for one in every)
        + "\\end{document}\n"
    )
    pdf, faults = compiled({"all.tex": body.encode()}, "all")
    assert pdf.startswith(b"%PDF") and not [one for one in faults if "Warning" in one]


# Commands of equations that are no symbols of the paper.
STRUCTURE = set(
    r"\frac \sqrt \left \right \middle \in \notin \subset \subseteq \cap \cup \circ \cdot \equiv"
    r" \le \ge \mid \quad \qquad \to \lim \max \sup \forall \partial".split()
)
ACCENTED = re.compile(r"((?:\\(?:dot|bar|mathcal)[ {]*)*)(\\[A-Za-z]+|[A-Za-z])")


def signs(latex: str) -> set[str]:
    """The letters of a formula, each after its accents in the order of the alphabet."""
    spelled = latex.replace(r"\overline", r"\bar").replace(r"\ddot", r"\dot\dot")
    found = ACCENTED.findall(spelled)
    accented = ("".join(sorted(re.findall(r"\\[a-z]+", over))) + one for over, one in found)
    return {one for one in accented if one not in STRUCTURE}


def unlisted(fragment: str) -> set[str]:
    """The signs of an exported equation that its comments do not list."""
    listed = re.findall(r"^%   (.+?): \w", fragment, re.MULTILINE)
    means = dict(re.findall(r"\\providecommand\{(\\jug\w+)\}\{(.*)\}\n", fragment))
    body = "\n".join(one for one in fragment.splitlines() if one[0] != "%" and "provide" not in one)
    body = re.sub(r"\\(?:text|tag|label|begin|end)\{[^{}]*\}(?:\{l+\})?", " ", body)
    for macro in sorted(means, key=len, reverse=True):
        body = body.replace(macro, means[macro])
    return signs(body) - set[str]().union(*map(signs, listed))


def test_every_symbol_of_an_equation_has_its_meaning_beside_it_holds() -> None:
    assert {name: unlisted(text) for name, text in equations().items() if unlisted(text)} == {}


def test_rejects_an_equation_with_a_symbol_that_is_not_listed() -> None:
    text = equation(contents().entry("eq-37"))
    (row,) = re.findall(r"^%   \\alpha: .*\n", text, re.MULTILINE)
    assert unlisted(text.replace(row, "")) == {r"\alpha"}
    assert unlisted(text.replace(r"\jugrestitution^", "s^") + "s") == {"s"}
    with pytest.raises(ClaimError, match=r"no meaning of q; add one for section A\.2"):
        tex_words.symbols("q = 1", "A.2")


@latex
def test_rejects_a_document_that_latex_cannot_read() -> None:
    with pytest.raises(ClaimError, match="Undefined control sequence"):
        compiled(
            {"bad.tex": rb"\documentclass{article}\begin{document}\nosuchcommand\end{document}"},
            "bad",
        )


@latex
def test_rejects_what_a_reader_would_see() -> None:
    source = (
        rb"\documentclass{article}\begin{document}\ref{nowhere}"
        rb" \noindent\hbox{\rule{500pt}{1pt}}\end{document}"
    )
    found = compiled({"wide.tex": source}, "wide")[1]
    assert any("nowhere" in one for one in found) and any("too wide" in one for one in found)


def test_rejects_only_lines_that_stick_out_far() -> None:
    assert complaints("Overfull \\hbox (4.9pt too wide) in paragraph\n") == []
    assert len(complaints("Overfull \\hbox (5.1pt too wide) in paragraph\n")) == 1


def test_the_sources_are_written_where_latexmk_is_absent_holds(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    made_of(monkeypatch, contents)
    monkeypatch.setattr(formats, "saved", lambda contents, form: ())
    monkeypatch.setattr(shutil, "which", lambda name: None)
    assert run(["report", "--format", "pdf", "-o", str(tmp_path / "out")]) == 2
    assert (
        "latexmk and pdflatex are needed" in capsys.readouterr().err
        and (tmp_path / "out" / "juggleproof.tex").exists()
    )
