"""
The launch manager: starts the launch files of capability providers, and ends them.

Each launch file runs in a process of its own (`capabilities.launch`), and so does the nodelet
manager. For a provider without a launch file, a placeholder runs that does nothing. A listener is
told what happens; nothing is published here, and rospy is not needed.
"""
import itertools
import logging
import os
import shutil
import threading
import time
from typing import TYPE_CHECKING, Callable, Dict, List, Optional

from capabilities.launch import Launch, Report
from capabilities.leftovers import Watcher
from capabilities.nodelet_manager import (
    ARGUMENT, LAUNCH_FILE, is_installed, manager_name, server_name)
from capabilities.processes import Marked, ServerRun, end_marked

if TYPE_CHECKING:
    from capabilities.listeners import LaunchListener
    from capabilities.specs.provider import CapabilityProvider

__all__ = ['LaunchManager', 'which']

_special_nodelet_manager_capability = '!!nodelet_manager'   # its name in events
_INTERRUPT_SECONDS = 5.0    # at the end of the server: from SIGINT to SIGTERM
_TERMINATE_SECONDS = 2.0    # from SIGTERM to SIGKILL
_LOG = logging.getLogger('rosout')      # rospy's own once a node is initialised


def which(program: str) -> Optional[str]:
    """
    The path of an executable; None if there is none.

    :param program: its name, looked for on the PATH, or its path

    >>> which('no_such_program') is None
    True
    """
    return shutil.which(program)


