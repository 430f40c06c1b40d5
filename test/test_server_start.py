"""How the capability server is configured, when it is ready, and what it makes of a reload."""
import os
import signal
from concurrent.futures import ThreadPoolExecutor

import pytest
from built import built

from capabilities.instances import USER_SERVICE_REASON
from made_packages import make_package
from robot import INTERFACE, PROVIDER, eventually, sleeper

WITHOUT = {'nodelet_manager': False}


def test_late_subscribers_are_told_that_it_is_ready(server):
    """A12: F20"""
    import rospy
    from capabilities.msg import CapabilityEvent
    server.start_capability('Base')
    server.wait_for('Base', 'running')
    events = []
    # a second subscriber of one node would share the connection of the first
    server._subscribers.pop(0).unregister()
    eventually(lambda: rospy.topics.get_topic_manager().get_subscriber_impl(
        server.name + '/events') is None)
    server._subscribers.insert(0, rospy.Subscriber(
        server.name + '/events', CapabilityEvent, server.events.append))
    server._subscribers[0].impl.add_callback(events.append, None)
    event = eventually(lambda: events and events[0])
    assert (event.type, event.capability, event.header.stamp.to_sec()) == (
        '"server_ready"', '', 0)
    assert len(events) == 1


def test_the_status_is_there_before_anybody_asks(server):
    """A12"""
    server.start_capability('Nav')
    message = eventually(lambda: server.status_message.capabilities and server.status_message)
    assert (message.server, message.ready) == (server.name, True)
    assert message.header.stamp.to_sec() > 1e9
    assert all(status.since.to_sec() > 1e9 for status in message.capabilities)


@pytest.mark.parametrize('parameters, lines', [
    ({'defaults': {'robot': {'Base': 'robot/nope'}}}, ['robot/nope']),
    ({'defaults': {'robot': {'Base': 'robot/nav', 'Nav': 'robot/base'}}},
     ["'robot/Nav' instead", "'robot/Base' instead"]),
    ({'missing_default_provider_is_an_error': True}, ["no default provider for 'robot/Two'"]),
    ({'on_dependency_lost': 'stpo'}, ["'stpo', expected stop or keep (did you mean 'stop'?)"]),
    ({'nodelet_manager_name': 'has blanks/!'}, ["'has blanks/!', which is not a legal node name"]),
    ({'defaults': 'robot/base', 'on_nodelet_manager_lost': 1}, ['~on_nodelet_manager_lost is']),
])
def test_a_bad_configuration_ends_it(robot, parameters, lines):
    """A15: F21"""
    server = robot.server(parameters)
    server.start()
    assert server.process.wait(60) == 255
    log = server.log.read_text()
    for line in lines:
        assert len([one for one in log.splitlines() if line in one]) == 1, log
    assert 'Traceback' not in log
    assert server.processes() == {}
    server.__exit__()


def test_it_says_that_package_paths_are_missing(monkeypatch):
    built('capabilities.msg')
    from capabilities import server
    monkeypatch.delenv('ROS_PACKAGE_PATH', raising=False)
    handlers = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)]
    try:
        with pytest.raises(SystemExit, match='No package paths specified'):
            server.main([])
    finally:
        for number, handler in zip((signal.SIGINT, signal.SIGTERM), handlers):
            signal.signal(number, handler)


def test_its_command_line():
    built('capabilities.msg')
    from capabilities.server import create_parser
    assert create_parser().parse_args(['a:b', '-s']).screen
    with pytest.raises(SystemExit):
        create_parser().parse_args(['a', 'b'])


