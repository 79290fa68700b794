"""What settles a statement: the rules for the orbits of maps, one statement, and a folder of them.

ORBIT RULES say what holds of every orbit of a map.  Each writes its premises itself, as text, and a
certificate has to prove exactly these.
"""

from __future__ import annotations

import json
import os
import re
import stat
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Literal, NoReturn, TypeVar

from .algebra import MAX_WORK, Kind, Rejected, Work, require
from .language import (
    Context,
    Known,
    Statement,
    Unfolding,
    read_statements,
)
from .rules import Hint, State, at, check_sharp, find, prove
from .text import names_in, put

MAX_FILE = 16 << 20
MAX_STATEMENTS = 2 << 20  # a syntax tree takes some 500 bytes for a letter
MAX_FOLDER_WORK = 10**9  # for all statements of a folder
MAX_REFUSED = 1000  # lines of certificates, after which no more are read
PER_LETTER = 20  # elementary products that a letter of a premise stands for
STATEMENTS = "statements.txt"
CERTIFICATES = "certificates.jsonl"

Premises = Mapping[str, list[str]]  # {name: lines of a statement}
Check = Callable[[Statement, Hint, Known, Known, Work], tuple[str, Rejected | None]]
T = TypeVar("T")


# ------------- ORBIT RULES: what holds of every orbit of a map, from premises that this file writes


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


class Orbits:
    """A map with the lines of a statement about it, from which the text of the premises is
    written.
    """

    def __init__(self, statement: Statement, known: Known, work: Work) -> None:
        self.own = statement
        self.work = work
        if statement.kind == "map":
            self.map = statement
        else:
            self.map = earlier_of("map", statement.text("map"), known)
        (self.parameters,) = self.map.get("over")
        (self.state,) = self.map.get("state")
        (self.space,) = self.map.get("space")
        (self.domain,) = statement.rows("domain")
        self.pieces = self.map.get("piece")
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
        # nothing but parameters and state: x_next in a guard would mean the image itself
        named = names_in(*(text for piece in self.pieces for side in piece for text in side))
        require(fits and named <= {*self.parameters, *self.state}, Kind.PIECE, self.map.name)

    def next(self, text: str) -> str:
        """The same of the next state."""
        return put(text, {name: name + "_next" for name in self.moving})

    def for_all(self, *rows: str, extra: Sequence[str] = ()) -> list[str]:
        """For all parameters in the domain, with the roots of parameters."""
        forall = "forall " + " ".join([*self.parameters, *extra])
        # a map of 1,500 pieces has a million pairs of them: the text is counted as it grows
        self.work.spend(PER_LETTER * sum(map(len, [*self.fixed, self.domain, *rows])))
        return [forall, f"range {self.domain}", *self.fixed, *rows]

    def at(self, *rows: str, extra: Sequence[str] = ()) -> list[str]:
        """For all parameters in the domain and all states of the space."""
        return self.for_all(f"given {self.space}", *self.roots, *rows, extra=[*self.state, *extra])

    def step(self, k: int, *rows: str, show: str, extra: Sequence[str] = ()) -> list[str]:
        """Where the k-th piece applies: something of the next state, which is in the space by the
        map's premises.
        """
        (guard,), images = self.pieces[k]
        image = [f"let {name}_next = {image}" for name, image in zip(self.state, images)]
        known = []
        if self.own is not self.map:  # else the map would be assumed to do what is to be shown
            known = ["given " + self.next(self.space), *map(self.next, self.roots)]
        return self.at(*rows, f"given {guard}", *image, *known, f"show {show}", extra=extra)

    def terms(self, keyword: str) -> list[str]:
        """One term for each state variable, in the parameters."""
        terms: list[str]
        (terms,) = self.own.get(keyword)
        constants = {*self.parameters, *(line.split(" ")[1] for line in self.fixed)}
        # with a state variable in it, the point would move with the state
        fits = len(terms) == len(self.state) and names_in(*terms) <= constants
        require(fits, Kind.STATE_TERMS, self.own.name)
        return terms

    def with_domain(self, premises: Premises) -> Premises:
        """Beside other premises: a state of the space, for parameters in the domain, which is part
        of the map's domain.
        """
        some = "exists " + " ".join([*self.parameters, *self.state])
        possible = [some, f"with {self.domain}", f"show {self.space}"]
        inside = {}
        if self.own is not self.map:
            (whole,) = self.map.rows("domain")
            inside = {"inside": self.for_all("show " + whole)}
        return {"possible": possible, **inside, **premises}


