"""A map, or a relation, with the lines of a statement about it, as the text of its premises is
written from them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from .algebra import Kind, Work, at, require
from .language import NAMED, Known, Statement
from .text import names_in, put

PER_LETTER = 20  # elementary products that a letter of a premise stands for

Premises = Mapping[str, list[str]]  # {name: lines of a statement}


class Orbits:
    """A map, or a relation, with the lines of a statement about it, from which the text of the
    premises is written.
    """

    def __init__(self, statement: Statement, known: Known, work: Work) -> None:
        self.own = statement
        self.work = work
        if statement.kind in ("map", "relation"):
            self.map = statement
        else:
            self.map = earlier(statement, known, "map", "relation")
        (self.parameters,) = self.map.get("over")
        (self.state,) = self.map.get("state")
        integers = self.map.rows("integer")
        # the next state of a state that is an integer may be none
        require(names_in(*integers) <= set(self.parameters), Kind.NO_VARIABLE, self.map.name)
        self.integers = [f"integer {line}" for line in integers]
        self.inputs = [name for line in self.map.get("input") for name in line]
        (self.space,) = self.map.get("space")
        (self.domain,) = statement.rows("domain")
        self.pieces = self.map.get("piece")
        # the names of the point, and the variables in place of the state's where they are used
        self.point = [name + "_point" for name in self.state]
        self.gaps: list[str] = []
        self.have = [f"given {line}" for line in statement.rows("have")]
        self.moving = set(self.state)  # what has another value at the next state
        self.roots = []
        self.fixed = []
        for line in statement.rows("root"):
            name, _, under = line.partition(" = ")
            if self.moving & names_in(under):
                self.moving.add(name)
                self.roots.append("root " + line)
            else:
                self.fixed.append("root " + line)
        fits = all(
            len(guard) == 1 and len(images) == len(self.state) for guard, images in self.pieces
        )
        # nothing but parameters, state and inputs: x_next in a guard would mean the image itself
        named = names_in(*(text for piece in self.pieces for side in piece for text in side))
        known_names = {*self.parameters, *self.state, *self.inputs}
        require(fits and named <= known_names, Kind.PIECE, self.map.name)

    def next(self, text: str) -> str:
        """The same of the next state."""
        return put(text, {name: name + "_next" for name in self.moving})

    def for_all(self, *rows: str, extra: Sequence[str] = ()) -> list[str]:
        """For all parameters in the domain, with the roots of parameters; around a point, for all
        points with what the lines `have` say.
        """
        named = self.point if self.have else []
        known = self.have or self.let_point()
        # a map of 1,500 pieces has a million pairs of them: the text is counted as it grows
        self.work.spend(PER_LETTER * sum(map(len, [*self.fixed, *known, self.domain, *rows])))
        return [*self.head(*named, *extra), *known, *rows]

    def head(self, *more: str) -> list[str]:
        """For all parameters in the domain, and more variables, with the roots of parameters."""
        forall = "forall " + " ".join([*self.parameters, *more])
        return [forall, *self.integers, f"range {self.domain}", *self.fixed]

    def at(self, *rows: str, extra: Sequence[str] = ()) -> list[str]:
        """For all parameters in the domain and all states of the space."""
        sums = zip(self.state, self.point, self.gaps)
        places = [f"let {name} = {point} + {gap}" for name, point, gap in sums]
        names = [*(self.gaps or self.state), *extra]
        return self.for_all(*places, f"given {self.space}", *self.roots, *rows, extra=names)

    def step(self, k: int, *rows: str, show: str, extra: Sequence[str] = ()) -> list[str]:
        """Where the k-th piece applies, for all inputs: something of the next state; the map's
        premises say that it is in the space.
        """
        (guard,), images = self.pieces[k]
        known = []
        if self.own is not self.map:  # else the map would be assumed to do what is to be shown
            known = ["given " + self.next(self.space), *map(self.next, self.roots)]
        image = self.let_next(images)
        every = [*extra, *self.inputs]
        return self.at(*rows, f"given {guard}", *image, *known, f"show {show}", extra=every)

    def follow(
        self, word: Sequence[int], start: Sequence[str] = ()
    ) -> tuple[list[tuple[dict[str, str], list[str], str]], list[str]]:
        """The steps by the pieces of a word, and the state after the last: for each step NAME_k for
        the names of what moves, k the number of steps before it; the lines that name this state, of
        the first the start if it is given; and the guard of the piece.
        """
        require(word, Kind.WORD, self.own.name)  # after no step, every start is back
        steps = []
        here = [*start]
        for count, piece in enumerate(word):
            (guard,), images = at(self.pieces, piece - 1)
            self.work.spend(PER_LETTER * sum(map(len, [guard, *images])))
            now = {name: f"{name}_{count}" for name in self.moving}
            lets = [f"let {now[name]} = {term}" for name, term in zip(self.state, here)]
            steps.append((now, lets, put(guard, now)))
            here = [put(image, now) for image in images]
        return steps, here

    def let_next(self, terms: Sequence[str]) -> list[str]:
        """The lines that name the terms of the next state, or of any other."""
        lets = [f"let {name}_next = {term}" for name, term in zip(self.state, terms)]
        gaps = zip(self.gaps, self.state, self.point)
        return lets + [f"let {gap}_next = {name}_next - {point}" for gap, name, point in gaps]

    def around(self) -> Orbits:
        """The same around the point: NAME_gap is NAME - NAME_point, and the variable in place of
        NAME.
        """
        self.gaps = [name + "_gap" for name in self.state]
        self.moving.update(self.gaps)
        return self

    def let_point(self) -> list[str]:
        """Around a point: its names stand for its terms."""
        terms = self.terms("point") if self.gaps else []
        return [f"let {name} = {term}" for name, term in zip(self.point, terms)]

    def let_names(self, text: str) -> list[str]:
        """For premises of others: what a text's names of the point and of gaps stand for."""
        if not names_in(text) & {*self.point, *(name + "_gap" for name in self.state)}:
            return []
        gaps = zip(self.around().gaps, self.state, self.point)
        return [*self.let_point(), *(f"let {gap} = {name} - {at}" for gap, name, at in gaps)]

    def at_the_point(self) -> list[str]:
        """The point, which has its terms, is in the space, and what the lines `have` say is so."""
        shown = [put(self.space, dict(zip(self.state, self.point))), *self.own.rows("have")]
        return [*self.head(), *self.let_point(), "show " + all_of(shown)]

    def within_gaps(self, distance: str, after: str = "") -> str:
        """|s - e| <= distance, e the point, in the sup norm, around it; of the next state where
        after is "_next".
        """
        reach = f"({distance})"
        gaps = [gap + after for gap in self.gaps]
        return all_of(f"-{reach} <= {gap} and {gap} <= {reach}" for gap in gaps)

    def in_space(self, point: Sequence[str], *roots: str) -> list[str]:
        """A point is in the space."""
        return self.for_all(*roots, *self.let_next(point), "show " + self.next(self.space))

    def within(
        self, distance: str, point: Sequence[str], weights: Sequence[str] = (), after: str = ""
    ) -> str:
        """|s - e| <= distance, e the point, in the sup norm, with weights if there are any; of the
        next state where after is "_next".
        """
        parts = []
        for name, e, weight in zip(self.state, point, weights or ["1"] * len(point)):
            reach = f"({distance})*({weight})"
            side = f"{name}{after} - ({e})"
            parts.append(f"-{reach} <= {side} and {side} <= {reach}")
        return all_of(parts)

    def values(self, keyword: str, names: Sequence[str]) -> list[tuple[list[str], list[str]]]:
        """[(guards, terms)] of the lines of this keyword, each with one guard or none, and a term
        for each of the names, which premises give to what is at least the greatest of the terms.
        """
        values = self.own.get(keyword)
        fits = all(len(guards) < 2 and len(terms) == len(names) for guards, terms in values)
        # the terms are of the state alone: with `value` in them, V(s) <= value would say nothing
        used = names_in(*(text for sides in values for side in sides for text in side))
        require(fits and used.isdisjoint(names), Kind.VALUE, self.own.name)
        return [*values]

    def at_most(self, keyword: str, names: Sequence[str]) -> list[str]:
        """Where their guards hold, the terms of each line are at most what the names stand for."""
        return [
            "given " + where(guards, (f"({term}) <= {name}" for term, name in zip(terms, names)))
            for guards, terms in self.values(keyword, names)
        ]

    def terms(self, keyword: str, *more: str) -> list[str]:
        """One term for each state variable, in the parameters and what more is named."""
        terms: list[str]
        (terms,) = self.own.get(keyword)
        constants = {*self.parameters, *more, *(line.split(" ")[1] for line in self.fixed)}
        # with a state variable in it, the point would move with the state
        fits = len(terms) == len(self.state) and names_in(*terms) <= constants
        require(fits, Kind.STATE_TERMS, self.own.name)
        return terms

    def with_domain(self, premises: Premises) -> Premises:
        """Beside other premises: a state of the space, for parameters in the domain, which is part
        of the map's domain.
        """
        some = "exists " + " ".join([*self.parameters, *self.state])
        possible = [*self.integers, some, f"with {self.domain}", f"show {self.space}"]
        inside = {}
        if self.own is not self.map:
            inside = {"inside": self.for_all("show " + self.map.rows("domain")[0])}
        return {"possible": possible, **inside, **premises}


def earlier(statement: Statement, known: Known, *keywords: str) -> Statement:
    """What the one line with one of these keywords names."""
    (one,) = all_earlier(statement, known, *keywords)
    return one


def all_earlier(statement: Statement, known: Known, *keywords: str) -> list[Statement]:
    """What the lines with these keywords name: earlier statements, certified, each of a kind that
    its line needs.
    """
    lines = [(NAMED[keyword], name) for keyword, name in statement.lines if keyword in keywords]
    for kinds, name in lines:
        fits = name in known and known[name].kind in kinds
        require(fits, Kind.EARLIER, f"{' or '.join(kinds)} {name}")
    return [known[name] for _, name in lines]


def where(guards: Sequence[str], parts: Iterable[str]) -> str:
    """All of the parts hold, where the guards do."""
    text = " and ".join(parts)
    return f"(not ({all_of(guards)}) or {text})" if guards else text


def all_of(parts: Iterable[str], op: str = " and ") -> str:
    return op.join(f"({part})" for part in parts)
