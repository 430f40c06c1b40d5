"""
What depends on what among apps, capabilities and providers, what is wrong, and what is not used.

>>> from rocon_uri.workspace import load_workspace
>>> spec_graph(load_workspace({}))
SpecGraph(nodes={}, edges=[])
"""
from __future__ import annotations

from typing import Collection, Dict, Iterable, Iterator, List, Mapping, NamedTuple, Optional, Set

from capabilities.planning.faults import Fault, FaultKind
from capabilities.planning.planner import Planner
from rocon_uri.apps.runnable import WITH_NEAR_MISSES, App, Verdict, runnable
from rocon_uri.uri import RoconURI, parse
from rocon_uri.workspace import Workspace

__all__ = ['Edge', 'FAILS', 'Node', 'RUNS', 'SpecGraph', 'UNUSED', 'app_id', 'spec_graph']

#: the states of nodes: it is part of what the robot can run
RUNS = 'runs'
#: it is at fault, or an app that cannot run
FAILS = 'fails'
#: no app needs it
UNUSED = 'unused'

#: faults that are there only because all providers are planned at once
_OF_SEVERAL = (FaultKind.CONFLICT, FaultKind.LAUNCH_SHARED)


class Node(NamedTuple):
    """What is drawn."""

    #: its name, ``package/name``
    name: str
    #: 'interface', 'semantic interface', 'provider', 'app', 'virtual app' or 'missing'
    kind: str
    #: `RUNS`, `FAILS`, `UNUSED`, or '' for none of them
    state: str = ''
    #: the id of what is wrong with itself, as `REASON_IDS` has it; '' for nothing
    fault: str = ''
    #: what is wrong with itself, one line; '' for nothing
    problem: str = ''


class Edge(NamedTuple):
    """An arrow."""

    #: the id of the node that it starts at
    start: str
    #: the id of the node that it ends at
    end: str
    #: 'implements', 'redefines', 'depends on', 'requires' or 'inherits from'
    kind: str
    #: for a dependency the name of the preferred provider, if there is one
    preferred: Optional[str]


class SpecGraph(NamedTuple):
    """What depends on what. What is named and does not exist is a node of the kind 'missing'."""

    #: the nodes by id: the name, but for an app `app_id`
    nodes: Dict[str, Node]
    #: the arrows
    edges: List[Edge]


def app_id(app: App) -> str:
    """The id of an app: its name with a # before, as in a rocon URI; of a .app file also '.app'."""
    return '#%s%s' % (app.name, '.app' if app.form == 'app' else '')


def spec_graph(exported: Workspace, robot: Optional[RoconURI] = None,
               defaults: Optional[Mapping[str, str]] = None,
               names: Collection[str] = ()) -> SpecGraph:
    """
    The graph of all that packages export.

    :param Workspace exported: what they export
    :param robot: RoconURI, what apps are judged for; None if their platforms do not matter
    :param defaults: mapping from capabilities to their default providers
    :param names: collection of str, the apps that are drawn, with what they need; all if empty
    :returns: `SpecGraph`
    """
    apps = [app for app in exported.apps() if not names or app.name in names]
    judged_for = robot or parse('rocon:/', exported.vocabulary)
    verdicts = [runnable(app, judged_for, exported.spec_index, defaults, exported.launch_files,
                         near_misses=number < WITH_NEAR_MISSES)
                for number, app in enumerate(apps)]
    nodes = {name: Node(name=name, kind=spec.spec_type.replace('_', ' '))
             for name, spec in exported.spec_index.specs.items()}
    for app in exported.apps():
        nodes[app_id(app)] = Node(name=app.name,
                                  kind='app' if app.is_implementation else 'virtual app')
    edges = list(_edges(exported))
    for edge in edges:
        nodes.setdefault(edge.end, Node(name=edge.end.lstrip('#'), kind='missing', state=FAILS,
                                        fault='missing', problem='no package exports it'))
    if names:
        reached = _reached([app_id(app) for app in apps], edges)
        nodes = {key: node for key, node in nodes.items() if key in reached}
        edges = [edge for edge in edges if edge.start in nodes and edge.end in nodes]
    _mark(nodes, edges, verdicts, robot is not None)
    for fault in _provider_faults(exported, defaults):
        _mark_fault(nodes, fault)
    return SpecGraph(nodes, edges)