def earlier_of(kind: str, name: str, known: Known) -> Statement:
    """A statement that another rests on: an earlier one, certified, of the kind that it needs."""
    require(name in known and known[name].kind == kind, Kind.EARLIER, f"{kind} {name}")
    return known[name]


def all_of(parts: Iterable[str], op: str = " and ") -> str:
    return op.join(f"({part})" for part in parts)


def premises_of_map(statement: Statement, known: Known, work: Work) -> Premises:
    """A map f of the space into itself: for all parameters in the domain, each state of the space
    has exactly one piece whose guard holds, f(state) is given by that piece, and f(state) is in the
    space.
    """
    f = Orbits(statement, known, work)
    guards = [guard for (guard,), _ in f.pieces]
    premises = {"covers": f.at("show " + all_of(guards, " or "))}
    for i, guard in enumerate(guards):
        for k in range(i):
            both = f"given {guard}", f"given {guards[k]}"
            premises[f"apart-{i + 1}-{k + 1}"] = f.at(*both, "show 0 = 1")
    for k in range(len(guards)):
        premises[f"stays-{k + 1}"] = f.step(k, show=f.next(f.space))
    return f.with_domain(premises)


def premises_of_descent(statement: Statement, known: Known, work: Work) -> Premises:
    """Descent of a rank to a trap: stages A_1, .., A_m.  For all parameters in the domain and all
    states s of the space, f^N(s) is in A_m for every integer N >= rank(s) + m - 1.

    Premises: rank >= 0; outside of all stages rank(f(s)) <= rank(s) - 1; f takes A_k into A_(k+1),
    and A_m into itself. So the first visit to a stage is after at most rank(s) steps, and m - 1
    more steps, or fewer, lead to A_m.
    """
    f = Orbits(statement, known, work)
    (rank,) = statement.get("rank")
    stages = statement.get("stage")
    outside = f"given not ({all_of(stages, ' or ')})"
    premises = {"bounded": f.at(f"show ({rank}) >= 0")}
    for k in range(len(f.pieces)):
        falls = f"({f.next(rank)}) <= ({rank}) - 1"
        premises[f"falls-{k + 1}"] = f.step(k, outside, show=falls)
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

    def within(distance: str, names: Sequence[str]) -> str:
        parts = []
        for name, e, weight in zip(names, point, weights):
            reach = f"({distance})*({weight})"
            parts.append(f"-{reach} <= {name} - ({e}) and {name} - ({e}) <= {reach}")
        return all_of(parts)

    positive = [f"({c}) > 0" for c in [*weights, radius, size]]
    after = [name + "_next" for name in f.state]
    at_point = [f"let {name} = {e}" for name, e in zip(after, point)]
    premises = {
        "constants": f.for_all("show " + all_of([f"({rate}) >= 0", f"({rate}) < 1", *positive])),
        "point": f.for_all(*at_point, "show " + put(f.space, dict(zip(f.state, after)))),
        "surrounds": f.at("given " + within(radius, f.state), f"show {on}"),
        "size": f.at(f"given {on}", "show " + within(size, f.state)),
    }
    near = ["given distance >= 0", "given " + within("distance", f.state)]
    nearer = within(f"({rate})*distance", after)
    for k in range(len(f.pieces)):
        premises[f"stays-{k + 1}"] = f.step(k, f"given {on}", show=f.next(on))
        closer = f.step(k, f"given {on}", *near, show=nearer, extra=["distance"])
        premises[f"closer-{k + 1}"] = closer
    return f.with_domain(premises)


