"""What the capability server publishes: events, its status, and diagnostics."""
from __future__ import annotations

import logging
import threading
import time
from typing import Callable, List, Optional

import rospy

from capabilities.messages import (
    DiagnosticArray, diagnostics_message, event_message, ready_message, status_message)
from capabilities.msg import CapabilityEvent, CapabilityStatuses
from capabilities.outbox import Outbox
from capabilities.status import StatusEntry

__all__ = ['Publications']

Publish = Callable[[CapabilityEvent], None]

_logger = logging.getLogger('rosout.capabilities')


class Publications:
    """
    The topics of the server, and its log. It is the audience of the runtime.

    :param str server: the name of the node
    :param must_end: called with the exit status with which the server is to end

    Nothing here waits for anything but `close`: what is told is published by a thread of its own,
    in the order in which it was told.
    """

    def __init__(self, server: str, must_end: Callable[[int], None]) -> None:
        self.must_end = must_end
        self._server = server
        self._outbox = Outbox()
        self._ready = False
        self._entries: List[StatusEntry] = []
        self._published: Optional[CapabilityStatuses] = None
        self._closed = threading.Event()
        self._events = rospy.Publisher('~events', CapabilityEvent, _Greeting(self._greeting),
                                       queue_size=1000)
        self._status = rospy.Publisher('~status', CapabilityStatuses, latch=True, queue_size=10)

    def told(self, event: str, capability: str, provider: str, pid: int) -> None:
        """Publish an event."""
        message = event_message(event, capability, provider, pid, time.time())
        self._outbox.put(lambda: self._events.publish(message))

    def status(self, entries: List[StatusEntry]) -> None:
        """Publish the status, unless a newer one replaces it first."""
        self._entries = entries
        self._outbox.put(self._publish_status)

    def error(self, text: str) -> None:
        """Log an error."""
        self._outbox.put(lambda: _logger.error('%s', text))

    def later(self, do: Callable[[], object]) -> None:
        """Have a function called by the thread that publishes."""
        self._outbox.put(do)

    def ready(self) -> None:
        """Tell the subscribers that the server is ready, and each later one when it subscribes."""
        self._ready = True
        self._outbox.put(lambda: self._events.publish(ready_message()))
        self._outbox.put(self._publish_status)
        if DiagnosticArray is not None:
            threading.Thread(target=self._diagnose, name='diagnostics', daemon=True).start()

    def status_message(self) -> CapabilityStatuses:
        """The status as it is now."""
        return status_message(self._entries, self._server, self._ready, time.time())

    def close(self) -> None:
        """Send what was told so far, and nothing after it."""
        self._closed.set()
        self._outbox.close(2.0)
        _flush(self._events, self._status)

    def _greeting(self) -> Optional[CapabilityEvent]:
        """The event for a new subscriber, if any."""
        return ready_message() if self._ready else None

    def _publish_status(self) -> None:
        message = self.status_message()
        published = self._published
        if published is None or (message.ready, message.capabilities) != (
                published.ready, published.capabilities):
            self._published = message
            self._status.publish(message)

    def _diagnose(self) -> None:
        publisher = rospy.Publisher('/diagnostics', DiagnosticArray, queue_size=10)
        while not self._closed.wait(1.0):
            publisher.publish(diagnostics_message(self._entries, self._server, time.time()))


class _Greeting(rospy.SubscribeListener):   # type: ignore[misc]
    """Sends a message to each new subscriber of a topic, and to no other."""

    def __init__(self, message: Callable[[], Optional[CapabilityEvent]]) -> None:
        super().__init__()
        self._message = message

    def peer_subscribe(self, topic_name: str, topic_publish: Publish,
                       peer_publish: Publish) -> None:
        message = self._message()
        if message is not None:
            peer_publish(message)


def _flush(*publishers: rospy.Publisher) -> None:
    """Wait, a second at most, until what was published has been handed to the system."""
    deadline = time.monotonic() + 1.0
    for publisher in publishers:
        for connection in list(getattr(publisher.impl, 'connections', None) or ()):
            while getattr(connection, '_queue', None) and time.monotonic() < deadline:
                time.sleep(0.01)
