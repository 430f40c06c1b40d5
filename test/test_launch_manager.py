"""The launch manager starts launch files, tells how they end, and leaves nothing behind."""
from __future__ import annotations

import contextlib
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from xmlrpc.client import ServerProxy

import pytest

from capabilities import launch_manager
from capabilities.launch_manager import LaunchManager, which
from capabilities.processes import ServerRun, find_marked, kill_marked
from capabilities.specs.provider import CapabilityProvider
from ros_master import ignores, node

pytest.importorskip('roslaunch', reason='ROS is not installed')

PATIENCE = 60


@pytest.fixture(autouse=True)
def environment(master, monkeypatch):
    """The launch manager starts processes with the environment of its own process."""
    for name in set(os.environ) - set(master.environment):
        monkeypatch.delenv(name)
    for name, value in master.environment.items():
        monkeypatch.setenv(name, value)
    rospy = sys.modules.get('rospy')
    if rospy is not None:       # other tests make this process a node, whose name would count
        monkeypatch.setattr(rospy.core, 'is_initialized', lambda: False)


class Listener:
    """What a launch manager told, in order."""

    def __init__(self):
        self.told = []

    def launch_reported(self, pid, report):
        self.told.append((pid, report.kind, report.text))

    def launch_ended(self, pid, exit_code, text):
        self.told.append((pid, 'ended', exit_code, text))

    def nodelet_manager_ended(self, pid, exit_code, text):
        self.told.append((pid, 'nodelet manager ended', exit_code, text))

    def about(self, pid):
        """What was told of a launch, without its id."""
        return [tuple(what) for about, *what in list(self.told) if about == pid]

    def until(self, pid, kind):
        """What was told of a launch when something of that kind is among it."""
        wait_until(lambda: any(what[0] == kind for what in self.about(pid)))
        return self.about(pid)

    def end(self, pid):
        return self.until(pid, 'ended')[-1]


@pytest.fixture
def run():
    run = ServerRun.new('/server', 'http://localhost:1')
    yield run
    kill_marked(lambda process: process.server == run.server)


@pytest.fixture
def listener():
    return Listener()


@pytest.fixture
def manager(run, listener):
    manager = LaunchManager(listener=listener, run=run, nodelet_manager=False)
    yield manager
    manager.end()
    assert not find_marked(lambda process: process.run == run.run)


@pytest.fixture
def provider(tmp_path):
    """Write a launch file of these lines: a provider that runs it, and the path of its spec."""
    def provider(*lines, name='a'):
        path = tmp_path / (name + '.launch')
        path.write_text('<launch>\n%s\n</launch>\n' % '\n'.join(lines))
        return (CapabilityProvider('package/' + name, 1, 'package/A', path.name),
                str(tmp_path / (name + '.yaml')))

    return provider


def processes_of(run):
    """The nodes and runners of a run, by their command lines."""
    return {pid: process.command for pid, process in
            find_marked(lambda process: process.run == run.run).items()}


def wait_for_stubborn(run):
    """Wait until a node of a run ignores signals; before, they end it."""
    wait_until(lambda: any('ignore' in command and ignores(pid, signal.SIGTERM)
                           for pid, command in processes_of(run).items()))


def wait_until(condition):
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, 'it did not happen'
        time.sleep(0.01)


def test_a_launch_is_started_and_stopped(manager, listener, provider, run):
    pid = manager.run_capability_provider(*provider(node('a', 'sleep 1000')))
    assert listener.until(pid, 'started') == [('started', '')]
    assert pid in processes_of(run)
    manager.stop_capability_provider(pid)
    assert listener.end(pid) == ('ended', 0, 'exit 0')
    assert not processes_of(run)


def test_the_end_says_which_node_died(manager, listener, provider):
    pid = manager.run_capability_provider(*provider(node('a', 'sleep 0.2 exit 5')))
    assert listener.until(pid, 'ended')[-2:] == [
        ('died', 'node /a died, exit 5'), ('ended', 5, 'node /a died, exit 5')]


