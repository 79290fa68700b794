"""Stored certificates and statements, tampered with: a certificate never changes its verdict, and
what is still accepted is true.

`make test` takes a fixed sample of the statements and of the changes; with JUGGLEPROOF_MUTANTS=many
(make exhaust) every line of one stored statement in four is changed, and every field of its
certificate, or 100 of its fields where it has more.  A field is a key or a leaf of the JSON; of a
sum of more than LONG products, each product has one field changed, in turn.  Statements that differ
in nothing but their name, certificate and all, count once.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
import pickle
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from functools import cache
from multiprocessing import get_context
from typing import Any

from juggleproof.certificates import checker
from juggleproof.certificates.checker import orbits, rules
from tests.proofs.paper.independent import contradiction
from tests.proofs.paper.statement_mutants import changes
from tests.share import MANY, share
from tests.stored import STORE, statements

# one statement in so many; fields of its certificate; changes of each of its lines
SHARE, FIELDS, LINES = share((40, 12, 1), (4, 100, 2))
LONG = 30
KEY = "the key itself"
Tally = tuple[int, int, list[str]]  # tried, rejected, what should not have been accepted


def digest(*parts: Any) -> int:
    return int(hashlib.sha256("\n".join(map(str, parts)).encode()).hexdigest()[:8], 16)


@cache
def sample() -> list[str]:
    """The statements to tamper with, those with the longest certificates first."""
    different: dict[str, str] = {}
    for name, text in STORE.texts.items():
        stored = json.dumps(STORE.certificate(name, text)).replace(f'"{name}"', '""')
        different.setdefault(text.partition("\n")[2] + stored, name)
    chosen = [(len(key), name) for key, name in different.items() if digest(name) % SHARE == 0]
    return [name for _, name in sorted(chosen, reverse=True)]


# ------------------------------------------------------------ certificates


def fields(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The path of every field: a leaf's, or that of a key of an object with KEY behind it."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield (*path, key, KEY)
            yield from fields(item, (*path, key))
    elif isinstance(value, list):
        for place, item in enumerate(value):
            inner = list(fields(item, (*path, place)))
            yield from inner if len(value) <= LONG else inner[place % len(inner) :][:1]
    else:
        yield path


def changed(value: Any, path: tuple[Any, ...], which: int) -> Any:
    """The JSON value with the field at the path changed; what is not on the path is shared with the
    original.
    """
    first, *rest = path
    if rest == [KEY]:
        left = {key: item for key, item in value.items() if key != first}
        return left if which % 2 else {**left, first + "x": value[first]}
    new = changed(value[first], tuple(rest), which) if rest else leaf(value[first], which)
    return (
        {**value, first: new}
        if isinstance(value, dict)
        else [*value[:first], new, *value[first + 1 :]]
    )


def leaf(value: Any, which: int) -> Any:
    """A number one more or less; a text with a digit, a sign or a letter more."""
    if isinstance(value, int):
        return value + 1 if which % 2 else value - 1
    digits = [place for place, letter in enumerate(value) if letter.isdigit()]
    ways = [
        value[:place] + str((int(value[place]) + 1) % 10) + value[place + 1 :]
        for place in digits[:3]
    ]
    ways += [value.replace("-", "+", 1)] if "-" in value else [f"-{value}"]
    return [*ways, value + "1"][which % (len(ways) + 1)]


plain_close = rules.close
closed: dict[tuple[int, bytes], Any] = {}


class Plain(pickle.Pickler):
    """The bytes of a state, whatever work its check has left."""

    def persistent_id(self, thing: object) -> str | None:
        return "work" if isinstance(thing, checker.Work) else None


def bytes_of(state: rules.State) -> bytes:
    file = io.BytesIO()
    Plain(file).dump(state)
    return file.getvalue()


def close_once(state: rules.State, node: Any, known: dict[str, rules.Statement]) -> None:
    """The checker's `close`, which depends on nothing but what it is given: a node closes an equal
    state without being followed again.
    """
    if not isinstance(node, list) or len(node) < 2:
        return plain_close(state, node, known)
    key = (id(node), hashlib.sha256(bytes_of(state)).digest())
    if key not in closed:
        plain_close(state, node, known)
        closed[key] = node  # kept, so that its id is not given to another
    return None


plain_premises, plain_prove = orbits.premises_of, orbits.prove
premises: dict[str, dict[str, rules.Statement]] = {}
proved: dict[tuple[str, int], Any] = {}


def premises_once(
    statement: rules.Statement, known: dict[str, rules.Statement], work: checker.Work
) -> dict[str, rules.Statement]:
    """The checker's `premises_of`, which depends on nothing but the statement and what is known."""
    if statement.name not in premises:
        premises[statement.name] = plain_premises(statement, known, work)
    return premises[statement.name]


def prove_once(
    premise: rules.Statement, proof: Any, known: dict[str, rules.Statement], work: checker.Work
) -> None:
    """The checker's `prove`: a proof that a change elsewhere leaves as it is proves its premise
    again.
    """
    key = (premise.name, id(proof))
    if key not in proved:
        plain_prove(premise, proof, known, work=work)
        proved[key] = proof  # kept, so that its id is not given to another


