"""The premises of the rules on orbits, written as universal statements."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import reduce
from itertools import repeat

from tests.certificates.reader.statements import Line, Statement
from tests.certificates.reader.syntax import Tree, names_in, renamed, require, substitute

Premises = dict[str, Statement]
ZERO, ONE = ("number", 0), ("number", 1)


def conjunction(parts: Iterable[Tree]) -> Tree:
    return reduce(lambda left, right: ("and", left, right), parts)


def disjunction(parts: Iterable[Tree]) -> Tree:
    return reduce(lambda left, right: ("or", left, right), parts)


def where(guards: Sequence[Tree], tree: Tree) -> Tree:
    """What holds where a guard does, if there is one."""
    return disjunction([*(("not", guard) for guard in guards), tree])


def equal(left: Iterable[Tree], right: Iterable[Tree]) -> Tree:
    return conjunction(("=", a, b) for a, b in zip(left, right))


class Setting:
    """A statement about a map: its parameters, state, pieces, domain and `root` lines."""

    def __init__(self, statement: Statement, statements: Mapping[str, Statement]) -> None:
        is_map = statement.kind in ("map", "relation")
        self.name = statement.name
        self.map = statement if is_map else statements[statement.lines[0].says]
        self.inputs = self.map.names("input")
        self.parameters = self.map.one("over")
        self.state = self.map.one("state")
        self.integers = [line for line in self.map.lines if line.word == "integer"]
        self.domain: Tree = statement.one("domain")
        self.space: Tree = self.map.one("space")
        self.pieces = self.map.all("piece")
        self.here = tuple(("name", name) for name in self.state)
        for _, terms in self.pieces:
            require(len(terms) == len(self.state), "a piece has a term for each variable")
        self.fixed: list[Line] = []
        self.moving: list[Line] = []
        moved = set(self.state)
        for root in statement.all("root"):
            if names_in(root[1]) & moved:
                moved.add(root[0])
                self.moving.append(Line("root", root))
            else:
                self.fixed.append(Line("root", root))
        self.have: list[Tree] = []
        self.points: tuple[str, ...] = ()
        self.gaps: tuple[str, ...] = ()
        self.point: tuple[Tree, ...] = ()
        if statement.kind in ("lyapunov", "unstable"):
            self.have = statement.all("have")
            self.point = statement.one("point")
            self.points = tuple(f"{name}_point" for name in self.state)
            self.gaps = tuple(f"{name}_gap" for name in self.state)
        self.next = {name: f"{name}_next" for name in (*moved, *self.gaps)}
        self.there = tuple(("name", self.next[name]) for name in self.state)

    def premise(self, name: str, lines: list[Line]) -> tuple[str, Statement]:
        return name, Statement(f"{self.name}.{name}", "universal", tuple(lines))

    def params(self, *more: str) -> list[Line]:
        names = (*self.parameters, *(self.points if self.have else ()), *more)
        known = [Line("given", one) for one in self.have] or self.let_point()
        return [*self.head(*names), *known]

    def head(self, *names: str) -> list[Line]:
        return [Line("forall", names), *self.integers, Line("range", self.domain), *self.fixed]

    def at_state(self, *more: str) -> list[Line]:
        places = [
            Line("let", (name, ("+", ("name", point), ("name", gap))))
            for name, point, gap in zip(self.state, self.points, self.gaps)
        ]
        lines = [*self.params(*(self.gaps or self.state), *more), *places]
        return [*lines, Line("given", self.space), *self.moving]

    def let_point(self) -> list[Line]:
        return [Line("let", pair) for pair in zip(self.points, self.point)]

    def let_gaps(self, end: str = "") -> list[Line]:
        return [
            Line("let", (gap + end, ("-", ("name", name + end), ("name", point))))
            for gap, name, point in zip(self.gaps, self.state, self.points)
        ]

    def around_point(self) -> list[Line]:
        lines = self.head(*self.parameters)
        space = renamed(self.space, dict(zip(self.state, self.points)))
        return [*lines, *self.let_point(), Line("show", conjunction([space, *self.have]))]

    def within_gaps(self, distance: Tree, end: str = "") -> Tree:
        links: list[Tree] = []
        for gap in self.gaps:
            name = ("name", gap + end)
            links += [("<=", ("-", distance), name), ("<=", name, distance)]
        return conjunction(links)

    def step(
        self, k: int, *given: Tree | Line, more: tuple[str, ...] = (), stays: bool = True
    ) -> list[Line]:
        guard, terms = self.pieces[k]
        rows = (one if isinstance(one, Line) else Line("given", one) for one in given)
        lines = [*self.at_state(*more, *self.inputs), *rows]
        lines.append(Line("given", guard))
        lines += self.lets(terms)
        if stays:
            lines += [Line("given", self.moved(self.space)), *self.roots_there()]
        return lines

    def moved(self, tree: Tree) -> Tree:
        return renamed(tree, self.next)

    def lets(self, terms: Iterable[Tree]) -> list[Line]:
        lets = [Line("let", (self.next[x], term)) for x, term in zip(self.state, terms)]
        return [*lets, *self.let_gaps("_next")]

    def roots_there(self) -> list[Line]:
        return [
            Line("root", (self.next[name], self.moved(term))) for _, (name, term) in self.moving
        ]

    def at_point(self, point: Iterable[Tree], *roots: Line) -> list[Line]:
        show = Line("show", self.moved(self.space))
        return [*self.params(), *roots, *self.lets(point), show]

    def within(
        self,
        distance: Tree,
        point: Iterable[Tree],
        names: Iterable[Tree] | None = None,
        weights: Iterable[Tree] = repeat(ONE),
    ) -> Tree:
        links: list[Tree] = []
        for name, e, weight in zip(names or self.here, point, weights):
            gap = ("-", name, e)
            links.append(("<=", ("*", ("-", distance), weight), gap))
            links.append(("<=", gap, ("*", distance, weight)))
        return conjunction(links)

    def own_domain(self) -> Premises:
        lines = [
            *self.integers,
            Line("exists", (*self.parameters, *self.state)),
            Line("with", self.domain),
            Line("show", self.space),
        ]
        return dict([self.premise("possible", lines)])

    def inside(self) -> Premises:
        lines = [*self.params(), Line("show", self.map.one("domain"))]
        return dict([self.premise("inside", lines)])


def of_map(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    setting = Setting(statement, statements)
    guards = [guard for guard, _ in setting.pieces]
    premises = setting.own_domain()
    some = [Line("exists", setting.inputs)] if setting.inputs else []
    covers = [*setting.at_state(), *some, Line("show", disjunction(guards))]
    premises |= [setting.premise("covers", covers)]
    for i in range(len(guards)):
        for k in range(i if statement.kind == "map" else 0):
            lines = [*setting.at_state(), Line("given", guards[i]), Line("given", guards[k])]
            lines.append(Line("show", ("=", ZERO, ONE)))
            premises |= [setting.premise(f"apart-{i + 1}-{k + 1}", lines)]
    for k in range(len(guards)):
        lines = [*setting.step(k, stays=False), Line("show", setting.moved(setting.space))]
        premises |= [setting.premise(f"stays-{k + 1}", lines)]
    return premises


def of_iterates(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    state, terms = statement.one("iterates")
    count, after = statement.one("after")
    variables, lets = statement.one("forall"), statement.all("let")
    require(len(after) == len(terms) == len(state), "as many terms as variables")
    require(variables[: len(state)] == state, "the variables begin with the state")
    require(statement.one("integer") == (count,) and count not in state, "the number of steps")
    require(not any(names_in(term) & {count, *state} for _, term in lets), "a name that moves")
    require(not any(count in names_in(term) for term in terms), "the map names the number of steps")
    head = [line for line in statement.lines if line.word in ("forall", "integer", "let")]
    at_start = [substitute(term, {count: ZERO}) for term in after]
    following = [substitute(term, {count: ("+", ("name", count), ONE)}) for term in after]
    next_names = {name: f"{name}_next" for name in state}
    reached = [Line("let", (next_names[name], term)) for name, term in zip(state, after)]
    stepped = [renamed(term, next_names) for term in terms]
    start = [*head, Line("show", equal(at_start, [("name", name) for name in state]))]
    step = [*head, *reached, Line("show", equal(stepped, following))]
    return {
        name: Statement(f"{statement.name}.{name}", "universal", tuple(lines))
        for name, lines in (("start", start), ("step", step))
    }


def of_descent(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    setting = Setting(statement, statements)
    lines_of_rank, stages = statement.all("rank"), statement.all("stage")
    require(not any(names_in(stage) & {*setting.inputs} for stage in stages), "an input")
    premises = {**setting.own_domain(), **setting.inside()}
    size = len(lines_of_rank[0][1])
    more = tuple(f"rank_{c}" for c in range(1, size + 1))
    rank: list[Tree] = [("name", name) for name in more]
    known: list[Tree] = []
    for guards, terms in lines_of_rank:
        require(len(terms) == size, "as many terms on each line")
        used = [names_in(tree) for tree in (*guards, *terms)]
        require(not any(names & {*more} for names in used), "a rank that names what it is below")
        below = conjunction(("<=", term, one) for term, one in zip(terms, rank))
        known.append(where(guards, below))
    if len(lines_of_rank) == 1 and not lines_of_rank[0][0]:
        rank, known, more = [*lines_of_rank[0][1]], [], ()
    lines = [*setting.at_state(*more), *(Line("given", one) for one in known)]
    lines.append(Line("show", conjunction((">=", one, ZERO) for one in rank)))
    premises |= [setting.premise("bounded", lines)]

    def smaller(c: int, guards: tuple[Tree, ...], terms: tuple[Tree, ...]) -> Tree:
        """Component c falls on this line and none before it grows, where the guard holds."""
        next_ = [*map(setting.moved, terms)]
        parts: list[Tree] = [("<=", after, one) for after, one in zip(next_[:c], rank)]
        parts.append(("<=", next_[c], ("-", rank[c], ONE)))
        return where([*map(setting.moved, guards)], conjunction(parts))

    falls = disjunction(
        conjunction(smaller(c, guards, terms) for guards, terms in lines_of_rank)
        for c in range(size)
    )
    for k in range(len(setting.pieces)):
        outside = ("not", disjunction(stages))
        lines = [*setting.step(k, outside, *known, more=more), Line("show", falls)]
        premises |= [setting.premise(f"falls-{k + 1}", lines)]
    for i, stage in enumerate(stages):
        following = stages[min(i + 1, len(stages) - 1)]
        for k in range(len(setting.pieces)):
            lines = [*setting.step(k, stage), Line("show", setting.moved(following))]
            premises |= [setting.premise(f"stage-{i + 1}-{k + 1}", lines)]
    return premises


def of_contraction(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    setting = Setting(statement, statements)
    inside: Tree = statement.one("on")
    point, weights = statement.one("point"), statement.one("weights")
    require(len(point) == len(weights) == len(setting.state), "a term for each variable")
    fixed = {*setting.parameters, *(name for _, (name, _) in setting.fixed)}
    rate, radius, size = (statement.one(word) for word in ("rate", "radius", "size"))
    for tree in (*point, *weights, rate, radius, size):
        require(names_in(tree) <= fixed, "a term in parameters only")

    def within(distance: Tree, names: Iterable[Tree] = setting.here) -> Tree:
        return setting.within(distance, point, names, weights)

    premises = {**setting.own_domain(), **setting.inside()}
    positive = [(">", weight, ZERO) for weight in weights]
    constants = conjunction(
        [(">=", rate, ZERO), ("<", rate, ONE), *positive, (">", radius, ZERO), (">", size, ZERO)]
    )
    premises |= [setting.premise("constants", [*setting.params(), Line("show", constants)])]
    premises |= [setting.premise("point", setting.at_point(point))]
    lines = [*setting.at_state(), Line("given", within(radius)), Line("show", inside)]
    premises |= [setting.premise("surrounds", lines)]
    lines = [*setting.at_state(), Line("given", inside), Line("show", within(size))]
    premises |= [setting.premise("size", lines)]
    distance: Tree = ("name", "distance")
    require("distance" not in names_in(setting.space) | names_in(inside), "distance is taken")
    for k in range(len(setting.pieces)):
        lines = [*setting.step(k, inside), Line("show", setting.moved(inside))]
        premises |= [setting.premise(f"stays-{k + 1}", lines)]
        given = (inside, (">=", distance, ZERO), within(distance))
        nearer = within(("*", rate, distance), setting.there)
        lines = [*setting.step(k, *given, more=("distance",)), Line("show", nearer)]
        premises |= [setting.premise(f"closer-{k + 1}", lines)]
    return premises


def other_roots(one: Setting, other: Setting) -> tuple[list[Line], list[Line]]:
    """The `root` lines of the other setting that the first has not: fixed, and moving."""
    return (
        [line for line in other.fixed if line not in one.fixed],
        [line for line in other.moving if line not in one.moving],
    )


def values_of(statement: Statement) -> list[tuple[tuple[Tree, ...], Tree]]:
    """The guards, one or none, and the term of each line `value`, which do not name `value`."""
    values = statement.all("value")
    for guards, term in values:
        require(not any("value" in names_in(tree) for tree in (*guards, term)), "value in a value")
    return values


def require_constants(setting: Setting, *trees: Tree) -> set[str]:
    """The names of constants: the terms have no others, and the point has none of its own."""
    fixed = {*setting.parameters, *(name for _, (name, _) in setting.fixed)}
    require(len(setting.point) == len(setting.state), "a term for each variable")
    for tree in setting.point:
        require(names_in(tree) <= fixed, "a point in parameters only")
    fixed |= {*setting.points}
    for tree in trees:
        require(names_in(tree) <= fixed, "a term in parameters only")
    return fixed


def of_lyapunov(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    setting = Setting(statement, statements)
    values = values_of(statement)
    words = ("on", "loss", "least", "upper", "radius")
    inside, loss, least, upper, radius = (statement.one(word) for word in words)
    require_constants(setting, upper, radius)
    value, distance, level = (("name", name) for name in ("value", "distance", "level"))
    given = Line("given", inside)
    here = [given]
    for guards, term in values:
        here.append(Line("given", where(guards, ("<=", term, value))))
    positive = [
        Line("given", (">=", value, ZERO)),
        Line("given", (">", ("+", ONE, value), ZERO)),
    ]
    bounded, names = [*here, *positive], ("value",)
    before, more = bounded, names
    if len(values) == 1 and not values[0][0]:
        before, more = [given, Line("let", ("value", values[0][1])), *positive], ()
    any_level = [
        Line("given", (">", distance, ZERO)),
        Line("given", (">=", level, ZERO)),
        Line("given", (">", ("+", ONE, level), ZERO)),
    ]
    far: list[Tree] = []
    for gap in setting.gaps:
        side = ("name", gap)
        far += [(">=", side, distance), ("<=", side, ("-", distance))]
    close = [
        Line("given", (">=", distance, ZERO)),
        Line("given", setting.within_gaps(distance)),
        Line("given", ("<=", distance, radius)),
    ]
    premises = {**setting.own_domain(), **setting.inside()}
    shown = conjunction([(">", radius, ZERO), (">", upper, ZERO)])
    premises |= [setting.premise("constants", [*setting.params(), Line("show", shown)])]
    lines = [*setting.params("distance", "level"), *any_level, Line("show", (">", least, ZERO))]
    premises |= [setting.premise("positive", lines)]
    premises |= [setting.premise("point", setting.around_point())]
    lines = [*setting.at_state(), Line("given", setting.within_gaps(radius))]
    premises |= [setting.premise("surrounds", [*lines, Line("show", inside)])]
    lines = [*setting.at_state("value"), *here, Line("show", (">=", value, ZERO))]
    premises |= [setting.premise("bounded", lines)]
    lines = [*setting.at_state(*more), *before, Line("show", (">=", loss, ZERO))]
    premises |= [setting.premise("loss", lines)]
    lines = [*setting.at_state("value", "distance", "level"), *bounded, *any_level]
    lines += [Line("given", disjunction(far)), Line("given", (">=", level, value))]
    premises |= [setting.premise("least", [*lines, Line("show", (">=", loss, least))])]
    for i, (guards, term) in enumerate(values):
        lines = [*setting.at_state("distance"), *close, *(Line("given", one) for one in guards)]
        lines.append(Line("show", ("<=", term, ("*", upper, distance))))
        premises |= [setting.premise(f"small-{i + 1}", lines)]
    for k in range(len(setting.pieces)):
        lines = [*setting.step(k, inside), Line("show", setting.moved(inside))]
        premises |= [setting.premise(f"stays-{k + 1}", lines)]
        for i, (guards, term) in enumerate(values):
            falls: Tree = ("<=", setting.moved(term), ("-", value, loss))
            shown = where([*map(setting.moved, guards)], falls)
            lines = [*setting.step(k, *before, more=more), Line("show", shown)]
            premises |= [setting.premise(f"falls-{k + 1}-{i + 1}", lines)]
    return premises


def of_unstable(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    setting = Setting(statement, statements)
    curve, values = statement.one("direction"), values_of(statement)
    rate, radius, upper = (statement.one(word) for word in ("rate", "radius", "upper"))
    fixed = require_constants(setting, rate, radius, upper)
    require(len(curve) == len(setting.state), "a term for each variable")
    require(all(names_in(tree) <= {*fixed, "distance"} for tree in curve), "a curve")
    distance = ("name", "distance")

    def next_value(relation: str, bound: Tree) -> Tree:
        return disjunction(
            conjunction([*map(setting.moved, guards), (relation, setting.moved(term), bound)])
            for guards, term in values
        )

    premises = {**setting.own_domain(), **setting.inside()}
    constants = conjunction([(">", rate, ONE), (">", radius, ZERO), (">", upper, ZERO)])
    premises |= [setting.premise("constants", [*setting.params(), Line("show", constants)])]
    lines = [*setting.params("distance"), Line("given", (">", distance, ZERO))]
    lines += [Line("given", ("<=", distance, radius)), *setting.lets(curve)]
    lines += [Line("have", setting.moved(setting.space)), *setting.roots_there()]
    near = setting.within_gaps(distance, "_next")
    lines.append(Line("show", conjunction([near, next_value(">", ZERO)])))
    premises |= [setting.premise("point", setting.around_point())]
    premises |= [setting.premise("direction", lines)]
    for i, (guards, term) in enumerate(values):
        given = [setting.within_gaps(radius), *guards, (">", term, ZERO)]
        lines = [*setting.at_state(), *(Line("given", one) for one in given)]
        lines.append(Line("show", ("<=", term, upper)))
        premises |= [setting.premise(f"bounded-{i + 1}", lines)]
        for k in range(len(setting.pieces)):
            grows = Line("show", next_value(">=", ("*", rate, term)))
            lines = [*setting.step(k, *(Line("given", one) for one in given)), grows]
            premises |= [setting.premise(f"grows-{k + 1}-{i + 1}", lines)]
    return premises


def around(statement: Statement, statements: Mapping[str, Statement]) -> Statement:
    """The contraction or Lyapunov function under an attraction."""
    other = statements[statement.lines[1].says]
    return around(other, statements) if other.kind in ("attracts", "into") else other


def of_into(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    descent = statements[statement.one("descent")]
    attraction = statements[statement.one("attraction")]
    first = Setting(descent, statements)
    second = Setting(statements[attraction.one("descent")], statements)
    other = around(attraction, statements)
    for word in ("over", "integer", "state", "piece"):
        require(first.map.all(word) == second.map.all(word), "a map with other pieces")
    point, radius = other.one("point"), statement.one("radius")
    roots = other_roots(first, Setting(other, statements))[0]
    positive = Line("show", (">", radius, ZERO))
    near = Line("given", first.within(radius, point))
    inner = Line("show", second.space)
    last = Line("given", descent.all("stage")[-1])
    premises = {
        "inside": [*first.params(), Line("show", second.domain)],
        "constants": [*first.params(), *roots, positive],
        "point": first.at_point(point, *roots),
        "surrounds": [*first.at_state(), *roots, near, inner],
        "enters": [*first.at_state(), last, inner],
    }
    return {
        name: Statement(f"{statement.name}.{name}", "universal", tuple(lines))
        for name, lines in premises.items()
    }


def of_attraction(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    descent = statements[statement.one("descent")]
    other = around(statement, statements)
    first, second = Setting(descent, statements), Setting(other, statements)
    require(first.map.name == second.map.name, "another map")
    lines = [*first.params(), Line("show", second.domain)]
    premises = [(("inside"), Statement(f"{statement.name}.inside", "universal", tuple(lines)))]
    lines = [*first.at_state(), *(line for some in other_roots(first, second) for line in some)]
    if names_in(other.one("on")) & {*second.points, *second.gaps}:
        lines += [*second.let_point(), *second.let_gaps()]
    lines += [Line("given", descent.all("stage")[-1]), Line("show", other.one("on"))]
    premises.append(("enters", Statement(f"{statement.name}.enters", "universal", tuple(lines))))
    return dict(premises)


def of_escape(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    setting = Setting(statement, statements)
    point, word = statement.one("point"), statement.one("word")
    start = statement.one("start")
    require(len(start) == len(point) == len(setting.state), "a term for each variable")
    require(max(word) <= len(setting.pieces), "a word of pieces")
    lines = setting.params()
    aim = [f"{name}_point" for name in setting.state]
    lines += [Line("let", (name, e)) for name, e in zip(aim, point)]
    terms = list(start)
    shown: list[Tree] = []
    first: list[Tree] = []
    for n, k in enumerate(word):
        here = {name: f"{name}_{n}" for name in setting.state}
        lines += [Line("let", (here[name], term)) for name, term in zip(setting.state, terms)]
        guard, pieces = setting.pieces[k - 1]
        if n == 0:
            first = [("name", here[name]) for name in setting.state]
            apart = [("!=", a, ("name", b)) for a, b in zip(first, aim)]
            shown += [renamed(setting.space, here), renamed(guard, here), disjunction(apart)]
        else:
            shown.append(renamed(guard, here))
        terms = [renamed(term, here) for term in pieces]
    shown.append(equal(first, terms))
    lines.append(Line("show", conjunction(shown)))
    premises = {**setting.own_domain(), **setting.inside()}
    premises |= [setting.premise("start", lines)]
    return premises


def of_exactly(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    attraction = statements[statement.one("attraction")]
    descent = Setting(statements[attraction.one("descent")], statements)
    inner = around(attraction, statements)
    points = Setting(inner, statements)
    others = [statements[line.says] for line in statement.lines[1:]]
    whole = Setting(statements[descent.map.name], statements)
    domains = [descent.domain, *(one.one("domain") for one in others)]
    premises = {"covers": [*whole.params(), Line("show", disjunction(domains))]}
    for k, one in enumerate(others, 1):
        other = Setting(one, statements)
        require(descent.map.name == other.map.name, "another map")
        show = Line("show", equal(inner.one("point"), one.one("point")))
        premises[f"same-point-{k}"] = [*other.params(), *other_roots(other, points)[0], show]
    return {
        name: Statement(f"{statement.name}.{name}", "universal", tuple(some))
        for name, some in premises.items()
    }


def require_no_way_on(
    words: Iterable[tuple[int, ...]], repeated: Sequence[tuple[int, ...]], pieces: int
) -> None:
    """An infinite word without these is at last one of the repeated: of the words with none, by
    their last letters, those that come back do so in one way, and the letters on the way are those
    of a repeated word.
    """
    apart = {*words}
    size = max(map(len, apart), default=1) - 1
    left: set[tuple[int, ...]] = {()}
    for _ in range(size):
        left = {(*end, k) for end in left for k in range(1, pieces + 1)}
        left = {end for end in left if not holds(end, apart)}
    ways = {
        (end, k): (*end, k)[1:] if size else ()
        for end in left
        for k in range(1, pieces + 1)
        if not holds((*end, k), apart)
    }
    size = len(ways) + 1
    while len(ways) < size:
        from_, size = {end for end, _ in ways}, len(ways)
        ways = {way: end for way, end in ways.items() if end in from_}
    ways = {way: end for way, end in ways.items() if way[0] in reached_from(end, ways)}
    from_ = {end for end, _ in ways}
    require(len(from_) == len(ways), "words of every length hold none of these")
    for start in from_:
        end, letters = start, list[int]()
        while end != start or not letters:
            ((k, end),) = [(k, to) for (one, k), to in ways.items() if one == end]
            letters.append(k)
        turns = {(*letters[n:], *letters[:n]) for n in range(len(letters))}
        require(not turns.isdisjoint(repeated), "words of every length hold none of these")


def reached_from(
    start: tuple[int, ...], ways: Mapping[tuple[tuple[int, ...], int], tuple[int, ...]]
) -> set[tuple[int, ...]]:
    """What the ways lead to from there, itself too."""
    after: dict[tuple[int, ...], set[tuple[int, ...]]] = {}
    for (end, _), to in ways.items():
        after.setdefault(end, set()).add(to)
    found, new = {start}, {start}
    while new:
        new = set().union(*(after.get(end, set()) for end in new)) - found
        found |= new
    return found


def holds(word: tuple[int, ...], apart: set[tuple[int, ...]]) -> bool:
    return any(word[-len(one) :] == one for one in apart)


def of_settles(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    descent = statements[statement.one("descent")]
    first, last = Setting(descent, statements), descent.all("stage")[-1]
    require(first.map.kind == "map", "a map")
    never, ranks, words = map(statement.all, ("never", "rank", "word"))
    require(max(max(word) for word in (*never, *words)) <= len(first.pieces), "a word of pieces")
    falling, words = words[: len(ranks)], words[len(ranks) :]
    require_no_way_on([*never, *words], falling, len(first.pieces))
    in_roots = bool(names_in(last) & {line.says[0] for line in first.moving})

    def named(setting: Setting, n: int, roots: bool = True) -> dict[str, str]:
        own = [*setting.state, *(line.says[0] for line in setting.moving if roots)]
        return {name: f"{name}_{n}" for name in own}

    def moved(lines: Iterable[Line], names: dict[str, str]) -> list[Line]:
        return [Line("root", (names[name], renamed(term, names))) for _, (name, term) in lines]

    def follows(word: tuple[int, ...], rest: list[Line]) -> Statement:
        lines = [*first.params(*named(first, 0, False).values())]
        terms: list[Tree] = []
        for n, k in enumerate(word):
            names = named(first, n)
            lines += [Line("let", (names[x], term)) for x, term in zip(first.state, terms)]
            lines.append(Line("given", renamed(first.space, names)))
            lines += moved(first.moving, names) if in_roots else []
            guard, images = first.pieces[k - 1]
            lines += [Line("given", renamed(one, names)) for one in (last, guard)]
            terms = [renamed(image, names) for image in images]
        return Statement("", "universal", (*lines, *rest))

    premises = {}
    for i, word in enumerate(never, 1):
        premises[f"never-{i}"] = follows(word, [Line("show", ("=", ZERO, ONE))])
    for i, ((guards, (term, *more)), word) in enumerate(zip(ranks, falling), 1):
        require(not guards and not more, "one term for a rank")
        require(names_in(term) <= {*first.parameters, *first.state}, "a rank of the state")
        names = named(first, len(word) - 1, False)
        images = [renamed(image, names) for image in first.pieces[word[-1] - 1][1]]
        after = {name: f"{name}_next" for name in first.state}
        here = renamed(term, named(first, 0, False))
        shown = conjunction([(">=", here, ZERO), ("<=", renamed(term, after), ("-", here, ONE))])
        lines = [Line("let", (after[name], image)) for name, image in zip(first.state, images)]
        premises[f"falls-{i}"] = follows(word, [*lines, Line("show", shown)])
    for i, (name, word) in enumerate(zip(statement.all("contraction"), words), 1):
        end = Setting(statements[name], statements)
        require(end.map.name == first.map.name, "another map")
        fixed, moving = other_roots(first, end)
        names = named(end, 0)
        on = renamed(statements[name].one("on"), names)
        roots = moved(moving if in_roots else end.moving, names)
        lines = (*first.params(), Line("show", end.domain))
        premises[f"inside-{i}"] = Statement("", "universal", lines)
        premises[f"ends-{i}"] = follows(word, [*fixed, *roots, Line("show", on)])
    return {name: one._replace(name=f"{statement.name}.{name}") for name, one in premises.items()}


def of_returns(statement: Statement, statements: Mapping[str, Statement]) -> Premises:
    whole = Setting(statements[statement.one("map")], statements)
    settling = statements[statement.one("settling")]
    first = Setting(statements[settling.one("descent")], statements)
    for word in ("over", "integer", "state", "space"):
        require(whole.map.all(word) == first.map.all(word), "a map of other states")
    words = statement.all("word")
    require(len(words) == len(first.pieces), "a word for each piece")
    premises = {"inside": [*first.params(), Line("show", whole.domain)]}
    for i, ((where, images), word) in enumerate(zip(first.pieces, words), 1):
        require(max(word) <= len(whole.pieces), "a word of pieces")
        lines = [*first.params(*first.state), Line("given", first.space), Line("given", where)]
        terms = [*whole.here]
        for n, k in enumerate(word):
            names = {name: f"{name}_{n}" for name in whole.state}
            lines += [Line("let", (names[x], term)) for x, term in zip(whole.state, terms)]
            guard, after = whole.pieces[k - 1]
            lines.append(Line("have", renamed(guard, names)))
            terms = [renamed(term, names) for term in after]
        premises[f"word-{i}"] = [*lines, Line("show", equal(terms, images))]
    for i, name in enumerate(settling.all("contraction"), 1):
        end = Setting(statements[name], statements)
        ends = settling.all("word")[len(settling.all("rank")) :]
        guard, _ = first.pieces[ends[i - 1][0] - 1]
        lines = [*end.at_state(), Line("given", first.domain)]
        lines += [Line("given", statements[name].one("on")), Line("show", guard)]
        premises[f"piece-{i}"] = lines
    return {
        name: Statement(f"{statement.name}.{name}", "universal", tuple(lines))
        for name, lines in premises.items()
    }


PREMISES: dict[str, Callable[[Statement, Mapping[str, Statement]], Premises]] = {
    "map": of_map,
    "relation": of_map,
    "iterates": of_iterates,
    "descends": of_descent,
    "contracts": of_contraction,
    "lyapunov": of_lyapunov,
    "unstable": of_unstable,
    "attracts": of_attraction,
    "into": of_into,
    "escapes": of_escape,
    "exactly": of_exactly,
    "settles": of_settles,
    "returns": of_returns,
}
