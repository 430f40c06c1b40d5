"""
Run a launch file, and report what happens to its nodes.

roslaunch's own command reports neither that a node died nor its exit code. This script uses its
`ROSLaunchParent`, and is run by its path with the launch file as its argument. Its
standard input holds a JSON object: ``arguments`` for the launch file, ``screen``, and the file
descriptor ``reports``, to which it writes a JSON object a line: see `capabilities.launch.Report`.
Its exit code is that of the last node that ended with another than 0.
"""
import os
import signal
import sys
from types import FrameType
from typing import Any, Optional

_nodes_exist = False        # from here on a signal has to stop them first
_stopped = False


def _on_signal(number: int, frame: Optional[FrameType]) -> None:
    global _stopped
    if not _nodes_exist:
        os._exit(128 + number)
    _stopped = True


if __name__ == '__main__':      # before the imports below, which take half a second
    for _number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(_number, _on_signal)
    if sys.path[0] == os.path.dirname(os.path.abspath(__file__)):
        import lossy_output     # type: ignore[import-not-found]
        lossy_output.install()
        del sys.path[0]         # no other module beside this one is meant by ``import client``

import json                     # noqa: E402
import logging                  # noqa: E402
import time                     # noqa: E402

import rosgraph                 # noqa: E402
import roslaunch                # noqa: E402
import roslaunch.core           # noqa: E402
import roslaunch.launch         # noqa: E402
import roslaunch.parent         # noqa: E402
import roslaunch.pmon           # noqa: E402
import roslib                   # noqa: E402
from roslaunch.core import RLException      # noqa: E402

_POLL = 0.1                 # seconds between two looks at the nodes, as in roslaunch itself
_COUNT_POLL = 0.5           # seconds between two looks at how often they were restarted


class _Reports(roslaunch.pmon.ProcessListener):     # type: ignore[misc]
    """Writes the reports; the process monitor tells it which processes died."""

    def __init__(self, descriptor: int) -> None:
        self._stream = os.fdopen(descriptor, 'w', encoding='utf-8')
        self._dead = set()          # type: set[str]
        self._counts = {}           # type: dict[str, int]
        self.started = []           # type: list[str]
        self.monitor: Any = None    # roslaunch's process monitor
        self.exit_code = 0          # of the node that ended last with another than 0

    def send(self, kind: str, **fields: object) -> None:
        """Write a report; the server may have gone."""
        try:
            self._stream.write(json.dumps(dict(fields, kind=kind)) + '\n')
            self._stream.flush()
        except OSError:
            pass

    def process_died(self, process_name: str, exit_code: Optional[int]) -> None:
        """Called at every poll while a node waits for its respawn, so that is counted elsewhere."""
        process = self.monitor.get_process(process_name)
        if process_name in self._dead or process is not None and process.respawn:
            return
        self._dead.add(process_name)
        if exit_code is None:
            self.send('died', node=_node_name(process_name), exit_code=-1, how='how is not known')
            return
        code = exit_code if exit_code >= 0 else 128 - exit_code
        self.exit_code = code or self.exit_code
        self.send('died', node=_node_name(process_name), exit_code=code, how=(
            'exit %d' % exit_code if exit_code >= 0 else 'signal %d' % -exit_code))

    def send_restarts(self) -> None:
        """Report which nodes were restarted since the last call."""
        for processes in self.monitor.get_process_names_with_spawn_count():
            for name, spawned in processes:
                if spawned > self._counts.setdefault(name, 1):
                    self._counts[name] = spawned
                    self.send('restarted', node=_node_name(name), times=spawned - 1)


