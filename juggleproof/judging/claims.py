"""A claim, its body, its verdict."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, TypedDict, TypeVar, Union, get_args

from juggleproof.folders import PACKAGE
from juggleproof.judging.conclusions import PROVED, REFUTED
from juggleproof.judging.forms import PLAIN, Vocabulary, domains_of
from juggleproof.reading import meaning
from juggleproof.reading.values import Matrix, Vector
from juggleproof.statements.cases import with_cases
from juggleproof.statements.language import (
    NO_ROLES,
    AnyStatement,
    ClaimError,
    Formula,
    Iterates,
    MapRule,
    Roles,
    SharpRange,
    Statement,
    Term,
)

if TYPE_CHECKING:
    from juggleproof.search.closing import Hints

Read = TypeVar("Read", bound=Callable[..., object])

# -------------------------------------------------------------------------------------------------
# Claims: an assertion with its place and print, and the formal reading that is judged.
#
# A claim is a function from its parsed print to a body: an assertion (all its statements hold),
# readings (a sentence that can be read in several ways), an argument (steps and a conclusion), a
# conclusion of map rules, the figures of a simulation, sentences that another checker certifies, or
# the reason why nothing is stated.


@dataclass(frozen=True)
class Assertion:
    """An assertion that all of the statements hold."""

    parts: tuple[AnyStatement, ...]


@dataclass(frozen=True)
class Reading:
    """One way to read a sentence, and the passage of the paper that prints it so."""

    assertion: Assertion
    passage: str


@dataclass(frozen=True)
class Readings:
    """The ways in which a sentence can be read, each with its own verdict.

    Raises ClaimError for fewer than two readings, and for one without a passage: without a reason
    from the paper there is one reading, the charitable one.
    """

    of: Mapping[str, Reading]

    def __post_init__(self) -> None:
        if len(self.of) < 2:
            raise ClaimError("one reading alone; return what it asserts")
        for name, reading in self.of.items():
            if not reading.passage.strip():
                raise ClaimError(f"the reading {name} has no passage that prints it so; drop it")


@dataclass(frozen=True)
class Argument:
    """An argument: labelled steps from which a conclusion is drawn.

    If a step fails, the conclusion stands by its own certificate, by the claim `proved_by` where
    that holds, or by the map rules that it `rests_on`.
    """

    steps: Mapping[str, Assertion]
    conclusion: Assertion | None = None
    proved_by: str = ""
    rests_on: tuple[str, ...] = ()


@dataclass(frozen=True)
class Following:
    """A sentence on limits or stability that follows from map rules, named by their statements;
    `beside` is what else it asserts.

    The sentence follows from the conclusion of the last rule named, so it holds at least where that
    conclusion holds.  `is_conclusion` says that the sentence is that conclusion itself, so that it
    is false where the rule refutes it.
    """

    rests_on: tuple[str, ...]
    beside: Assertion | None = None
    is_conclusion: bool = False


REMARK = "remark."  # the prefix of the statements of a remark


@dataclass(frozen=True)
class Simulated:
    """The figures that a simulation gives, with its seed; they prove nothing.

    `agrees` says whether they agree with what is printed; None where nobody has compared them.
    """

    figures: str
    agrees: bool | None = None

    @property
    def told(self) -> str:
        """The figures, after whether they agree with what is printed."""
        agreement = {True: "agrees with the print: ", False: "does not agree with the print: "}
        return (agreement[self.agrees] if self.agrees is not None else "") + self.figures


@dataclass(frozen=True)
class NotFormalised:
    """A sentence that no statement of real arithmetic expresses, with the reason; it stays open."""

    why: str


@dataclass(frozen=True)
class CheckedApart:
    """Sentences in the language of another checker, which certifies them from a store of its own.

    `outcomes` asks it for (sentence or line of the store, outcome, reason) of all that is stored.
    `believed` says what one has to trust for this, and what other evidence there is.
    """

    sentences: tuple[str, ...]
    checker: str
    outcomes: Callable[[], Sequence[tuple[str, str, str]]]
    believed: str

    def verdict(self) -> Verdict:
        """The verdict: unknown where anything stored is rejected, holds where all sentences are
        certified, false where the first one that is not certified is refuted, else unknown.
        """
        found = {name: (outcome, reason) for name, outcome, reason in self.outcomes()}
        lost = [name for name, (outcome, _) in found.items() if outcome == "rejected"]
        for name in (*lost, *self.sentences):
            outcome, reason = found.get(name, ("unknown", "it is not stored"))
            if outcome == "refuted":
                return Verdict("false", f"{REFUTED} by {self.checker}: {name}")
            if outcome != "certified":
                why = f"{outcome}: {reason}" if reason else outcome
                return Verdict("unknown", f"not certified by {self.checker}: {name}: {why}")
        return Verdict("holds", f"by {self.checker}")

    def line(self, claim_id: str, verdict: Verdict) -> str:
        """One line for the verdict: what is certified, or why it is not."""
        if verdict.word != "holds":
            return f"{claim_id}: NOT certified; {verdict.detail}"
        return f"{claim_id}: certified by {self.checker}: {'; '.join(self.sentences)}"


NOT_FORMALISED = "not formalised: "  # begins the detail of such a verdict
Body = Union[Assertion, Readings, Argument, Following, Simulated, CheckedApart, NotFormalised]


@dataclass(frozen=True)
class FixedBody:
    """The body of a claim, in place of the function that returns it: unlike the function, it can be
    sent to another process.
    """

    body: Body
    where: str

    def __call__(self) -> Body:
        return self.body


@dataclass(frozen=True)
class Remark:
    """A remark on a claim, with its evidence: statements, which must be certified, and other
    claims.
    """

    text: str
    state: Callable[[], object] | None = None
    by: tuple[str, ...] = ()


class ClaimHints(TypedDict, total=False):
    """The hints of a claim for the search: the names of the earlier statements that its proofs use
    (`uses`), and how to search (`search`).
    """

    uses: Sequence[str]
    search: Hints


@dataclass(frozen=True)
class Claim:
    """One assertion: id, place, what is printed, and the function that reads it."""

    id: str
    section: str
    place: str
    says: str
    read: Callable[..., object]
    printed: str = ""
    as_it_stands: str = ""
    repeats: str = ""
    parameters: tuple[str, ...] | None = None
    derived: Callable[[], Term | Vector | Matrix] | None = None
    mended: str = ""
    true_nearby: tuple[str, Callable[[], object]] | None = None
    remark: Remark | None = None
    hints: ClaimHints = field(default_factory=lambda: ClaimHints())
    source: str = ""
    vocabulary: Vocabulary = PLAIN

    def roles(self, statements: Sequence[Statement]) -> Roles:
        """The parameters of the claim with their domains, and its scales; the domains come from its
        vocabulary, or else from its statements.
        """
        domains = self.vocabulary.domains or domains_of(statements, self.parameters)
        return Roles(domains, self.vocabulary.scales)

    @property
    def assumed(self) -> tuple[Formula, ...]:
        """What its section assumes beyond the standing assumptions."""
        assumes = self.vocabulary.assumes
        return () if assumes is None else assumes(self.section)

    def stated(self, roles: Roles) -> Roles:
        """The roles, if the vocabulary states them, else none: domains that are taken from
        statements need not be those of a map.
        """
        return roles if self.vocabulary.domains else NO_ROLES

    def over(self, roles: Roles) -> tuple[str, ...]:
        """The parameters of its sharp ranges: those that the claim names, else the first of its
        vocabulary, else those that its statements bound.
        """
        if self.parameters is not None:
            return self.parameters
        return tuple(roles.domains)[: 1 if self.vocabulary.domains else None]

    @property
    def where(self) -> str:
        """File and line of the claim, relative to the working directory where it is below it."""
        if isinstance(self.read, FixedBody):
            return self.read.where
        code = self.read.__code__
        return place_in_file(code.co_filename, code.co_firstlineno)

    def body(self, printed: meaning.Printed | None = None) -> Body:
        """The body of the claim, read with its own print or with another one.

        Raises ClaimError, naming the claim, where the claim function returns no body.
        """
        if printed is None or not self.printed:
            return self._own_body
        return as_body(self.read(printed), self.id)

    @property
    def is_of_package(self) -> bool:
        """Whether the claim is the paper's, and not a user's."""
        return self.source.startswith(f"{PACKAGE}.")

    @cached_property
    def _own_body(self) -> Body:
        body = as_body(self.read(self.read_print()) if self.printed else self.read(), self.id)
        if isinstance(body, CheckedApart) and not self.is_of_package:
            raise ClaimError(
                f"{self.id}: no other checker certifies a claim of one's own; state what it asserts"
            )
        return body

    def shown_beside(self) -> Assertion | None:
        """The assertion that its remark makes, if it makes one."""
        if self.remark is None or self.remark.state is None:
            return None
        return as_assertion(self.remark.state(), self.id)

    def read_print(self, latex: str = "") -> meaning.Printed:
        """The print, or another LaTeX text, as the reader reads it."""
        return meaning.read(latex or self.printed)


def place_in_file(file: str, line: int) -> str:
    """File and line, the file relative to the working directory where it is below it."""
    path = Path(file)
    shown = path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path
    return f"{one_line(str(shown))}:{line}"


def one_line(text: str) -> str:
    """The text in one line of printable characters, so that it cannot move the cursor.

    >>> one_line("a" + chr(10) + "b" + chr(27) + "c" + chr(0x202e))
    'a b\ufffdc\ufffd'
    """
    return "".join(
        each if each.isprintable() else " " if each.isspace() else "\ufffd" for each in text
    )


def as_body(returned: object, claim_id: str) -> Body:
    """The body that a claim function returned.

    Raises ClaimError, naming the claim, for any other value, and for a body that asserts nothing.
    """
    if isinstance(returned, get_args(Body)):
        body: Body = returned
        stated = assertions(body)
        if any(not one.parts for _, one in stated) or isinstance(body, Argument) and not stated:
            raise ClaimError(f"{claim_id} asserts nothing in a part; give each part a statement")
        return _printable(body)
    if isinstance(returned, (Statement, Iterates, MapRule)):
        return Assertion((returned,))
    if isinstance(returned, Iterable) and not isinstance(returned, (str, Formula)):
        parts: list[AnyStatement] = []
        for item in returned:
            part = item if isinstance(item, Statement) else as_body(item, claim_id)
            if isinstance(part, Statement):
                parts.append(part)
            elif isinstance(part, Assertion):
                parts += part.parts
        if parts:
            return Assertion(tuple(parts))
    raise ClaimError(
        f"{claim_id} returns {type(returned).__name__}; return always(...), a list of such,"
        " Readings, Argument, Following, Simulated, CheckedApart or NotFormalised"
    )


def _printable(body: Body) -> Body:
    """The body with each of its displayed texts in one line."""
    if isinstance(body, Simulated):
        return replace(body, figures=one_line(body.figures))
    if isinstance(body, NotFormalised):
        return NotFormalised(one_line(body.why))
    if isinstance(body, Readings):
        lines = {name: one_line(one.passage) for name, one in body.of.items()}
        return Readings({name: replace(one, passage=lines[name]) for name, one in body.of.items()})
    if isinstance(body, Argument):
        body = replace(body, proved_by=one_line(body.proved_by))
    if isinstance(body, (Argument, Following)):
        return replace(body, rests_on=tuple(map(one_line, body.rests_on)))
    return body


def as_assertion(returned: object, claim_id: str) -> Assertion:
    """The assertion that a function returned; raises ClaimError for any other body."""
    body = as_body(returned, claim_id)
    if not isinstance(body, Assertion):
        raise ClaimError(f"{claim_id}: {type(body).__name__} where one assertion is expected")
    return body


def assertions(body: Body) -> list[tuple[str, Assertion]]:
    """The assertions of a body with the prefix of their statements' names."""
    if isinstance(body, Assertion):
        return [("", body)]
    if isinstance(body, Readings):
        return [(f"{name}.", reading.assertion) for name, reading in body.of.items()]
    if isinstance(body, Following):
        return [("beside.", body.beside)] if body.beside else []
    if isinstance(body, (Simulated, CheckedApart, NotFormalised)):
        return []
    steps = [(f"{name}.", assertion) for name, assertion in body.steps.items()]
    return steps + ([("conclusion.", body.conclusion)] if body.conclusion else [])


