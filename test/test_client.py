"""The client of the capability server, against a real one."""
from __future__ import annotations

import os
import queue
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import pytest
from built import built
from robot import eventually
from sources import ROOT, SOURCE

built('capabilities.msg')

import rospy    # noqa: E402
from capabilities.client import (  # noqa: E402
    CannotEstablishBondException, CapabilitiesClient, CapabilityNotInUseException,
    CapabilityNotRunningException, ServiceNotAvailableException)
from capabilities.service_discovery import spec_index_from_service     # noqa: E402


@pytest.fixture
def client(server):
    client = CapabilitiesClient(server.name)
    yield client
    client.shutdown()


@pytest.fixture
def lost():
    """What clients are told that they lost, in order."""
    return queue.Queue()


@pytest.fixture
def told(server, lost):
    """A client that is told what it loses."""
    client = CapabilitiesClient(server.name, on_lost=lambda *what: lost.put(what))
    yield client
    client.shutdown()


def wanted(server):
    """The names of what somebody wants."""
    return {name for name, state in server.states().items() if state != 'failed'}


def test_a_capability_runs_as_long_as_it_is_used(server, client):
    assert client.wait_for_services(10)
    assert client.use_capability('robot/Nav')
    assert client._used_capabilities == {'robot/Nav'}
    assert wanted(server) == {'Base', 'Nav'}
    assert client.use_capability('robot/Nav', 'robot/nav', 5)
    assert client.free_capability('robot/Nav')
    assert wanted(server) == {'Base', 'Nav'} and client._used_capabilities
    assert client.free_capability('robot/Nav')
    eventually(lambda: not wanted(server))
    assert client._used_capabilities == set()


def test_the_end_of_the_client_frees_what_it_used(server, client):
    client.use_capability('robot/Base')
    client.shutdown()
    eventually(lambda: not wanted(server))


def test_a_client_of_its_own_that_is_killed_frees_what_it_used(server):
    code = ('import rospy\nfrom capabilities.client import CapabilitiesClient\n'
            "rospy.init_node('user', anonymous=True)\n"
            'CapabilitiesClient(%r).use_capability("robot/Base")\n'
            'print("uses", flush=True)\nrospy.spin()\n' % server.name)
    with subprocess.Popen([sys.executable, '-c', code], env=server.robot.server_environment,
                          stdout=subprocess.PIPE) as user:
        assert user.stdout.readline() == b'uses\n'
        assert server.status('Base').uses == 1
        user.kill()
    eventually(lambda: not wanted(server))


def test_a_program_that_ends_frees_what_it_used_at_once(server):
    code = ('import rospy\nfrom capabilities.client import CapabilitiesClient\n'
            "rospy.init_node('user', anonymous=True)\n"
            'CapabilitiesClient(%r).use_capability("robot/Base")\n' % server.name)
    subprocess.run([sys.executable, '-c', code], env=server.robot.server_environment, check=True,
                   timeout=60)
    eventually(lambda: not wanted(server))


def test_a_second_bond_breaks_the_first_and_frees_what_it_used(server, client):
    first = client.establish_bond(10)
    client.use_capability('robot/Base')
    second = client.establish_bond(10)
    assert first and second and first != second and client._bond_id == second
    assert client._used_capabilities == set()
    eventually(lambda: not wanted(server))


def test_a_bond_that_the_caller_breaks_frees_what_it_used(server, client):
    client.use_capability('robot/Base')
    client._bond.break_bond()
    eventually(lambda: not wanted(server))


def test_after_a_broken_bond_a_use_makes_a_new_one(server, client):
    client.use_capability('robot/Base')
    client._bond.break_bond()
    eventually(lambda: client._bond.is_broken() and not wanted(server))
    client.use_capability('robot/Camera')
    assert server.running() == ['Camera']
    client.free_capability('robot/Camera')


