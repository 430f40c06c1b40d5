"""What clients of old rely on, and what a server has to stand: many at once, and bad timing."""
import json
import os
import signal
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
from made_packages import make_package
from robot import eventually


def at_once(count, do):
    """What a function gives that many threads call at the same time, with the number of each."""
    barrier = threading.Barrier(count)

    def run(number):
        barrier.wait()
        return do(number)
    with ThreadPoolExecutor(count) as pool:
        return list(pool.map(run, range(count)))


def environment(pid):
    """The environment of a process, as a dict."""
    with open('/proc/%d/environ' % pid) as file:
        return dict(entry.partition('=')[::2] for entry in file.read().split('\0') if entry)


def test_what_runs_is_listed_with_its_dependents_and_who_started_it(server):
    """1.5 get_running_capabilities"""
    server.start_capability('Patrol')
    for name in 'Base', 'Nav', 'Patrol':
        server.wait_for(name, 'running')
    running = server.call('get_running_capabilities').running_capabilities
    assert [(one.capability.capability, one.capability.provider, one.started_by,
             [(other.capability, other.provider) for other in one.dependent_capabilities])
            for one in running] == [
        ('robot/Base', 'robot/base', 'robot/nav', [('robot/Nav', 'robot/nav')]),
        ('robot/Nav', 'robot/nav', 'robot/patrol', [('robot/Patrol', 'robot/patrol')]),
        ('robot/Patrol', 'robot/patrol', 'user service call', [])]
    processes = server.processes()
    assert ['%s.launch' % name in processes[one.pid] for name, one in zip(
        ('base', 'nav', 'patrol'), running)] == [True] * 3


def test_a_start_of_what_waits_answers_1_and_of_what_stops_3(server):
    """1.5 start_capability, A19"""
    server.start_capability('Slow')
    server.stubborn_node_pid('slow')
    stop = ThreadPoolExecutor(1).submit(server.stop_capability, 'Slow')
    server.wait_for('Slow', 'stopping')
    assert server.start_capability('Slow') == 3
    assert server.start_capability('OnSlow') == 0
    assert server.start_capability('OnSlow') == 1
    assert server.start_capability('Slow') == 3
    assert [(status.capability, status.state) for status in server.statuses()
            if status.state != 'failed'] == [
        ('robot/Slow', 'stopping'), ('robot/Slow', 'waiting'), ('robot/OnSlow', 'waiting')]
    stop.result()
    server.wait_for('OnSlow', 'running')
    assert server.start_capability('OnSlow') == 2
    assert server.types() == [
        ('launched', 'Slow'), ('stopped', 'Slow'), ('terminated', 'Slow'), ('launched', 'Slow'),
        ('launched', 'OnSlow')]


def test_a_bond_may_use_a_capability_several_times(server):
    """1.5 use_capability, free_capability"""
    one, two = server.bond(), server.bond()
    server.use('Base', one.id)
    server.use('Base', one.id)
    server.use('Base', two.id)
    assert server.status('Base').uses == 3
    server.free('Base', one.id)
    server.free('Base', one.id)
    assert "Given bond_id '%s' not associated with given capability 'robot/Base'" % one.id in (
        server.error('free_capability', 'robot/Base', one.id))
    assert server.running() == ['Base']
    server.free('Base', two.id)
    assert server.running() == []
    one.shutdown()
    two.shutdown()


def test_events_have_a_stamp_and_the_process_id(server):
    """1.3"""
    server.start_capability('Base')
    pid = server.call('get_running_capabilities').running_capabilities[0].pid
    server.stop_capability('Base')
    server.wait_for_all_events()
    assert [(event.type, event.capability, event.provider, event.pid) for event in server.events
            ] == [('"%s"' % kind, 'robot/Base', 'robot/base', pid)
                  for kind in ('launched', 'stopped', 'terminated')]
    stamps = [event.header.stamp.to_sec() for event in server.events]
    assert stamps == sorted(stamps) and stamps[0] > 1e9


def test_the_nodelet_manager_has_events_of_its_own(robot):
    """1.3, 1.1: and the arguments of the node reach the environment of what it starts"""
    with robot.server() as server:
        server.start_capability('Manager')
        variables = environment(server.node_pid('nodelet'))
        known = robot.server_environment['ROS_PACKAGE_PATH']
        assert variables['ROS_PACKAGE_PATH'] == '%s:%s' % (known, robot.workspace)
        assert variables['ROS_MASTER_URI'] == robot.master.uri
        assert server.end() == 0
        eventually(lambda: ('terminated', '!!nodelet_manager') in server.types())
        [ready] = {event.header.stamp.to_sec() for event in server.events
                   if event.type == '"server_ready"'}
        assert ready == 0
    of_manager = [event for event in server.events if event.capability == '!!nodelet_manager']
    assert {event.type for event in of_manager} >= {'"stopped"', '"terminated"'}
    assert {event.provider for event in of_manager} == {server.name[1:] + '_nodelet_manager'}


