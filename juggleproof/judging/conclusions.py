"""The conclusion of a certified statement on the orbits of a map, as a sentence made from its text;
and the meaning of each of its premises.

Each rule of the checker has an entry in `RULES`, and this has one for each kind of premise.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import NamedTuple

from juggleproof.certificates import checker
from juggleproof.statements.definitions import term_of
from juggleproof.statements.language import bounds_of, interval_text

# the words for results; other files import them, and do not write them out
STABLE, PROVED, REFUTED = "stable", "proved", "refuted"
ATTRACT, ATTRACTS = "attract", "attracts"
AROUND = ("contraction", "lyapunov", "attraction")  # lines that name what holds around a point
ALWAYS = ("0 < 1", "0 = 0")  # conditions that always hold


LETTERS = (  # each letter with its substitutes where a statement uses it
    *map(tuple, ("epqzc", "fFgh", "sSuw", "nmij", "NMLJ", "klij", "VWUL")),
    ("rank", "order", "rho"),
    ("least", "lowest", "mu"),
)


class Letters(NamedTuple):
    """The names of a conclusion: point, map, state, three whole numbers, V, rank, least loss."""

    e: str
    f: str
    s: str
    n: str
    N: str
    k: str
    V: str
    rank: str
    least: str


class RuleLines:
    """The lines of a statement, with access to the statements that it names."""

    def __init__(self, name: str, texts: Mapping[str, str]) -> None:
        self.texts = texts
        self.rows = [row.partition(" ")[::2] for row in texts[name].splitlines()[1:]]

    @cached_property
    def letters(self) -> Letters:
        """The letters of the conclusion; none is a name in the statement, even with an index."""
        names = checker.names_in(*(text for _, text in self.of_map().rows), *self.roots())
        taken = {name.partition("_")[0] for name in names}
        found = []
        for others in LETTERS:
            found.append(next((one for one in others if one not in taken), others[0] * 2))
            taken.add(found[-1])
        return Letters(*found)

    def all(self, keyword: str) -> list[str]:
        """The texts of the lines with this keyword."""
        return [text for key, text in self.rows if key == keyword]

    def one(self, keyword: str) -> str:
        """The text of the only line with this keyword."""
        (text,) = self.all(keyword)
        return text

    def named(self, keyword: str) -> RuleLines:
        """The statement that the line with this keyword names."""
        return RuleLines(self.one(keyword), self.texts)

    def for_domain(self) -> str:
        """The words for the parameters for which a conclusion holds; empty without parameters."""
        names = self.of_map().one("over").split()
        domain = self.one("domain")
        with_domain = "" if domain in ALWAYS else f" with {domain}"
        every = self.intervals() or f"all {', '.join(names)}{with_domain}"
        whole = [name for line in self.of_map().all("integer") for name in line.split()]
        return f"for {every}{''.join(f', {n} an integer' for n in whole)}: " if names else ""

    def of_map(self) -> RuleLines:
        """The map or relation that the statement is about; the statement itself, if it is one."""
        keyword = next((key for key, _ in self.rows if key in checker.NAMED), "")
        return self.named(keyword).of_map() if keyword else self

    def around(self) -> RuleLines:
        """The statement that states the point: this one, or one that it rests on."""
        keyword = next((key for key, _ in self.rows if key in AROUND), "")
        return self.named(keyword).around() if keyword else self

    def intervals(self) -> str:
        """The domain as intervals; empty unless each condition is linear in a single parameter."""
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
            for root in RuleLines(name, self.texts).roots()
        ]
        return [*dict.fromkeys([*inner, *self.all("root")])]

    def terms(self, keyword: str) -> str:
        """The terms of the line with this keyword as a state, with roots written out."""
        return _vector(self.without_roots(self.one(keyword)))

    def without_roots(self, text: str) -> str:
        """The text with the roots of this statement written out, since other statements may use
        their names.
        """
        for name, _, term in (root.partition(" = ") for root in reversed(self.all("root"))):
            text = checker.put(text, {name: term})
        return text

    def point(self) -> str:
        """The equation of the point, e = .."""
        return f"{self.letters.e} = {self.terms('point')}"


def _set(called: str, condition: str) -> str:
    return f"{called} of all states" if condition in ALWAYS else f"{called} {{{condition}}}"


def _where(guard: str) -> str:
    return "" if guard in ("", *ALWAYS) else f" where {guard}"


def terms_of(text: str) -> list[str]:
    """The terms of a tuple, or the one term."""
    tree = checker.parse(text)
    parts = tree.elts if isinstance(tree, ast.Tuple) else [tree]
    return [str(term_of(part)) for part in parts]


def _vector(terms: str) -> str:
    return f"({terms})" if "," in terms else terms


def _factor(text: str) -> str:
    return text if re.fullmatch(r"\w+", text) else f"({text})"


def _steps(descent: RuleLines) -> str:
    """The numbers N of steps after which the orbit of s is in the trap."""
    at = descent.letters
    if len(terms_of(descent.all("rank")[0].rpartition(" -> ")[2])) > 1:
        return f"{at.N} that is large enough for {at.s}"
    more = len(descent.all("stage")) - 1
    return f"{at.N} >= {at.rank}({at.s})" + (f" + {more}" if more else "")


def _rank(descent: RuleLines) -> str:
    return f"where {descent.letters.rank} = {_greatest(descent.all('rank'))}"


def _greatest(rows: Sequence[str]) -> str:
    """The maximum of the terms of lines, which may have guards, in words."""
    each = [row.rpartition(" -> ")[::2] for row in rows]
    terms = [_vector(term) + (f" where {guard}" if guard else "") for guard, term in each]
    return f"the greatest of {'; '.join(terms)}" if len(terms) > 1 else terms[0]


def _power(contraction: RuleLines, exponent: str) -> str:
    return f"{_factor(contraction.one('rate'))}^{exponent}"


def _bound(contraction: RuleLines, exponent: str) -> str:
    size = contraction.one("size")
    return _power(contraction, exponent) + ("" if size == "1" else f" {_factor(size)}")


def _norm(contraction: RuleLines) -> str:
    names, at = contraction.of_map().one("state").split(), contraction.letters
    parts = []
    for name, weight in zip(names, terms_of(contraction.one("weights"))):
        apart = f"|{name} - {at.e}_{name}|" if len(names) > 1 else f"|{name} - {at.e}|"
        parts.append(apart + ("" if weight == "1" else f"/{_factor(weight)}"))
    greatest = f"max({', '.join(parts)})" if len(parts) > 1 else parts[0]
    return f"|{at.s} - {at.e}| = {greatest}"


def _largest(at: Letters) -> str:
    return f"|{at.s} - {at.e}| is the largest of all |{at.s}_j - {at.e}_j|"


def _of_iterates(f: RuleLines) -> str:
    (state, images), (count, powers) = (
        (", ".join(terms_of(side)) for side in f.one(keyword).split(" -> "))
        for keyword in ("iterates", "after")
    )
    at = f.letters
    return (
        f"{at.f}^{count}({state}) = {_vector(powers)} for every integer {count} >= 0, where"
        f" {at.f}({state}) = {_vector(images)}"
    ) + "".join(f", {text}" for text in f.all("let"))


def _pieces(f: RuleLines, before: str = "") -> str:
    """The image of each piece, with the guard of the piece."""
    pieces = (piece.split(" -> ") for piece in f.all("piece"))
    return "; ".join(f"{before}{_vector(image)}{_where(guard)}" for guard, image in pieces)


def _of_map(f: RuleLines) -> str:
    state, at = ", ".join(f.one("state").split()), f.letters
    return (
        f"{f.for_domain()}{at.f} maps {_set('the space', f.one('space'))} into itself, and exactly"
        f" one piece applies at each of its states: {_pieces(f, f'{at.f}({state}) = ')}"
    )


def _of_relation(f: RuleLines) -> str:
    state = ", ".join(f.one("state").split())
    inputs = f", for all {', '.join(f.one('input').split())}" if f.one("input") else ""
    return (
        f"{f.for_domain()}each state {state} of {_set('the space', f.one('space'))} has a next"
        f" state, and all next states are in it: {_pieces(f)}{inputs}"
    )


def _of_descent(f: RuleLines) -> str:
    trap, at = _set("the last stage", f.all("stage")[-1]), f.letters
    return (
        f"{f.for_domain()}{at.f}^{at.N}({at.s}) is in {trap} for every state {at.s} of the space"
        f" and every integer {_steps(f)}, {_rank(f)}"
    )


def _set_of(f: RuleLines) -> tuple[str, str, str]:
    """Three texts: the set of states that the point attracts; its short form after `of the space`;
    and the sentence that the set is mapped into itself and surrounds the point.
    """
    on, at = f.one("on"), f.letters
    if on in (*ALWAYS, f.of_map().one("space")):
        return "every state of the space", "", ""
    near = f"all states of the space with |{at.s} - {at.e}| <= {f.one('radius')}"
    around = f"; {at.f} takes the set into itself, and {near} are in it"
    return f"the set {{{on}}}", " in the set", around


def _of_contraction(f: RuleLines) -> str:
    at, (on, inside, around) = f.letters, _set_of(f)
    return (
        f"{f.for_domain()}{f.point()} is a fixed point, is {STABLE}, and {ATTRACTS} {on}:"
        f" |{at.f}^{at.n}({at.s}) - {at.e}| <= {_power(f, at.n)} |{at.s} - {at.e}| <="
        f" {_bound(f, at.n)} for every state {at.s} of the space{inside} and every integer"
        f" {at.n} >= 0, where {_norm(f)}{around}"
    )


def _value_of(f: RuleLines) -> str:
    """The maximum of the terms `value`, and the meaning of the statement's names for the point."""
    state, e = f.of_map().one("state").split(), f.letters.e
    points = {name: f"{e}_{name}" if len(state) > 1 else e for name in state}
    meanings = {f"{name}_gap": f"{name} - {point}" for name, point in points.items()}
    meanings |= {f"{name}_point": point for name, point in points.items()}
    names = [
        f"{name} = {meaning}"
        for name, meaning in meanings.items()
        if name in checker.names_in(*(text for _, text in f.rows))
    ]
    return ", ".join([_greatest(f.all("value")), *names])


