"""
Processes that belong to a run of the capability server: marked, found and ended.

All processes that the server starts carry a mark in their environment, which children inherit. So
leftovers can be found in ``/proc``, however often they forked and whatever their parent is now.
This module imports only the standard library: it is also run by its path, with ``python3 -I -S``,
as the process of a `capabilities.leftovers.Watcher`.
"""
import json
import os
import signal
import sys
import time
from typing import Callable, Dict, Iterable, List, NamedTuple, Optional, Set

__all__ = ['MARK', 'Marked', 'ServerRun', 'end_marked', 'find_marked', 'kill_marked', 'send']

MARK = 'CAPABILITY_SERVER_MARK'         # the environment variable: server, run and launch
_ENVIRONMENT_LIMIT = 8 << 20            # bytes that are read; Linux allows about 6 MiB
_POLL = 0.05                            # seconds between two looks at /proc
_UNKILLABLE = 10.0                      # seconds after which SIGKILL is not repeated


class ServerRun(NamedTuple):
    """
    One run of a capability server.

    >>> run = ServerRun('/capability_server@http://localhost:11311', '17-4711-c0ffee')
    >>> run.mark('3')
    '/capability_server@http://localhost:11311 17-4711-c0ffee 3'
    """

    server: str     # NODE NAME@ROS_MASTER_URI: the same for each run of that server
    run: str        # different for each run; tells whether the server still lives

    @classmethod
    def new(cls, node_name: str, master_uri: str) -> 'ServerRun':
        """
        The run of the server in this process, with an id that no other run has.

        :param node_name: the resolved name of the server's node
        """
        process = _Process.read(os.getpid())
        started = process.started if process else 0
        return cls('@'.join((node_name, master_uri)).replace(' ', '%20'),
                   '%d-%d-%s' % (os.getpid(), started, os.urandom(4).hex()))

    def mark(self, launch: str) -> str:
        """The value of the variable `MARK` for one launch, whose id has no blanks."""
        return '%s %s %s' % (self.server, self.run, launch)

    def is_alive(self) -> bool:
        """Is the process of this server still there?"""
        pid, _, rest = self.run.partition('-')
        process = _Process.read(int(pid)) if pid.isdigit() else None
        return process is not None and rest.partition('-')[0] == str(process.started)


class _Process(NamedTuple):
    """The content of /proc/PID/stat for a process that has not ended."""

    parent: int     # the id of its parent
    group: int      # the id of its process group
    started: int    # clock ticks since the machine started

    @classmethod
    def read(cls, pid: int) -> 'Optional[_Process]':
        """The process of that id, None where it is not there or has ended."""
        try:
            with open('/proc/%d/stat' % pid, 'rb') as stream:
                fields = stream.read().rpartition(b')')[2].split()
            if fields[0] in b'ZXx':
                return None
            return cls(int(fields[1]), int(fields[2]), int(fields[19]))
        except (OSError, IndexError, ValueError):
            return None


class Marked(NamedTuple):
    """A process that carries a mark."""

    pid: int        # its id
    parent: int     # that of its parent
    group: int      # that of its process group
    server: str     # the three parts of its mark, as in `ServerRun.mark`
    run: str        # the second
    launch: str     # the third

    @property
    def command(self) -> str:
        """Its command line, at most 200 characters of it; '' where it has ended."""
        try:
            with open('/proc/%d/cmdline' % self.pid, 'rb') as stream:
                return ' '.join(stream.read(200).decode(errors='replace').split('\0')).strip()
        except OSError:
            return ''


Wanted = Callable[[Marked], bool]


def find_marked(wanted: Wanted) -> Dict[int, Marked]:
    """
    The processes of this user that carry a mark, without this process.

    :param wanted: returns whether to include a process
    :returns: the processes by their ids

    >>> find_marked(lambda process: process.server == '/nobody@http://localhost:1')
    {}
    """
    user = os.geteuid()
    found = {}
    with os.scandir('/proc') as entries:
        for entry in entries:
            try:
                if not entry.name.isdigit() or entry.stat().st_uid != user:
                    continue
                with open(entry.path + '/environ', 'rb') as stream:
                    mark = _mark(stream.read(_ENVIRONMENT_LIMIT))
            except OSError:         # it has ended, or may not be looked at
                continue
            pid = int(entry.name)
            process = _Process.read(pid) if mark and pid != os.getpid() else None
            if process is not None:
                marked = Marked(pid, process.parent, process.group, *mark)
                if wanted(marked):
                    found[pid] = marked
    return found


