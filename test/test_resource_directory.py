"""The pure part of the resource directory: announcements, lifetimes, answers."""
from __future__ import annotations

from typing import Any, List

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocon_uri import ResourceIndex, RoconURIValueError, parse
from rocon_uri.announcement import values_of
from rocon_uri.resource_directory import Change, ResourceDirectory, What

BOB, ALICE = 'rocon:/pr2/bob/*/*', 'rocon:/kobuki/alice/*/*'


class Watched:
    """A directory whose time a test says, and all that it tells."""

    def __init__(self) -> None:
        self.now = 0.0
        self.changes: List[Change] = []
        self.reports: List[str] = []
        self.directory = ResourceDirectory(self.changes.append, self.reports.append,
                                           lambda: self.now)

    def announce(self, announcer: str, uri: str, lifetime: float = 10.0, key: str = '') -> bool:
        return self.directory.announce(announcer, key, values_of(uri), lifetime)

    def events(self) -> List[Any]:
        events = [(change.what, change.announcer, str(change.uri),
                   change.before and str(change.before)) for change in self.changes]
        del self.changes[:]
        return events


@pytest.fixture
def watched() -> Watched:
    return Watched()


def test_a_robot_is_there_until_it_says_goodbye(watched: Watched) -> None:
    assert watched.announce('/bob', BOB)
    assert watched.directory.find('rocon:/pr2') == [BOB]
    assert watched.announce('/bob', BOB, 0.0)
    assert watched.directory.find('rocon:/') == []
    assert watched.events() == [(What.APPEARED, '/bob', BOB, None), (What.LEFT, '/bob', BOB, None)]


def test_a_robot_that_falls_silent_is_gone_after_its_lifetime(watched: Watched) -> None:
    watched.announce('/bob', BOB, 10.0)
    watched.announce('/alice', ALICE, 30.0)
    watched.now = 6.0
    watched.announce('/bob', BOB, 10.0)
    watched.now = 15.9
    assert watched.directory.uris() == [BOB, ALICE]
    watched.now = 16.0
    assert watched.directory.find('rocon:/') == [ALICE]
    assert watched.events()[2:] == [(What.EXPIRED, '/bob', BOB, None)]
    watched.now = 30.0
    assert len(watched.directory) == 0


def test_a_robot_that_comes_back_before_anybody_looks_has_expired_and_appeared(
        watched: Watched) -> None:
    watched.announce('/bob', BOB, 10.0)
    watched.now = 10.0
    watched.announce('/bob', BOB, 10.0)
    assert [what for what, *_ in watched.events()] == [What.APPEARED, What.EXPIRED, What.APPEARED]
    watched.now = 20.0
    watched.announce('/bob', BOB, 0.0)
    assert [what for what, *_ in watched.events()] == [What.EXPIRED]


def test_the_newest_announcement_replaces_the_earlier_one_of_its_announcer_only(
        watched: Watched) -> None:
    watched.announce('/bob', BOB)
    watched.announce('/other', BOB)
    watched.announce('/bob', ALICE)
    assert watched.directory.uris() == [BOB, ALICE]
    assert watched.events()[2:] == [(What.CHANGED, '/bob', ALICE, BOB)]


def test_a_uri_of_several_announcers_is_one_resource_until_the_last_has_gone(
        watched: Watched) -> None:
    watched.announce('/a', BOB)
    watched.announce('/b', BOB)
    watched.announce('/a', BOB, key='again')
    assert watched.directory.uris() == [BOB]
    watched.announce('/a', BOB, 0.0)
    watched.announce('/b', BOB, 0.0)
    assert watched.directory.uris() == [BOB]
    watched.announce('/a', BOB, 0.0, key='again')
    assert watched.directory.uris() == []


@pytest.mark.parametrize('lifetime, text', [
    (0.09, 'lifetime 0.09 s is not between 0.1 s and 3600 s'),
    (3601.0, 'lifetime 3601 s is not between 0.1 s and 3600 s'),
    (-1.0, 'lifetime -1 s is not between 0.1 s and 3600 s'),
    (float('nan'), 'lifetime nan s is not between 0.1 s and 3600 s')])
def test_a_lifetime_is_between_a_tenth_of_a_second_and_an_hour(
        watched: Watched, lifetime: float, text: str) -> None:
    watched.announce('/bob', BOB)
    assert not watched.announce('/bob', ALICE, lifetime)
    assert watched.reports == ['refused an announcement of /bob: ' + text]
    assert watched.directory.uris() == [BOB]


