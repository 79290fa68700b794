"""The ways to decide a statement of the store: ours, and every peer."""

from __future__ import annotations

import re
import resource
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Literal, NamedTuple

from z3 import Context, SolverFor, Z3Exception

from juggleproof import coq_store as coq
from juggleproof.benchmarks.peers.notation import HEAD, goal, prenex
from juggleproof.benchmarks.processes import (
    UNCOUNTED,
    Timed,
    allow,
    children_seconds,
    each,
    kill_with_children,
    output_of,
)
from juggleproof.certificates import checker
from juggleproof.search.certificate import search_certificate, search_premises
from juggleproof.search.sharp import search_sharp
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.store import DEFAULT, Store
from juggleproof.statements.work import Budget
from juggleproof.votes.questions import Question, questions
from juggleproof.votes.smtlib import script

Word = Literal["holds", "fails", "gave up", "not taken"]
Known = Mapping[str, checker.Statement]


class Answer(NamedTuple):
    """What a route says of a statement; a note on its proof, or why it cannot be asked."""

    word: Word
    note: str = ""


HOLDS, FAILS, GAVE_UP = Answer("holds"), Answer("fails"), Answer("gave up")
Run = Callable[[], Answer]  # the work that is timed


@dataclass(frozen=True)
class Problem:
    """A statement of a store, with all before it and the line of its certificate; `outcome` is what
    the checker says of that.
    """

    name: str
    text: str
    statement: checker.Statement
    earlier: Known
    line: str
    outcome: Word


def problems(store: Store) -> list[Problem]:
    """Every statement of a store, in order."""
    outcomes = {name: word for name, word, _ in checker.check_folder(str(store.folder))}
    statements = checker.read_statements("\n\n".join(store.texts.values()))
    lines = checker.load(str(store.folder / checker.CERTIFICATES)).splitlines()
    by_name = {line.split('"', 2)[1]: line for line in lines}
    return [
        Problem(name, store.texts[name], one, statements, by_name[name], word_of(outcomes[name]))
        for name, one in statements.items()
    ]


def word_of(outcome: str) -> Word:
    """What a verdict of the checker says of the statement."""
    return {"certified": HOLDS, "refuted": FAILS}.get(outcome, GAVE_UP).word


# -------------------------------------------------------------------------------------------------
# Ours: a search with its check, and the check of the stored certificate.
#
# The search has the text of a statement, as the peers have: no lemmas and none of the hints that
# stand beside the claims.

UNITS = 2_000_000  # of counted work, as `juggleproof certify` has


def by_search() -> Callable[[Problem], Run]:
    """The checker's verdict on the certificate that our search finds."""

    def run(problem: Problem) -> Answer:
        statement = checker.read_statements(problem.text)[problem.name]
        certificate, known = _found(statement, problem.earlier)
        outcome = checker.check_one(statement, certificate, known, problem.earlier)[0]
        return Answer(word_of(outcome))

    return lambda problem: partial(run, problem)


def _found(statement: checker.Statement, earlier: Known) -> tuple[Certificate, Known]:
    """A certificate, and the statements that it rests on: those that an orbit rule names."""
    if statement.kind == "universal":
        return search_certificate(statement, {}, Budget(UNITS)), {}
    if statement.kind == "sharp":
        proof = search_sharp(statement, {}, earlier, Budget(UNITS))
        return ({"certified": proof} if proof else {"unknown": "no certificate was found"}), {}
    known = dict(earlier)
    premises = checker.premises_of(statement, known)
    found = search_premises(premises, known, UNITS)
    proofs = {name: proof for name, proof in found if proof is not None}
    if proofs.keys() != premises.keys():
        return {"unknown": "a premise has no proof"}, earlier
    return {"certified": proofs}, earlier


def by_check() -> Callable[[Problem], Run]:
    """The checker's verdict on the stored certificate, both read from their texts."""

    def run(problem: Problem) -> Answer:
        statement = checker.read_statements(problem.text)[problem.name]
        certificates, _ = checker.read_certificates(problem.line + "\n")
        outcome = checker.check_one(
            statement, certificates[problem.name], problem.earlier, problem.earlier
        )[0]
        return Answer(word_of(outcome))

    return lambda problem: partial(run, problem)


def lines_of_checker() -> int:
    """The lines of the checker's files, with their comments and docstrings."""
    files = DEFAULT.with_name("checker").glob("*.py")
    return sum(len(path.read_text(encoding="utf-8").splitlines()) for path in files)


# -------------------------------------------------------------------------------------------------
# Z3 and cvc5 on the SMT-LIB script that `juggleproof export smt2` writes.

