"""The rules for orbits of maps: what holds of every orbit, from premises that this file writes.

Each rule writes its premises itself, as text, and a certificate has to prove exactly these.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from .algebra import Kind, Rejected, Work, at, require
from .language import NAMED, Known, Statement, read_statements
from .maps import PER_LETTER, Orbits, Premises, all_earlier, all_of, earlier, where
from .rules import Hint, prove
from .text import Definitions, names_in, put

Word = tuple[int, ...]  # pieces of a map, by their numbers from 1 on
Words = Sequence[Sequence[int]]


def premises_of_iterates(statement: Statement, known: Known, work: Work) -> Premises:
    """The K-th iterate of the map, for every integer K >= 0.  Premises: P(0) is the identity, and
    map(P(K)) = P(K + 1).
    """
    (variables,) = statement.get("forall")
    (counts,) = statement.get("integer")
    ((state, images),) = statement.get("iterates")
    ((count, powers),) = statement.get("after")
    lets = ["let " + text for text in statement.rows("let")]
    shaped = state == variables[: len(state)] and 0 < len(state) == len(images) == len(powers)
    # the count apart from the state: else the map would change how often it is iterated
    apart = count == counts and set(count) <= set(variables[len(state) :])
    require(shaped and apart, Kind.ITERATES_SHAPE, statement.name)
    still = not names_in(*images) & set(count) and not names_in(*lets) & {*count, *state}
    require(still, Kind.ITERATES_COUNT, statement.name)
    # a name that only the premises declare, such as x_next, would mean something in them alone
    declared = {*variables, *(name for name, _ in statement.get("let"))}
    require(names_in(*images, *powers) <= declared, Kind.ITERATES_NAME, statement.name)
    (k,) = count
    after = {name: name + "_next" for name in state}
    head = [f"forall {' '.join(variables)}", f"integer {k}", *lets]
    start = [f"({put(power, {k: '0'})}) = {name}" for name, power in zip(state, powers)]
    step = [
        f"({put(image, after)}) = ({put(power, {k: f'({k} + 1)'})})"
        for image, power in zip(images, powers)
    ]
    reached = [f"let {name}_next = {power}" for name, power in zip(state, powers)]
    return {
        "start": [*head, "show " + " and ".join(start)],
        "step": [*head, *reached, "show " + " and ".join(step)],
    }


def premises_of_map(statement: Statement, known: Known, work: Work) -> Premises:
    """A map f of the space into itself: for all parameters in the domain, each state of the space
    has exactly one piece whose guard holds, f(state) is given by that piece, and f(state) is in the
    space.  Parameters that a line `integer` names are integers, here and in all that is said of the
    map.
    """
    f = Orbits(statement, known, work)
    guards = [guard for (guard,), _ in f.pieces]
    apart = {}
    for i, guard in enumerate(guards):
        for k in range(i):
            both = f"given {guard}", f"given {guards[k]}"
            apart[f"apart-{i + 1}-{k + 1}"] = f.at(*both, "show 0 = 1")
    return premises_of_relation(statement, known, work, apart)


def premises_of_relation(
    statement: Statement, known: Known, work: Work, apart: Premises | None = None
) -> Premises:
    """A relation F between states of the space: for all parameters in the domain, each state s of
    the space has a next state, that is, a piece whose guard holds for some inputs, and all its next
    states are in the space: the images under each piece, for all inputs for which its guard holds.

    What `descends`, `contracts`, `lyapunov`, `attracts` and `into` say of f^n(s), they say of s_n
    for every execution s_0 = s, s_(n + 1) in F(s_n) of a relation, with F(e) = {e} for f(e) = e.
    """
    f = Orbits(statement, known, work)
    some = [f"exists {' '.join(f.inputs)}"] if f.inputs else []
    covers = f.at(*some, "show " + all_of((guard for (guard,), _ in f.pieces), " or "))
    premises = {"covers": covers, **(apart or {})}
    for k in range(len(f.pieces)):
        premises[f"stays-{k + 1}"] = f.step(k, show=f.next(f.space))
    return f.with_domain(premises)


def premises_of_descent(statement: Statement, known: Known, work: Work) -> Premises:
    """Descent of a rank to a trap: stages A_1, .., A_m.  Each line `rank` has a term for each
    component of the rank; component c of rank(s) is the greatest of the c-th terms of the lines
    whose guard, if they have one, holds at s.  For all parameters in the domain and all states s of
    the space, f^N(s) is in A_m for every integer N >= rank(s) + m - 1, if the rank has one
    component; if it has more, for every integer N from some number on, which depends on s.

    Premises: each component of the rank is >= 0; outside of all stages some component falls by 1 at
    least from s to f(s), and none before it grows; f takes A_k into A_(k+1), and A_m into itself.
    So the first visit to a stage is after at most rank(s) steps; with more components, after
    finitely many, as the integers below them descend in lexicographic order. And m - 1 more steps,
    or fewer, lead to A_m.
    """
    f = Orbits(statement, known, work)
    names = [f"rank_{c + 1}" for c in range(len(statement.get("rank")[0][1]))]
    ranks, at_most, rank, extra = f.values("rank", names), f.at_most("rank", names), names, names
    if [guards for guards, _ in ranks] == [[]]:
        at_most, extra, rank = [], [], [f"({term})" for term in ranks[0][1]]
    stages = statement.get("stage")
    require(not names_in(*stages) & set(f.inputs), Kind.STAGE_INPUT, statement.name)
    outside = f"given not ({all_of(stages, ' or ')})"
    falls = []
    for c in range(len(rank)):
        parts = []
        for guards, terms in ranks:
            less = [f"({f.next(term)}) <= {one}" for term, one in zip(terms, rank)]
            work.spend(PER_LETTER * sum(map(len, less)))
            parts.append(where([*map(f.next, guards)], [*less[:c], f"{less[c]} - 1"]))
        falls.append(" and ".join(parts))
    show = " or ".join(falls)
    positive = " and ".join(f"{one} >= 0" for one in rank)
    premises = {"bounded": f.at(*at_most, f"show {positive}", extra=extra)}
    for k in range(len(f.pieces)):
        premises[f"falls-{k + 1}"] = f.step(k, outside, *at_most, show=show, extra=extra)
        for i, (stage, after) in enumerate(zip(stages, [*stages[1:], stages[-1]])):
            premises[f"stage-{i + 1}-{k + 1}"] = f.step(k, f"given {stage}", show=f.next(after))
    return f.with_domain(premises)


def premises_of_contraction(statement: Statement, known: Known, work: Work) -> Premises:
    """Contraction in a weighted sup norm, |s - e| = max |s_j - e_j| / weight_j, e the point.  For
    all parameters in the domain: f(e) = e; for all states s of the space in the set `on` and all
    integers n >= 0, f^n(s) is in it and |f^n(s) - e| <= rate^n |s - e| <= rate^n size; and all
    states of the space with |s - e| <= radius are in it.  So e is stable, and attracts the set.

    Premises: 0 <= rate < 1, weights > 0, radius > 0, size > 0; e is in the space; `on` holds where
    |s - e| <= radius, is taken into itself, and has |s - e| <= size; and on it |s - e| <= distance
    implies |f(s) - e| <= rate distance, for every distance >= 0.
    """
    f = Orbits(statement, known, work)
    (on,), (rate,), (radius,), (size,) = map(statement.get, ("on", "rate", "radius", "size"))
    point = f.terms("point")
    weights = f.terms("weights")
    positive = [f"({c}) > 0" for c in [*weights, radius, size]]
    premises = {
        "constants": f.for_all("show " + all_of([f"({rate}) >= 0", f"({rate}) < 1", *positive])),
        "point": f.in_space(point),
        "surrounds": f.at("given " + f.within(radius, point, weights), f"show {on}"),
        "size": f.at(f"given {on}", "show " + f.within(size, point, weights)),
    }
    near = ["given distance >= 0", "given " + f.within("distance", point, weights)]
    nearer = f.within(f"({rate})*distance", point, weights, "_next")
    for k in range(len(f.pieces)):
        premises[f"stays-{k + 1}"] = f.step(k, f"given {on}", show=f.next(on))
        closer = f.step(k, f"given {on}", *near, show=nearer, extra=["distance"])
        premises[f"closer-{k + 1}"] = closer
    return f.with_domain(premises)


def premises_of_lyapunov(statement: Statement, known: Known, work: Work) -> Premises:
    """A Lyapunov function V: V(s) is the greatest of the terms `value` whose guard, if they have
    one, holds at s; e is the point, and |s - e| = max |s_j - e_j|.  For all parameters in the
    domain: f(e) = e; for all states s of the space in the set `on` and all integers n >= 0, f^n(s)
    is in it, V(f^(n + 1)(s)) <= V(f^n(s)), and |f^n(s) - e| >= d for at most V(s)/least(d, V(s))
    of these n, for every d > 0; and all states of the space with |s - e| <= radius are in it.  So e
    is stable, and attracts the set.

    In all lines but `point` NAME_point names the point, and NAME_gap is NAME - NAME_point.  What
    the lines `have` say of the point is all that the premises know of it, if there are any.

    Premises: e is in the space, and what the lines `have` say is so; radius > 0 and upper > 0, in
    the parameters alone; least(distance, level) > 0 for distance > 0 and level >= 0; `on` holds
    where |s - e| <= radius; V(s) <= upper distance where |s - e| <= distance <= radius; and on the
    set, which is taken into itself, V(s) >= 0, loss >= 0, V(f(s)) <= V(s) - loss, and loss >=
    least(distance, level) where |s - e| >= distance and V(s) <= level.  The loss may name V(s), as
    `value`.

    Stable: where |s - e| >= d and V(s) <= c = upper radius, V(s) >= loss >= least(d, c).  So where
    V(s) is less than both, |f^n(s) - e| < d for all n.  V(e) = 0, so V(f(e)) = 0 and f(e) = e.
    """
    f = Orbits(statement, known, work).around()
    (on,), (loss,), (least,) = map(statement.get, ("on", "loss", "least"))
    (upper,), (radius,) = map(statement.get, ("upper", "radius"))
    values = f.values("value", ["value"])
    here = [f"given {on}", *f.at_most("value", ["value"])]
    # what holds for every number that is at least V(s) holds for V(s); 1 + value > 0 and 1 + level
    # > 0, so that loss and least may divide by them
    bounded = [*here, "given value >= 0", "given 1 + value > 0"]
    before, extra = bounded, ["value"]
    if [guards for guards, _ in values] == [[]]:
        before, extra = [here[0], f"let value = {values[0][1][0]}", *bounded[2:]], []
    any_level = ["given distance > 0", "given level >= 0", "given 1 + level > 0"]
    far = all_of((f"{gap} >= distance or {gap} <= -distance" for gap in f.gaps), " or ")
    far_off = [*any_level, f"given {far}", "given level >= value", f"show ({loss}) >= ({least})"]
    within = "given " + f.within_gaps("distance")
    near = ["given distance >= 0", within, f"given distance <= ({radius})"]
    both = ["distance", "level"]
    premises = {
        # apart from `least`: a radius that names `distance` would be as small as it likes
        "constants": f.for_all("show " + all_of([f"({radius}) > 0", f"({upper}) > 0"])),
        "positive": f.for_all(*any_level, f"show ({least}) > 0", extra=both),
        "point": f.at_the_point(),
        "surrounds": f.at("given " + f.within_gaps(radius), f"show {on}"),
        "bounded": f.at(*here, "show value >= 0", extra=["value"]),
        "loss": f.at(*before, f"show ({loss}) >= 0", extra=extra),
        "least": f.at(*bounded, *far_off, extra=["value", *both]),
    }
    for i, (guards, (term,)) in enumerate(values):
        small = [*(f"given {guard}" for guard in guards), f"show ({term}) <= ({upper})*distance"]
        premises[f"small-{i + 1}"] = f.at(*near, *small, extra=["distance"])
    for k in range(len(f.pieces)):
        premises[f"stays-{k + 1}"] = f.step(k, f"given {on}", show=f.next(on))
        for i, (guards, (term,)) in enumerate(values):
            show = where([*map(f.next, guards)], [f"({f.next(term)}) <= value - ({loss})"])
            premises[f"falls-{k + 1}-{i + 1}"] = f.step(k, *before, show=show, extra=extra)
    return f.with_domain(premises)


def premises_of_attraction(statement: Statement, known: Known, work: Work) -> Premises:
    """A descent whose last stage lies in the set `on` of a contraction, or of a Lyapunov function,
    of the same map.  For all parameters in the descent's domain, the point is stable and f^n(s)
    tends to it for all states s of the space; with a contraction |f^(N+k)(s) - e| <= rate^k size
    for all integers k >= 0 and all N for which the descent says that f^N(s) is in the last stage.
    """
    f = Orbits(earlier(statement, known, "descent"), known, work)
    other = Orbits(around(statement, known), known, work)
    # the very statement: two maps may have the same text, and other certificates
    require(f.map is other.map, Kind.OTHER_MAP, statement.name)
    # a root of one name for two terms is declared twice, and refused
    roots = [root for root in other.fixed + other.roots if root not in f.fixed + f.roots]
    last, on = f.own.get("stage")[-1], other.own.get("on")[0]
    return {
        "inside": f.for_all(f"show {other.domain}"),
        "enters": f.at(*roots, *other.let_names(on), f"given {last}", f"show {on}"),
    }


def around(statement: Statement, known: Known) -> Statement:
    """What an attraction says of a neighbourhood of its point."""
    one = earlier(statement, known, "contraction", "lyapunov", "attraction")
    return around(one, known) if one.kind in NAMED["attraction"] else one


def premises_of_attraction_into(statement: Statement, known: Known, work: Work) -> Premises:
    """A descent of a map f, and an attraction of a map g with the same parameters, state and pieces
    on another space.  For all parameters in the descent's domain, the attraction's point e is a
    fixed point of f, it is stable, and f^n(s) tends to it for all states s of f's space.

    Premises: the descent's domain is part of the attraction's; e is in f's space; radius > 0, in
    the parameters alone; the states of f's space that are in the last stage, or have |s - e| =
    max |s_j - e_j| <= radius, are in g's space.  f = g where both are defined, by the same pieces:
    an orbit of f that enters g's space is from there on an orbit of g.
    """
    f = Orbits(earlier(statement, known, "descent"), known, work)
    attraction = earlier(statement, known, "attraction")
    g = Orbits(earlier(attraction, known, "descent"), known, work)
    other = Orbits(around(attraction, known), known, work)
    same = all(f.map.get(key) == g.map.get(key) for key in ("over", "integer", "state", "piece"))
    require(same, Kind.OTHER_MAP, statement.name)
    (radius,), point = statement.get("radius"), other.terms("point")
    roots = [root for root in other.fixed if root not in f.fixed]
    return {
        "inside": f.for_all(f"show {g.domain}"),
        "constants": f.for_all(*roots, f"show ({radius}) > 0"),
        "point": f.in_space(point, *roots),
        "surrounds": f.at(*roots, "given " + f.within(radius, point), f"show {g.space}"),
        "enters": f.at(f"given {f.own.get('stage')[-1]}", f"show {g.space}"),
    }


def premises_of_escape(statement: Statement, known: Known, work: Work) -> Premises:
    """A periodic orbit: for all parameters in the domain the start is in the space, f^n(start) =
    start for the length n of the word of pieces, and start is not the point; so the orbit of the
    start does not tend to the point.
    """
    f = Orbits(statement, known, work)
    (word,) = statement.get("word")
    rows = [f"let {name}_point = {e}" for name, e in zip(f.state, f.terms("point"))]
    apart = all_of((f"{name}_0 != {name}_point" for name in f.state), " or ")
    shown = [put(f.space, {name: f"{name}_0" for name in f.state})]
    steps, here = f.follow(word, f.terms("start"))
    for _, lets, guard in steps:
        rows += lets
        shown.append(guard)
    shown.insert(2, apart)
    shown += [f"{name}_0 = ({last})" for name, last in zip(f.state, here)]
    return f.with_domain({"start": f.for_all(*rows, "show " + all_of(shown))})


def premises_of_instability(statement: Statement, known: Known, work: Work) -> Premises:
    """A Chetaev function W: W(s) is the greatest of the terms `value` whose guard, if they have
    one, holds at s; e is the point, |s - e| = max |s_j - e_j|, and s(d) the state given by the
    terms `direction`, in which d is named `distance`.  For all parameters in the domain and 0 < d
    <= radius: s(d) is in the space, |s(d) - e| <= d, and |f^n(s(d)) - e| > radius for some integer
    n >= 0.  So e is not stable.

    Premises, with the point's names and the lines `have` as for a Lyapunov function: e is in the
    space; rate > 1, radius > 0 and upper > 0, in the parameters alone; for 0 < d <= radius s(d) is
    in the space, |s(d) - e| <= d and W(s(d)) > 0; and for all states s of the space with |s - e| <=
    radius and W(s) > 0, W(s) <= upper and W(f(s)) >= rate W(s).  If the orbit stayed, W(f^n(s(d)))
    >= rate^n W(s(d)) would exceed upper.
    """
    f = Orbits(statement, known, work).around()
    (rate,), (radius,), (upper,) = map(statement.get, ("rate", "radius", "upper"))
    curve, values = f.terms("direction", "distance", *f.point), f.values("value", ["value"])

    def next_value(bound: str) -> str:
        """W of the next state meets a lower bound."""
        parts = [[*map(f.next, guards), f"({f.next(term)}) {bound}"] for guards, (term,) in values]
        return all_of(map(all_of, parts), " or ")

    # what is shown to be a state of the space has the roots that are of the state
    start = ["have " + f.next(f.space), *map(f.next, f.roots)]
    small = ["given distance > 0", f"given distance <= ({radius})", *f.let_next(curve), *start]
    # no f.next of it: a state variable may have the name `distance`
    show = "show " + all_of([f.within_gaps("distance", "_next"), next_value("> 0")])
    constants = all_of([f"({rate}) > 1", f"({radius}) > 0", f"({upper}) > 0"])
    premises = {
        "constants": f.for_all(f"show {constants}"),
        "point": f.at_the_point(),
        "direction": f.for_all(*small, show, extra=["distance"]),
    }
    for i, (guards, (term,)) in enumerate(values):
        here = [f.within_gaps(radius), *guards, f"({term}) > 0"]
        given = [f"given {one}" for one in here]
        premises[f"bounded-{i + 1}"] = f.at(*given, f"show ({term}) <= ({upper})")
        for k in range(len(f.pieces)):
            grows = f.step(k, *given, show=next_value(f">= ({rate})*({term})"))
            premises[f"grows-{k + 1}-{i + 1}"] = grows
    return f.with_domain(premises)


def premises_of_sharpness(statement: Statement, known: Known, work: Work) -> Premises:
    """An attraction; and escapes from the same point of the same map, or its instability, on
    domains that make up the map's with that of the attraction's descent.  For all parameters in the
    map's domain: the point is stable and attracts every state of the space <=> the parameters are
    in the domain of the descent.
    """
    attraction = earlier(statement, known, "attraction")
    f = Orbits(earlier(attraction, known, "descent"), known, work)
    inner = Orbits(around(attraction, known), known, work)
    refuted = all_earlier(statement, known, "escape", "unstable")
    others = [Orbits(one, known, work) for one in refuted]
    domains = all_of([f.domain, *(other.domain for other in others)], " or ")
    premises = {"covers": Orbits(f.map, known, work).for_all(f"show {domains}")}
    for k, other in enumerate(others):
        require(f.map is other.map, Kind.OTHER_MAP, statement.name)
        roots = [root for root in inner.fixed if root not in other.fixed]
        points = zip(inner.terms("point"), other.terms("point"))
        same = all_of(f"({one}) = ({two})" for one, two in points)
        premises[f"same-point-{k + 1}"] = other.for_all(*roots, f"show {same}")
    return premises


def premises_of_settling(statement: Statement, known: Known, work: Work) -> Premises:
    """A descent of a map f with the last stage A; words of pieces `never`; words with a rank; and
    ends, each a contraction of the same map and a word.  s follows a word where its pieces apply to
    s, f(s), and so on.  For all parameters in the descent's domain and all states s of the space,
    f^n(s) tends to the point of one of the contractions; and each of the points is stable.

    Premises: the descent's domain is part of that of each contraction; no state of A follows a word
    `never`, where all states on the way are in A and in the space; such a state that follows a word
    of K pieces with a rank has rank(s) >= 0 and rank(f^K(s)) <= rank(s) - 1; and one that follows
    the word of an end is in the set `on` of its contraction.  Checked here: a sequence of pieces
    without an end that holds no word `never` and no word of an end repeats at last a word with a
    rank.

    f^n(s) is in A for all n >= M, by the descent.  If the pieces that apply from f^M(s) on held no
    word `never` and none of an end, some f^N(s) would follow a word with a rank again and again,
    and its rank would fall below 0.  They hold no word `never`, as all these states are in A and in
    the space; so they hold that of an end, and some f^(M+j)(s) is in the set `on`, where
    |f^(M+j+k)(s) - e| <= rate^k size for all k >= 0.
    """
    f = Orbits(earlier(statement, known, "descent"), known, work)
    # a relation may lead on by another piece than the one whose guard holds
    require(f.map.kind == "map", Kind.EARLIER, f"map {f.map.name}")
    never, ranks, words = map(statement.get, ("never", "rank", "word"))
    falling, words = words[: len(ranks)], words[len(ranks) :]
    require_no_other([*never, *words], falling, len(f.pieces), statement.name, work)
    stage = f.own.get("stage")[-1]
    f.roots = f.roots if names_in(stage) & (f.moving - {*f.state}) else []

    def following(word: Sequence[int], *rows: str) -> list[str]:
        """For all states of the last stage that follow a word, NAME_0 in place of NAME."""
        along: list[str] = []
        for now, lets, guard in f.follow(word)[0]:
            known = [put(row, now) for row in (f"given {f.space}", *f.roots, f"given {stage}")]
            along += [*lets, *known, f"given {guard}"]
        return f.for_all(*along, *rows, extra=[f"{name}_0" for name in f.state])

    premises = {}
    for i, word in enumerate(never):
        premises[f"never-{i + 1}"] = following(word, "show 0 = 1")
    for i, ((guards, terms), word) in enumerate(zip(ranks, falling)):
        # of the state alone: a rank that names a state on the way would change from time to time
        alone = names_in(*terms) <= {*f.parameters, *f.state}
        require(not guards and len(terms) == 1 and alone, Kind.VALUE, statement.name)
        last = [f"let {name}_next = {term}" for name, term in zip(f.state, f.follow(word)[1])]
        here = put(terms[0], {name: f"{name}_0" for name in f.state})
        falls = f"show ({here}) >= 0 and ({f.next(terms[0])}) <= ({here}) - 1"
        premises[f"falls-{i + 1}"] = following(word, *last, falls)
    for i, (one, word) in enumerate(zip(all_earlier(statement, known, "contraction"), words)):
        end = Orbits(one, known, work)
        require(f.map is end.map, Kind.OTHER_MAP, statement.name)
        roots = [root for root in end.fixed + end.roots if root not in f.fixed + f.roots]
        # by its own names: what moves here may be a root of parameters there
        first = {name: f"{name}_0" for name in end.moving}
        on = [put(row, first) for row in (*roots, f"show {end.own.get('on')[0]}")]
        premises[f"inside-{i + 1}"] = f.for_all(f"show {end.domain}")
        premises[f"ends-{i + 1}"] = following(word, *on)
    return premises


def premises_of_return(statement: Statement, known: Known, work: Work) -> Premises:
    """A map f; what `settles` says of a map g with the same parameters, state and space; and for
    each piece of g a word of pieces of f, by which g leads at once.  For all parameters in the
    descent's domain and all states s of the space, one of the points e of `settles` has f^(N+n)(s)
    - f^n(e) -> 0 for an integer N; f^n(e) is back at e after as many steps as the word of a piece
    has pieces; and for every d > 0 there is a c > 0 such that |f^n(s) - f^n(e)| < d for all n >= 0
    and all states s of the space with |s - e| < c.

    Premises: the descent's domain is part of f's domain; where the guard of a piece of g holds, the
    pieces of its word apply in turn, and their last image is that of g; the set `on` of each
    contraction of `settles` lies where one piece of g applies, the first of its word.

    An orbit of g is one of f with states left out.  On the set `on`, which g takes into itself and
    which has e in it, g is f^K by one word of length K, and for j < K f^j is one term in the state,
    made by + - * / and powers, so it is continuous.  g^n(s) is in that set from some n = M on, and
    tends to e; so for each j < K f^j(g^(M+n)(s)) -> f^j(e).  Likewise where s is near e: all g^n(s)
    are near it, in the set, and f^j of them near f^j(e).
    """
    f = Orbits(earlier(statement, known, "map"), known, work)
    settling = earlier(statement, known, "settling")
    g = Orbits(earlier(settling, known, "descent"), known, work)
    # on another space there are other orbits of f, and states near a point of which g says nothing
    same = all(f.map.get(key) == g.map.get(key) for key in ("over", "integer", "state", "space"))
    require(same, Kind.OTHER_MAP, statement.name)
    words = statement.get("word")
    require(len(words) == len(g.pieces), Kind.WORD_EACH, statement.name)
    premises = {"inside": g.for_all(f"show {f.domain}")}
    for k, (((guard,), images), word) in enumerate(zip(g.pieces, words)):
        rows = [f"given {g.space}", f"given {guard}"]
        steps, here = f.follow(word, f.state)
        for _, lets, applies in steps:
            # nothing is given on the way: that this piece applies is to be shown
            rows += [*lets, f"have {applies}"]
        same_end = all_of(f"({last}) = ({image})" for last, image in zip(here, images))
        premises[f"word-{k + 1}"] = g.for_all(*rows, f"show {same_end}", extra=g.state)
    ends = settling.get("word")[len(settling.get("rank")) :]
    for k, (one, word) in enumerate(zip(all_earlier(settling, known, "contraction"), ends)):
        end, ((guard,), _) = Orbits(one, known, work), at(g.pieces, word[0] - 1)
        on = f"given {g.domain}", f"given {end.own.get('on')[0]}"
        premises[f"piece-{k + 1}"] = end.at(*on, f"show {guard}")
    return premises


def require_no_other(words: Words, repeated: Words, letters: int, name: str, work: Work) -> None:
    """A sequence without an end, of letters from 1 on, that holds none of the words repeats at last
    one of those that may be repeated.

    An end (see `ways_on`) that no letter leads on from does not come back; nor do those on a circle
    from which no letter leads off, once one of them is left out: where it is reached, the letters
    round it are read for ever.  Without such ends nothing is left.
    """
    ways, again = ways_on(words, letters, work), {tuple(word) for word in repeated}
    while ways:
        # ends are looked up by each letter, and twice more
        work.spend((letters + 2) * sum(len(end) // 8 + 4 for end in ways))
        on = {e: {k: to for k, to in way.items() if to in ways} for e, way in ways.items()}
        on = {end: way for end, way in on.items() if way}
        if on == ways:
            circle = closed_circle(ways)
            once = [k for end in circle for k in ways[end]]
            work.spend(len(once) ** 2)
            turned = any((*once[n:], *once[:n]) in again for n in range(len(once)))
            require(turned, Kind.WORDS, name)
            on = {end: ways[end] for end in ways.keys() - {*circle}}
        ways = on


def ways_on(words: Words, letters: int, work: Work) -> dict[Word, dict[int, Word]]:
    """How sequences that hold none of the words are read a letter at a time: {end: {letter: the end
    that it leads to}}.

    Of what is read only the longest end is kept with which one of the words begins, and no letter
    is read by which a word is held.
    """
    work.spend(sum(len(word) ** 2 for word in words))
    held = {tuple(word) for word in words}
    begun = {word[:n] for word in held for n in range(len(word))}
    longest = max(map(len, held))
    ways: dict[Word, dict[int, Word]] = {}
    found: list[Word] = [()]
    while found:
        end = found.pop()
        if end not in ways:
            # to cut off an end and to look it up takes time that grows with its length
            work.spend(letters * (longest + longest**2 // 8 + 1))
            read = {k: [(*end, k)[n:] for n in range(len(end) + 1)] for k in range(1, letters + 1)}
            free = {k: ends for k, ends in read.items() if held.isdisjoint(ends)}
            ways[end] = {k: next(filter(begun.__contains__, e), ()) for k, e in free.items()}
            found += ways[end].values()
    return ways


def closed_circle(ways: Mapping[Word, Mapping[int, Word]]) -> list[Word]:
    """Ends each of which leads to the next alone, and the last to the first; none if there are none
    such.
    """
    seen: set[Word] = set()
    for end in ways:
        path: list[Word] = []
        while end not in seen and len(ways[end]) == 1:
            seen.add(end)
            path.append(end)
            (end,) = ways[end].values()
        if end in path:
            return path[path.index(end) :]
    return []


ORBIT_RULES = {
    "iterates": premises_of_iterates,
    "map": premises_of_map,
    "relation": premises_of_relation,
    "descends": premises_of_descent,
    "contracts": premises_of_contraction,
    "lyapunov": premises_of_lyapunov,
    "attracts": premises_of_attraction,
    "into": premises_of_attraction_into,
    "escapes": premises_of_escape,
    "unstable": premises_of_instability,
    "exactly": premises_of_sharpness,
    "settles": premises_of_settling,
    "returns": premises_of_return,
}


def orbit_rules() -> dict[str, str]:
    """{kind of statement: what its rule says}, for the rules for orbits of maps."""
    return {kind: str(rule.__doc__) for kind, rule in ORBIT_RULES.items()}


def premises_of(
    statement: Statement, known: Known, work: Work | None = None
) -> dict[str, Statement]:
    """The premises of an orbit rule, as statements that a certificate has to prove: {name:
    statement}.
    """
    premises = {}
    work = work or Work()
    none = Definitions(work)
    for name, rows in ORBIT_RULES[statement.kind](statement, known, work).items():
        full = f"{statement.name}.{name}"
        premises[name] = read_statements("\n".join([f"statement {full}", *rows]), none)[full]
    return premises


def check_orbit_rule(statement: Statement, certificate: Hint, known: Known, work: Work) -> None:
    """{premise: prove}: each of the premises that the rule asks for is proved, and there is no
    other.
    """
    premises = premises_of(statement, known, work)
    # what the statement asks for is shown, not what the certificate offers
    require(
        set(certificate) == set(premises), Kind.PREMISES, sorted(set(certificate) ^ set(premises))
    )
    for name, premise in premises.items():
        try:
            prove(premise, certificate[name], known, work=work)
        except Rejected as reason:
            raise reason.within(f"premise {name} of {statement.name}") from None