def awaited(body: Body) -> tuple[str, ...]:
    """The statements of map rules, and the claim, that the verdict on a body rests on."""
    if isinstance(body, Argument):
        return (*body.rests_on, body.proved_by) if body.proved_by else body.rests_on
    return body.rests_on if isinstance(body, Following) else ()


def all_assertions(claim: Claim) -> list[tuple[str, Assertion]]:
    """The assertions of a claim and of its remark, with the prefixes of their statements' names."""
    beside = claim.shown_beside()
    return assertions(claim.body()) + ([(REMARK, beside)] if beside else [])


def stated_texts(claim: Claim) -> dict[str, str]:
    """The texts of the statements that a claim makes, by name."""
    return {
        part.name: part.text()
        for prefix, assertion in all_assertions(claim)
        for part in named_statements(claim.id, prefix, assertion)
    }


def named_statements(claim_id: str, prefix: str, assertion: Assertion) -> list[AnyStatement]:
    """The statements of an assertion under their full names ID/label; two of one label are
    numbered.
    """
    count: dict[str, int] = {}
    named: list[AnyStatement] = []
    for part in assertion.parts:
        label = part.name or "main"
        count[label] = count.get(label, 0) + 1
        label = label if count[label] == 1 else f"{label}-{count[label]}"
        if isinstance(part, SharpRange):
            raise ClaimError(
                f"{claim_id}: a sharp range is found by the program, not stated by a claim"
            )
        if isinstance(part, Statement) and part.undeclared():
            raise ClaimError(
                f"{claim_id}: undeclared symbol {sorted(part.undeclared())[0]}; add it to the"
                " statement's variables"
            )
        full = f"{claim_id}/{prefix}{label}"
        if not re.fullmatch(r"[\w.\-]+/[\w.\-]+", full, re.ASCII):
            raise ClaimError(
                f"{claim_id}: {full!r} is no name for a statement; use letters, digits, - and ."
            )
        part = replace(part, name=full)
        named.append(with_cases(part) if isinstance(part, MapRule) else part)
    return named


