"""The forms of an assertion: for all, there is, maximum, supremum, equal sets."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache

from juggleproof.certificates import checker
from juggleproof.reading.evaluation import Environment
from juggleproof.statements.definitions import Definition
from juggleproof.statements.language import (
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
# A vocabulary has what the prints leave unsaid: the standing assumption on a parameter
# (such as 0 < a < 1), the term of an abbreviation (T = 2 r/g), the radicand of a name for a square
# root.  It adds them as lines to the statement, where an auditor reads them.


@dataclass(frozen=True)
class Vocabulary:
    """The meanings that names have by default: order of variables, standing assumptions,
    abbreviations and roots.

    `domains` gives each parameter of sharp ranges, in order, the assumptions on it alone; `scales`
    has the positive variables that a change of units makes 1 (None: homogeneity decides); `sample`
    is a point at which signs of denominators are guessed; `reads` returns the environment in which
    prints are read for their correction, `introduces` the names to which the prose of a section
    gives a meaning, `assumes` what a section assumes beyond that, and `defines` the definitions of
    the statement file.
    """

    order: tuple[str, ...] = ()
    ranges: Mapping[str, tuple[Formula, ...]] = field(default_factory=dict)
    givens: Mapping[str, tuple[Formula, ...]] = field(default_factory=dict)
    abbreviations: Mapping[str, Term] = field(default_factory=dict)
    roots: Mapping[str, Term] = field(default_factory=dict)
    integers: frozenset[str] = frozenset()
    sample: Mapping[str, Fraction] = field(default_factory=dict)
    domains: Mapping[str, tuple[Formula, ...]] = field(default_factory=dict)
    scales: frozenset[str] | None = None
    reads: Callable[[], Environment] | None = None
    introduces: Callable[[str], frozenset[str]] | None = None
    assumes: Callable[[str], tuple[Formula, ...]] | None = None
    defines: Callable[[], Sequence[Definition]] | None = None


PLAIN = Vocabulary()
COMPARISONS: Mapping[str, Callable[[Fraction, Fraction], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "=": operator.eq,
    "!=": operator.ne,
}


class _Writer:
    """A writer of the lines of one statement: each line is preceded by the abbreviations, roots and
    side conditions that it needs.

    The checker's context after the lines so far is computed only where a denominator needs it.
    """

    def __init__(self, vocabulary: Vocabulary) -> None:
        self.vocabulary, self.known = vocabulary, set[str]()
        self.context = checker.Context()
        self.later: list[Callable[[checker.Context], None]] = []
        self.nonzero = set[Term]()  # terms that the lines so far are known to keep from 0
        self.lines: list[Line] = []
        self.sample = dict(vocabulary.sample)
        self.alone: dict[str, list[Formula]] = {}  # the lines about one variable only

    def declare(self, names: Sequence[str]) -> None:
        for name in names:
            self.known.add(name)
            self._declare(name, name in self.vocabulary.integers)

    def add(self, keyword: str, formula: Formula) -> None:
        self.prepare(formula)
        self.lines.append((keyword, formula))
        self._sample(formula)
        self._license(formula)

    def _sample(self, formula: Formula) -> None:
        """Gives a variable that has no sample value in the vocabulary the first value of `SAMPLES`
        that meets the lines about it alone.
        """
        names = names_in(formula)
        if len(names) == 1 and not names & set(self.vocabulary.sample):
            (name,) = names
            self.alone.setdefault(name, []).append(formula)
            for value in SAMPLES:
                if all(_meets(one, {name: value}) for one in self.alone[name]):
                    self.sample[name] = value
                    return

    def _declare(self, name: str, integer: bool = False) -> None:
        self.later.append(lambda context: context.declare(name, integer))

    def _define(self, name: str, value: Term) -> None:
        self.later.append(
            lambda context: context.define(name, context.value(checker.parse(str(value))))
        )

    def _license(self, formula: Formula) -> None:
        if formula.op in (">", "!=") and str(formula.sides[1]) == "0":
            side = formula.sides[0]
            if side.op == "var" and side.name not in self.vocabulary.abbreviations:
                self.nonzero.add(side)
        self.later.append(
            lambda context: context.license(context.formula(checker.parse(str(formula))))
        )

    def by_now(self) -> checker.Context:
        """The checker's context after the lines so far."""
        for learn in self.later:
            learn(self.context)
        self.later.clear()
        return self.context

    def prepare(self, thing: Term | Formula) -> None:
        """Adds the lines that the names and denominators of a term or formula need."""
        for name in sorted(names_in(thing) - self.known):
            if name in self.known:  # one of the others needed it, and added it
                continue
            self.known.add(name)
            if name in self.vocabulary.roots:
                under = self.vocabulary.roots[name]
                self.prepare(under)
                self.lines.append(("root", (name, under)))
                self._declare(name)
            else:
                value = self.vocabulary.abbreviations[name]
                self.prepare(value)
                self.lines.append(("let", (name, value)))
                self._define(name, value)
        for below in _denominators(thing):
            self.license(below)

    def license(self, below: Term) -> None:
        """Adds `have` lines, which the certificate must prove, for the factors of a denominator
        that no strict line makes nonzero yet.
        """
        if below.op == "num" or below in self.nonzero:
            return
        self.nonzero.add(below)  # by the lines so far, or by those that are added now
        context = self.by_now()
        try:
            context.reciprocal(checker.parse(str(below)))
            return
        except checker.Rejected:
            pass
        if below.op in ("*", "/", "^"):
            for part in below.operands:
                self.license(part)
        else:
            sign = _likely_sign(below, self.vocabulary, self.sample)
            formula = below > 0 if sign > 0 else below < 0
            self.lines.append(("have", formula))
            self._license(formula)


