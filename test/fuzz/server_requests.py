"""
Requests to the services of the capability server, as they arrive from anybody, one after the other.

The services, the runtime and the graph are the server's own; the processes are pretended, and end
when they are told to, or by themselves.
"""
from __future__ import annotations

import functools
import itertools
import threading
from io import BytesIO
from types import SimpleNamespace
from unittest import mock

import rospy
from capabilities.catalogue import catalogue_of, load_specs
from capabilities.messages import status_message
from capabilities.parameters import read_parameters
from capabilities.runtime import Runtime
from capabilities.services import Services
from fuzz.damage import ROOT, damaged
from genpy import DeserializationError

CAPABILITIES = ['cafe_capabilities/Camera', 'cafe_capabilities/FrontCamera',
                'cafe_capabilities/MobileBase', 'cafe_capabilities/Speech',
                'cafe_capabilities/Tray', 'cafe_capabilities/Lift', 'cafe_capabilities/Navigation']
PROVIDERS = ['cafe_capabilities/front_camera', 'cafe_capabilities/turtlebot_base',
             'cafe_capabilities/espeak', 'cafe_capabilities/festival',
             'cafe_capabilities/tray_scale', '']
BONDS = ['bond_1', 'bond_2', 'bond_3', 'of_nobody']
TOKENS = ['/', '..', 'cafe_capabilities', 'Camera', 'front_camera', 'bond_1', '--screen', '`id`',
          '$(touch x)', ';', '|', '\n', '\0', '\x1b[2J', '\u202e', '\ud800', '\xe9', '%s%n', ':=',
          ' ', 'a' * 300, "'", '"', '!!nodelet_manager']
BYTES = [b'\0', b'\1', b'\xff', b'\0\0\0\0', b'\xff\xff\xff\x7f', b'a', b'/', b'\xc3\x28']
SERVICES = {
    'start_capability': (CAPABILITIES, PROVIDERS), 'stop_capability': (CAPABILITIES,),
    'use_capability': (CAPABILITIES, PROVIDERS, BONDS), 'free_capability': (CAPABILITIES, BONDS),
    'plan_capability': (CAPABILITIES, PROVIDERS), 'establish_bond': (),
    'get_providers': (CAPABILITIES,), 'get_semantic_interfaces': (CAPABILITIES,),
    'get_capability_spec': (CAPABILITIES + PROVIDERS,), 'get_capability_specs': (),
    'get_remappings': (CAPABILITIES + PROVIDERS,), 'get_running_capabilities': (),
    'get_interfaces': (), 'get_nodelet_manager_name': (), 'get_status': (),
    'reload_capabilities': ()}
EVENTS = ['nodes start', 'a process ends', 'a bond breaks']


def make(rng):
    """The requests and events: (name, texts, bytes that replace the message or None)."""
    return [make_step(rng) for _ in range(rng.choice((1, 2, 5, 10, 20)))]


def make_step(rng):
    name = rng.choice(list(SERVICES) + EVENTS)
    texts = [rng.choice(values) for values in SERVICES.get(name, (BONDS,))]
    if rng.random() < 0.3:
        texts = [damaged(rng, text, TOKENS) for text in texts]
    wire = b''.join(b'%c\0\0\0%s' % (len(text.encode('utf-8', 'replace')) % 256,
                                     text.encode('utf-8', 'replace')) for text in texts)
    return name, texts, damaged(rng, wire, BYTES) if rng.random() < 0.1 else None


def check(steps):
    server = Server()
    for name, texts, wire in steps:
        if name in SERVICES:
            check_request(server, name, texts, wire)
        else:
            server.happens(name, texts[0])
        server.check_status()
    server.runtime.begin_end()
    server.end_all()
    assert not list(server.runtime.graph.instances)


def check_request(server, name, texts, wire):
    """It is answered, or refused on one line, and not for a fault of the server's own."""
    service, handler = server.services[name]
    request = service._request_class()
    try:
        if wire is None:
            for field, text in zip(request.__slots__, texts):
                setattr(request, field, text)
            wire = serialized(request)
        request = service._request_class().deserialize(wire)
    except (DeserializationError, UnicodeError):
        return      # rospy's to refuse
    try:
        serialized(handler(request))
    except RuntimeError as error:
        assert str(error).isprintable() and 'internal error' not in str(error), error


def serialized(message):
    buffer = BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


@functools.lru_cache(maxsize=None)
def catalogue():
    """What the café has."""
    parameters = read_parameters(lambda name, default=None: default, False)
    return catalogue_of(load_specs([str(ROOT / 'examples/workspace')], parameters), parameters)


class Server:
    """The services of a server without ROS; it is the audience, the bonds and the processes."""

    def __init__(self):
        self.services, self.entries, self.processes, self.ends = {}, [], {}, []
        self.ids, self.bond_numbers = itertools.count(1), itertools.count(1)
        self.nodelet_manager_name, self.has_nodelet_manager = '/manager', False
        self.nodelet_manager_pid = None
        self.runtime = Runtime(self, catalogue())
        self.runtime.manager = self
        services = Services(self.runtime, self, lambda: status_message(
            self.entries, '/server', True, 0.0), catalogue)
        with mock.patch.object(rospy, 'Service', self.advertised):
            services.advertise_status()
            services.advertise()

    def advertised(self, name, service, handler, error_handler):
        self.services[name.lstrip('~')] = service, handler
        return SimpleNamespace()

    # the processes

    def run_capability_provider(self, provider, provider_path, remember):
        pid = next(self.ids)
        self.processes[pid] = provider.name
        remember(pid)
        return pid

    def begin_stop(self, pid):
        if pid not in self.processes:
            raise RuntimeError('no process %d' % pid)
        self.ends.append(threading.Thread(target=self.ended, args=(pid,)))
        self.ends[-1].start()   # not now, under the lock of the runtime

    def begin_end(self):
        pass

    def ended(self, pid):
        if self.processes.pop(pid, None) is not None:
            self.runtime.launch_ended(pid, 0, 'it ended')

    def end_all(self):
        for pid in list(self.processes):
            self.ended(pid)
        for thread in self.ends:
            thread.join()

    def happens(self, event, bond):
        """Something that is not a request."""
        pid = next(iter(self.processes), None)
        if event == 'a bond breaks':
            self.runtime.bond_broken(bond)
        elif pid is not None and event == 'nodes start':
            self.runtime.launch_reported(pid, SimpleNamespace(kind='started'))
        elif pid is not None:
            self.ended(pid)

    # the bonds, and the audience

    def new_id(self):
        return 'bond_%d' % next(self.bond_numbers)

    def start(self, bond_id):
        pass

    def told(self, event, capability, provider, pid):
        assert (capability + provider).isprintable()

    def status(self, entries):
        self.entries = entries

    def error(self, text):
        assert text.isprintable()

    def must_end(self, status):
        raise AssertionError('the server ends with %s' % status)

    def check_status(self):
        """Only what is exported is ever in the status."""
        known = set(self.runtime.catalogue.spec_index.names)
        serialized(status_message(self.entries, '/server', True, 0.0))
        assert {entry.capability for entry in self.entries} <= known