_registry: list[Claim] = []  # in the order of registration, since `claims_of` began
_by_module: dict[str, dict[str, Claim]] = {}  # by module and id: a module registers only once


def claim(
    id: str,
    section: str = "",
    place: str = "",
    *,
    printed: str = "",
    as_it_stands: str = "",
    repeats: str = "",
    parameters: Sequence[str] | None = None,
    derived: Callable[[], Term | Vector | Matrix] | None = None,
    mended: str = "",
    true_nearby: tuple[str, Callable[[], object]] | None = None,
    remark: Remark | None = None,
    hints: ClaimHints | None = None,
    vocabulary: Vocabulary = PLAIN,
) -> Callable[[Read], Read]:
    """Registers a function as a claim; its docstring, in our own words, is what the claim says.

    `printed` is the paper's LaTeX, typed once and judged; `as_it_stands` is what the transcription
    has where it mangles the print.  Where no change of one mark mends the print, these are tried as
    corrections: `mended`, the print with several marks changed; `derived`, the true right-hand
    side; and `true_nearby`, a true assertion near a false one, with its text.  `parameters` are the
    variables that sharp ranges are sought over, none where it is empty; without it those of the
    vocabulary, else of `forms.domains_of`.  Raises ClaimError for a duplicate name, an empty
    docstring, or a name that is not letters, digits, - and dots.
    """

    def register(read: Read) -> Read:
        if not re.fullmatch(r"[A-Za-z0-9.\-]+", id):
            raise ClaimError(f"{id!r} is no name for a claim; use letters, digits, - and .")
        if any(known.id == id for known in _registry):
            raise ClaimError(f"{id} is the name of two claims; rename one")
        says = one_line(" ".join((inspect.getdoc(read) or "").split()))
        if not says:
            raise ClaimError(f"{id} has no docstring; say in a sentence what it asserts")
        module = _module_of(read)
        made = Claim(
            id,
            " ".join(one_line(section).split()),
            " ".join(one_line(place).split()),
            says,
            read,
            "\n".join(map(one_line, printed.split("\n"))),
            one_line(as_it_stands),
            one_line(repeats),
            None if parameters is None else tuple(parameters),
            derived,
            one_line(mended),
            true_nearby and (one_line(true_nearby[0]), true_nearby[1]),
            remark
            and replace(remark, text=one_line(remark.text), by=tuple(map(one_line, remark.by))),
            hints or {},
            f"{module}.{read.__qualname__}",
            vocabulary,
        )
        _registry.append(made)
        _by_module.setdefault(module, {})[id] = made
        return read

    return register


