"""For all, there is, maximum, supremum, equal sets."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache
from typing import Any

from juggleproof.certificates import checker
from juggleproof.certificates.language import (
    ClaimError,
    Formula,
    Line,
    Number,
    Statement,
    Term,
    equal,
    names_in,
    real,
    substitute,
    term,
)

# -------------------------------------------------------------------------------------------------
# The forms that an assertion takes: for all, there is, maximum, supremum, equal sets; each makes
# plain statements.
#
# A vocabulary says what is understood without being said: the standing assumption on a parameter (0
# <
# alpha < 1), what an abbreviation stands for (T = 2 r/g) and which square root a name is.  The
# lines
# it adds stand in the statement, where an auditor reads them.


@dataclass(frozen=True)
class Vocabulary:
    """What names mean where nothing is said: order of variables, standing assumptions,
    abbreviations and roots.
    """

    order: tuple[str, ...] = ()
    ranges: Mapping[str, tuple[Formula, ...]] = field(default_factory=dict)
    givens: Mapping[str, tuple[Formula, ...]] = field(default_factory=dict)
    abbreviations: Mapping[str, Term] = field(default_factory=dict)
    roots: Mapping[str, Term] = field(default_factory=dict)
    integers: frozenset[str] = frozenset()
    sample: Mapping[str, Fraction] = field(
        default_factory=lambda: {"alpha": Fraction(3, 11), "r": Fraction(1), "g": Fraction(1)}
    )


PLAIN = Vocabulary()


class _Writer:
    """Collects the lines of one statement: each line is preceded by the abbreviations, roots and
    side conditions that it needs.

    What the checker would know by then is worked out only where a denominator asks for it.
    """

    def __init__(self, vocabulary: Vocabulary) -> None:
        self.vocabulary, self.known = vocabulary, set[str]()
        self.context = checker.Context()
        self.later: list[Callable[[checker.Context], None]] = []
        self.lines: list[Line] = []

    def declare(self, names: Sequence[str]) -> None:
        for name in names:
            self.known.add(name)
            self.later.append(
                lambda context, name=name: context.declare(name, name in self.vocabulary.integers)  # type: ignore[misc]
            )

    def add(self, keyword: str, formula: Formula) -> None:
        self.prepare(formula)
        self.lines.append((keyword, formula))
        self.later.append(
            lambda context: context.license(context.formula(checker.parse(str(formula))))
        )

    def by_now(self) -> checker.Context:
        """What the checker knows after the lines so far."""
        for learn in self.later:
            learn(self.context)
        self.later.clear()
        return self.context

    def prepare(self, thing: Term | Formula) -> None:
        """Adds the lines that the names and denominators of a term or formula need."""
        for name in sorted(names_in(thing) - self.known):
            if name in self.known:  # an abbreviation before it is written with this one
                continue
            self.known.add(name)
            if name in self.vocabulary.roots:
                under = self.vocabulary.roots[name]
                self.prepare(under)
                self.lines.append(("root", (name, under)))
                self.later.append(lambda context, name=name: context.declare(name))  # type: ignore[misc]
            else:
                value = self.vocabulary.abbreviations[name]
                self.prepare(value)
                self.lines.append(("let", (name, value)))
                self.later.append(
                    lambda context, name=name, value=value: (  # type: ignore[misc]
                        context.define(name, context.value(checker.parse(str(value))))
                    )
                )
        for below in _denominators(thing):
            self.license(below)

    def license(self, below: Term) -> None:
        """A denominator that no strict line makes nonzero yet gets a `have` line, factor by factor,
        which the certificate must prove.
        """
        if below.op == "num":
            return
        context = self.by_now()
        try:
            context.reciprocal(checker.parse(str(below)))
            return
        except checker.Rejected:
            pass
        if below.op in ("*", "/"):
            self.license(below.args[0])
            self.license(below.args[1])
        elif below.op == "^":
            self.license(below.args[0])
        else:
            sign = _likely_sign(below, self.vocabulary)
            formula = below > 0 if sign > 0 else below < 0
            self.lines.append(("have", formula))
            self.later.append(
                lambda context: context.license(context.formula(checker.parse(str(formula))))
            )


def _denominators(thing: Term | Formula) -> list[Term]:
    found: list[Term] = []
    for part in thing.args:
        if isinstance(part, (Term, Formula)):
            found += _denominators(part)
    if isinstance(thing, Term) and thing.op == "/":
        found.append(thing.args[1])
    return found


def _likely_sign(value: Term, vocabulary: Vocabulary) -> int:
    """The sign at the vocabulary's sample point, 2 for names that it lacks: a guess that the
    certificate of the `have` line has to confirm.
    """
    for _ in range(8):
        hidden = {
            n: vocabulary.abbreviations[n] for n in names_in(value) if n in vocabulary.abbreviations
        }
        if not hidden:
            break
        value = substitute(value, hidden)
    return 1 if _evaluate(value, vocabulary.sample) >= 0 else -1


def _evaluate(value: Term, sample: Mapping[str, Fraction]) -> Fraction:
    if value.op == "num":
        return Fraction(value.args[0])
    if value.op == "var":
        return sample.get(str(value.args[0]), Fraction(2))
    parts = [_evaluate(part, sample) for part in value.args if isinstance(part, Term)]
    if value.op == "^":
        return parts[0] ** int(value.args[1])
    if value.op == "neg":
        return -parts[0]
    if value.op == "/":
        return parts[0] / parts[1] if parts[1] else Fraction(0)
    return (
        parts[0] + parts[1]
        if value.op == "+"
        else parts[0] - parts[1]
        if value.op == "-"
        else parts[0] * parts[1]
    )


def _needed(
    formulas: Sequence[Term | Formula], vocabulary: Vocabulary, exists: Sequence[str]
) -> list[str]:
    """The variables that occur, abbreviations opened, in the vocabulary's order."""
    names: set[str] = set()
    work = set().union(*(names_in(formula) for formula in formulas))
    while work:
        name = work.pop()
        if name in names:
            continue
        names.add(name)
        for table in (vocabulary.abbreviations, vocabulary.roots):
            if name in table:
                work |= names_in(table[name])
        for assumption in (*vocabulary.ranges.get(name, ()), *vocabulary.givens.get(name, ())):
            work |= names_in(assumption)
    variables = names - set(vocabulary.abbreviations) - set(vocabulary.roots) - set(exists)
    place = {name: index for index, name in enumerate(vocabulary.order)}
    return sorted(variables, key=lambda name: (place.get(name, len(place)), name))