def _denominators(thing: Term | Formula) -> list[Term]:
    denominators: list[Term] = []
    for part in thing.args:
        if isinstance(part, (Term, Formula)):
            denominators += _denominators(part)
    if isinstance(thing, Term) and thing.op == "/":
        denominators.append(thing.operands[1])
    return denominators


SAMPLES = tuple(Fraction(p, q) for p, q in ((2, 1), (3, 11), (5, 2), (10, 1), (-1, 1), (-10, 1)))


def _meets(formula: Formula, sample: Mapping[str, Fraction]) -> bool:
    """Whether a relation holds at a sample; any other formula counts as met."""
    if formula.op == "and":
        return all(_meets(part, sample) for part in formula.parts)
    if formula.op not in COMPARISONS:
        return True
    left, right = (_evaluate(side, sample) for side in formula.sides)
    return COMPARISONS[formula.op](left, right)


def _likely_sign(value: Term, vocabulary: Vocabulary, sample: Mapping[str, Fraction]) -> int:
    """The sign of the term at the sample point, where names without a value are 2: a guess that the
    certificate of the `have` line must confirm.
    """
    for _ in range(8):
        hidden = {
            n: vocabulary.abbreviations[n] for n in names_in(value) if n in vocabulary.abbreviations
        }
        if not hidden:
            break
        value = substitute(value, hidden)
    return 1 if _evaluate(value, sample) >= 0 else -1


def _evaluate(value: Term, sample: Mapping[str, Fraction]) -> Fraction:
    if value.op == "num":
        return value.value
    if value.op == "var":
        return sample.get(value.name, Fraction(2))
    parts = [_evaluate(part, sample) for part in value.operands]
    if value.op == "^":
        return parts[0] ** value.exponent
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
    """The variables that occur, also in abbreviations, in the vocabulary's order."""
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
    """The statement that for all values of the names that occur, the standing assumptions and the
    givens imply `show`.

    `in_range` replaces the vocabulary's standing range of the parameters, which a search for a
    sharp range drops.

    >>> from juggleproof.statements.language import reals
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
    """The statement that for all values of the other names, under the assumptions, some values of
    `exists` meet `within` and `show`.
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
    """Three statements that `value` is the maximum of `of` on the region, attained at the state
    `at`: bound, member, equality.
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
    """Two statements that `value` is the supremum of `of` on the region: it is a bound (strict
    where it is not attained), and for any eps > 0 some state comes within eps.
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
    """Two statements that each region is contained in the other."""
    return [
        always(
            right, given=[*given, left], label="forth", vocabulary=vocabulary, in_range=in_range
        ),
        always(left, given=[*given, right], label="back", vocabulary=vocabulary, in_range=in_range),
    ]


# -------------------------------------------------------------------------------------------------
# The domains of parameters, read from the hypotheses of statements.