Z3_UNITS = 5_000_000  # Z3's rlimit
CVC5_UNITS = 500_000  # cvc5's rlimit
_CHECK = re.compile(r"; ([^\n]*)\n\(reset\)\n\(set-logic (\w+)\)\n(.*?)\(check-sat\)\n", re.DOTALL)


class Check(NamedTuple):
    """One check of a script; a solution `refutes` the statement, or shows that a line does not
    follow from those before.
    """

    logic: str
    text: str
    refutes: bool


def checks(text: str) -> list[Check]:
    """The checks of a script, in order.

    >>> checks("; goal: a solution refutes it\\n(reset)\\n(set-logic NRA)\\n(check-sat)\\n")
    [Check(logic='NRA', text='', refutes=True)]
    """
    return [
        Check(logic, asked, "does not follow" not in meaning)
        for meaning, logic, asked in _CHECK.findall(text)
    ]


def by_solver(
    solver: Callable[[], Callable[[Check], tuple[str, str]]],
) -> Callable[[Problem], Run]:
    """The answer of a solver to all checks of a statement's script: it holds where every one is
    unsat.
    """
    ask = solver()
    return lambda problem: partial(
        answer_of, ask, checks(script(problem.statement, problem.earlier))
    )


def answer_of(ask: Callable[[Check], tuple[str, str]], asked: Sequence[Check]) -> Answer:
    """What the answers to all checks come to; a note says the worst of their proofs."""
    notes, unsettled = list[str](), not asked
    for check in asked:
        word, note = ask(check)
        if word == "sat" and check.refutes:
            return Answer("fails", "no proof of sat" if note else "")
        unsettled = unsettled or word != "unsat"
        notes.append(note)
    return GAVE_UP if unsettled else Answer("holds", max(notes))


def z3() -> Callable[[Check], tuple[str, str]]:
    """Z3, each check in a context of its own."""

    def ask(check: Check) -> tuple[str, str]:
        solver = SolverFor(check.logic, ctx=Context())
        solver.set("rlimit", Z3_UNITS)
        solver.from_string(check.text)
        try:
            return str(solver.check()), ""
        except Z3Exception:
            return "unknown", ""

    return ask


def reader_of_cvc5(**options: str) -> Callable[[str], tuple[Callable[[], str], str]]:
    """What reads a script by cvc5, in a solver of its own: the text of its first proof, and all
    that it writes.
    """
    from cvc5 import InputLanguage, InputParser, Solver

    def read(text: str) -> tuple[Callable[[], str], str]:
        solver = Solver()
        for option, value in {"rlimit": str(CVC5_UNITS), **options}.items():
            solver.setOption(option.replace("_", "-"), value)
        parser = InputParser(solver)
        parser.setStringInput(InputLanguage.SMT_LIB_2_6, text, "check")
        output = ""
        while not (command := parser.nextCommand()).isNull():
            output += str(command.invoke(solver, parser.getSymbolManager()))
        return lambda: str(solver.proofToString(solver.getProof()[0])), output

    return read


def cvc5(proof: bool = False) -> Callable[[Check], tuple[str, str]]:
    """cvc5, each check in a solver of its own; if asked to, it writes its proof in its own format
    and checks that itself.
    """
    proofs = {"produce_proofs": "true", "check_proofs": "true"} if proof else {}
    read = reader_of_cvc5(**proofs)

    def ask(check: Check) -> tuple[str, str]:
        proof_text, output = read(f"(set-logic {check.logic})\n{check.text}(check-sat)\n")
        word = output.split()[0]
        if not proof or word != "unsat":
            return word, "proof" if proof else ""
        return word, ("steps on trust" if ":rule trust" in proof_text() else "every step by a rule")

    return ask


# -------------------------------------------------------------------------------------------------
# QEPCAD B, a process for each question, which is how it is used.

CELLS = (2_000_000, 100_000_000)  # of memory for lists; setting up the second takes 1 s
TOO_FEW = "Too few cells"


def asked_of(problem: Problem) -> list[Question]:
    """The questions of a statement; of an orbit rule, those of its premises."""
    statement, earlier = problem.statement, problem.earlier
    if statement.kind == "iterates" or statement.kind not in checker.orbit_rules():
        return questions(statement, earlier)
    premises = checker.premises_of(statement, earlier).values()
    return [question for premise in premises for question in questions(premise)]


def is_expanded_away(problem: Problem) -> bool:
    """Whether nothing is left to ask where the polynomials are expanded, as they are for all peers
    but Coq on the store: our arithmetic has settled it.
    """
    return problem.statement.kind != "iterates" and all(
        False in (*question.assumed, *(denial.formula for denial in question.denials))
        for question in asked_of(problem)
    )


