"""The node resource_directory, and robots that announce themselves to it, on a real master."""
from __future__ import annotations

import signal
import subprocess
import sys

import pytest

from built import built
from directory import ANNOUNCE, DIRECTORY, Place, Seen, end
from made_packages import make_package
from robot import PATIENCE, eventually

srv = built('rocon_uri.srv')

BOB, ALICE = 'rocon:/pr2/bob/*/*', 'rocon:/turtlebot2/alice/*/*'
FAST = '--period', '0.5', '--lifetime', '1'


@pytest.fixture
def place(robot):
    with Place(robot.folder, robot.server_environment) as place:
        yield place


def test_robots_come_and_go(place):
    place.directory()
    with Seen(place) as seen:
        bob = place.announce('bob', BOB)
        alice = place.announce('alice', ALICE)
        place.wait_for(BOB, ALICE)
        assert place.find('rocon:/turtlebot2|pc') == [ALICE]
        eventually(lambda: sorted(seen.resources[-1].uris) == [BOB, ALICE])
        assert end(bob) == 0
        place.wait_for(ALICE)
        eventually(lambda: seen.resources[-1].uris == [ALICE])
        assert end(alice, signal.SIGTERM) == 0
        place.wait_for()
        eventually(lambda: len(seen.changes) == 4)
    told = {(change.what, change.uri, change.announcer, change.before) for change in seen.changes}
    ours = place.namespace
    assert told == {(what, uri, ours + name, '') for what in (1, 3)
                    for uri, name in ((BOB, '/bob'), (ALICE, '/alice'))}


def test_a_robot_that_dies_without_a_word_expires(place):
    place.directory()
    with Seen(place) as seen:
        bob = place.announce('bob', BOB, *FAST)
        place.announce('alice', ALICE, *FAST)
        place.wait_for(BOB, ALICE)
        end(bob, signal.SIGKILL)
        place.wait_for(ALICE)
        eventually(lambda: seen.resources[-1].uris == [ALICE])
        eventually(lambda: [change.uri for change in seen.changes if change.what == 4] == [BOB])
        place.announce('bob', BOB, *FAST)       # under the same name
        place.wait_for(BOB, ALICE)


def test_a_robot_of_the_same_name_replaces_the_earlier_one(place):
    place.directory()
    first = place.announce('bob', BOB)
    place.wait_for(BOB)
    place.announce('bob', ALICE)
    place.wait_for(ALICE)
    assert first.wait(PATIENCE) == 0      # not anonymous: the master ends it


def test_a_directory_that_was_killed_and_comes_back_has_its_robots_again(place):
    directory = place.directory()
    place.announce('bob', BOB, '--period', '1000', '--lifetime', '3000')
    place.announce('alice', ALICE)
    place.wait_for(BOB, ALICE)
    end(directory, signal.SIGKILL)
    place.directory()
    place.wait_for(BOB, ALICE)      # the announcements are latched


def test_robots_may_come_before_the_directory(place):
    place.announce('bob', BOB, '--period', '1000', '--lifetime', '3000')
    place.directory()
    place.wait_for(BOB)


def test_by_default_a_robot_announces_this_machine(place):
    import rospy
    from rocon_uri.messages import from_msg
    from rocon_uri.msg import Announcement
    from rocon_uri.platform import (
        default_robot_name, default_robot_type, generate_platform_rocon_uri)
    said = []
    subscriber = rospy.Subscriber(place.namespace + '/resource_announcements', Announcement,
                                  said.append)
    try:
        robot = place.run(ANNOUNCE, 'robot')
        eventually(lambda: said)
        assert end(robot) == 0
        eventually(lambda: said[-1].lifetime.to_sec() == 0)
    finally:
        subscriber.unregister()
    assert str(from_msg(said[0].uri)) == str(
        generate_platform_rocon_uri(default_robot_type, default_robot_name()))
    assert (said[0].key, said[0].lifetime.to_sec()) == ('', 15.0)     # three periods of 5 s
    assert said[0]._connection_header['callerid'] == place.namespace + '/robot'
    assert said[0]._connection_header['latching'] == '1'


def test_one_call_announces_changes_and_ends(robot, place, monkeypatch):
    from rocon_uri import announcer as module
    # this process is a node in another namespace
    monkeypatch.setattr(module, 'TOPIC', place.namespace + '/resource_announcements')
    place.directory()
    with Seen(place) as seen:
        with module.Announcer(BOB, 0.5) as announcer, module.Announcer(ALICE, 0.5, key='second'):
            place.wait_for(BOB, ALICE)
            announcer.change('rocon:/pc/bob/*/*')
            place.wait_for('rocon:/pc/bob/*/*', ALICE)
        place.wait_for()
        eventually(lambda: len(seen.changes) == 5)
    changed = next(change for change in seen.changes if change.what == 2)
    assert (changed.before, changed.uri, changed.key) == (BOB, 'rocon:/pc/bob/*/*', '')


def test_what_is_wrong_is_shown_once_and_touches_no_other_robot(place):
    import rospy
    from rocon_uri.msg import Announcement, RoconURI
    place.directory()
    place.announce('bob', BOB)
    place.wait_for(BOB)
    publisher = rospy.Publisher(place.namespace + '/resource_announcements', Announcement,
                                queue_size=100)
    try:
        eventually(publisher.get_num_connections)
        for lifetime in 5, 5, 7200:
            publisher.publish(Announcement(uri=RoconURI(name='not legal'),
                                           lifetime=rospy.Duration(lifetime)))
        publisher.publish(Announcement(uri=RoconURI(name='fine'), lifetime=rospy.Duration(60)))
        place.wait_for(BOB, 'rocon:/*/fine/*/*')
        eventually(lambda: 'announcements refused so far: 3' in place.text_of('directory'))
    finally:
        publisher.unregister()
    text = place.text_of('directory')
    assert text.count("'not legal'") == 1
    assert text.count('lifetime 7200 s is not between') == 1
    assert 'Traceback' not in text


