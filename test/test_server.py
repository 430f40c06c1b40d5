"""The capability server, asked as its clients of old ask it: with a master and real processes."""
import pytest

pytest.importorskip('capabilities.msg', reason='the messages are not built')
pytest.importorskip('rospy')

from robot import Robot, eventually     # noqa: E402


@pytest.fixture(scope='module')
def robot(tmp_path_factory):
    with Robot(tmp_path_factory.mktemp('robot')) as robot:
        yield robot


@pytest.fixture(scope='module')
def server(robot):
    with robot.server({'nodelet_manager': False,
                       'defaults': {'robot': {'Good': 'robot/good'}}}) as server:
        yield server


@pytest.fixture(autouse=True)
def clean(request):
    """What a test leaves running on the server that several share is stopped."""
    yield
    if 'server' in request.fixturenames:
        server = request.getfixturevalue('server')
        for status in server.statuses():
            if status.state != 'failed':
                server.error('stop_capability', status.capability)
        del server.events[:]


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