def premises_of_attraction(statement: Statement, known: Known, work: Work) -> Premises:
    """A descent whose last stage lies in the set of a contraction of the same map.  For all
    parameters in the descent's domain, the point is stable, f^n(s) tends to it for all states s of
    the space, and |f^(N+k)(s) - e| <= rate^k size for all integers N >= rank(s) + m - 1, k >= 0.
    """
    f = Orbits(earlier_of("descends", statement.text("descent"), known), known, work)
    other = Orbits(earlier_of("contracts", statement.text("contraction"), known), known, work)
    # the very statement: two maps may have the same text, and other certificates
    require(f.map is other.map, Kind.OTHER_MAP, statement.name)
    # a root of one name for two terms is declared twice, and refused
    roots = [root for root in other.fixed + other.roots if root not in f.fixed + f.roots]
    last, on = f.own.get("stage")[-1], other.own.get("on")[0]
    return {
        "inside": f.for_all(f"show {other.domain}"),
        "enters": f.at(*roots, f"given {last}", f"show {on}"),
    }


def premises_of_escape(statement: Statement, known: Known, work: Work) -> Premises:
    """A periodic orbit: for all parameters in the domain the start is in the space, f^n(start) =
    start for the length n of the word of pieces, and start is not the point; so the orbit of the
    start does not tend to the point.
    """
    f = Orbits(statement, known, work)
    (word,) = statement.get("word")
    require(word, Kind.WORD, statement.name)  # after no step, every start is back
    here = f.terms("start")
    rows = [f"let {name}_point = {e}" for name, e in zip(f.state, f.terms("point"))]
    first = {name: f"{name}_0" for name in f.state}
    apart = all_of((f"{name}_0 != {name}_point" for name in f.state), " or ")
    shown = [put(f.space, first)]
    for count, piece in enumerate(word):
        (guard,), images = at(f.pieces, piece - 1)
        now = {name: f"{name}_{count}" for name in f.state}
        work.spend(PER_LETTER * sum(map(len, [guard, *here, *images])))
        rows += [f"let {now[name]} = {term}" for name, term in zip(f.state, here)]
        shown.append(put(guard, now))
        if count == 0:
            shown.append(apart)
        here = [put(image, now) for image in images]
    shown += [f"{name}_0 = ({last})" for name, last in zip(f.state, here)]
    return f.with_domain({"start": f.for_all(*rows, "show " + all_of(shown))})


def premises_of_sharpness(statement: Statement, known: Known, work: Work) -> Premises:
    """An attraction and an escape, from the same point of the same map, on domains that make up the
    map's.  For all parameters in the map's domain: the point is stable and attracts every state of
    the space <=> the parameters are in the domain of the attraction's descent.
    """
    attraction = earlier_of("attracts", statement.text("attraction"), known)
    f = Orbits(known[attraction.text("descent")], known, work)
    inner = Orbits(known[attraction.text("contraction")], known, work)
    other = Orbits(earlier_of("escapes", statement.text("escape"), known), known, work)
    require(f.map is other.map, Kind.OTHER_MAP, statement.name)
    roots = [root for root in inner.fixed if root not in other.fixed]
    points = zip(inner.terms("point"), other.terms("point"))
    same = all_of(f"({one}) = ({two})" for one, two in points)
    return {
        "covers": Orbits(f.map, known, work).for_all(f"show ({f.domain}) or ({other.domain})"),
        "same-point": other.for_all(*roots, f"show {same}"),
    }