def untaken(problem: Problem, asked: Sequence[Question], quantifiers: bool) -> Answer | None:
    """Why a tool for real numbers, with or without `quantifiers`, cannot be asked; None where it
    can.
    """
    if problem.statement.get("number"):
        return Answer("not taken", "algebraic numbers")
    if any(question.integers & set(question.occurring()) for question in asked):
        return Answer("not taken", "integers")
    if any(denial.chosen for question in asked for denial in question.denials):
        return Answer("not taken", "alternating quantifiers")
    if not quantifiers and any(question.quantified for question in asked):
        return Answer("not taken", "quantifiers")
    return None


def by_qepcad() -> Callable[[Problem], Run]:
    """QEPCAD's answer to the questions in turn; it holds where every one is FALSE."""

    def prepare(problem: Problem) -> Run:
        asked = asked_of(problem)
        none = untaken(problem, asked, quantifiers=True)
        if none is not None:
            return lambda: none
        texts = [prenex(question) or "" for question in asked]
        return partial(answer_of_qepcad, texts, [question.refutes for question in asked])

    return prepare


def answer_of_qepcad(texts: Sequence[str], refutes: Sequence[bool]) -> Answer:
    """What QEPCAD's answers come to."""
    answers = [qepcad(text) for text in texts]
    if ("TRUE", True) in zip(answers, refutes):
        return FAILS
    return HOLDS if set(answers) == {"FALSE"} else GAVE_UP


def by_qepcad_alone(text: str) -> Word:
    """What QEPCAD says of one statement that is none of the store."""
    asked = questions(checker.read_statements(text).popitem()[1])
    texts = [prenex(question) or "" for question in asked]
    return answer_of_qepcad(texts, [question.refutes for question in asked]).word


def qepcad(text: str) -> str:
    """TRUE or FALSE, as QEPCAD says; empty where it does not within the CPU seconds that are
    left.
    """
    for cells in CELLS:
        output = output_of(["qepcad", "-noecho", f"+N{cells}"], text) or ""
        if TOO_FEW not in output:
            break
    match = re.search(r"An equivalent quantifier-free formula:\s+(TRUE|FALSE)\s", output)
    return match[1] if match else ""


# -------------------------------------------------------------------------------------------------
# Coq: its own tactics on the questions, and its kernel on the exported certificates.

TACTICS = "first [nra | psatz R 2]"  # psatz asks csdp

_TIME = re.compile(r"Chars \d+ - (\d+) .* secs \(([\d.]+)u,([\d.]+)s\)")