def test_the_end_says_what_did_not_start(manager, listener, provider):
    pid = manager.run_capability_provider(*provider('<node pkg="test_nodes" type="b" name="b"/>'))
    assert listener.end(pid) == ('ended', 0, 'node /b did not start')


def test_the_end_says_what_roslaunch_said(manager, listener, provider):
    pid = manager.run_capability_provider(*provider('<include file="/no/such.launch"/>'))
    kind, code, text = listener.end(pid)
    assert (kind, code) == ('ended', 1)
    assert text.startswith('roslaunch: ') and '/no/such.launch' in text


def test_the_id_is_known_before_anything_is_told(manager, listener, provider):
    known = []
    pid = manager.run_capability_provider(
        *provider(node('a', 'exit 1')), on_pid=lambda pid: known.append((pid, *listener.told)))
    assert known == [(pid,)]
    listener.end(pid)


def test_the_nodes_are_gone_before_the_end_is_told(manager, listener, provider, run):
    pid = manager.run_capability_provider(*provider(node('a', 'ignore fork sleep 1000')))
    listener.until(pid, 'started')
    wait_until(lambda: len(processes_of(run)) == 3)     # the runner, the node, and what it forked
    left = []
    tell = listener.launch_ended
    listener.launch_ended = lambda *what: (left.append(processes_of(run)), tell(*what))
    os.kill(pid, signal.SIGKILL)
    assert listener.end(pid) == ('ended', 128 + 9, 'signal 9')
    assert left == [{}]


def test_what_a_node_forked_ends_with_its_launch(manager, listener, provider, run):
    pid = manager.run_capability_provider(*provider(node('a', 'fork sleep 0.2 exit 0')))
    assert listener.end(pid) == ('ended', 0, 'exit 0')
    assert not processes_of(run)


def test_one_launch_does_not_end_another(manager, listener, provider):
    first = manager.run_capability_provider(*provider(node('a', 'sleep 1000'), name='a'))
    second = manager.run_capability_provider(*provider(node('b', 'sleep 1000'), name='b'))
    listener.until(first, 'started')
    listener.until(second, 'started')
    os.kill(first, signal.SIGKILL)
    listener.end(first)
    with pytest.raises(RuntimeError, match='already running'):
        manager.run_capability_provider(*provider(node('b', 'sleep 1000'), name='b'))
    manager.stop_capability_provider(second)
    assert listener.end(second) == ('ended', 0, 'exit 0')


def test_one_launch_file_runs_once_at_a_time(manager, listener, provider, tmp_path):
    spec, path = provider(node('a', 'sleep 1000'))
    pid = manager.run_capability_provider(spec, path)
    with pytest.raises(RuntimeError) as error:
        manager.run_capability_provider(spec, path)
    assert str(error.value) == "Launch file at '%s' is already running." % (tmp_path / 'a.launch')
    (tmp_path / 'link.launch').symlink_to(tmp_path / 'a.launch')
    with pytest.raises(RuntimeError, match='link.launch. is already running'):
        manager.run_launch_file(str(tmp_path / 'link.launch'), spec)
    manager.stop_capability_provider(pid)
    again = manager.run_capability_provider(spec, path)
    assert listener.until(again, 'started')


def test_a_launch_file_can_be_started_again_from_the_word_of_its_end(manager, listener, provider):
    again = []

    def start_again(pid, exit_code, text):
        if not again:
            again.append(manager.run_capability_provider(*what))

    what = provider(node('a', 'exit 1'))
    listener.launch_ended = start_again
    manager.run_capability_provider(*what)
    wait_until(lambda: again)
    listener.until(again[0], 'started')


def test_a_provider_without_a_launch_file_has_a_placeholder(manager, listener, run):
    spec = CapabilityProvider('package/a', 1, 'package/A')
    first = manager.run_capability_provider(spec, '/anywhere/a.yaml')
    second = manager.run_capability_provider(spec, '/anywhere/a.yaml')
    assert listener.until(first, 'started') == [('started', '')]
    assert processes_of(run).keys() == {first, second}
    assert 'capability_server' not in processes_of(run)[first]
    manager.stop_capability_provider(first)
    assert processes_of(run).keys() == {second}


