"""The runner of launch files reports what becomes of the nodes, and ends when it is told to."""
from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import threading

import pytest

from capabilities.launch import Report
from ros_master import Master, make_test_nodes, node

pytest.importorskip('roslaunch', reason='ROS is not installed')

PATIENCE = 60
RUNNER = os.path.join(os.path.dirname(sys.modules[Report.__module__].__file__), 'runner.py')


class Runner:
    """A running runner: its reports, as they come."""

    def __init__(self, launch_file, environment, arguments=(), **options):
        reading, writing = os.pipe()
        self.process = subprocess.Popen(
            [sys.executable, RUNNER, str(launch_file)], env=environment, pass_fds=(writing,),
            start_new_session=True, stdin=subprocess.PIPE, **options)
        os.close(writing)
        self.process.stdin.write(json.dumps({
            'arguments': list(arguments), 'screen': False, 'reports': writing}).encode())
        self.process.stdin.close()
        self._stream = os.fdopen(reading)
        self.timer = threading.Timer(PATIENCE, self.process.kill)
        self.timer.start()

    def report(self):
        """The next report, as a tuple of kind, node, what; None at the end."""
        line = self._stream.readline()
        if not line:
            return None
        data = json.loads(line)
        if data['kind'] == 'error':
            return ('error', data['text'])
        report = Report(**dict(data, nodes=tuple(data.get('nodes', ()))))
        return (report.kind, *(report.nodes if report.kind == 'started' else (report.text,)))

    def until(self, kind):
        """The reports up to the next of a kind."""
        reports = []
        while not reports or reports[-1] is not None and reports[-1][0] != kind:
            reports.append(self.report())
        return reports

    def end(self):
        """The rest of the reports, and the exit status."""
        reports = []
        while True:
            report = self.report()
            if report is None:
                return reports, self.process.wait()
            reports.append(report)

    def close(self):
        self.timer.cancel()
        self.process.terminate()
        self.end()
        self._stream.close()


@pytest.fixture
def run(master, tmp_path):
    """Run a launch file of these lines."""
    runners = []

    def run(*lines, environment=master.environment, **options):
        path = tmp_path / 'a.launch'
        path.write_text('<launch>\n%s\n</launch>\n' % '\n'.join(lines))
        runners.append(Runner(path, environment, **options))
        return runners[-1]

    yield run
    for runner in runners:
        runner.close()


def test_a_node_that_dies_at_once(run):
    reports, status = run(node('a', 'exit 5')).end()
    assert sorted(reports) == [('died', 'node /a died, exit 5'), ('started', '/a')]
    assert status == 5


def test_a_node_that_dies_later_beside_one_that_lives(run):
    runner = run(node('lives', 'sleep 1000'), node('later', 'sleep 0.5 exit 7'))
    assert runner.until('died') == [
        ('started', '/lives', '/later'), ('died', 'node /later died, exit 7')]
    assert runner.process.poll() is None
    runner.process.terminate()
    assert runner.end() == ([], 7)


def test_a_node_that_dies_of_a_signal(run):
    reports, status = run(node('a', 'sleep 0.3 kill 9')).end()
    assert reports[-1] == ('died', 'node /a died, signal 9')
    assert status == 128 + 9


def test_the_exit_code_is_that_of_the_node_that_ended_last_with_another_than_0(run):
    reports, status = run(node('a', 'sleep 0.2 exit 3'), node('b', 'sleep 0.9 exit 4'),
                          node('c', 'sleep 1.6 exit 0')).end()
    assert [text for kind, *text in reports if kind == 'died'] == [
        ['node /a died, exit 3'], ['node /b died, exit 4'], ['node /c died, exit 0']]
    assert status == 4


def test_nodes_that_end_with_0_have_done_their_work(run):
    reports, status = run(node('a', 'exit 0')).end()
    assert ('died', 'node /a died, exit 0') in reports
    assert status == 0


@pytest.mark.parametrize('count', [6, 16])
def test_of_many_nodes_one_that_dies_at_once_is_not_missed(run, count):
    runner = run(node('first', 'exit 5'),
                 *[node('n%d' % number, 'sleep 1000') for number in range(count)])
    reports = runner.until('started')
    if ('died', 'node /first died, exit 5') not in reports:
        reports += runner.until('died')
    assert ('died', 'node /first died, exit 5') in reports


def test_a_required_node_ends_the_launch(run):
    reports, status = run(node('lives', 'sleep 1000'),
                          node('must', 'sleep 0.5 exit 6', 'required="true"')).end()
    assert reports[-1] == ('died', 'node /must died, exit 6')
    assert status == 6


def test_a_node_that_is_restarted_is_counted_and_not_dead(run):
    runner = run(node('again', 'sleep 0.1 exit 1', 'respawn="true" respawn_delay="0.6"'))
    reports = runner.until('restarted') + runner.until('restarted')
    assert [report for report in reports if report[0] != 'started'] == [
        ('restarted', 'node /again restarted once'),
        ('restarted', 'node /again restarted 2 times')]
    runner.process.terminate()
    reports, status = runner.end()
    assert status == 0
    assert {kind for kind, *_ in reports} <= {'restarted'}


