"""
The capability server: starts what a robot can do for whoever needs it.

This is its node. Requests go to `capabilities.runtime`, which decides and starts processes; its
events go out as messages. Incoming messages on ``~events`` or ``~status`` have no effect: nobody
can pretend that something has ended.
"""
from __future__ import annotations

import argparse
import logging
import os
import signal
import socket
import sys
from typing import List, Optional, Sequence

import capabilities.needs_ros  # noqa: F401
import rosgraph
import rospy

from capabilities import lossy_output
from capabilities.bonds import Bonds
from capabilities.catalogue import Catalogue, catalogue_of, load_specs, read_catalogue
from capabilities.instances import (
    USER_SERVICE_REASON, CapabilityInstance, get_reverse_depends)
from capabilities.launch_manager import LaunchManager
from capabilities.leftovers import end_leftovers
from capabilities.parameters import InvalidConfiguration, read_parameters
from capabilities.processes import ServerRun
from capabilities.publications import Publications
from capabilities.runtime import Runtime
from capabilities.service_discovery import server_names
from capabilities.services import Services
from capabilities.spec_index import SpecIndex

__all__ = ['USER_SERVICE_REASON', 'CapabilityInstance', 'CapabilityServer', 'create_parser',
           'get_reverse_depends', 'main']

_BAD_CONFIGURATION = 255

_logger = logging.getLogger('rosout.capabilities')


class CapabilityServer:
    """
    The server of this node, which `spin` runs; ``rospy.init_node`` comes before.

    :param package_paths: list of str, the folders in which packages are looked for
    :param screen: bool, is the output of all nodes shown? None: as ``~use_screen`` says
    :raises InvalidConfiguration: if a parameter is not valid
    """

    def __init__(self, package_paths: Sequence[str], screen: Optional[bool] = None) -> None:
        self.__package_paths = list(package_paths)
        self.__parameters = read_parameters(rospy.get_param, bool(screen))
        if self.__parameters.debug:
            logging.getLogger('rosout').setLevel(logging.DEBUG)
        self.__name = rospy.get_name()
        self.__spec_index = SpecIndex()
        self.__catalogue: Optional[Catalogue] = None
        self.__runtime: Optional[Runtime] = None
        self.__bonds: Optional[Bonds] = None
        self.__publications = Publications(self.__name, self.must_end)
        self.__exit_status: Optional[int] = None
        self.__has_started = False      # is there anything to end?
        self.__has_ended = False
        # A signal handler may write to a pipe; it must not touch what the main thread may hold.
        self.__wake_up_read, self.__wake_up = os.pipe()
        os.set_blocking(self.__wake_up, False)

    def spin(self) -> int:
        """
        Serve until the node is told to end, then end all that was started.

        :returns: int, the exit status: 0; 1 if the nodelet manager was lost
        :raises SystemExit: with status 255, if a default provider is at fault
        """
        rospy.on_shutdown(lambda: self.must_end(0))
        try:
            self.__load_capabilities()
            self.__populate_default_providers()
            self.__serve()
        finally:
            self.shutdown()
        return self.__exit_status or 0

    def handle_signals(self) -> None:
        """Have `spin` end on SIGINT and SIGTERM."""
        # The system may hand a signal to any thread. Without this Python would not call the handler
        # before the main thread wakes up.
        signal.set_wakeup_fd(self.__wake_up, warn_on_full_buffer=False)
        for number in signal.SIGINT, signal.SIGTERM:
            signal.signal(number, self.__handle_signal)

    def __handle_signal(self, number: int, frame: object) -> None:
        """Have `spin` end; at once (by SystemExit) as long as nothing was started."""
        self.must_end(0)
        if not self.__has_started:
            raise SystemExit(0)     # rospy has places where it is lost: `__serve` looks again

    def must_end(self, exit_status: int) -> None:
        """Have `spin` end, and return at once; for signal handlers too."""
        if self.__exit_status is None:
            self.__exit_status = exit_status
        try:
            os.write(self.__wake_up, b'.')
        except BlockingIOError:
            pass        # it has been written often enough

    def shutdown(self) -> None:
        """End all that was started, and wait for that."""
        if self.__has_ended:
            return
        if self.__runtime is not None:
            self.__runtime.end()
        if self.__bonds is not None:
            self.__bonds.end()
        self.__publications.close()
        self.__has_ended = True

    def handle_capability_events(self, event: object) -> None:
        """Do nothing: the server takes no knowledge from messages."""

    # how it serves

    def __load_capabilities(self) -> None:
        """Read the specs that are exported and not filtered out."""
        self.__spec_index = load_specs(self.__package_paths, self.__parameters)

    def __populate_default_providers(self) -> None:
        """Find the default providers; SystemExit if one cannot be one."""
        try:
            self.__catalogue = catalogue_of(self.__spec_index, self.__parameters)
        except InvalidConfiguration as error:
            _log_faults(error)
            raise SystemExit(_BAD_CONFIGURATION) from None

    def __stop_capability(self, name: str) -> None:
        """Stop a capability; what is wrong is only logged."""
        try:
            if self.__runtime is None:
                raise RuntimeError("No Capability '%s' running" % name)
            self.__runtime.stop(name)
        except RuntimeError as error:
            _logger.error('%s', error)

    def __serve(self) -> None:
        parameters = self.__parameters
        publications = self.__publications
        assert self.__catalogue is not None
        runtime = self.__runtime = Runtime(
            publications, self.__catalogue, parameters.keep_dependents,
            parameters.ends_without_nodelet_manager)
        self.__bonds = Bonds(rospy.resolve_name('~bonds'), runtime.bond_broken, publications.later)
        services = Services(runtime, self.__bonds, publications.status_message, self.__reload)
        services.advertise_status()
        publications.status([])
        _warn_of_other_servers(self.__name)
        run = ServerRun.new(self.__name, rosgraph.get_master_uri())
        end_leftovers(run, _logger.warning)
        if self.__exit_status is not None:
            return
        self.__has_started = True
        runtime.manager = LaunchManager(
            screen=parameters.use_screen, nodelet_manager_name=parameters.nodelet_manager_name,
            listener=runtime, run=run, nodelet_manager=parameters.nodelet_manager)
        services.advertise()
        publications.ready()
        _logger.info('capability server ready')
        if self.__exit_status is None:
            runtime.autostart(parameters.autostart)
        while self.__exit_status is None:
            os.read(self.__wake_up_read, 1)

    def __reload(self) -> Catalogue:
        return read_catalogue(self.__package_paths, self.__parameters)


