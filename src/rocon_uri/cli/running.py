"""How the verbs ask a running capability server."""
from __future__ import annotations

import re

from rocon_uri.sources.wording import quoted

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from rocon_uri.cli.packages import PackageReport
    from typing import Any, Dict, List, Optional

__all__ = ['Refused', 'RunningServer', 'Unreachable', 'add_running', 'add_server',
           'capability_names', 'what_runs']

_RUNNING = ('launching', 'running', 'degraded')    # the states in which a capability can be used
_TIMEOUT = 1.5      # seconds to wait for the master, and for the server


class Unreachable(Exception):
    """ROS, the master or the server is missing; the text is one line."""


class Refused(Exception):
    """The server answered with an error; the text is that of the server."""


def add_server(parser: argparse.ArgumentParser) -> None:
    """Let a verb take ``--server``."""
    parser.add_argument('--server', metavar='NAME', default='capability_server',
                        help='the node name of the server (default: capability_server)')


def add_running(parser: argparse.ArgumentParser, help_text: str) -> None:
    """Let a verb ask a server if it is told to: ``--running``."""
    parser.add_argument('--running', action='store_true', help=help_text)
    add_server(parser)


def what_runs(args: argparse.Namespace, report: PackageReport) -> Optional[Dict[str, str]]:
    """
    What runs on the server, if ``--running`` was given.

    :param report: is told if the server does not answer
    :returns: the provider of each capability that runs; None without ``--running`` or an answer
    """
    if not args.running:
        return None
    try:
        return RunningServer(args.server).running()
    except (Unreachable, Refused) as error:
        report.bad(str(error))
        return None


def capability_names(parsed_args: argparse.Namespace, **others: object) -> List[str]:
    """What the shell offers for a CAPABILITY: the names that the server knows, if there is one."""
    try:
        server = RunningServer(parsed_args.server)
        return [*server.call('get_interfaces').interfaces,
                *server.call('get_semantic_interfaces', '').semantic_interfaces]
    except (Unreachable, Refused):
        return []


class RunningServer:
    """
    The services of one capability server.

    :param name: of its node; resolved in the namespace of this process
    :raises Unreachable: if it does not answer
    """

    def __init__(self, name: str) -> None:
        try:
            import rosgraph
            import rospy
            import capabilities.srv
        except ImportError as error:
            raise Unreachable('the capability server needs ROS, and %s is not there: '
                              'is a workspace sourced?' % error.name) from None
        self._rospy, self._types = rospy, capabilities.srv
        if not rosgraph.names.is_legal_name(name):
            raise Unreachable('%s is not the name of a node' % quoted(name))
        #: str: the node name, absolute
        self.name: str = rosgraph.names.script_resolve_name('rocon_uri', name)
        self._reach()

    def _reach(self) -> None:
        import socket
        import rosgraph
        from capabilities.service_discovery import server_names
        before = socket.getdefaulttimeout()
        socket.setdefaulttimeout(_TIMEOUT)      # requests to the master have no timeout
        try:
            servers = server_names('/rocon_uri')
        except (OSError, rosgraph.MasterException):
            raise Unreachable('no ROS master answers at %s' % rosgraph.get_master_uri()) from None
        finally:
            socket.setdefaulttimeout(before)
        if self.name not in servers:
            others = ', '.join(map(quoted, servers[:5]))
            raise Unreachable('no capability server %s%s' % (
                quoted(self.name), '; there is %s (--server)' % others if servers else
                ' runs: rosrun capabilities capability_server'))
        try:
            self._rospy.wait_for_service(self.name + '/start_capability', timeout=_TIMEOUT)
        except self._rospy.ROSException:
            raise Unreachable('capability server %s does not answer' % quoted(self.name)) from None

    def running(self) -> Dict[str, str]:
        """
        The provider of each capability that runs.

        :raises Unreachable: if the server does not answer any more
        """
        return {status.capability: status.provider
                for status in self.call('get_status').status.capabilities
                if status.state in _RUNNING}

    def call(self, service: str, *request: object) -> Any:
        """
        The response of one of its services.

        :param service: its name below that of the node
        :param request: the fields of the request, in order
        :raises Refused: if the server answers with an error
        :raises Unreachable: if the server does not answer any more
        """
        type_name = ''.join(word.capitalize() for word in service.split('_'))
        proxy = self._rospy.ServiceProxy('%s/%s' % (self.name, service),
                                         getattr(self._types, type_name))
        try:
            return proxy(*request)
        except self._rospy.ServiceException as error:
            text = _error_text(str(error))
            if text is None:
                raise Unreachable('capability server %s does not answer: %s' % (
                    quoted(self.name), error)) from None
            raise Refused(text) from None


def _error_text(text: str) -> 'str | None':
    """The text of a service's error, out of rospy's; None if the service sent none."""
    match = re.fullmatch(r'service \[.*?\] responded with an error: (?:b(?P<q>[\'"]))?'
                         r'(?:error processing request: )?(.*?)(?(q)(?P=q))', text, re.DOTALL)
    if match is None:
        return None
    said = match.group(2)
    if match.group('q'):        # the repr of bytes
        said = said.encode('latin-1', 'replace').decode('unicode_escape')
        said = said.encode('latin-1', 'replace').decode('utf-8', 'replace')
    return ' '.join(said.split())
