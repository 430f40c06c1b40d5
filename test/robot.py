"""
A robot for the tests of the capability server: packages whose providers fail as a test wants it.

A `Robot` has a master of its own. A `Server` is a capability server on it, in a process of its own,
and what a client sees of it.
"""
from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

from made_packages import make_package
from ros_master import Master, ignores, make_test_nodes, node
from sources import SOURCE

INTERFACE = 'name: %s\nspec_version: 1\nspec_type: interface\ninterface: {}\n'
SEMANTIC = 'name: %s\nspec_version: 1\nspec_type: semantic_interface\nredefines: %s\n'
PROVIDER = 'name: %s\nspec_version: 1\nspec_type: provider\nimplements: %s\n'

#: a node that takes its time to end
SLOW_NODE = '''\
#!%s
import signal, sys, time
signal.signal(signal.SIGINT, lambda *ignored: (time.sleep(3), sys.exit()))
signal.signal(signal.SIGTERM, signal.SIG_IGN)
time.sleep(10000)
''' % sys.executable

#: the server, which writes what its threads do when it is asked to
SERVER = '''\
import faulthandler, signal
faulthandler.register(signal.SIGUSR1)
signal.signal(signal.SIGINT, signal.SIG_DFL)    # as in the script of the node
from capabilities.server import main
raise SystemExit(main())
'''

#: seconds that a test waits for what has to come, on a machine that has other things to do
PATIENCE = 40.0


def sleeper(name):
    """A node that sleeps until it is told to end."""
    return node(name, 'sleep 10000')


#: package robot: interface, what its provider depends on, the nodes of its launch file
CAPABILITIES = [
    ('Base', '', sleeper('base')),
    ('Nav', 'robot/Base', sleeper('nav')),
    ('Patrol', 'robot/Nav', sleeper('patrol')),
    ('Camera', '', sleeper('camera')),
    ('Pair', '', sleeper('one') + sleeper('later')),
    ('Loader', '', node('loader', 'exit 0') + sleeper('loaded')),
    ('Partly', '', sleeper('there') + '<node pkg="test_nodes" type="nope" name="absent"/>'),
    ('Crash', '', node('crash', 'exit 5')),
    ('OnCrash', 'robot/Crash', sleeper('on_crash')),
    ('Slow', '', '<node pkg="robot" type="slow" name="slow"/>'),
    ('OnSlow', 'robot/Slow', sleeper('on_slow')),
    ('Stubborn', '', node('stubborn', 'ignore sleep 10000')),
    ('Forks', '', node('forks', 'fork sleep 10000')),
    ('Loop', 'robot/Pool', sleeper('loop')),
    ('Pool', 'robot/Loop', sleeper('pool')),
    ('Respawns', '', node('respawns', 'sleep 0.2 exit 1', 'respawn="true" respawn_delay="0.2"')
     + sleeper('beside')),
    ('Hangs', '', '<param name="never" command="sleep 10000"/>' + sleeper('hangs')),
    ('OnHangs', 'robot/Hangs', sleeper('on_hangs')),
    ('Changes', '', sleeper('changes')),
    ('Manager', '', '<arg name="capability_server_nodelet_manager_name"/>' + sleeper('nodelet')),
]


def make_robot(workspace):
    """Write the packages of the robot below a folder."""
    make_test_nodes(workspace)
    files, exports = {}, []

    def add(tag, path, text):
        files[path] = text
        exports.append((tag, path))

    def add_interface(name):
        add('capability_interface', 'interfaces/%s.yaml' % name, INTERFACE % name)

    def add_provider(name, interface, more='', launch=None):
        add('capability_provider', 'providers/%s.yaml' % name,
            PROVIDER % (name, 'robot/' + interface) + more)
        if launch is not None:
            files['providers/%s' % launch[0]] = '<launch>%s</launch>\n' % launch[1]

    for name, depends_on, nodes in CAPABILITIES:
        add_interface(name)
        own = name.lower()
        add_provider(own, name, 'launch_file: %s.launch\n%s' % (
            own, 'depends_on: [%s]\n' % depends_on if depends_on else ''), (own + '.launch', nodes))
    for name in 'Two', 'Good', 'Broken', 'Missing', 'Nothing', 'Left', 'Right', 'Nodelets', 'None':
        add_interface(name)
    add_provider('two_a', 'Two', 'launch_file: two_a.launch\n', ('two_a.launch', sleeper('two_a')))
    add_provider('two_b', 'Two', 'launch_file: two_b.launch\n', ('two_b.launch', sleeper('two_b')))
    add_provider('good', 'Good', 'launch_file: good.launch\n'
                 'remappings: {topics: {image: good/image}}\n', ('good.launch', sleeper('good')))
    add('semantic_capability_interface', 'interfaces/SemGood.yaml',
        SEMANTIC % ('SemGood', 'robot/Good'))
    add_provider('sem_good', 'SemGood', 'launch_file: sem.launch\n', ('sem.launch', sleeper('sem')))
    add_provider('broken', 'Broken', 'launch_file: broken.launch\n', ('broken.launch', '<node'))
    add_provider('missing', 'Missing', 'launch_file: missing.launch\n')
    add_provider('nothing', 'Nothing')
    add_provider('left', 'Left', 'launch_file: shared.launch\n', ('shared.launch', sleeper('both')))
    add_provider('right', 'Right', 'launch_file: shared.launch\n')
    add_provider('nodelets', 'Nodelets', 'nodelet_manager: some_manager\n')
    package = make_package(workspace, 'robot', exports)
    for path, text in files.items():
        (package / path).parent.mkdir(exist_ok=True)
        (package / path).write_text(text)
    (package / 'slow').write_text(SLOW_NODE)
    (package / 'slow').chmod(0o755)
    return package


