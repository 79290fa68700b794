"""Runs over many claims in several processes: they are loaded and judged, and the checker reads the
store.
"""

from __future__ import annotations

import importlib.util
import json
import os
import sys
import textwrap
import time
import traceback
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.judging import limits
from juggleproof.judging.checked import Checked, StoreReading, outcomes_of
from juggleproof.judging.claims import (
    REMARK,
    Claim,
    FixedBody,
    Verdict,
    awaited,
    claim_named,
    claims_in,
    claims_of,
    outcome_of,
    stated_texts,
    verdict_of,
)
from juggleproof.judging.judge import NOT_FOUND, judge
from juggleproof.judging.judgement import (
    ROUTES,
    Finding,
    Judgement,
    RecordedVotes,
    Resources,
    Sharp,
    is_finding,
)
from juggleproof.judging.rule_ranges import range_of_rule
from juggleproof.statements.definitions import Definition
from juggleproof.statements.language import ClaimError, rests_on
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.processes import alone, own_pool, spread
from juggleproof.statements.store import (
    DEFAULT,
    Store,
    canonical,
    plain_file,
    statement_file,
    write_file,
    write_store,
)
from juggleproof.statements.work import read

FINDINGS = "findings"
WIDTH = 96  # characters of a comment line in the statement file
TITLE = (
    "Every statement that the claims come to; certificates/checker reads this file and believes"
    " nothing else."
)
Progress = Callable[[Claim, Judgement], None]

# -------------------------------------------------------------------------------------------------
# A run: judge every claim, store the results, let the checker read the whole store.


@dataclass(frozen=True)
class Options:
    """The options of a run: the folder of statements and certificates, the routes, the counted work
    for each statement (`budget`), the number of processes (0: one a core), whether stored
    certificates are ignored (`fresh`), the claims (none: all), and whether each vote is cast again.

    Raises ClaimError, one line, for unknown routes, for routes without the exact one, and for
    `revote` without all routes.
    """

    store: Path
    routes: tuple[str, ...] = ROUTES
    budget: int = limits.DEFAULT_BUDGET
    jobs: int = 0
    fresh: bool = False
    only: tuple[str, ...] = ()
    revote: bool = False

    def __post_init__(self) -> None:
        if "exact" not in self.routes or not set(self.routes) <= set(ROUTES):
            raise ClaimError(
                f"--routes {','.join(self.routes)}: choose from {', '.join(ROUTES)}; exact is"
                " always among them, since only a certificate certifies"
            )
        if self.revote and {*self.routes} != {*ROUTES}:
            raise ClaimError("--revote: asks each route again; leave out --routes")

    @property
    def processes(self) -> int:
        """The number of processes, at least 1."""
        return self.jobs if self.jobs > 0 else os.cpu_count() or 1


@dataclass(frozen=True)
class Run:
    """The results of a run: the claims and the judgements on them, the seconds that each took, and
    the checker's outcome of each stored statement; `restated` names those with a new text.
    """

    claims: Sequence[Claim]
    judgements: Sequence[Judgement]
    seconds: Mapping[str, float]
    checked: Checked
    store: Path
    restated: tuple[str, ...] = ()

    @cached_property
    def outcomes(self) -> dict[str, str]:
        """The checker's outcome of every stored statement, by name."""
        return {name: outcome for name, outcome, _ in self.checked}

    @property
    def rejected(self) -> list[tuple[str, str]]:
        """The stored statements that the checker rejects, each with its reason."""
        return [(name, reason) for name, outcome, reason in self.checked if outcome == "rejected"]


def no_progress(claim: Claim, judgement: Judgement) -> None:
    """Reports nothing."""


def run(
    claims: Sequence[Claim],
    options: Options,
    progress: Progress = no_progress,
    executor: Executor | None = None,
) -> Run:
    """Judges the claims, stores the results, and has the checker read the whole store.

    `progress` is called with each judgement as it is ready; an executor, if given, replaces the
    pool of processes.  Claims that `options.only` leaves out keep their stored entries.

    Raises ClaimError, one line, for two claims with the same name, a name that no claim has, and
    the first claim in order that cannot be stated.
    """
    done = judge_stored(claims, options, progress, executor, is_checked_after=True)
    before = Store(options.store).texts
    restated = tuple(
        name
        for one in done.judgements
        for name, text in one.statements
        if before.get(name, text) != text
    )
    changed = _write(options.store, claims, done)
    checked = done.checked
    if changed or not checked:
        checked = checker.check_folder(str(options.store))
    settled = replace(done, checked=checked, restated=restated)
    settle_by_rules(done.judgements, settled.outcomes, Store(options.store).texts, by_id(claims))
    for judgement in done.judgements:
        take_back(judgement, settled)
    return settled