def _module_of(read: Callable[..., object]) -> str:
    """The module of a function; empty where the function claims a module of this package, but is
    from another file.
    """
    name, code = read.__module__, getattr(read, "__code__", None)
    if name.startswith("juggleproof."):
        if code is None or getattr(sys.modules.get(name), "__file__", "") != code.co_filename:
            return ""
    return name


def claims_in(modules: Iterable[str]) -> list[Claim]:
    """The claims of modules, in the order of the modules, even if they were imported before."""
    claims: list[Claim] = []
    for name in modules:
        import_module(name)
        claims += _by_module.get(name, {}).values()
    return claims


def claims_beside(claim: Claim) -> list[Claim]:
    """The claims of the same module about the same section, this one among them."""
    module = claim.source.rpartition(".")[0]
    return [one for one in _by_module.get(module, {}).values() if one.section == claim.section]


def claims_of(load: Callable[[], object]) -> list[Claim]:
    """The claims that are registered while `load` runs, in order."""
    held, _registry[:] = list(_registry), []
    try:
        load()
        return list(_registry)
    finally:
        _registry[:] = held


def claim_named(text: str, known: Collection[str]) -> str:
    """The name of the claim that a text means; the number of an equation stands for its claim.

    >>> [claim_named(text, ["eq-37"]) for text in ("eq-37", "37", "(37)", "eq 37")]
    ['eq-37', 'eq-37', 'eq-37', 'eq-37']

    Raises ClaimError, which proposes similar names, where there is no such claim.
    """
    number = re.fullmatch(r"(?:eq(?:uation)?\.?[ -]?)?\(?(\d+[a-z]?)\)?", text.strip())
    for name in (text, f"eq-{number[1]}" if number else text):
        if name in known:
            return name
    similar = [name for name in known if text in name][:5] or get_close_matches(text, known, 3)
    hint = f"did you mean {', '.join(similar)}?" if similar else "`juggleproof list` names them"
    raise ClaimError(f"{text}: no such claim; {hint}")


