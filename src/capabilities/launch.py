"""One launch: the process that runs a launch file, what it reports, and how it is ended."""
import json
import logging
import os
import signal
import subprocess
import sys
import threading
from typing import IO, Callable, Dict, Iterator, List, NamedTuple, Optional, Tuple

from capabilities.processes import MARK, Marked, ServerRun, kill_marked, send

__all__ = ['Launch', 'Report', 'STOP_SECONDS', 'exit_code', 'exit_text']

STOP_SECONDS = 15.0 + 2.0 + 5.0     # what roslaunch gives its nodes, and 5 s for itself
_KILL_SECONDS = 0.3                 # how long the end of a launch waits while leftovers are killed
_LINE_LIMIT = 64 << 10              # bytes of a line of output that are passed on
_HERE = os.path.dirname(os.path.abspath(__file__))
_LOG = logging.getLogger('rosout')  # rospy's own once a node is initialised


class Report(NamedTuple):
    """
    What a launch reports while it runs.

    >>> Report('died', '/later', 5).text, Report('died', '/later', 5).degrades
    ('node /later died, exit 5', True)
    """

    kind: str                       # 'started', 'died', 'missing' (did not start), 'restarted'
    node: str = ''                  # the name of the node, with its namespace
    exit_code: int = 0              # of 'died': 128 + n for signal n, -1 where it is not known
    times: int = 0                  # of 'restarted': how often so far
    nodes: Tuple[str, ...] = ()     # of 'started': the names of the nodes
    how: str = ''                   # of 'died': 'exit 5', 'signal 9'

    @property
    def text(self) -> str:
        """What happened, in words; '' for 'started'."""
        if self.kind == 'died':
            return 'node %s died, %s' % (self.node, self.how or 'exit %d' % self.exit_code)
        if self.kind == 'missing':
            return 'node %s did not start' % self.node
        if self.kind == 'restarted':
            return 'node %s restarted %s' % (
                self.node, 'once' if self.times == 1 else '%d times' % self.times)
        return ''

    @property
    def degrades(self) -> bool:
        """Is a part missing from now on? A node that ends with 0 has done its work."""
        return self.kind == 'missing' or self.kind == 'died' and self.exit_code != 0


