"""The tree of a map rule: the rules that its conclusion rests on, and the premises that the checker
writes, down to the inequalities.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence

from juggleproof.certificates import checker
from juggleproof.judging.conclusions import PROVED
from juggleproof.papers.paper import opened
from juggleproof.statements.language import ClaimError, lemmas_of, rests_on
from juggleproof.statements.store import Store, WrittenOut
from juggleproof.statements.vote import Vote

STANDS, LOST = f"theorem: {PROVED}", f"theorem: NOT {PROVED}"


def rules_of(store: Store, names: Iterable[str] | None = None) -> dict[str, checker.Statement]:
    """The stored map rules by name: all, or those among `names` and the statements these name."""
    if not isinstance(store.texts, WrittenOut):
        return {}
    statements = store.texts.read(store.texts if names is None else names)
    return {
        name: one
        for name, one in statements.items()
        if one.kind in checker.orbit_rules() and one.kind != "iterates"
    }


def with_all_below(name: str, rules: Mapping[str, checker.Statement]) -> list[str]:
    """The rule and all rules that it rests on, each once, in order of discovery; none where one of
    them is missing.
    """
    names = [name]
    for one in names:
        if one not in rules:
            return []
        names += [inner for inner in rests_on(rules[one]) if inner not in names]
    return names


def digest_of(texts: Iterable[str]) -> str:
    """A digest of statements in order, with definitions written out."""
    return hashlib.sha256("\n\n".join(texts).encode()).hexdigest()


def name_of_theorem() -> tuple[str, ...]:
    """The name of the theorem's statement; none where the paper has no theorem."""
    theorem = opened().theorem
    return () if theorem is None else (theorem.name,)


def theorem_line(
    store: Store, outcomes: Mapping[str, str], votes: Mapping[str, Sequence[Vote]] | None = None
) -> str:
    """The line about the theorem: that it is proved, with the number of statements that it rests
    on, and their rules; or the statement that is not certified; or that the store has another
    statement under its name.

    Empty where the store does not have it, or the paper has no theorem.
    """
    theorem = opened().theorem
    if theorem is None or theorem.name not in store.texts:
        return ""
    rules = rules_of(store, [theorem.name])
    names = with_all_below(theorem.name, rules)
    if digest_of(store.texts[name] for name in names) != theorem.digest:
        return f"{LOST}; {theorem.name}, or what it rests on, is not as the sources state it"
    used = set().union(*(lemmas_of(store.certificate(name, store.texts[name])) for name in names))
    cast = [
        vote
        for name, each in (votes or {}).items()
        if name.rpartition(".")[0] in names
        for vote in each
    ]
    decided = [
        f"{route} {sum(vote.answer == 'holds' for vote in cast if vote.route == route)}"
        for route in ("z3", "boxes")
        if cast
    ]
    lost = [name for name in [*sorted(used), *reversed(names)] if outcomes.get(name) != "certified"]
    if lost:
        return f"{LOST}; {lost[0]} is not certified, and {theorem.name} rests on it"
    count = sum(len(checker.premises_of(rules[name], rules)) for name in names)
    kinds = ", ".join(dict.fromkeys(rules[name].kind for name in reversed(names)))
    return (
        f"{STANDS} by exact certificates: {theorem.sentence};\n         {theorem.name} rests on"
        f" {len(names) + len(used)} statements with {count} premises, under the checker's rules"
        f" {kinds}"
        + (
            f";\n         recorded votes for the premises: {', '.join(decided)} of {count}"
            if decided
            else ""
        )
        + "".join(f"\n         {line}" for line in theorem.witness)
    )


def print_tree(claim_id: str, resting: Sequence[str], store: Store, with_premises: bool) -> None:
    """Prints the trees of the claim's map rules, and of those it rests on, unless inside another.

    Raises ClaimError where premises are asked for, and the claim has no map rule and rests on none.
    """
    own = [name for name in store.texts if name.split("/")[0] == claim_id]
    rules = rules_of(store, [*own, *resting])
    roots = [
        *(name for name in rules if name in own),
        *(name for name in resting if name in rules),
    ]
    if not roots:
        if with_premises:
            raise ClaimError(
                f"{claim_id} has no map rules, so that no premises are written; its statements are"
                " all there is"
            )
        return
    roots = [name for name in roots if not any(name in rests_on(rules[other]) for other in roots)]
    print(
        "\nrests on    each rule, its premises as the checker writes them, and the rules that it"
        " names"
    )
    shown: dict[str, Mapping[str, checker.Statement]] = {}
    for name in roots:
        _branch(name, 1, rules, store, shown)
    count = sum(map(len, shown.values()))
    print(
        f"  {len(shown)} rules, {count} premises, each an inequality or identity of polynomials"
        + ("" if with_premises else " (--premises prints their texts)")
    )
    for premises in shown.values() if with_premises else ():
        for premise in premises.values():
            print("\n    " + premise.text().replace("\n", "\n    "))


def _branch(
    name: str,
    depth: int,
    rules: Mapping[str, checker.Statement],
    store: Store,
    shown: dict[str, Mapping[str, checker.Statement]],
) -> None:
    if name in shown:
        print(f"{'  ' * depth}{name} (above)")
        return
    shown[name] = premises = checker.premises_of(rules[name], rules)
    used = sorted(lemmas_of(store.certificate(name, store.texts[name])))
    print(
        f"{'  ' * depth}{name}: {len(premises)} premises: {' '.join(premises)}"
        + (f"; by {', '.join(used)}" if used else "")
    )
    for inner in rests_on(rules[name]):
        _branch(inner, depth + 1, rules, store, shown)