def _warn_of_other_servers(name: str) -> None:
    """Warn of servers of other names at this master: neither knows what the other starts."""
    try:
        servers = server_names(name)
    except (OSError, rosgraph.MasterException):
        return
    for server in servers:
        if server != name:
            _logger.warning('there is another capability server, %s; neither knows what the other '
                            'starts', server)


def _log_faults(error: InvalidConfiguration) -> None:
    for line in error.lines:
        _logger.error('%s', line)


def create_parser() -> argparse.ArgumentParser:
    """
    The command line of the node.

    :returns: ``argparse.ArgumentParser``
    """
    parser = argparse.ArgumentParser(
        prog='capability_server', description='Starts the capabilities of a robot for the '
        'clients that need them.')
    parser.add_argument('package_path', nargs='?',
                        help='folders in which packages with capabilities are looked for, '
                             'separated by colons (default: ROS_PACKAGE_PATH)')
    parser.add_argument('-s', '--screen', action='store_true',
                        help='show the output of all nodes that are started')
    return parser


def main(sysargv: Optional[List[str]] = None) -> int:
    """
    Run the node.

    :param sysargv: list of str, the arguments without the name of the program; None for those of
        this process. ROS remappings among them are left out.
    :returns: int, the exit status
    :raises SystemExit: with a text, if no package paths are given; with status 255 if the
        configuration is at fault
    """
    told_to_end: List[int] = []

    def leave(number: int, frame: object) -> None:
        """End at once, while nothing has been started."""
        told_to_end.append(number)
        raise SystemExit(0)     # rospy has places where it is lost: it is looked at again below

    signal.signal(signal.SIGINT, leave)         # where it was inherited as ignored, too
    signal.signal(signal.SIGTERM, leave)
    arguments = create_parser().parse_args(
        rospy.myargv(sys.argv if sysargv is None else [sys.argv[0], *sysargv])[1:])
    package_path = arguments.package_path or os.environ.get('ROS_PACKAGE_PATH', '')
    package_paths = [path for path in package_path.split(os.pathsep) if path]
    if not package_paths:
        raise SystemExit('No package paths specified: give them as an argument, or set '
                         'ROS_PACKAGE_PATH.')
    if arguments.package_path:      # so that what is started finds those packages too
        known = os.environ.get('ROS_PACKAGE_PATH')
        os.environ['ROS_PACKAGE_PATH'] = os.pathsep.join(
            ([known] if known else []) + package_paths)
    lossy_output.install()
    rospy.init_node('capability_server', disable_signals=True)
    _accept_many()
    try:
        server = CapabilityServer(package_paths, screen=arguments.screen)
    except InvalidConfiguration as error:
        _log_faults(error)
        return _finish(_BAD_CONFIGURATION)
    server.handle_signals()
    if told_to_end:
        return _finish(0)
    try:
        status = server.spin()
    except SystemExit as end:
        status = int(end.code or 0)
    return _finish(status)


def _accept_many() -> None:
    """
    Let as many connections wait as the system allows; rospy allows five.

    The system drops the sixth, and that client tries again only after 1, 3 and 7 seconds.
    """
    try:
        rospy.impl.tcpros_base.init_tcpros_server().tcp_ros_server.server_sock.listen(socket.SOMAXCONN)
    except (AttributeError, OSError):       # another version of rospy: leave it
        pass


def _finish(status: int) -> int:
    """End the node, and the process even if a thread of the libraries hangs."""
    rospy.signal_shutdown('the capability server has ended')
    logging.shutdown()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)