def compiled(path: Path, parts: Sequence[str], seconds: float) -> Iterator[Timed[bool]]:
    """Whether coqc accepts the parts of a file, in order; it ends with the first that is refused,
    or takes longer than it may.  The seconds are those that `coqc -time` prints of each sentence.
    """
    text, before = path.read_text(encoding="utf-8"), children_seconds()
    ends, end = list[int](), 0
    for part in parts:
        end = text.index(part, end) + len(part.rstrip())
        ends.append(end)
    start = text.index(parts[0])
    process = subprocess.Popen(
        ["coqc", "-q", "-time", "-Q", str(path.parent), "Store", str(path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        cwd=path.parent,  # psatz leaves files where it runs
        start_new_session=True,
        preexec_fn=lambda: allow(seconds),
    )
    done, used, last = 0, 0.0, 0.0
    try:
        for line in process.stdout or ():
            match = _TIME.match(line)
            if match is None:
                continue
            at, used = int(match[1]), used + float(match[2]) + float(match[3])
            if at <= start:
                last = used
            elif at >= ends[done]:
                resource.prlimit(process.pid, resource.RLIMIT_CPU, (int(used + seconds) + 2, -1))
                yield Timed(True, used - last)
                done, last = done + 1, used
    finally:
        if done < len(parts):
            kill_with_children(process)
        process.wait()
    if done < len(parts):
        yield Timed(None, children_seconds() - before - last)


def by_tactics(asked: Sequence[Problem], seconds: float) -> Iterator[Result]:
    """What nra, or else psatz, proves: many statements in one process, and another one after each
    that is not proved.
    """
    texts: dict[str, str] = {}
    for problem in asked:
        own = asked_of(problem)
        none = untaken(problem, own, quantifiers=False)
        if none is None:
            texts[problem.name] = "".join(goal(question, TACTICS) or "" for question in own)
        else:
            yield Result(problem.name, none, 0.0)
    names = list(texts)
    with tempfile.TemporaryDirectory() as folder:
        while names:
            path = Path(folder) / "Goals.v"
            parts = [texts[name] for name in names]
            path.write_text(HEAD + "".join(parts), encoding="utf-8")
            for timed in compiled(path, parts, seconds):
                yield Result(names.pop(0), HOLDS if timed.answer else GAVE_UP, timed.seconds)


def by_export(asked: Sequence[Problem], seconds: float) -> Iterator[Result]:
    """What Coq's kernel accepts of the exported store: its files one after the other."""
    by_name = {problem.name: problem for problem in asked}
    exported = coq.export(Store(DEFAULT), by_name)
    for name, why in exported.reasons.items():
        if name in by_name:
            yield Result(name, Answer("not taken", why), 0.0)
    with tempfile.TemporaryDirectory() as folder:
        coq.write(exported, Path(folder))
        command = ["coqc", "-q", "-Q", folder, "Store", f"{folder}/Prelude.v"]
        subprocess.run(command, check=True, capture_output=True)
        for path in sorted(Path(folder).glob("Part*.v")):
            text = path.read_text(encoding="utf-8")
            places = sorted(
                (text.find(one), name) for name, one in exported.texts.items() if one in text
            )
            names = [name for _, name in places]
            results = compiled(path, [exported.texts[name] for name in names], seconds)
            for timed, name in zip(results, names):
                if name in by_name:
                    word = by_name[name].outcome if timed.answer else "gave up"
                    yield Result(name, Answer(word), timed.seconds)


# -------------------------------------------------------------------------------------------------
# The routes.


class Result(NamedTuple):
    """What a route says of a statement, and its CPU seconds."""

    name: str
    answer: Answer
    seconds: float


@dataclass(frozen=True)
class Route:
    """A way to decide statements: what has to be believed where it does, how it runs, whether it is
    `present`, and what to install where it is absent.
    """

    title: str
    believed: str
    how: str
    run: Callable[[Sequence[Problem], float], Iterator[Result]]
    present: bool = True
    package: str = ""
    ours: bool = False


def warm(
    start: Callable[[], Callable[[Problem], Run]],
) -> Callable[[Sequence[Problem], float], Iterator[Result]]:
    """Asks about statement after statement in one warm process."""
    return lambda asked, seconds: _named(asked, each(start, asked, seconds))


def _named(asked: Sequence[Problem], timed: Iterator[Timed[Answer]]) -> Iterator[Result]:
    for one, problem in zip(timed, asked):
        yield Result(problem.name, one.answer or GAVE_UP, one.seconds)


def routes() -> list[Route]:
    """Every route, present or not."""
    coqc, qepcad_b = shutil.which("coqc"), shutil.which("qepcad")
    has_cvc5 = find_spec("cvc5") is not None
    warmly, kernel = "one warm process", "Coq's kernel, its real numbers"
    return [
        Route(
            "ours, search and check",
            f"the checker, {lines_of_checker()} lines",
            warmly,
            warm(by_search),
            ours=True,
        ),
        Route(
            "ours, check alone",
            f"the checker, {lines_of_checker()} lines",
            warmly,
            warm(by_check),
            ours=True,
        ),
        Route(
            "Z3, unchecked",
            "Z3",
            warmly,
            warm(lambda: by_solver(z3)),
            find_spec("z3") is not None,
            "Z3 (pip install z3-solver)",
        ),
        Route(
            "cvc5, unchecked",
            "cvc5",
            warmly,
            warm(lambda: by_solver(cvc5)),
            has_cvc5,
            "cvc5 (pip install cvc5)",
        ),
        Route(
            "cvc5 with its proof",
            "cvc5: its proof is not checked elsewhere",
            warmly,
            warm(lambda: by_solver(partial(cvc5, True))),
            has_cvc5,
            "cvc5 (pip install cvc5)",
        ),
        Route(
            "QEPCAD B",
            "QEPCAD B and SACLIB",
            "a process a question",
            warm(by_qepcad),
            qepcad_b is not None,
            "QEPCAD B (Debian package qepcad)",
        ),
        Route(
            "Coq's nra, or psatz",
            f"{kernel}, our translation",
            "a process until one is not proved",
            by_tactics,
            coqc is not None and shutil.which("csdp") is not None,
            "Coq and csdp (Debian packages coq, coinor-csdp)",
        ),
        Route(
            "Coq on the exported store",
            f"{kernel}, our export",
            "a process for each of 16 files",
            lambda asked, seconds: by_export(asked, UNCOUNTED),
            coqc is not None,
            "Coq (Debian package coq)",
        ),
    ]
