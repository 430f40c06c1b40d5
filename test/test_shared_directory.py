"""Directories that share one PostgreSQL: the pure part, and nodes on masters of their own."""
from __future__ import annotations

import signal
import subprocess
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from built import built
from directory import Place, Seen, end
from robot import PATIENCE, eventually
from ros_master import Master

pytest.importorskip('sqlalchemy', reason='SQLAlchemy is not installed')

from rocon_uri.announcement import values_of      # noqa: E402
from rocon_uri.resource_database import ResourceDatabase, announcers, open_engine       # noqa: E402
from rocon_uri.shared_directory import SharedDirectory  # noqa: E402

BOB, ALICE = 'rocon:/pr2/bob/*/*', 'rocon:/turtlebot2/alice/*/*'


@pytest.fixture
def north(postgresql_url):
    return SharedDirectory(postgresql_url, 'north')


@pytest.fixture
def south(postgresql_url, north):
    return SharedDirectory(postgresql_url, 'south')


def announce(directory, announcer, uri, lifetime=60.0, key=''):
    assert directory.announce(announcer, key, values_of(uri), lifetime)
    directory.store()


def test_they_answer_as_one(north, south):
    announce(north, '/robot', BOB)
    announce(south, '/robot', ALICE)        # the same name, on another master
    for directory in north, south:
        assert directory.uris() == directory.find('rocon:/') == [BOB, ALICE]
        assert directory.find('rocon:/pr2') == [BOB]
    announce(south, '/robot', ALICE, 0.0)
    assert north.uris() == [BOB]


def test_a_resource_is_there_until_its_last_announcer_has_gone(north, south):
    announce(north, '/a', BOB)
    announce(south, '/b', BOB)
    announce(south, '/c', BOB, key='k')
    announce(north, '/a', BOB, 0.0)
    announce(south, '/b', ALICE)            # it changes
    assert sorted(north.uris()) == [BOB, ALICE]
    announce(south, '/c', BOB, 0.0, 'k')
    assert north.uris() == south.uris() == [ALICE]


def test_the_longest_lifetime_counts(north, south):
    announce(north, '/a', BOB, 60.0)
    announce(south, '/b', BOB, 0.2)
    announce(south, '/c', ALICE, 0.2)
    eventually(lambda: south.uris() == [BOB])
    announce(north, '/a', BOB, 0.0)     # that of /b has passed, though nobody said so
    assert north.uris() == []


def test_a_goodbye_after_the_directory_was_started_again(postgresql_url, north):
    announce(north, '/a', BOB)
    again = SharedDirectory(postgresql_url, 'north')
    assert again.uris() == [BOB]
    announce(again, '/a', BOB, 0.0)
    assert again.uris() == []


def test_what_somebody_else_stored_for_ever_stays(postgresql_url, north):
    resources = ResourceDatabase(open_engine(postgresql_url))
    resources.add(BOB, payload='mine')
    announce(north, '/a', BOB)
    announce(north, '/a', BOB, 0.0)
    assert resources[BOB] == 'mine'


def test_the_state_differs_when_the_resources_do(north, south):
    states = [south.state()]
    for uri, lifetime in (BOB, 60.0), (ALICE, 60.0), (ALICE, 0.0):
        announce(north, '/a', uri, lifetime)
        states.append(south.state())
    assert states[0] == states[3] and len(set(states)) == 3
    announce(north, '/a', ALICE)
    announce(north, '/a', ALICE)
    assert south.state() == states[2]


def test_what_has_expired_is_removed_from_the_tables(postgresql_url, north, postgresql):
    announce(north, '/a', BOB, 0.1)
    announce(north, '/b', ALICE)
    eventually(lambda: north.uris() == [ALICE])
    for _ in range(10):
        north.store()
    engine = open_engine(postgresql_url)
    for table in 'rocon_uri_announcer', 'rocon_uri_resource':
        with engine.connect() as connection:
            cursor = connection.connection.cursor()
            cursor.execute('SELECT uri FROM ' + table)
            assert cursor.fetchall() == [(ALICE,)]
    engine.dispose()


def test_patterns_and_values_that_are_not_registered(north, south):
    announce(north, '/a', 'rocon:/homemade/bob_*')
    assert south.find('rocon:/*/bob_7') == south.find('rocon:/homemade') == \
        ['rocon:/homemade/bob_*/*/*']
    with pytest.raises(ValueError, match="did you mean 'turtlebot2'"):
        south.find('rocon:/turtelbot2')


def test_many_at_once_do_not_wait_for_each_other_for_ever(postgresql_url, north, south):
    uris = ['rocon:/pr2/bob_%d/*/*' % number for number in range(300)]

    def work(directory, order):
        for lifetime in (60.0, 0.0) * 5 + (60.0,):
            for number in order:
                directory.announce('/a', str(number), values_of(uris[number]), lifetime)
            directory.store()

    with ThreadPoolExecutor() as pool:
        for future in [pool.submit(work, north, range(300)),
                       pool.submit(work, south, range(299, -1, -1))]:
            future.result()
    north.store()
    south.store()
    assert sorted(north.uris()) == sorted(uris)


