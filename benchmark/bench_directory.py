"""
How much of a processor the resource directory takes for 10,000 robots, and whether it loses one.

Needs the devel or install space of a build (``. build/devel/setup.bash``); each load takes 45 s.
"""
import os
import signal
import socket
import socketserver
import struct
import subprocess
import sys
import tempfile
import threading
import time
import xmlrpc.client
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

ROOT = Path(__file__).resolve().parent.parent
LOADS = [(50, 200), (200, 50)]      # nodes, and keys of each
PERIOD = 5.0        # seconds, in which each key is announced once
LIFETIME = 8.0      # likewise: less than two periods, so that one that is lost shows
STRETCH = 30.0      # likewise, for which is measured
TARGET = 0.25       # of a core

#: a client of the directory, until its standard input ends
WATCHER = '''\
import sys
import rospy
from rocon_uri.msg import ResourceChange
from rocon_uri.srv import FindResources
rospy.init_node('benchmark', disable_signals=True)
changes = []
subscriber = rospy.Subscriber('/resource_directory/changes', ResourceChange, changes.append)
while not subscriber.get_num_connections():
    rospy.sleep(0.1)
print('ready', flush=True)
sys.stdin.read()
find = rospy.ServiceProxy('/resource_directory/find', FindResources)
print(len(find('rocon:/').uris), len(changes), flush=True)
'''


def figures():
    """What this part measures."""
    try:
        import rospy    # noqa: F401
        from rocon_uri.srv import FindResources     # noqa: F401
    except ImportError as error:
        print('    left out: needs ROS and the messages of rocon_uri (%s)' % error)
        return
    sys.path.append(str(ROOT / 'test'))
    from ros_master import Master
    for nodes, keys in LOADS:
        with tempfile.TemporaryDirectory() as folder, Master(Path(folder)) as master:
            seconds, passed = measured(master, nodes, keys)
        yield {'name': '%d URIs every %g s by %d connections' % (nodes * keys, PERIOD, nodes),
               'ratio': seconds / passed, 'target': TARGET, 'reference': 'one core',
               'seconds': seconds, 'reference_seconds': passed, 'details': 'none was lost'}


def measured(master, nodes, keys):
    """The time of the processor that the directory takes, and the time that passes."""
    with Robots(master.uri, nodes, keys) as robots:     # first, or rospy connects twice
        directory = subprocess.Popen(
            [sys.executable, str(ROOT / 'scripts' / 'resource_directory')],
            env=master.environment, stdin=subprocess.DEVNULL)
        try:
            robots.wait()
            time.sleep(2 * PERIOD)
            with none_is_lost(master, nodes * keys):
                before, start = processor_time(directory.pid), time.monotonic()
                time.sleep(STRETCH)
                seconds = processor_time(directory.pid) - before
                return seconds, time.monotonic() - start
        finally:
            robots.fall_silent()
            directory.send_signal(signal.SIGINT)
            try:
                directory.wait(30)
            except subprocess.TimeoutExpired:
                directory.kill()
                directory.wait()


@contextmanager
def none_is_lost(master, count):
    """Meanwhile no robot comes or goes, and at the end all of them are there."""
    watcher = subprocess.Popen([sys.executable, '-c', WATCHER], env=master.environment,
                               stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                               universal_newlines=True)
    try:
        assert watcher.stdout.readline() == 'ready\n'
        yield
    finally:
        told, _ = watcher.communicate('', timeout=60)
    found, changes = map(int, told.split())
    assert (found, changes) == (count, 0), '%d of %d are there, %d changes' % (
        found, count, changes)


def processor_time(pid):
    """Of a process and all of its threads, in seconds."""
    fields = Path('/proc/%d/stat' % pid).read_text().rpartition(')')[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf('SC_CLK_TCK')


class Robots:
    """Nodes that announce robots, without rospy: one process plays them all, evenly in time."""

    def __init__(self, master_uri, nodes, keys):
        self._master = xmlrpc.client.ServerProxy(master_uri)
        self._keys = keys
        self._api = Api(('127.0.0.1', 0), Paths, logRequests=False)
        self._api.register_function(self._request_topic, 'requestTopic')
        self._api.register_function(lambda *ignored: (1, '', 0), 'publisherUpdate')
        self._listeners = [socket.create_server(('127.0.0.1', 0)) for _ in range(nodes)]
        self._connections = {}
        self._messages = [message(node, key) for node in range(nodes) for key in range(keys)]
        self._has_ended = threading.Event()
        self._serving = threading.Thread(target=self._api.serve_forever)
        self._announcing = threading.Thread(target=self._announce)

    def __enter__(self):
        self._serving.start()
        for node in range(len(self._listeners)):
            self._master.registerPublisher('/robot_%d' % node, '/resource_announcements',
                                           'rocon_uri/Announcement', self._uri(node))
        return self

    def wait(self):
        """Wait until the directory is connected with all of them, and begin."""
        from rocon_uri.msg import Announcement
        for node, listener in enumerate(self._listeners):
            listener.settimeout(60)
            connection, _ = listener.accept()
            connection.settimeout(60)
            size, = struct.unpack('<I', connection.recv(4, socket.MSG_WAITALL))
            connection.recv(size, socket.MSG_WAITALL)
            fields = ['callerid=/robot_%d' % node, 'latching=1', 'md5sum=' + Announcement._md5sum,
                      'message_definition=', 'topic=/resource_announcements',
                      'type=rocon_uri/Announcement']
            connection.sendall(sized(b''.join(sized(field.encode()) for field in fields)))
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._connections[node] = connection
        self._announcing.start()

    def fall_silent(self):
        """Announce nothing any more."""
        self._has_ended.set()
        if self._announcing.ident is not None:
            self._announcing.join()

    def __exit__(self, *error):
        self._api.shutdown()
        self._serving.join()
        self._api.server_close()
        for closed in self._listeners + list(self._connections.values()):
            closed.close()

    def _uri(self, node):
        return 'http://127.0.0.1:%d/%d' % (self._api.server_address[1], node)

    def _request_topic(self, caller, topic, protocols):
        port = self._listeners[int(threading.current_thread().path[1:])].getsockname()[1]
        return 1, '', ['TCPROS', '127.0.0.1', port]

    def _announce(self):
        nodes = len(self._connections)
        start, sent = time.monotonic(), 0
        while not self._has_ended.is_set():
            due = int((time.monotonic() - start) / PERIOD * len(self._messages))
            for number in range(sent, due):     # of each node in turn
                key, node = divmod(number % len(self._messages), nodes)
                self._connections[node].sendall(self._messages[node * self._keys + key])
            sent = due
            time.sleep(0.0005)


class Paths(SimpleXMLRPCRequestHandler):
    """The path says which node is meant."""

    rpc_paths = ()

    def do_POST(self):
        threading.current_thread().path = self.path
        super().do_POST()


class Api(socketserver.ThreadingMixIn, SimpleXMLRPCServer):
    """The API of all nodes."""

    daemon_threads = True


def message(node, key):
    """An announcement as it is sent."""
    import rospy
    from rocon_uri import parse
    from rocon_uri.messages import to_msg
    from rocon_uri.msg import Announcement
    buffer = BytesIO()
    Announcement(uri=to_msg(parse('rocon:/turtlebot2/robot_%d_%d/noetic/focal' % (node, key))),
                 key=str(key), lifetime=rospy.Duration(LIFETIME)).serialize(buffer)
    return sized(buffer.getvalue())


def sized(data):
    """Data with its length before it, as TCPROS has it."""
    return struct.pack('<I', len(data)) + data
