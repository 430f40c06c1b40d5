"""
Which provider runs a capability, what has to run before it, and which faults prevent it.

A *capability* is an interface or a semantic interface; a provider implements one and depends on
others. `plan_start`, `plan_for_capabilities` and `plan_for_provider` choose a provider for each and
say in which order they start::

    plan = plan_for_capabilities(spec_index, ['navigation/Navigation'], defaults)
    plan.order      # ['hokuyo_capability/hokuyo_base', 'navigation/navigation_nav_stack']
    plan.faults     # a list of Fault, empty where all of it can be started

`choose_provider` makes the single choice: the provider that a dependency prefers, else the one that
``defaults`` names for the capability, else the only one there is. If a named provider does not
exist or implements something else, that is a fault, and no other takes its place. A provider of a
semantic interface may be named for the interface that it redefines, but is never picked for it; it
runs as an instance of the semantic interface.

All faults are found, not just the first, in a time that grows only with what is reached.
"""
from __future__ import annotations

from typing import Iterable, List, Mapping, Optional, Union

from capabilities.planning.faults import Fault, FaultKind
from capabilities.planning.plan import PlannedProvider, RunningProvider, StartPlan, error_text
from capabilities.planning.planner import Planner
from capabilities.spec_index import SpecIndex
from rocon_uri.sources.launch_file import LaunchFiles, RememberedLaunchFiles

Defaults = Optional[Mapping[str, str]]
LaunchFacts = Union[LaunchFiles, RememberedLaunchFiles, None]

__all__ = ['Fault', 'FaultKind', 'PlannedProvider', 'RunningProvider', 'StartPlan',
           'choose_provider', 'error_text', 'find_cycles', 'plan_for_capabilities',
           'plan_for_provider', 'plan_start']


def choose_provider(spec_index: SpecIndex, capability: str, preferred: Optional[str] = None,
                    defaults: Defaults = None) -> Union[str, Fault]:
    """
    The provider that runs a capability.

    :param SpecIndex spec_index: what there is
    :param str capability: the name of an interface or semantic interface
    :param preferred: str, the name of the provider that is preferred, or None
    :param defaults: mapping from capabilities to their default providers, both str, or None
    :returns: str, the name of the provider, or a `Fault`

    >>> from capabilities.spec_index import SpecIndex
    >>> print(choose_provider(SpecIndex(), 'navigation/Navigation'))
    capability 'navigation/Navigation': no package exports this capability
    """
    return Planner(spec_index, defaults).choose(capability, preferred, capability)


def plan_for_capabilities(spec_index: SpecIndex, capabilities: Iterable[str],
                          defaults: Defaults = None, launch_files: LaunchFacts = None
                          ) -> StartPlan:
    """
    What it takes to start some capabilities at once, where nothing runs.

    :param SpecIndex spec_index: what there is
    :param capabilities: iterable of str, the names of interfaces and semantic interfaces
    :param defaults: mapping from capabilities to their default providers, both str, or None
    :param launch_files: `LaunchFiles`, which judges the launch files; None where they do not matter
    :returns: `StartPlan`

    >>> from capabilities.spec_index import SpecIndex
    >>> plan_for_capabilities(SpecIndex(), []).order
    []
    """
    planner = Planner(spec_index, defaults)
    for capability in dict.fromkeys(capabilities):      # of one named twice, each fault once
        planner.add(capability)
    return planner.plan(None if launch_files is None else launch_files.look_at)


def plan_start(spec_index: SpecIndex, capability: str, preferred_provider: Optional[str] = None,
               defaults: Defaults = None, running: Iterable[RunningProvider] = (),
               launch_files: LaunchFacts = None, nodelet_manager: bool = True) -> StartPlan:
    """
    What it takes to start a capability beside what runs already.

    An instance that there is is shared, whatever its provider, and no fault is looked for below it.

    :param SpecIndex spec_index: what there is
    :param str capability: the name of an interface or semantic interface
    :param preferred_provider: str, the provider that is asked for; None or '' for any
    :param defaults: mapping from capabilities to their default providers, both str, or None
    :param running: iterable of `RunningProvider`
    :param launch_files: `LaunchFiles`, or what they remember, which reads nothing and may leave
        some in `StartPlan.unread`; None where launch files do not matter
    :param bool nodelet_manager: is there one for the providers that need it?
    :returns: `StartPlan`; without faults the last of its steps is the instance that was asked for

    >>> from capabilities.spec_index import SpecIndex
    >>> print(error_text(plan_start(SpecIndex(), 'ours/Map')))
    Capability 'ours/Map' not found. capability 'ours/Map': no package exports this capability
    """
    planner = Planner(spec_index, defaults, running)
    planner.add(capability, preferred_provider)
    return planner.plan(None if launch_files is None else launch_files.look_at, nodelet_manager)


def plan_for_provider(spec_index: SpecIndex, provider_name: str, defaults: Defaults = None,
                      launch_files: LaunchFacts = None) -> StartPlan:
    """
    What it takes to start a provider. In the order of the plan it is the last.

    :param SpecIndex spec_index: what there is
    :param str provider_name: ``package/name``
    :param defaults: mapping from capabilities to their default providers, both str, or None
    :param launch_files: as `plan_for_capabilities` takes
    :returns: `StartPlan`
    :raises KeyError: if there is no such provider

    >>> from capabilities.spec_index import SpecIndex
    >>> plan_for_provider(SpecIndex(), 'navigation/navigation_nav_stack')
    Traceback (most recent call last):
        ...
    KeyError: 'navigation/navigation_nav_stack'
    """
    planner = Planner(spec_index, defaults)
    provider = spec_index.provider(provider_name)
    if provider is None:
        raise KeyError(provider_name)
    planner.add(provider.implements, provider_name)
    return planner.plan(None if launch_files is None else launch_files.look_at)


def find_cycles(spec_index: SpecIndex, defaults: Defaults = None) -> List[Fault]:
    """
    Cycles among all the providers there are.

    :param SpecIndex spec_index: what there is
    :param defaults: mapping from capabilities to their default providers, both str, or None
    :returns: list of `Fault`, one for each set of providers that all depend on each other

    >>> from capabilities.spec_index import SpecIndex
    >>> find_cycles(SpecIndex())
    []
    """
    planner = Planner(spec_index, defaults)
    for name, provider in spec_index.providers.items():
        planner.add(provider.implements, name)
    return [fault for fault in planner.plan().faults if fault.kind is FaultKind.CYCLE]
