"""How the tests run, wherever they run."""
from __future__ import annotations

import os
import signal
import sys
import threading
import traceback
from typing import Any, Iterator, List, Optional

import pytest
from hypothesis import Phase, settings

settings.register_profile('rocon_uri', deadline=None)     # a busy machine is no failure
settings.register_profile(      # where it matters that a test fails, and not of what
    'no_shrinking', deadline=None, report_multiple_bugs=False,
    phases=[Phase.explicit, Phase.generate])
settings.load_profile('rocon_uri')

# Where a shell runs the tests in the background it has SIGINT ignored, and what they start would
# inherit that: a signal to a process that has no handler yet would be lost.
signal.signal(signal.SIGINT, signal.default_int_handler)

_unhandled: List[str] = []      # exceptions that ended a thread, or were raised in a __del__


def _note(unhandled: Any) -> None:
    """Keep an exception that nobody handles, of which Python only tells stderr."""
    if unhandled.exc_type is not SystemExit:
        where = getattr(unhandled, 'thread', None) or getattr(unhandled, 'object', None)
        _unhandled.append('unhandled in %r:\n%s' % (where, ''.join(traceback.format_exception(
            unhandled.exc_type, unhandled.exc_value, unhandled.exc_traceback))))


@pytest.hookimpl(trylast=True)     # after the plugins, whose hooks these replace
def pytest_configure(config: Any) -> None:
    """Hear of what nobody handles; newer pytests warn of it, that of Ubuntu 20.04 does not."""
    for name in 'threadexception', 'unraisableexception':
        plugin = config.pluginmanager.get_plugin(name)
        if plugin is not None:
            config.pluginmanager.unregister(plugin)
    threading.excepthook = sys.unraisablehook = _note


def pytest_make_parametrize_id(val: object) -> Optional[str]:
    """Shorten long ones: the name of a test is in the environment of what it starts."""
    shown = ascii(val) if isinstance(val, (str, bytes, int)) else ''
    return '%s... (%d)' % (shown[:60], len(shown)) if len(shown) > 200 else None


@pytest.fixture(autouse=True)
def _fails_of_what_nobody_handles() -> Iterator[None]:
    """Fail the test in which a thread ended with an exception, or a __del__ raised one."""
    yield
    if _unhandled:
        text = '\n'.join(_unhandled)
        _unhandled.clear()
        pytest.fail(text, pytrace=False)


def pytest_sessionfinish() -> None:
    """Fail the run if there was such a one after the last test."""
    if _unhandled:
        raise RuntimeError('\n'.join(_unhandled))


@pytest.fixture
def no_packages_around(monkeypatch):
    """What is found is what a test says, and nothing on the package path of who runs it."""
    monkeypatch.delenv('ROS_PACKAGE_PATH', raising=False)


@pytest.fixture(scope='module')
def master(tmp_path_factory):
    """A master of the module's own, and the package test_nodes (`ros_master.Master`)."""
    from ros_master import Master, make_test_nodes
    folder = tmp_path_factory.mktemp('master')
    make_test_nodes(folder / 'src')
    with Master(folder, folder / 'src') as master:
        yield master


@pytest.fixture(scope='session')
def _robot(tmp_path_factory):
    """The robot of all tests of a process, since that can be one node only."""
    from built import built
    built('capabilities.msg')
    from robot import Robot
    with Robot(tmp_path_factory.mktemp('robot')) as robot:
        yield robot


@pytest.fixture(scope='module')
def robot(_robot):
    """A master with the packages of the tests of the capability server (`robot.Robot`)."""
    before = dict(os.environ)
    os.environ.update(_robot.client_environment)
    yield _robot
    os.environ.clear()
    os.environ.update(before)


@pytest.fixture(scope='module')
def shared_server(robot):
    """A server for the tests of a module that leave it as it was."""
    with robot.server({'nodelet_manager': False,
                       'defaults': {'robot': {'Good': 'robot/good'}}}) as server:
        yield server


@pytest.fixture
def server(shared_server):
    """The server of the module; what a test leaves running on it is stopped."""
    del shared_server.events[:]
    yield shared_server
    for status in shared_server.statuses():
        if status.state != 'failed':
            shared_server.error('stop_capability', status.capability)
    shared_server.wait_for_all_events()     # so that the next test does not see those of this one


@pytest.fixture(scope='session')
def postgresql():
    """A PostgreSQL of this process's own (`postgresql_server.Server`)."""
    pytest.importorskip('sqlalchemy', reason='SQLAlchemy is not installed')
    pytest.importorskip('psycopg2', reason='psycopg2 is not installed')
    from postgresql_server import Server, find_binaries
    if find_binaries() is None:
        pytest.skip('PostgreSQL is not installed')
    server = Server()
    yield server
    server.remove()


@pytest.fixture
def postgresql_url(postgresql):
    """The URL of an empty database of it."""
    with postgresql.database() as url:
        yield url


@pytest.fixture(params=['sqlite', 'postgresql'])
def database_url(request, tmp_path):
    """The URL of an empty database of each kind that is supported."""
    if request.param == 'postgresql':
        return request.getfixturevalue('postgresql_url')
    pytest.importorskip('sqlalchemy', reason='SQLAlchemy is not installed')
    return 'sqlite:///%s' % (tmp_path / 'fleet.db')


@pytest.fixture
def engine(database_url):
    """An engine for it, which does not wait for the disk."""
    import sqlalchemy
    from rocon_uri.resource_database import open_engine
    engine = open_engine(database_url)
    if engine.dialect.name == 'sqlite':
        sqlalchemy.event.listen(engine, 'connect', lambda connection, _: connection.execute(
            'PRAGMA synchronous = OFF'))
    yield engine
    engine.dispose()
