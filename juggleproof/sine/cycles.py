"""The strongly connected parts of a graph; not believed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

Node = TypeVar("Node")


def cyclic_parts(
    nodes: Iterable[Node], targets: Callable[[Node], Iterable[Node]]
) -> list[list[Node]]:
    """The sets of nodes that lie on common cycles, of those whose edges stay among the nodes.

    R. Tarjan, SIAM J. Comput. 1, 1972: in a walk in depth, `low` is the earliest node that is still
    open and can be reached.

    >>> cyclic_parts(range(4), lambda node: {0: [1], 1: [2, 0], 2: [3], 3: [3]}[node])
    [[3], [1, 0]]
    """
    among = set(nodes)
    order: dict[Node, int] = {}
    low: dict[Node, int] = {}
    open_nodes: dict[Node, None] = {}  # in order
    found = []
    for root in among:
        walk: list[tuple[Node, Iterator[Node]]] = []
        if root not in order:
            walk.append((root, iter(targets(root))))
        while walk:
            node, edges = walk[-1]
            if node not in order:
                order[node] = low[node] = len(order)
                open_nodes[node] = None
            for target in edges:
                if target not in among:
                    continue
                if target not in order:
                    walk.append((target, iter(targets(target))))
                    break
                if target in open_nodes:
                    low[node] = min(low[node], order[target])
            else:
                walk.pop()
                if walk:
                    before = walk[-1][0]
                    low[before] = min(low[before], low[node])
                if low[node] == order[node]:
                    part = []
                    while node in open_nodes:
                        part.append(open_nodes.popitem()[0])
                    if len(part) > 1 or node in targets(node):
                        found.append(part)
    return found