@contextmanager
def nothing_twice() -> Iterator[None]:
    """While one statement's certificate is changed, what no change has touched is checked once."""
    for kept in (closed, premises, proved):
        kept.clear()
    rules.close, orbits.premises_of, orbits.prove = close_once, premises_once, prove_once
    try:
        yield
    finally:
        rules.close, orbits.premises_of, orbits.prove = plain_close, plain_premises, plain_prove


@cache
def certified_before(name: str) -> dict[str, rules.Statement]:
    """What the checker knows when it comes to a stored statement."""
    known = statements()
    before = list(known)[: list(known).index(name)]
    return {
        one: known[one] for one in before if "certified" in STORE.certificate(one, STORE.texts[one])
    }


def outcome(statement: rules.Statement, certificate: Any) -> str:
    return str(
        checker.check_one(statement, certificate, certified_before(statement.name), statements())[0]
    )


def claimed(certificate: Any) -> str:
    """What a certificate says beside its statement: the values that it names."""
    if "refuted" in certificate:
        return json.dumps(certificate)
    if isinstance(certificate["certified"], dict):  # premises, which the statement alone decides
        return json.dumps(sorted(certificate["certified"]))
    way, *_, last = certificate["certified"] or [""]
    return json.dumps(
        [
            (
                last
                if way == "witness"
                else certificate["certified"][1:2]
                if "point" not in certificate
                else ""
            ),
            certificate.get("point"),
        ]
    )


def tampered_certificate(name: str) -> Tally:
    good, text = STORE.certificate(name, STORE.texts[name]), STORE.texts[name]
    with nothing_twice():
        before, wrong, tried, rejected = outcome(statements()[name], good), [], 0, 0
        if before not in ("certified", "refuted"):
            wrong.append(f"{name}: its own certificate is {before}")
        paths = sorted(fields(good), key=lambda path: digest(name, path))[:FIELDS]
        told: set[str] = set()
        for path in paths:
            bad = changed(good, path, digest(path, name))
            after = outcome(statements()[name], bad)
            tried, rejected = tried + 1, rejected + (after == "rejected")
            if after not in ("rejected", before):
                wrong.append(f"{name}: {before} became {after} with {path} changed")
            elif after != "rejected" and claimed(bad) not in told:
                told.add(claimed(bad))
                if (
                    point := contradiction(text, after, bad, STORE.texts, certified_before(name))
                ) is not None:
                    wrong.append(f"{name}: accepted with {path} changed, and false at {point}")
    return tried, rejected, wrong


# ------------------------------------------------------------ statements


def tampered_statements(text: str) -> Iterator[str]:
    """The statement with one mark of one line changed, a name exchanged for another, or the line
    left out.
    """
    rows = text.splitlines()
    names = [name for row in rows if row.startswith("forall ") for name in row.split()[1:]]
    for place, row in enumerate(rows[1:], 1):
        keyword, _, said = row.partition(" ")
        marks = [f"{said[:start]}{new}{said[end:]}" for start, end, new in changes(said)]
        words = said.split(" ")
        marks += [
            " ".join([*words[:k], names[digest(row) % len(names)], *words[k + 1 :]])
            for k, word in enumerate(words)
            if word in names
        ]
        marks = sorted(
            {mark for mark in marks if mark != said}, key=lambda mark: digest(text, mark)
        )
        for mark in marks[:LINES]:
            yield "\n".join([*rows[:place], f"{keyword} {mark}", *rows[place + 1 :]])
        if MANY or digest(row) % 3 == 0:
            yield "\n".join([*rows[:place], *rows[place + 1 :]])


def tampered_statement(name: str) -> Tally:
    text, tried, rejected, wrong = STORE.texts[name], 0, 0, []
    good = STORE.certificate(name, text)
    for other in tampered_statements(text):
        tried += 1
        try:
            after = outcome(checker.read_statements(other)[name], good)
        except checker.Rejected:
            after = "rejected"
        rejected += after == "rejected"
        if (
            after != "rejected"
            and (point := contradiction(other, after, good, STORE.texts, certified_before(name)))
            is not None
        ):
            wrong.append(f"{after}, but false at {point}:\n{other}")
    return tried, rejected, wrong


def over_all(work: Any) -> Tally:
    """The sum of what the work on each statement of the sample tells."""
    with ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("fork")) as pool:
        tallies = list(pool.map(work, sample()))
    return (
        sum(one[0] for one in tallies),
        sum(one[1] for one in tallies),
        [wrong for one in tallies for wrong in one[2]],
    )


def test_tampered_certificate_never_changes_the_outcome_holds() -> None:
    tried, rejected, wrong = over_all(tampered_certificate)
    assert not wrong, wrong[0]
    assert tried > (8_000 if MANY else 200) and rejected > 0.9 * tried


def test_tampered_statement_that_its_certificate_still_proves_is_true_holds() -> None:
    tried, rejected, wrong = over_all(tampered_statement)
    assert not wrong, wrong[0]
    assert tried > (1_500 if MANY else 100) and rejected > tried / 2
