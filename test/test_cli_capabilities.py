"""The verb capabilities, asked as a person asks it, of a real server."""
from __future__ import annotations

import json
import signal
import subprocess
import sys
from functools import partial

import pytest
from made_packages import make_package
from sources import ROOT

COMMAND = [sys.executable, str(ROOT / 'scripts' / 'rocon_uri'), 'capabilities']
APP = '''
display: Patrol
description: goes round
compatibility: rocon:/pr2
launch: patrol.launch
required_capabilities: [{name: robot/Nav}, {name: robot/Camera}]
'''
NO_MASTER = 'http://127.0.0.1:1'


def asked(server, verb, *arguments):
    """Run a verb on a server: its exit status, output and errors."""
    done = subprocess.run(
        [*COMMAND, verb, *arguments, '--server', server.name],
        env=server.robot.server_environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        universal_newlines=True)
    return done.returncode, done.stdout, done.stderr


@pytest.fixture
def capabilities(server):
    """Run a verb on the server of these tests, as `asked` does."""
    return partial(asked, server)


def test_list_has_the_capabilities_with_their_providers(capabilities):
    status, out, err = capabilities('list')
    assert (status, err) == (0, '')
    lines = out.splitlines()
    assert lines[lines.index('robot/Base') + 1] == '  * robot/base'
    two = lines.index('robot/Two')
    assert lines[two + 1:two + 3] == ['    robot/two_a', '    robot/two_b']
    assert lines[lines.index('robot/SemGood (redefines robot/Good)') + 1] == '  * robot/sem_good'


def test_a_capability_is_planned_started_shown_and_stopped(server, capabilities):
    assert capabilities('plan', 'robot/Nav') == (
        0, 'starts robot/Base by robot/base\nstarts robot/Nav by robot/nav\n', '')
    assert server.states() == {}
    assert capabilities('start', 'robot/Nav') == (0, 'robot/Nav: started\n', '')
    server.wait_for('Nav', 'running')
    assert capabilities('start', 'robot/Nav') == (0, 'robot/Nav: runs already\n', '')
    status, out, err = capabilities('status')
    assert (status, err) == (0, '')
    lines = [line.split() for line in out.splitlines()]
    assert lines[0] == ['capability', 'state', 'since', 'pid']
    assert [line[:2] for line in lines[1::2]] == [['robot/Base', 'running'],
                                                  ['robot/Nav', 'running']]
    assert out.splitlines()[2] == '    robot/base; wanted by robot/Nav'
    assert out.splitlines()[4] == '    robot/nav; wanted by start'
    assert max(map(len, out.splitlines())) <= 80
    assert capabilities('plan', 'robot/Nav')[1] == 'runs   robot/Nav by robot/nav\n'
    assert capabilities('stop', 'robot/Base') == (0, 'robot/Base: stopped\n', '')
    assert server.running() == []
    assert capabilities('status') == (0, 'nothing runs\n', '')
    status, out, err = capabilities('stop', 'robot/Base')
    assert (status, out) == (1, '') and "No Capability 'robot/Base' running" in err


def test_what_cannot_start_says_why_in_one_line(capabilities):
    for verb in 'start', 'plan':
        status, out, err = capabilities(verb, 'robot/Two')
        assert (status, out) == (1, '') and err.count('\n') == 1
        assert "'robot/two_a', 'robot/two_b'" in err
    status, _, err = capabilities('start', 'robot/Bsae')
    assert status == 1 and "did you mean 'robot/Base'" in err


def test_what_failed_is_in_the_exit_status(robot):
    with robot.server({'nodelet_manager': False}) as server:    # which remembers it
        server.start_capability('Crash')
        server.wait_for('Crash', 'failed')
        status, out, _ = asked(server, 'status', '--json')
    crash = next(one for one in json.loads(out)['capabilities']
                 if one['capability'] == 'robot/Crash')
    assert status == 1 and crash['state'] == 'failed' and crash['exit_code'] == 5
    assert crash['pid'] is None and 'node /crash died' in crash['text']


def test_every_verb_prints_one_json_object(server, capabilities):
    for arguments in (['list'], ['plan', 'robot/Base'], ['start', 'robot/Base'], ['status'],
                      ['stop', 'robot/Base'], ['start', 'robot/Nope']):
        answer = json.loads(capabilities(*arguments, '--json')[1])
        assert bool(answer['errors']) == ('robot/Nope' in arguments)


