"""What follows from map rules; how it rests on premises."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from juggleproof.certificates import checker
from juggleproof.certificates.language import (
    NO_ROLES,
    ClaimError,
    End,
    Roles,
    bounds_of,
    interval_text,
    rests_on,
)
from juggleproof.certificates.store import Store
from juggleproof.certificates.votes.vote import Vote
from juggleproof.proofs.theorem import SENTENCE, THEOREM

# -------------------------------------------------------------------------------------------------
# How the conclusion of a map rule rests on other rules, and on premises that the checker writes:
# down to the inequalities.


def rules_of(store: Store) -> dict[str, Any]:
    """The stored statements under map rules, by name."""
    texts = [
        text
        for text in store.texts.values()
        if not text.split("\n")[1].startswith(("forall ", "sharp "))
    ]
    statements = checker.read_statements("\n\n".join(texts))
    return {
        name: one
        for name, one in statements.items()
        if one.kind in checker.ORBIT_RULES and one.kind != "iterates"
    }


def with_all_below(name: str, rules: Mapping[str, Any]) -> list[str]:
    """The rule and all rules that it rests on, each once, those that rest on others first."""
    found = [name]
    for one in found:
        found += [inner for inner in rests_on(rules[one]) if inner not in found]
    return found


def theorem_line(
    store: Store, outcomes: Mapping[str, str], votes: Mapping[str, Sequence[Vote]] | None = None
) -> str:
    """One line for the theorem: proved, resting on how many statements, and under which rules; or
    where its proof is lost.

    Empty where the store does not hold it.
    """
    if THEOREM not in store.texts:
        return ""
    rules = rules_of(store)
    names = with_all_below(THEOREM, rules)
    used = set().union(*(lemmas(store.certificate(name, store.texts[name])) for name in names))
    told = [
        vote
        for name, cast in (votes or {}).items()
        if name.rpartition(".")[0] in names
        for vote in cast
    ]
    decided = [
        f"{route} {sum(vote.answer == 'holds' for vote in told if vote.route == route)}"
        for route in ("z3", "boxes")
        if told
    ]
    lost = [name for name in [*sorted(used), *reversed(names)] if outcomes.get(name) != "certified"]
    if lost:
        return f"theorem: NOT proved; {lost[0]} is not certified, and {THEOREM} rests on it"
    count = sum(len(checker.premises_of(rules[name], rules)) for name in names)
    kinds = ", ".join(dict.fromkeys(rules[name].kind for name in reversed(names)))
    return (
        f"theorem: proved by exact certificates: {SENTENCE};\n         {THEOREM} rests on"
        f" {len(names) + len(used)} statements with {count} premises, under the checker's rules"
        f" {kinds}"
        + (
            f";\n         votes for the premises: {', '.join(decided)} of {count}"
            if decided
            else ""
        )
        + "\n         `make coq` proves the same from the definition of the map alone"
    )


def print_tree(claim_id: str, resting: Sequence[str], store: Store, with_premises: bool) -> None:
    """Prints, for each conclusion that no other of the claim's rules rests on, what it rests on.

    Raises ClaimError where premises are asked for and the claim neither is a map rule nor rests on
    one.
    """
    rules = rules_of(store)
    roots = [
        *(name for name in rules if name.split("/")[0] == claim_id),
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
    shown: dict[str, Mapping[str, Any]] = {}
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
    rules: Mapping[str, Any],
    store: Store,
    shown: dict[str, Mapping[str, Any]],
) -> None:
    if name in shown:
        print(f"{'  ' * depth}{name} (above)")
        return
    shown[name] = premises = checker.premises_of(rules[name], rules)
    used = sorted(lemmas(store.certificate(name, store.texts[name])))
    print(
        f"{'  ' * depth}{name}: {len(premises)} premises: {' '.join(premises)}"
        + (f"; by {', '.join(used)}" if used else "")
    )
    for inner in rests_on(rules[name]):
        _branch(inner, depth + 1, rules, store, shown)


def lemmas(certificate: Any) -> set[str]:
    """The earlier statements that a certificate uses."""
    if isinstance(certificate, Mapping):
        return set().union(*map(lemmas, certificate.values()))
    if not isinstance(certificate, list):
        return set()
    own = {certificate[1]} if len(certificate) == 5 and certificate[0] == "use" else set()
    return own.union(*map(lemmas, certificate))


# -------------------------------------------------------------------------------------------------
# What follows from map rules: verdicts that wait for rules of other claims, and the range of the
# parameter for which a rule speaks.

if TYPE_CHECKING:
    from juggleproof.proofs.judging import Judgement


def settle_by_rules(
    judgements: Sequence[Judgement], outcomes: Mapping[str, str], texts: Mapping[str, str]
) -> None:
    """Gives each judgement that rests on map rules its verdict and range, now that the outcomes of
    all statements are known.
    """
    for one in judgements:
        if one.rests_on and all(outcomes.get(name) == "certified" for name in one.rests_on):
            one.verdict = one.by_rules
        if one.follows:
            one.sharp[""] = {
                "text": (
                    range_of_rule(one.rests_on[-1], texts, one.roles)
                    if one.verdict.word == "holds"
                    else "not found"
                ),
                "by": list(one.rests_on),
            }


def rule_domain(name: str, texts: Mapping[str, str]) -> tuple[str, bool]:
    """The domain of a map rule's conclusion as text, and whether the rule says that outside of it
    the conclusion is false.
    """
    rows = dict(row.partition(" ")[::2] for row in texts[name].splitlines())
    for inner in ("attraction", "descent"):
        if inner in rows:
            return rule_domain(rows[inner], texts)[0], inner == "attraction"
    return rows["domain"], False


def range_of_rule(name: str, texts: Mapping[str, str], roles: Roles = NO_ROLES) -> str:
    """The parameters for which the rule's conclusion is proved, told as sharp where it is refuted
    for all others of their domain.

    >>> text = "statement t/map\\nover a r\\ndomain a > 0 and 3*a < 1 and r > 0"
    >>> range_of_rule("t/map", {"t/map": text})
    'at least 0 < a < 1/3'

    The parameter is the first of the roles, else the first that the map is over.  Nothing is told
    where the domain does not speak of it, and the domain itself where its conditions on it are not
    linear.
    """
    domain, is_sharp = rule_domain(name, texts)
    parameter = roles.parameter or _first_over(name, texts)
    if parameter not in checker.names_in(domain):
        return ""
    ends = bounds_of(domain, parameter)
    if not ends:
        return ("" if is_sharp else "at least ") + domain
    whole = _ends(roles)
    low, high = ends[0] or whole[0], ends[1] or whole[1]
    at_one_point = low is not None and high is not None and low[0] == high[0]
    sure = is_sharp or at_one_point or (low, high) == whole and bool(roles.parameter)
    return ("" if sure else "at least ") + interval_text(parameter, low, high)


def _first_over(name: str, texts: Mapping[str, str]) -> str:
    """The first parameter of the map that a rule is about."""
    rows = dict(row.partition(" ")[::2] for row in texts.get(name, "").splitlines())
    if "over" in rows:
        return rows["over"].split()[0]
    inner = next((rows[key] for key in ("map", "attraction", "descent") if key in rows), "")
    return _first_over(inner, texts) if inner else ""


def _ends(roles: Roles) -> tuple[End | None, End | None]:
    """The ends of the first parameter's domain."""
    said = roles.domains.get(roles.parameter, ())
    return (
        bounds_of(" and ".join(map(str, said)), roles.parameter) or (None, None)
        if said
        else (
            None,
            None,
        )
    )


def whole_text(roles: Roles) -> str:
    """The domain of the first parameter as a person reads it."""
    return interval_text(roles.parameter, *_ends(roles))
