"""The order in which to start what depends on one another, and the cycles that there may be."""
from __future__ import annotations

from typing import Dict, Hashable, Iterator, List, Mapping, Sequence, Tuple, TypeVar

__all__ = ['components', 'cycle_in']

Node = TypeVar('Node', bound=Hashable)


def components(graph: Mapping[Node, Sequence[Node]]) -> Iterator[List[Node]]:
    """
    The strongly connected components of a graph, each after the components that it depends on.

    This is Tarjan's algorithm, without recursion, in time linear in nodes and edges.

    :param graph: mapping from each node to the nodes that it depends on, all of them its keys
    :returns: iterator of lists of nodes; a component of several nodes, or of one that depends on
        itself, has a cycle in it. Of its nodes the last is the one that was met first.

    >>> list(components({'navigation': ['laser', 'base'], 'laser': ['base'], 'base': []}))
    [['base'], ['laser'], ['navigation']]
    """
    numbers: Dict[Node, int] = {}        # of the nodes that were met, in that order
    lowest: Dict[Node, int] = {}         # the lowest number that is reached, as far as is known
    unfinished: Dict[Node, None] = {}    # the nodes that are in no component yet, as they were met
    path: List[Tuple[Node, Iterator[Node]]] = []

    def enter(node: Node) -> None:
        numbers[node] = lowest[node] = len(numbers)
        unfinished[node] = None
        path.append((node, iter(graph[node])))

    for start in graph:
        if start not in numbers:
            enter(start)
        while path:
            node, rest = path[-1]
            for below in rest:
                if below not in numbers:
                    enter(below)
                    break
                if below in unfinished:
                    lowest[node] = min(lowest[node], numbers[below])
            else:
                path.pop()
                if path:
                    above = path[-1][0]
                    lowest[above] = min(lowest[above], lowest[node])
                if lowest[node] == numbers[node]:
                    component: List[Node] = []
                    while node in unfinished:
                        component.append(unfinished.popitem()[0])
                    yield component


def cycle_in(component: Sequence[Node], graph: Mapping[Node, Sequence[Node]]
             ) -> Tuple[Node, ...]:
    """
    A cycle in a component that has one.

    :param component: sequence of nodes, as `components` yields
    :param graph: as `components` takes
    :returns: tuple of nodes, the first one again at the end

    >>> cycle_in(['b', 'a'], {'a': ['b'], 'b': ['a']})
    ('a', 'b', 'a')
    """
    members = set(component)
    path: Dict[Node, None] = {}      # a set that keeps its order
    node = component[-1]
    while node not in path:
        path[node] = None
        node = next(below for below in graph[node] if below in members)
    nodes = list(path)
    return tuple(nodes[nodes.index(node):] + [node])