def take_back(judgement: Judgement, done: Run) -> None:
    """Makes a judgement unknown where the checker, on reading the whole store, gives one of its
    statements another outcome: for instance, a lemma may have turned out not to be certified.
    """
    reasons = {name: f"{outcome}: {why}" for name, outcome, why in done.checked}
    for name, outcome in judgement.outcomes.items():
        now = done.outcomes.get(name, "rejected")
        if now != outcome:
            judgement.outcomes[name] = now
            judgement.correction, judgement.sharp = None, {}
            judgement.verdict = Verdict("unknown", f"{name} is {reasons.get(name, 'not stored')}")


def judge_stored(
    claims: Sequence[Claim],
    options: Options,
    progress: Progress = no_progress,
    executor: Executor | None = None,
    is_checked_after: bool = False,
    checked: Checked | None = None,
) -> Run:
    """Judges the claims like `run`, but writes nothing, and settles no claim that awaits others.

    `checked` has the checker's outcomes of the store, which is checked here where it is None.  Only
    lemmas that are certified in the store are used, or all lemmas if `is_checked_after`: then the
    caller has the checker read the results.
    """
    refuse_duplicates(claims)
    chosen, jobs = _selected(claims, options.only), options.processes
    with StoreReading(options.store, jobs, options.fresh or checked is not None) as reading:
        resources = Resources(
            options.routes,
            options.budget,
            Store(Path(os.devnull) if options.fresh else options.store),
            {} if options.fresh else findings_in(options.store),
            votes={} if options.revote else votes_on_record(options.store, claims),
            lemmas=lemmas(by_id(claims), chosen),
        )
        outcomes = reading.outcomes()
        if checked is None:
            checked = reading.results
        else:
            outcomes = {name: outcome for name, outcome, _ in checked}
        resources = replace(resources, checked=outcomes)
        if not is_checked_after:
            resources = replace(resources, lemmas=accepted(resources))
    judgements, seconds = judge_all(chosen, resources, jobs, progress, executor)
    return Run(chosen, judgements, seconds, checked, options.store)


def judge_some(
    chosen: Sequence[Claim],
    claims: Mapping[str, Claim],
    folder: Path,
    outcomes: Mapping[str, str] | None = None,
) -> list[Judgement]:
    """The judgements on some of the claims by their stored certificates and the exact route alone.

    Without `outcomes`, the checker checks the stored statements of these claims and all that they
    rest on.  An earlier claim with a lemma that is not certified in the store is judged first; the
    lemma is used only if this certifies it.

    Raises what `judge` raises, and ClaimError where the folder cannot be read.
    """
    store, ids, used = Store(folder), {claim.id for claim in chosen}, lemmas(claims, chosen)
    own = [name for name in store.texts if name in used or name.split("/")[0] in ids]
    checked = outcomes if outcomes is not None else outcomes_of(folder, own) if own else {}
    resources = Resources(
        ("exact",), store=store, findings=findings_in(folder), lemmas=used, checked=checked
    )
    certified = accepted(resources)
    last = max((index for index, name in enumerate(claims) if name in ids), default=0)
    lacking = {name.split("/")[0] for name in used if name not in certified}
    # in order, as the checker reads them
    before = [claims[name] for name in islice(claims, last) if name in lacking]
    for earlier in judge_some(before, claims, folder, outcomes) if before else ():
        certified.update(
            (name, text)
            for name, text in earlier.statements
            if used.get(name) == text and earlier.outcomes[name] == "certified"
        )
    resources = replace(resources, lemmas=certified)
    judgements = [judge(claim, resources) for claim in chosen]
    names = with_below((name for one in judgements for name in one.awaits), claims)
    if outcomes is None:
        outcomes = outcomes_of(folder, names) if store.texts and names else {}
    settle_by_rules(judgements, outcomes, store.texts, claims)
    return judgements


