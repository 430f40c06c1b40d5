"""The services of the capability server, asked as its clients of old ask them."""
import pytest

from robot import INTERFACE, eventually


def remappings(server, spec):
    return [(one.key, one.value) for one in server.call('get_remappings', spec).topics]


def test_a_capability_is_started_listed_and_stopped(server):
    assert server.start_capability('Nav') == 0
    running = {one.capability.capability: one
               for one in server.call('get_running_capabilities').running_capabilities}
    assert set(running) == {'robot/Base', 'robot/Nav'}
    assert running['robot/Nav'].started_by == 'user service call'
    assert running['robot/Base'].started_by == 'robot/nav'
    assert [one.capability for one in running['robot/Base'].dependent_capabilities] == ['robot/Nav']
    assert running['robot/Nav'].pid > 0
    assert server.start_capability('Nav') == 2
    server.wait_for('Nav', 'running')
    assert server.stop_capability('Base') is True
    assert server.running() == []
    assert server.processes() == {}
    eventually(lambda: len(server.types('terminated')) == 2)
    assert server.types('launched', 'stopped', 'terminated') == [
        ('launched', 'Base'), ('launched', 'Nav'), ('stopped', 'Nav'), ('stopped', 'Base'),
        ('terminated', 'Nav'), ('terminated', 'Base')]


def test_the_types_of_events_contain_their_quotation_marks(server):
    server.start_capability('Nothing')
    event = eventually(lambda: server.events and server.events[0])
    assert (event.type, event.capability, event.provider) == (
        '"launched"', 'robot/Nothing', 'robot/nothing')
    assert event.pid == server.status('Nothing').pid
    assert event.header.stamp.to_sec() > 1e9


def test_a_provider_without_launch_file_runs_a_placeholder(server):
    server.start_capability('Nothing')
    server.wait_for('Nothing', 'running')
    assert server.stop_capability('Nothing')
    assert server.running() == []


@pytest.mark.parametrize('service, arguments, error', [
    ('start_capability', ('x/Y', ''), "Capability 'x/Y' not found."),
    ('start_capability', ('robot/Base', 'robot/nav'),
     "Capability Provider 'robot/nav' not found for Capability 'robot/Base'"),
    ('start_capability', ('robot/Base', 'x/y'),
     "Capability Provider 'x/y' not found for Capability 'robot/Base'"),
    ('stop_capability', ('robot/Base',), "No Capability 'robot/Base' running"),
    ('use_capability', ('robot/Base', '', 'b'), "Invalid bond_id given to ~use_capability: 'b'"),
    ('free_capability', ('robot/Base', 'b'),
     "Cannot free Capability 'robot/Base', because it is not running"),
    ('get_providers', ('x/Y', False), "Capability Interface 'x/Y' not found."),
    ('get_capability_spec', ('x/Y',), "Could not find requested spec 'x/Y'"),
    ('get_remappings', ('robot/Base',),
     "Spec 'robot/Base' is neither a running Interface nor a running Provider."),
])
def test_the_texts_of_errors_are_those_of_old(server, service, arguments, error):
    text = server.error(service, *arguments)
    assert 'responded with an error: ' in text
    assert 'error processing request: ' + error in text


def test_a_use_starts_and_a_free_stops(server):
    bond = server.bond()
    server.use('Base', bond.id)
    server.use('Base', bond.id)
    assert server.running() == ['Base']
    assert server.status('Base').uses == 2
    server.free('Base', bond.id)
    assert server.running() == ['Base']
    server.free('Base', bond.id)
    assert server.running() == []
    assert "bond_id 'x' not associated with given capability 'robot/Camera'" in (
        server.start_capability('Camera') or server.error('free_capability', 'robot/Camera', 'x'))
    bond.shutdown()


def test_a_use_with_another_provider_is_refused_and_not_counted(server):
    bond = server.bond()
    server.use('Two', bond.id, 'robot/two_a')
    assert "is already running with provider 'robot/two_a'" in server.error(
        'use_capability', 'robot/Two', 'robot/two_b', bond.id)
    assert server.status('Two').uses == 1
    bond.shutdown()


def test_a_bond_that_breaks_frees_what_it_used(server):
    bond = server.bond()
    server.use('Nav', bond.id)
    bond.break_bond()
    eventually(lambda: server.states() == {})
    assert bond.id in server.error('use_capability', 'robot/Nav', '', bond.id)


