"""
Print what starts and what ends, as it happens.

Example:
  rocon_uri capabilities watch

Each line is an event: the time, what happened, the capability, its provider, the
pid of its roslaunch. If "terminated" comes without "stopped" before it, nobody
asked for that end. The command runs until it is interrupted or the server ends.

Exit status: 0 when the server has ended; 2 if no server answers
JSON: an object per line: {"time": SECONDS, "event", "capability", "provider",
"pid"}
"""
from __future__ import annotations

import json
import queue
import time

from rocon_uri.cli.display import painter
from rocon_uri.cli.given import say
from rocon_uri.cli.packages import one_line

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Any, Dict
    from rocon_uri.cli.running import RunningServer

__all__ = ['add_arguments', 'main']

_STYLES = {'launched': 'green', 'terminated': 'red'}
_PATIENCE = 2.0     # seconds without a connection to the server, after which it has gone


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """It takes nothing."""


def main(server: RunningServer, args: argparse.Namespace) -> int:
    import rospy
    from capabilities.msg import CapabilityEvent
    rospy.init_node('capabilities_watch', anonymous=True, disable_signals=True)
    events: queue.Queue[Any] = queue.Queue()    # what is printed is printed by this thread
    subscriber = rospy.Subscriber(server.name + '/events', CapabilityEvent, events.put)
    try:
        connected = time.monotonic()
        while time.monotonic() - connected < _PATIENCE:
            try:
                _print_event(_as_json(events.get(timeout=0.5)), args.json)
            except queue.Empty:
                pass
            if subscriber.get_num_connections():
                connected = time.monotonic()
    finally:
        rospy.signal_shutdown('watched enough')
    say('rocon_uri: capability server %s has gone' % server.name)
    return 0


def _as_json(event: Any) -> Dict[str, Any]:
    stamp = event.header.stamp.to_sec()
    return {'time': stamp or time.time(), 'event': event.type.strip('"'),
            'capability': event.capability, 'provider': event.provider, 'pid': event.pid}


def _print_event(event: Dict[str, Any], as_json: bool) -> None:
    if as_json:
        print(json.dumps(event), flush=True)
        return
    clock = time.strftime('%H:%M:%S', time.localtime(event['time']))
    kind = painter()('%-12s' % one_line(event['event']), _STYLES.get(event['event'], 'cyan'))
    what = '%s by %s, pid %d' % (one_line(event['capability']), one_line(event['provider']),
                                 event['pid']) if event['capability'] else ''
    print(('%s  %s  %s' % (clock, kind, what)).rstrip(), flush=True)