def _mark(environment: bytes) -> List[str]:
    """The three parts of the mark in an environment; empty where it has none."""
    name = MARK.encode() + b'='
    if name in environment:         # nearly always it is not: a search is cheaper than a split
        for entry in environment.split(b'\0'):
            if entry.startswith(name):
                parts = entry[len(name):].decode(errors='replace').split(' ')
                if len(parts) == 3:
                    return parts
    return []


def send(pid: int, number: int) -> None:
    """Send a signal to a process, and to its group if it leads one; none if it has ended."""
    try:
        if os.getpgid(pid) == pid != os.getpgrp():
            os.killpg(pid, number)
        else:
            os.kill(pid, number)
    except (ProcessLookupError, PermissionError):
        pass


def _send_all(found: Dict[int, Marked], pids: Iterable[int], number: int) -> None:
    """Send a signal once to each process: to its group if the leader is one of them."""
    chosen = set(pids)
    for pid in chosen:
        group = found[pid].group
        if group == pid or group not in chosen:
            send(pid, number)


def _kill_all(found: Dict[int, Marked]) -> None:
    """
    Send SIGKILL to the groups of processes.

    The groups contain nothing else, since each launch begins a session. The signal to a group also
    reaches children that were forked after the look at /proc.
    """
    for process in found.values():
        try:
            if process.group == os.getpgrp():
                os.kill(process.pid, signal.SIGKILL)
            else:
                os.killpg(process.group, signal.SIGKILL)
        except (ProcessLookupError, PermissionError):
            pass


def kill_marked(wanted: Wanted, seconds: float = _UNKILLABLE) -> bool:
    """
    Send SIGKILL to marked processes until none is found any more, or the time is over.

    :param wanted: as `find_marked` takes it
    :returns: whether nothing is left

    >>> kill_marked(lambda process: process.server == '/nobody@http://localhost:1')
    True
    """
    return _repeat(wanted, seconds, _kill_all)


def end_marked(wanted: Wanted, interrupt: Optional[float] = 5.0, terminate: float = 2.0,
               settle: float = 0.0) -> bool:
    """
    End marked processes: SIGINT, SIGTERM, SIGKILL, each only if the one before did not suffice.

    SIGINT goes to those whose parent is not one of them: a roslaunch passes it on to its nodes.

    :param wanted: as `find_marked` takes it
    :param interrupt: seconds from SIGINT to SIGTERM; None sends no SIGINT
    :param terminate: seconds from SIGTERM to SIGKILL
    :param settle: seconds for which nothing must be found
    :returns: whether nothing is left

    >>> end_marked(lambda process: process.server == '/nobody@http://localhost:1')
    True
    """
    seen: Set[int] = set()
    terminated: Set[int] = set()

    def send_interrupt(found: Dict[int, Marked]) -> None:
        _send_all(found, [pid for pid, process in found.items()
                          if pid not in seen and process.parent not in found], signal.SIGINT)
        seen.update(found)

    def send_terminate(found: Dict[int, Marked]) -> None:
        _send_all(found, found.keys() - terminated, signal.SIGTERM)
        terminated.update(found)

    return (interrupt is not None and _repeat(wanted, interrupt, send_interrupt, settle)
            or _repeat(wanted, terminate, send_terminate, settle)
            or kill_marked(wanted))


def _repeat(wanted: Wanted, seconds: float, action: Callable[[Dict[int, Marked]], None],
            settle: float = 0.0) -> bool:
    """
    Do something with the processes found, until none is left or the time is over.

    At least two looks in a row, over ``settle`` seconds, have to find none, because a process that
    is calling exec has no environment for a moment.
    """
    end = time.monotonic() + seconds
    empty_since: Optional[float] = None
    while True:
        found = find_marked(wanted)
        now = time.monotonic()
        if found:
            empty_since = None
            action(found)
            if now >= end:
                return False
        elif empty_since is not None and now - empty_since >= settle:
            return True
        elif empty_since is None:
            empty_since = now
        time.sleep(_POLL if found or settle else _POLL / 5)


def _watch() -> None:
    """Wait for the end of the pipe, then end the leftovers of the server."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    lines = sys.stdin.read().splitlines()
    if lines:
        run = ServerRun(*json.loads(lines[0]))
        # A process that was just being started when the server was killed appears a little later.
        settle = 0.0 if lines[1:] == ['done'] else 1.0
        end_marked(lambda process: (process.server, process.run) == run, settle=settle)


if __name__ == '__main__':
    _watch()
