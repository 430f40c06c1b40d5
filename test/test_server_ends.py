"""The end of the capability server: nothing that it started outlives it, however it ends."""
import os
import signal
import time

import pytest

from robot import PATIENCE, eventually

WITHOUT = {'nodelet_manager': False}
ENDS = int(os.environ.get('CAPABILITIES_ENDS', '5'))    # in the long run 50


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_everything(robot, number):
    """A9: F7, with a nodelet manager and a node that takes its time"""
    server = robot.server()
    with server:
        for name in 'Nav', 'Camera', 'Slow', 'Forks':
            server.start_capability(name)
        server.wait_for('Slow', 'running')
        server.stubborn_node_pid('slow')
        server.wait_for('Forks', 'running')
        assert server.end(number) == 0
        assert server.processes() == {}
        eventually(lambda: len(server.types('terminated')) == 6)
        assert len(server.types('stopped')) == 6
        assert ('terminated', '!!nodelet_manager') in server.types()


def test_a_node_that_ignores_signals_is_killed(robot):
    """A9: F8"""
    with robot.server(WITHOUT) as server:
        server.start_capability('Stubborn')
        server.stubborn_node_pid('stubborn')
        begin = time.monotonic()
        assert server.end() == 0
        assert server.processes() == {}
        assert time.monotonic() - begin > 4     # it had its 5 s, so that this tests what it says


def test_an_inherited_ignored_sigint_ends_it_too(robot):
    """A9"""
    server = robot.server(WITHOUT)
    server.start(sigint=signal.SIG_IGN)
    with server:
        server.start_capability('Base')
        assert server.end(signal.SIGINT) == 0
        assert server.processes() == {}


def test_ends_at_any_time_after_a_start_leave_nothing(robot):
    """A9"""
    for number in range(ENDS):
        with robot.server(WITHOUT) as server:
            server.start_capability('Patrol')
            server.start_capability('Camera')
            time.sleep(2.0 * number / ENDS)
            assert server.end() == 0
            assert server.processes() == {}


def test_from_the_signal_on_requests_are_refused(robot):
    """A9"""
    with robot.server(WITHOUT) as server:
        server.start_capability('Stubborn')
        server.stubborn_node_pid('stubborn')
        server.process.send_signal(signal.SIGINT)
        eventually(lambda: 'the capability server ends' in server.error(
            'start_capability', 'robot/Base', ''))
        assert 'the capability server ends' in server.error('get_status')
        assert server.end() == 0
        assert server.processes() == {}


def test_a_signal_before_anything_was_started_ends_it(robot):
    """A9: while it starts, at different times"""
    for number in range(ENDS):
        server = robot.server()
        server.start()
        time.sleep(1.5 * number / ENDS)
        server.end()
        eventually(lambda server=server: server.processes() == {})


@pytest.mark.parametrize('function', ['rospy.init_node', 'rosgraph.Master.getSystemState'])
def test_a_signal_is_not_lost_in_a_library(robot, function):
    """A9: rospy has places where any exception is dropped, that of a signal too"""
    server = robot.server(program='''\
import os, rosgraph, rospy, signal
from capabilities.server import main

function = %(function)s
def function_that_drops_exceptions(*arguments, **keywords):
    try:
        os.kill(os.getpid(), signal.SIGINT)
    except BaseException:
        pass
    return function(*arguments, **keywords)

%(function)s = function_that_drops_exceptions
raise SystemExit(main())
''' % {'function': function})
    server.start()
    assert server.process.wait(PATIENCE) == 0
    assert 'ready' not in server.log.read_text()
    eventually(lambda: server.processes() == {})


def test_a_killed_server_leaves_no_orphans(robot):
    """A10: F6"""
    with robot.server() as server:
        server.start_capability('Nav')
        server.start_capability('Forks')
        server.wait_for('Nav', 'running')
        server.wait_for('Forks', 'running')
        commands = ' '.join(server.processes().values())
        assert 'capability_server' not in commands.replace(
            'capability_server_nodelet_manager', '').replace('capability_server.', '')
        server.process.kill()
        eventually(lambda: server.processes() == {}, 15)


def test_a_restarted_server_finds_no_survivors(robot):
    """A11, its predecessor and the watcher of that killed"""
    server = robot.server(WITHOUT)
    with server:
        server.start_capability('Nav')
        server.wait_for('Nav', 'running')
        node = server.node_pid('nav')
        started = set(server.processes())
        watcher = [pid for pid in children(server.process.pid) if pid not in started]
        assert len(watcher) == 1
        os.kill(watcher[0], signal.SIGKILL)
        server.end(signal.SIGKILL)
        survivors = set(server.processes())
        assert node in survivors
    server.process = None
    with server:
        assert not survivors & set(server.processes())
        assert server.states() == {}
        assert server.start_capability('Nav') == 0
        server.wait_for('Nav', 'running')


def test_a_server_that_restarts_while_the_watcher_is_at_work(robot):
    """A11: it ends the rest itself, and the watcher does not touch what it starts"""
    server = robot.server(WITHOUT)
    with server:
        server.start_capability('Stubborn')
        server.stubborn_node_pid('stubborn')
        before = set(server.processes())
        [watcher] = [pid for pid in children(server.process.pid) if pid not in before]
        server.end(signal.SIGKILL)
    server.process = None
    with server:
        assert not before & set(server.processes())
        assert 'left by an earlier run' in server.log.read_text()
        server.start_capability('Stubborn')
        node = server.stubborn_node_pid('stubborn')
        eventually(lambda: not os.path.exists('/proc/%d' % watcher))
        assert server.status('Stubborn').state == 'running'
        assert server.stubborn_node_pid('stubborn') == node


def children(pid):
    """The processes that a process has started."""
    with open('/proc/%d/task/%d/children' % (pid, pid)) as file:
        return [int(child) for child in file.read().split()]


def test_a_server_of_the_same_name_takes_the_place_of_the_other(robot):
    """A11"""
    with robot.server(WITHOUT) as first:
        first.start_capability('Nav')
        first.wait_for('Nav', 'running')
        before = set(first.processes())
        second = robot.server(WITHOUT, name=first.name.lstrip('/')).start()
        assert first.process.wait(30) == 0
        with second:
            assert not before & set(second.processes())
            assert second.states() == {}
