"""
Clients that die, and providers that crash, for as long as is asked: ``bash test/soak SECONDS``.

Afterwards the server has no more processes, threads, file descriptors and connections than before.
What it published on the way followed the states and events that its page describes.
"""
import os
import random
import signal
import subprocess
import sys
import threading
import time
import xmlrpc.client
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

import pytest

from made_packages import make_package
from robot import INTERFACE, PATIENCE, PROVIDER, eventually

SECONDS = float(os.environ.get('CAPABILITIES_SOAK_SECONDS', '4'))

#: In a long soak the memory of the server is compared after so many starts and after so many more.
#: They take about 150 s, so a shorter one is not long.
FIRST_STARTS, ALL_STARTS, LONG = 500, 2000, 100

#: what a client may be told while others stop and kill what it uses
EXPECTED = ('because it is not running', 'not associated with given', "No Capability '",
            'is already running with provider', 'which is used already', 'is already running.')

CLIENT = '''\
import sys
import rospy
from capabilities.client import CapabilitiesClient
rospy.init_node('soak', anonymous=True, disable_signals=True)
client = CapabilitiesClient(sys.argv[1], on_lost=lambda *what: None)
for name in sys.argv[2:]:
    client.use_capability(name)
print('uses', flush=True)
sys.stdin.read()
'''

#: the states in the order that they have in the life of a process
ORDER = ('launching', 'running', 'degraded', 'stopping')


class Witness:
    """Watches what the server publishes; `faults` has what does not follow the documentation."""

    def __init__(self, server):
        import rospy
        from capabilities.msg import CapabilityEvent, CapabilityStatuses
        self.faults = []
        self.starts = 0
        self._states = {}       # of each process that was listed last
        self._events = {}       # the last one of each process
        self._subscribers = [
            rospy.Subscriber(server.name + '/status', CapabilityStatuses, self._status),
            rospy.Subscriber(server.name + '/events', CapabilityEvent, self._event)]

    def close(self):
        for subscriber in self._subscribers:
            subscriber.unregister()

    def _expect(self, condition, *what):
        if not condition:
            self.faults.append(what)

    def _status(self, message):
        states = {}
        places = Counter()
        for entry in message.capabilities:
            what = entry.capability, entry.state, entry.pid
            place = entry.state if entry.state in ('stopping', 'failed') else 'current'
            places[entry.capability, place] += 1
            self._expect(places[entry.capability, place] == 1, 'listed twice', *what)
            if entry.state in ORDER:
                before = self._states.get(entry.pid, 'launching')
                self._expect(entry.pid > 0, 'has no process', *what)
                self._expect(ORDER.index(before) <= ORDER.index(entry.state),
                             'was %s before' % before, *what)
                states[entry.pid] = entry.state
            else:
                self._expect(entry.state in ('waiting', 'failed'), 'no such state', *what)
                self._expect(entry.pid == 0, 'has a process', *what)
        for capability, place in places:
            self._expect(place != 'failed' or not places[capability, 'current'],
                         'failed, and is wanted again', capability)
        self._states = states

    def _event(self, event):
        kind = event.type.strip('"')
        if event.pid:
            self.starts += kind == 'launched'
            before = self._events.get(event.pid)
            may_follow = {None: ['launched'], 'launched': ['stopped', 'terminated'],
                          'stopped': ['terminated'],
                          'terminated': ['launched']}       # the system uses its id again
            self._expect(kind in may_follow[before], 'event %s after %s' % (kind, before),
                         event.capability, event.pid)
            self._events[event.pid] = kind

    def is_over(self):
        """Has each process that was launched terminated?"""
        return set(self._events.values()) <= {'terminated'}