class LaunchManager:
    """
    Starts launch files, knows them by the id of their process, and ends them.

    :param quiet: read the output of the launch files and write it to stdout; by default they write
        to the stdout of this process themselves
    :param screen: show the output of all nodes
    :param nodelet_manager_name: the base name of the nodelet manager; by default the name of this
        node and ``_nodelet_manager``
    :param listener: is told what happens, in the threads of the launches
    :param run: marks all processes, and has a watcher end them if this process dies; None does
        neither
    :param nodelet_manager: False starts no nodelet manager
    :raises OSError: if a process cannot be started

    >>> manager = LaunchManager(nodelet_manager=False)
    >>> manager.nodelet_manager_name
    '/capability_server_nodelet_manager'
    >>> manager.stop()
    """

    def __init__(self, quiet: bool = False, screen: bool = False,
                 nodelet_manager_name: Optional[str] = None, *,
                 listener: 'Optional[LaunchListener]' = None, run: Optional[ServerRun] = None,
                 nodelet_manager: bool = True) -> None:
        self.__quiet = quiet
        self.__screen = screen
        self.__listener = listener
        self.__run = run
        self.__lock = threading.Lock()      # held while a process is created, not to wait for one
        self.__launches: Dict[int, Launch] = {}
        self.__ids = itertools.count(1)
        self.__stopping = False
        self.__interrupted: Optional[float] = None      # when the end began, by the monotonic clock
        self.__namespace, _ = server_name()
        self.__manager_name = manager_name(nodelet_manager_name)
        self.__manager_pid: Optional[int] = None
        self.__has_manager = nodelet_manager and is_installed()
        self.__watcher = Watcher(run) if run is not None else None
        self.start_nodelet_manager()

    @property
    def nodelet_manager_name(self) -> str:
        """The name of the nodelet manager with its namespace, even if none is started."""
        return self.__manager_name

    @property
    def has_nodelet_manager(self) -> bool:
        """Is a nodelet manager wanted, and package nodelet installed?"""
        return self.__has_manager

    @property
    def nodelet_manager_pid(self) -> Optional[int]:
        """The id of the process of the nodelet manager; None where it does not run."""
        return self.__manager_pid

    @property
    def stopping(self) -> bool:
        """Has the end begun? Nothing is started any more then."""
        return self.__stopping

    def run_capability_provider(self, provider: 'CapabilityProvider', provider_path: str,
                                on_pid: Optional[Callable[[int], None]] = None) -> int:
        """
        Start the launch file of a provider, or the placeholder.

        :param provider_path: the path of the file of the spec
        :param on_pid: called with the id before the listener is told anything about it
        :returns: the id of the process
        :raises RuntimeError: if the launch file runs already, if it cannot be started, or if the
            end has begun
        """
        launch_file = None
        if provider.launch_file is None:
            _LOG.info("provider '%s' has no launch file, so a placeholder runs in its place",
                      provider.name)
        else:
            launch_file = os.path.join(os.path.dirname(provider_path), provider.launch_file)
        return self.run_launch_file(launch_file, provider, on_pid=on_pid)

    def run_launch_file(self, launch_file: Optional[str], provider: 'CapabilityProvider',
                        manager: bool = False,
                        on_pid: Optional[Callable[[int], None]] = None) -> int:
        """
        Start a launch file, as `run_capability_provider` does.

        :param launch_file: its path; None runs the placeholder
        :param manager: is it that of the nodelet manager?
        """
        return self.__start(launch_file, manager, on_pid)

    def start_nodelet_manager(self) -> Optional[int]:
        """
        Start the nodelet manager, unless it runs or is not wanted.

        :returns: the id of its process; None if it is not wanted
        :raises RuntimeError: if it cannot be started, or if the end has begun
        """
        if self.__has_manager and self.__manager_pid is None:
            self.__start(LAUNCH_FILE, True, None)
        return self.__manager_pid

    def begin_stop(self, pid: int) -> None:
        """
        Ask a launch to stop; the listener is told when it has stopped.

        Its nodes get the time that roslaunch gives them. Leftovers are killed 5 s after that.

        :raises RuntimeError: if there is no such launch
        """
        self.__launch(pid).begin_stop()

    def stop_capability_provider(self, pid: int) -> None:
        """Do what `begin_stop` does, and wait until the launch has ended."""
        self.__stop_by_pid(pid)

    def __stop_by_pid(self, pid: int) -> None:
        launch = self.__launch(pid)
        launch.begin_stop()
        launch.join()

    def stop(self) -> None:
        """Stop all launches at once, the nodelet manager after them, and wait for that."""
        with self.__lock:
            self.__stopping = True
            manager_pid = self.__manager_pid
            launches = dict(self.__launches)
        manager = launches.pop(manager_pid, None) if manager_pid is not None else None
        _stop_all(list(launches.values()))
        _stop_all([manager] if manager is not None else [])
        if self.__watcher is not None:
            self.__watcher.close()

    def begin_end(self) -> None:
        """Begin what `end` does, and return at once: nothing starts any more, SIGINT is sent."""
        with self.__lock:
            if self.__interrupted is not None:
                return
            self.__stopping = True
            self.__interrupted = time.monotonic()
            launches = list(self.__launches.values())
        for launch in launches:
            launch.interrupt()

    def end(self) -> None:
        """
        End everything at once, with the short times of the end of the server, and wait for that.

        SIGINT goes to each roslaunch, which passes it on; after 5 s SIGTERM to all processes of
        this run, after 7 s SIGKILL until nothing is found. Without a mark this is `stop`.
        """
        run = self.__run
        if run is None:
            self.stop()
            return
        self.begin_end()
        assert self.__interrupted is not None
        deadline = self.__interrupted + _INTERRUPT_SECONDS
        with self.__lock:
            launches = list(self.__launches.values())
        for launch in launches:
            launch.join(max(0.0, deadline - time.monotonic()))

        def is_of_run(process: Marked) -> bool:
            return (process.server, process.run) == run

        end_marked(is_of_run, interrupt=None, terminate=_TERMINATE_SECONDS)
        for launch in launches:
            launch.join(1.0)
        if self.__watcher is not None:
            self.__watcher.close()

    def handle_capability_events(self, msg: object) -> None:
        """Do nothing: the end of a launch is known from its process, not from messages."""

    def __monitor_process(self, pid: int) -> None:
        """Wait until a launch has ended; its own thread tells of it."""
        with self.__lock:
            launch = self.__launches.get(pid)
        if launch is None:
            raise RuntimeError("Unknown process id '%s'" % pid)
        launch.join()

    def __launch(self, pid: int) -> Launch:
        with self.__lock:
            if pid not in self.__launches:
                raise RuntimeError("No running launch file with PID of '%s'" % pid)
            return self.__launches[pid]

    def __start(self, file: Optional[str], manager: bool,
                on_pid: Optional[Callable[[int], None]]) -> int:
        """Start a launch file or the placeholder, and have it watched."""
        namespace, _, base_name = self.__manager_name.rpartition('/')
        environment = dict(os.environ, ROS_NAMESPACE=namespace if manager else self.__namespace)
        argument = '%s:=%s' % (ARGUMENT, base_name if manager else self.__manager_name)
        real_path = None if file is None else os.path.realpath(file)
        with self.__lock:
            if self.__stopping:
                raise RuntimeError('the capability server ends')
            if real_path is not None and any(real_path == launch.real_path
                                             for launch in self.__launches.values()):
                raise RuntimeError("Launch file at '%s' is already running." % file)
            try:
                launch = Launch(file, [argument], screen=self.__screen, quiet=self.__quiet,
                                environment=environment, run=self.__run, name=str(next(self.__ids)))
            except OSError as error:
                raise RuntimeError("cannot start '%s': %s" % (
                    file or 'the placeholder', error.strerror or error)) from None
            pid = launch.pid
            self.__launches[pid] = launch
            if manager:
                self.__manager_pid = pid
        if on_pid is not None:
            on_pid(pid)
        launch.watch(lambda report: self.__reported(pid, report),
                     lambda exit_code, text: self.__ended(pid, exit_code, text))
        return pid

    def __reported(self, pid: int, report: Report) -> None:
        if self.__listener is not None:
            self.__listener.launch_reported(pid, report)

    def __ended(self, pid: int, exit_code: int, text: str) -> None:
        with self.__lock:
            launch = self.__launches.pop(pid)
            is_manager = pid == self.__manager_pid
            if is_manager:
                self.__manager_pid = None
        if is_manager and not self.__stopping and not launch.stopping:
            _LOG.error("Capability server's nodelet manager terminated unexpectedly.")
        if self.__listener is not None:
            (self.__listener.nodelet_manager_ended if is_manager
             else self.__listener.launch_ended)(pid, exit_code, text)


def _stop_all(launches: List[Launch]) -> None:
    """Stop launches at once, and wait for their end."""
    for launch in launches:
        launch.begin_stop()
    for launch in launches:
        launch.join()