def test_lists_of_another_type_are_logged_and_not_used(robot):
    """1.2"""
    lists = 'whitelist', 'blacklist', 'package_whitelist', 'package_blacklist', 'autostart'
    with robot.server(dict.fromkeys(lists, 'invalid'), name='with_invalid_lists') as server:
        assert server.start_capability('Base') == 0
        log = server.log.read_text()
        for name in lists:
            assert 'parameter ~%s is not a list of names' % name in log


def test_the_heartbeat_timeout_can_be_turned_off(robot):
    """1.10: who stands in a debugger keeps what it uses"""
    import rospy
    from bond.msg import Status
    rospy.set_param('/bond_disable_heartbeat_timeout', True)
    try:
        with robot.server({'nodelet_manager': False}) as server:
            bond_id = server.call('establish_bond').bond_id
            publisher = rospy.Publisher(server.name + '/bonds', Status, queue_size=10)
            eventually(lambda: publisher.get_num_connections() > 0)
            server.use('Base', bond_id)
            publisher.publish(Status(id=bond_id, instance_id='somebody', active=True,
                                     heartbeat_timeout=4, heartbeat_period=1))
            eventually(lambda: 'Heartbeat timeout is disabled' in server.log.read_text())
            assert server.status('Base').uses == 1
            publisher.unregister()
    finally:
        rospy.delete_param('/bond_disable_heartbeat_timeout')


def test_many_starts_at_once_make_one_process(server):
    """A23, A24"""
    results = at_once(200, lambda number: server.start_capability('Nav'))
    assert results.count(0) == 1 and set(results) <= {0, 1, 2}
    assert server.running() == ['Base', 'Nav']
    assert server.types('launched') == [('launched', 'Base'), ('launched', 'Nav')]


def test_many_stops_and_frees_at_once_are_answered(server):
    """A23, A24"""
    bond = server.bond()
    for _ in range(50):
        server.use('Nav', bond.id)
    errors = at_once(100, lambda number: server.error(
        *(('free_capability', 'robot/Nav', bond.id) if number % 2 else
          ('stop_capability', 'robot/Nav'))))
    for error in errors:
        assert not error or 'because it is not running' in error or 'not associated' in error or (
            "No Capability 'robot/Nav' running" in error), error
    assert server.running() == []
    bond.shutdown()


def test_many_bonds_that_never_form_are_forgotten(server):
    """1.10, A23"""
    bonds = at_once(100, lambda number: server.call('establish_bond').bond_id)
    assert len(set(bonds)) == 100
    for bond in bonds[:20]:
        server.use('Base', bond)
    assert server.status('Base').uses == 20
    eventually(lambda: server.running() == [])
    assert 'Invalid bond_id given to ~use_capability' in server.error(
        'use_capability', 'robot/Base', '', bonds[0])


@pytest.mark.parametrize('text', ['x' * 5000000, 'robot/' + 'Base' * 100000, '\u202e/' * 200000])
def test_long_texts_are_answered(server, text):
    """A23"""
    for service, arguments in (
            ('start_capability', (text, text)), ('start_capability', ('robot/Base', text)),
            ('stop_capability', (text,)), ('get_providers', (text, True)),
            ('free_capability', (text, text)), ('use_capability', (text, text, text)),
            ('get_capability_spec', (text,)), ('get_remappings', (text,))):
        error = server.error(service, *arguments)
        assert 'responded with an error' in error and 'internal' not in error
    assert server.start_capability('Base') == 0


def test_a_launch_file_that_never_finishes_disturbs_nobody(server):
    """A8, A23: a command in it does not end"""
    assert server.start_capability('OnHangs') == 0
    eventually(lambda: any('sleep 10000' in command for command in server.processes().values()))
    assert server.status('Hangs').state == 'launching'
    assert server.start_capability('Base') == 0
    server.wait_for('OnHangs', 'running')
    server.stop_capability('Hangs')
    assert server.running() == ['Base']
    eventually(lambda: not any('sleep 10000' == command.strip()
                               for command in server.processes().values()))


