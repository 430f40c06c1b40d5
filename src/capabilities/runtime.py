"""
The graph of what is wanted, joined with the processes that run it.

A `Runtime` has the one lock of the capability server. Under the lock, requests, bonds and events of
processes are told to the graph, and the actions of the graph are carried out; nothing that takes
long is done while it is held. A `Runtime` knows launch files and processes, but not ROS: an
`Audience` publishes.
"""
from __future__ import annotations

import threading
import time
from collections import deque
from typing import TYPE_CHECKING, Callable, Deque, Dict, List, Optional, TypeVar

from capabilities.actions import ENDS, Action, Do, RefusedRequest, StartResult
from capabilities.catalogue import Catalogue
from capabilities.graph import Graph
from capabilities.instances import CapabilityInstance
from capabilities.launch_manager import LaunchManager, _special_nodelet_manager_capability
from capabilities.planning.plan import StartPlan, error_text
from capabilities.starts import Starts, running_providers
from capabilities.status import status_entries
from rocon_uri.sources.wording import quoted

if TYPE_CHECKING:
    from capabilities.launch import Report
    from capabilities.listeners import Audience

__all__ = ['Runtime']

T = TypeVar('T')

_LOSSES = 3                 # with that loss of the nodelet manager
_LOSSES_SECONDS = 60.0      # within this time the server ends