def test_nothing_is_lost_while_the_database_is_away(postgresql, postgresql_url):
    reports = []
    directory = SharedDirectory(postgresql_url, 'north', report=reports.append)
    announce(directory, '/old', 'rocon:/pr2/old')
    postgresql.stop()
    try:
        announce(directory, '/a', ALICE)
        announce(directory, '/a', BOB)
        announce(directory, '/old', 'rocon:/pr2/old', 0.0)
        announce(directory, '/b', ALICE, 0.1)
        with pytest.raises(OSError):
            directory.find('rocon:/')
        eventually(lambda: len(directory) == 1)     # that of /b is over before it could be stored
    finally:
        postgresql.start()
    directory.store()
    assert directory.uris() == [BOB]
    assert len(reports) == 2
    assert reports[0].startswith('announcements are kept until the database is back: postgresql://')
    assert reports[1] == 'the database is back'


@pytest.fixture(scope='module')
def other_master(tmp_path_factory):
    with Master(tmp_path_factory.mktemp('other_master')) as master:
        yield master


@pytest.fixture
def place(robot, postgresql_url):       # which ends after the nodes
    built('rocon_uri.srv')
    with Place(robot.folder, robot.server_environment) as place:
        yield place


def test_two_masters_have_one_answer(robot, place, other_master, postgresql_url):
    environment = dict(robot.server_environment, ROS_MASTER_URI=other_master.uri)
    with Place(robot.folder, environment) as other:
        place.directory('_database:=' + postgresql_url)
        directory = other.directory('_database:=' + postgresql_url)
        with Seen(place) as seen:
            bob = place.announce('robot', BOB)
            alice = other.announce('robot', ALICE)
            place.wait_for(BOB, ALICE)
            eventually(lambda: sorted(seen.resources[-1].uris) == [BOB, ALICE])
            found = subprocess.run(     # by who asks the other master
                ['rosservice', 'call', other.namespace + '/directory/find', 'rocon:/'],
                env=environment, stdout=subprocess.PIPE, universal_newlines=True, check=True,
                timeout=PATIENCE).stdout
            assert BOB in found and ALICE in found
            end(directory, signal.SIGKILL)
            other.directory('_database:=' + postgresql_url)
            end(alice)
            place.wait_for(BOB)
            eventually(lambda: seen.resources[-1].uris == [BOB])
            end(bob, signal.SIGKILL)
    assert 'Traceback' not in place.text_of('directory') + other.text_of('directory')


def test_the_database_goes_away_for_8_seconds(place, postgresql, postgresql_url):
    import rospy
    place.directory('_database:=' + postgresql_url)
    place.announce('bob', BOB, '--period', '1', '--lifetime', '2')
    goes = place.announce('goes', 'rocon:/pc/goes/*/*')
    place.wait_for(BOB, 'rocon:/pc/goes/*/*')
    postgresql.stop()
    away = threading.Event()
    try:
        place.announce('alice', ALICE, '--period', '1000', '--lifetime', '3000')
        end(goes)
        with pytest.raises(rospy.ServiceException) as error:
            place.find()
        assert 'postgresql://' in str(error.value) and 'postgres@' not in str(error.value)
        away.wait(8.0)      # how long it is away
    finally:
        postgresql.start()
    eventually(lambda: 'the database is back' in place.text_of('directory'))
    place.wait_for(BOB, ALICE)
    assert 'Traceback' not in place.text_of('directory')


def test_a_directory_ends_while_the_database_does_not_answer(place, postgresql, postgresql_url):
    import psycopg2
    directory = place.directory('_database:=' + postgresql_url)
    place.wait_for()
    holder = psycopg2.connect(postgresql_url)
    try:
        cursor = holder.cursor()
        cursor.execute('SELECT pg_advisory_lock(%d)' % announcers._LOCK)
        place.announce('bob', BOB)
        waiting = "SELECT count(*) FROM pg_locks WHERE locktype = 'advisory' AND NOT granted"
        eventually(lambda: cursor.execute(waiting) or cursor.fetchone() == (1,))
        assert end(directory) == 0
    finally:
        holder.close()


@pytest.mark.parametrize('database, text', [
    ('sqlite:///fleet.db', "resource_directory: 'sqlite' is not supported"),
    ('mysql://robots:secret@db/fleet', "resource_directory: 'mysql' is not supported"),
    ('fleet.db', 'resource_directory: the database is not a URL such as'),
    ('postgresql://robots:secret@127.0.0.1:1/fleet', 'resource_directory: postgresql://127.0.0.1:1')])
def test_a_database_that_is_not_one(robot, place, database, text):
    directory = place.directory('_database:=' + database)
    assert directory.wait(PATIENCE) == 2
    written = place.text_of('directory')
    assert text in written and 'secret' not in written and 'Traceback' not in written


def test_a_directory_that_shares_needs_a_name_for_its_master(robot, place, postgresql_url):
    import rospy
    before = rospy.get_param('/run_id')
    rospy.delete_param('/run_id')
    try:
        assert place.directory('_database:=' + postgresql_url).wait(PATIENCE) == 2
        assert '/run_id' in place.text_of('directory')
        place.directory('_database:=' + postgresql_url, '_master:=ours')
        place.wait_for()
    finally:
        rospy.set_param('/run_id', before)