def _of_lyapunov(f: RuleLines) -> str:
    at, (on, inside, around) = f.letters, _set_of(f)
    iterate = f"{at.f}^{at.n}({at.s})"
    return (
        f"{f.for_domain()}{f.point()} is a fixed point, is {STABLE}, and {ATTRACTS} {on}:"
        f" {at.V}({at.f}^({at.n} + 1)({at.s})) <= {at.V}({iterate}), and |{iterate} - {at.e}| >="
        f" distance for at most {at.V}({at.s})/{at.least} integers {at.n} >= 0, for every state"
        f" {at.s} of the space{inside} and every distance > 0, where {at.V}({at.s}) ="
        f" {_value_of(f)}; {at.least} = {f.one('least')} with level = {at.V}({at.s});"
        f" {_largest(at)}{around}"
    )


def _of_instability(f: RuleLines) -> str:
    radius, at = f.one("radius"), f.letters
    apart = f"|{at.s} - {at.e}|"
    return (
        f"{f.for_domain()}{f.point()} is not {STABLE}: for 0 < distance <= {radius} the state"
        f" {at.s} = {_vector(f.one('direction'))} has {apart} <= distance, and"
        f" |{at.f}^{at.n}({at.s}) - {at.e}| > {radius} for some integer {at.n} >= 0, where"
        f" {_largest(at)}"
    )