def test_watch_prints_events_until_the_server_has_gone(robot):
    with robot.server({'nodelet_manager': False}) as server:
        watch = subprocess.Popen(
            [*COMMAND, 'watch', '--json', '--server', server.name],
            env=robot.server_environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            universal_newlines=True)
        events = [json.loads(watch.stdout.readline())]
        server.start_capability('Base')
        server.stop_capability('Base')
        events += [json.loads(watch.stdout.readline()) for _ in range(3)]
    assert [(event['event'], event['capability']) for event in events] == [
        ('server_ready', ''), ('launched', 'robot/Base'), ('stopped', 'robot/Base'),
        ('terminated', 'robot/Base')]
    out, err = watch.communicate(timeout=60)
    assert (watch.returncode, out) == (0, '') and 'has gone' in err


def test_an_interrupt_ends_watch(server):
    watch = subprocess.Popen(
        [*COMMAND, 'watch', '--server', server.name], env=server.robot.server_environment,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
    watch.stdout.readline()
    watch.send_signal(signal.SIGINT)
    assert watch.communicate(timeout=60)[1] == b'' and watch.returncode == 130


def test_the_shell_completes_names_from_the_server(server):
    pytest.importorskip('argcomplete')
    line = 'rocon_uri capabilities start --server %s robot/Cam' % server.name
    done = subprocess.run(
        ['bash', '-c', 'exec "$@" 8>&1', 'bash', *COMMAND[:2]], stdout=subprocess.PIPE,
        universal_newlines=True, env=dict(
            server.robot.server_environment, COMP_LINE=line, COMP_POINT=str(len(line)),
            _ARGCOMPLETE='1', _ARGCOMPLETE_IFS=' '))
    assert done.stdout.split() == ['robot/Camera']


@pytest.fixture
def packages(server, tmp_path):
    """The packages of the robot, and an app that needs two of its capabilities."""
    package = make_package(tmp_path, 'apps', [('rocon_app', 'patrol.rapp')], patrol_rapp=APP)
    (package / 'patrol.launch').write_text('<launch/>')
    return ['--package-path', '%s:%s' % (server.robot.workspace, tmp_path), '--json',
            '--running', '--server', server.name]


def answer(server, *arguments):
    done = subprocess.run([*COMMAND[:2], *arguments], env=server.robot.server_environment,
                          stdout=subprocess.PIPE, universal_newlines=True)
    return json.loads(done.stdout)


def test_apps_say_which_of_their_capabilities_run(server, packages):
    asked = ['apps', '--robot', 'rocon:/pr2/bob', '--all', *packages]
    assert answer(server, *asked)['apps'][0]['running'] == {
        'robot/Nav': None, 'robot/Camera': None}
    server.start_capability('Nav')
    server.wait_for('Nav', 'running')
    assert answer(server, *asked)['apps'][0]['running'] == {
        'robot/Nav': 'robot/nav', 'robot/Camera': None}
    asked.remove('--json')
    done = subprocess.run([*COMMAND[:2], *asked], env=server.robot.server_environment,
                          stdout=subprocess.PIPE, universal_newlines=True)
    assert '      robot/Nav runs by robot/nav\n      robot/Camera does not run\n' in done.stdout


def test_the_graph_shows_what_runs(server, packages):
    server.start_capability('Nav')
    server.wait_for('Nav', 'running')
    nodes = answer(server, 'specs', 'graph', *packages)['nodes']
    assert {node['id'] for node in nodes if node['running']} == {
        'robot/Base', 'robot/base', 'robot/Nav', 'robot/nav'}
    packages.remove('--json')
    done = subprocess.run([*COMMAND[:2], 'specs', 'graph', *packages],
                          env=server.robot.server_environment, stdout=subprocess.PIPE,
                          universal_newlines=True)
    outlined = [line.split('"')[1] for line in done.stdout.splitlines() if 'penwidth=4' in line]
    assert outlined == ['robot/Base', 'robot/Nav', 'robot/base', 'robot/nav']


@pytest.mark.parametrize('verb', [['apps', '--robot', 'rocon:/pr2'], ['specs', 'graph']])
def test_what_runs_is_not_known_without_a_server(server, packages, verb):
    packages[-1] = 'nobody'
    assert "no capability server '/nobody'" in answer(
        server, *verb, *packages)['errors'][-1]['message']


@pytest.mark.parametrize('arguments', [['status'], ['list'], ['start', 'a/B'], ['watch']])
def test_without_a_master_or_a_server_it_says_so(robot, arguments):
    for environment, said in (
            (dict(robot.server_environment, ROS_MASTER_URI=NO_MASTER), 'no ROS master answers at'),
            (robot.server_environment, "no capability server '/nobody'")):
        done = subprocess.run([*COMMAND, *arguments, '--server', 'nobody'], env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              universal_newlines=True)
        assert (done.returncode, done.stdout) == (2, '')
        assert done.stderr.count('\n') == 1 and said in done.stderr