def with_below(names: Iterable[str], claims: Mapping[str, Claim]) -> list[str]:
    """These names of rules and claims, and the names of all that the claims state and await."""
    found = [*names]
    for name in found:
        if name in claims:
            below = (*stated_texts(claims[name]), *awaited(claims[name].body()))
            found += [one for one in below if one not in found]
    return found


def settle_by_rules(
    judgements: Sequence[Judgement],
    outcomes: Mapping[str, str],
    texts: Mapping[str, str],
    claims: Mapping[str, Claim],
) -> None:
    """Gives each judgement that awaits map rules or a claim its verdict and range, from the
    outcomes and texts of all statements; an outcome counts only if the claims state the same text.
    """
    stated = dict[str, str]()
    above = list[str]()

    def stands(name: str) -> bool:
        """Whether the claim holds by the outcomes of its own statements, and by the rules and
        claims that it awaits; a claim that awaits itself does not.
        """
        claim = claims.get(name)
        if claim is None or name in above:
            return False
        above.append(name)
        settled = {
            one: outcomes.get(one, "unknown")
            for one, text in stated_texts(claim).items()
            if texts.get(one) == text
        }
        body, beside = claim.body(), claim.shown_beside()
        settled.update((one, "certified") for one in awaited(body) if holds(one))
        above.pop()
        if beside and outcome_of(name, REMARK, beside, settled) != "certified":
            return False
        return verdict_of(name, body, settled).word == "holds"

    def holds(name: str) -> bool:
        """Whether the claim stands; or whether the rule is certified, and it and all that it rests
        on are map rules with the text that their claims state.
        """
        if "/" not in name:
            return stands(name)
        names = [name] if outcomes.get(name) == "certified" else []
        for one in names:
            claim = claims.get(one.split("/")[0])
            if one not in stated and claim is not None:
                stated.update(stated_texts(claim))
            if one not in stated or texts.get(one) != stated[one]:
                return False
            rule = read(stated[one], one)
            if rule.kind not in checker.orbit_rules():
                return False
            names += [each for each in rests_on(rule) if each not in names]
        return bool(names)

    for one in judgements:
        if one.awaits and all(map(holds, one.awaits)):
            one.verdict = one.by_rules
        if one.follows:
            held = one.verdict.word == "holds"
            text = (
                range_of_rule(
                    one.rests_on[-1],
                    texts,
                    claims[one.id].stated(one.roles),
                    one.is_conclusion,
                )
                if held
                else NOT_FOUND
            )
            one.sharp[""] = Sharp(text, one.rests_on)


def accepted(resources: Resources) -> dict[str, str]:
    """The lemmas that the store has with the same text, and certified."""
    texts = resources.store.texts if resources.store else {}
    return {
        name: text
        for name, text in resources.lemmas.items()
        if resources.checked.get(name) == "certified" and texts.get(name) == text
    }


def refuse_duplicates(claims: Sequence[Claim]) -> None:
    """Raises ClaimError where two claims have the same name."""
    seen: set[str] = set()
    for claim in claims:
        if claim.id in seen:
            raise ClaimError(f"{claim.id} is the name of two claims; rename one")
        seen.add(claim.id)


def _selected(claims: Sequence[Claim], only: Sequence[str]) -> Sequence[Claim]:
    if not only:
        return claims
    known = [claim.id for claim in claims]
    try:
        wanted = [claim_named(text, known) for text in only]
    except ClaimError as problem:
        raise ClaimError(f"--only {problem}") from None
    return [claim for claim in claims if claim.id in wanted]