def _of_attraction(f: RuleLines) -> str:
    descent, inner, at = f.named("descent"), f.around(), f.letters
    start = f"{descent.for_domain()}{inner.point()} is {STABLE} and {ATTRACTS} every state"
    if not inner.all("weights"):
        return f"{start} of the space"
    return (
        f"{start} {at.s} of the space: |{at.f}^({at.N} + {at.k})({at.s}) - {at.e}| <="
        f" {_bound(inner, at.k)} for all integers {at.k} >= 0 and {_steps(descent)},"
        f" {_rank(descent)}, {_norm(inner)}"
    )


def _of_attraction_into(f: RuleLines) -> str:
    descent = f.named("descent")
    return (
        f"{descent.for_domain()}{f.around().point()} is a fixed point, is {STABLE}, and {ATTRACTS}"
        f" every state of {_set('the space', descent.of_map().one('space'))}"
    )


def _of_escape(f: RuleLines) -> str:
    word = f.one("word").split()
    return (
        f"{f.for_domain()}the orbit of {f.terms('start')} is back after"
        f" {len(word)} step{'s' * (len(word) > 1)}, by the pieces {', '.join(word)}, and does not"
        f" tend to {f.point()}"
    )


def _of_sharpness(f: RuleLines) -> str:
    descent = f.named("attraction").named("descent")
    return (
        f"{descent.of_map().for_domain()}{f.around().point()} is {STABLE} and {ATTRACTS} every"
        f" state of the space if and only if {descent.intervals() or descent.one('domain')}"
    )


