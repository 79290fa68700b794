"""What follows from map rules, once it is known which are certified: the verdicts and the ranges of
the claims that rest on them.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence

from juggleproof.certificates import checker
from juggleproof.certificates.language import (
    NO_ROLES,
    End,
    Roles,
    bounds_of,
    conjunction,
    interval_text,
    rests_on,
)
from juggleproof.certificates.work import read
from juggleproof.proofs import searches
from juggleproof.proofs.claims import REMARK, Claim, awaited, outcome_of, stated_texts, verdict_of
from juggleproof.proofs.judgement import Judgement, Sharp

NOT_FOUND = "not found"


def settle_by_rules(
    judgements: Sequence[Judgement],
    outcomes: Mapping[str, str],
    texts: Mapping[str, str],
    claims: Mapping[str, Claim],
) -> None:
    """Gives each judgement that rests on map rules or on a claim its verdict and range, now that
    the outcomes of all statements are known, with their texts; the claims state what these should
    be.
    """
    stated = dict[str, str]()
    above = list[str]()

    def stands(name: str) -> bool:
        """Whether the claim holds by the outcomes of its statements as stated, and by what it
        awaits, which is not itself.
        """
        claim = claims.get(name)
        if claim is None or name in above:
            return False
        above.append(name)
        settled = {
            one: outcomes.get(one, "unknown")
            for one, text in stated_texts(claim).items()
            if texts.get(one) == text
        }
        body, beside = claim.body(), claim.shown_beside()
        settled.update((one, "certified") for one in awaited(body) if holds(one))
        above.pop()
        if beside and outcome_of(name, REMARK, beside, settled) != "certified":
            return False
        return verdict_of(name, body, settled).word == "holds"

    def holds(name: str) -> bool:
        """Whether the claim stands, or the rule is certified, and it and all that it rests on are
        rules, and as stated.
        """
        if "/" not in name:
            return stands(name)
        names = [name] if outcomes.get(name) == "certified" else []
        for one in names:
            claim = claims.get(one.split("/")[0])
            if one not in stated and claim is not None:
                stated.update(stated_texts(claim))
            if one not in stated or texts.get(one) != stated[one]:
                return False
            rule = read(stated[one], one)
            if rule.kind not in checker.orbit_rules():
                return False
            names += [each for each in rests_on(rule) if each not in names]
        return bool(names)

    for one in judgements:
        if one.awaits and all(map(holds, one.awaits)):
            one.verdict = one.by_rules
        if one.follows:
            held = one.verdict.word == "holds"
            text = (
                range_of_rule(
                    one.rests_on[-1],
                    texts,
                    stated_roles(one.roles, claims[one.id]),
                    one.is_conclusion,
                )
                if held
                else NOT_FOUND
            )
            one.sharp[""] = Sharp(text, one.rests_on)


def stated_roles(roles: Roles, claim: Claim) -> Roles:
    """The roles where the vocabulary of the claim states them; what its statements say of a domain
    says nothing of a map's.
    """
    return roles if claim.vocabulary.domains else NO_ROLES


def rule_domain(name: str, texts: Mapping[str, str]) -> tuple[str, bool]:
    """The domain of a map rule's conclusion as text, nothing where it has none, and whether the
    rule refutes the conclusion outside of it.
    """
    rows = dict(row.partition(" ")[::2] for row in texts[name].splitlines())
    for inner in ("attraction", "settling", "descent"):
        if inner in rows:
            return rule_domain(rows[inner], texts)[0], inner == "attraction"
    return rows.get("domain", ""), False


def range_of_rule(
    name: str, texts: Mapping[str, str], roles: Roles = NO_ROLES, is_conclusion: bool = True
) -> str:
    """The parameters for which the rule's conclusion is proved; `at least` stands before them
    unless it is refuted for all others of their domain, or it is not that conclusion itself which
    is asserted.

    >>> text = "statement t/map\\nover a r\\ndomain a > 0 and 3*a < 1 and r > 0"
    >>> range_of_rule("t/map", {"t/map": text})
    'at least a > 0 and 3*a < 1 and r > 0'

    The parameter is the first of the roles, else the first that the map is over.  The text
    is empty where the domain does not name it, and the domain itself where it is no interval, or
    asks something of the other parameters; with roles, where it asks more of them than the map's
    domain. A rational number just inside stands for an irrational end, after `at least`.

    >>> text = "statement t/map\\nover a\\ndomain a > 0 and 2*a^2 < 1"
    >>> range_of_rule("t/map", {"t/map": text})
    'at least 0 < a <= 1393/1970'
    """
    domain, refutes = rule_domain(name, texts)
    is_sharp = refutes and is_conclusion
    rows = _map_of(name, texts)
    parameter = roles.parameter or rows.get("over", "").partition(" ")[0]
    if parameter not in checker.names_in(domain):
        return ""
    ends = bounds_of(domain, parameter)
    if not ends and not is_sharp and checker.names_in(domain) == {parameter}:
        ends = searches.ends_inside(domain, parameter)
    standing = _conditions(rows.get("domain", domain)) if roles.parameter else set[str]()
    more = _conditions(domain) - standing
    others = {*rows.get("over", "").split()} - {parameter}
    if not ends or any(others & checker.names_in(one) for one in more):
        return ("" if is_sharp else "at least ") + domain
    whole = _ends(roles)
    low, high = ends[0] or whole[0], ends[1] or whole[1]
    at_one_point = low is not None and high is not None and low[0] == high[0]
    sure = is_sharp or at_one_point or (low, high) == whole and bool(roles.parameter)
    return ("" if sure else "at least ") + interval_text(parameter, low, high)


def _map_of(name: str, texts: Mapping[str, str]) -> Mapping[str, str]:
    """The lines of the map that a rule is about, by keyword."""
    rows = dict(row.partition(" ")[::2] for row in texts.get(name, "").splitlines())
    if "over" in rows:
        return rows
    inner = next(
        (rows[key] for key in ("map", "relation", "attraction", "descent") if key in rows), ""
    )
    return _map_of(inner, texts) if inner else {}


def _conditions(domain: str) -> set[str]:
    """What a domain joins by `and`."""
    tree = checker.parse(domain)
    parts = tree.values if isinstance(tree, ast.BoolOp) and isinstance(tree.op, ast.And) else [tree]
    return set(map(ast.unparse, parts))


def _ends(roles: Roles) -> tuple[End | None, End | None]:
    """The ends of the first parameter's domain."""
    domain = " and ".join(map(str, roles.domains.get(roles.parameter, ())))
    return (bounds_of(domain, roles.parameter) if domain else None) or (None, None)


def whole_text(roles: Roles) -> str:
    """The domain of the first parameter as a person reads it."""
    domain = str(conjunction(roles.domains[roles.parameter]))
    ends = bounds_of(domain, roles.parameter)
    return interval_text(roles.parameter, *ends) if ends else domain
