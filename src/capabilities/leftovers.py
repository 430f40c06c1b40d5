"""
What a capability server leaves behind when it is killed. Its watcher ends that at once; if the
watcher was killed as well, the next run of the server does, before it starts anything.
"""
import json
import os
import subprocess
import sys
import time
from typing import Callable

from capabilities import processes
from capabilities.processes import MARK, Marked, ServerRun, end_marked, find_marked

__all__ = ['Watcher', 'end_leftovers']

_POLL = 0.1     # seconds between two looks whether an earlier server still lives


class Watcher:
    """
    A process that ends all marked processes of a run as soon as the server is gone.

    It reads from a pipe that only the server holds open, so it notices any end. It is in a session
    of its own and ignores SIGINT and SIGTERM, so that a Ctrl-C does not end it.

    :param run: the run whose processes it ends
    :raises OSError: if it cannot be started
    """

    def __init__(self, run: ServerRun) -> None:
        environment = {name: value for name, value in os.environ.items() if name != MARK}
        self._process = subprocess.Popen(
            [sys.executable, '-I', '-S', os.path.abspath(processes.__file__)],
            stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            start_new_session=True, env=environment, cwd='/')
        self._tell(json.dumps(run))

    @property
    def pid(self) -> int:
        """The id of its process."""
        return self._process.pid

    def close(self) -> None:
        """Let it end, since the server has ended everything itself; waits at most 2 s."""
        self._tell('done')
        try:
            assert self._process.stdin is not None
            self._process.stdin.close()
            self._process.wait(2.0)
        except (OSError, subprocess.TimeoutExpired):
            pass

    def _tell(self, line: str) -> None:
        try:
            assert self._process.stdin is not None
            self._process.stdin.write(line.encode() + b'\n')
            self._process.stdin.flush()
        except (OSError, ValueError):       # it was killed; the next run of the server cleans up
            pass


def end_leftovers(run: ServerRun, log: Callable[[str], None], wait: float = 8.0) -> int:
    """
    End the leftovers of earlier runs of a server.

    An earlier server of the same name that still lives was shut down by the master when this one
    registered, and is ending its own processes: it gets ``wait`` seconds for that. Blocks for at
    most that time and 3 s.

    :param run: the run that begins
    :param log: called with a line for each process that is ended
    :returns: how many processes were ended

    >>> end_leftovers(ServerRun('/nobody@http://localhost:1', '17-4711-c0ffee'), print)
    0
    """
    def is_leftover(process: Marked) -> bool:
        return process.server == run.server and process.run != run.run

    end = time.monotonic() + wait
    found = find_marked(is_leftover)
    while time.monotonic() < end and any(
            ServerRun(process.server, process.run).is_alive() for process in found.values()):
        time.sleep(_POLL)
        found = find_marked(is_leftover)
    for process in found.values():
        log('ending process %d, left by an earlier run of %s: %s' % (
            process.pid, run.server.partition('@')[0], process.command))
    if found:
        end_marked(is_leftover, interrupt=2.0, terminate=1.0)
    return len(found)
