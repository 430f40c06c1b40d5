"""
A robot's end of the resource directory: it announces itself, and says goodbye when it ends.

``rosrun rocon_uri announce`` is the node; a node of one's own has an `Announcer`.
"""
from __future__ import annotations

import argparse
import signal
import sys
import threading
import time
from typing import Optional, Union

import rosgraph
import rospy

from capabilities import lossy_output
from rocon_uri.announcement import check_key, check_lifetime
from rocon_uri.exceptions import UnregisteredValue
from rocon_uri.messages import to_msg
from rocon_uri.msg import Announcement
from rocon_uri.platform import (
    default_robot_name, default_robot_type, generate_platform_rocon_uri)
from rocon_uri.uri import RoconURI, parse
from rocon_uri.vocabulary import Vocabulary

__all__ = ['TOPIC', 'Announcer', 'main']

#: where announcements are sent; relative, so that it can be remapped
TOPIC = 'resource_announcements'

_SENDING = 1.0      # seconds that the end of a robot waits for its goodbye to be sent


class Announcer:
    """
    Announces a resource until it is told to end; ``rospy.init_node`` comes before.

    It ends with the node, too. In a ``with`` statement it ends with the block::

        rospy.init_node('bob')
        Announcer('rocon:/turtlebot2/bob/noetic/focal')

    :param uri: str or RoconURI, the resource, which may have values that are not registered; None
        for this machine's, as ``rocon_uri platform`` shows it
    :param float period: seconds between announcements
    :param float lifetime: seconds until the resource is gone if it falls silent; None for three
        periods
    :param str key: which of the node's resources it is, at most 255 characters; '' if it has one
    :raises RoconURIValueError: for a text that is not legal
    :raises ValueError: for a period that is not greater than 0, a lifetime under twice the period
        or one that the directory refuses, and for a key that is too long
    """

    def __init__(self, uri: Union[str, RoconURI, None] = None, period: float = 5.0,
                 lifetime: Optional[float] = None, key: str = '') -> None:
        lifetime = 3 * period if lifetime is None else lifetime
        if not period > 0:
            raise ValueError('period %g s is not greater than 0' % period)
        if not lifetime >= 2 * period:
            raise ValueError('lifetime %g s is not at least twice the period of %g s: one lost '
                             'announcement would end the resource' % (lifetime, period))
        check_lifetime(lifetime)
        check_key(key)
        self._period = period
        self._message = Announcement(uri=to_msg(_read(uri)), key=key,
                                     lifetime=rospy.Duration.from_sec(lifetime))
        self._publisher = rospy.Publisher(TOPIC, Announcement, latch=True, queue_size=1000)
        self._has_ended = threading.Event()
        self._lock = threading.RLock()      # the handler of a signal may end it at any time
        self._thread = threading.Thread(target=self._announce, daemon=True)
        self._thread.start()
        rospy.on_shutdown(self.end)

    def change(self, uri: Union[str, RoconURI]) -> None:
        """
        Announce another URI from now on, at once.

        :param uri: str or RoconURI, as above
        :raises RoconURIValueError: for a text that is not legal
        """
        message = to_msg(_read(uri))
        with self._lock:
            self._message.uri = message
            self._publish()

    def end(self) -> None:
        """Say goodbye, unless that was done; it takes at most a second."""
        with self._lock:
            if self._has_ended.is_set():
                return
            self._has_ended.set()
            self._message.lifetime = rospy.Duration(0)
            self._publisher.publish(self._message)
        deadline = time.monotonic() + _SENDING
        while self._is_sending() and time.monotonic() < deadline:
            time.sleep(0.01)
        time.sleep(0.05)    # in which rospy's thread writes what it has taken from its queue

    def __enter__(self) -> Announcer:
        return self

    def __exit__(self, *error: object) -> None:
        self.end()

    def _announce(self) -> None:
        while True:
            with self._lock:
                if self._has_ended.is_set():
                    return
                self._publish()
            self._has_ended.wait(self._period)

    def _publish(self) -> None:
        try:
            if not self._has_ended.is_set():
                self._publisher.publish(self._message)
        except rospy.ROSException:      # the node is ending
            pass

    def _is_sending(self) -> bool:
        implementation = self._publisher.impl
        return implementation is not None and any(
            getattr(connection, '_queue', None) for connection in implementation.connections)


def _read(uri: Union[str, RoconURI, None]) -> RoconURI:
    if uri is None:
        uri = generate_platform_rocon_uri(default_robot_type, default_robot_name())
    return parse(uri, Vocabulary.open()) if isinstance(uri, str) else uri


def start_node(name: str) -> None:
    """
    As ``rospy.init_node``; a signal ends the node, and its lines are in a file at once.

    :param str name: of the node
    :raises KeyboardInterrupt: if it is told to end meanwhile; like rospy.ROSInitException
    """
    lossy_output.install()
    for number in signal.SIGINT, signal.SIGTERM:
        # Until rospy has handlers of its own. That of Ubuntu 20.04 itself calls this one from
        # them, and would fail if it were SIG_DFL.
        signal.signal(number, signal.default_int_handler)
    rospy.init_node(name)


def no_master() -> str:
    """What a node says that was told to end while it waited for the master."""
    return 'ended before a ROS master answered at %s' % rosgraph.get_master_uri()


def main() -> int:
    """The node ``announce``; returns its exit status."""
    parser = argparse.ArgumentParser(
        prog='announce', description='Announce a robot to the resource directory of its master, '
        'and say goodbye when it ends.', epilog='The name of the node says who it is: give each '
        'robot of a master another one (__name:=announce_bob), since a node ends an earlier one of '
        'its name. Exit status: 0; 2 for arguments that are wrong, or if no master ever answered.')
    parser.add_argument('uri', nargs='?', help='the robot (default: what rocon_uri platform shows)')
    parser.add_argument('--period', type=float, default=5.0, metavar='SECONDS',
                        help='between announcements (default: 5)')
    parser.add_argument('--lifetime', type=float, metavar='SECONDS',
                        help='until it is gone if it falls silent, at least twice the period '
                        '(default: 3 periods)')
    parser.add_argument('--key', default='', help='which of the robots of the node it is')
    arguments = parser.parse_args(rospy.myargv(sys.argv)[1:])
    try:
        if arguments.uri is not None:
            _warn_of_unregistered(arguments.uri)
        start_node('announce')
        Announcer(arguments.uri, arguments.period, arguments.lifetime, arguments.key)
    except ValueError as error:
        print('announce: %s' % error, file=sys.stderr)
        return 2
    except (rospy.ROSInitException, KeyboardInterrupt):
        print('announce: %s' % no_master(), file=sys.stderr)
        return 2
    rospy.spin()
    return 0


def _warn_of_unregistered(uri: str) -> None:
    try:
        parse(uri)
    except UnregisteredValue as error:
        print('announce: warning: %s' % error, file=sys.stderr)
