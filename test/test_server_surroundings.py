"""What the server does when what is around it fails: the master, the disk, the clock, the crowd."""
import os
import signal
import subprocess
import sys
import time
import xmlrpc.client
from concurrent.futures import ThreadPoolExecutor

import pytest

from robot import PATIENCE, SERVER, eventually, processes_with
from ros_master import Master
from test_server_soak import CLIENT

WITHOUT = {'nodelet_manager': False}


@pytest.fixture
def second_master(robot, tmp_path):
    """A master that a test may kill, with the packages of the robot, and the id of its process."""
    with Master(tmp_path, robot.workspace) as master:
        [pid] = [pid for pid, command in processes_with('ROS_MASTER_URI=' + master.uri).items()
                 if '/rosmaster ' in command]
        yield master, pid


def test_the_master_is_killed(robot, second_master):
    """What runs goes on, a client that dies is noticed, and the end is in order."""
    master, pid = second_master
    environment = dict(robot.server_environment, **{
        name: master.environment[name] for name in ('ROS_MASTER_URI', 'ROS_HOME', 'ROS_LOG_DIR')})
    with xmlrpc.client.ServerProxy(master.uri) as proxy:
        proxy.setParam('/test', '/capability_server', {
            'nodelet_manager': False, 'autostart': ['robot/Camera']})

    def nodes():
        found = processes_with('CAPABILITY_SERVER_MARK=/capability_server@%s ' % master.uri)
        return {name for name in ('camera', 'base') for command in found.values()
                if '__name:=%s ' % name in command}

    log = open(master.environment['ROS_HOME'] + '.log', 'wb')
    server = subprocess.Popen([sys.executable, '-c', SERVER, str(robot.workspace)],
                              env=environment, stdout=log, stderr=log, start_new_session=True)
    client = subprocess.Popen([sys.executable, '-c', CLIENT, '/capability_server', 'robot/Base'],
                              env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL)
    try:
        assert client.stdout.readline() == b'uses\n'
        eventually(lambda: nodes() == {'camera', 'base'})
        os.kill(pid, signal.SIGKILL)
        client.kill()
        eventually(lambda: nodes() == {'camera'})
        server.send_signal(signal.SIGTERM)
        assert server.wait(PATIENCE) == 0
        assert nodes() == set()
    finally:
        log.close()
        for process in client, server:
            process.kill()
            process.communicate()


def test_the_disk_is_full(robot):
    """Nothing can be written, neither a log nor to the terminal."""
    server = robot.server(WITHOUT, program='''\
import os, resource
resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
for stream in 1, 2:
    os.dup2(os.open('/dev/full', os.O_WRONLY), stream)
''' + SERVER)
    with server:
        assert server.start_capability('Nav') == 0
        server.wait_for('Nav', 'running')
        assert server.start_capability('Crash') == 0
        assert server.wait_for('Crash', 'failed').exit_code == 5
        assert server.stop_capability('Nav')
        assert server.start_capability('Camera') == 0
        assert server.end() == 0
        assert server.processes() == {}


def test_the_clock_jumps(robot):
    """By an hour, forwards and backwards: bonds hold, and nothing waits for the clock."""
    server = robot.server(WITHOUT, program='''\
import signal, time
true_time, jumps = time.time, []
time.time = lambda: true_time() + 3600 * len(jumps) * (-1) ** len(jumps)
signal.signal(signal.SIGUSR2, lambda *ignored: jumps.append(1))
''' + SERVER)
    with server:
        bond = server.bond()
        server.use('Base', bond.id)
        since = server.wait_for('Base', 'running').since.to_sec()
        for ahead in -1, 1:
            server.process.send_signal(signal.SIGUSR2)
            time.sleep(5)       # longer than a bond lives without a heartbeat
            assert server.status('Base').uses == 1
            assert server.start_capability('Camera') == 0
            assert (server.wait_for('Camera', 'running').since.to_sec() - since) * ahead > 1000
            assert server.stop_capability('Camera')
        bond.shutdown()
        eventually(lambda: server.states() == {})
        assert server.end() == 0
        assert server.processes() == {}


def test_200_clients_at_once(robot):
    """Each makes a bond and uses two capabilities; each is counted, and so is its end."""
    from capabilities.bonds import Bonds
    broken = []
    with robot.server(WITHOUT) as server:
        bonds = Bonds(server.name + '/bonds', broken.append, lambda do: do())

        def come(number):
            bond_id = server.call('establish_bond').bond_id
            bonds.start(bond_id)
            server.use('Nav', bond_id)
            server.use('Base', bond_id)
            return bond_id

        with ThreadPoolExecutor(200) as pool:
            ids = set(pool.map(come, range(200)))
        assert len(ids) == 200
        server.wait_for('Nav', 'running')
        time.sleep(5)       # longer than a bond lives without a heartbeat
        assert broken == []
        assert [(server.status(name).uses) for name in ('Nav', 'Base')] == [200, 200]
        bonds.end()
        eventually(lambda: server.states() == {})


def test_a_reload_in_the_middle_of_a_start(robot):
    """A start that waits for a stop and one whose launch file is loading go on as planned."""
    with robot.server(WITHOUT) as server:
        server.start_capability('OnHangs')
        eventually(lambda: any('sleep 10000' in command
                               for command in server.processes().values()))
        spec = robot.package / 'providers' / 'onslow.yaml'
        text = spec.read_text()
        try:
            with server.stopping('Slow') as stop:
                assert server.start_capability('OnSlow') == 0
                spec.unlink()
                server.call('reload_capabilities')
                assert server.status('OnSlow').state == 'waiting'
                assert server.status('Hangs').state == 'launching'
                assert stop.result()
            server.wait_for('OnSlow', 'running')
        finally:
            spec.write_text(text)
        for name in 'Hangs', 'Slow':
            assert server.stop_capability(name)
        assert server.states() == {}