def test_what_is_wrong_is_counted_and_shown_once_for_each_announcer_and_text(
        watched: Watched) -> None:
    for announcer in '/a', '/b', '/a':
        for values in ('', ('pr2',), 'b-b', ('*',), ('*',), ''), \
                ('', ('a b',), '*', ('*',), ('*',), ''):
            assert not watched.directory.announce(announcer, '', values, 10.0)
    assert watched.directory.refused == 6
    assert len(watched.reports) == 4
    assert all('\n' not in report for report in watched.reports)
    assert "'b-b'" in watched.reports[0]


def test_reports_that_are_all_different_come_to_an_end(watched: Watched) -> None:
    for number in range(1500):
        watched.directory.refuse('/a', 'fault %d' % number)
    assert watched.directory.refused == 1500
    assert len(watched.reports) == 1001
    assert watched.reports[-1] == 'further announcements that are refused are only counted'


def test_an_announcer_has_at_most_1000_keys(watched: Watched) -> None:
    for number in range(1001):
        assert watched.announce('/a', BOB, key=str(number)) == (number < 1000)
    assert watched.announce('/a', ALICE, key='0')       # one that it has
    assert watched.announce('/b', BOB)
    assert watched.reports == [
        'refused an announcement of /a: it has 1000 keys, the most that one node may have']


def test_there_are_at_most_100000_announcements(watched: Watched) -> None:
    values = values_of(BOB)
    for number in range(100000):
        watched.directory.announce('/a%d' % (number // 1000), str(number), values, 10.0)
    assert len(watched.directory) == 100000
    assert not watched.announce('/b', BOB)
    watched.now = 10.0
    watched.directory.expire()
    assert watched.announce('/b', BOB)


def test_a_key_has_at_most_255_characters(watched: Watched) -> None:
    assert watched.announce('/a', BOB, key=255 * 'k')
    assert not watched.announce('/a', BOB, key=256 * 'k')
    assert watched.reports[0].endswith('has 256 characters, expected at most 255')


def test_an_unregistered_robot_is_there_and_counted(watched: Watched) -> None:
    uri = 'rocon:/homemade/bob/*/*'
    watched.announce('/bob', uri)
    watched.announce('/alice', ALICE)
    assert watched.directory.unregistered() == [uri]
    assert watched.directory.find('rocon:/*/bob') == watched.directory.find('rocon:/homemade') \
        == [uri]


def test_a_request_that_is_wrong_says_what_was_meant(watched: Watched) -> None:
    watched.announce('/bob', BOB)
    with pytest.raises(RoconURIValueError, match=r"did you mean 'turtlebot2'"):
        watched.directory.find('rocon:/turtelbot2')
    with pytest.raises(RoconURIValueError):
        watched.directory.explain('rocon:/pr2/a-b', BOB)


def test_explain_says_why(watched: Watched) -> None:
    assert watched.directory.explain('rocon:/pr2', BOB)
    assert not watched.directory.explain('rocon:/kobuki', BOB)


OPERATIONS = st.lists(st.one_of(
    st.tuples(st.sampled_from('ab'), st.sampled_from(['', 'k']),
              st.sampled_from([BOB, ALICE, 'rocon:/pr2|kobuki/c*']),
              st.sampled_from([0.0, 1.0, 3.0])),
    st.just(1.0)), max_size=30)


@given(OPERATIONS)
def test_it_answers_as_an_index_of_what_is_alive(operations: List[Any]) -> None:
    watched, alive = Watched(), {}
    for operation in operations:
        if isinstance(operation, float):
            watched.now += operation
        else:
            announcer, key, uri, lifetime = operation
            watched.announce(announcer, uri, lifetime, key)
            alive[announcer, key] = parse(uri), watched.now + lifetime
        alive = {who: entry for who, entry in alive.items() if entry[1] > watched.now}
        index = ResourceIndex(uri for uri, _ in alive.values())
        for request in 'rocon:/', 'rocon:/pr2', 'rocon:/*/alice':
            assert sorted(watched.directory.find(request)) == sorted(map(str, index.find(request)))
        assert len(watched.directory) == len(alive)
    seen = {}
    for change in watched.changes:      # they tell it all
        if change.what in (What.LEFT, What.EXPIRED):
            assert seen.pop((change.announcer, change.key)) == change.uri
        else:
            assert seen.get((change.announcer, change.key)) == change.before
            seen[change.announcer, change.key] = change.uri
    assert seen == {who: uri for who, (uri, _) in alive.items()}
