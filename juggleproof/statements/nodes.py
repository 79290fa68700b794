"""The shape of certificates: what a search returns, and what the checker reads as a hint.

A node closes a state, and names its rule first, as in `checker/rules.py`, where each rule is stated
in full.  In a file tuples are JSON lists.  Terms and polynomials are text of the statement
language; facts and disjunctions are numbered as the state has them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, NamedTuple, TypedDict, Union

# what a file of certificates may hold
Json = Union[None, bool, int, str, Sequence["Json"], Mapping[str, "Json"]]

Power = tuple[int, int]  # (number of a fact, exponent)
Product = tuple[str, Sequence[Power], str]  # (rational coefficient, powers of facts, root)
Cofactor = tuple[int, str]  # (number of an equation, polynomial)

Close = tuple[Literal["close"]]
Psatz = tuple[Literal["psatz"], Sequence[Product], Sequence[Cofactor]]
Cases = tuple[Literal["cases"], int, Sequence["Node"]]
Sign = tuple[Literal["sign"], str, "Node", "Node", "Node"]  # below, at and above 0
Boxes = tuple[Literal["boxes"], int, Sequence[tuple[int, int]], str]
Integral = tuple[Literal["integral"], int, "Node"]
# name of the lemma, terms for its variables, fresh names for what exists
Use = tuple[Literal["use"], str, Mapping[str, str], Mapping[str, str], "Node"]
Node = Union[Close, Psatz, Cases, Sign, Boxes, Integral, Use]

# new name, polynomial in it, its ends, nodes that show a change of sign
Adjoined = tuple[str, str, str, str, Node, Node]


class Point(NamedTuple):
    """Values for the variables of a statement; the node shows that they meet its premises, or the
    goals of a witness.
    """

    statement: str
    adjoined: Sequence[Adjoined]
    terms: Mapping[str, str]
    node: Node


class Counterexample(NamedTuple):
    """Values for the variables of a statement; the nodes show that they meet its premises, and that
    its goals fail.
    """

    statement: str
    adjoined: Sequence[Adjoined]
    terms: Mapping[str, str]
    node: Node
    fails: Node


BySign = tuple[Literal["sign"], str, "Values", "Values", "Values"]
Impossible = tuple[Literal["empty"], Node]  # a case that no point is in
Values = Union[Point, Counterexample, BySign, Impossible]

# side conditions in order, then what closes "premises and not goals", or values that meet the goals
Proof = Union[
    tuple[Literal["proof"], Sequence[Node], Node],
    tuple[Literal["witness"], Sequence[Node], Values],
]
# proofs inside, counterexamples outside, a point that meets what each statement is given
Sharp = tuple[Mapping[str, Proof], Values, Mapping[str, Values]]


class Certificate(TypedDict, total=False):
    """The certificate of one statement: `certified`, with a `point` where it is for all or of
    existence; or `refuted`; or `unknown`, with the reason.

    `certified` of an orbit rule has a proof for each of its premises.
    """

    certified: Proof | Sharp | Mapping[str, Proof]
    point: Values
    refuted: Values
    unknown: str


def values_at(
    statement: str, adjoined: Sequence[Adjoined], terms: Mapping[str, str], nodes: Sequence[Node]
) -> Point | Counterexample:
    """The point that one node shows to be one, or the counterexample that two nodes do."""
    node, *more = nodes
    if not more:
        return Point(statement, adjoined, terms, node)
    (fails,) = more
    return Counterexample(statement, adjoined, terms, node, fails)


def by_sign(text: str, cases: Sequence[Values]) -> BySign:
    """The values of three cases: where a polynomial is below, at and above 0."""
    below, at, above = cases
    return "sign", text, below, at, above