ORBIT_RULES = {
    "iterates": premises_of_iterates,
    "map": premises_of_map,
    "descends": premises_of_descent,
    "contracts": premises_of_contraction,
    "attracts": premises_of_attraction,
    "escapes": premises_of_escape,
    "exactly": premises_of_sharpness,
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
    for name, rows in ORBIT_RULES[statement.kind](statement, known, work or Work()).items():
        full = f"{statement.name}.{name}"
        premises[name] = read_statements("\n".join([f"statement {full}", *rows]))[full]
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


# ------------------------------------------------------------ one statement


def settle(
    statement: Statement,
    certificate: Hint,
    known: Known,
    statements: Known,
    work: Work,
) -> str:
    """The outcome: {"unknown": why}, {"refuted": found}, {"certified": proof} or, for all but sharp
    and the orbit rules, {.., "point": found}.

    A certified statement carries a point that meets its premises, so that it says something.  A
    refuted one has a counterexample.
    """
    keys = sorted(certificate) if isinstance(certificate, dict) else []
    if keys == ["unknown"]:
        return "unknown"
    if statement.kind != "universal":
        require(keys == ["certified"], Kind.KEYS, keys)  # such a statement is never refuted
        if statement.kind == "sharp":
            check_sharp(statement, certificate["certified"], known, statements, work)
        else:
            check_orbit_rule(statement, certificate["certified"], known, work)
        return "certified"
    state = State(Context(work=work))
    named = {statement.name: statement}
    if keys == ["refuted"]:
        # else a line could use a root that stands below it, or divide by what a value makes nonzero
        Unfolding(statement, Context(work=work))
        find(state, certificate["refuted"], known, "counterexample", named, {})
        return "refuted"
    # without a point, premises that contradict each other would certify anything
    require(keys == ["certified", "point"], Kind.KEYS, keys)
    prove(statement, certificate["certified"], known, work=work)
    find(state, certificate["point"], known, "point", named, {})
    return "certified"


def check_one(
    statement: Statement,
    certificate: Hint,
    known: Known,
    earlier: Known,
    work: Work | None = None,
) -> tuple[str, Rejected | None]:
    """(outcome, None), or ("rejected", why).

    known: the certified statements before it, by name; earlier: all statements before it; work: the
    meter that it spends from.
    """
    return verdict(settle, statement, certificate, known, earlier, work or Work())


def verdict(
    check: Callable[..., T], *arguments: object
) -> tuple[T | Literal["rejected"], Rejected | None]:
    """(what the check returns, None), or ("rejected", why): whatever is wrong with a certificate is
    a rejection, never a crash.
    """
    try:
        return check(*arguments), None
    except Rejected as reason:
        return "rejected", reason
    except Exception as error:
        return "rejected", Rejected(Kind.MALFORMED, type(error).__name__)


# ------------------------------------------------------------ files


def load(path: str, limit: int = MAX_FILE) -> str:
    """The text of a file of printable ASCII, whose lines end in a newline alone."""
    try:
        # a pipe or a device might never end, and opening a pipe wait for ever
        require(stat.S_ISREG(os.stat(path).st_mode), Kind.FILE, path)
        with open(path, "rb") as file:
            content = file.read(limit + 1)
    except OSError as error:
        raise Rejected(Kind.FILE, f"{path} ({type(error).__name__})") from None
    # a carriage return, or a letter that looks like another, could hide a line from who reads it
    fits = len(content) <= limit and not re.search(rb"[^\x20-\x7e\n]", content)
    require(fits, Kind.CHARACTERS, path)
    return content.decode("ascii")


def unique(pairs: list[tuple[str, Hint]]) -> dict[str, Hint]:
    """A JSON object: a key that stands twice would mean one thing to one reader, and another to
    the next.
    """
    require(len(dict(pairs)) == len(pairs), Kind.KEY_TWICE, lambda: sorted(key for key, _ in pairs))
    return dict(pairs)


def refuse(text: str) -> NoReturn:
    raise Rejected(Kind.INEXACT, text)


def read_certificate(line: str) -> tuple[str, Hint]:
    """(name, certificate) of one line, ["ID/part", {...}]."""
    try:
        data = json.loads(line, object_pairs_hook=unique, parse_float=refuse, parse_constant=refuse)
    except (ValueError, RecursionError) as error:
        raise Rejected(Kind.CERTIFICATE_LINE, error) from None
    pair = isinstance(data, list) and len(data) == 2 and isinstance(data[0], str)
    require(pair, Kind.CERTIFICATE_LINE)
    name, certificate = data
    return name, certificate


def read_certificates(text: str) -> tuple[dict[str, Hint], list[tuple[int, Rejected]]]:
    """({name: certificate}, [(line, reason)]): what the lines say, and those that are refused.

    The lines are sorted by name, and end in a newline, so that none can be added, doubled or cut
    unseen.
    """
    certificates: dict[str, Hint] = {}
    refused: list[tuple[int, Rejected]] = []
    last = ""
    lines = text.split("\n")
    if lines.pop():
        refused.append((len(lines) + 1, Rejected(Kind.CERTIFICATE_LINE, "no newline at the end")))
    for count, line in enumerate(lines, 1):
        if len(refused) > MAX_REFUSED:
            break  # what is not read certifies nothing
        try:
            name, certificate = read_certificate(line)
            require(name not in certificates, Kind.CERTIFICATE_TWICE, name)
            require(name > last, Kind.CERTIFICATE_ORDER, name)
            certificates[name] = certificate
            last = name
        except Rejected as reason:
            refused.append((count, reason))
    return certificates, refused


def check_folder(folder: str, check: Check = check_one) -> list[tuple[str, str, str]]:
    """[(name, outcome, reason)] for every statement of a folder in order, then for every line of
    certificates that is refused or has no statement.
    """
    left = MAX_FOLDER_WORK
    statements = read_statements(load(os.path.join(folder, STATEMENTS), MAX_STATEMENTS))
    results: list[tuple[str, str, str]] = []
    certificates: dict[str, Hint] = {}
    rest: list[tuple[str, Rejected]] = []
    try:
        certificates, refused = read_certificates(load(os.path.join(folder, CERTIFICATES)))
        rest += [(f"{CERTIFICATES}, line {count}", reason) for count, reason in refused]
    except Rejected as unread:
        rest.append((CERTIFICATES, unread))
    known: dict[str, Statement] = {}
    earlier: dict[str, Statement] = {}
    for name, statement in statements.items():
        outcome: str = "rejected"
        reason: Rejected | None = Rejected(Kind.NO_CERTIFICATE)
        if name in certificates:
            limit = min(MAX_WORK, left)
            work = Work(limit)
            outcome, reason = check(statement, certificates.pop(name), known, earlier, work)
            left -= limit - work.left
        results.append((name, outcome, str(reason) if reason else ""))
        earlier[name] = statement
        if outcome == "certified":
            known[name] = statement
    rest += [(name, Rejected(Kind.LEFT_OVER)) for name in certificates]
    return results + [(name, "rejected", str(why)) for name, why in rest]


def report(results: list[tuple[str, str, str]]) -> int:
    """Prints what is rejected, and how many statements have which outcome; 0 where every one is
    certified or refuted, else 1.
    """
    for name, outcome, reason in results:
        if outcome == "rejected":
            # ascii: a name from a certificate cannot write a line of its own
            print("rejected ", ascii(f"{name}: {reason}")[1:-1])
    counts = []
    for kind in ("certified", "refuted", "unknown", "rejected"):
        counts.append(f"{sum(outcome == kind for _, outcome, _ in results)} {kind}")
    print(f"{len(results)} statements: " + ", ".join(counts))
    return int(not results or any(outcome in ("rejected", "unknown") for _, outcome, _ in results))


def main(arguments: list[str]) -> int:
    """Checks the folder named, or the store beside this folder; the exit code."""
    beside = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "store")
    try:
        require(len(arguments) < 2, Kind.FILE, "name one folder")
        return report(check_folder(arguments[0] if arguments else beside))
    except Rejected as reason:
        print("checker:", ascii(str(reason))[1:-1], file=sys.stderr)
        return 2
