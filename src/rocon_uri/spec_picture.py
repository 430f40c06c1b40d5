"""
The graph of specs and apps as a picture, in the language of graphviz.

It reads from left to right: an app, the capabilities that it requires, their providers, and what
these depend on. The packages are frames.
"""
from __future__ import annotations

from typing import Collection, Dict, Iterable, Iterator, List

from rocon_uri.sources.wording import printable
from rocon_uri.spec_graph import FAILS, RUNS, UNUSED, Edge, Node, SpecGraph

__all__ = ['dot_text']

_RED, _GREEN, _GREY = '#cc0000', '#38761d', '#b7b7b7'
_PINK = '#a64d79'
_KINDS = {
    'interface': ('shape=box, style=filled', '#cfe2f3'),
    'semantic interface': ('shape=box, style="filled,rounded"', '#d9ead3'),
    'provider': ('shape=ellipse, style=filled', '#fff2cc'),
    'app': ('shape=component, style=filled', '#ead1dc'),
    'virtual app': ('shape=component, style="filled,dashed"', '#f3f3f3'),
    'missing': ('shape=box, style="filled,dashed"', '#ffffff'),
}
_STATES = {
    '': '',
    RUNS: ', color="%s", penwidth=2' % _GREEN,
    FAILS: ', color="%s", fontcolor="%s", penwidth=2' % (_RED, _RED),
    UNUSED: ', color="%s", fontcolor="%s"' % (_GREY, '#888888'),
}
_FILLS = {RUNS: '#b6d7a8', FAILS: '#f4cccc', UNUSED: '#f3f3f3'}
_RUNNING = ', penwidth=4, color="%s"' % _GREEN
_EDGES = {
    'implements': 'arrowhead=empty',    # drawn from the capability to the provider, to its right
    'redefines': 'arrowhead=empty, style=dashed',
    'depends on': 'arrowhead=vee',
    'requires': 'arrowhead=vee, color="%s"' % _PINK,
    'inherits from': 'arrowhead=empty, style=dotted, color="%s"' % _PINK,
}
# Many apps, one below the other, would make the picture higher than a screen is. They stand in
# columns where there are more than the first of these, with about as many in each as the second.
_IN_ONE_COLUMN = 14
_IN_A_COLUMN = 10
_COLUMNS = 8    # at most
_RATIO = 0.65   # of height to width, to which a picture with columns is spread
_IN_A_ROW = 3   # of few apps, those without an arrow
_SHORT = {'ambiguous': 'several providers, no default', 'launch-missing': 'no launch file',
          'missing': 'not there', 'no-interface': 'not there', 'platform': 'wrong platform'}

#: what is drawn before the nodes
_HEAD = '''digraph capabilities {
  rankdir=LR; nodesep=0.12; ranksep=0.5; newrank=true;
  node [fontname="Helvetica", fontsize=11, height=0.3, margin="0.12,0.04"];
  edge [fontname="Helvetica", fontsize=9, arrowsize=0.7];
  graph [fontname="Helvetica", fontsize=11, labelloc=b];'''