class Runtime:
    """
    Starts and stops capabilities. Its methods may be called in any thread.

    :param audience: is told what happens
    :param Catalogue catalogue: what can be started
    :param bool keep_dependents: keep the dependents of a capability that ended unasked?
    :param bool ends_without_nodelet_manager: end the server when the nodelet manager ends?

    All methods that serve a request raise `RefusedRequest` once the server ends.
    """

    def __init__(self, audience: Audience, catalogue: Catalogue, keep_dependents: bool = False,
                 ends_without_nodelet_manager: bool = False) -> None:
        self.lock = threading.Lock()
        self.graph = Graph(time.time, keep_dependents)
        self.catalogue = catalogue
        self._audience = audience
        self._ends_without_nodelet_manager = ends_without_nodelet_manager
        self._starts = Starts()
        self._manager: Optional[LaunchManager] = None
        self._has_manager = threading.Event()
        self._by_pid: Dict[int, CapabilityInstance] = {}
        self._gone: Dict[int, threading.Event] = {}
        self._losses: Deque[float] = deque(maxlen=_LOSSES)      # by the monotonic clock
        self._reloads = 0                   # how many were begun
        self._newest_reload = 0             # the number of the newest that was finished

    @property
    def manager(self) -> LaunchManager:
        """The `LaunchManager`, which runs the launch files."""
        assert self._manager is not None
        return self._manager

    @manager.setter
    def manager(self, manager: LaunchManager) -> None:
        with self.lock:
            self._manager = manager
            self._starts.has_nodelet_manager = manager.has_nodelet_manager
            self._tell_of_manager('launched')
        self._has_manager.set()

    # requests

    def check_running(self) -> None:
        """Check that the server does not end."""
        if self.graph.ends:
            raise RefusedRequest(ENDS)

    def plan(self, capability: str, preferred: str) -> StartPlan:
        """What a start would do (`StartPlan`); starts nothing."""
        with self.lock:
            running = running_providers(self.graph)
        return self._starts.plan(self.catalogue, capability, preferred, running, may_read=True)

    def start(self, capability: str, preferred: str) -> StartResult:
        """Start a capability for as long as nobody stops it."""
        def start(plan: StartPlan) -> StartResult:
            return self.graph.start(plan.steps[-1].capability,
                                    self._starts.instances(self.catalogue, plan))
        return self._with_plan(capability, preferred, start)

    def use(self, capability: str, preferred: str, bond_id: str) -> None:
        """Count a use of a capability, and start it if it does not run."""
        def use(plan: StartPlan) -> None:
            self.graph.check_bond(bond_id)
            name = plan.steps[-1].capability
            current = self.graph.current(name)
            if current is not None and preferred not in ('', current.provider):
                raise RefusedRequest('Capability %s is already running with provider %s' % (
                    quoted(name), quoted(current.provider)))
            self.graph.use(name, self._starts.instances(self.catalogue, plan), bond_id, capability)
        with self.lock:
            self.check_running()
            self.graph.check_bond(bond_id)
        self._with_plan(capability, preferred, use)

    def free(self, capability: str, bond_id: str) -> None:
        """Count one use less. If nobody wants the capability now, wait until it has ended."""
        self._wait_for(lambda: self.graph.free(capability, bond_id))

    def stop(self, capability: str) -> None:
        """Stop a capability and what depends on it, and wait until they have ended."""
        self._wait_for(lambda: self.graph.stop(capability))

    def bond_made(self, bond_id: str) -> None:
        """Accept uses by a new bond."""
        with self.lock:
            self.check_running()
            self.graph.bond_formed(bond_id)

    def bond_broken(self, bond_id: str) -> None:
        """Drop the uses of a bond that has ended."""
        with self.lock:
            self.graph.bond_broken(bond_id)
            self._carry_out()

    def autostart(self, capabilities: List[str]) -> None:
        """Start some capabilities explicitly; those that cannot be started are failed."""
        for name in capabilities:
            try:
                self.start(name, '')
            except RefusedRequest as error:
                with self.lock:
                    if self.graph.ends:
                        return
                    self.graph.could_not_start(name, '', str(error))
                    self._carry_out()
                    self._audience.error('autostart of %s: %s' % (quoted(name), error))

    def reload(self, read: Callable[[], Catalogue]) -> None:
        """
        Replace the catalogue. Nothing that runs is touched; if it raises, nothing changes.

        :param read: makes the new one; called without the lock
        """
        with self.lock:
            self.check_running()
            self._reloads += 1
            reload = self._reloads
        catalogue = read()
        with self.lock:
            self.check_running()
            if reload > self._newest_reload:    # otherwise a later one was faster
                self._newest_reload = reload
                self.catalogue = catalogue
                self.graph.forget_failures(set(catalogue.spec_index.interface_names)
                                           | set(catalogue.spec_index.semantic_interface_names))
                self._carry_out()

    # the listener of the launch manager

    def launch_reported(self, pid: int, report: Report) -> None:
        """A launch file has started its nodes, or something happened to one of them."""
        with self.lock:
            instance = self._by_pid.get(pid)
            if instance is None:
                return
            if report.kind == 'started':
                self.graph.nodes_started(instance)
            else:
                self.graph.noted(instance, report.node, report.text, report.degrades)
            self._carry_out()

    def launch_ended(self, pid: int, exit_code: int, text: str) -> None:
        """Note that all processes of a launch are gone."""
        with self.lock:
            instance = self._by_pid.pop(pid, None)
            if instance is None:
                return
            unexpected = self.graph.current(instance.interface) is instance
            if unexpected:
                self._audience.error('capability %s by %s ended unexpectedly: %s' % (
                    quoted(instance.interface), quoted(instance.provider), text))
            self.graph.ended(instance, exit_code, 'ended unexpectedly: %s' % text)
            self._carry_out()

    def nodelet_manager_ended(self, pid: int, exit_code: int, text: str) -> None:
        """Start the nodelet manager again after its end, or end the server."""
        self._has_manager.wait()
        with self.lock:
            self._tell_of_manager('terminated', pid)
            if self.graph.ends:
                return
            self._losses.append(time.monotonic())
            are_too_many = (len(self._losses) == _LOSSES
                            and self._losses[-1] - self._losses[0] < _LOSSES_SECONDS)
            if self._ends_without_nodelet_manager or are_too_many:
                self._audience.must_end(1)
                return
            try:
                self.manager.start_nodelet_manager()
            except RuntimeError as error:
                self._audience.error('the nodelet manager cannot be started again: %s' % error)
                self._audience.must_end(1)
                return
            self._tell_of_manager('launched')
            self.graph.restart([instance.interface for instance in self.graph.instances
                                if instance.uses_nodelet_manager])
            self._carry_out()

    # the end

    def begin_end(self) -> None:
        """Refuse all requests, start nothing more, and begin to end everything at once."""
        with self.lock:
            if self.graph.ends:
                return
            self._tell_of_manager('stopped')
            self.graph.end()
            self._carry_out()
        if self._manager is not None:
            self._manager.begin_end()

    def end(self) -> None:
        """End everything, and wait for that."""
        self.begin_end()
        if self._manager is not None:
            self._manager.end()

    # how it is done; all of it under the lock

    def _with_plan(self, capability: str, preferred: str, do: Callable[[StartPlan], T]) -> T:
        """Plan a start, and do something with the plan if it has no faults. Takes the lock."""
        while True:
            self.plan(capability, preferred)    # reads the launch files that changed
            with self.lock:
                self.check_running()
                plan = self._starts.plan(self.catalogue, capability, preferred,
                                         running_providers(self.graph), may_read=False)
                if plan.unread:     # there was a reload or a stop meanwhile
                    continue
                if plan.faults:
                    raise RefusedRequest(error_text(plan))
                result = do(plan)
                self._carry_out()
                return result

    def _wait_for(self, do: Callable[[], List[CapabilityInstance]]) -> None:
        """Do something that stops instances, and wait until they are gone. Takes the lock."""
        with self.lock:
            self.check_running()
            gone = [self._gone.setdefault(id(instance), threading.Event()) for instance in do()]
            self._carry_out()
        for event in gone:
            event.wait()

    def _carry_out(self) -> None:
        """Carry out the actions of the graph until there are none."""
        actions = self.graph.take_actions()
        while actions:
            for action in actions:
                self._do(action)
            actions = self.graph.take_actions()
        self._audience.status(status_entries(self.graph))

    def _do(self, action: Action) -> None:
        do, instance = action
        if do is Do.LAUNCH:
            self._launch(instance)
        elif do is Do.STOP:
            try:
                self.manager.begin_stop(instance.pid or 0)
            except RuntimeError:
                pass    # it has ended by itself; `launch_ended` follows
        elif do is Do.GONE:
            event = self._gone.pop(id(instance), None)
            if event is not None:
                event.set()
        else:
            self._audience.told(do.value, instance.interface, instance.provider, instance.pid or 0)

    def _launch(self, instance: CapabilityInstance) -> None:
        if instance.canceled:
            return

        def remember(pid: int) -> None:
            self._by_pid[pid] = instance

        try:
            pid = self.manager.run_capability_provider(
                instance.spec, instance.provider_path, remember)
        except RuntimeError as error:
            self._audience.error('capability %s: %s' % (quoted(instance.interface), error))
            self.graph.launch_failed(instance, str(error))
        else:
            self.graph.launched(instance, pid)

    def _tell_of_manager(self, event: str, pid: Optional[int] = None) -> None:
        """Tell the audience of an event of the nodelet manager, if there is one."""
        if self._manager is not None:
            pid = pid or self._manager.nodelet_manager_pid
            if pid is not None:
                self._audience.told(event, _special_nodelet_manager_capability,
                                    self._manager.nodelet_manager_name.lstrip('/'), pid)
