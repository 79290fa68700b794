"""Map rules as a claim writes them: the errors for lines that make no rule, and the premises of a
rule.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from difflib import get_close_matches

from juggleproof.certificates import checker
from juggleproof.judging.conclusions import RULES
from juggleproof.statements.language import ClaimError, MapRule


def read_rule(rule: MapRule) -> checker.Statement:
    """The rule as the checker reads it.

    Raises ClaimError, which names the line and the expected form, where the checker rejects it.
    """
    try:
        keywords = [keyword for keyword, _ in rule.lines]
    except (TypeError, ValueError):
        raise ClaimError(f"{rule.name}: each line of a rule is a pair (keyword, text)") from None
    fault = _fault(keywords)
    if fault:
        raise ClaimError(f"{rule.name}: {fault}")
    try:
        return checker.read_statements(rule.text())[rule.name]
    except checker.Rejected as reason:
        count = re.search(r"line (\d+)$", reason.place)
        at = int(count[1]) - 2 if count else len(keywords)  # the first line is `statement`
        row = f"the line `{' '.join(rule.lines[at])}`: " if at < len(keywords) else ""
        raise ClaimError(
            f"{rule.name}: {row}{checker.Rejected(reason.kind, reason.offender)}"
        ) from None


def premises_of(
    rule: checker.Statement, known: Mapping[str, checker.Statement], stated: Collection[str]
) -> dict[str, checker.Statement] | str:
    """The premises by name; or the reason why there are none: the rule names another that is
    stated, but not known to be certified.

    Raises ClaimError for a name that is not stated before the rule, or that names another kind of
    rule, and where the checker makes no premises of the lines.
    """
    for keyword, name in ((key, text) for key, text in rule.lines if key in checker.NAMED):
        if name not in stated:
            part = name.partition("/")[1:]
            similar = get_close_matches(name, stated, 1) or [
                one for one in stated if one.partition("/")[1:] == part
            ]
            hint = f"did you mean {similar[0]}?" if similar else "state it first, in this claim"
            raise ClaimError(
                f"{rule.name}: the line `{keyword} {name}` names no rule that stands before it;"
                f" {hint}"
            )
        if name not in known:
            return f"it rests on {name}, which is not certified"
    try:
        return checker.premises_of(rule, known)
    except checker.Rejected as reason:
        kind, _, name = reason.offender.rpartition(" ")
        if reason.kind is checker.Kind.EARLIER and name in known:
            own = known[name].kind
            mend = f"name one of the kind `{kind}`"
            if {own, kind} == {"map", "relation"}:
                mend = f"write the line `{own} {name}`"
            raise ClaimError(f"{rule.name}: {name} is a rule `{own}`; {mend}") from None
        raise ClaimError(f"{rule.name}: {reason}") from None


def _fault(keywords: Sequence[str]) -> str:
    """The reason why lines with these keywords are no rule; empty where they are one."""
    row = "".join(f"{keyword} " for keyword in keywords)
    if any(re.fullmatch(rule.lines, row) for rule in RULES.values()):
        return ""

    def parts(kind: str) -> list[tuple[list[str], str]]:
        """For each place in the order of lines, the keywords that may stand there, and how often:
        *, + or ?, or empty for exactly once.
        """
        found = re.findall(r"\(([a-z| ]+)\) ?([*+?]?)|([a-z]+) ", RULES[kind].lines)
        return [
            ((group or word).replace(" ", "").split("|"), often) for group, often, word in found
        ]

    def missing(kind: str) -> list[str]:
        return [
            f"`{'` or `'.join(words)}`"
            for words, often in parts(kind)
            if often not in ("*", "?") and not {*words} & {*keywords}
        ]

    def foreign(kind: str) -> list[str]:
        own = {word for words, _ in parts(kind) for word in words}
        return [f"`{keyword}`" for keyword in dict.fromkeys(keywords) if keyword not in own]

    kind = min(RULES, key=lambda one: len(missing(one)) + len(foreign(one)))
    faults = [f"{', '.join(missing(kind))} missing"] if missing(kind) else []
    faults += [f"{', '.join(foreign(kind))} left over"] if foreign(kind) else []
    places = [
        next((k for k, (words, _) in enumerate(parts(kind)) if keyword in words), -1)
        for keyword in keywords
    ]
    for before, after, one, other in zip(places, places[1:], keywords, keywords[1:]):
        if 0 <= after < before:
            faults.append(f"`{other}` after `{one}`")
        elif after == before >= 0 and parts(kind)[after][1] in ("", "?"):
            faults.append(f"`{other}` twice")
    often = {"": "", "*": " (any number)", "+": " (at least one)", "?": " (at most one)"}
    order = ", ".join(" or ".join(words) + often[count] for words, count in parts(kind))
    return f"{', '.join(faults)}; the lines of `{kind}` are, in this order: {order}"
