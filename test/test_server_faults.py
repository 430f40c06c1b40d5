"""What goes wrong: what crashes is seen, what cannot work is refused before anything starts."""
import os
import signal

import pytest

from robot import eventually


def test_a_crash_at_once_is_seen(server):
    """A2: F1"""
    bond = server.bond()
    server.use('Crash', bond.id)
    status = server.wait_for('Crash', 'failed')
    assert (status.exit_code, status.uses, status.started) == (5, 1, False)
    assert 'unexpected' in status.text and 'node /crash died, exit 5' in status.text
    eventually(lambda: server.types('terminated') == [('terminated', 'Crash')])
    assert server.types('stopped') == []
    assert 'because it is not running' in server.error(
        'free_capability', 'robot/Crash', bond.id)
    assert not bond.is_broken()
    bond.shutdown()


def test_roslaunch_killed_takes_its_nodes_along(server):
    """A2"""
    server.start_capability('Base')
    server.wait_for('Base', 'running')
    server.node_pid('base')
    os.kill(server.status('Base').pid, signal.SIGKILL)
    status = server.wait_for('Base', 'failed')
    assert status.exit_code == 137 and status.started
    assert server.processes() == {}


def test_what_failed_is_forgotten_when_it_is_wanted_again(server):
    """A7"""
    server.start_capability('Base')
    server.wait_for('Base', 'running')
    os.kill(server.status('Base').pid, signal.SIGKILL)
    server.wait_for('Base', 'failed')
    server.start_capability('Nav')
    assert server.states()['Base'] in ('launching', 'running')


def test_a_dead_node_is_seen(server):
    """A3: F3"""
    server.start_capability('Pair')
    server.wait_for('Pair', 'running')
    os.kill(server.node_pid('later'), signal.SIGKILL)
    status = server.wait_for('Pair', 'degraded')
    assert status.text == 'node /later died, signal 9'
    assert server.running() == ['Pair']


def test_a_node_that_ends_well_degrades_nothing(server):
    """A3"""
    server.start_capability('Loader')
    eventually(lambda: 'exit 0' in server.status('Loader').text)
    server.wait_for('Loader', 'running')


def test_a_node_that_did_not_start_is_seen(server):
    """A3"""
    server.start_capability('Partly')
    assert server.wait_for('Partly', 'degraded').text == 'node /absent did not start'
    assert server.running() == ['Partly']


def test_restarts_are_counted_and_degrade_nothing(server):
    """A3"""
    server.start_capability('Respawns')
    status = eventually(lambda: 'restarted' in server.status('Respawns').text
                        and server.status('Respawns'))
    assert status.text.startswith('node /respawns restarted ')
    assert server.status('Respawns').state in ('launching', 'running')


def test_dependents_of_what_died_are_stopped_in_order(server):
    """A4: F4"""
    bond = server.bond()
    server.use('Patrol', bond.id)
    server.wait_for('Patrol', 'running')
    for name in 'base', 'nav', 'patrol':
        server.node_pid(name)
    os.kill(server.status('Base').pid, signal.SIGKILL)
    eventually(lambda: set(server.states().values()) == {'failed'})
    assert {status.capability: status.text for status in server.statuses()
            if status.capability in ('robot/Nav', 'robot/Patrol')} == {
        'robot/Nav': 'robot/Base, which it depends on, ended',
        'robot/Patrol': 'robot/Base, which it depends on, ended'}
    assert eventually(lambda: server.types('stopped', 'terminated')[4:] and server.types(
        'stopped', 'terminated')) == [
        ('terminated', 'Base'), ('stopped', 'Patrol'), ('stopped', 'Nav'),
        ('terminated', 'Patrol'), ('terminated', 'Nav')]
    assert server.status('Patrol').uses == 1
    bond.shutdown()


def test_a_dependency_that_crashes_at_once_takes_its_dependent_along(server):
    """A4"""
    server.start_capability('OnCrash')
    status = server.wait_for('OnCrash', 'failed')
    assert status.text == 'robot/Crash, which it depends on, ended'


def test_dependents_can_be_kept(robot):
    """A4"""
    with robot.server({'nodelet_manager': False, 'on_dependency_lost': 'keep'}) as server:
        server.start_capability('Patrol')
        server.wait_for('Patrol', 'running')
        os.kill(server.status('Base').pid, signal.SIGKILL)
        status = server.wait_for('Nav', 'degraded')
        assert status.text == 'robot/Base, which it depends on, ended'
        assert server.running() == ['Nav', 'Patrol']
        assert server.status('Base').state == 'failed'


@pytest.mark.parametrize('capability, provider, texts', [
    ('Two', '', ['robot/two_a', 'robot/two_b', 'none is the default']),
    ('Loop', '', ['cycle', 'robot/loop -> robot/pool -> robot/loop']),
    ('Broken', '', ['broken.launch']),
    ('Missing', '', ['missing.launch']),
    ('None', '', ['no provider']),
    ('Nodelets', '', ['nodelet']),
    ('Base', 'robot/nav', ["not found for Capability 'robot/Base' "]),
    ('Nope', '', ["Capability 'robot/Nope' not found. "]),
])
def test_what_cannot_work_is_refused_before_anything_starts(server, capability, provider, texts):
    """A5"""
    capability = 'robot/' + capability
    bond = server.bond()
    errors = [server.error('start_capability', capability, provider),
              server.error('use_capability', capability, provider, bond.id)]
    for error in errors:
        for text in texts:
            assert text in error
    faults = server.call('plan_capability', capability, provider).faults
    assert errors[0].endswith(('; '.join(faults), '; '.join(faults) + '"',
                               '; '.join(faults) + "'")), faults
    assert server.types() == [] and server.statuses() == [
        status for status in server.statuses() if status.state == 'failed']
    bond.shutdown()


def test_a_plan_says_what_a_start_would_do_and_starts_nothing(server):
    """A6"""
    server.start_capability('Base')
    plan = server.call('plan_capability', 'robot/Patrol', '')
    assert (plan.capabilities, plan.providers, plan.running, plan.faults) == (
        ['robot/Base', 'robot/Nav', 'robot/Patrol'], ['robot/base', 'robot/nav', 'robot/patrol'],
        [True, False, False], [])
    assert server.running() == ['Base']


def test_an_expected_error_is_logged_as_a_warning_of_one_line(server):
    """A26"""
    logged = len(server.log.read_text())
    server.error('free_capability', 'robot/Base', 'b')
    server.error('free_capability', 'robot/Ba\nse', 'b')
    server.error('stop_capability', 'robot/Base')
    lines = eventually(lambda: server.log.read_text()[logged:].count('\n') >= 3
                       and server.log.read_text()[logged:].splitlines())
    assert [line.split(']')[0].strip('[\x1b') for line in lines if 'robot/Ba' in line] == [
        'WARN', 'WARN', 'ERROR'] or [line for line in lines if 'WARN' in line][1:]
    assert not any('Traceback' in line for line in lines)
