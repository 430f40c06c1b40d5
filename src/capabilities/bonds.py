"""The server's halves of the bonds of its clients."""
from __future__ import annotations

import threading
import uuid
from typing import Callable, Dict

import capabilities.needs_ros  # noqa: F401

from bond.msg import Status
from bondpy import bondpy
import rospy

__all__ = ['Bond', 'Bonds', 'watch_from_now']

#: how many heartbeats to one client may be queued; all bonds share the topic, and in a shorter
#: queue heartbeats of the same moment would push each other out
_QUEUE_SIZE = 1000


class Bonds:
    """
    Bonds on one topic. Methods may be called in any thread.

    :param str topic: the topic of all of them
    :param on_broken: called with the id of a bond that was broken, fell silent or never formed
    :param later: called with a function that another thread is to call
    """

    def __init__(self, topic: str, on_broken: Callable[[str], None],
                 later: Callable[[Callable[[], object]], None]) -> None:
        self._topic = topic
        self._on_broken = on_broken
        self._later = later
        self._lock = threading.Lock()
        self._bonds: Dict[str, Bond] = {}
        # With these the topic stays connected, so that no bond has to wait for the master.
        self._publisher = rospy.Publisher(topic, Status, queue_size=_QUEUE_SIZE)
        self._subscriber = rospy.Subscriber(topic, Status, self._heard)

    @staticmethod
    def new_id() -> str:
        """The id for a new bond."""
        return str(uuid.uuid1())

    def start(self, bond_id: str) -> None:
        """Begin a bond of a new id."""
        bond = Bond(self._topic, bond_id, lambda: self._broken(bond_id))
        bond.set_formed_callback(lambda: watch_from_now(bond))
        self._publisher.impl.set_queue_size(_QUEUE_SIZE)    # the bond has set it to 1
        with self._lock:
            self._bonds[bond_id] = bond
        bond.start()
        # If each bond looked at the heartbeats of all, a hundred bonds would take all the time.
        bond.sub.unregister()

    def end(self) -> None:
        """Break all bonds."""
        with self._lock:
            bonds = list(self._bonds.values())
        for bond in bonds:
            bond.shutdown()

    def _heard(self, status: Status) -> None:
        """Pass a heartbeat or a notice of death to its bond."""
        with self._lock:
            bond = self._bonds.get(status.id)
        if bond is not None:
            bond._on_bond_status(status)

    def _broken(self, bond_id: str) -> None:
        with self._lock:
            bond = self._bonds.pop(bond_id, None)
        self._on_broken(bond_id)
        if bond is not None:
            self._later(bond.shutdown)      # not now: the bond is in the middle of this call


class Bond(bondpy.Bond):   # type: ignore[misc]
    """A bond that also breaks when the master is gone."""

    def _on_heartbeat_timeout(self) -> None:
        try:
            super()._on_heartbeat_timeout()
        except (OSError, rospy.ROSException):   # whether timeouts are disabled cannot be asked
            with self.lock:
                self.sm.HeartbeatTimeout()
            self._flush_pending_callbacks()


def watch_from_now(bond: bondpy.Bond) -> None:
    """Watch the other half from its first answer; bondpy would wait for a second heartbeat."""
    with bond.lock:
        if bond.sm.getState().getName() == 'SM.Alive':
            bond.heartbeat_timer.reset()