def always(
    show: Formula,
    *,
    given: Sequence[Formula] = (),
    in_range: Sequence[Formula] | None = None,
    label: str = "main",
    vocabulary: Vocabulary = PLAIN,
) -> Statement:
    """For all values of the names that occur: the standing assumptions and the givens imply what is
    shown.

    `in_range` replaces the vocabulary's standing range of the parameters; it is what a sharp range
    leaves open.

    >>> from juggleproof.certificates.language import reals
    >>> x, y = reals("x y")
    >>> print(always(x / y > 0, given=[x > 0, y > 0]).text())
    statement main
    forall x y
    given x > 0
    given y > 0
    show x/y > 0
    """
    return exists_some((), show, given=given, in_range=in_range, label=label, vocabulary=vocabulary)


def exists_some(
    exists: Sequence[str],
    show: Formula,
    *,
    within: Sequence[Formula] = (),
    given: Sequence[Formula] = (),
    in_range: Sequence[Formula] | None = None,
    label: str = "main",
    vocabulary: Vocabulary = PLAIN,
) -> Statement:
    """For all values of the other names, under the assumptions, some values of `exists` meet
    `within` and what is shown.
    """
    if isinstance(exists, str) or not all(isinstance(name, str) for name in exists):
        raise ClaimError(
            f'{exists!r} is no list of names; write what exists as names, such as ["x"]'
        )
    for formula in (*given, *within, show, *(in_range or ())):
        if not isinstance(formula, Formula):
            raise ClaimError(
                f"{formula!r} is not a formula; compare two terms with <, <=, >, >= or equal(a, b)"
            )
    forall = _needed([*given, *within, show, *(in_range or ())], vocabulary, exists)
    writer = _Writer(vocabulary)
    writer.declare(forall)
    standing = (
        [f for name in forall for f in vocabulary.ranges.get(name, ())]
        if in_range is None
        else list(in_range)
    )
    for formula in standing:
        writer.add("range", formula)
    for name in forall:
        for formula in vocabulary.givens.get(name, ()):
            writer.add("given", formula)
    for formula in given:
        writer.add("given", formula)
    count = len(writer.lines)
    if exists:
        for thing in (*within, show):
            for name in sorted(names_in(thing) - set(exists)):
                writer.prepare(real(name))
            for below in _denominators(thing):
                if not names_in(below) & set(exists):
                    writer.prepare(below)
                    writer.license(below)
        count = len(writer.lines)
        writer.declare(exists)
        for formula in within:
            writer.add("with", formula)
    writer.prepare(show)
    lines, inner = (
        writer.lines[:count] if exists else writer.lines,
        writer.lines[count:] if exists else [],
    )
    if any(keyword in ("have", "root") for keyword, _ in inner):
        raise ClaimError(
            f"{label}: a division or root behind `exists` needs a strict `within` formula before it"
        )
    integers = tuple(name for name in forall if name in vocabulary.integers)
    return Statement(
        label, tuple(forall), tuple(lines), show, integers, tuple(exists), tuple(inner)
    )


