"""Certify."""

from __future__ import annotations

import argparse
import json
import os
import textwrap
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from dataclasses import dataclass, replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from juggleproof.certificates import checker
from juggleproof.certificates.definitions import Definition
from juggleproof.certificates.language import ClaimError
from juggleproof.certificates.store import (
    DEFAULT,
    Store,
    canonical,
    statement_file,
    write_file,
    write_store,
)
from juggleproof.proofs.claims import Claim
from juggleproof.proofs.command import outputs
from juggleproof.proofs.judging import DEFAULT_BUDGET, Judgement, Options
from juggleproof.proofs.paper.definitions import definitions
from juggleproof.proofs.register import PATH, load_register, registered, write_register
from juggleproof.proofs.reports import results as table
from juggleproof.proofs.reports.results import Results, results_of_run
from juggleproof.proofs.rules import settle_by_rules, theorem_line
from juggleproof.proofs.run import (
    Reading,
    Records,
    claims_of_file,
    judge_all,
    judge_with_records,
    keep_results,
    lemmas,
    paper_claims,
    start,
    stop,
)
from juggleproof.proofs.smtlib.answering import BUDGET, Answered, answer_files, in_script

# -------------------------------------------------------------------------------------------------
# `juggleproof certify`: judge every claim, store what was found, let the checker read the whole
# store, compare with the register.

FINDINGS = "findings"
PAPER = "juggleproof.proofs.paper."  # of the modules of its claims
WIDTH = 96  # of a comment in the statement file
TITLE = (
    "Every statement that the claims come to; certificates/checker reads this file and believes"
    " nothing else."
)


@dataclass(frozen=True)
class Run:
    """What a run came to: the claims and the judgements on them, the seconds they took, the
    theorem's lines, and what the checker rejects.
    """

    claims: Sequence[Claim]
    judgements: Sequence[Judgement]
    seconds: Mapping[str, float]
    theorem: str
    rejected: Sequence[tuple[str, str]]


def certify(options: argparse.Namespace, register: Path = PATH) -> int:
    """Runs the main job; returns 0 where all verdicts are as registered (for a user's file: where
    every claim holds), else 1.
    """
    from rich.console import Console

    outputs.refuse_unwritable(options)
    before = None if options.files else load_register(register)
    console = Console(highlight=False)
    done = run(options, console)
    table.draw(done.claims, done.judgements, console)
    print(table.summary(done.judgements))
    print(done.theorem, end="\n" if done.theorem else "")
    for name, reason in done.rejected:
        print(f"rejected by the checker: {name}: {reason}")
    accepts = options.accept and not done.rejected
    results = results_of_run(
        done.claims,
        done.judgements,
        before,
        theorem=done.theorem,
        rejected=done.rejected,
        partial=bool(options.only),
        accepted=accepts,
    )
    for change in results.changes:
        print(f"{'accepted ' if accepts else 'differs from the register '} {change}")
    if before is not None and accepts:
        _accept(results, before, options, register)
    outputs.write(options, results, done.seconds)
    return results.exit


def run(
    options: argparse.Namespace,
    console: Any = None,
    executor: Executor | None = None,
    given: Sequence[Claim] = (),
) -> Run:
    """Judges the claims, stores what was found, and has the checker read all that is stored.

    An executor judges in place of processes of our own; `given` are claims in hand, which need
    `options.store`.
    """
    routes = _routes(options.routes)
    own = bool(options.files or given)
    folder = options.store or (options.files[0].with_suffix(".certificates") if own else DEFAULT)
    store = Store(folder)
    jobs = options.jobs if options.jobs > 0 else os.cpu_count() or 1
    budget = options.budget or DEFAULT_BUDGET
    with Reading(folder, jobs, nothing=options.fresh) as reading:
        records = Records(None if own or options.fresh else budget, read=not options.accept)
        everything = (
            records.claims
            or list(given)
            or (
                [claim for path in options.files for claim in claims_of_file(path)]
                if own
                else paper_claims()
            )
        )
        refuse_duplicates(everything)
        claims = _selected(everything, options.only)
        judged = Options(
            routes,
            budget,
            Store(Path(os.devnull)) if options.fresh else store,
            {} if options.fresh else _findings(folder),
            {} if records.claims else lemmas(everything, claims),
        )
        judged = replace(judged, checked=reading.outcomes())
    judgements, seconds = judge_with_records(
        claims,
        judged,
        records,
        lambda rest, judged: _with_progress(rest, judged, jobs, console, executor),
    )
    records.keep(judgements, len(everything))
    changed = _write(folder, store, everything, claims, judgements)
    results = (
        reading.results if reading.results and not changed else checker.check_folder(str(folder))
    )
    if records.key:
        keep_results(folder, results)
    outcomes = {name: outcome for name, outcome, _ in results}
    settle_by_rules(judgements, outcomes, Store(folder).texts)
    line = (
        ""
        if own
        else theorem_line(
            Store(folder),
            outcomes,
            {name: cast for one in judgements for name, cast in one.votes.items()},
        )
    )
    return Run(
        claims,
        judgements,
        seconds,
        line,
        [(name, reason) for name, outcome, reason in results if outcome == "rejected"],
    )