def findings_in(folder: Path) -> dict[str, Finding]:
    """The findings of an earlier run by claim, which are tried first; none where the file cannot be
    read, and without entries that do not have the shape of a finding.
    """
    try:
        data = json.loads(plain_file(folder / FINDINGS).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    entries = data.items() if isinstance(data, dict) else ()
    return {claim: one for claim, one in entries if is_finding(one)}


def votes_on_record(folder: Path, claims: Sequence[Claim]) -> dict[str, dict[str, RecordedVotes]]:
    """The recorded votes by claim and by the digest of the question: those of the folder and, for
    the paper's claims, those beside the committed certificates.
    """
    is_paper = any(claim.is_of_package for claim in claims)
    votes: dict[str, dict[str, RecordedVotes]] = {}
    for one in dict.fromkeys([DEFAULT, folder] if is_paper else [folder]):
        for claim, finding in findings_in(one).items():
            recorded = finding.get("votes", {}).values()
            votes.setdefault(claim, {}).update((each["on"], each) for each in recorded)
    return votes


def _definitions(claims: Sequence[Claim]) -> Sequence[Definition]:
    """The definitions of the statement file: those of the first vocabulary that defines any."""
    sources = [one.vocabulary.defines for one in claims if one.vocabulary.defines is not None]
    return sources[0]() if sources else ()


def heading(claim: Claim) -> str:
    """The comment above the statements of a claim: its id and place, its print, its sentence."""
    place = " ".join(part for part in (claim.section, claim.place) if part)
    lines = [f"{claim.id}: {place}" if place else claim.id]
    lines += [f"    {line.strip()}" for line in claim.printed.splitlines()]
    return "\n".join([*lines, *textwrap.wrap(claim.says, WIDTH)])


def _write(folder: Path, everything: Sequence[Claim], done: Run) -> int:
    """Writes statements, certificates and findings; claims that were not selected keep their stored
    entries.  Returns the number of files that changed.
    """
    store, fresh = Store(folder), {judgement.id: judgement for judgement in done.judgements}
    names: dict[str, list[str]] = {}  # names of the stored statements, by claim
    for name in store.texts:
        names.setdefault(name.split("/")[0], []).append(name)
    chapters: list[tuple[str, Sequence[str]]] = []
    certificates: dict[str, Mapping[str, Certificate]] = {}
    findings = findings_in(folder)
    for claim in everything:
        if claim.id in fresh:
            judgement = fresh[claim.id]
            chapters.append((heading(claim), [text for _, text in judgement.statements]))
            if judgement.statements:
                certificates[claim.id] = judgement.certificates
            findings[claim.id] = judgement.finding()
        else:
            kept = {name: store.texts[name] for name in names.get(claim.id, ())}
            chapters.append((heading(claim), list(kept.values())))
            if kept:
                found = ((name, store.certificate(name, text)) for name, text in kept.items())
                certificates[claim.id] = {name: one for name, one in found if one is not None}
    findings = {claim.id: findings[claim.id] for claim in everything if claim.id in findings}
    text = statement_file(TITLE, chapters, _definitions(everything), store.texts)
    changed = write_store(folder, text, certificates)
    return changed + write_file(folder / FINDINGS, canonical(findings))


# -------------------------------------------------------------------------------------------------
# The claims of a user's own file.


def claims_of_file(path: Path) -> list[Claim]:
    """The claims of a Python file.

    Raises ClaimError, one line with file and line, where it does not parse, fails, or holds no
    claim.
    """
    if path.is_dir():
        raise ClaimError(f"{path}: a folder; name a Python file with claims")
    if not plain_file(path).exists():
        raise ClaimError(f"{path}: no such file; name a Python file with claims")

    def load() -> None:
        spec = importlib.util.spec_from_file_location(f"claims_of_{path.stem}", path)
        if spec is None or spec.loader is None:
            raise ClaimError(f"{path}: not a Python file; its name must end with .py")
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module
        try:
            spec.loader.exec_module(module)
        except ClaimError as problem:
            raise ClaimError(f"{path}:{_line_in(path)}: {problem}") from None
        except SyntaxError as problem:
            raise ClaimError(
                f"{path}:{problem.lineno}: does not parse ({problem.msg}); mend the syntax"
            ) from None
        except (Exception, SystemExit) as problem:
            raise ClaimError(
                f"{path}:{_line_in(path)}: {type(problem).__name__}: {problem}; mend this line"
            ) from None

    claims = claims_of(load)
    if not claims:
        raise ClaimError(f'{path}: no claims; decorate a function with @claim("its-name")')
    return claims


def claims_of_files(paths: Sequence[Path]) -> list[Claim]:
    """The claims of Python files, in order."""
    return [claim for path in paths for claim in claims_of_file(path)]


def store_of(paths: Sequence[Path]) -> Path:
    """The folder for the certificates of such claims: beside the first file, with its name."""
    return paths[0].with_suffix(".certificates")


def _line_in(path: Path) -> int:
    """The last line of the file in the traceback of the exception that is being handled."""
    frames = traceback.extract_tb(sys.exc_info()[2])
    lines = [
        frame.lineno for frame in frames if frame.filename == str(path.absolute()) and frame.lineno
    ]
    return lines[-1] if lines else 1


# -------------------------------------------------------------------------------------------------
# The judgement of many claims by a pool of processes or by any executor; results come in order and
# do not depend on this.

_work: tuple[Sequence[Claim], Resources] | None = None
# ------------------------------------------------------------ claims


@dataclass(frozen=True)
class Sent:
    """A claim that is sent to another process with its resources: a claim of this package as module
    and name, any other with a fixed body.
    """

    claim: tuple[str, str] | Claim
    resources: Resources


def _loaded(module: str, name: str) -> Claim:
    return next(claim for claim in claims_in([module]) if claim.id == name)


def judge_sent(sent: Sent) -> tuple[Judgement, float]:
    """The judgement on a claim that was sent, and the seconds it took."""
    with alone:
        began = time.perf_counter()
        claim = sent.claim if isinstance(sent.claim, Claim) else _loaded(*sent.claim)
        judgement = judge(claim, sent.resources)
        return judgement, time.perf_counter() - began


def sent(claim: Claim, resources: Resources) -> Sent:
    """A claim with its resources as data that can be pickled; raises ClaimError for a claim with a
    print that may need correcting.
    """
    module = claim.source.rpartition(".")[0]
    if claim.is_of_package and any(one is claim for one in claims_in([module])):
        return Sent((module, claim.id), resources.only(claim))
    if claim.printed or claim.derived or claim.true_nearby:
        raise ClaimError(
            f"{claim.id} has a print to be corrected, which only this process can do; certify it"
            " without an executor"
        )
    beside, remark = claim.shown_beside(), claim.remark
    if beside is not None and remark is not None:
        remark = replace(remark, state=FixedBody(beside, claim.where))
    body = FixedBody(claim.body(), claim.where)
    return Sent(replace(claim, read=body, remark=remark), resources.only(claim))


def judge_all(
    claims: Sequence[Claim],
    resources: Resources,
    jobs: int,
    progress: Progress = no_progress,
    executor: Executor | None = None,
) -> tuple[list[Judgement], dict[str, float]]:
    """The judgements on all claims in order, and the seconds that each took; an executor, if given,
    replaces the pool of processes.

    Raises ClaimError for the first claim in order that cannot be stated.
    """
    seconds: dict[str, float] = {}

    def take(index: int, timed: tuple[Judgement, float]) -> None:
        judgement, seconds[claims[index].id] = timed
        progress(claims[index], judgement)

    if executor is not None:
        return [
            judgement
            for judgement, _ in spread(
                judge_sent, [sent(claim, resources) for claim in claims], executor, take
            )
        ], seconds
    global _work
    _work = (claims, resources)
    everything = range(len(claims))
    if jobs <= 1 or len(claims) == 1:
        return [judgement for judgement, _ in spread(_judge_one, everything, None, take)], seconds
    with own_pool(jobs) as pool:
        return [judgement for judgement, _ in spread(_judge_one, everything, pool, take)], seconds


def _judge_one(index: int) -> tuple[Judgement, float]:
    if _work is None:
        raise RuntimeError("a worker started without its claims")
    began = time.perf_counter()
    return judge(_work[0][index], _work[1]), time.perf_counter() - began


def lemmas(everything: Mapping[str, Claim], claims: Sequence[Claim]) -> dict[str, str]:
    """The texts of the statements that the selected claims use from other claims."""
    used = {name for claim in claims for name in claim.hints.get("uses", ())}
    texts: dict[str, str] = {}
    for owner in dict.fromkeys(name.split("/")[0] for name in sorted(used)):
        if owner in everything:
            texts.update(stated_texts(everything[owner]))
    return {name: texts[name] for name in used if name in texts}


def by_id(claims: Iterable[Claim]) -> dict[str, Claim]:
    """The claims by their ids, in order."""
    return {claim.id: claim for claim in claims}