def _of_settling(f: RuleLines) -> str:
    ends, at = [RuleLines(name, f.texts) for name in f.all("contraction")], f.letters
    points = [f"{at.e}_{k} = {end.terms('point')}" for k, end in enumerate(ends, 1)]
    several = f"one of {', '.join(points)}", "each"
    to, each = several if len(ends) > 1 else (f"{at.e} = {ends[0].terms('point')}", at.e)
    return (
        f"{f.named('descent').for_domain()}{at.f}^{at.n}({at.s}) tends to {to} for every state"
        f" {at.s} of the space, and {each} is {STABLE}"
    )


def _of_return(f: RuleLines) -> str:
    settling, at = f.named("settling"), f.letters
    names, starts = settling.all("contraction"), settling.all("word")[len(settling.all("rank")) :]
    points = []
    for count, (name, start) in enumerate(zip(names, starts), 1):
        steps = len(f.all("word")[int(start.split()[0]) - 1].split())
        e = f"{at.e}_{count}" if len(names) > 1 else at.e
        back = f" = {at.f}^{steps}({e})" if steps > 1 else f" = {at.f}({e})"
        points.append(f"{e} = {RuleLines(name, f.texts).terms('point')}{back}")
    to = f"one of {', '.join(points)}" if len(points) > 1 else points[0]
    iterates = f"{at.f}^{at.n}({at.s}) - {at.f}^{at.n}({at.e})"
    return (
        f"{settling.named('descent').for_domain()}every orbit tends to that of {to}:"
        f" {at.f}^({at.N} + {at.n})({at.s}) - {at.f}^{at.n}({at.e}) tends to 0, for every state"
        f" {at.s} of the space, with such an {at.e} and an integer {at.N} >= 0; and each such orbit"
        f" is {STABLE}: |{iterates}| is small for all {at.n} >= 0 where |{at.s} - {at.e}| is"
    )


# -------------------------------------------------------------------------------------------------
# The table of the rules.


class RuleWords(NamedTuple):
    """A rule of the checker in words: a short label; the order of its lines, as the checker
    demands it; its conclusion; and the meaning of each premise by the premise's name without
    numbers, which replace {0}, {1}.
    """

    label: str
    lines: str
    concludes: Callable[[RuleLines], str]
    premises: Mapping[str, str]