class _Runner(roslaunch.launch.ROSLaunchRunner):    # type: ignore[misc]
    """roslaunch's runner, which starts no master, and no node after a signal."""

    reports: _Reports

    def _launch_master(self) -> Any:
        if not self.config.master.is_running():
            raise RLException('cannot contact the master at %s' % self.config.master.uri)
        return super()._launch_master()

    def _check_and_set_run_id(self, param_server: Any, run_id: str) -> None:
        """Take the id that another start has set in the meantime."""
        for _ in range(3):
            code, _, value = param_server.getParam('/roslaunch', '/run_id')
            if code == 1:
                self.run_id = value
            try:
                super()._check_and_set_run_id(param_server, self.run_id)
                return
            except RLException:
                pass
        super()._check_and_set_run_id(param_server, self.run_id)

    def launch_node(self, node: Any, core: bool = False) -> Any:
        global _nodes_exist
        if _stopped:
            return str(node.name), False
        _nodes_exist = True
        name = rosgraph.names.ns_join(node.namespace, node.name or node.type)
        try:
            process, started = super().launch_node(node, core)
        except roslaunch.pmon.FatalProcessLaunch:
            self.reports.send('missing', node=name)
            raise
        if isinstance(process, str):        # there is no executable for it
            self.reports.send('missing', node=name)
        elif not core:
            self.reports.started.append(name)
        return process, started


class _Parent(roslaunch.parent.ROSLaunchParent):    # type: ignore[misc]
    """roslaunch's parent, with a listener that is told of each node."""

    reports: _Reports

    def _start_pm(self) -> None:
        # Here and not by process_listeners=: that adds it when all nodes were launched, and
        # those that died at once would be missed.
        super()._start_pm()
        self.reports.monitor = self.pm
        self.pm.add_process_listener(self.reports)

    def _start_server(self) -> None:
        super()._start_server()
        self.server.add_process_listener(self.reports)      # for nodes on other machines

    def _init_runner(self) -> None:
        print(self.config.summary(local=self.remote_runner is None))
        for error in self.config.config_errors:
            roslaunch.core.printerrlog('WARNING: %s' % error)
        self.runner = _Runner(self.run_id, self.config, server_uri=self.server.uri, pmon=self.pm,
                              remote_runner=self.remote_runner)
        self.runner.reports = self.reports


def _node_name(process_name: str) -> str:
    """The name of a node from that of its process, which ends in a number."""
    return '/' + process_name.rpartition('-')[0].lstrip('/')


def _run_id() -> str:
    """The run id, which all roslaunch processes of one master share."""
    try:
        return str(rosgraph.Master('/roslaunch').getParam('/run_id'))
    except rosgraph.MasterException:        # nobody has set it
        return str(roslaunch.core.generate_run_id())
    except Exception as error:
        raise RLException('cannot contact the master at %s: %s' % (
            rosgraph.get_master_uri(), error)) from None


def _run(parent: _Parent, reports: _Reports) -> None:
    """Start the nodes and wait for their end, or for a signal."""
    parent.start()
    reports.send('started', nodes=reports.started)
    counted = time.monotonic()
    while not parent.pm.done:
        if _stopped or not parent.pm.get_active_names():
            parent.pm.shutdown()
        if time.monotonic() - counted >= _COUNT_POLL:
            counted = time.monotonic()
            reports.send_restarts()
        time.sleep(_POLL)


def main() -> int:
    """
    Run the launch file.

    :returns: int, the exit status
    """
    request = json.load(sys.stdin)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.set_inheritable(request['reports'], False)
    reports = _Reports(request['reports'])
    roslib.set_interactive(True)            # keeps roslaunch from setting signal handlers
    parent = None
    try:
        run_id = _run_id()
        roslaunch.configure_logging(run_id)
        parent = _Parent(run_id, [(sys.argv[1], request['arguments'])],
                         force_screen=request['screen'])
        parent.reports = reports
        _run(parent, reports)
    except Exception as error:
        roslaunch.core.printerrlog('%s: %s' % (type(error).__name__, error))
        reports.send('error', text=' '.join(str(error).split()))
        return 1
    finally:
        if parent is not None:
            parent.shutdown()
    return reports.exit_code


if __name__ == '__main__':
    _status = main()
    logging.shutdown()
    sys.stdout.flush()
    os._exit(_status)           # whichever threads of roslaunch still wait for something