# -------------------------------------------------------------------------------------------------
# The verdict on a print, from the checker's outcomes of its statements.

VERDICTS = {  # each verdict with its meaning
    "holds": "true as printed, with a certificate",
    "misprint": "false as printed, certified with some marks of the print changed",
    "false": f"{REFUTED}; where a true assertion nearby is known, it stands beside",
    "gap": f"a step of the argument is {REFUTED}; the conclusion may stand by another route",
    "ambiguous": "can be read in several ways, and not all of them are true",
    "simulated": f"what a simulation shows, with its figures; nothing is {PROVED}",
    "unknown": "open: not settled, or not stated, which says nothing",
}


@dataclass(frozen=True)
class Verdict:
    """The verdict on a print, one of `VERDICTS`, and a detail that a table can show beside it."""

    word: str
    detail: str = ""


def outcome_of(
    claim_id: str, prefix: str, assertion: Assertion, outcomes: Mapping[str, str]
) -> str:
    """The outcome of an assertion: refuted if one of its statements is, certified if all are, else
    unknown.
    """
    parts = [
        outcomes.get(part.name, "unknown") for part in named_statements(claim_id, prefix, assertion)
    ]
    if "refuted" in parts:
        return "refuted"
    return "certified" if {*parts} == {"certified"} else "unknown"