def dot_text(graph: SpecGraph, running: Collection[str] = ()) -> str:
    """
    The graph in the language of graphviz, the content of a ``.dot`` file.

    :param SpecGraph graph: what to draw
    :param running: collection of str, the capabilities and providers that run, which have a thick
        green outline
    :returns: str

    >>> text = dot_text(SpecGraph({'ours/Legs': Node('ours/Legs', 'interface')}, []))
    >>> text.splitlines()[8].strip()[:54]
    '"ours/Legs" [label="Legs", shape=box, style=filled, fi'
    """
    apps = sum(node.kind == 'app' for node in graph.nodes.values())
    columns = 1 if apps <= _IN_ONE_COLUMN else min(-(-apps // _IN_A_COLUMN), _COLUMNS)
    frames: Dict[str, List[str]] = {}
    for key, node in graph.nodes.items():
        frames.setdefault(node.name.rpartition('/')[0], []).append(key)
    lines = [_HEAD, '  label=<%s>;' % _legend(graph)]
    if columns > 1:
        lines.append('  ratio=%s;' % _RATIO)
    for package, keys in frames.items():
        lines += ['  subgraph "cluster_%s" {' % _escaped(package),
                  '    label="%s"; labelloc=t; labeljust=l; style=rounded; color="#999999";'
                  % _escaped(package)]
        lines += ['    %s;' % _node(key, graph.nodes[key], key in running) for key in keys]
        lines += _rows(keys, graph, columns)
        lines.append('  }')
    if columns == 1:
        first = {edge.start for edge in graph.edges if edge.kind == 'requires'}
        lines.append('  { rank=min; %s }' % ' '.join(
            '"%s";' % _escaped(key) for key in graph.nodes if key in first))
    lines += ['  %s;' % _edge(edge, graph.nodes) for edge in graph.edges]
    return '\n'.join(lines + ['}'])


def _node(key: str, node: Node, is_running: bool) -> str:
    shape, fill = _KINDS[node.kind]
    label = _escaped(node.name.rpartition('/')[2])
    if node.fault:
        label += '\\n' + _escaped(_SHORT.get(node.fault, node.fault.replace('-', ' ')))
    tooltip = node.name + (': ' + node.problem if node.problem else '')
    return '"%s" [label="%s", %s, fillcolor="%s"%s%s, tooltip="%s"]' % (
        _escaped(key), label, shape, _FILLS.get(node.state, fill), _STATES[node.state],
        _RUNNING * is_running, _escaped(tooltip))


def _edge(edge: Edge, nodes: Dict[str, Node]) -> str:
    start, end = edge.start, edge.end
    if edge.kind == 'implements':
        start, end = end, start
    style = _EDGES[edge.kind]
    if edge.preferred is not None:
        style += ', label="by %s"' % _escaped(edge.preferred)
        if edge.preferred not in nodes:
            style += ', fontcolor="%s"' % _RED
    if UNUSED in (nodes[start].state, nodes[end].state):
        style += ', color="%s"' % _GREY
    return '"%s" -> "%s" [%s, tooltip="%s"]' % (
        _escaped(start), _escaped(end), style, _escaped(edge.kind))


def _rows(keys: Iterable[str], graph: SpecGraph, columns: int) -> Iterator[str]:
    """Invisible arrows that put the apps of a package side by side, those with no arrow first."""
    requiring = {edge.start for edge in graph.edges if edge.kind == 'requires'}
    touched = {name for edge in graph.edges for name in (edge.start, edge.end)}
    apps = [key for key in keys if graph.nodes[key].kind == 'app']
    if columns == 1:
        apps = [key for key in apps if key not in touched]
        columns = _IN_A_ROW
    apps.sort(key=requiring.__contains__)
    rows = -(-len(apps) // columns)
    for row in range(rows):
        names = ['"%s"' % _escaped(key) for key in apps[row::rows]]
        if len(names) > 1:
            yield '    %s [style=invis];' % ' -> '.join(names)


def _legend(graph: SpecGraph) -> str:
    """What the colours and arrows of a graph mean, those that occur in it."""
    kinds = {node.kind for node in graph.nodes.values()}
    states = {node.state for node in graph.nodes.values()}
    edges = {edge.kind for edge in graph.edges}
    cells = [_cell(fill, kind) for kind, (_, fill) in _KINDS.items()
             if kind in kinds and kind != 'missing']
    cells += [_cell(_FILLS[state], what) for state, what in (
        (RUNS, 'the robot can run it'), (FAILS, 'does not work, and why'),
        (UNUSED, 'no app needs it')) if state in states]
    arrows = [text for kind, text in (
        ('requires', 'pink: requires'), ('depends on', 'black: depends on'),
        ('implements', 'white head: is implemented by'), ('redefines', 'dashed: redefines'),
        ('inherits from', 'dotted: inherits from')) if kind in edges]
    return ('<table border="0" cellspacing="4"><tr>%s</tr><tr><td colspan="%d">%s</td></tr></table>'
            % (''.join(cells) or '<td></td>', max(len(cells), 1), ';  '.join(arrows)))


def _cell(fill: str, text: str) -> str:
    return '<td bgcolor="%s" border="1" color="#999999">%s</td>' % (fill, text)


def _escaped(text: str) -> str:
    """A text as it stands between double quotes."""
    return printable(text).replace('\\', '\\\\').replace('"', '\\"')