def is_maximum(
    value: Term,
    of: Term,
    state: Mapping[str, Term],
    at: Mapping[str, Number],
    on: Formula,
    *,
    vocabulary: Vocabulary = PLAIN,
    given: Sequence[Formula] = (),
    in_range: Sequence[Formula] | None = None,
) -> list[Statement]:
    """`value` is the maximum of `of` on the region, attained at the state `at`: bound, member,
    equality.
    """
    there = {name: term(place) for name, place in at.items()}
    if set(there) != set(state):
        raise ClaimError("a maximum is attained at a whole state; give every component")
    return [
        always(
            of <= value, label="bound", vocabulary=vocabulary, in_range=in_range, given=[*given, on]
        ),
        always(
            substitute(on, there),
            label="member",
            vocabulary=vocabulary,
            in_range=in_range,
            given=given,
        ),
        always(
            equal(substitute(of, there), value),
            label="attained",
            vocabulary=vocabulary,
            in_range=in_range,
            given=given,
        ),
    ]


def is_supremum(
    value: Term,
    of: Term,
    state: Sequence[str],
    on: Formula,
    *,
    strict: bool = False,
    vocabulary: Vocabulary = PLAIN,
    given: Sequence[Formula] = (),
    in_range: Sequence[Formula] | None = None,
) -> list[Statement]:
    """`value` is the supremum of `of` on the region: a bound (strict where it is not attained), and
    states that come within any eps > 0.
    """
    eps = real("eps")
    bound = of < value if strict else of <= value
    return [
        always(bound, label="bound", vocabulary=vocabulary, in_range=in_range, given=[*given, on]),
        exists_some(
            state,
            of > value - eps,
            within=[on],
            label="approached",
            vocabulary=vocabulary,
            in_range=in_range,
            given=[*given, eps > 0],
        ),
    ]


def same_set(
    left: Formula,
    right: Formula,
    *,
    vocabulary: Vocabulary = PLAIN,
    given: Sequence[Formula] = (),
    in_range: Sequence[Formula] | None = None,
) -> list[Statement]:
    """The two regions have the same states: two inclusions."""
    return [
        always(
            right, given=[*given, left], label="forth", vocabulary=vocabulary, in_range=in_range
        ),
        always(left, given=[*given, right], label="back", vocabulary=vocabulary, in_range=in_range),
    ]


# -------------------------------------------------------------------------------------------------
# What the hypotheses of a statement say: the whole range of alpha, or a part of it.


def read(text: str, name: str) -> checker.Statement:
    """The statement as the checker reads it."""
    statement: checker.Statement = checker.read_statements(text)[name]
    return statement


def speaks_of_range(statement: Statement) -> bool:
    """Whether a statement is about a range of alpha: by range lines, or by givens that say 0 <
    alpha < 1.
    """
    if any(keyword == "range" for keyword, _ in statement.lines):
        return True
    given = [
        ("range", said)
        for keyword, said in statement.lines
        if keyword == "given" and _names_of(str(said)) == {"alpha"}
    ]
    return bool(given) and has_whole_range(replace(statement, lines=tuple(given)))


def has_whole_range(statement: Statement) -> bool:
    """Whether the range lines say 0 < alpha < 1 and nothing else, however they are written."""
    return _is_whole_range(
        statement.forall,
        tuple(str(formula) for keyword, formula in statement.lines if keyword == "range"),
    )


@cache
def _names_of(text: str) -> set[str]:
    return {node.id for node in ast.walk(checker.parse(text)) if isinstance(node, ast.Name)}


@cache
def _is_whole_range(variables: tuple[str, ...], said: tuple[str, ...]) -> bool:
    context = checker.Context()
    for name in variables:
        context.declare(name)
    whole = ["alpha > 0", "alpha < 1"] if "alpha" in variables else []
    return _atoms(context, [checker.parse(text) for text in said]) == _atoms(
        context, [checker.parse(text) for text in whole]
    )


def _atoms(context: checker.Context, trees: list[Any]) -> set[Any]:
    """The atoms of a conjunction, each as its primitive polynomial and relation; anything else as
    itself.
    """
    joined = checker.join("and", [context.formula(tree) for tree in trees])
    parts = [joined] if isinstance(joined, bool) or joined[0] != "and" else joined[1]
    found: set[Any] = set()
    for part in parts:
        if isinstance(part, bool) or part[0] != "atom":
            found.add(repr(part))
        else:
            content, primitive = part[1].primitive()
            found.add((tuple(sorted(primitive.terms.items())), content > 0, part[2]))
    return found
