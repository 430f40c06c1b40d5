"""How a plan is made: a provider for each capability, what has to run before it, and the faults."""
from __future__ import annotations

from typing import Collection, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple, Union

from capabilities.planning.faults import Fault, FaultKind
from capabilities.planning.launching import Launches, LookAt
from capabilities.planning.plan import PlannedProvider, RunningProvider, StartPlan
from capabilities.planning.start_order import components, cycle_in
from capabilities.spec_index import SpecIndex
from capabilities.specs.provider import CapabilityProvider
from rocon_uri.sources.wording import NearMisses

__all__ = ['Planner']

#: How many names one plan may be compared with to find near misses. Faults that are met after that
#: have none.
_MAX_COMPARED = 5000


class _Instance(NamedTuple):
    """An instance of a capability, which is running or has to be started."""

    #: what the provider implements
    capability: str
    #: its name
    provider: str
    #: is it running?
    running: bool


class _Need(NamedTuple):
    """A capability that is needed."""

    #: its name
    capability: str
    #: the provider that is preferred; '' or None where any will do
    preferred: Optional[str]
    #: the capability that was asked for, and needs this one
    asked_for: str
    #: the provider that depends on it; None for what was asked for
    required_by: Optional[str] = None


class Planner:
    """
    The providers chosen so far, and what they depend on.

    :param SpecIndex spec_index: the specs to choose from
    :param defaults: mapping from capabilities to their default providers, both str
    :param running: iterable of `RunningProvider`
    """

    def __init__(self, spec_index: SpecIndex, defaults: Optional[Mapping[str, str]],
                 running: Iterable[RunningProvider] = ()) -> None:
        self._spec_index = spec_index
        self._defaults = defaults or {}
        self._running = list(running)
        self._instances = {one.capability: _Instance(capability=one.capability,
                                                     provider=one.provider, running=True)
                           for one in self._running if not one.ends}
        self._candidates: Dict[str, Tuple[str, ...]] = {}
        self._chosen: Dict[str, str] = {}       # the first provider for each need
        self._dependencies: Dict[_Instance, List[_Instance]] = {}
        self._first_need: Dict[_Instance, _Need] = {}
        self._preferences: Dict[str, Dict[str, None]] = {}      # of sets that keep their order
        self._faults: List[Fault] = []
        self._near_misses = NearMisses(_MAX_COMPARED)

    def add(self, asked_for: str, preferred: Optional[str] = None) -> None:
        """Find an instance for a capability, and for all that it depends on."""
        waiting: List[Tuple[_Need, Optional[_Instance]]] = [
            (_Need(capability=asked_for, preferred=preferred, asked_for=asked_for), None)]
        while waiting:
            need, dependent = waiting.pop()
            instance = self._instance(need)
            if isinstance(instance, Fault):
                self._faults.append(instance)
                continue
            self._chosen.setdefault(need.capability, instance.provider)
            if dependent is not None:
                self._dependencies[dependent].append(instance)
            if instance not in self._dependencies:
                self._dependencies[instance] = []
                self._first_need[instance] = need
                if not instance.running:    # what a running one depends on is not checked
                    needed = self._provider(instance.provider).dependencies.values()
                    waiting += [(_Need(capability=one.capability_name,
                                       preferred=one.preferred_provider, asked_for=asked_for,
                                       required_by=instance.provider), instance)
                                for one in reversed(list(needed))]

    def choose(self, capability: str, preferred: Optional[str], asked_for: str,
               required_by: Optional[str] = None) -> Union[str, Fault]:
        """The provider of a capability, or the fault why there is none."""
        def fault(kind: FaultKind, provider: Optional[str] = None,
                  implements: Optional[str] = None, candidates: Tuple[str, ...] = (),
                  semantic_candidates: Tuple[str, ...] = (),
                  known: Collection[str] = ()) -> Fault:
            return Fault(kind=kind, capability=capability, asked_for=asked_for,
                         required_by=required_by, provider=provider,
                         is_default=provider is not None and not preferred, implements=implements,
                         candidates=candidates, semantic_candidates=semantic_candidates,
                         known=known)

        if self._spec_index.capability(capability) is None:
            return fault(FaultKind.NO_INTERFACE, known=self._alike(capability, 'capabilities'))
        candidates = self._candidates_for(capability)
        named = preferred or self._defaults.get(capability)
        if named:
            provider = self._spec_index.provider(named)
            if provider is None:
                return fault(FaultKind.UNKNOWN_PROVIDER, named, None, candidates,
                             known=self._alike(named, 'providers'))
            implements = provider.implements
            implemented = self._spec_index.capability(implements)
            if capability not in (implements, getattr(implemented, 'redefines', None)):
                return fault(FaultKind.WRONG_PROVIDER, named, implements, candidates)
            return str(named)
        if not candidates:
            return fault(FaultKind.NO_PROVIDER,
                         semantic_candidates=self._semantic_candidates(capability))
        if len(candidates) > 1:
            return fault(FaultKind.AMBIGUOUS, candidates=candidates)
        return candidates[0]

    def plan(self, look_at: Optional[LookAt] = None, nodelet_manager: bool = True) -> StartPlan:
        """
        The plan for what was added.

        :param look_at: as `LaunchFiles.look_at`; None where launch files do not matter
        :param bool nodelet_manager: is there one?
        """
        faults = self._faults + self._conflicts()
        order: List[_Instance] = []
        for component in components(self._dependencies):
            order += component
            if len(component) > 1 or component[0] in self._dependencies[component[0]]:
                cycle = cycle_in(component, self._dependencies)
                faults.append(Fault(kind=FaultKind.CYCLE, capability=cycle[0].capability,
                                    asked_for=self._first_need[cycle[0]].asked_for,
                                    cycle=tuple(one.provider for one in cycle)))
        launches = Launches(self._spec_index, self._running, look_at, nodelet_manager)
        steps = [self._step(instance, launches) for instance in order]
        dependencies = {one.provider: [below.provider for below in needed]
                        for one, needed in self._dependencies.items()}
        providers = dict(self._chosen)
        for one in self._dependencies:
            providers.setdefault(one.capability, one.provider)
        return StartPlan(order=[step.provider for step in steps if not step.running],
                         providers=providers, dependencies=dependencies,
                         faults=faults + launches.all_faults(), steps=tuple(steps),
                         unread=tuple(launches.unread))

    def _instance(self, need: _Need) -> Union[_Instance, Fault]:
        """The instance that meets a need: an existing one, whatever its provider, or a new one."""
        running = self._instances.get(need.capability)
        if running is not None and not need.preferred:
            return running
        chosen = self.choose(*need)
        if isinstance(chosen, Fault):
            # A request for a bad provider is refused. A dependency is met: it is running.
            return chosen if running is None or need.required_by is None else running
        implements = str(self._provider(chosen).implements)
        shared = self._instances.get(implements, running)
        if shared is not None:
            return shared
        if need.preferred:
            self._preferences.setdefault(need.capability, {})[chosen] = None
        return _Instance(capability=implements, provider=chosen, running=False)

    def _provider(self, name: str) -> CapabilityProvider:
        """The provider of a name that there is."""
        provider = self._spec_index.provider(name)
        if provider is None:
            raise KeyError(name)
        return provider

    def _alike(self, name: str, kind: str) -> Collection[str]:
        """The names among which a near miss is looked for: none after too many comparisons."""
        return self._near_misses.among(self._spec_index.names_like(name, kind))

    def _candidates_for(self, capability: str) -> Tuple[str, ...]:
        if capability not in self._candidates:  # once, since many may depend on it
            self._candidates[capability] = tuple(self._spec_index.providers_of(capability))
        return self._candidates[capability]

    def _semantic_candidates(self, capability: str) -> Tuple[str, ...]:
        return tuple(provider for name in self._spec_index.redefinitions_of(capability)
                     for provider in self._candidates_for(name))

    def _conflicts(self) -> List[Fault]:
        """The capabilities for which several providers would have to run, or are preferred."""
        chosen: Dict[str, Dict[str, None]] = {}
        for instance in self._dependencies:
            if not instance.running:
                chosen.setdefault(instance.capability, {})[instance.provider] = None
        faults: List[Fault] = []
        for capability in {**chosen, **self._preferences}:
            implementing = chosen.get(capability, {})
            preferred = self._preferences.get(capability, {})
            if len(implementing) > 1 or len(preferred) > 1:
                candidates = tuple({**implementing, **preferred})
                last = _Instance(capability=str(self._provider(candidates[-1]).implements),
                                 provider=candidates[-1], running=False)
                faults.append(Fault(kind=FaultKind.CONFLICT, capability=capability,
                                    asked_for=self._first_need[last].asked_for,
                                    candidates=candidates))
        return faults

    def _step(self, instance: _Instance, launches: Launches) -> PlannedProvider:
        capability, provider, running = instance
        need = self._first_need[instance]
        launch_file = None
        if not running:
            launch_file = launches.add(capability, self._provider(provider), need.asked_for)
        depends_on = dict.fromkeys(below.capability for below in self._dependencies[instance])
        return PlannedProvider(capability=capability, provider=provider, running=running,
                               launch_file=launch_file, depends_on=tuple(depends_on),
                               required_by=need.required_by)
