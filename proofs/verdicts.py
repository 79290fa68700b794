"""From outcomes to verdicts: what the checker accepted says what is to be thought of a print."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from proofs.claims import Argument, Assertion, Body, Following, Readings, named_statements

VERDICTS = ("holds", "misprint", "false", "gap", "ambiguous", "unknown")


@dataclass(frozen=True)
class Verdict:
    """What is to be thought of a print, and the detail that a table can show beside it."""

    word: str
    detail: str = ""


def outcome_of(
    claim_id: str, prefix: str, assertion: Assertion, outcomes: Mapping[str, str]
) -> str:
    """certified, refuted or unknown: an assertion is refuted by any of its statements, and
    certified by all.
    """
    found = [
        outcomes.get(part.name, "unknown") for part in named_statements(claim_id, prefix, assertion)
    ]
    return (
        "refuted"
        if "refuted" in found
        else "certified"
        if all(o == "certified" for o in found)
        else "unknown"
    )


_WORD = {"certified": "holds", "refuted": "false", "unknown": "unknown"}


def verdict_of(
    claim_id: str, body: Body, outcomes: Mapping[str, str], corrected: bool = False
) -> Verdict:
    """The verdict on a claim from the outcomes of its statements; `corrected` where a corrected
    print has been certified.
    """

    def word(prefix: str, assertion: Assertion) -> str:
        return _WORD[outcome_of(claim_id, prefix, assertion, outcomes)]

    if isinstance(body, Assertion):
        found = word("", body)
        return Verdict("misprint" if found == "false" and corrected else found)
    if isinstance(body, Readings):
        words = {name: word(f"{name}.", assertion) for name, assertion in body.of.items()}
        detail = "; ".join(f"{name}: {one}" for name, one in words.items())
        if "unknown" in words.values():
            return Verdict("unknown", detail)
        same = len(set(words.values())) == 1
        return Verdict(
            (
                (
                    "misprint"
                    if corrected and "holds" not in words.values()
                    else next(iter(words.values()))
                )
                if same
                else "ambiguous"
            ),
            detail,
        )
    if isinstance(body, Following):
        beside = word("beside.", body.beside) if body.beside else "holds"
        found = by_rules(body.rests_on, outcomes)
        return Verdict(
            beside if beside != "holds" else found,
            ("by " if found == "holds" else "awaits ") + ", ".join(body.rests_on),
        )
    return _argument(body, word, by_rules(body.rests_on, outcomes))


def by_rules(rests_on: Sequence[str], outcomes: Mapping[str, str]) -> str:
    """holds where every map rule that is named was certified, else unknown."""
    return (
        "holds"
        if rests_on and all(outcomes.get(name) == "certified" for name in rests_on)
        else "unknown"
    )


def _argument(body: Argument, word: Callable[[str, Assertion], str], rules: str) -> Verdict:
    steps = {name: word(f"{name}.", step) for name, step in body.steps.items()}
    conclusion = word("conclusion.", body.conclusion) if body.conclusion else ""
    broken = [name for name, one in steps.items() if one == "false"]
    if conclusion == "false":
        return Verdict(
            "false", "its conclusion is refuted" + (f", and step {broken[0]}" if broken else "")
        )
    if broken:
        stands = (
            "conclusion certified"
            if conclusion == "holds"
            else (
                f"conclusion by {body.rescue}"
                if body.rescue
                else (
                    f"conclusion by {', '.join(body.rests_on)}"
                    if rules == "holds"
                    else "conclusion open"
                )
            )
        )
        return Verdict("gap", f"step {', '.join(broken)} is false; {stands}")
    if "unknown" in (*steps.values(), conclusion):
        return Verdict("unknown")
    return Verdict("holds") if conclusion or body.rescue else Verdict("unknown", "conclusion open")