def eventually(condition, patience=PATIENCE):
    """Wait until a condition holds; what it gave is returned."""
    deadline = time.monotonic() + patience
    while True:
        result = condition()
        if result:
            return result
        assert time.monotonic() < deadline, 'this never came: %s' % condition
        time.sleep(0.02)


def processes_with(mark):
    """The ids of the processes whose environment has a text in it, and their command lines."""
    found = {}
    for pid in filter(str.isdigit, os.listdir('/proc')):
        try:
            with open('/proc/%s/environ' % pid, 'rb') as environment:
                if mark.encode() not in environment.read():
                    continue
            with open('/proc/%s/stat' % pid) as stat:
                if stat.read().rpartition(')')[2].split()[0] == 'Z':
                    continue
            with open('/proc/%s/cmdline' % pid, 'rb') as command:
                found[int(pid)] = command.read().replace(b'\0', b' ').decode(errors='replace')
        except OSError:
            pass    # it has ended
    return found


class Server:
    """
    A capability server that runs, and is ended at the end of a ``with`` statement.

    :param Robot robot: where it runs
    :param str name: the name of its node, of which each test has one of its own
    :param dict parameters: its private parameters
    :param str program: what Python runs
    """

    def __init__(self, robot, name, parameters=None, arguments=(), program=SERVER):
        import rospy
        from capabilities.msg import CapabilityEvent, CapabilityStatuses
        self.robot, self.name = robot, '/' + name
        for parameter, value in (parameters or {}).items():
            rospy.set_param('%s/%s' % (self.name, parameter), value)
        self.log = robot.folder / (name.replace('/', '_') + '.log')
        self.events = []
        self.status_message = None
        self._subscribers = [
            rospy.Subscriber(self.name + '/events', CapabilityEvent, self.events.append),
            rospy.Subscriber(self.name + '/status', CapabilityStatuses, self._keep_status)]
        self.process = None
        self.arguments = arguments
        self.package_path = str(robot.workspace)
        self.program = program

    def start(self, sigint=signal.SIG_DFL):
        """Start the process, with a disposition of SIGINT, and wait for nothing."""
        with open(self.log, 'ab') as log:
            self.process = subprocess.Popen(
                [sys.executable, '-c', self.program, self.package_path,
                 '__name:=' + self.name.rpartition('/')[2], *self.arguments],
                env=dict(self.robot.server_environment,
                         ROS_NAMESPACE=self.name.rpartition('/')[0] or '/'),
                stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                cwd=str(self.robot.folder), start_new_session=True,
                preexec_fn=lambda: signal.signal(signal.SIGINT, sigint))
        return self

    def __enter__(self):
        if self.process is None:
            self.start()
        eventually(self.is_ready)
        # An event is lost until the server has connected to who subscribed before it came up.
        eventually(lambda: self.types('server_ready') and self.status_message is not None)
        return self

    def __exit__(self, *error):
        self.end()
        for subscriber in self._subscribers:
            subscriber.unregister()

    def end(self, number=signal.SIGINT):
        """End the process; its exit status is returned."""
        if self.process.poll() is None:
            self.process.send_signal(number)
        try:
            return self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.process.send_signal(signal.SIGUSR1)
            time.sleep(1.0)     # in which it writes what each thread does
            self.process.kill()
            self.process.wait()
            raise AssertionError(self.log.read_text()) from None

    def is_ready(self):
        assert self.process.poll() is None, self.log.read_text()
        try:
            return self.call('get_status').status.ready
        except OSError:
            return False
        except Exception as error:
            if type(error).__name__ == 'ServiceException':
                return False
            raise

    def call(self, service, *arguments):
        """The response of a service of the server."""
        import rospy
        from std_srvs.srv import Empty
        import capabilities.srv
        name = ''.join(word.capitalize() for word in service.split('_'))
        kind = getattr(capabilities.srv, name, Empty)
        return rospy.ServiceProxy('%s/%s' % (self.name, service), kind)(*arguments)

    def error(self, service, *arguments):
        """The error that a service of the server answers with; '' if it gives an answer."""
        import rospy
        try:
            self.call(service, *arguments)
        except rospy.ServiceException as error:
            return str(error)
        return ''

    def start_capability(self, capability, provider=''):
        return self.call('start_capability', 'robot/' + capability, provider).result

    def use(self, capability, bond, provider=''):
        self.call('use_capability', 'robot/' + capability, provider, bond)

    def free(self, capability, bond):
        self.call('free_capability', 'robot/' + capability, bond)

    def stop_capability(self, capability):
        return self.call('stop_capability', 'robot/' + capability).successful

    @contextlib.contextmanager
    def stopping(self, capability):
        """Meanwhile a capability whose node takes its time is being stopped; the future of that."""
        self.start_capability(capability)
        self.wait_for(capability, 'running')
        self.stubborn_node_pid(capability.lower())
        with ThreadPoolExecutor(1) as pool:
            stop = pool.submit(self.stop_capability, capability)
            self.wait_for(capability, 'stopping')
            yield stop

    def bond(self):
        """A client: the bond that it made with the server, formed."""
        import rospy
        import capabilities.needs_ros  # noqa: F401, without it bondpy is not found on Ubuntu 20.04
        from bondpy import bondpy
        bond = bondpy.Bond(self.name + '/bonds', self.call('establish_bond').bond_id)
        # All bonds of a process share a queue. Those of several clients would not.
        bond.pub.impl.set_queue_size(1000)
        bond.start()
        assert bond.wait_until_formed(rospy.Duration(10))
        return bond

    def _keep_status(self, message):
        self.status_message = message

    def statuses(self):
        """What the status says, a list."""
        return list(self.call('get_status').status.capabilities)

    def states(self):
        """The state of each capability, without the name of the package."""
        return {status.capability.partition('/')[2]: status.state for status in self.statuses()}

    def status(self, capability):
        """What the status says of a capability (the first, if there are two), or None."""
        return next((status for status in self.statuses()
                     if status.capability == 'robot/' + capability), None)

    def running(self):
        """The names of what is listed as running."""
        running = self.call('get_running_capabilities').running_capabilities
        return sorted(one.capability.capability.partition('/')[2] for one in running)

    def wait_for(self, capability, state):
        """Wait until a capability is in a state; its status is returned."""
        def is_in_state():
            status = self.status(capability)
            return status is not None and status.state == state and status
        return eventually(is_in_state)

    def types(self, *wanted):
        """The events that came, as type and capability; of some types only, if they are named."""
        events = [(event.type.strip('"'), event.capability.rpartition('/')[2])
                  for event in list(self.events)]
        return [event for event in events if not wanted or event[0] in wanted]

    def wait_for_all_events(self):
        """Wait until all that was launched, and has ended, is known to have terminated."""
        eventually(lambda: len(self.types('launched')) == len(self.types('terminated')))

    def processes(self):
        """What it started and what still runs: command lines by process id."""
        return processes_with('CAPABILITY_SERVER_MARK=%s@%s ' % (self.name, self.robot.master.uri))

    def node_pid(self, name):
        """The process id of a node, once it runs."""
        def find():
            return next((pid for pid, command in self.processes().items()
                         if '__name:=%s ' % name in command), None)
        return eventually(find)

    def stubborn_node_pid(self, name):
        """The same of a node that ignores SIGTERM, once it does so."""
        pid = self.node_pid(name)
        eventually(lambda: ignores(pid, signal.SIGTERM))
        return pid