class Launch:
    """
    A process that runs a launch file, or the placeholder, in a session of its own.

    :param file: the launch file; None runs the placeholder
    :param arguments: ``name:=value`` for the launch file
    :param screen: show the output of all nodes
    :param quiet: read the output and write it to stdout; otherwise the process writes there itself
    :param environment: of the process, without a mark
    :param run: the run whose mark its processes carry; None for no mark
    :param name: the id of the launch within that run
    :raises OSError: if the process cannot be started

    It runs when this returns; `watch` has to be called next.
    """

    def __init__(self, file: Optional[str], arguments: List[str], *, screen: bool, quiet: bool,
                 environment: Dict[str, str], run: Optional[ServerRun], name: str) -> None:
        self.real_path = None if file is None else os.path.realpath(file)   # None: the placeholder
        self._run = run
        self._name = name
        self._lock = threading.Lock()       # to send signals and to reap; not held while waiting
        self._reaped = False
        self._stopping: Optional[threading.Timer] = None
        self._ended = threading.Event()
        self._failure = ''                  # what roslaunch said, and the last report of its kind
        self._died = self._missing = Report(kind='')
        if run is not None:
            environment = dict(environment, **{MARK: run.mark(name)})
        reading, writing = os.pipe()
        try:
            self._process = subprocess.Popen(
                [sys.executable, os.path.join(_HERE, 'placeholder')] if file is None else
                [sys.executable, os.path.join(_HERE, 'runner.py'), file],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE if quiet else None,
                stderr=subprocess.STDOUT if quiet else None, env=environment,
                start_new_session=True, pass_fds=() if file is None else (writing,))
        except OSError:
            os.close(reading)
            raise
        finally:
            os.close(writing)
        self._reports = os.fdopen(reading, encoding='utf-8', errors='replace')
        self._instruct({'arguments': arguments, 'screen': screen, 'reports': writing})

    @property
    def pid(self) -> int:
        """The id of the process."""
        return self._process.pid

    @property
    def stopping(self) -> bool:
        """Was it asked to stop?"""
        return self._stopping is not None

    def watch(self, reported: Callable[[Report], None], ended: Callable[[int, str], None]) -> None:
        """
        Tell what happens to it, from a thread of its own.

        :param reported: called with each `Report`
        :param ended: called with the exit code and a text when all its processes are gone
        """
        threading.Thread(target=self._watch, args=(reported, ended), daemon=True,
                         name='launch %d' % self.pid).start()

    def begin_stop(self) -> None:
        """Ask it to stop: its nodes get the time that roslaunch gives them."""
        with self._lock:
            if not self._reaped and self._stopping is None:
                self._stopping = threading.Timer(STOP_SECONDS, self.kill)
                self._stopping.daemon = True
                self._stopping.start()
                send(self.pid, signal.SIGTERM)

    def interrupt(self) -> None:
        """Send SIGINT to the process, which passes it on to its nodes."""
        with self._lock:
            if not self._reaped:
                send(self.pid, signal.SIGINT)

    def kill(self) -> None:
        """Send SIGKILL to it, and to all that carries its mark."""
        with self._lock:
            if not self._reaped:
                send(self.pid, signal.SIGKILL)
        if self._run is not None:
            kill_marked(self._is_of_it, _KILL_SECONDS)

    def join(self, timeout: Optional[float] = None) -> bool:
        """Wait until ``ended`` was called, or for so many seconds; whether it was called."""
        return self._ended.wait(timeout)

    def _instruct(self, request: Dict[str, object]) -> None:
        """Write the runner's instructions to its standard input."""
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(json.dumps(request).encode())
            self._process.stdin.close()
        except OSError:             # it has ended already
            pass

    def _watch(self, reported: Callable[[Report], None], ended: Callable[[int, str], None]
               ) -> None:
        """Pass on reports, wait for the end, kill leftovers, and tell that all is gone."""
        if self._process.stdout is not None:
            output = threading.Thread(target=_pass_on, args=(self._process.stdout,), daemon=True)
            output.start()
        if self.real_path is None:
            _call(reported, Report(kind='started'))
        for report in self._read_reports():
            _call(reported, report)
        os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOWAIT)
        self.kill()                 # while the id is still taken by the process that ended
        with self._lock:
            returncode = self._process.wait()
            self._reaped = True
            if self._stopping is not None:
                self._stopping.cancel()
        if self._process.stdout is not None:
            output.join(_KILL_SECONDS / 3)
        _call(ended, exit_code(returncode), self._end_text(returncode))
        self._ended.set()
        if self._run is not None:
            kill_marked(self._is_of_it)

    def _read_reports(self) -> Iterator[Report]:
        """What the runner reports, until it ends."""
        with self._reports:
            for line in self._reports:
                data = json.loads(line)
                if data['kind'] == 'error':
                    self._failure = data['text']
                    continue
                report = Report(**dict(data, nodes=tuple(data.get('nodes', ()))))
                if report.kind == 'missing':
                    self._missing = report
                elif report.kind == 'died' and report.exit_code:
                    self._died = report
                yield report

    def _end_text(self, returncode: int) -> str:
        """Why it ended, in words."""
        if self._failure:
            return 'roslaunch: ' + self._failure
        if returncode > 0 and self._died.kind:
            return self._died.text
        return self._missing.text if self._missing.kind else exit_text(returncode)

    def _is_of_it(self, process: Marked) -> bool:
        return (process.server, process.run) == self._run and process.launch == self._name


def _call(function: Callable[..., None], *arguments: object) -> None:
    """Call a callback; an error in it is logged and does not end the thread."""
    try:
        function(*arguments)
    except Exception:
        _LOG.exception('a listener of a launch failed')


def _pass_on(output: IO[bytes]) -> None:
    """Copy the output of a process to stdout, line by line, until it ends."""
    with output:
        while True:
            line = output.readline(_LINE_LIMIT)
            if not line:
                return
            rest = line
            while rest and not rest.endswith(b'\n'):
                rest = output.readline(_LINE_LIMIT)
            try:
                sys.stdout.write(line.decode(errors='replace').rstrip('\n') + '\n')
                sys.stdout.flush()
            except (OSError, ValueError):   # stdout is closed; read on, or the process would block
                pass


def exit_code(returncode: int) -> int:
    """
    The exit code of a process as a shell tells it: 128 + n for signal n, which is -n in Python.

    >>> exit_code(5), exit_code(-9)
    (5, 137)
    """
    return returncode if returncode >= 0 else 128 - returncode


def exit_text(returncode: int) -> str:
    """
    How a process ended, in words.

    >>> exit_text(5), exit_text(-9)
    ('exit 5', 'signal 9')
    """
    return 'exit %d' % returncode if returncode >= 0 else 'signal %d' % -returncode
