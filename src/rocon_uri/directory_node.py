"""
The node ``resource_directory``: it keeps the robots that announce themselves, and answers.

Announcements come on the topic ``resource_announcements``. One counts if the name in the handshake
of its connection is one that the master knows at the address of that connection: this keeps out who
only lies in the handshake. Who may talk to the master may take any name, as everywhere in ROS 1.
"""
from __future__ import annotations

import os
import sys
import threading
from typing import Callable, Dict, List, Optional, Tuple

import rosgraph
import rospy

from rocon_uri.announcement import Values
from rocon_uri.announcer import TOPIC, no_master, start_node
from rocon_uri.apps.runnable import App, platform_uri
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.msg import Announcement, AppRobots, ResourceChange, Resources
from rocon_uri.parts import FIELDS
from rocon_uri.resource_directory import Change, ResourceDirectory
from rocon_uri.sources.wording import NamesByPart, did_you_mean, quoted
from rocon_uri.srv import (
    ExplainResource, ExplainResourceRequest, ExplainResourceResponse, FindResources,
    FindResourcesRequest, FindResourcesResponse, FindRobots, FindRobotsRequest, FindRobotsResponse)
from rocon_uri.uri import RoconURI, parse
from rocon_uri.vocabulary import Vocabulary
from rocon_uri.workspace import Workspace, read_workspace

__all__ = ['DirectoryNode', 'main']

_PERIOD = 1.0       # seconds by which topics may lag
_ENDING = 5.0       # seconds that the end waits for the database


class DirectoryNode:
    """
    The directory of this node; ``rospy.init_node`` comes before.

    It answers until the node ends. With ``~database`` it shares that with the directories of other
    masters; ``~master``, else ``/run_id``, tells this master from the others.

    :raises ValueError: for a ``~database`` that is not a URL, or without a name of the master
    :raises NotImplementedError: for another database than PostgreSQL
    :raises OSError: if the database does not answer
    """

    def __init__(self) -> None:
        url = rospy.get_param('~database', '')
        self._changes = rospy.Publisher('~changes', ResourceChange, queue_size=10000)
        self._directory = ResourceDirectory(self._tell, rospy.logwarn) if not url \
            else self._shared(url)
        self._workspace: Optional[Workspace] = None
        self._lock = threading.Lock()
        #: the headers of connections by their ids, with the name that each may announce under
        self._connections: Dict[int, Tuple[Dict[str, str], Optional[str]]] = {}
        self._published: object = None      # the state of the list that was published last
        self._counted = 0, 0
        self._resources = rospy.Publisher('~resources', Resources, latch=True, queue_size=10)
        self._services = [
            rospy.Service('~find', FindResources, _answering(self._find)),
            rospy.Service('~explain', ExplainResource, _answering(self._explain)),
            rospy.Service('~find_robots', FindRobots, _answering(self._find_robots))]
        self._subscriber = rospy.Subscriber(TOPIC, Announcement, self._take, tcp_nodelay=True)

    def spin(self) -> bool:
        """
        Publish what changes until the node ends; what was announced last is stored then.

        :returns: bool, did it end because it was told to?
        """
        has_ended = threading.Event()
        work = threading.Thread(target=self._work, args=(has_ended,), daemon=True)
        work.start()
        while work.is_alive() and not rospy.is_shutdown():
            rospy.rostime.wallsleep(0.1)
        was_told = work.is_alive()
        has_ended.set()         # not by the handler of a signal, which might interrupt `wait`
        work.join(_ENDING)      # a database that does not answer keeps no node from ending
        return was_told

    def _work(self, has_ended: threading.Event) -> None:
        while not has_ended.is_set():
            self._directory.expire()
            self._directory.store()
            try:
                self._publish_resources()
            except OSError:         # the database is away, which was said
                pass
            self._say_counts()
            has_ended.wait(_PERIOD)
        self._directory.store()

    def _shared(self, url: str) -> ResourceDirectory:
        from rocon_uri.shared_directory import SharedDirectory      # it needs SQLAlchemy
        master = rospy.get_param('~master', '') or rospy.get_param('/run_id', '')
        if not master:
            raise ValueError('nothing tells this master from others, expected the parameter '
                             '/run_id, which roslaunch and roscore set, or ~master')
        return SharedDirectory(str(url), str(master), self._tell, rospy.logwarn)

    def _publish_resources(self) -> None:
        state = self._directory.state()
        if state != self._published:
            resources = Resources(uris=self._directory.uris())
            resources.header.stamp = rospy.Time.now()
            self._publish(self._resources, resources)
            self._published = state

    def _take(self, message: Announcement) -> None:
        """Take an announcement, in the thread of its connection."""
        announcer = self._announcer(message._connection_header)
        if announcer is not None:
            self._directory.announce(announcer, message.key, _values(message),
                                     message.lifetime.to_sec())

    def _announcer(self, header: Dict[str, str]) -> Optional[str]:
        """Who sends over a connection, None if it is not who it says."""
        known = self._connections.get(id(header))       # there as long as the header is
        if known is not None:
            if known[1] is None:
                self._refuse(header)
            return known[1]
        connections = self._subscriber.impl.connections
        address = next((connection.endpoint_id for connection in connections
                        if connection.header is header), None)
        try:
            is_known = rosgraph.Master(rospy.get_name()).lookupNode(header['callerid']) == address
        except rosgraph.MasterError:        # it knows no such node
            is_known = False
        except (KeyError, OSError):         # no name; or no answer: the next message asks again
            self._refuse(header)
            return None
        if address is None:     # the connection has ended
            return None
        announcer = header['callerid'] if is_known else None
        if announcer is None:
            self._refuse(header)
        with self._lock:
            there = {id(connection.header) for connection in connections}
            self._connections = {number: known for number, known in self._connections.items()
                                 if number in there}
            self._connections[id(header)] = header, announcer
        return announcer

    def _refuse(self, header: Dict[str, str]) -> None:
        self._directory.refuse(header.get('callerid', 'a node without a name'),
                               'the master does not know that name at the address it comes from')

    def _tell(self, change: Change) -> None:
        message = ResourceChange(
            what=change.what, uri=str(change.uri), announcer=change.announcer, key=change.key,
            before='' if change.before is None else str(change.before))
        message.header.stamp = rospy.Time.now()
        self._publish(self._changes, message)

    @staticmethod
    def _publish(publisher: rospy.Publisher, message: object) -> None:
        try:
            publisher.publish(message)
        except rospy.ROSException:      # the node is ending
            pass

    def _say_counts(self) -> None:
        counted = self._directory.refused, len(self._directory.unregistered())
        if counted != self._counted:
            self._counted = counted
            rospy.loginfo('announcements refused so far: %d; resources that have a value which is '
                          'not registered: %d', *counted)

    def _find(self, request: FindResourcesRequest) -> FindResourcesResponse:
        return FindResourcesResponse(self._directory.find(request.request))

    def _explain(self, request: ExplainResourceRequest) -> ExplainResourceResponse:
        explanation = self._directory.explain(request.request, request.uri)
        return ExplainResourceResponse(bool(explanation), str(explanation))

    def _find_robots(self, request: FindRobotsRequest) -> FindRobotsResponse:
        with self._lock:
            if self._workspace is None:     # reading all packages takes its time
                folders = os.environ.get('ROS_PACKAGE_PATH', '').split(os.pathsep)
                self._workspace = read_workspace(filter(os.path.isdir, folders))
        apps = [app for app in self._workspace.apps() if request.app in ('', app.name)]
        if request.app and not apps:
            known = NamesByPart(app.name for app in self._workspace.apps())
            raise ValueError('app %s is not known%s' % (
                quoted(request.app), did_you_mean(known.near_misses(request.app))))
        return FindRobotsResponse([AppRobots(app.name, self._robots_of(app, self._workspace))
                                   for app in apps])

    def _robots_of(self, app: App, workspace: Workspace) -> List[str]:
        platform = platform_uri(app, workspace.vocabulary) or _platform_as_text(app)
        return [] if platform is None else self._directory.find(platform)


