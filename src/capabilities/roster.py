"""
The instances of capabilities, their dependencies, and the failures that are remembered.

A `Roster` knows and changes nothing but that; `capabilities.graph.Graph` decides on it.
"""
from __future__ import annotations

from capabilities.instances import (
    NO_EXIT_CODE, CapabilityInstance, Failure, get_reverse_depends)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Collection, Dict, Iterable, List, Optional, Sequence

__all__ = ['Roster']


class Roster:
    """
    Instances by the names of their capabilities, and failures.

    :param clock: called for the time, in seconds since 1970

    A capability has at most two instances: one that stops, and one that runs or is on its way.
    ``failures`` (dict from str to `Failure`) is what ended unasked or could not start, by the name
    of the capability, until it is wanted again.

    >>> Roster(lambda: 0.0).instances
    []
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self.failures: Dict[str, Failure] = {}
        self._clock = clock
        # Both have dependencies before what depends on them.
        self._current: Dict[str, CapabilityInstance] = {}
        self._stopping: Dict[str, CapabilityInstance] = {}

    @property
    def instances(self) -> List[CapabilityInstance]:
        """All instances, a list; one that stops comes before the one that waits for its end."""
        return [*self._stopping.values(), *self._current.values()]

    def current(self, interface: str) -> Optional[CapabilityInstance]:
        """The instance of a capability that runs or is on its way, or None."""
        return self._current.get(interface)

    def stopping(self, interface: str) -> Optional[CapabilityInstance]:
        """The instance of a capability that is ending, or None."""
        return self._stopping.get(interface)

    def dependents(self, instance: CapabilityInstance) -> List[CapabilityInstance]:
        """The instances that depend on this one directly, in whatever state."""
        return [other for other in get_reverse_depends(instance.interface, self.instances)
                if instance in other.dependencies]

    def could_not_start(self, interface: str, provider: str, text: str) -> None:
        """Remember that a capability could not be started."""
        self.failures[interface] = Failure(interface=interface, provider=provider, started=False,
                                           uses=0, dependents=(), since=self._clock(),
                                           exit_code=NO_EXIT_CODE, text=text)

    def forget_failures(self, interfaces: Collection[str]) -> None:
        """Forget the failures of all capabilities but these."""
        self.failures = {name: failure for name, failure in self.failures.items()
                         if name in interfaces}

    def _enter(self, planned: Iterable[CapabilityInstance]) -> None:
        """Add the planned instances whose capability has no current instance."""
        for instance in planned:
            if instance.interface not in self._current:
                instance.dependencies = [self._current[name] for name in instance.depends_on]
                instance.since = self._clock()
                self._current[instance.interface] = instance
                self.failures.pop(instance.interface, None)

    def _with_dependents(self, instances: Sequence[CapabilityInstance]
                         ) -> List[CapabilityInstance]:
        """Some current instances and all that depend on them, dependencies first."""
        found = set(map(id, instances))
        for instance in self._current.values():
            if any(id(dependency) in found for dependency in instance.dependencies):
                found.add(id(instance))
        return [instance for instance in self._current.values() if id(instance) in found]

    def _unwanted(self) -> List[CapabilityInstance]:
        """The current instances that nobody wants, dependencies first."""
        needed = {id(dependency) for instance in self._stopping.values()
                  for dependency in instance.dependencies}
        unwanted = []
        for instance in reversed(list(self._current.values())):
            if instance.started or instance.bonds or id(instance) in needed:
                needed.update(map(id, instance.dependencies))
            else:
                unwanted.append(instance)
        return unwanted[::-1]

    def _failure(self, instance: CapabilityInstance, exit_code: int, text: str) -> Failure:
        dependents = tuple(other.interface for other in self.dependents(instance))
        return Failure(interface=instance.interface, provider=instance.provider,
                       started=instance.started, uses=instance.reference_count,
                       dependents=dependents, since=self._clock(), exit_code=exit_code, text=text)
