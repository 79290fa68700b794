"""The generated Markdown: two lines of README.md, the table of docs/results.md, the entries of
docs/errata.md and the tables of docs/remarks.md, each between two comments of its file.

All of it is made from the register, the store and the ledger, and depends on nothing else.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from juggleproof.judging.checked import outcomes_of
from juggleproof.judging.claims import VERDICTS, CheckedApart, Claim
from juggleproof.judging.conclusions import REFUTED
from juggleproof.judging.judgement import Finding
from juggleproof.judging.register import Register, load_register
from juggleproof.judging.run import findings_in
from juggleproof.papers.paper import opened
from juggleproof.papers.places import place_of
from juggleproof.papers.remarks import remarks
from juggleproof.reports import errata
from juggleproof.reports import tex_words as words
from juggleproof.reports.results import columns, counted, no_range
from juggleproof.reports.tree import name_of_theorem, theorem_line
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import DEFAULT, Store, write_file

ROOT = Path(__file__).resolve().parents[2]
END = "<!-- end of what is generated -->"


def summary() -> str:
    """The number of claims by verdict, the number of statements by outcome, and the number of
    claims that the paper does not print, in two lines.
    """
    register, store = load_register(), Store(DEFAULT)
    verdicts = Counter(entry["verdict"] for entry in register.values())
    outcomes = Counter(word for own in _outcomes(store).values() for word in own.values())
    return (
        f"{len(register)} claims: "
        + ", ".join(f"{verdicts[word]} {word}" for word in VERDICTS)
        + f".\n{outcomes.total()} statements: {outcomes['certified']} certified,"
        f" {outcomes[REFUTED]} {REFUTED}, {outcomes['unknown']} open."
        f" The paper does not print {len(register.keys() & opened().unprinted)} of the claims."
    )


def results() -> str:
    """The summary, then a row for each claim: claim, place, verdict, settled by, sharp range."""
    register, store, findings = load_register(), Store(DEFAULT), findings_in(DEFAULT)
    outcomes = _outcomes(store)
    lines = [
        *summary().splitlines(),
        "",
        f"| {' | '.join(columns())} |",
        "| --- | --- | --- | --- | --- |",
    ]
    for claim in opened().claims():
        entry = register.get(claim.id)
        if entry is None:
            continue
        body = claim.body()
        others = [f"rule {name}" for name in getattr(body, "rests_on", ())]
        others += [body.checker] if isinstance(body, CheckedApart) else []
        settled = ", ".join([*counted(outcomes.get(claim.id, {})), *others]) or "no statement"
        verdict = entry["verdict"]
        if errata.group_of(claim, register, findings):
            verdict = f"[{verdict}](errata.md#{claim.id})"
        detail = f" (`{entry['detail']}`)" if "detail" in entry else ""
        sharp = f"`{entry['sharp']}`" if "sharp" in entry else no_range()
        lines.append(
            f'| <a id="{claim.id}"></a>{claim.id}'
            f" | {place_of(claim).removeprefix('section ')}"
            f" | {verdict}{detail} | {settled} | {sharp} |"
        )
    return "\n".join(lines)


def printed_wrongly() -> str:
    """Every claim that is not simply true, in the groups of `juggleproof errata`, with prints and
    corrections as LaTeX."""
    register, store, findings = load_register(), Store(DEFAULT), findings_in(DEFAULT)
    claims = opened().claims()
    groups = {one.id: errata.group_of(one, register, findings) for one in claims}
    lines = _first_page(claims, register, groups, findings, store)
    for group, title in errata.GROUPS.items():
        members = [one for one in claims if groups[one.id] == group]
        lines += [f"## {title} ({len(members)})", ""]
        for claim in members:
            lines += _entry(claim, register, findings.get(claim.id, {}), store)
    return "\n".join(lines).rstrip("\n")


def _first_page(
    claims: Sequence[Claim],
    register: Register,
    groups: Mapping[str, str],
    findings: Mapping[str, Finding],
    store: Store,
) -> list[str]:
    if opened().theorem is None:
        return []
    theorem = theorem_line(store, outcomes_of(DEFAULT, name_of_theorem()))
    lines = [f"## {errata.FIRST}", "", errata.theorem_stands(claims, theorem), ""]
    for claim in errata.what_matters(claims, groups):
        settled = errata.stored(claim, store)
        three = errata.three_lines_of(claim, register, findings.get(claim.id, {}), settled)
        lines += [f"**[{claim.id}](#{claim.id})**, {place_of(claim)}", ""]
        for one in three:
            formula = f" ${one.latex}$" if one.latex else ""
            lines.append(f"- *{one.title}:*{formula} {_prose(one.words)}".rstrip())
        lines.append("")
    return lines


def _entry(
    claim: Claim,
    register: Register,
    finding: Finding,
    store: Store,
) -> list[str]:
    heading, *rows = errata.rows_of(claim, register, finding, errata.stored(claim, store))
    name, rest = claim.id, heading.text.removeprefix(claim.id)
    lines = [f'<a id="{name}"></a>**[{name}](results.md#{name})**{rest}', ""]
    for row in rows:
        title, parts = row.title or "change", row.text.splitlines()
        if row.latex:
            lines += [f"*{title}:*", "", *_display(row.text)]
        elif row.code:
            lines += [f"*{title}:* " + "; ".join(map(_code, parts)), ""]
        elif len(parts) > 1:
            lines += [f"*{title}:*", "", *(f"- {_prose(part)}" for part in parts), ""]
        else:
            lines += [f"*{title}:* {_prose(row.text)}", ""]
    return lines


def _prose(text: str) -> str:
    return re.sub(r"([*\\])", r"\\\1", text)


def _display(latex: str) -> list[str]:
    """A display for each line of a formula."""
    return [row for line in words.lines(latex) for row in ("```math", line, "```", "")]


def _code(text: str) -> str:
    title, colon, goal = text.partition("false there: ")
    return f"{colon}`{goal}`" if colon and not title else f"`{text}`"


def _outcomes(store: Store) -> dict[str, dict[str, str]]:
    """The outcomes that the stored certificates of each claim state, by claim and statement."""
    outcomes: dict[str, dict[str, str]] = {}
    for name, text in store.texts.items():
        certificate = store.certificate(name, text) or {}
        words = (word for word in ("certified", "refuted") if word in certificate)
        outcomes.setdefault(name.split("/")[0], {})[name] = next(words, "unknown")
    return outcomes


PAGES: Mapping[str, Callable[[], str]] = {
    "README.md": summary,
    "docs/results.md": results,
    "docs/errata.md": printed_wrongly,
    "docs/remarks.md": remarks,
}


def begin_line(page: str) -> str:
    """The line above the generated part of a page."""
    return f"<!-- {PAGES[page].__name__}: generated by juggleproof certify --accept -->"


def regenerated(page: str) -> str:
    """The text of a page with its generated part replaced; raises ClaimError, one line, where its
    two comments are missing.
    """
    path, begin = ROOT / page, begin_line(page)
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    if begin not in text or END not in text:
        raise ClaimError(f"{page}: the marks {begin} and {END} are missing; put them back")
    head, rest = text.split(begin, 1)
    return f"{head}{begin}\n{PAGES[page]()}\n{END}{rest.split(END, 1)[1]}"


def update() -> None:
    """Writes the generated part of every page of the paper."""
    for page in opened().pages:
        write_file(ROOT / page, regenerated(page).encode())
