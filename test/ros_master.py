"""A roscore of a test's own, on a port that is free, and nodes that fail as a test wants it."""
from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
import xmlrpc.client

from made_packages import make_package

NODE = '''\
#!%s
"""Do what the arguments say: sleep SECONDS, exit CODE, kill SIGNAL, ignore, fork, say, flood."""
import os, signal, sys, time
words = iter(argument for argument in sys.argv[1:] if ':=' not in argument)
for word in words:
    if word == 'sleep':
        time.sleep(float(next(words)))
    elif word == 'exit':
        sys.exit(int(next(words)))
    elif word == 'kill':
        os.kill(os.getpid(), int(next(words)))
    elif word == 'ignore':
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
    elif word == 'fork':
        if os.fork() == 0:
            os.setsid()
            time.sleep(1000)
    elif word == 'say':
        print(next(words), flush=True)
    elif word == 'flood':
        while True:
            sys.stdout.write(1000 * 'x')
''' % sys.executable


class _Transport(xmlrpc.client.Transport):
    """Waits 10 s for an answer; another process may have taken the port."""

    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = 10
        return connection


class Master:
    """
    A roscore, and the environment of what talks to it.

    Where it is used in a ``with`` statement it is there at its beginning and gone at its end.
    """

    def __init__(self, folder, *packages):
        with socket.socket() as probe:
            probe.bind(('127.0.0.1', 0))
            self.port = probe.getsockname()[1]
        self.uri = 'http://127.0.0.1:%d' % self.port
        self.environment = dict(os.environ, ROS_MASTER_URI=self.uri, ROS_IP='127.0.0.1',
                                ROS_HOME=str(folder / 'ros_home'), ROS_LOG_DIR=str(folder / 'log'))
        for name in 'ROS_HOSTNAME', 'ROS_NAMESPACE', 'PYTHONUNBUFFERED':
            self.environment.pop(name, None)
        self.environment['ROS_PACKAGE_PATH'] = ':'.join(
            [str(package) for package in packages]
            + [os.environ.get('ROS_PACKAGE_PATH') or '/usr/share'])

    def __enter__(self):
        self._process = subprocess.Popen(
            ['roscore', '-p', str(self.port)], env=self.environment, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, start_new_session=True)
        deadline = time.monotonic() + 60
        while not self._answers():
            assert self._process.poll() is None and time.monotonic() < deadline, \
                'roscore does not start'
            time.sleep(0.05)
        return self

    def __exit__(self, *error):
        self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(30)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _answers(self):
        """Is the master there, and rosout, which is the last to come?"""
        try:
            master = xmlrpc.client.ServerProxy(self.uri, _Transport())
            return master.lookupNode('/test', '/rosout')[0] == 1
        except OSError:
            return False


def ignores(pid, *numbers):
    """Does a process ignore these signals by now? False for one that has ended."""
    try:
        with open('/proc/%d/status' % pid) as status:
            mask = next(line.split()[1] for line in status if line.startswith('SigIgn'))
    except (OSError, StopIteration):
        return False
    return all(int(mask, 16) & (1 << number - 1) for number in numbers)


def make_test_nodes(workspace):
    """Write the package test_nodes, whose node does what its arguments say."""
    path = make_package(workspace, 'test_nodes') / 'node'
    path.write_text(NODE)
    path.chmod(0o755)


def node(name, args, more=''):
    """The line of a launch file that runs a node of test_nodes."""
    return '<node pkg="test_nodes" type="node" name="%s" args="%s" %s/>' % (name, args, more)