def test_who_lies_in_the_handshake_does_not_count(robot, place):
    """A publisher that says another node's name than the one that it has at the master."""
    import rospy
    from rospy.impl import tcpros_pubsub
    from rocon_uri.msg import Announcement, RoconURI
    place.directory()
    place.announce('bob', BOB)
    place.wait_for(BOB)
    original = tcpros_pubsub.TCPROSPub.get_header_fields
    tcpros_pubsub.TCPROSPub.get_header_fields = lambda self: dict(
        original(self), callerid=place.namespace + '/bob')
    publisher = rospy.Publisher(place.namespace + '/resource_announcements', Announcement,
                                queue_size=100)
    try:
        eventually(publisher.get_num_connections)
        publisher.publish(Announcement(uri=RoconURI(name='liar'), lifetime=rospy.Duration(60)))
        publisher.publish(Announcement(uri=RoconURI(name='liar'), lifetime=rospy.Duration(0)))
        eventually(lambda: 'announcements refused so far: 2' in place.text_of('directory'))
    finally:
        tcpros_pubsub.TCPROSPub.get_header_fields = original
        publisher.unregister()
    assert place.find() == [BOB]
    assert place.text_of('directory').count('does not know that name at the address') == 1


def test_a_robot_that_is_not_registered_is_there(place):
    place.directory()
    place.announce('bob', 'rocon:/turtelbot2/bob')
    place.wait_for('rocon:/turtelbot2/bob/*/*')
    eventually(lambda: 'which is not registered: 1'
               in place.text_of('directory'))
    assert "did you mean 'turtlebot2'" in place.text_of('bob')


def test_services_refuse_in_one_line(place):
    import rospy
    place.directory()
    for call, text in [
            (('find', 'rocon:/turtelbot2'), "did you mean 'turtlebot2'"),
            (('find', 'rocon:/*/a b'), 'no white space'),
            (('explain', 'rocon:/pr2', 'http://pr2'), "'http"),
            (('find_robots', 'nothing/here'), "app 'nothing/here' is not known")]:
        with pytest.raises(rospy.ServiceException) as error:
            place.call(*call)
        assert text in str(error.value)
        assert '\n' not in str(error.value)
    assert 'Traceback' not in place.text_of('directory')


def test_explain_shows_the_fields(place):
    place.directory()
    answer = place.call('explain', 'rocon:/pr2', ALICE)
    assert not answer.compatible
    assert answer.text.startswith('not compatible\n')
    assert place.call('explain', 'rocon:/*/bob', BOB).compatible


def test_find_robots_by_the_apps_of_the_packages(robot, place, tmp_path):
    package = make_package(tmp_path, 'our_apps', [('rocon_app', 'dance.rapp'),
                                                  ('rocon_app', 'sing.rapp')])
    for name, platform in ('dance', 'rocon:/pr2'), ('sing', 'rocon:/'):
        (package / (name + '.rapp')).write_text(
            'display: %s\ncompatibility: %s\nlaunch: x.launch\n' % (name, platform))
    place.environment['ROS_PACKAGE_PATH'] = str(tmp_path)
    place.directory()
    place.announce('bob', BOB)
    place.announce('alice', ALICE)
    place.wait_for(BOB, ALICE)
    assert {answer.app: sorted(answer.robots) for answer in place.call('find_robots', '').apps} \
        == {'our_apps/dance': [BOB], 'our_apps/sing': [BOB, ALICE]}
    dance, = place.call('find_robots', 'our_apps/dance').apps
    assert dance.robots == [BOB]
    import rospy
    with pytest.raises(rospy.ServiceException, match="did you mean 'our_apps/dance'"):
        place.call('find_robots', 'our_apps/danse')


@pytest.mark.parametrize('program, arguments, text', [
    (ANNOUNCE, ['rocon:/pr2/a b'], 'announce: a rocon URI has no white space'),
    (ANNOUNCE, [BOB, '--lifetime', '9'], 'announce: lifetime 9 s is not at least twice the period'),
    (ANNOUNCE, [BOB, '--period', '3000'], 'announce: lifetime 9000 s is not between'),
    (ANNOUNCE, [BOB, '--period', '0'], 'announce: period 0 s is not greater than 0'),
    (ANNOUNCE, [BOB, '--key', 300 * 'k'], 'announce: key '),
    (DIRECTORY, ['here'], "resource_directory: argument 'here' is not expected")])
def test_arguments_that_are_wrong(robot, program, arguments, text):
    done = subprocess.run([sys.executable, '-c', program, *arguments],
                          env=robot.server_environment, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, universal_newlines=True, timeout=PATIENCE)
    assert done.returncode == 2
    assert done.stderr.startswith(text)
    assert done.stderr.count('\n') == 1


@pytest.mark.parametrize('name, program, arguments', [
    ('announce', ANNOUNCE, [BOB]), ('resource_directory', DIRECTORY, [])])
def test_who_gives_up_waiting_for_a_master_is_told_in_one_line(robot, name, program, arguments):
    node = subprocess.Popen([sys.executable, '-u', '-c', program, *arguments],
                            env=dict(robot.server_environment, ROS_MASTER_URI='http://127.0.0.1:1'),
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
    try:
        assert node.stdout.readline().startswith('Unable to register with master node')
        node.send_signal(signal.SIGINT)
        _, err = node.communicate(timeout=PATIENCE)
        assert (node.returncode, err) == (
            2, '%s: ended before a ROS master answered at http://127.0.0.1:1\n' % name)
    finally:
        node.kill()
        node.communicate()
