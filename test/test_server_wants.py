"""Who wants a capability, and what becomes of that: a capability runs while somebody wants it."""
import os
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from robot import eventually


SECONDS = float(os.environ.get('CAPABILITIES_CLIENTS_SECONDS', '10'))   # in the long run 60


@pytest.fixture
def two_clients(server):
    bonds = [server.bond(), server.bond()]
    yield [bond.id for bond in bonds]
    for bond in bonds:
        bond.shutdown()


def test_a_use_of_a_base_is_freed_while_another_needs_it(server, two_clients):
    """A7: F11"""
    one, two = two_clients
    server.use('Nav', one)
    server.use('Base', two)
    server.free('Base', two)
    assert server.running() == ['Base', 'Nav']


def test_a_base_that_is_used_outlives_what_depends_on_it(server, two_clients):
    """A7: F12"""
    one, two = two_clients
    server.use('Nav', one)
    server.use('Base', two)
    server.free('Nav', one)
    assert server.running() == ['Base']
    server.free('Base', two)
    assert server.running() == []


def test_an_explicit_start_outlives_the_last_free(server, two_clients):
    """A7: F13"""
    server.start_capability('Base')
    server.use('Base', two_clients[0])
    server.free('Base', two_clients[0])
    assert server.running() == ['Base']


def test_a_start_of_a_dependency_counts(server, two_clients):
    """A7"""
    server.use('Nav', two_clients[0])
    assert server.start_capability('Base') == 2
    assert server.status('Base').started
    server.free('Nav', two_clients[0])
    assert server.running() == ['Base']


def test_a_stop_drops_all_uses(server, two_clients):
    """A7"""
    server.use('Base', two_clients[0])
    server.use('Nav', two_clients[1])
    server.stop_capability('Base')
    assert server.states() == {}
    assert "Cannot free Capability 'robot/Nav', because it is not running" in server.error(
        'free_capability', 'robot/Nav', two_clients[1])


def test_nothing_waits_for_a_stubborn_node(server):
    """A8"""
    with server.stopping('Stubborn') as stop:
        begin = time.monotonic()
        assert server.start_capability('Base') == 0
        took = time.monotonic() - begin
        assert server.status('Stubborn').state == 'stopping', 'started after %s s' % took
        server.stop_capability('Base')
        assert server.status('Stubborn').state == 'stopping'
        assert stop.result()
    assert server.states() == {}


def test_a_use_while_it_stops_waits(server, two_clients):
    """A19"""
    with server.stopping('Slow') as stop:
        assert server.start_capability('Slow') == 3
        server.use('Slow', two_clients[0])
        assert server.start_capability('Slow') == 3
        assert [(status.state, status.uses, status.started) for status in server.statuses()] == [
            ('stopping', 0, False), ('waiting', 1, False)]
        assert server.call('get_remappings', 'robot/Slow').topics == []
        assert stop.result()
    eventually(lambda: server.types('launched', 'terminated') == [
        ('launched', 'Slow'), ('terminated', 'Slow'), ('launched', 'Slow')])
    assert server.running() == ['Slow']
    server.free('Slow', two_clients[0])
    assert server.states() == {}


def test_a_use_that_waits_can_be_freed_and_stopped(server, two_clients):
    """A19"""
    with server.stopping('Slow') as stop:
        server.use('Slow', two_clients[0])
        server.free('Slow', two_clients[0])
        assert 'because it is not running' in server.error(
            'free_capability', 'robot/Slow', two_clients[0])
        server.use('Slow', two_clients[0])
        server.stop_capability('Slow')
        assert server.states() == {}
        assert stop.result()
    assert server.types('launched') == [('launched', 'Slow')]


def test_a_shared_launch_file_is_refused_and_free_again_after_a_stop(server):
    """A17"""
    server.start_capability('Left')
    error = server.error('start_capability', 'robot/Right', '')
    assert 'robot/left' in error and 'robot/right' in error
    assert server.running() == ['Left']
    server.stop_capability('Left')
    assert server.start_capability('Right') == 0
    server.stop_capability('Right')
    assert server.start_capability('Right') == 0


def test_providers_without_launch_file_share_nothing(server):
    """A17"""
    server.start_capability('Nothing')
    assert server.start_capability('Left') == 0


def test_nothing_on_the_events_topic_changes_the_server(server):
    """A13: F18"""
    import rospy
    from capabilities.msg import CapabilityEvent
    server.start_capability('Base')
    pid = server.status('Base').pid
    publisher = rospy.Publisher(server.name + '/events', CapabilityEvent, queue_size=10)
    eventually(lambda: publisher.get_num_connections() > 0)
    for kind in '"terminated"', '"stopped"', '"launched"':
        publisher.publish(CapabilityEvent(capability='robot/Base', provider='robot/base', pid=pid,
                                          type=kind))
    eventually(lambda: len(server.types()) >= 4)
    assert server.running() == ['Base']
    assert server.stop_capability('Base')
    publisher.unregister()


def test_many_clients_keep_their_bonds(server):
    """The heartbeats of all bonds go over one connection to each client."""
    import rospy
    with ThreadPoolExecutor(20) as pool:
        clients = [bond.result() for bond in [pool.submit(server.bond) for _ in range(20)]]
    # longer than a bond lives without a heartbeat
    assert not clients[0].wait_until_broken(rospy.Duration(6))
    assert [bond.is_broken() for bond in clients] == 20 * [False]
    for bond in clients:
        bond.shutdown()


def test_a_client_killed_before_its_bond_formed_is_noticed(server):
    """A27: F10"""
    bond_id = server.call('establish_bond').bond_id
    server.use('Base', bond_id)
    eventually(lambda: server.states() == {})


def test_a_client_killed_right_after_its_bond_formed_is_noticed(server):
    """A27: F24. It sends one heartbeat and no second."""
    import rospy
    from bond.msg import Status
    publisher = rospy.Publisher(server.name + '/bonds', Status, queue_size=10)
    bond_id = server.call('establish_bond').bond_id
    eventually(lambda: publisher.get_num_connections() > 0)
    server.use('Base', bond_id)
    begin = time.monotonic()
    publisher.publish(Status(id=bond_id, instance_id='somebody', active=True,
                             heartbeat_timeout=4, heartbeat_period=1))
    eventually(lambda: server.states() == {})
    assert time.monotonic() - begin > 3     # by its timeout, not at once
    publisher.unregister()


def test_four_clients_at_random_leave_nothing(server):
    """A24"""
    import random
    import rospy
    names = ['Base', 'Nav', 'Camera', 'Patrol', 'Good', 'Nothing']
    documented = ['because it is not running', 'not associated with given', "No Capability '",
                  'Cannot free']
    errors = []
    deadline = time.monotonic() + SECONDS

    def ask(seed):
        choose = random.Random(seed)
        bond = server.bond()
        while time.monotonic() < deadline:
            name = choose.choice(names)
            act, *more = choose.choice([(server.start_capability,), (server.use, bond.id),
                                        (server.free, bond.id), (server.stop_capability,)])
            try:
                act(name, *more)
            except rospy.ServiceException as error:
                if not any(text in str(error) for text in documented):
                    errors.append(str(error))
        bond.shutdown()

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(ask, range(4)))       # raises what one of them raises
    for name in names:
        server.error('stop_capability', 'robot/' + name)
    eventually(lambda: server.states() == {})
    assert errors == []
    assert server.processes() == {}
    launched = [event for event in server.types('launched')]
    eventually(lambda: len(server.types('terminated')) == len(launched))