def test_errors_of_the_server_are_raised(client):
    with pytest.raises(rospy.ServiceException, match="Capability 'robot/Nope' not found"):
        client.use_capability('robot/Nope')
    with pytest.raises(rospy.ServiceException, match='two_a'):
        client.use_capability('robot/Two')


def test_freeing_what_does_not_run(client):
    client.establish_bond(10)
    with pytest.raises(CapabilityNotRunningException) as raised:
        client.free_capability('robot/Base')
    assert 'robot/Base' in str(raised.value)


def test_only_a_strict_client_minds_what_it_does_not_use(server, client):
    server.start_capability('Base')
    assert client.free_capability('robot/Base')     # logged, as the old one did
    strict = CapabilitiesClient(server.name, strict=True)
    try:
        strict.establish_bond(10)
        with pytest.raises(CapabilityNotInUseException):
            strict.free_capability('robot/Base')
    finally:
        strict.shutdown()


def test_without_a_server(robot):
    client = CapabilitiesClient('/nobody')
    assert client.wait_for_services(0.1) is False
    assert client.establish_bond(0.1) is None
    with pytest.raises(CannotEstablishBondException):
        client.use_capability('robot/Base', timeout=0.1)
    with pytest.raises(ServiceNotAvailableException, match='/nobody/free_capability'):
        client.free_capability('robot/Base', 0.1)
    with pytest.raises(ValueError, match='start_capability'):
        client.wait_for_services(0.1, ['start_capability'])
    client.shutdown()


def test_a_free_that_reaches_no_server_can_be_made_again(robot):
    """A25: what was used is not forgotten"""
    from capabilities.client import CapabilitiesClient, ServiceNotAvailableException
    client = CapabilitiesClient('/no_such_server', strict=True)
    client._uses['robot/Base'] = 1
    for _ in range(2):
        with pytest.raises(ServiceNotAvailableException):
            client.free_capability('robot/Base', 0.1)
    assert client._used_capabilities == {'robot/Base'}
    client.shutdown()


def test_nothing_of_it_needs_a_node(robot):
    code = ('from capabilities.client import *\nclient = CapabilitiesClient()\n'
            'assert client.wait_for_services(0.1) is False\n'
            'assert client.establish_bond(0.1) is None\n'
            'try:\n    client.free_capability("a/B", 0.1)\n'
            'except ServiceNotAvailableException:\n    client.shutdown()\n')
    done = subprocess.run([sys.executable, '-c', code], env=robot.server_environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout


def test_threads_share_one_bond(server, client):
    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(client.use_capability, ['robot/Base'] * 8))
        assert server.status('Base').uses == 8
        assert all(pool.map(client.free_capability, ['robot/Base'] * 8))
    eventually(lambda: not wanted(server))


# -- what is lost (A2) -----------------------------------------------------------------------------

@pytest.mark.parametrize('capability, said', [
    ('Crash', 'node /crash died, exit 5'), ('OnCrash', 'robot/Crash, which it depends on, ended')])
def test_who_uses_what_crashes_is_told(told, lost, capability, said):
    told.use_capability('robot/' + capability)
    interface, text = lost.get(timeout=40)
    assert interface == 'robot/' + capability and said in text
    assert lost.empty()


def test_who_uses_what_another_stops_is_told_once(server, told, lost):
    told.use_capability('robot/Base')
    told.use_capability('robot/Base')
    told.use_capability('robot/Camera')
    server.stop_capability('Base')
    assert lost.get(timeout=40) == ('robot/Base', 'it was stopped')
    told.free_capability('robot/Camera')
    eventually(lambda: not wanted(server))
    assert lost.empty()


def test_a_semantic_interface_is_watched_under_its_own_name(server, told, lost):
    told.use_capability('robot/Good', 'robot/sem_good')
    assert lost.empty()
    server.call('stop_capability', 'robot/SemGood')
    assert lost.get(timeout=40)[0] == 'robot/Good'