def test_a_node_without_an_executable_did_not_start(run):
    runner = run(node('a', 'sleep 1000'),
                 '<node pkg="test_nodes" type="not_there" name="b" ns="below"/>')
    assert runner.until('started') == [
        ('missing', 'node /below/b did not start'), ('started', '/a')]


def test_where_no_node_starts_the_launch_ends(run):
    reports, status = run('<node pkg="no_such_package" type="a" name="a"/>').end()
    assert reports == [('missing', 'node /a did not start'), ('started',)]
    assert status == 0


def test_a_launch_file_without_nodes_ends(run):
    assert run('<param name="a" value="1"/>').end() == ([('started',)], 0)


def test_a_prefix_that_cannot_be_run_ends_what_was_started(run):
    reports, status = run(
        node('a', 'sleep 1000'), node('b', 'sleep 1', 'launch-prefix="no_such_prefix"')).end()
    assert reports[0] == ('missing', 'node /b did not start')
    assert reports[1][0] == 'error' and 'no_such_prefix' in reports[1][1]
    assert status == 1


def test_a_launch_file_that_cannot_be_loaded_is_an_error(run):
    reports, status = run('<node pkg="test_nodes" type="node"/>').end()
    assert [kind for kind, _ in reports] == ['error']
    assert "'name'" in reports[0][1] or 'name' in reports[0][1]
    assert status == 1


def test_arguments_come_by_standard_input_and_unknown_ones_are_ignored(run):
    runner = run('<arg name="who" default="nobody"/>', node('$(arg who)', 'sleep 1000'),
                 arguments=['who:=somebody', 'unknown:=1'])
    assert runner.report() == ('started', '/somebody')
    with open('/proc/%d/cmdline' % runner.process.pid) as stream:
        command = stream.read().rstrip('\0').split('\0')
    assert command[1:2] == [RUNNER] and len(command) == 3 and command[2].endswith('/a.launch')
    assert 'capability_server' not in ' '.join(command)


def test_nodes_start_in_the_namespace_of_the_environment(run, master):
    runner = run(node('a', 'sleep 1000'),
                 environment=dict(master.environment, ROS_NAMESPACE='/robot'))
    assert runner.report() == ('started', '/robot/a')


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_stops_the_nodes_first(run, number):
    runner = run(node('a', 'sleep 1000'))
    runner.until('started')
    runner.process.send_signal(number)
    assert runner.end() == ([], 0)


def test_sigint_counts_where_it_was_inherited_as_ignored(run):
    runner = run(node('a', 'sleep 1000'), preexec_fn=lambda: signal.signal(
        signal.SIGINT, signal.SIG_IGN))
    runner.until('started')
    runner.process.send_signal(signal.SIGINT)
    assert runner.end() == ([], 0)


def test_a_second_signal_does_not_hurry_it(run):
    runner = run(node('a', 'sleep 1000'))
    runner.until('started')
    runner.process.send_signal(signal.SIGTERM)
    runner.process.send_signal(signal.SIGINT)
    assert runner.end() == ([], 0)


def test_without_a_master_none_is_started(run, master):
    with socket.socket() as nobody:
        nobody.bind(('127.0.0.1', 0))       # and does not listen
        uri = 'http://127.0.0.1:%d' % nobody.getsockname()[1]
        reports, status = run(
            node('a', 'sleep 1000'), environment=dict(master.environment, ROS_MASTER_URI=uri)).end()
    assert reports[0][0] == 'error'
    assert reports[0][1].startswith('cannot contact the master at ' + uri)
    assert status == 1


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_as_long_as_there_are_no_nodes_a_signal_ends_it_at_once(run, master, number):
    with socket.socket() as silent:         # a master that takes the call and never answers
        silent.bind(('127.0.0.1', 0))
        silent.listen(1)
        uri = 'http://127.0.0.1:%d' % silent.getsockname()[1]
        runner = run(node('a', 'sleep 1000'),
                     environment=dict(master.environment, ROS_MASTER_URI=uri))
        silent.accept()[0].recv(1)          # it waits for the answer now
        runner.process.send_signal(number)
        assert runner.end() == ([], 128 + number)


def test_the_run_id_that_another_start_has_set_meanwhile_is_taken(tmp_path):
    make_test_nodes(tmp_path / 'src')
    launch_file = tmp_path / 'a.launch'
    launch_file.write_text('<launch>%s</launch>' % node('$(anon a)', 'sleep 1000'))
    # A bare master has no /run_id, so several starts at once each want to set one.
    with Master(tmp_path, tmp_path / 'src') as master:
        subprocess.run(['rosparam', 'delete', '/run_id'], env=master.environment, check=True)
        runners = [Runner(launch_file, master.environment) for _ in range(4)]
        try:
            assert [runner.report()[0] for runner in runners] == ['started'] * 4
        finally:
            for runner in runners:
                runner.close()