_WORD = {"certified": "holds", "refuted": "false", "unknown": "unknown"}


def verdict_of(
    claim_id: str, body: Body, outcomes: Mapping[str, str], corrected: bool = False
) -> Verdict:
    """The verdict on a claim from the outcomes of its statements and of the rules and claims that
    it awaits; `corrected` says that a corrected print has been certified.
    """

    def word(prefix: str, assertion: Assertion) -> str:
        return _WORD[outcome_of(claim_id, prefix, assertion, outcomes)]

    if isinstance(body, Assertion):
        single = word("", body)
        return Verdict("misprint" if single == "false" and corrected else single)
    if isinstance(body, Readings):
        words = {name: word(f"{name}.", one.assertion) for name, one in body.of.items()}
        detail = "; ".join(f"{name}: {one}" for name, one in words.items())
        if "unknown" in words.values():
            return Verdict("unknown", detail)
        if len(set(words.values())) != 1:
            return Verdict("ambiguous", detail)
        (common,) = set(words.values())
        return Verdict("misprint" if corrected and common != "holds" else common, detail)
    if isinstance(body, Following):
        beside = word("beside.", body.beside) if body.beside else "holds"
        rules = by_rules(body.rests_on, outcomes)
        return Verdict(
            beside if beside != "holds" else rules,
            ("by " if rules == "holds" else "awaits ") + ", ".join(body.rests_on),
        )
    if isinstance(body, Simulated):
        return Verdict("simulated", body.told)
    if isinstance(body, CheckedApart):
        return body.verdict()
    if isinstance(body, NotFormalised):
        return Verdict("unknown", NOT_FORMALISED + body.why)
    by = by_rules((body.proved_by,), outcomes), by_rules(body.rests_on, outcomes)
    return _argument(body, word, *by)


def by_rules(rests_on: Sequence[str], outcomes: Mapping[str, str]) -> str:
    """The verdict by map rules and claims: holds where all that are named are certified, else
    unknown.
    """
    return (
        "holds"
        if rests_on and all(outcomes.get(name) == "certified" for name in rests_on)
        else "unknown"
    )


def _argument(
    body: Argument, word: Callable[[str, Assertion], str], proved: str, rules: str
) -> Verdict:
    steps = {name: word(f"{name}.", step) for name, step in body.steps.items()}
    conclusion = word("conclusion.", body.conclusion) if body.conclusion else ""
    broken = [name for name, one in steps.items() if one == "false"]
    if conclusion == "false":
        return Verdict(
            "false", f"its conclusion is {REFUTED}" + (f", and step {broken[0]}" if broken else "")
        )
    if broken:
        if conclusion == "holds":
            stands = "certified"
        elif proved == "holds":
            stands = f"by {body.proved_by}"
        else:
            stands = f"by {', '.join(body.rests_on)}" if rules == "holds" else "open"
        return Verdict("gap", f"step {', '.join(broken)} is false; conclusion {stands}")
    if "unknown" in (*steps.values(), conclusion):
        return Verdict("unknown")
    if conclusion or proved == "holds":
        return Verdict("holds")
    waits = f"; awaits {body.proved_by}" if body.proved_by else ""
    return Verdict("unknown", f"conclusion open{waits}")
