"""The range of parameters for which the conclusion of a certified map rule is proved, and the whole
range, as text for a reader.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping

from juggleproof.certificates import checker
from juggleproof.judging import searches
from juggleproof.statements.language import (
    NO_ROLES,
    End,
    Roles,
    bounds_of,
    conjunction,
    interval_text,
)


def rule_domain(name: str, texts: Mapping[str, str]) -> tuple[str, bool]:
    """The domain of a map rule's conclusion as text (empty where it has none), and whether the rule
    refutes the conclusion outside of the domain.
    """
    rows = dict(row.partition(" ")[::2] for row in texts[name].splitlines())
    for inner in ("attraction", "settling", "descent"):
        if inner in rows:
            return rule_domain(rows[inner], texts)[0], inner == "attraction"
    return rows.get("domain", ""), False


def range_of_rule(
    name: str, texts: Mapping[str, str], roles: Roles = NO_ROLES, is_conclusion: bool = True
) -> str:
    """The parameters for which the rule's conclusion is proved, as text.  It begins with `at least`
    unless these are known to be all: because the conclusion itself is asserted and the rule refutes
    it for all others, because the range is the whole domain of the roles, or a single point.

    >>> text = "statement t/map\\nover a r\\ndomain a > 0 and 3*a < 1 and r > 0"
    >>> range_of_rule("t/map", {"t/map": text})
    'at least a > 0 and 3*a < 1 and r > 0'

    The parameter is the first of the roles, else the first parameter of the map.  The text is empty
    where the domain does not name it; it is the domain itself where this is not an interval, or has
    conditions on other parameters (with roles: conditions that the map's domain has not).  An
    irrational end is replaced by a rational number just inside, after `at least`.

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
    """The conditions that a domain joins by `and`."""
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