def test_autostart_counts_as_an_explicit_start(robot):
    """A20"""
    with robot.server({**WITHOUT, 'autostart': ['robot/Nope', 'robot/Nav', 'robot/Two']}) as server:
        status = server.wait_for('Nav', 'running')
        assert status.started
        server.wait_for('Base', 'running')      # later, at times
        assert server.states() == {
            'Nope': 'failed', 'Nav': 'running', 'Base': 'running', 'Two': 'failed'}
        assert 'none is the default' in server.status('Two').text
        assert server.log.read_text().count('autostart of ') == 2
        bond = server.bond()
        server.use('Nav', bond.id)
        server.free('Nav', bond.id)
        assert server.running() == ['Base', 'Nav']
        assert server.types('server_ready', 'launched')[0] == ('server_ready', '')
        bond.shutdown()


@pytest.mark.parametrize('parameters, there, not_there', [
    ({'package_whitelist': ['other']}, [], ['robot/Base', 'robot/base', 'robot/SemGood']),
    ({'package_whitelist': [], 'whitelist': []}, ['robot/Base', 'robot/base'], []),
    ({'package_blacklist': ['robot']}, [], ['robot/Base', 'robot/base']),
    ({'whitelist': ['robot/Base', 'robot/base', 'robot/nav']}, ['robot/Base', 'robot/base'],
     ['robot/Nav', 'robot/nav', 'robot/SemGood']),
    ({'blacklist': ['robot/Good']}, ['robot/SemGood', 'robot/sem_good'],
     ['robot/Good', 'robot/good']),
    ({'blacklist': ['robot/SemGood']}, ['robot/Good', 'robot/good'],
     ['robot/SemGood', 'robot/sem_good']),
    ({'whitelist': 'invalid', 'blacklist': 7}, ['robot/Base', 'robot/base'], []),
])
def test_specs_are_filtered(robot, parameters, there, not_there):
    import logging
    from capabilities.catalogue import read_catalogue
    from capabilities.parameters import read_parameters
    logging.getLogger('rosout.capabilities')
    read = read_parameters(lambda name, default: parameters.get(name[1:], default))
    names = read_catalogue([str(robot.workspace)], read).spec_index.names
    assert set(there) <= set(names)
    assert not set(not_there) & set(names)


def test_the_specs_of_a_package_that_catkin_refuses_are_there(tmp_path):
    built('capabilities.msg')
    from capabilities.catalogue import read_catalogue
    from capabilities.parameters import read_parameters
    folder = make_package(
        tmp_path, 'ours', [('capability_interface', 'A.yaml')],
        A_yaml='name: A\nspec_version: 1\nspec_type: interface\n')
    manifest = (folder / 'package.xml').read_text()
    (folder / 'package.xml').write_text(manifest.replace('somebody@example.org', 'somebody'))
    read = read_parameters(lambda name, default: default)
    assert read_catalogue([str(tmp_path)], read).spec_index.names == ['ours/A']


@pytest.mark.parametrize('given', [
    {'robot': {'Two': 'robot/two_b'}}, {'robot/Two': 'robot/two_b'},
    {'robot': {'Two': 'robot/two_b', 'Nope': 'x/y'}, 'nobody': {'Here': 'x/y'}}])
def test_defaults_are_keys_or_paths_of_keys(robot, given):
    from capabilities.catalogue import read_catalogue
    from capabilities.parameters import read_parameters
    read = read_parameters(lambda name, default: given if name == '~defaults' else default)
    catalogue = read_catalogue([str(robot.workspace)], read)
    assert catalogue.defaults['robot/Two'] == 'robot/two_b'
    assert catalogue.defaults['robot/Base'] == 'robot/base'
    interfaces = catalogue.spec_index.interfaces
    assert interfaces['robot/Two'].default_provider == 'robot/two_b'
    assert interfaces['robot/None'].default_provider == 'unknown'


def test_a_default_may_be_a_provider_of_a_semantic_interface(robot):
    from capabilities.catalogue import read_catalogue
    from capabilities.parameters import read_parameters
    given = {'robot/Good': 'robot/sem_good'}
    read = read_parameters(lambda name, default: given if name == '~defaults' else default)
    assert read_catalogue([str(robot.workspace)], read).defaults['robot/Good'] == 'robot/sem_good'


