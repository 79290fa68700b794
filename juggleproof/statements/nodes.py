"""The types of certificates, which searches return and the checker reads as hints.

A node closes a state.  Its first entry names a rule of `checker/rules.py`, where each rule is
stated in full.  In a file tuples are JSON lists.  Terms and polynomials are text of the statement
language; facts and disjunctions are given by their numbers in the state.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, NamedTuple, TypedDict, Union

# the values that a file of certificates may contain
Json = Union[None, bool, int, str, Sequence["Json"], Mapping[str, "Json"]]

Power = tuple[int, int]  # (number of a fact, exponent)
Product = tuple[str, Sequence[Power], str]  # (rational coefficient, powers of facts, root)
Cofactor = tuple[int, str]  # (number of an equation, polynomial)

Close = tuple[Literal["close"]]
Psatz = tuple[Literal["psatz"], Sequence[Product], Sequence[Cofactor]]
Cases = tuple[Literal["cases"], int, Sequence["Node"]]
Sign = tuple[Literal["sign"], str, "Node", "Node", "Node"]  # polynomial; where it is < 0, = 0, > 0
Boxes = tuple[Literal["boxes"], int, Sequence[tuple[int, int]], str]
Integral = tuple[Literal["integral"], int, "Node"]
# name of the lemma, terms for its universal variables, fresh names for its existential ones
Use = tuple[Literal["use"], str, Mapping[str, str], Mapping[str, str], "Node"]
Node = Union[Close, Psatz, Cases, Sign, Boxes, Integral, Use]

# new name, polynomial in it, the two ends of its interval, nodes that show a change of sign there
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

# proofs of the side conditions, then a node that closes "premises and not goals", or a witness
Proof = Union[
    tuple[Literal["proof"], Sequence[Node], Node],
    tuple[Literal["witness"], Sequence[Node], Values],
]
# proofs inside, counterexamples outside, for each statement a point that meets its premises
Sharp = tuple[Mapping[str, Proof], Values, Mapping[str, Values]]


class Certificate(TypedDict, total=False):
    """The certificate of one statement: `certified`, with a `point` that meets the premises where
    the statement is a `Statement`; or `refuted`; or `unknown`, with the reason.

    For a map rule, `certified` has a proof of each premise by name.
    """

    certified: Proof | Sharp | Mapping[str, Proof]
    point: Values
    refuted: Values
    unknown: str


def values_at(
    statement: str, adjoined: Sequence[Adjoined], terms: Mapping[str, str], nodes: Sequence[Node]
) -> Point | Counterexample:
    """The point that one node certifies, or the counterexample that two nodes certify."""
    node, *more = nodes
    if not more:
        return Point(statement, adjoined, terms, node)
    (fails,) = more
    return Counterexample(statement, adjoined, terms, node, fails)


def by_sign(text: str, cases: Sequence[Values]) -> BySign:
    """The values for three cases: the polynomial is < 0, = 0 and > 0."""
    below, at, above = cases
    return "sign", text, below, at, above
