"""`juggleproof certify`: claims of the paper, or of files."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from itertools import count
from pathlib import Path

from rich.console import Console

from juggleproof.command.outputs import asked_of, fitted, now_and_then, refuse_unwritable
from juggleproof.judging import limits
from juggleproof.judging.claims import CheckedApart, Claim, one_line
from juggleproof.judging.judgement import Judgement, statements_of
from juggleproof.judging.register import PATH, Register, load_register, write_register
from juggleproof.judging.run import (
    Options,
    Progress,
    Run,
    claims_of_files,
    findings_in,
    run,
    store_of,
)
from juggleproof.papers import derived
from juggleproof.papers.derivations import behind, derivations_of
from juggleproof.papers.index import write_index
from juggleproof.papers.paper import opened
from juggleproof.reports import pages
from juggleproof.reports import results as table
from juggleproof.reports.ci import as_junit, failing, markdown
from juggleproof.reports.contents import Contents, as_json, contents_of
from juggleproof.reports.results import RunResults, results_of_run, theorem_of_run
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import DEFAULT, write_file

# -------------------------------------------------------------------------------------------------
# `juggleproof certify`: judge every claim, store the results, let the checker read the whole store,
# compare with the register.


class CertifyOptions(argparse.Namespace):
    """The options of `juggleproof certify`; 0 stands for the default."""

    files: list[Path]
    only: list[str] | None
    routes: str
    fresh: bool
    rederive: bool
    revote: bool
    jobs: int
    budget: int
    accept: bool
    store: Path | None
    json: Path | None
    junit: Path | None
    markdown: Path | None
    timings: Path | None
    report: list[str]
    all: bool
    quiet: bool
    output: Path | None
    write_reports: Callable[[Contents], int] | None


def command(parsed: argparse.Namespace) -> int:
    """Judges the claims; returns the exit code."""
    return certify(CertifyOptions(**vars(parsed)))


def certify(options: CertifyOptions, register: Path = PATH) -> int:
    """Runs `certify`; returns 0 where all verdicts are as registered (for a user's file: where
    every claim holds), else 1.
    """
    refuse_unwritable(options.files, asked_of(options))
    _refuse_what_needs_the_paper(options)
    before = None if options.files else load_register(register)
    console = Console(highlight=False)
    claims = claims_of_files(options.files) if options.files else opened().claims()
    with _progress(console, len(options.only or claims)) as step:
        done = run(claims, _options(options), step)
    for name in done.restated:
        print(f"restated {name}: what was stored is not the statement of the sources")
    for name, reason in done.rejected:
        print(f"rejected by the checker: {name}: {reason}")
    accepts = options.accept and not done.rejected
    theorem = "" if options.files else theorem_of_run(done)
    results = results_of_run(
        done.claims,
        done.judgements,
        before,
        theorem=theorem,
        rejected=done.rejected,
        partial=bool(options.only),
        accepted=accepts,
    )
    for change in results.changes:
        print(f"{'accepted ' if accepts else 'differs from the register '} {change}")
    _show(options, done, results, console)
    for one in results.claims if options.files else ():
        if one.verdict != "holds":
            print(f"\n{one.id}: {failing(one)}".replace("\n", "\n    ").replace("\n    ", "\n", 1))
    if results.own and results.exit:
        files = " ".join(one_line(str(path)) for path in options.files)
        print(f"\n`juggleproof explain ID {files}` shows a claim whole")
    if before is not None and accepts:
        _accept(results, before, options, register)
    write_outputs(options, results, done.seconds)
    if options.rederive and not _derives_what_is_kept():
        return 1
    if options.write_reports is None:
        return results.exit
    return results.exit | options.write_reports(contents_of(done, load_register(register)))


def _show(options: CertifyOptions, done: Run, results: RunResults, console: Console) -> None:
    """Prints the results of a run: a line where it is quiet; else the theorem, where its printed
    proof breaks, and the counts; a table for few claims, or where it is asked for.
    """
    claims, *others = table.summary(done.judgements).splitlines()
    claims += "" if results.own or results.changes else "; all as registered"
    if options.quiet:
        print(claims + "".join(f"; {one}" for one in results.theorem.splitlines()[:1]).rstrip(";"))
        return
    if options.all or options.files or options.only:
        table.draw(done.claims, done.judgements, console)
    broken = [] if options.files or options.only else table.where_the_proof_breaks(results)
    bodies = [(claim, claim.body(), one) for claim, one in zip(done.claims, done.judgements)]
    lines = [*results.theorem.splitlines(), *broken, claims, *others]
    lines += [
        body.line(claim.id, judged.verdict)
        for claim, body, judged in bodies
        if isinstance(body, CheckedApart)
    ]
    if broken:
        lines.append("`juggleproof errata` shows every error, `certify --all` every claim")
    if console.is_terminal:
        lines.append(f"{sum(done.seconds.values()):.1f} s of judging")
    print(fitted("\n".join(lines)))


def _derives_what_is_kept() -> bool:
    """Whether the sources derive exactly the stored values; prints the result."""
    _derive_everything()
    kept = derived.kept()
    otherwise = kept.otherwise()
    if otherwise:
        print(f"{derived.PATH.name}: kept otherwise than derived: {otherwise};", end=" ")
        print("`juggleproof certify --accept` writes it anew")
    else:
        print(f"derived again: {len(kept.asked)} values, all as they are kept")
    return not otherwise


def _derive_everything() -> None:
    """Requests all values that SymPy derives for judging and for showing the paper's claims."""
    found = findings_in(DEFAULT)
    for claim in opened().claims():
        correction = found.get(claim.id, {}).get("correction")
        for one in behind(derivations_of(statements_of(claim, correction))):
            one.shown()
        if claim.derived is not None:
            claim.derived()
        if claim.true_nearby is not None:
            claim.true_nearby[1]()