def _routes(text: str) -> tuple[str, ...]:
    from juggleproof.proofs.command.main import ROUTES

    chosen = tuple(text.split(","))
    unknown = [route for route in chosen if route not in ROUTES]
    if unknown or "exact" not in chosen:
        raise ClaimError(
            f"--routes {text}: choose from {', '.join(ROUTES)}; exact is always among them, since"
            " only a certificate certifies"
        )
    return chosen


def refuse_duplicates(claims: Sequence[Claim]) -> None:
    """Raises ClaimError where two claims have one name."""
    seen: set[str] = set()
    for claim in claims:
        if claim.id in seen:
            raise ClaimError(f"{claim.id} is the name of two claims; rename one")
        seen.add(claim.id)


def _selected(claims: list[Claim], only: list[str] | None) -> list[Claim]:
    if not only:
        return claims
    missing = set(only) - {claim.id for claim in claims}
    if missing:
        raise ClaimError(
            f"--only {sorted(missing)[0]}: no such claim; `juggleproof list` names them"
        )
    return [claim for claim in claims if claim.id in only]


def _findings(folder: Path) -> dict[str, Any]:
    path = folder / FINDINGS
    if not path.exists():
        return {}
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return data if isinstance(data, dict) else {}


def _with_progress(
    claims: Sequence[Claim],
    judged: Options,
    jobs: int,
    console: Any,
    executor: Executor | None,
) -> tuple[list[Judgement], dict[str, float]]:
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    if console is None or not console.is_terminal:
        return judge_all(claims, judged, jobs, lambda claim, judgement: None, executor)
    columns = (
        TextColumn("{task.description:24}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task("judging", total=len(claims))

        def step(claim: Claim, judgement: Judgement) -> None:
            progress.update(task, advance=1, description=f"{claim.id} {judgement.verdict.word}")

        return judge_all(claims, judged, jobs, step, executor)


def _definitions(claims: Sequence[Claim]) -> Sequence[Definition]:
    """The definitions of the statement file: those of the paper, where its claims are in it."""
    return definitions() if any(one.source.startswith(PAPER) for one in claims) else ()


def heading(claim: Claim) -> str:
    """What stands above the statements of a claim: its id and place, its print, its sentence."""
    place = " ".join(part for part in (claim.section, claim.place) if part)
    lines = [f"{claim.id}: {place}" if place else claim.id]
    lines += [f"    {line.strip()}" for line in claim.printed.splitlines()]
    return "\n".join([*lines, *textwrap.wrap(claim.says, WIDTH)])


def _write(
    folder: Path,
    store: Store,
    everything: Sequence[Claim],
    claims: Sequence[Claim],
    judgements: Sequence[Judgement],
) -> int:
    """Writes statements, certificates and findings; claims that were not selected keep what is
    stored of them.  Returns the files changed.
    """
    fresh = {judgement.id: judgement for judgement in judgements}
    chapters: list[tuple[str, Sequence[str]]] = []
    certificates: dict[str, Mapping[str, Any]] = {}
    findings = _findings(folder)
    for claim in everything:
        if claim.id in fresh:
            judgement = fresh[claim.id]
            chapters.append((heading(claim), [text for _, text in judgement.statements]))
            if judgement.statements:
                certificates[claim.id] = judgement.certificates
            findings[claim.id] = judgement.finding()
        else:
            held = {
                name: store.texts[name] for name in store.texts if name.split("/")[0] == claim.id
            }
            chapters.append((heading(claim), list(held.values())))
            if held:
                certificates[claim.id] = {
                    name: store.certificate(name, text) for name, text in held.items()
                }
    findings = {claim.id: findings[claim.id] for claim in everything if claim.id in findings}
    text = statement_file(TITLE, chapters, _definitions(everything), store.texts)
    changed = write_store(folder, text, certificates)
    return changed + write_file(folder / FINDINGS, canonical(findings))


def _accept(
    results: Results,
    before: Mapping[str, Mapping[str, Any]],
    options: argparse.Namespace,
    register: Path,
) -> None:
    """Writes the verdicts into the register, and what is generated into the pages where the
    verdicts are those of the stored certificates.
    """
    from juggleproof.proofs.reports import pages

    after = {one.id: one.registered() for one in results.claims}
    write_register({**before, **after} if options.only else after, register)
    if options.store is None and register == PATH:
        pages.update()


def entry(claim: Claim, judgement: Judgement) -> dict[str, Any]:
    """What the register keeps of a judgement."""
    return registered(
        judgement.verdict.word,
        judgement.verdict.detail,
        judgement.correction,
        table.sharp_range(judgement) if judgement.sharp else "",
    )


# -------------------------------------------------------------------------------------------------
# `juggleproof certify FILE.smt2 ...`: answers every problem of the scripts, and shows what settles
# each.

COLUMNS = ("problem", "answer", "settled by")
COLOURS = {"unsat": "green", "sat": "cyan", "unknown": "bold red"}
SUFFIX = ".smt2"
NOT_FOR_SCRIPTS = ("only", "accept", "junit", "markdown", "timings")


def are_scripts(files: Sequence[Path]) -> bool:
    """Whether the files are scripts of SMT-LIB; raises ClaimError where some are and others are
    not.
    """
    scripts = [path for path in files if path.suffix == SUFFIX]
    if scripts and len(scripts) < len(files):
        other = next(path for path in files if path.suffix != SUFFIX)
        raise ClaimError(f"{other}: beside scripts of SMT-LIB; certify files of one kind at a time")
    return bool(scripts)


def certify_problems(options: argparse.Namespace) -> int:
    """Answers the problems; 0 where all are answered, and as the scripts state, else 1."""
    from rich.console import Console

    for option in NOT_FOR_SCRIPTS:
        if getattr(options, option):
            raise ClaimError(f"--{option}: not for scripts of SMT-LIB; leave it out")
    outputs.refuse_unwritable(options)
    answered = _answered(options)
    draw(answered, Console(highlight=False))
    for one in answered:
        if one.contradicts:
            print(
                f"CONTRADICTS {one.problem.place}: the script states"
                f" {one.problem.status}, but it is {one.answer.word}, by what the checker accepted"
            )
        if one.rejected:
            print(f"rejected by the checker: {one.answer.name}: {one.rejected}")
    print(summary(answered))
    if options.json is not None:
        write_file(options.json, canonical({one.answer.name: data(one) for one in answered}))
    return int(not all(one.settled for one in answered))


def _answered(options: argparse.Namespace) -> list[Answered]:
    jobs = options.jobs if options.jobs > 0 else os.cpu_count() or 1
    budget = options.budget or BUDGET
    if jobs == 1:
        return answer_files(options.files, budget=budget, store=options.store, fresh=options.fresh)
    with ProcessPoolExecutor(jobs, mp_context=get_context("fork"), initializer=start) as pool:
        try:
            return answer_files(
                options.files,
                budget=budget,
                store=options.store,
                fresh=options.fresh,
                executor=pool,
            )
        except ClaimError:
            raise
        except BaseException:
            stop(pool)
            raise


def settled_by(one: Answered) -> str:
    """What settles a problem: a certificate, an exact model, or why nothing does."""
    if one.answer.word == "unsat":
        return "certificate"
    if one.answer.word == "unknown":
        return one.answer.reason
    model = ", ".join(f"{symbol} = {value}" for symbol, value in in_script(one.answer, one.problem))
    return "; ".join([f"model {model}" if model else "model", *one.answer.numbers])


def rows(answered: Sequence[Answered]) -> list[tuple[str, str, str]]:
    """The table's rows."""
    return [
        (
            one.name,
            one.answer.word + (f" (stated: {one.problem.status})" if one.contradicts else ""),
            settled_by(one),
        )
        for one in answered
    ]


def draw(answered: Sequence[Answered], console: Any) -> None:
    """Draws the table on a terminal; plain columns, one row a line, where there is none."""
    from rich.table import Table

    if not console.is_terminal:
        everything = [COLUMNS, *rows(answered)]
        widths = [max(len(row[i]) for row in everything) for i in range(len(COLUMNS))]
        for row in everything:
            print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
        return
    table = Table(*COLUMNS, header_style="bold")
    for row, one in zip(rows(answered), answered):
        colour = "bold red" if not one.settled else COLOURS[one.answer.word]
        table.add_row(row[0], f"[{colour}]{row[1]}[/{colour}]", row[2].replace("[", r"\["))
    console.print(table)


def summary(answered: Sequence[Answered]) -> str:
    """How many problems have which answer."""
    words = [one.answer.word for one in answered]
    wrong = sum(one.contradicts for one in answered)
    counted = ", ".join(f"{words.count(word)} {word}" for word in ("unsat", "sat", "unknown"))
    return f"{len(answered)} problem{'' if len(answered) == 1 else 's'}: {counted}" + (
        f"; {wrong} not as stated" if wrong else ""
    )


def data(one: Answered) -> dict[str, Any]:
    """An answer for other programs."""
    return {
        "file": one.path.name,
        "line": one.problem.line,
        "answer": one.answer.word,
        "stated": one.problem.status,
        "statement": one.answer.text,
        "reason": one.answer.reason,
        "rejected": one.rejected,
        "model": dict(in_script(one.answer, one.problem)) if one.answer.word == "sat" else {},
        "numbers": list(one.answer.numbers),
    }
