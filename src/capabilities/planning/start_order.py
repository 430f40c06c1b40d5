"""The order in which to start what depends on one another, and the cycles that there may be."""
from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, Iterator, List, Mapping, Sequence, Tuple

__all__ = ['components', 'cycle_in']


def components(graph: Mapping[str, Sequence[str]]) -> Iterator[List[str]]:
    """
    The strongly connected components of a graph: each those that depend on before those they do.

    This is Tarjan's algorithm, without recursion, in time linear in nodes and edges.

    :param graph: mapping from each node to the nodes that it depends on, all of them its keys
    :returns: iterator of lists of str; a component of several nodes, or of one that depends on
        itself, has a cycle in it. Of its nodes the last is the one that was met first.

    >>> list(components({'navigation': ['laser', 'base'], 'laser': ['base'], 'base': []}))
    [['base'], ['laser'], ['navigation']]
    """
    numbers: Dict[str, int] = {}        # of the nodes that were met, in that order
    lowest: Dict[str, int] = {}         # the lowest number that is reached, as far as is known
    unfinished: Dict[str, None] = {}    # the nodes that are in no component yet, as they were met
    path: List[Tuple[str, Iterator[str]]] = []

    def enter(node: str) -> None:
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
                    component: List[str] = []
                    while node in unfinished:
                        component.append(unfinished.popitem()[0])
                    yield component


def cycle_in(component: Sequence[str], graph: Mapping[str, Sequence[str]]) -> Tuple[str, ...]:
    """
    A cycle in a component that has one.

    :param component: sequence of str, as `components` yields
    :param graph: as `components` takes
    :returns: tuple of str, the first one again at the end

    >>> cycle_in(['b', 'a'], {'a': ['b'], 'b': ['a']})
    ('a', 'b', 'a')
    """
    members = set(component)
    path: Dict[str, None] = {}      # a set that keeps its order
    node = component[-1]
    while node not in path:
        path[node] = None
        node = next(below for below in graph[node] if below in members)
    nodes = list(path)
    return tuple(nodes[nodes.index(node):] + [node])
