"""Strongly connected components of a directed graph."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Int32 = npt.NDArray[np.int32]


def components(count: int, tail: npt.ArrayLike, head: npt.ArrayLike) -> Int32:
    """Number the strongly connected components of `count` nodes with edges from `tail` to `head`, (n,) each.

    (count,) int32: for each node the least node of its component. Tarjan's algorithm without recursion.
    """
    tails, heads = np.asarray(tail, np.intp), np.asarray(head, np.intp)
    pairs = np.unique(np.stack([tails, heads], axis=1), axis=0) if len(tails) else np.zeros((0, 2), np.intp)
    start = np.searchsorted(pairs[:, 0], np.arange(count + 1)).tolist()
    follows = pairs[:, 1].tolist()
    order = [-1] * count
    lowest = [0] * count
    least = [-1] * count
    open_nodes: list[int] = []
    seen = 0
    for root in range(count):
        if order[root] >= 0:
            continue
        order[root] = lowest[root] = seen
        seen += 1
        open_nodes.append(root)
        way = [(root, start[root])]
        while way:
            node, at = way.pop()
            if at < start[node + 1]:
                way.append((node, at + 1))
                after = follows[at]
                if order[after] < 0:
                    order[after] = lowest[after] = seen
                    seen += 1
                    open_nodes.append(after)
                    way.append((after, start[after]))
                elif least[after] < 0:
                    lowest[node] = min(lowest[node], order[after])
                continue
            if way:
                before = way[-1][0]
                lowest[before] = min(lowest[before], lowest[node])
            if lowest[node] == order[node]:
                members = [open_nodes.pop()]
                while members[-1] != node:
                    members.append(open_nodes.pop())
                first = min(members)
                for member in members:
                    least[member] = first
    return np.array(least, np.int32)
