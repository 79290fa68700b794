"""The rules for orbits of maps in words: the lines of each, what it concludes, what its premises
mean, and why one of them has no proof.

A rule of the checker has one row in `RULES`, and a premise one in that.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from difflib import get_close_matches
from fractions import Fraction
from typing import NamedTuple

from juggleproof.certificates import checker
from juggleproof.certificates.algebra.numbers import AlgebraicNumber
from juggleproof.certificates.definitions import formula_of, term_of
from juggleproof.certificates.language import (
    ClaimError,
    MapRule,
    bounds_of,
    interval_text,
)
from juggleproof.certificates.votes.vote import Vote
from juggleproof.certificates.votes.z3 import Model
from juggleproof.proofs.evaluating import Ends, ends_of, is_surely

# -------------------------------------------------------------------------------------------------
# What a rule concludes, with the numbers of the statement.


AROUND = ("contraction", "lyapunov", "attraction")  # lines that name what holds around a point
LONGEST_SET = 60  # characters of a set that is written in a conclusion
ALWAYS = ("0 < 1", "0 = 0")  # what is written where nothing is asked


class Lines:
    """The lines of the statement of this name, and of those that it names."""

    def __init__(self, name: str, texts: Mapping[str, str]) -> None:
        self.texts = texts
        self.rows = [row.partition(" ")[::2] for row in texts[name].splitlines()[1:]]

    def all(self, keyword: str) -> list[str]:
        """What stands on each line of this keyword."""
        return [text for key, text in self.rows if key == keyword]

    def one(self, keyword: str) -> str:
        """What stands on the one line of this keyword."""
        (text,) = self.all(keyword)
        return text

    def named(self, keyword: str) -> Lines:
        """The statement that the line of this keyword names."""
        return Lines(self.one(keyword), self.texts)

    def for_domain(self) -> str:
        """For which parameters a conclusion holds; nothing where there are none."""
        names = self.of_map().one("over").split()
        domain = self.one("domain")
        with_domain = "" if domain in ALWAYS else f" with {domain}"
        every = self.intervals() or f"all {', '.join(names)}{with_domain}"
        whole = [name for line in self.of_map().all("integer") for name in line.split()]
        return f"for {every}{''.join(f', {n} an integer' for n in whole)}: " if names else ""

    def of_map(self) -> Lines:
        """The map or relation that the statement is about, or is."""
        keyword = next((key for key, _ in self.rows if key in ("map", "relation", "descent")), "")
        return self.named(keyword).of_map() if keyword else self

    def around(self) -> Lines:
        """What an attraction rests on around its point."""
        keyword = next(key for key, _ in self.rows if key in AROUND)
        inner = self.named(keyword)
        return inner.around() if keyword == "attraction" else inner

    def intervals(self) -> str:
        """The domain, where each condition is on one parameter alone and linear; else nothing."""
        names, text = self.of_map().one("over").split(), self.one("domain")
        tree = checker.parse(text)
        parts = tree.values if isinstance(tree, ast.BoolOp) else [tree]
        alone = all(len(checker.names_in(ast.unparse(part))) == 1 for part in parts)
        bounds = [bounds_of(text, name) for name in names]
        if not alone or None in bounds:
            return ""
        return ", ".join(interval_text(name, *(ends or ())) for name, ends in zip(names, bounds))

    def roots(self) -> list[str]:
        """The root lines of this statement, and of those that it rests on."""
        inner = [
            root
            for key, name in self.rows
            if key in checker.NAMED
            for root in Lines(name, self.texts).roots()
        ]
        return [*dict.fromkeys([*inner, *self.all("root")])]

    def point(self) -> str:
        """The point, as e."""
        return f"e = {_vector(self.one('point'))}"


def _set(called: str, condition: str) -> str:
    if condition in ALWAYS:
        return f"{called} of all states"
    return f"{called} {{{condition}}}" if len(condition) <= LONGEST_SET else called


def _where(guard: str) -> str:
    return "" if guard in ("", *ALWAYS) else f" where {guard}"


def _terms(text: str) -> list[str]:
    tree = checker.parse(text)
    parts = tree.elts if isinstance(tree, ast.Tuple) else [tree]
    return [str(term_of(part)) for part in parts]


def _vector(terms: str) -> str:
    return f"({terms})" if "," in terms else terms


def _factor(text: str) -> str:
    return text if re.fullmatch(r"\w+", text) else f"({text})"


def _steps(descent: Lines) -> str:
    """The numbers N of steps after which the orbit of s is in the trap."""
    if len(_terms(descent.all("rank")[0].rpartition(" -> ")[2])) > 1:
        return "N that is large enough for s"
    more = len(descent.all("stage")) - 1
    return "N >= rank(s)" + (f" + {more}" if more else "")


def _rank(descent: Lines) -> str:
    return f"where rank = {_greatest(descent.all('rank'))}"


def _greatest(rows: Sequence[str]) -> str:
    """The greatest of the terms of lines, some with a guard."""
    each = [row.rpartition(" -> ")[::2] for row in rows]
    terms = [_vector(term) + (f" where {guard}" if guard else "") for guard, term in each]
    return f"the greatest of {'; '.join(terms)}" if len(terms) > 1 else terms[0]


def _power(contraction: Lines, exponent: str) -> str:
    return f"{_factor(contraction.one('rate'))}^{exponent}"


def _bound(contraction: Lines, exponent: str) -> str:
    size = contraction.one("size")
    return _power(contraction, exponent) + ("" if size == "1" else f" {_factor(size)}")


def _norm(contraction: Lines) -> str:
    names = contraction.of_map().one("state").split()
    parts = []
    for name, weight in zip(names, _terms(contraction.one("weights"))):
        apart = f"|{name} - e_{name}|" if len(names) > 1 else f"|{name} - e|"
        parts.append(apart + ("" if weight == "1" else f"/{_factor(weight)}"))
    return "|s - e| = " + (f"max({', '.join(parts)})" if len(parts) > 1 else parts[0])


def _of_iterates(f: Lines) -> str:
    (state, images), (count, powers) = (
        (", ".join(_terms(side)) for side in f.one(keyword).split(" -> "))
        for keyword in ("iterates", "after")
    )
    return (
        f"f^{count}({state}) = {_vector(powers)} for every integer {count} >= 0, where"
        f" f({state}) = {_vector(images)}"
    )


def _of_map(f: Lines) -> str:
    state = ", ".join(f.one("state").split())
    pieces = [piece.split(" -> ") for piece in f.all("piece")]
    images = [f"f({state}) = {_vector(image)}{_where(guard)}" for guard, image in pieces]
    return (
        f"{f.for_domain()}f maps {_set('the space', f.one('space'))} into itself, and exactly"
        f" one piece applies at each of its states: {'; '.join(images)}"
    )


def _of_relation(f: Lines) -> str:
    state = ", ".join(f.one("state").split())
    inputs = f", for all {', '.join(f.one('input').split())}" if f.one("input") else ""
    pieces = [piece.split(" -> ") for piece in f.all("piece")]
    images = [f"{_vector(image)}{_where(guard)}" for guard, image in pieces]
    return (
        f"{f.for_domain()}each state {state} of {_set('the space', f.one('space'))} has a next"
        f" state, and all next states are in it: {'; '.join(images)}{inputs}"
    )


def _of_descent(f: Lines) -> str:
    trap = _set("the last stage", f.all("stage")[-1])
    return (
        f"{f.for_domain()}f^N(s) is in {trap} for every state s of the space and every integer"
        f" {_steps(f)}, {_rank(f)}"
    )


def _of_contraction(f: Lines) -> str:
    return (
        f"{f.for_domain()}{f.point()} is a fixed point, is stable, and attracts"
        f" {_set('the set `on`', f.one('on'))}: |f^n(s) - e| <= {_power(f, 'n')} |s - e| <="
        f" {_bound(f, 'n')} for every state s of the space in the set and every integer n >= 0,"
        f" where {_norm(f)}; f takes the set into itself, and all states of the space with |s - e|"
        f" <= {f.one('radius')} are in it"
    )


def _value_of(f: Lines) -> str:
    """The greatest of the terms `value`, and what their names of the point mean."""
    state = f.of_map().one("state").split()
    points = {name: f"e_{name}" if len(state) > 1 else "e" for name in state}
    meanings = {f"{name}_gap": f"{name} - {point}" for name, point in points.items()}
    meanings |= {f"{name}_point": point for name, point in points.items()}
    names = [
        f"{name} = {meaning}"
        for name, meaning in meanings.items()
        if name in checker.names_in(*f.all("value"))
    ]
    return ", ".join([_greatest(f.all("value")), *names])


def _of_lyapunov(f: Lines) -> str:
    return (
        f"{f.for_domain()}{f.point()} is a fixed point, is stable, and attracts"
        f" {_set('the set `on`', f.one('on'))}, which f takes into itself:"
        f" V(f^(n + 1)(s)) <= V(f^n(s)), and |f^n(s) - e| >= distance for at most V(s)/least"
        f" integers n >= 0, for every state s of the space in the set and every distance > 0,"
        f" where V(s) = {_value_of(f)}; least = {f.one('least')} with level = V(s); {LARGEST};"
        f" all states of the space with |s - e| <= {f.one('radius')} are in the set"
    )


LARGEST = "|s - e| is the largest of all |s_j - e_j|"


def _of_instability(f: Lines) -> str:
    radius = f.one("radius")
    return (
        f"{f.for_domain()}{f.point()} is not stable: for 0 < distance <= {radius} the state s ="
        f" {_vector(f.one('direction'))} has |s - e| <= distance, and |f^n(s) - e| > {radius} for"
        f" some integer n >= 0, where {LARGEST}"
    )


def _of_attraction(f: Lines) -> str:
    descent, inner = f.named("descent"), f.around()
    start = f"{descent.for_domain()}{inner.point()} is stable and attracts every state"
    if not inner.all("weights"):
        return f"{start} of the space"
    return (
        f"{start} s of the space: |f^(N + k)(s) - e| <= {_bound(inner, 'k')} for all integers"
        f" k >= 0 and {_steps(descent)}, {_rank(descent)}, {_norm(inner)}"
    )


def _of_attraction_into(f: Lines) -> str:
    descent = f.named("descent")
    return (
        f"{descent.for_domain()}{f.around().point()} is a fixed point, is stable, and attracts"
        f" every state of {_set('the space', descent.of_map().one('space'))}"
    )


def _of_escape(f: Lines) -> str:
    word = f.one("word").split()
    return (
        f"{f.for_domain()}the orbit of {_vector(f.one('start'))} is back after"
        f" {len(word)} step{'s' * (len(word) > 1)}, by the pieces {', '.join(word)}, and does not"
        f" tend to {f.point()}"
    )


def _of_sharpness(f: Lines) -> str:
    descent = f.named("attraction").named("descent")
    whole = descent.of_map()
    return (
        f"{whole.for_domain()}{f.around().point()} is stable and attracts every state of the"
        f" space if and only if {descent.intervals() or descent.one('domain')}"
    )


def _of_settling(f: Lines) -> str:
    ends = [Lines(name, f.texts) for name in f.all("contraction")]
    points = [f"e_{k} = {_vector(end.one('point'))}" for k, end in enumerate(ends, 1)]
    to, each = (f"one of {', '.join(points)}", "each") if len(ends) > 1 else (ends[0].point(), "e")
    return (
        f"{f.named('descent').for_domain()}f^n(s) tends to {to} for every state s of the space,"
        f" and {each} is stable"
    )


def _of_return(f: Lines) -> str:
    settling = f.named("settling")
    names, starts = settling.all("contraction"), settling.all("word")[len(settling.all("rank")) :]
    points = []
    for k, (name, start) in enumerate(zip(names, starts), 1):
        steps = len(f.all("word")[int(start.split()[0]) - 1].split())
        e = f"e_{k}" if len(names) > 1 else "e"
        back = f" = f^{steps}({e})" if steps > 1 else f" = f({e})"
        points.append(f"{e} = {_vector(Lines(name, f.texts).one('point'))}{back}")
    to = f"one of {', '.join(points)}" if len(points) > 1 else points[0]
    return (
        f"{settling.named('descent').for_domain()}every orbit tends to that of {to}:"
        " f^(N + n)(s) - f^n(e) tends to 0, for every state s of the space, with such an e and an"
        " integer N >= 0; and each such orbit is stable: |f^n(s) - f^n(e)| is small for all n >= 0"
        " where |s - e| is"
    )


# -------------------------------------------------------------------------------------------------
# The table of the rules.


class Rule(NamedTuple):
    """A rule of the checker: the order of its lines, as the checker has it; what it concludes; and
    what each premise means, by its name without numbers, for which {0}, {1} stand.
    """

    lines: str
    concludes: Callable[[Lines], str]
    premises: Mapping[str, str]


OF_DOMAIN = {
    "possible": "some parameters of the domain have a state in the space",
    "inside": "the domain is part of the map's domain",
}
OF_POINT = "the point is in the space, and what the lines `have` say of it is so"
RULES = {
    "iterates": Rule(
        "forall integer (let )*iterates after ",
        _of_iterates,
        {
            "start": "the state after 0 steps is the state",
            "step": "the map takes the state after K steps to that after K + 1",
        },
    ),
    "map": Rule(
        "over (integer )?domain state space (piece )+",
        _of_map,
        {
            "possible": OF_DOMAIN["possible"],
            "covers": "the guard of some piece holds at each state of the space",
            "apart": "the guards of pieces {1} and {0} do not overlap",
            "stays": "piece {0} takes the space into itself",
        },
    ),
    "relation": Rule(
        "over (integer )?domain state input space (piece )+",
        _of_relation,
        {
            "possible": OF_DOMAIN["possible"],
            "covers": "the guard of some piece holds at each state of the space, for some inputs",
            "stays": "piece {0} takes the space into itself, for all inputs",
        },
    ),
    "descends": Rule(
        "(map|relation) domain (root )*(rank )+(stage )+",
        _of_descent,
        {
            **OF_DOMAIN,
            "bounded": "the rank is at least 0 on the space",
            "falls": "the rank falls by 1 at least where piece {0} applies, outside of all stages",
            "stage": "piece {1} takes stage {0} into the next stage, or the last one into itself",
        },
    ),
    "contracts": Rule(
        "(map|relation) domain (root )*on point weights rate radius size ",
        _of_contraction,
        {
            **OF_DOMAIN,
            "constants": "0 <= rate < 1, and weights, radius and size are positive",
            "point": "the point is in the space",
            "surrounds": "all states of the space within the radius of the point are in the set",
            "size": "all states of the set are within the size of the point",
            "stays": "piece {0} takes the set into itself",
            "closer": "on the set, piece {0} multiplies distances from the point by at most the"
            " rate",
        },
    ),
    "lyapunov": Rule(
        "(map|relation) domain (root )*on point (have )*(value )+loss least upper radius ",
        _of_lyapunov,
        {
            **OF_DOMAIN,
            "constants": "radius and upper are positive",
            "positive": "least is positive where distance > 0 and level >= 0",
            "point": OF_POINT,
            "surrounds": "all states of the space within the radius of the point are in the set",
            "bounded": "V is at least 0 on the set",
            "loss": "the loss is at least 0 on the set",
            "least": "on the set, the loss is at least `least` of the distance and of V",
            "small": "term {0} of V is at most upper times the distance, within the radius",
            "stays": "piece {0} takes the set into itself",
            "falls": "on the set, piece {0} takes term {1} of V to at most V less the loss",
        },
    ),
    "unstable": Rule(
        "map domain (root )*point direction (have )*(value )+rate radius upper ",
        _of_instability,
        {
            **OF_DOMAIN,
            "constants": "rate > 1, and radius and upper are positive",
            "point": OF_POINT,
            "direction": "for 0 < distance <= radius the direction is a state of the space within"
            " the distance of the point, and the value is positive there",
            "bounded": "where term {0} of the value is positive, within the radius, it is at most"
            " upper",
            "grows": "where term {1} of the value is positive, within the radius, piece {0} takes"
            " the value to at least rate times the term",
        },
    ),
    "attracts": Rule(
        "descent (contraction|lyapunov) ",
        _of_attraction,
        {
            "inside": "the domain of the descent is part of that of the other rule",
            "enters": "the last stage of the descent lies in the set `on` of the other rule",
        },
    ),
    "into": Rule(
        "descent attraction radius ",
        _of_attraction_into,
        {
            "inside": "the domain of the descent is part of that of the attraction",
            "constants": "the radius is positive",
            "point": "the point is in the space of the descent",
            "surrounds": "all states within the radius of the point are in the space of the"
            " attraction",
            "enters": "the last stage of the descent lies in the space of the attraction",
        },
    ),
    "escapes": Rule(
        "map domain (root )*point start word ",
        _of_escape,
        {
            **OF_DOMAIN,
            "start": "the start is in the space and not the point, and the pieces of the word apply"
            " in turn and lead back to it",
        },
    ),
    "exactly": Rule(
        "attraction (escape |unstable )+",
        _of_sharpness,
        {
            "covers": "the domains of the rules make up the map's domain",
            "same-point": "the attraction and refutation {0} are about the same point",
        },
    ),
    "settles": Rule(
        "descent (never )*(rank word )*(contraction word )+",
        _of_settling,
        {
            "never": "no state of the last stage follows word {0} of those that none follows",
            "falls": "a state of the last stage that follows word {0} of those with a rank has a"
            " rank that is not below 0, and falls by 1 or more along the word",
            "inside": "the domain of the descent is part of that of contraction {0}",
            "ends": "a state of the last stage that follows the word of contraction {0} is in its"
            " set `on`",
        },
    ),
    "returns": Rule(
        "map settling (word )+",
        _of_return,
        {
            "inside": "the domain of the descent is part of that of the map",
            "word": "where piece {0} of the other map applies, so do the pieces of its word, one"
            " after the other, and they lead to the same state",
            "piece": "on the set `on` of contraction {0} one piece of the other map applies, the"
            " first of the contraction's word",
        },
    ),
}


def conclusion(kind: str, name: str, texts: Mapping[str, str]) -> str:
    """What the rule of this kind and name concludes, from its text and those that it rests on.

    >>> text = "statement t/sum\\nforall x K\\ninteger K\\niterates x -> x + 2\\nafter K -> x + 2*K"
    >>> conclusion("iterates", "t/sum", {"t/sum": text})
    'f^K(x) = x + 2*K for every integer K >= 0, where f(x) = x + 2'
    """
    lines = Lines(name, texts)
    said = RULES[kind].concludes(lines)
    if kind != "relation" and any(key == "input" for key, _ in lines.of_map().rows):
        said += "; f^n(s) is any state that the relation leads to from s in n steps"
    for root in reversed(lines.roots()):  # a root may be of one above it
        if root.partition(" = ")[0] in checker.names_in(said):
            said += f"; {root}"
    return said


def meaning(kind: str, premise: str) -> str:
    """What a premise of a rule of this kind means.

    >>> meaning("descends", "stage-2-1")
    'piece 1 takes stage 2 into the next stage, or the last one into itself'
    """
    name = re.sub(r"(-\d+)+$", "", premise)
    return RULES[kind].premises[name].format(*re.findall(r"-(\d+)", premise))


# -------------------------------------------------------------------------------------------------
# Lines that make no rule.


def read_rule(rule: MapRule) -> checker.Statement:
    """The rule as the checker reads it.

    Raises ClaimError, which names the line and what is wanted, where it cannot.
    """
    try:
        keywords = [keyword for keyword, _ in rule.lines]
    except (TypeError, ValueError):
        raise ClaimError(f"{rule.name}: each line of a rule is a pair (keyword, text)") from None
    fault = _fault(keywords)
    if fault:
        raise ClaimError(f"{rule.name}: {fault}")
    try:
        return checker.read_statements(rule.text())[rule.name]
    except checker.Rejected as reason:
        count = re.search(r"line (\d+)$", reason.place)
        at = int(count[1]) - 2 if count else len(keywords)  # the first line is `statement`
        row = f"the line `{' '.join(rule.lines[at])}`: " if at < len(keywords) else ""
        raise ClaimError(
            f"{rule.name}: {row}{checker.Rejected(reason.kind, reason.offender)}"
        ) from None


def premises_of(
    rule: checker.Statement, known: Mapping[str, checker.Statement], stated: Collection[str]
) -> dict[str, checker.Statement] | str:
    """The premises by name, or why there are none: a rule that it names is stated, and not among
    those known to be certified.

    Raises ClaimError for a name that is not stated before it, or is that of another kind of rule;
    and for lines of which the checker makes no premises.
    """
    for keyword, name in ((key, text) for key, text in rule.lines if key in checker.NAMED):
        if name not in stated:
            part = name.partition("/")[1:]
            similar = get_close_matches(name, stated, 1) or [
                one for one in stated if one.partition("/")[1:] == part
            ]
            hint = f"did you mean {similar[0]}?" if similar else "state it first, in this claim"
            raise ClaimError(
                f"{rule.name}: the line `{keyword} {name}` names no rule that stands before it;"
                f" {hint}"
            )
        if name not in known:
            return f"it rests on {name}, which is not certified"
    try:
        return checker.premises_of(rule, known)
    except checker.Rejected as reason:
        kind, _, name = reason.offender.rpartition(" ")
        if reason.kind is checker.Kind.EARLIER and name in known:
            own = known[name].kind
            mend = f"name one of the kind `{kind}`"
            if {own, kind} == {"map", "relation"}:
                mend = f"write the line `{own} {name}`"
            raise ClaimError(f"{rule.name}: {name} is a rule `{own}`; {mend}") from None
        raise ClaimError(f"{rule.name}: {reason}") from None


def _fault(keywords: Sequence[str]) -> str:
    """What keeps lines with these keywords from being a rule; nothing where they are one."""
    row = "".join(f"{keyword} " for keyword in keywords)
    if any(re.fullmatch(rule.lines, row) for rule in RULES.values()):
        return ""

    def parts(kind: str) -> list[tuple[list[str], str]]:
        """The keywords of which one stands at each place, and how often: once, or *, + or ?."""
        found = re.findall(r"\(([a-z| ]+)\) ?([*+?]?)|([a-z]+) ", RULES[kind].lines)
        return [
            ((group or word).replace(" ", "").split("|"), often) for group, often, word in found
        ]

    def missing(kind: str) -> list[str]:
        return [
            f"`{'` or `'.join(words)}`"
            for words, often in parts(kind)
            if often not in ("*", "?") and not {*words} & {*keywords}
        ]

    def foreign(kind: str) -> list[str]:
        own = {word for words, _ in parts(kind) for word in words}
        return [f"`{keyword}`" for keyword in dict.fromkeys(keywords) if keyword not in own]

    kind = min(RULES, key=lambda one: len(missing(one)) + len(foreign(one)))
    faults = [f"{', '.join(missing(kind))} missing"] if missing(kind) else []
    faults += [f"{', '.join(foreign(kind))} left over"] if foreign(kind) else []
    places = [
        next((k for k, (words, _) in enumerate(parts(kind)) if keyword in words), -1)
        for keyword in keywords
    ]
    for before, after, one, other in zip(places, places[1:], keywords, keywords[1:]):
        if 0 <= after < before:
            faults.append(f"`{other}` after `{one}`")
        elif after == before >= 0 and parts(kind)[after][1] in ("", "?"):
            faults.append(f"`{other}` twice")
    often = {"": "", "*": " (any number)", "+": " (at least one)", "?": " (at most one)"}
    order = ", ".join(" or ".join(words) + often[count] for words, count in parts(kind))
    return f"{', '.join(faults)}; the lines of `{kind}` are, in this order: {order}"


# -------------------------------------------------------------------------------------------------
# Why a premise has no proof: values at which it is false, or what Z3 says.

LONGEST, LONGEST_NUMBER = 80, 24  # characters of a formula, and of a number, in a line
BITS, PLACES = 64, 6  # of an irrational value: after the point of its ends, and decimals shown
MORE = 10  # times the budget that is proposed


def why(
    kind: str,
    name: str,
    premise: checker.Statement,
    answer: tuple[Vote, Model | None],
    budget: int,
    cut: bool = True,
) -> str:
    """A line on a premise for which no proof was found within the budget, from Z3's answer; `cut`:
    whether it was the budget that ended the search.
    """
    vote, model = answer
    about = f"{name}, {meaning(kind, name)}:"
    if model is not None:
        # a root that is not known to exist has no value
        names = model.point if model.part == "goal" else premise.get("forall")[0]
        values = ", ".join(f"{one} = {_value(model.point[one])}" for one in names)
        numbers = _numbers(premise, model)
        parts = ["false", f" at {values}" * bool(values), f", where {numbers}" * bool(numbers)]
        return f"{about} {''.join(parts)}"
    if vote.answer == "fails":
        return f"{about} Z3 says that it is false"
    says = "Z3 says that it holds" if vote.answer == "holds" else "Z3 gives no answer"
    if not cut:
        return f"{about} {says}; no certificate was found, and not for want of budget"
    return (
        f"{about} {says}; no certificate was found within the budget: try --budget"
        f" {MORE * budget}, or a lemma"
    )


def _value(value: Fraction | AlgebraicNumber) -> str:
    if isinstance(value, Fraction):
        return str(value)
    return f"about {value.decimal(PLACES)} (a root of {value.polynomial_text('z')})"


def _numbers(premise: checker.Statement, model: Model) -> str:
    """What is false at the values, with the numbers that its two sides come to; nothing where that
    is 0 = 1, or where the ends of irrational values do not tell.
    """
    point = {
        name: (value, value) if isinstance(value, Fraction) else value.enclosure(BITS)
        for name, value in model.point.items()
    }
    obligations = 0
    try:
        for keyword, line in premise.lines:
            if keyword == "let":
                point[line[0]] = ends_of(line[1], point)
            elif keyword == "show":
                return _false_part(line, point)
            elif keyword in ("have", "root"):
                obligations += 1
                if model.part != f"obligation {obligations}":
                    continue
                if keyword == "have":
                    return _false_part(line, point)
                name, (under,) = line
                defined = ast.Compare(under, [ast.GtE()], [ast.Constant(0)])
                return f"under the root {name}, {_false_part(defined, point)}"
    except ZeroDivisionError:  # between ends that are not close enough
        return ""
    return ""


def _false_part(node: ast.expr, point: Mapping[str, Ends]) -> str:
    """The first false part of a conjunction, all parts of a disjunction that is false."""
    if not is_surely(False, node, point):
        return ""
    if isinstance(node, ast.BoolOp):
        parts = list(filter(None, (_false_part(part, point) for part in node.values)))
        return ", ".join(parts if isinstance(node.op, ast.Or) else parts[:1])
    if not isinstance(node, ast.Compare):
        return f"{formula_of(node)} is false"
    sides = [node.left, *node.comparators]
    pairs = (
        ast.Compare(left, [sign], [right]) for left, sign, right in zip(sides, node.ops, sides[1:])
    )
    pair = next(one for one in pairs if is_surely(False, one, point))
    relation = formula_of(pair)
    if not checker.names_in(str(relation)):
        return "" if str(relation) == "0 = 1" else f"{relation} is false"
    left, right = (_number(ends_of(side, point)) for side in (pair.left, *pair.comparators))
    numbers = f"{left} {relation.op} {right}"
    return f"{relation} comes to {numbers}" if len(str(relation)) <= LONGEST else numbers


def _number(ends: Ends) -> str:
    if ends[0] == ends[1] and len(str(ends[0])) <= LONGEST_NUMBER:
        return str(ends[0])
    return f"about {AlgebraicNumber.rational(ends[0]).decimal(PLACES)}"
