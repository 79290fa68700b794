"""What a claim rests on in `symbolic`: each derivation that it uses, with what the derivation says of itself and its result."""

from __future__ import annotations

from certificates import checker
from certificates.terms import ClaimError
from proofs.claims import Body, Claim


def body_and_derivations(claim: Claim) -> tuple[Body, list[str]]:
    """What the claim asserts, and a line for each derivation used: the constants that its print names, then what its reading asks for.

    Raises ClaimError, naming the claim, for whatever the function of a claim outside of this package raises.
    """
    if not claim.source.startswith(("proofs.paper.", "proofs.theorem.")):
        try:
            return claim.body(), []
        except (checker.Rejected, ClaimError):
            raise
        except Exception as problem:
            raise ClaimError(f"{claim.id} raises {type(problem).__name__}: {problem}; mend its function") from problem
    from proofs.paper import vocabulary

    vocabulary.derivations_used.clear()
    body = claim.body()
    used = dict.fromkeys([*((name, ()) for name in _constants_in(claim)), *vocabulary.derivations_used])
    return body, [f"symbolic.{name}: {vocabulary.derivation(name, arguments)}" for name, arguments in used]


def _constants_in(claim: Claim) -> list[str]:
    """The derivations behind the constants that the print names."""
    from proofs.paper.vocabulary import CONSTANTS
    from proofs.reading.parser import parse_name

    if not claim.printed:
        return []
    printed = set()
    for name in claim.read_print().names:
        try:
            printed.add(parse_name(name))
        except ClaimError:  # a name with a place for an argument is no constant
            continue
    return [derivation for latex, derivation in CONSTANTS.items() if parse_name(latex) in printed]