def test_a_launch_file_that_breaks_after_it_was_read_is_seen(server, robot):
    """A5: the next start reads it again"""
    file = robot.package / 'providers' / 'changes.launch'
    text = file.read_text()
    try:
        assert server.call('plan_capability', 'robot/Changes', '').faults == []
        file.write_text('<launch')
        assert 'changes.launch' in server.error('start_capability', 'robot/Changes', '')
        assert server.status('Changes') is None
        # roslaunch finds fault with it, we do not
        file.write_text('<launch><node pkg="nope"/></launch>')
        assert server.start_capability('Changes') == 0
        failed = server.wait_for('Changes', 'failed')
        assert failed.exit_code == 1 and 'unexpected' in failed.text
        file.unlink()
        assert 'changes.launch' in server.error('start_capability', 'robot/Changes', '')
    finally:
        file.write_text(text)
    assert server.start_capability('Changes') == 0


def test_a_frozen_node_disturbs_nobody_and_ends(server):
    """A8: SIGSTOP"""
    server.start_capability('Camera')
    server.wait_for('Camera', 'running')
    os.kill(server.node_pid('camera'), signal.SIGSTOP)
    stop = ThreadPoolExecutor(1).submit(server.stop_capability, 'Camera')
    server.wait_for('Camera', 'stopping')
    assert server.start_capability('Base') == 0
    server.wait_for('Base', 'running')
    stop.result()
    assert server.running() == ['Base']


def test_a_frozen_roslaunch_ends_with_the_server(robot):
    """A9: SIGSTOP"""
    with robot.server({'nodelet_manager': False}) as server:
        server.start_capability('Nav')
        server.wait_for('Nav', 'running')
        for one in server.call('get_running_capabilities').running_capabilities:
            os.kill(one.pid, signal.SIGSTOP)
        assert server.end() == 0
        assert server.processes() == {}


def test_remappings_are_followed_through_all_that_it_depends_on():
    """1.5 get_remappings"""
    from capabilities.merged_remappings import merged_remappings
    from capabilities.specs.provider import CapabilityProvider

    def provider(**topics):
        return CapabilityProvider('p', 1, 'p/P', remappings={'topics': topics})
    below = provider(distance='robot/front/distance')
    assert merged_remappings([below, provider(**{'front/distance': 'distance'})])['topics'] == {
        'front/distance': 'robot/front/distance'}
    # two that stand on the same
    assert merged_remappings([below, provider(left='distance'), provider(right='distance')])[
        'topics'] == {'left': 'robot/front/distance', 'right': 'robot/front/distance'}
    # the same as its dependency
    assert merged_remappings([below, provider(distance='distance')])['topics'] == {
        'distance': 'robot/front/distance'}
    # a chain of three
    assert merged_remappings([provider(a='b'), provider(c='a'), provider(d='c')])['topics'] == {
        'd': 'b'}


FAULTY = 'Two', 'Broken', 'Missing', 'Loop', 'Pool', 'None'


def test_apps_start_and_plan_say_why_not_in_one_wording(server, robot, tmp_path, capsys):
    """A5: character for character"""
    from rocon_uri.cli import main
    make_package(tmp_path, 'apps', [('rocon_app', 'a%s.rapp' % name) for name in FAULTY], **{
        'a%s_rapp' % name: '{compatibility: "rocon:/", launch: app.launch, required_capabilities: '
        '[{name: robot/%s}]}' % name for name in FAULTY}, app_launch='<launch/>')
    main(['apps', '--json', '--all', '--robot', 'rocon:/pc/bob', '--package-path',
          '%s:%s' % (tmp_path, robot.workspace)])
    apps = {app['name']: [reason['text'] for reason in app['reasons']]
            for app in json.loads(capsys.readouterr().out)['apps']}
    bond = server.bond()
    for name in FAULTY:
        reasons = apps['apps/a' + name]
        assert reasons
        assert server.call('plan_capability', 'robot/' + name, '').faults == reasons
        for arguments in (('start_capability', 'robot/' + name, ''),
                          ('use_capability', 'robot/' + name, '', bond.id)):
            assert 'error processing request: ' + '; '.join(reasons) in server.error(*arguments)
    assert server.states() == {}
    bond.shutdown()


def test_the_parameter_use_screen_counts_more_than_the_option():
    """1.1"""
    pytest.importorskip('rospy')
    from capabilities.parameters import read_parameters
    assert read_parameters(lambda name, default: default, True).use_screen is True
    given = {'~use_screen': False}
    assert read_parameters(given.get, True).use_screen is False
