"""Stored certificates and statements, tampered with: a certificate never changes its verdict, and what it still proves is true."""

from __future__ import annotations

import copy
import hashlib
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

from independent import Independent
from statement_mutants import mutants

from certificates import checker
from certificates.store import DEFAULT, Store

SHARE = 5 if os.environ.get("JUGGLEPROOF_MUTANTS") == "all" else 40
STORE = Store(DEFAULT)
STATEMENTS = checker.read_statements("\n\n".join(STORE.texts.values()))


def sample() -> list[str]:
    """A fixed choice of universal statements that stand by themselves."""
    return [name for name, statement in STATEMENTS.items()
            if statement.kind == "universal" and int(hashlib.sha256(name.encode()).hexdigest()[:6], 16) % SHARE == 0]


def tampered(value: Any) -> Iterator[Any]:
    """Every copy of a JSON value with one leaf changed, one item dropped, or two neighbours exchanged."""
    if isinstance(value, int):
        yield value + 1
        yield value - 1
    elif isinstance(value, str):
        digits = [i for i, letter in enumerate(value) if letter.isdigit()]
        for i in digits[:3]:
            yield value[:i] + str((int(value[i]) + 1) % 10) + value[i + 1:]
        yield value + "1"
        if "-" in value:
            yield value.replace("-", "+", 1)
    elif isinstance(value, list):
        for i, item in enumerate(value):
            yield value[:i] + value[i + 1:]
            if i:
                yield [*value[:i - 1], item, value[i - 1], *value[i + 1:]]
            for other in tampered(item):
                yield [*value[:i], other, *value[i + 1:]]
    elif isinstance(value, dict):
        for key, item in value.items():
            yield {k: v for k, v in value.items() if k != key}
            yield {**{k: v for k, v in value.items() if k != key}, key + "x": item}
            for other in tampered(item):
                yield {**value, key: other}


def outcome(statement: checker.Statement, certificate: Any) -> str:
    return str(checker.check_one(statement, copy.deepcopy(certificate), {}, {})[0])


def test_tampered_certificate_never_changes_the_outcome_holds() -> None:
    tried = rejected = 0
    for name in sample():
        good = STORE.certificate(name, STORE.texts[name])
        before = outcome(STATEMENTS[name], good)
        assert before in ("certified", "refuted"), name
        for number, bad in enumerate(tampered(good)):
            if number > 60:
                break
            after = outcome(STATEMENTS[name], bad)
            assert after in ("rejected", before), (name, before, after)
            tried, rejected = tried + 1, rejected + (after == "rejected")
    assert tried > 300 and rejected > tried / 2


def test_tampered_statement_that_its_certificate_still_proves_is_true_holds() -> None:
    accepted = tried = 0
    for name in sample():
        text = STORE.texts[name]
        good = STORE.certificate(name, text)
        if "certified" not in good or any(f"\n{word} " in text for word in ("exists", "integer")):
            continue
        for _, mutant in list(mutants(text, ("range", "given", "show")))[:20]:
            try:
                parsed = checker.read_statements(mutant)[name]
            except checker.Rejected:
                continue
            tried += 1
            if outcome(parsed, good) == "certified":
                accepted += 1
                assert Independent(mutant).counterexample(2_000) is None, mutant
    assert tried > 50
