"""The range of alpha for which a map rule speaks."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from juggleproof.certificates import checker


def rule_domain(name: str, texts: Mapping[str, str]) -> tuple[str, bool]:
    """The domain of a map rule's conclusion as text, and whether the rule says that outside of it
    the conclusion is false.
    """
    rows = dict(row.partition(" ")[::2] for row in texts[name].splitlines())
    for inner in ("attraction", "descent"):
        if inner in rows:
            return rule_domain(rows[inner], texts)[0], inner == "attraction"
    return rows["domain"], False


def range_of_rule(name: str, texts: Mapping[str, str]) -> str:
    """The alpha in (0, 1) for which the rule's conclusion is proved, told as sharp where it is
    refuted for all others.

    >>> text = "statement t/map\\nover alpha r\\ndomain alpha > 0 and 3*alpha < 1 and r > 0"
    >>> range_of_rule("t/map", {"t/map": text})
    'at least 0 < alpha < 1/3'

    Nothing is told where the domain does not speak of alpha, and the domain itself where its
    conditions on alpha are not linear.
    """
    domain, is_sharp = rule_domain(name, texts)
    if "alpha" not in checker.names_in(domain):
        return ""
    ends = alpha_interval(domain)
    if not ends:
        return ("" if is_sharp else "at least ") + domain
    low, high = ends
    if low[0] == high[0]:
        return f"alpha = {low[0]}"
    whole = low == ("0", "<") and high == ("1", "<")
    return (
        "" if is_sharp or whole else "at least "
    ) + f"{low[0]} {low[1]} alpha {high[1]} {high[0]}"


def alpha_interval(domain: str) -> tuple[tuple[str, str], tuple[str, str]] | None:
    """The ends, with < or <=, of the interval in (0, 1) that the conditions on alpha alone make;
    None where one is not linear in alpha.

    >>> alpha_interval("3*alpha >= 1 and alpha < 1 and g > 0")
    (('1/3', '<='), ('1', '<'))
    """
    context = checker.Context()
    for name in sorted(checker.names_in(domain)):
        context.declare(name)
    formula = context.formula(checker.parse(domain))
    low, high = (Fraction(0), "<"), (Fraction(1), "<")
    for part in checker.conjuncts(formula):
        if isinstance(part, bool) or part[0] != "atom":
            return None
        _, poly, relation = part
        if checker.variables_of(context, poly) == {"alpha"}:
            coefficients = checker.univariate(context, poly, "alpha")
            if len(coefficients) != 2 or relation == "!=":
                return None
            constant, slope = coefficients
            end, sign = Fraction(-constant, slope), "<" if relation == ">" else "<="
            if slope > 0 or relation == "=":
                low = max(low, (end, sign), key=lambda bound: (bound[0], bound[1] == "<"))
            if slope < 0 or relation == "=":
                high = min(high, (end, sign), key=lambda bound: (bound[0], bound[1] != "<"))
    return (str(low[0]), low[1]), (str(high[0]), high[1])