def test_what_is_not_there_cannot_be_stopped(manager):
    for stop in (manager.begin_stop, manager.stop_capability_provider,
                 manager._LaunchManager__stop_by_pid):
        with pytest.raises(RuntimeError) as error:
            stop(-1)
        assert str(error.value) == "No running launch file with PID of '-1'"
    with pytest.raises(RuntimeError, match='Unknown process id'):
        manager._LaunchManager__monitor_process(-1)


def test_nobody_waits_for_a_stubborn_node(manager, listener, provider, run):
    stubborn = manager.run_capability_provider(
        *provider(node('stubborn', 'ignore sleep 1000'), name='a'))
    listener.until(stubborn, 'started')
    wait_for_stubborn(run)
    manager.begin_stop(stubborn)
    manager.begin_stop(stubborn)
    other = manager.run_capability_provider(*provider(node('other', 'sleep 1000'), name='b'))
    listener.until(other, 'started')
    assert listener.about(stubborn) == [('started', '')]


def test_a_roslaunch_that_does_not_end_in_its_time_is_killed(
        manager, listener, provider, run, monkeypatch):
    monkeypatch.setattr('capabilities.launch.STOP_SECONDS', 0.5)
    pid = manager.run_capability_provider(*provider(node('a', 'ignore sleep 1000')))
    listener.until(pid, 'started')
    wait_for_stubborn(run)
    manager.stop_capability_provider(pid)
    assert listener.end(pid) == ('ended', 128 + 9, 'signal 9')
    assert not processes_of(run)


@contextlib.contextmanager
def silent_master(monkeypatch):
    """A master that takes the call and never answers."""
    with socket.socket() as silent:
        silent.bind(('127.0.0.1', 0))
        silent.listen(5)
        monkeypatch.setenv('ROS_MASTER_URI', 'http://127.0.0.1:%d' % silent.getsockname()[1])
        yield silent


def test_a_roslaunch_that_never_comes_up_ends_at_once(manager, listener, provider, monkeypatch):
    with silent_master(monkeypatch) as silent:
        pid = manager.run_capability_provider(*provider(node('a', 'sleep 1000')))
        silent.accept()[0].recv(1)
        manager.stop_capability_provider(pid)
    assert listener.until(pid, 'ended') == [('ended', 128 + 15, 'exit 143')]


def test_the_end_of_all(run, listener, provider, monkeypatch):
    manager = LaunchManager(listener=listener, run=run, nodelet_manager=False)
    ids = [manager.run_capability_provider(*provider(node(name, args), name=name))
           for name, args in (('a', 'sleep 1000'), ('b', 'ignore fork sleep 1000'),
                              ('c', 'fork sleep 1000'))]
    ids.append(manager.run_launch_file(None, None))
    for pid in ids:
        listener.until(pid, 'started')
    with silent_master(monkeypatch):
        ids.append(manager.run_capability_provider(*provider(node('d', ''), name='d')))
    manager.begin_end()
    assert manager.stopping
    with pytest.raises(RuntimeError, match='the capability server ends'):
        manager.run_capability_provider(*provider(node('e', 'sleep 1000'), name='e'))
    manager.end()
    assert not processes_of(run)
    assert {pid for pid, kind, *_ in listener.told if kind == 'ended'} == set(ids)
    manager.end()


def test_what_has_only_just_been_started_ends_too(run, listener, provider):
    manager = LaunchManager(listener=listener, run=run, nodelet_manager=False)
    ids = [manager.run_capability_provider(*provider(node('a', 'sleep 1000'), name='a%d' % number))
           for number in range(3)]
    manager.end()
    assert not processes_of(run)
    assert {pid for pid, kind, *_ in listener.told if kind == 'ended'} == set(ids)


def test_without_a_server_there_is_no_mark_and_stop_ends_what_was_started(listener, provider):
    manager = LaunchManager(listener=listener, nodelet_manager=False)
    pid = manager.run_capability_provider(*provider(node('a', 'sleep 1000')))
    listener.until(pid, 'started')
    assert not find_marked(lambda process: process.pid == pid)
    manager.handle_capability_events(None)
    manager.stop()
    assert listener.end(pid) == ('ended', 0, 'exit 0')
    with pytest.raises(RuntimeError, match='the capability server ends'):
        manager.run_launch_file(None, None)