def _platform_as_text(app: App) -> Optional[RoconURI]:
    """The platform of an app of app_manager that is not registered; robots may have it anyway."""
    try:
        return parse('rocon:/%s' % app.platform, Vocabulary.open())     # type: ignore[union-attr]
    except (AttributeError, RoconURIValueError):        # of a rapp; not a base name
        return None


def _values(message: Announcement) -> Values:
    return tuple(value if isinstance(value, str) else tuple(value) or ('*',)
                 for value in [getattr(message.uri, field) for field in FIELDS])


def _answering(handler: Callable[..., object]) -> Callable[..., object]:
    """A handler whose errors are those of the service, in one line."""
    def answer(request: object) -> object:
        try:
            return handler(request)
        except (ValueError, OSError) as error:
            raise rospy.ServiceException(' '.join(str(error).split())) from None
    return answer


def main() -> int:
    """The node ``resource_directory``; returns its exit status."""
    arguments = rospy.myargv(sys.argv)[1:]
    if arguments:
        print('resource_directory: argument %s is not expected: it takes remappings only'
              % quoted(arguments[0]), file=sys.stderr)
        return 2
    try:
        start_node('resource_directory')
        node = DirectoryNode()
    except (ImportError, NotImplementedError, OSError, ValueError) as error:
        print('resource_directory: %s' % ' '.join(str(error).split()), file=sys.stderr)
        return 2
    except (rospy.ROSInitException, KeyboardInterrupt):
        print('resource_directory: %s' % no_master(), file=sys.stderr)
        return 2
    return 0 if node.spin() else 1