class Soak:
    """The clients of one server, and the names that they use."""

    def __init__(self, robot, server, names):
        self.robot, self.server, self.names = robot, server, names
        self.killed = Counter()

    def run(self, seconds, starts, witness):
        """Use, start, stop, kill for some seconds, and until there were so many starts."""
        end = time.monotonic() + seconds

        def go_on():
            return time.monotonic() < end or witness.starts < starts
        with ThreadPoolExecutor(4) as pool:
            for future in [pool.submit(act, go_on) for act in (
                    self._ask, self._ask, self._kill_providers, self._kill_clients)]:
                future.result()

    def _ask(self, go_on):
        """A client that uses, frees, starts and stops, and breaks its bond now and then."""
        import rospy
        server, bond = self.server, self.server.bond()
        while go_on():
            name = random.choice(self.names)
            act, *arguments = random.choice([
                ('start_capability', name, ''), ('use_capability', name, '', bond.id),
                ('use_capability', name, '', bond.id), ('free_capability', name, bond.id),
                ('stop_capability', name), ('break', None)])
            if act == 'break':
                if random.random() < 0.3:
                    bond.shutdown()
                    bond = server.bond()
                continue
            try:
                server.call(act, *arguments)
            except rospy.ServiceException as error:
                assert any(text in str(error) for text in EXPECTED), error
        bond.shutdown()

    def _kill_providers(self, go_on):
        """Kill a process of the server's now and then: a node, or a roslaunch."""
        while go_on():
            time.sleep(random.uniform(0.05, 0.5))
            running = [pid for pid in self.server.processes()]
            if running:
                try:
                    os.kill(random.choice(running), signal.SIGKILL)
                    self.killed['processes'] += 1
                except ProcessLookupError:
                    pass

    def _kill_clients(self, go_on):
        """Clients that are killed while they use something; each third before its bond forms."""
        while go_on():
            client = self.client(*random.sample(self.names, 2))
            timer = threading.Timer(PATIENCE if random.random() < 0.67 else 0.8, client.kill)
            timer.start()
            client.stdout.readline()
            timer.cancel()
            client.kill()
            client.communicate()
            self.killed['clients'] += 1

    def client(self, *names):
        """A client that says when it uses these capabilities, and ends at the end of its input."""
        return subprocess.Popen(
            [sys.executable, '-c', CLIENT, self.server.name, *names],
            env=dict(self.robot.server_environment, **self.robot.client_environment),
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            start_new_session=True)

    def end(self):
        """Stop everything, and wait until the server has nothing to do."""
        for status in self.server.statuses():
            self.server.error('stop_capability', status.capability)
        eventually(lambda: not [state for state in self.server.states().values()
                                if state != 'failed'])


def resources(server):
    """How many threads, descriptors, connections and topics the server has."""
    with xmlrpc.client.ServerProxy(server.robot.master.uri) as master:
        address = master.lookupNode('/soak', server.name)[2]
    with xmlrpc.client.ServerProxy(address) as node:
        found = {'connections': len(node.getBusInfo('/soak')[2]),
                 'subscriptions': len(node.getSubscriptions('/soak')[2]),
                 'publications': len(node.getPublications('/soak')[2])}
    time.sleep(0.5)     # in which the server ends the thread of these requests
    # rospy and the master keep their connections for requests, each of which has a thread.
    port = ':%04X' % int(address.rstrip('/').rpartition(':')[2])
    with open('/proc/net/tcp') as file:
        kept = [line for line in file if line.split()[1].endswith(port) and line.split()[3] == '01']
    process = '/proc/%d/' % server.process.pid
    return dict(found, threads=len(os.listdir(process + 'task')) - len(kept),
                descriptors=len(os.listdir(process + 'fd')) - len(kept))


def settled(server):
    """The same, when nothing has changed for some seconds."""
    found = [resources(server)]
    while found[-5:] != 5 * found[-1:]:
        found.append(resources(server))
    return found[-1]


def resident(server):
    """The memory of the server in MB."""
    with open('/proc/%d/statm' % server.process.pid) as file:
        return int(file.read().split()[1]) * os.sysconf('SC_PAGE_SIZE') / 1e6


@pytest.fixture
def server_to_soak(robot, tmp_path):
    """A server, and names of capabilities, most of which have no launch file and so start fast."""
    exports, files, names = [], {}, []
    for number in range(6):
        exports += [('capability_interface', 'i%d.yaml' % number),
                    ('capability_provider', 'p%d.yaml' % number)]
        files['i%d_yaml' % number] = INTERFACE % ('I%d' % number)
        files['p%d_yaml' % number] = PROVIDER % ('p%d' % number, 'soak/I%d' % number) + (
            'depends_on: [soak/I%d]\n' % (number - 1) if number % 3 else '')
        names.append('soak/I%d' % number)
    make_package(tmp_path, 'soak', exports, **files)
    server = robot.server({'nodelet_manager': False})
    server.package_path += ':%s' % tmp_path
    with server:
        yield server, names + ['robot/Nav', 'robot/Crash', 'robot/OnCrash', 'robot/Pair']


def test_after_a_soak_nothing_is_left(robot, server_to_soak):
    server, names = server_to_soak
    soak, witness = Soak(robot, server, names), Witness(server)
    server.bond().shutdown()        # what is made at first use is not left over
    assert soak.client(*names[:2]).communicate()[0] == b'uses\n'
    soak.end()
    before = settled(server)
    print()
    memory = []
    for seconds, starts in (SECONDS / 4, FIRST_STARTS), (SECONDS * 3 / 4, ALL_STARTS):
        soak.run(seconds, starts if SECONDS >= LONG else 0, witness)
        soak.end()
        memory.append(resident(server))
        print('%d starts, %d processes and %d clients killed, %.1f MB, %s' % (
            witness.starts, soak.killed['processes'], soak.killed['clients'], memory[-1],
            resources(server)))

    def are_as_before():
        now = resources(server)
        return all(now[name] <= before[name] for name in now)
    eventually(are_as_before)
    eventually(witness.is_over)
    witness.close()
    assert witness.faults == []
    assert server.processes() == {}
    if SECONDS >= LONG:
        assert memory[1] <= 1.05 * memory[0]
