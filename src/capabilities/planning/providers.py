"""
Which provider runs a capability, what has to run before it, and what stands in the way.

A *capability* is an interface or a semantic interface; a provider implements one and depends on
others. `plan_for_capabilities` and `plan_for_provider` choose a provider for each and say in which
order they start::

    plan = plan_for_capabilities(spec_index, ['navigation/Navigation'], defaults)
    plan.order      # ['hokuyo_capability/hokuyo_base', 'navigation/navigation_nav_stack']
    plan.faults     # a list of Fault, empty where all of it can be started

`choose_provider` makes the single choice: the provider that a dependency prefers, else the one that
``defaults`` names for the capability, else the only one there is. One that is named and is not
there, or implements something else, is a fault; another one is not put in its place.

All faults are found, not just the first, in a time that grows with what is reached and no more.
"""
from __future__ import annotations

from collections import namedtuple

from capabilities.planning.faults import Fault, FaultKind
from capabilities.planning.start_order import components, cycle_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Dict, Iterable, List, Mapping, Optional, Tuple, Union

    from capabilities.spec_index import SpecIndex

    Defaults = Optional[Mapping[str, str]]

__all__ = ['Fault', 'FaultKind', 'StartPlan', 'choose_provider', 'find_cycles',
           'plan_for_capabilities', 'plan_for_provider']


class StartPlan(namedtuple('StartPlan', 'order providers dependencies faults')):
    """
    What it takes to start some capabilities.

    - ``order`` (list of str): the providers to start, each once and after those it depends on.
      With faults it is what could be found of it.
    - ``providers`` (dict from str to str): the provider chosen for each capability that is reached
    - ``dependencies`` (dict from str to list of str): the providers that each of the providers
      depends on directly
    - ``faults`` (list of `Fault`): all that stands in the way, in the order in which it was met;
      then conflicts, then one cycle of each set of providers that all depend on each other

    >>> StartPlan([], {}, {}, []).can_start
    True
    """

    __slots__ = ()

    @property
    def can_start(self) -> bool:
        """Does nothing stand in the way? (bool)"""
        return not self.faults


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
    return _Planner(spec_index, defaults).choose(capability, preferred, capability)


def plan_for_capabilities(spec_index: SpecIndex, capabilities: Iterable[str],
                          defaults: Defaults = None) -> StartPlan:
    """
    What it takes to start some capabilities at once.

    :param SpecIndex spec_index: what there is
    :param capabilities: iterable of str, the names of interfaces and semantic interfaces
    :param defaults: mapping from capabilities to their default providers, both str, or None
    :returns: `StartPlan`

    >>> from capabilities.spec_index import SpecIndex
    >>> plan_for_capabilities(SpecIndex(), []).order
    []
    """
    planner = _Planner(spec_index, defaults)
    for capability in capabilities:
        planner.add(capability)
    return planner.plan()


def plan_for_provider(spec_index: SpecIndex, provider_name: str,
                      defaults: Defaults = None) -> StartPlan:
    """
    What it takes to start a provider. In the order of the plan it is the last.

    :param SpecIndex spec_index: what there is
    :param str provider_name: ``package/name``
    :param defaults: mapping from capabilities to their default providers, both str, or None
    :returns: `StartPlan`
    :raises KeyError: if there is no such provider

    >>> from capabilities.spec_index import SpecIndex
    >>> plan_for_provider(SpecIndex(), 'navigation/navigation_nav_stack')
    Traceback (most recent call last):
        ...
    KeyError: 'navigation/navigation_nav_stack'
    """
    planner = _Planner(spec_index, defaults)
    planner.add(planner.specs[provider_name].implements, provider_name)
    return planner.plan()


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
    planner = _Planner(spec_index, defaults)
    for name, provider in planner.specs.items():
        planner.add(provider.implements, name)
    return [fault for fault in planner.plan().faults if fault.kind is FaultKind.CYCLE]


class _Planner:
    """The providers chosen so far, and what they depend on."""

    def __init__(self, spec_index: SpecIndex, defaults: Defaults) -> None:
        self.spec_index = spec_index
        self.specs = spec_index.providers
        self.capabilities = {*spec_index.interface_names, *spec_index.semantic_interface_names}
        self.defaults = defaults or {}
        self.candidates: Dict[str, Tuple[str, ...]] = {}
        self.dependencies: Dict[str, List[str]] = {}
        self.asked_for: Dict[str, str] = {}
        self.faults: List[Fault] = []

    def choose(self, capability: str, preferred: Optional[str], asked_for: str,
               required_by: Optional[str] = None) -> Union[str, Fault]:
        """The provider for a capability, or the fault that there is none."""
        def fault(kind: FaultKind, **attributes: Any) -> Fault:
            return Fault(kind, capability, asked_for, required_by, **attributes)

        if capability not in self.capabilities:
            return fault(FaultKind.NO_INTERFACE, known=self.capabilities)
        if capability not in self.candidates:   # once, since many may ask for one that has many
            self.candidates[capability] = tuple(self.spec_index.providers_of(capability))
        candidates = self.candidates[capability]
        named = preferred or self.defaults.get(capability)
        if named:
            named_one = {'provider': named, 'is_default': not preferred, 'candidates': candidates}
            if named not in self.specs:
                return fault(FaultKind.UNKNOWN_PROVIDER, known=self.specs, **named_one)
            implements = self.specs[named].implements
            if implements != capability:
                return fault(FaultKind.WRONG_PROVIDER, implements=implements, **named_one)
            return str(named)
        if not candidates:
            return fault(FaultKind.NO_PROVIDER)
        if len(candidates) > 1:
            return fault(FaultKind.AMBIGUOUS, candidates=candidates)
        return candidates[0]

    def add(self, asked_for: str, preferred: Optional[str] = None) -> None:
        """Choose a provider for a capability, and for all that it depends on."""
        waiting: List[Tuple[str, Optional[str], Optional[str]]] = [(asked_for, preferred, None)]
        while waiting:
            capability, preferred, required_by = waiting.pop()
            provider = self.choose(capability, preferred, asked_for, required_by)
            if isinstance(provider, Fault):
                self.faults.append(provider)
                continue
            if required_by is not None:
                self.dependencies[required_by].append(provider)
            if provider not in self.dependencies:
                self.dependencies[provider] = []
                self.asked_for[provider] = asked_for
                needed = self.specs[provider].dependencies.values()
                waiting += [(dependency.capability_name, dependency.preferred_provider, provider)
                            for dependency in reversed(list(needed))]

    def plan(self) -> StartPlan:
        """The plan for what was added."""
        running: Dict[str, List[str]] = {}
        for provider in self.dependencies:
            running.setdefault(self.specs[provider].implements, []).append(provider)
        for capability, providers in running.items():
            if len(providers) > 1:
                self.faults.append(Fault(FaultKind.CONFLICT, capability,
                                         self.asked_for[providers[-1]],
                                         candidates=tuple(providers)))
        order: List[str] = []
        for component in components(self.dependencies):
            order += component
            if len(component) > 1 or component[0] in self.dependencies[component[0]]:
                cycle = cycle_in(component, self.dependencies)
                self.faults.append(Fault(FaultKind.CYCLE, self.specs[cycle[0]].implements,
                                         self.asked_for[cycle[0]], cycle=cycle))
        chosen = {capability: providers[0] for capability, providers in running.items()}
        return StartPlan(order, chosen, self.dependencies, self.faults)
