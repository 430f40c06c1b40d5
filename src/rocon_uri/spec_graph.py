"""
What depends on what among interfaces, semantic interfaces, providers and apps, as a picture.

>>> from capabilities.spec_index import SpecIndex
>>> print(dot_text(spec_graph(SpecIndex(), {})).splitlines()[0])
digraph capabilities {
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Collection, Dict, List, Mapping, NamedTuple, Optional

from rocon_uri.sources.wording import printable

if TYPE_CHECKING:
    from capabilities.spec_index import SpecIndex
    from rocon_uri.apps.rapp import Rapp

__all__ = ['Edge', 'Node', 'SpecGraph', 'dot_text', 'spec_graph']


class Node(NamedTuple):
    """What is drawn."""

    #: its name, ``package/name``
    name: str
    #: a key of `_NODE_STYLES`
    kind: str


class Edge(NamedTuple):
    """An arrow."""

    #: the id of the node that it starts at
    start: str
    #: the id of the node that it ends at
    end: str
    #: a key of `_EDGE_STYLES`
    kind: str
    #: for a dependency the name of the preferred provider, if there is one
    preferred: Optional[str]


class SpecGraph(NamedTuple):
    """What depends on what. What is named and does not exist is a node of the kind 'missing'."""

    #: the nodes by id: the name, with a # before that of an app, as in a rocon URI
    nodes: Dict[str, Node]
    #: the arrows
    edges: List[Edge]


_NODE_STYLES = {
    'interface': 'shape=box, style=filled, fillcolor="#cfe2f3"',
    'semantic interface': 'shape=box, style="filled,rounded", fillcolor="#d9ead3"',
    'provider': 'shape=ellipse, style=filled, fillcolor="#fff2cc"',
    'app': 'shape=component, style=filled, fillcolor="#ead1dc"',
    'virtual app': 'shape=component, style="filled,dashed", fillcolor="#f3f3f3"',
    'missing': 'shape=box, style=dashed, color="#cc0000", fontcolor="#cc0000"',
}
_RUNNING = ', penwidth=3, color="#38761d"'
_EDGE_STYLES = {
    'implements': 'arrowhead=empty',
    'redefines': 'arrowhead=empty, style=dashed',
    'depends on': 'arrowhead=vee',
    'requires': 'arrowhead=vee, color="#a64d79"',
    'inherits from': 'arrowhead=empty, style=dotted, color="#a64d79"',
}


def spec_graph(spec_index: SpecIndex, rapps: Mapping[str, Rapp]) -> SpecGraph:
    """
    The graph of all that packages export; the rapps are given by name.

    >>> from capabilities.spec_index import SpecIndex
    >>> from rocon_uri.apps.rapp import rapp_from_string
    >>> dance = rapp_from_string('required_capabilities: [{name: ours/Legs}]', 'ours/dance')
    >>> sorted(spec_graph(SpecIndex(), {'ours/dance': dance}).nodes.items())
    [('#ours/dance', Node(name='ours/dance', kind='virtual app')), \
('ours/Legs', Node(name='ours/Legs', kind='missing'))]
    """
    nodes = {name: Node(name, spec.spec_type.replace('_', ' '))
             for name, spec in spec_index.specs.items()}
    for name, rapp in rapps.items():
        nodes['#' + name] = Node(name, 'app' if rapp.is_implementation else 'virtual app')
    edges: List[Edge] = []
    for name, semantic in spec_index.semantic_interfaces.items():
        edges.append(Edge(name, semantic.redefines, 'redefines', None))
    for name, provider in spec_index.providers.items():
        edges.append(Edge(name, provider.implements, 'implements', None))
        edges += [Edge(name, needed.capability_name, 'depends on', needed.preferred_provider)
                  for needed in provider.dependencies.values()]
    for name, rapp in rapps.items():
        if rapp.parent_name is not None:
            edges.append(Edge('#' + name, '#' + rapp.parent_name, 'inherits from', None))
        edges += [Edge('#' + name, needed.name, 'requires', None)
                  for needed in rapp.required_capabilities]
    for edge in edges:
        nodes.setdefault(edge.end, Node(edge.end, 'missing'))
    return SpecGraph(nodes, edges)


def dot_text(graph: SpecGraph, running: Collection[str] = ()) -> str:
    """
    The graph in the language of graphviz, the content of a ``.dot`` file.

    The capabilities and providers that are running have a thick green outline.

    >>> print(dot_text(SpecGraph({'ours/Legs': Node('ours/Legs', 'interface')}, [])))
    digraph capabilities {
      rankdir=LR;
      node [fontname="Helvetica", fontsize=11];
      edge [fontname="Helvetica", fontsize=9];
      "ours/Legs" [label="Legs\\nours", shape=box, style=filled, fillcolor="#cfe2f3"];
    }
    """
    lines = ['digraph capabilities {', '  rankdir=LR;',
             '  node [fontname="Helvetica", fontsize=11];',
             '  edge [fontname="Helvetica", fontsize=9];']
    for identity, node in graph.nodes.items():
        package, _, own_name = node.name.rpartition('/')
        lines.append('  "%s" [label="%s\\n%s", %s];' % (
            _escaped(identity), _escaped(own_name), _escaped(package),
            _NODE_STYLES[node.kind] + _RUNNING * (identity in running)))
    for edge in graph.edges:
        label, style = edge.kind, _EDGE_STYLES[edge.kind]
        if edge.preferred is not None:
            label += '\\nby %s' % _escaped(edge.preferred)
            if edge.preferred not in graph.nodes:
                style += ', fontcolor="#cc0000"'
        lines.append('  "%s" -> "%s" [label="%s", %s];' % (
            _escaped(edge.start), _escaped(edge.end), label, style))
    return '\n'.join(lines + ['}'])


def _escaped(name: str) -> str:
    """A name as it stands between double quotes."""
    return printable(name).replace('\\', '\\\\').replace('"', '\\"')
