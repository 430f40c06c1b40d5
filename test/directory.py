"""A resource directory, robots that announce themselves to it, and what a client sees of it."""
from __future__ import annotations

import concurrent.futures
import contextlib
import itertools
import os
import signal
import subprocess
import sys
import threading

from robot import PATIENCE, eventually

DIRECTORY = '''\
import signal
signal.signal(signal.SIGINT, signal.SIG_DFL)    # as in the script of the node
from rocon_uri.directory_node import main
raise SystemExit(main())
'''
ANNOUNCE = DIRECTORY.replace('directory_node', 'announcer')

_numbers = itertools.count(1)


class Place:
    """
    A namespace of a master in which a directory and its robots run, all ended with the block.

    :param folder: where logs are written
    :param environment: of what runs there, with the address of its master
    """

    def __init__(self, folder, environment):
        self.namespace = '/place_%d' % next(_numbers)
        self.folder = folder
        self.environment = dict(environment, ROS_NAMESPACE=self.namespace)
        self.processes = []

    def __enter__(self):
        return self

    def __exit__(self, *error):
        with contextlib.ExitStack() as stack:       # each, even if one does not end
            for process in reversed(self.processes):
                stack.callback(end, process)

    def run(self, program, name, *arguments):
        """Start a node of that name; its process is returned."""
        self.log = self.folder / ('%s_%s.log' % (self.namespace[1:], name))
        with open(self.log, 'ab') as log:
            process = subprocess.Popen(
                [sys.executable, '-c', program, *arguments, '__name:=' + name],
                env=self.environment, stdout=log, stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL, cwd=str(self.folder), start_new_session=True)
        self.processes.append(process)
        return process

    def announce(self, name, uri, *arguments):
        """Start ``announce``."""
        return self.run(ANNOUNCE, name, uri, *arguments)

    def directory(self, *arguments):
        """Start the directory."""
        return self.run(DIRECTORY, 'directory', *arguments)

    def text_of(self, name):
        """What a node has written."""
        return (self.folder / ('%s_%s.log' % (self.namespace[1:], name))).read_text()

    def call(self, service, *arguments):
        """Call a service of the directory, once it is there."""
        import rospy
        from rocon_uri import srv
        kind = {'find': srv.FindResources, 'explain': srv.ExplainResource,
                'find_robots': srv.FindRobots}[service]
        name = '%s/directory/%s' % (self.namespace, service)
        rospy.wait_for_service(name, PATIENCE)
        return within_patience(rospy.ServiceProxy(name, kind), *arguments)

    def find(self, request='rocon:/'):
        """What the directory finds, sorted."""
        return sorted(self.call('find', request).uris)

    def wait_for(self, *uris):
        """Wait until the directory has exactly these."""
        eventually(lambda: self.find() == sorted(uris))


def within_patience(function, *arguments):
    """What it returns or raises; an AssertionError if that takes longer than a test waits."""
    outcome = concurrent.futures.Future()

    def call():
        try:
            outcome.set_result(function(*arguments))
        except BaseException as error:
            outcome.set_exception(error)

    threading.Thread(target=call, daemon=True).start()
    try:
        return outcome.result(PATIENCE)
    except concurrent.futures.TimeoutError:
        raise AssertionError('no answer after %g s: %r' % (PATIENCE, arguments)) from None


class Seen:
    """What a subscriber of a directory sees."""

    def __init__(self, place):
        import rospy
        from rocon_uri.msg import ResourceChange, Resources
        self.changes, self.resources = [], []
        base = place.namespace + '/directory/'
        self._subscribers = [
            rospy.Subscriber(base + 'changes', ResourceChange, self.changes.append),
            rospy.Subscriber(base + 'resources', Resources, self.resources.append)]

    def __enter__(self):
        eventually(lambda: all(subscriber.get_num_connections()
                               for subscriber in self._subscribers))
        eventually(lambda: self.resources)
        return self

    def __exit__(self, *error):
        for subscriber in self._subscribers:
            subscriber.unregister()


def end(process, number=signal.SIGINT):
    """End a process that was started here; its exit status is returned."""
    if process.poll() is None:
        os.kill(process.pid, number)
        os.kill(process.pid, signal.SIGCONT)
    try:
        return process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        raise AssertionError('it does not end') from None