def domains_of(
    statements: Sequence[Statement], named: Sequence[str] | None = None
) -> dict[str, tuple[Formula, ...]]:
    """The parameters of a claim whose vocabulary has none, each with its domain.

    The parameters are the variables that the claim names; else those that are the only variable of
    a range line; else the only variable for which the givens say 0 < x < 1 and no more.  The domain
    has the range lines about the variable alone, or else such givens; a variable is left out where
    two statements differ in this.

    >>> from juggleproof.statements.language import reals
    >>> a, q = reals("a q")
    >>> claimed = always(a * q < 1, given=[a > 0, a < 1, q > 2, q < 3])
    >>> {name: list(map(str, domain)) for name, domain in domains_of([claimed]).items()}
    {'a': ['a > 0', 'a < 1']}
    """
    hypotheses = [(_alone(one, "range"), _alone(one, "given")) for one in statements]
    names: Sequence[str] = list(dict.fromkeys(name for ranges, _ in hypotheses for name in ranges))
    if named is not None:
        names = named
    elif not names:
        names = list(
            dict.fromkeys(
                name
                for _, givens in hypotheses
                for name, formulas in givens.items()
                if _agree([name], formulas, [f"{name} > 0", f"{name} < 1"])
            )
        )
        names = names if len(names) == 1 else []
    domains: dict[str, tuple[Formula, ...]] = {}
    for name in names:
        texts: dict[tuple[str, ...], tuple[Formula, ...]] = {}
        for kind in (0, 1):
            for both in hypotheses if not texts else ():
                if name in both[kind]:
                    texts[tuple(map(str, both[kind][name]))] = both[kind][name]
        if len(texts) == 1:
            (domains[name],) = texts.values()
    return domains


def _alone(statement: Statement, keyword: str) -> dict[str, tuple[Formula, ...]]:
    """The formulas of the lines with this keyword in one variable only, by variable, in order."""
    alone: dict[str, tuple[Formula, ...]] = {}
    for kind, formula in statement.lines:
        if kind == keyword and isinstance(formula, Formula):
            names = _names_of(str(formula))
            if len(names) == 1 and names <= set(statement.forall):
                (name,) = names
                alone[name] = (*alone.get(name, ()), formula)
    return {name: alone[name] for name in statement.forall if name in alone}


def speaks_of_range(statement: Statement, domains: Mapping[str, tuple[Formula, ...]]) -> bool:
    """Whether a statement is about a range of parameters: it has range lines, or its givens state
    exactly the domain of the first parameter.
    """
    if any(keyword == "range" for keyword, _ in statement.lines):
        return True
    first = next(iter(domains), "")
    given = _alone(statement, "given").get(first, ())
    return bool(given) and _agree(statement.forall, given, domains[first])


def has_whole_range(statement: Statement, domains: Mapping[str, tuple[Formula, ...]]) -> bool:
    """Whether the range lines are equivalent, atom by atom, to the domains of the statement's
    parameters, apart from conditions that are givens.
    """
    given = {str(line) for keyword, line in statement.lines if keyword == "given"}
    whole = [
        formula
        for name in statement.forall
        for formula in domains.get(name, ())
        if str(formula) not in given
    ]
    ranges = [line for keyword, line in statement.lines if keyword == "range"]
    return _agree(statement.forall, ranges, whole)


def _agree(variables: Sequence[str], left: Sequence[object], right: Sequence[object]) -> bool:
    return _texts_agree(tuple(variables), tuple(map(str, left)), tuple(map(str, right)))


@cache
def _names_of(text: str) -> set[str]:
    return {node.id for node in ast.walk(checker.parse(text)) if isinstance(node, ast.Name)}


@cache
def _texts_agree(variables: tuple[str, ...], left: tuple[str, ...], right: tuple[str, ...]) -> bool:
    context = checker.Context()
    for name in variables:
        context.declare(name)
    return _atoms(context, [checker.parse(text) for text in left]) == _atoms(
        context, [checker.parse(text) for text in right]
    )


def _atoms(context: checker.Context, trees: list[ast.expr]) -> set[Hashable]:
    """The parts of a conjunction: an atom as its primitive polynomial and relation, any other part
    as its text.
    """
    joined = checker.join("and", [context.formula(tree) for tree in trees])
    parts = [joined] if isinstance(joined, bool) or joined[0] != "and" else joined[1]
    atoms: set[Hashable] = set()
    for part in parts:
        if isinstance(part, bool) or part[0] != "atom":
            atoms.add(repr(part))
        else:
            content, primitive = part[1].primitive()
            atoms.add((tuple(sorted(primitive.terms.items())), content > 0, part[2]))
    return atoms