def _refuse_what_needs_the_paper(options: CertifyOptions) -> None:
    """Raises ClaimError, one line, for an option that goes only with the paper's claims, or with
    all of them.
    """
    if options.rederive and options.files:
        raise ClaimError("--rederive: for the paper's claims; leave out FILE")
    if options.report and (options.files or options.only):
        raise ClaimError("--report: shows all claims of the paper; leave out FILE and --only")
    if options.output is not None and not options.report:
        raise ClaimError("-o: where reports go; name one with --report")


def _options(options: CertifyOptions) -> Options:
    own = store_of(options.files) if options.files else None
    return Options(
        options.store or own or DEFAULT,
        tuple(options.routes.split(",")),
        options.budget or limits.DEFAULT_BUDGET,
        options.jobs,
        options.fresh,
        tuple(options.only or ()),
        options.revote,
    )


@contextmanager
def _progress(console: Console, total: int) -> Iterator[Progress]:
    """Shows the progress of the run: by a bar on a terminal, else by lines on standard error."""
    if not console.is_terminal:
        yield _lines_of_progress(total)
        return
    bars = import_module("rich.progress")  # loading it takes 0.01 s or more
    columns = (
        bars.TextColumn("{task.description:24}"),
        bars.BarColumn(),
        bars.MofNCompleteColumn(),
        bars.TimeElapsedColumn(),
    )
    with bars.Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("judging", total=total)

        def step(claim: Claim, judgement: Judgement) -> None:
            bar.update(task, advance=1, description=f"{claim.id} {judgement.verdict.word}")

        yield step


def _lines_of_progress(total: int) -> Progress:
    judged, tell = count(1), now_and_then()

    def step(claim: Claim, judgement: Judgement) -> None:
        tell(f"{next(judged)} of {total} claims judged")

    return step


def _accept(
    results: RunResults,
    before: Register,
    options: CertifyOptions,
    register: Path,
) -> None:
    """Writes the verdicts into the register; for the paper's own store and register, also the
    index, the derived values and the generated pages.
    """
    after = {one.id: one.registered() for one in results.claims}
    write_register({**before, **after} if options.only else after, register)
    if options.store is None and register == PATH:
        write_index(opened().modules)
        _derive_everything()
        derived.kept().write()
        pages.update()


# -------------------------------------------------------------------------------------------------
# The files that `certify` writes beside the store; those that cannot be written are refused before
# the run.


def write_outputs(
    options: CertifyOptions, results: RunResults, seconds: Mapping[str, float]
) -> None:
    """Writes each file that was asked for."""
    for option, path in asked_of(options).items():
        write_file(path, _content(option, results, seconds if options.timings else {}))


def _content(option: str, results: RunResults, seconds: Mapping[str, float]) -> bytes:
    if option == "json":
        return as_json(results)
    if option == "junit":
        return as_junit(results, seconds)
    if option == "markdown":
        return markdown(results).encode()
    return "".join(f"{seconds[one.id]:9.3f}  {one.id}\n" for one in results.claims).encode()