def _edges(exported: Workspace) -> Iterator[Edge]:
    index = exported.spec_index
    for name, semantic in index.semantic_interfaces.items():
        yield Edge(start=name, end=semantic.redefines, kind='redefines', preferred=None)
    for name, provider in index.providers.items():
        yield Edge(start=name, end=provider.implements, kind='implements', preferred=None)
        for needed in provider.dependencies.values():
            yield Edge(start=name, end=needed.capability_name, kind='depends on',
                       preferred=needed.preferred_provider)
    for app in exported.apps():
        parent = getattr(app, 'parent_name', None)
        if parent is not None:
            yield Edge(start=app_id(app), end='#' + parent, kind='inherits from', preferred=None)
        for required in app.required_capabilities:
            yield Edge(start=app_id(app), end=required.name, kind='requires', preferred=None)


def _reached(starts: Iterable[str], edges: Iterable[Edge]) -> Set[str]:
    """What can be reached: from a capability its providers, from all else what it depends on."""
    below: Dict[str, List[str]] = {}
    for edge in edges:
        start, end = edge.start, edge.end
        if edge.kind == 'implements':
            start, end = end, start
        below.setdefault(start, []).append(end)
    reached: Set[str] = set()
    waiting = list(starts)
    while waiting:
        name = waiting.pop()
        if name not in reached:
            reached.add(name)
            waiting += below.get(name, ())
    return reached


def _mark(nodes: Dict[str, Node], edges: Iterable[Edge], verdicts: Iterable[Verdict],
          has_robot: bool) -> None:
    """Set what the verdicts say of apps, and of the capabilities and providers that they need."""
    used: Set[str] = set()
    for verdict in verdicts:
        app = verdict.app
        used |= _used(verdict)
        if not app.is_implementation:
            continue
        key = app_id(app)
        own = next((reason for reason in verdict.reasons if reason.fault is None), None)
        if own is not None:
            nodes[key] = nodes[key]._replace(state=FAILS, fault=own.id, problem=str(own))
        elif not verdict:
            nodes[key] = nodes[key]._replace(state=FAILS)
        elif has_robot:
            for name in {key, *_used(verdict)} & nodes.keys():
                nodes[name] = nodes[name]._replace(state=RUNS)
        for reason in verdict.reasons:
            if reason.fault is not None:
                _mark_fault(nodes, reason.fault)
    used.update(edge.end for edge in edges if edge.kind == 'redefines' and edge.start in used)
    for key, node in nodes.items():
        if used and key not in used and not node.state and not key.startswith('#'):
            nodes[key] = node._replace(state=UNUSED)


def _used(verdict: Verdict) -> Set[str]:
    """The capabilities and providers that an app needs, those that it may need included."""
    plan = verdict.plan
    used = {*plan.providers, *plan.dependencies}
    for fault in plan.faults:
        used.update((fault.capability, *fault.candidates))
    return used


def _provider_faults(exported: Workspace, defaults: Optional[Mapping[str, str]]
                     ) -> Iterator[Fault]:
    """What is wrong with providers, whether an app needs them or not."""
    planner = Planner(exported.spec_index, defaults)
    for name, provider in exported.spec_index.providers.items():
        planner.add(provider.implements, name)
    return (fault for fault in planner.plan(exported.launch_files.look_at).faults
            if fault.kind not in _OF_SEVERAL)


def _mark_fault(nodes: Dict[str, Node], fault: Fault) -> None:
    """Set a fault where it is: at a provider whose launch file is at fault, or the capability."""
    if fault.kind is FaultKind.CYCLE:
        names = fault.cycle
    elif fault.kind is FaultKind.LAUNCH_SHARED:
        names = fault.sharers
    else:
        names = (str(fault.provider) if fault.launch is not None else fault.capability,)
    for name in names:
        if name in nodes and not nodes[name].fault:
            nodes[name] = nodes[name]._replace(state=FAILS, fault=fault.kind.value,
                                               problem=str(fault))