def test_the_end_of_the_server_is_told_and_the_bond_made_anew(robot, lost):
    server = robot.server({'nodelet_manager': False})
    with server:
        client = CapabilitiesClient(server.name, on_lost=lambda *what: lost.put(what),
                                    reconnect=True)
        client.use_capability('robot/Base')
        first = client._bond_id
        os.kill(server.process.pid, signal.SIGKILL)
        server.process.wait()
        assert lost.get(timeout=40)[0] == 'robot/Base'
        server.start()
        eventually(lambda: client._bond_id not in (None, first))
        assert client.use_capability('robot/Base', timeout=10)
        assert server.status('Base').uses == 1
        client.shutdown()


def test_a_server_that_restarts_at_once_is_told_as_such(robot, lost):
    server = robot.server({'nodelet_manager': False})
    with server:
        client = CapabilitiesClient(server.name, on_lost=lambda *what: lost.put(what))
        client.use_capability('robot/Base')
        os.kill(server.process.pid, signal.SIGKILL)
        server.process.wait()
        server.start()
        interface, text = lost.get(timeout=40)
        assert interface == 'robot/Base'
        assert text in ('the capability server was restarted',
                        'the bond with the capability server was broken')
        client.shutdown()


# -- specs over a service --------------------------------------------------------------------------

@pytest.mark.parametrize('slash', ['', '/'])
def test_the_specs_of_the_server(server, slash):
    index, errors = spec_index_from_service(slash + server.name.lstrip('/'), 10)
    assert not errors
    assert index.interfaces['robot/Base'].default_provider == 'robot/base'
    assert index.interfaces['robot/Two'].default_provider == ''
    assert index.semantic_interfaces['robot/SemGood'].default_provider == 'robot/sem_good'
    assert index.providers['robot/nav'].dependencies['robot/Base'].capability_name == 'robot/Base'
    assert index.interface_paths['robot/Base'] == 'service call'


def test_specs_of_nobody(robot):
    with pytest.raises(rospy.ROSException):
        spec_index_from_service('nobody', 0.1)


# -- without ROS -----------------------------------------------------------------------------------

@pytest.mark.parametrize('module', ['server', 'client', 'service_discovery'])
def test_without_ros_it_says_in_one_line_what_is_missing(module):
    done = subprocess.run(
        [sys.executable, '-S', '-c', 'import capabilities.' + module], stderr=subprocess.PIPE,
        universal_newlines=True, env={'PYTHONPATH': str(SOURCE)})
    last = done.stderr.splitlines()[-1]
    assert last.startswith('ImportError: the capability server and its client need ROS, and rospy')


def test_the_bondpy_of_ubuntu_which_imports_as_python_2_did_will_do(tmp_path):
    bondpy = tmp_path / 'bondpy'
    bondpy.mkdir()
    (bondpy / '__init__.py').write_text('')
    (bondpy / 'BondSM_sm.py').write_text('')
    (bondpy / 'bondpy.py').write_text('import BondSM_sm')
    environment = dict(os.environ, PYTHONPATH='%s:%s' % (tmp_path, os.environ['PYTHONPATH']))
    subprocess.run([sys.executable, '-c', 'import capabilities.needs_ros; import bondpy.bondpy'],
                   check=True, env=environment)


def test_the_node_says_so_where_the_old_package_comes_first(tmp_path):
    (tmp_path / 'capabilities').mkdir()
    (tmp_path / 'capabilities' / '__init__.py').write_text('')
    script = (ROOT / 'capabilities/scripts/capability_server').read_text()
    (tmp_path / 'capability_server').write_text(script)     # from where it does not find its source
    done = subprocess.run(
        [sys.executable, str(tmp_path / 'capability_server')], stderr=subprocess.PIPE,
        universal_newlines=True, env={'PYTHONPATH': str(tmp_path)})
    assert done.returncode == 1 and done.stderr.count('\n') == 1
    assert 'the old package capabilities, in %s' % (tmp_path / 'capabilities') in done.stderr