def test_a_listener_that_fails_loses_nothing(manager, listener, provider, caplog):
    listener.launch_reported = lambda pid, report: 1 / 0
    pid = manager.run_capability_provider(*provider(node('a', 'exit 3')))
    assert listener.end(pid) == ('ended', 3, 'node /a died, exit 3')
    assert 'ZeroDivisionError' in caplog.text


@pytest.mark.parametrize('namespace, given, name', [
    (None, None, '/capability_server_nodelet_manager'),
    ('/robot', None, '/robot/capability_server_nodelet_manager'),
    ('robot/', 'nodelets', '/robot/nodelets'),
    ('/', '/elsewhere/nodelets', '/elsewhere/nodelets')])
def test_the_name_of_the_nodelet_manager(monkeypatch, namespace, given, name):
    if namespace is not None:
        monkeypatch.setenv('ROS_NAMESPACE', namespace)
    manager = LaunchManager(nodelet_manager_name=given, nodelet_manager=False)
    assert manager.nodelet_manager_name == name
    assert manager.nodelet_manager_pid is None
    assert not manager.has_nodelet_manager


@pytest.mark.parametrize('namespace, given', [
    (None, None), ('/robot', None), (None, '/elsewhere/nodelets')])
def test_the_nodelet_manager_has_that_name(run, listener, master, monkeypatch, namespace, given):
    if namespace is not None:
        monkeypatch.setenv('ROS_NAMESPACE', namespace)
    manager = LaunchManager(False, False, given, listener=listener, run=run)
    name, pid = manager.nodelet_manager_name, manager.nodelet_manager_pid
    assert listener.until(pid, 'started')
    assert manager.start_nodelet_manager() == pid
    wait_until(lambda: ServerProxy(master.uri).lookupNode('/test', name)[0] == 1)
    runner = next(command for command in processes_of(run).values() if 'runner.py' in command)
    assert 'capability_server' not in runner
    manager.end()
    assert manager.nodelet_manager_pid is None


def test_the_loss_of_the_nodelet_manager_is_told_and_it_can_be_started_again(
        run, listener, caplog):
    manager = LaunchManager(listener=listener, run=run)
    pid = manager.nodelet_manager_pid
    os.kill(pid, signal.SIGKILL)
    assert listener.until(pid, 'nodelet manager ended')[-1] == (
        'nodelet manager ended', 128 + 9, 'signal 9')
    assert "Capability server's nodelet manager terminated unexpectedly." in caplog.text
    again = manager.start_nodelet_manager()
    assert again == manager.nodelet_manager_pid != pid
    caplog.clear()
    manager.begin_stop(again)
    listener.until(again, 'nodelet manager ended')
    assert not caplog.records
    manager.end()


def test_the_nodelet_manager_is_stopped_last(run, listener, provider):
    manager = LaunchManager(listener=listener, run=run)
    nodelets = manager.nodelet_manager_pid
    pid = manager.run_capability_provider(*provider(node('a', 'sleep 1000')))
    listener.until(pid, 'started')
    manager.stop()
    assert [told[0] for told in listener.told if 'ended' in told[1]] == [pid, nodelets]


def test_where_nodelet_is_not_installed_one_warning_says_so(monkeypatch, caplog):
    monkeypatch.setattr('roslib.packages.find_node', lambda package, node: [])
    manager = LaunchManager()
    assert not manager.has_nodelet_manager
    assert manager.nodelet_manager_pid is None
    assert [record.getMessage() for record in caplog.records] == [
        'package nodelet is not installed, so no nodelet manager is started']


def test_providers_are_told_the_whole_name_of_the_nodelet_manager(manager, listener, provider):
    pid = manager.run_capability_provider(*provider(
        '<arg name="capability_server_nodelet_manager_name"/>',
        '<group if="$(eval arg(\'capability_server_nodelet_manager_name\') == '
        '\'/capability_server_nodelet_manager\')">', node('told', 'sleep 1000'), '</group>'))
    assert listener.until(pid, 'started') == [('started', '')]
    manager.stop_capability_provider(pid)
    assert listener.end(pid) == ('ended', 0, 'exit 0')


