"""Tells a client that a capability it used has failed, or was stopped by somebody else."""
from __future__ import annotations

import logging
import queue
import threading
from typing import Callable, Dict, NamedTuple, Optional, Tuple

import rosgraph
import rospy

from capabilities.msg import CapabilityStatuses
from capabilities.srv import GetSemanticInterfaces, GetStatus

__all__ = ['LostWatch']

_STOPPED = 'it was stopped'

_logger = logging.getLogger('rosout.capabilities')


class _Use(NamedTuple):
    """A use of a capability."""

    #: its name in the status: the name that was asked for, or that of a semantic interface
    entry: str
    #: stamp of the first status that listed it; earlier ones are ignored
    stamp: rospy.Time
    #: address of the server then, '' if it is not known
    address: str


class LostWatch:
    """
    Compares what a client uses with the status of the server.

    :param on_lost: called as ``on_lost(interface, text)``, one call after the other in a thread of
        its own
    :param str server: the name of the server's node
    """

    def __init__(self, on_lost: Callable[[str, str], object], server: str) -> None:
        self._on_lost = on_lost
        self._server = rospy.resolve_name(server)
        self._get_status = rospy.ServiceProxy(server + '/get_status', GetStatus)
        self._get_semantic_interfaces = rospy.ServiceProxy(server + '/get_semantic_interfaces',
                                                           GetSemanticInterfaces)
        self._used: Dict[str, _Use] = {}
        self._lock = threading.Lock()
        self._lost: 'queue.Queue[Tuple[str, str, str]]' = queue.Queue()
        self._thread: Optional[threading.Thread] = None

    def used(self, interface: str, provider: Optional[str]) -> None:
        """The client uses a capability, by this provider if it named one."""
        try:
            address = self._address()
            status = self._get_status().status
            entry = self._entry(status, interface, provider)
        except rospy.ServiceException as error:     # the bond will tell
            _logger.warning('the status of the capability server is not known: %s', error)
            return
        with self._lock:
            self._used.setdefault(interface, _Use(entry=entry, stamp=status.header.stamp,
                                                  address=address))
        self.status(status)

    def _entry(self, status: CapabilityStatuses, interface: str, provider: Optional[str]) -> str:
        """
        The name under which a status lists a capability that was asked for by this name.

        With a provider of a semantic interface, that is the name of the semantic interface.
        """
        providers = {entry.capability: entry.provider for entry in status.capabilities
                     if entry.state != 'failed'}
        names = [interface]
        if providers.get(interface) is None or provider not in (None, providers[interface]):
            names += self._get_semantic_interfaces(interface).semantic_interfaces
        for name in names:
            if name in providers and provider in (None, providers[name]):
                return str(name)
        return interface

    def freed(self, interface: str) -> None:
        """The client has freed it, so it cannot be lost any more."""
        with self._lock:
            self._used.pop(interface, None)

    def freed_all(self) -> None:
        """The client uses nothing any more."""
        with self._lock:
            self._used.clear()

    def lost_all(self, text: str) -> None:
        """All that the client uses is lost."""
        with self._lock:
            lost = list(self._used)
            self._used.clear()
        for interface in lost:
            self._tell(interface, text)

    def status(self, status: CapabilityStatuses) -> None:
        """Compare with a status of the server; messages may come late and out of order."""
        texts = {}
        for entry in status.capabilities:
            if entry.state != 'failed':
                texts[entry.capability] = ''
            else:
                texts.setdefault(entry.capability, entry.text or 'it has failed')
        lost = {}
        with self._lock:
            for interface, use in list(self._used.items()):
                text = texts.get(use.entry, _STOPPED)
                if text and status.header.stamp >= use.stamp:
                    lost[interface] = text, use.address
                    del self._used[interface]
        for interface, (text, address) in lost.items():
            self._tell(interface, text, address)

    def _address(self) -> str:
        """The address of the server's node, of which each run has another."""
        try:
            return str(rosgraph.Master(rospy.get_name()).lookupNode(self._server))
        except (OSError, rosgraph.MasterException):
            return ''

    def _tell(self, interface: str, text: str, address: str = '') -> None:
        with self._lock:
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, daemon=True)
                self._thread.start()
        self._lost.put((interface, text, address))

    def _run(self) -> None:
        while True:
            interface, text, address = self._lost.get()
            if text == _STOPPED and address and self._address() not in ('', address):
                text = 'the capability server was restarted'
            try:
                self._on_lost(interface, text)
            except Exception:
                _logger.exception('on_lost failed for %s', interface)