def test_a_reload_touches_nothing_that_runs(robot):
    """A16: F17"""
    from made_packages import make_package
    with robot.server(WITHOUT) as server:
        server.start_capability('Good')
        pid = server.wait_for('Good', 'running').pid
        spec = robot.package / 'providers' / 'good.yaml'
        text = spec.read_text()
        new = None
        try:
            spec.unlink()
            new = make_package(robot.workspace, 'newcomer', [
                ('capability_interface', 'new.yaml'), ('capability_provider', 'provider.yaml')])
            (new / 'new.yaml').write_text(INTERFACE % 'New')
            (new / 'provider.yaml').write_text(
                PROVIDER % ('new', 'newcomer/New') + 'launch_file: new.launch\n')
            (new / 'new.launch').write_text('<launch>%s</launch>' % sleeper('new'))
            server.call('reload_capabilities')
            assert server.status('Good').pid == pid
            assert [(one.key, one.value) for one in server.call(
                'get_remappings', 'robot/good').topics] == [('image', 'good/image')]
            assert server.call('start_capability', 'newcomer/New', '').result == 0
            assert server.stop_capability('Good')
            assert 'no provider' in server.error('start_capability', 'robot/Good', '')
        finally:
            spec.write_text(text)
            if new is not None:
                for path in list(new.iterdir()):
                    path.unlink()
                new.rmdir()


def test_reloads_disturb_nobody(robot):
    """A16: while four clients start and stop"""
    with robot.server(WITHOUT) as server:
        def ask(name):
            for _ in range(5):
                assert server.start_capability(name) == 0
                assert server.stop_capability(name)
        with ThreadPoolExecutor(4) as pool:
            clients = [pool.submit(ask, name) for name in ('Base', 'Camera', 'Good', 'Nothing')]
            while not all(client.done() for client in clients):
                server.call('reload_capabilities')
            for client in clients:
                client.result()
        assert server.states() == {}


def test_a_reload_whose_defaults_are_at_fault_changes_nothing(robot):
    """A16"""
    with robot.server({**WITHOUT, 'defaults': {'robot/Two': 'robot/two_a'}}) as server:
        spec = robot.package / 'providers' / 'two_a.yaml'
        text = spec.read_text()
        try:
            spec.write_text(text.replace('robot/Two', 'robot/Base'))
            error = server.error('reload_capabilities')
            assert "the default provider 'robot/two_a' implements 'robot/Base' instead" in error
        finally:
            spec.write_text(text)
        assert server.start_capability('Two') == 0


def test_the_nodelet_manager_is_started_and_started_again(robot):
    """A14: F19"""
    with robot.server() as server:
        launched = eventually(lambda: [
            event for event in server.events if event.capability == '!!nodelet_manager'
            and event.type == '"launched"'] or server.processes() and [None])
        assert launched
        server.start_capability('Manager')
        server.start_capability('Camera')
        bond = server.bond()
        server.use('Manager', bond.id)
        before = server.wait_for('Manager', 'running').pid
        camera = server.wait_for('Camera', 'running').pid
        manager = next(pid for pid, command in server.processes().items()
                       if 'nodelet_manager.launch' in command)
        os.kill(manager, signal.SIGKILL)
        eventually(lambda: ('launched', '!!nodelet_manager') in server.types())
        status = eventually(lambda: server.status('Manager').state == 'running'
                            and server.status('Manager').pid != before
                            and server.status('Manager'))
        assert (status.started, status.uses) == (True, 1)
        assert server.status('Camera').pid == camera
        assert server.types('terminated').count(('terminated', '!!nodelet_manager')) == 1
        bond.shutdown()