SERVER = '''
import sys, time
from capabilities.launch_manager import LaunchManager
from capabilities.processes import ServerRun
from capabilities.specs.provider import CapabilityProvider

class Listener:
    def launch_reported(self, pid, report):
        if report.kind == 'started':
            print('started', file=sys.stderr, flush=True)
    def launch_ended(self, pid, exit_code, text):
        print('ended', text, file=sys.stderr, flush=True)

quiet, run, *launch_files = sys.argv[1:]
manager = LaunchManager(quiet == 'quiet', listener=Listener(), run=ServerRun('/server', run),
                        nodelet_manager=False)
for launch_file in launch_files:
    manager.run_launch_file(launch_file, None)
time.sleep(1000)
'''


@contextlib.contextmanager
def server(run, *launch_files, quiet='not quiet', stdout=subprocess.PIPE):
    """A process with a launch manager that runs launch files; it is killed at the end."""
    with subprocess.Popen([sys.executable, '-c', SERVER, quiet, run.run, *launch_files],
                          stdout=stdout, stderr=subprocess.PIPE) as process:
        try:
            yield process
        finally:
            process.kill()
            wait_until(lambda: not processes_of(run))


def wait_for_line(stream, expected):
    for line in stream:
        if expected in line:
            return line
    raise AssertionError('%r was not written' % expected)


def test_nothing_outlives_a_killed_server(run, provider, tmp_path):
    for name, args in ('a', 'sleep 1000'), ('b', 'ignore fork sleep 1000'):
        provider(node(name, args), name=name)
    with server(run, str(tmp_path / 'a.launch'), str(tmp_path / 'b.launch'),
                stdout=subprocess.DEVNULL) as process:
        wait_for_line(process.stderr, b'started')
        wait_for_line(process.stderr, b'started')
        wait_until(lambda: len(processes_of(run)) == 5)
        process.kill()
        wait_until(lambda: not processes_of(run))


def test_where_quiet_the_output_is_passed_on_and_a_line_is_cut(run, provider, tmp_path):
    provider(node('a', 'say %s say %s sleep 1000' % ('short', 70000 * 'x'), 'output="screen"'))
    with server(run, str(tmp_path / 'a.launch'), quiet='quiet') as process:
        wait_for_line(process.stdout, b'short')
        assert process.stdout.readline() == 65536 * b'x' + b'\n'


def test_where_not_quiet_the_output_goes_to_the_same_place(run, provider, tmp_path):
    provider(node('a', 'say hello say %s sleep 1000' % (70000 * 'x'), 'output="screen"'))
    with server(run, str(tmp_path / 'a.launch')) as process:
        wait_for_line(process.stdout, b'hello')
        assert process.stdout.readline() == 70000 * b'x' + b'\n'


def test_a_node_that_writes_without_end_fills_no_memory(run, provider, tmp_path):
    provider(node('a', 'flood', 'output="screen"'))
    with server(run, str(tmp_path / 'a.launch'), quiet='quiet',
                stdout=subprocess.DEVNULL) as process:
        wait_for_line(process.stderr, b'started')

        def bytes_read():
            with open('/proc/%d/io' % process.pid) as stream:
                return int(stream.readline().partition('rchar: ')[2])

        begin = bytes_read()
        wait_until(lambda: bytes_read() > begin + 3e8)
        with open('/proc/%d/statm' % process.pid) as stream:
            megabytes = int(stream.read().split()[1]) * os.sysconf('SC_PAGE_SIZE') / 1e6
        assert megabytes < 100


def test_a_program_is_found_as_the_shell_finds_it(tmp_path):
    assert which('sh') == shutil.which('sh')
    assert which('no_such_program') is None
    assert which(sys.executable) == sys.executable
    assert which(str(tmp_path)) is None


def test_the_names_of_old_are_there(manager):
    assert launch_manager._special_nodelet_manager_capability == '!!nodelet_manager'
    manager._LaunchManager__quiet = manager._LaunchManager__screen = True