OF_DOMAIN = {
    "possible": "some parameters of the domain have a state in the space",
    "inside": "the domain is part of the map's domain",
}
OF_POINT = "the point is in the space, and what the lines `have` say of it is so"
RULES = {
    "iterates": RuleWords(
        "the iterates of a map",
        "forall integer (let )*iterates after ",
        _of_iterates,
        {
            "start": "the state after 0 steps is the state",
            "step": "the map takes the state after K steps to that after K + 1",
        },
    ),
    "map": RuleWords(
        "a map of the space into itself, piece by piece",
        "over (integer )?domain state space (piece )+",
        _of_map,
        {
            "possible": OF_DOMAIN["possible"],
            "covers": "the guard of some piece holds at each state of the space",
            "apart": "the guards of pieces {1} and {0} do not overlap",
            "stays": "piece {0} takes the space into itself",
        },
    ),
    "relation": RuleWords(
        "the next states of each state, piece by piece",
        "over (integer )?domain state input space (piece )+",
        _of_relation,
        {
            "possible": OF_DOMAIN["possible"],
            "covers": "the guard of some piece holds at each state of the space, for some inputs",
            "stays": "piece {0} takes the space into itself, for all inputs",
        },
    ),
    "descends": RuleWords(
        "a falling rank leads to the trap",
        "(map|relation) domain (root )*(rank )+(stage )+",
        _of_descent,
        {
            **OF_DOMAIN,
            "bounded": "the rank is at least 0 on the space",
            "falls": "the rank falls by 1 at least where piece {0} applies, outside of all stages",
            "stage": "piece {1} takes stage {0} into the next stage, or the last one into itself",
        },
    ),
    "contracts": RuleWords(
        "orbits in the trap close in on the point",
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
    "lyapunov": RuleWords(
        "a function falls along every orbit to the point",
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
    "unstable": RuleWords(
        f"a function grows near the point, which is not {STABLE}",
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
    "attracts": RuleWords(
        "every orbit tends to the point",
        "descent (contraction|lyapunov) ",
        _of_attraction,
        {
            "inside": "the domain of the descent is part of that of the other rule",
            "enters": "the last stage of the descent lies in the set `on` of the other rule",
        },
    ),
    "into": RuleWords(
        "a falling rank leads to a smaller space, where every orbit tends to the point",
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
    "escapes": RuleWords(
        "a periodic orbit stays away",
        "map domain (root )*point start word ",
        _of_escape,
        {
            **OF_DOMAIN,
            "start": "the start is in the space and not the point, and the pieces of the word apply"
            " in turn and lead back to it",
        },
    ),
    "exactly": RuleWords(
        f"{STABLE} and attracting for these parameters only",
        "attraction (escape |unstable )+",
        _of_sharpness,
        {
            "covers": "the domains of the rules make up the map's domain",
            "same-point": "the attraction and refutation {0} are about the same point",
        },
    ),
    "settles": RuleWords(
        "every orbit tends to one of several points",
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
    "returns": RuleWords(
        "every orbit tends to one of several orbits",
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
    """The conclusion of a map rule, made from its text and the texts that it rests on.

    >>> text = "statement t/sum\\nforall x K\\ninteger K\\niterates x -> x + 2\\nafter K -> x + 2*K"
    >>> conclusion("iterates", "t/sum", {"t/sum": text})
    'f^K(x) = x + 2*K for every integer K >= 0, where f(x) = x + 2'
    """
    lines = RuleLines(name, texts)
    said = RULES[kind].concludes(lines)
    if kind != "relation" and any(key == "input" for key, _ in lines.of_map().rows):
        f, s, n = lines.letters.f, lines.letters.s, lines.letters.n
        said += f"; {f}^{n}({s}) is any state that the relation leads to from {s} in {n} steps"
    for root in reversed(lines.roots()):  # a root may contain one above it
        if root.partition(" = ")[0] in checker.names_in(said):
            said += f"; {root}"
    return said


def meaning(kind: str, premise: str) -> str:
    """The meaning of a premise of a rule of this kind.

    >>> meaning("descends", "stage-2-1")
    'piece 1 takes stage 2 into the next stage, or the last one into itself'
    """
    name = re.sub(r"(-\d+)+$", "", premise)
    return RULES[kind].premises[name].format(*re.findall(r"-(\d+)", premise))