def test_a_nodelet_manager_that_is_lost_again_and_again_ends_the_server(robot):
    """A14"""
    with robot.server() as server:
        killed = set()

        def manager():
            return next((pid for pid, command in server.processes().items()
                         if 'nodelet_manager.launch' in command and pid not in killed), None)
        for _ in range(3):
            pid = eventually(manager)
            killed.add(pid)
            os.kill(pid, signal.SIGKILL)
        assert server.process.wait(30) == 1
        assert server.processes() == {}


def test_without_its_nodelet_manager_it_may_end(robot):
    """A14"""
    with robot.server({'on_nodelet_manager_lost': 'stop'}) as server:
        server.start_capability('Camera')
        server.wait_for('Camera', 'running')
        manager = next(pid for pid, command in server.processes().items()
                       if 'nodelet_manager.launch' in command)
        os.kill(manager, signal.SIGKILL)
        assert server.process.wait(30) == 1
        assert server.processes() == {}
        assert 'nodelet manager terminated unexpectedly' in server.log.read_text()


def test_diagnostics_are_published_at_1_hz(server):
    """A22"""
    diagnostics = pytest.importorskip('diagnostic_msgs.msg')
    import rospy
    server.start_capability('Base')
    messages = []
    subscriber = rospy.Subscriber('/diagnostics', diagnostics.DiagnosticArray, messages.append)
    eventually(lambda: any(
        status.name == '%s: robot/Base' % server.name[1:] and 'provider' in [
            value.key for value in status.values]
        for message in messages for status in message.status))
    subscriber.unregister()


def test_it_warns_of_another_server(robot, server):
    with robot.server(WITHOUT) as second:
        assert 'there is another capability server, %s' % server.name in second.log.read_text()


def test_everything_goes_on_where_the_clock_stands_still(robot):
    """A26: times are of the wall clock"""
    import rospy
    rospy.set_param('/use_sim_time', True)
    try:
        with robot.server(WITHOUT) as server:
            bond_id = server.call('establish_bond').bond_id
            server.use('Crash', bond_id)
            assert server.wait_for('Crash', 'failed').since.to_sec() > 1e9
            server.use('Base', bond_id)
            server.wait_for('Base', 'running')
            eventually(lambda: 'Base' not in server.states())     # its bond never formed
            assert server.end() == 0
            assert server.processes() == {}
    finally:
        rospy.delete_param('/use_sim_time')


def test_old_code_that_makes_a_server_finds_its_names(robot):
    import rospy
    from capabilities.server import CapabilityServer
    assert USER_SERVICE_REASON == 'user service call'
    rospy.set_param('~defaults', {'robot/Base': 'robot/nope'})
    try:
        server = CapabilityServer([str(robot.workspace)])
        server._CapabilityServer__load_capabilities()
        with pytest.raises(SystemExit):
            server._CapabilityServer__populate_default_providers()
        server._CapabilityServer__stop_capability('x/Y')
        server.handle_capability_events(None)
        server.shutdown()
    finally:
        rospy.delete_param('~defaults')


def test_in_a_namespace_all_that_it_starts_is_in_that_namespace(robot):
    with robot.server(WITHOUT, name='ns/server_in_a_namespace') as server:
        assert server.call('get_nodelet_manager_name').nodelet_manager_name == (
            '/ns/server_in_a_namespace_nodelet_manager')
        server.start_capability('Base')
        pid = server.node_pid('base')
        with open('/proc/%d/environ' % pid) as environ:
            assert 'ROS_NAMESPACE=/ns' in environ.read().split('\0')


def test_without_a_master_a_signal_ends_it(robot):
    server = robot.server()
    robot_environment, robot.server_environment = robot.server_environment, dict(
        robot.server_environment, ROS_MASTER_URI='http://127.0.0.1:1')
    try:
        server.start()
    finally:
        robot.server_environment = robot_environment
    # It depends on how ROS is installed whether rospy shows that, or writes it to its own log only.
    eventually(lambda: any('Unable to register with master' in path.read_text() for path in (
        server.log, *(robot.folder / 'log').rglob(server.log.name))))
    assert server.end() == 0
    server.__exit__()