class Robot:
    """A master, the packages of the robot, and this process as a node there."""

    def __init__(self, folder):
        self.folder = folder
        self.workspace = folder / 'src'
        self.workspace.mkdir()
        self.package = make_robot(self.workspace)
        self.master = Master(folder, self.workspace)
        self.servers = []
        self.server_environment = dict(
            self.master.environment, PYTHONPATH=os.pathsep.join(
                [str(SOURCE)] + [path for path in sys.path if path]),
            PYTHONDONTWRITEBYTECODE='1')
        self.client_environment = {name: self.master.environment[name] for name in (
            'ROS_MASTER_URI', 'ROS_IP', 'ROS_HOME', 'ROS_LOG_DIR')}

    def __enter__(self):
        self.master.__enter__()
        before = dict(os.environ)
        os.environ.update(self.client_environment)
        import rospy
        rospy.init_node('test_of_the_server', anonymous=True, disable_signals=True)
        os.environ.clear()
        os.environ.update(before)
        return self

    def __exit__(self, *error):
        import rospy
        for server in self.servers:     # those that a test that failed has left
            if server.process is not None:
                server.end()
        rospy.signal_shutdown('the tests are over')
        for thread in threading.enumerate():
            if thread.name.startswith('rosout'):
                thread.join(1)
        self.master.__exit__(*error)

    def server(self, parameters=None, arguments=(), name=None, program=SERVER):
        """A server, of a name that no other has unless it is given, which is not started yet."""
        name = name or 'server_%d' % (len(self.servers) + 1)
        self.servers.append(Server(self, name, parameters, arguments, program))
        return self.servers[-1]