def test_names_are_listed(server):
    assert 'robot/Base' in server.call('get_interfaces').interfaces
    assert server.call('get_semantic_interfaces', '').semantic_interfaces == ['robot/SemGood']
    assert server.call('get_semantic_interfaces', 'robot/Good').semantic_interfaces == [
        'robot/SemGood']
    assert server.call('get_semantic_interfaces', 'x/Y').semantic_interfaces == []
    everything = server.call('get_providers', '', False)
    assert 'robot/base' in everything.providers and everything.default_provider == ''
    good = server.call('get_providers', 'robot/Good', True)
    assert (good.providers, good.default_provider) == (
        ['robot/good', 'robot/sem_good'], 'robot/good')
    assert server.call('get_providers', 'robot/Good', False).providers == ['robot/good']
    two = server.call('get_providers', 'robot/Two', False)
    assert (two.providers, two.default_provider) == (['robot/two_a', 'robot/two_b'], '')


def test_specs_come_with_the_text_of_their_files(server):
    specs = {spec.type: spec for spec in server.call('get_capability_specs').capability_specs}
    assert set(specs) == {'capability_interface', 'semantic_capability_interface',
                          'capability_provider'}
    base = server.call('get_capability_spec', 'robot/Base').capability_spec
    assert (base.package, base.type, base.content, base.default_provider) == (
        'robot', 'capability_interface', INTERFACE % 'Base', 'robot/base')
    provider = server.call('get_capability_spec', 'robot/base').capability_spec
    assert (provider.type, provider.default_provider) == ('capability_provider', '')


def test_the_name_of_the_nodelet_manager_is_absolute(server):
    assert server.call('get_nodelet_manager_name').nodelet_manager_name == (
        server.name + '_nodelet_manager')


def test_remappings_are_there_in_any_state(server):
    server.start_capability('Good')
    assert remappings(server, 'robot/Good') == [('image', 'good/image')]
    assert remappings(server, 'robot/good') == [('image', 'good/image')]


def test_a_semantic_interface_is_started_used_and_freed(server):
    """A18"""
    bond = server.bond()
    server.use('Good', bond.id, 'robot/sem_good')
    assert server.running() == ['SemGood']
    assert server.status('SemGood').uses == 1
    server.free('Good', bond.id)
    assert server.running() == []
    server.start_capability('Good')
    assert "is already running with provider 'robot/good'" in server.error(
        'use_capability', 'robot/Good', 'robot/sem_good', bond.id)
    assert server.start_capability('Good', 'robot/sem_good') == 2
    server.stop_capability('Good')
    server.start_capability('Good', 'robot/sem_good')
    server.use('Good', bond.id)
    assert server.running() == ['Good', 'SemGood']
    bond.shutdown()


@pytest.mark.parametrize('text', ['', '\x00', '\n\n', 'a' * 100000, '../../x', "'; --", '\u202e',
                                  'robot/Base\n', '%s%d', 'robot//Base', '~', '/'])
def test_any_text_in_any_request_is_answered(server, text):
    """A23"""
    logged = len(server.log.read_text())
    for service, arguments in (
            ('start_capability', (text, text)), ('stop_capability', (text,)),
            ('use_capability', (text, text, text)), ('free_capability', (text, text)),
            ('plan_capability', (text, text)), ('get_providers', (text, True)),
            ('get_semantic_interfaces', (text,)), ('get_capability_spec', (text,)),
            ('get_remappings', (text,))):
        error = server.error(service, *arguments)
        assert 'Traceback' not in error and 'internal' not in error
        assert 'responded with an error' in error or not error
    assert 'Traceback' not in server.log.read_text()[logged:]


def test_invalid_utf_8_in_a_request_is_answered(server):
    """A23"""
    import socket
    import struct
    import rospy
    from capabilities.srv import StartCapability
    uri = rospy.core.parse_rosrpc_uri(
        rospy.client.get_master().lookupService(server.name + '/start_capability')[2])
    with socket.create_connection(uri, 10) as connection:
        fields = [('service', server.name + '/start_capability'), ('callerid', '/strange'),
                  ('md5sum', StartCapability._md5sum)]
        header = b''.join(struct.pack('<I', len(field)) + field for field in (
            ('%s=%s' % pair).encode() for pair in fields))
        connection.sendall(struct.pack('<I', len(header)) + header)
        names = (struct.pack('<I', 3) + b'\xff\xfe/') * 2
        connection.sendall(struct.pack('<I', len(names)) + names)
        assert connection.recv(4)
    assert server.start_capability('Base') == 0
