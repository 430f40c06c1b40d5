"""
Decides which capabilities run: those that somebody wants, and no other.

An explicit start, a use by a bond and a running dependent each want a capability. A capability that
is stopping needs its dependencies until it is gone. Callers tell a `Graph` each request and each
event, and it answers with `Action` objects. It knows neither ROS nor processes, and has no thread
and no lock: callers tell it one thing at a time, and carry out the actions of `Graph.take_actions`,
in their order, before they tell it the next.

- Dependencies start first. A capability is launched as soon as the processes of all its
  dependencies exist; nothing waits until their nodes are ready.
- Dependents end before their dependencies; independent capabilities end at the same time.
- A process that ends unasked is not started again. Its start and its uses end, and its dependents
  are stopped (unless they are to be kept).
- While an instance stops, a use of the capability makes a new one, which waits for that end.
"""
from __future__ import annotations

from capabilities.actions import ENDS, Action, Do, RefusedRequest, StartResult
from capabilities.instances import NO_EXIT_CODE, CapabilityInstance, State
from capabilities.roster import Roster
from rocon_uri.sources.wording import quoted

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Collection, Iterable, List, Sequence, Set

__all__ = ['ENDS', 'Action', 'Do', 'Graph', 'RefusedRequest', 'StartResult']


class Graph(Roster):
    """
    What is wanted, and what runs.

    :param clock: called for the time, in seconds since 1970
    :param bool keep_dependents: keep dependents of an instance that ended unasked, as degraded?

    >>> Graph(lambda: 0.0).instances
    []
    """

    def __init__(self, clock: Callable[[], float], keep_dependents: bool = False) -> None:
        super().__init__(clock)
        self._keep_dependents = keep_dependents
        self._bonds: Set[str] = set()
        self._actions: List[Action] = []
        self._ends = False

    @property
    def ends(self) -> bool:
        """Was `end` called? (bool)"""
        return self._ends

    def take_actions(self) -> List[Action]:
        """The actions since the last call: a list, in the order to carry them out."""
        actions, self._actions = self._actions, []
        return actions

    # what is asked for

    def start(self, interface: str, planned: Iterable[CapabilityInstance]) -> StartResult:
        """
        Somebody starts a capability explicitly.

        :param str interface: the name that its instance has
        :param planned: the instances that the start takes, dependencies first; those whose
            capability has a current instance already are ignored
        :raises RefusedRequest: if the server ends
        """
        self._refuse_if_it_ends()
        if interface in self._stopping:
            return StartResult.STOPPING
        instance = self._current.get(interface)
        result = StartResult.SUCCESS
        if instance is not None:
            result = StartResult.RUNNING if instance.is_up else StartResult.STARTING
        self._enter(planned)
        self._current[interface].started = True
        self._advance()
        return result

    def use(self, interface: str, planned: Iterable[CapabilityInstance], bond_id: str,
            asked_as: str) -> None:
        """
        A client uses a capability. One that stops starts again when it has ended.

        :param str interface: the name that its instance has
        :param planned: as `start` takes it
        :param str bond_id: the bond of the client
        :param str asked_as: the name that the client said: ``interface``, or what it redefines
        :raises RefusedRequest: if the server ends, or there is no such bond
        """
        self._refuse_if_it_ends()
        self.check_bond(bond_id)
        self._enter(planned)
        self._current[interface].add_use(bond_id, asked_as)
        self._advance()

    def free(self, name: str, bond_id: str) -> List[CapabilityInstance]:
        """
        A client frees one use of a capability.

        :param str name: of the capability, or of what it redefines
        :returns: the instances that this stops, a list
        :raises RefusedRequest: if the bond has no use of it
        """
        candidates = [instance for instance in self._current.values()
                      if name in (instance.interface, instance.redefines)]
        if not candidates:
            raise RefusedRequest(
                'Cannot free Capability %s, because it is not running' % quoted(name))
        used = [instance for instance in candidates if bond_id in instance.bonds]
        if not used:
            raise RefusedRequest(
                'Given bond_id %s not associated with given capability %s' % (
                    quoted(bond_id), quoted(name)))
        instance = min(used, key=lambda instance: (instance.interface != name,
                                                   (bond_id, name) not in instance.asked_as))
        instance.remove_use(bond_id, name)
        self._advance()
        return [instance] if self._stopping.get(instance.interface) is instance else []

    def stop(self, name: str) -> List[CapabilityInstance]:
        """
        Somebody stops a capability, whoever wants it, and what depends on it.

        :returns: the instances whose end is to be waited for, a list
        :raises RefusedRequest: if there is no instance of it
        """
        if name not in self._current and name not in self._stopping:
            raise RefusedRequest('No Capability %s running' % quoted(name))
        ending = {name}
        if name in self._current:
            affected = self._with_dependents([self._current[name]])
            ending.update(instance.interface for instance in affected)
            self._retire(affected)
            self._advance()
        return [self._stopping[name] for name in ending if name in self._stopping]

    def bond_formed(self, bond_id: str) -> None:
        """Accept uses by a new bond from now on."""
        self._bonds.add(bond_id)

    def check_bond(self, bond_id: str) -> None:
        """
        Check that a use may name a bond.

        :raises RefusedRequest: if there is none of this id
        """
        if bond_id not in self._bonds:
            raise RefusedRequest(
                'Invalid bond_id given to ~use_capability: %s' % quoted(bond_id))

    def bond_broken(self, bond_id: str) -> None:
        """A bond has ended, and all its uses end."""
        self._bonds.discard(bond_id)
        for instance in self._current.values():
            instance.drop_wants(bond_id)
        self._advance()

    def restart(self, interfaces: Collection[str]) -> None:
        """Stop capabilities and what depends on them, and start them again. All wants stay."""
        affected = self._with_dependents(
            [instance for name, instance in self._current.items() if name in interfaces])
        successors = {id(instance): instance.successor() for instance in affected}
        for instance in affected:
            successor = successors[id(instance)]
            successor.dependencies = [successors.get(id(dependency), dependency)
                                      for dependency in instance.dependencies]
            successor.since = self._clock()
        self._retire(affected)
        for successor in successors.values():
            self._current[successor.interface] = successor
        self._advance()

    def end(self) -> None:
        """
        Start nothing any more, since the server ends. No action stops anything: the caller ends all
        processes at once.
        """
        self._ends = True
        self._retire(list(self._current.values()))

    # what happened

    def launched(self, instance: CapabilityInstance, pid: int) -> None:
        """The process of an instance was made."""
        instance.pid = pid
        instance.since = self._clock()
        self._act(Do.TELL_LAUNCHED, instance)
        self._advance()

    def launch_failed(self, instance: CapabilityInstance, text: str) -> None:
        """The process of an instance could not be made."""
        self._lose(instance, NO_EXIT_CODE, text)

    def nodes_started(self, instance: CapabilityInstance) -> None:
        """The process of an instance has started its nodes."""
        if instance.state is State.LAUNCHING and instance.pid is not None:
            instance.launched(instance.pid)
            instance.since = self._clock()

    def noted(self, instance: CapabilityInstance, about: str, text: str,
              is_degraded: bool) -> None:
        """Note a text about a node or dependency of an instance, which may degrade the instance."""
        instance.notes[about] = text
        if is_degraded and instance.is_up and instance.state is not State.DEGRADED:
            instance.degraded()
            instance.since = self._clock()

    def ended(self, instance: CapabilityInstance, exit_code: int, text: str) -> None:
        """
        The process of an instance has ended, and nothing of it is left.

        :param int exit_code: 0 to 255, or 128 + n for a signal n
        :param str text: how it ended, if that was unasked
        """
        if self._stopping.get(instance.interface) is instance:
            del self._stopping[instance.interface]
            self._gone(instance)
            self._advance()
        elif self._current.get(instance.interface) is instance:
            self._lose(instance, exit_code, text)

    def _lose(self, instance: CapabilityInstance, exit_code: int, text: str) -> None:
        """A current instance has ended unasked."""
        instance.failure = self._failure(instance, exit_code, text)
        dependents = [other for other in self._with_dependents([instance])
                      if other is not instance]
        text = '%s, which it depends on, ended' % instance.interface
        if self._keep_dependents:
            for other in dependents:
                if other.is_up and instance in other.dependencies:
                    other.dependencies.remove(instance)
                    self.noted(other, instance.interface, text, True)
            dependents = [other for other in dependents if not other.is_up]
        del self._current[instance.interface]
        instance.drop_wants()
        self._gone(instance)
        self._retire(dependents, text)
        self._advance()

    # how it is decided

    def _refuse_if_it_ends(self) -> None:
        if self._ends:
            raise RefusedRequest(ENDS)

    def _retire(self, instances: Sequence[CapabilityInstance], text: str = '') -> None:
        """End all starts and uses of current instances; with a text, remember them as failed."""
        if text:
            for instance in instances:
                instance.failure = self._failure(instance, NO_EXIT_CODE, text)
        for instance in reversed(instances):
            instance.drop_wants()
            del self._current[instance.interface]
            if instance.pid is None:
                instance.canceled = True
                self._gone(instance)
            else:
                instance.stopped()
                instance.since = self._clock()
                self._act(Do.TELL_STOPPED, instance)
        for instance in instances:
            if not instance.canceled:
                self._stopping[instance.interface] = instance

    def _gone(self, instance: CapabilityInstance) -> None:
        """Note that an instance has gone."""
        instance.ended()
        if instance.failure is not None and instance.interface not in self._current:
            self.failures[instance.interface] = instance.failure._replace(since=self._clock())
        if instance.pid is not None:
            self._act(Do.TELL_TERMINATED, instance)
        self._act(Do.GONE, instance)

    def _advance(self) -> None:
        """Stop what nobody wants, end what nothing needs any more, launch what is ready."""
        self._retire(self._unwanted())
        if self._ends:
            return
        needed = {id(dependency) for instance in self._stopping.values()
                  for dependency in instance.dependencies}
        for instance in self._stopping.values():
            if id(instance) not in needed and not instance.stop_sent:
                instance.stop_sent = True
                self._act(Do.STOP, instance)
        for instance in self._current.values():
            if (instance.state is State.WAITING and instance.interface not in self._stopping
                    and all(dependency.is_up for dependency in instance.dependencies)):
                instance.launch()
                self._act(Do.LAUNCH, instance)

    def _act(self, do: Do, instance: CapabilityInstance) -> None:
        self._actions.append(Action(do, instance))
