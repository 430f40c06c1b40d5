"""An index of resources: a mapping in order, whose answers are those of a loop."""
import copy
import gc
import pickle
import random
import weakref
from collections.abc import MutableMapping

import pytest
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from rocon_uri import (Field, PatternTooComplex, ResourceIndex, RoconURI, RoconURIValueError,
                       Vocabulary, is_compatible, parse)
from rocon_uri import name_index
from rocon_uri.name_pattern import Glob, NamePattern
from rocon_uri.regular.budget import REQUEST_WORK_LIMIT, WORK_LIMIT
from rocon_uri.regular.intersection import Intersection
from rocon_uri.vocabulary import complete

FLEET = ['rocon:/pr2/bob/noetic/focal', 'rocon:/kobuki/bob_1/noetic', 'rocon:/pr2/bob_2/indigo',
         'rocon:/kobuki|pr2/al*/noetic', 'rocon:/phone/*/*/android', 'rocon://north/pr2/bob_3/*/*',
         'rocon:/turtlebot2/arm_left/noetic/ubuntu', 'rocon:/turtlebot2/[a-c]o+b_[0-9]/noetic',
         'rocon:/tablet/alice/ros/trusty|chrome', 'rocon:/pr2/bob/noetic/focal#apps/teleop']


@pytest.fixture
def fleet():
    return ResourceIndex(FLEET)


@pytest.mark.parametrize('request_text, places', [
    ('rocon:/', range(10)),
    ('rocon:/pr2', [0, 2, 3, 5, 9]),
    ('rocon:/robot', [0, 1, 2, 3, 5, 6, 7, 9]),
    ('rocon:/mobile_device', [4, 8]),
    ('rocon:/*/*/*/linux', [0, 1, 2, 3, 5, 6, 7, 8, 9]),
    ('rocon:/*/*/*/chrome', [1, 2, 3, 5, 7, 8]),
    ('rocon:/*/bob', [0, 4, 9]),
    ('rocon:/*/bob_1', [1, 4, 7]),
    ('rocon:/*/alice', [3, 4, 8]),
    ('rocon:/*/bob_*', [1, 2, 4, 5, 7]),
    ('rocon:/*/*_left', [3, 4, 6]),
    ('rocon:/*/a*_left', [3, 4, 6]),
    ('rocon:/*/b.*2', [2, 4, 7]),
    ('rocon:/*/[a-b].*[13]', [1, 3, 4, 5, 7]),
    ('rocon:/*/nobody', [4]),
    ('rocon://south/pr2', [0, 2, 3, 9]),
    ('rocon:/warthog', []),
])
def test_a_request_finds_the_resources_it_is_compatible_with(fleet, request_text, places):
    expected = [parse(FLEET[place]) for place in places]
    assert list(fleet.find(request_text)) == expected
    assert fleet.count(request_text) == len(expected)
    assert fleet.any(parse(request_text)) is bool(expected)


def test_it_is_a_mapping_in_order_of_insertion(fleet):
    assert isinstance(fleet, MutableMapping)
    assert list(fleet) == [parse(text) for text in FLEET]
    assert all(type(uri) is RoconURI for uri in fleet)
    fleet['rocon:/pc/marvin'] = 'depressed'
    assert list(fleet.items())[-1] == (parse('rocon:/pc/marvin/*/*'), 'depressed')
    assert fleet['rocon:/pc/marvin'] == fleet.pop(parse('rocon:/pc/marvin')) == 'depressed'
    with pytest.raises(KeyError):
        fleet['rocon:/pc/marvin']
    with pytest.raises(KeyError):
        del fleet['rocon:/pc/marvin']
    del fleet['rocon:/pr2/bob/noetic/focal#apps/teleop']
    assert list(fleet) == [parse(text) for text in FLEET[:-1]]


def test_a_resource_without_payload_has_none():
    index = ResourceIndex({'rocon:/pr2': 'payload', 'rocon:/pc': None})
    assert dict(index) == {parse('rocon:/pr2'): 'payload', parse('rocon:/pc'): None}
    assert ResourceIndex(['rocon:/pc']) == {parse('rocon:/pc'): None}


def test_an_equal_resource_replaces_the_payload_and_keeps_its_place(fleet):
    fleet.add('rocon:/pr2|kobuki/al*/noetic', 'new')
    assert fleet['rocon:/kobuki|pr2/al*/noetic/*'] == 'new'
    assert list(fleet) == [parse(text) for text in FLEET]
    fleet.add('rocon:/kobuki|pr2/al*/noetic')
    assert fleet['rocon:/kobuki|pr2/al*/noetic'] is None
    assert fleet.count('rocon:/') == len(fleet) == len(FLEET)


def test_discarding_what_is_not_there_changes_nothing(fleet):
    fleet.discard('rocon:/warthog')
    fleet.discard(FLEET[0])
    fleet.discard(FLEET[0])
    assert list(fleet) == [parse(text) for text in FLEET[1:]]


def test_it_is_emptied_from_the_end(fleet):
    assert fleet.popitem() == (parse(FLEET[-1]), None)
    fleet.clear()
    assert not fleet and not fleet.any('rocon:/')
    with pytest.raises(KeyError):
        fleet.popitem()


def test_what_is_found_are_the_resources_at_the_time_of_the_call(fleet):
    for change in fleet.popitem, fleet.clear:
        expected = list(fleet.find('rocon:/pr2'))
        found = fleet.find('rocon:/pr2')
        change()
        assert list(found) == expected


def test_iteration_over_it_notices_changes_as_that_over_a_dict_does(fleet):
    with pytest.raises(RuntimeError):
        for uri in fleet:
            fleet.discard(uri)


@pytest.mark.parametrize('ask', ['add', 'discard', 'find', 'count', 'any', '__getitem__',
                                 '__contains__'])
def test_what_is_not_a_uri_is_an_error_at_once(fleet, ask):
    with pytest.raises(RoconURIValueError, match='turtelbot'):
        getattr(fleet, ask)('rocon:/turtelbot')


@pytest.mark.parametrize('give', [list, iter, lambda texts: {text: len(text) for text in texts}])
def test_a_text_that_is_not_legal_costs_only_itself_among_all(fleet, give):
    texts = ['rocon:/pr2/bob_9', 'rocon:/pr2/bob-9', 'rocon:/turtelbot/al', FLEET[0], '',
             'rocon:/pc/carol']
    index = ResourceIndex({uri: 'payload' for uri in FLEET})
    faults = index.add_all(give(texts))
    assert [(fault.uri, fault.field) for fault in faults] == [
        ('rocon:/pr2/bob-9', 'name'), ('rocon:/turtelbot/al', 'hardware_platform'), ('', 'uri')]
    assert all(isinstance(fault, RoconURIValueError) for fault in faults)
    assert list(index) == list(fleet) + [parse('rocon:/pr2/bob_9'), parse('rocon:/pc/carol')]
    assert index[FLEET[0]] == (len(FLEET[0]) if isinstance(give(texts), dict) else None)
    assert index[FLEET[1]] == 'payload'


def test_what_is_neither_text_nor_uri_ends_adding(fleet):
    with pytest.raises(TypeError, match='a rocon URI is a str, not int'):
        fleet.add_all(['rocon:/pc/carol', 7, 'rocon:/pc/marvin'])
    assert 'rocon:/pc/carol' in fleet and 'rocon:/pc/marvin' not in fleet


def test_its_repr_says_how_many_resources_it_has(fleet):
    assert repr(fleet) == '<ResourceIndex of 10 resources>'
    assert repr(ResourceIndex(['rocon:/pc'])) == '<ResourceIndex of 1 resource>'
    assert repr(ResourceIndex()) == '<ResourceIndex of 0 resources>'


def test_a_copy_is_another_index(fleet):
    fleet['rocon:/pc'] = ['payload']
    for other in (copy.copy(fleet), copy.deepcopy(fleet), pickle.loads(pickle.dumps(fleet))):
        assert list(other.items()) == list(fleet.items())
        other.discard('rocon:/pc')
        assert 'rocon:/pc' in fleet
        assert other.count('rocon:/*/bob*') == fleet.count('rocon:/*/bob*') - 1


def test_names_are_found_after_every_change():
    kept = ['rocon:/pr2/%s#%s' % (name, app)
            for name in ('bob', 'bob_', 'bob_1', 'bob_z', 'bob_zz9', 'bo', 'az', 'za', 'Z_1',
                         'zz_9', '*', 'bob_*', '[a-z]+_1')
            for app in ('one', 'two', 'three')]
    requests = ['rocon:/pr2/' + name for name in ('bob', 'bob_z', 'bob_*', '*_1', '*9', '*z*', 'z*',
                                                  'b.*[1z]', '.*[_o]', 'zz_[0-9]')]
    index = ResourceIndex()

    def check():
        for request in requests:
            assert list(index.find(request)) == [
                uri for uri in index if is_compatible(uri, request)]
    for uri in kept:
        index.add(uri)
        check()
    for uri in sorted(kept, key=lambda text: text[::-1]):
        index.discard(uri)
        check()


@pytest.mark.parametrize('seed', range(10))
def test_resources_of_one_name_are_discarded_in_any_order(seed):
    index = ResourceIndex('rocon:/pr2/%s#apps/a%d' % ('al' if number % 7 else 'bob', number)
                          for number in range(84))
    uris = list(index.find('rocon:/pr2/bob'))
    for uri in random.Random(seed).sample(uris, len(uris)):
        index.discard(uri)
        uris.remove(uri)
        assert list(index.find('rocon:/pr2/bob')) == uris


@pytest.fixture
def sorts(monkeypatch):
    """The orders of names, each made by sorting all of them once."""
    made = []

    class CountedOrder(name_index._Order):
        def __init__(self, *args):
            made.append(self)
            super().__init__(*args)
    monkeypatch.setattr(name_index, '_Order', CountedOrder)
    return made


def test_names_are_sorted_again_only_after_many_changes(sorts):
    limit = name_index._CHANGES_LIMIT
    index = ResourceIndex('rocon:/pr2/bob_%d' % number for number in range(1000))
    assert index.count('rocon:/pr2/carol*') == 0
    for number in range(limit):
        index.add('rocon:/pr2/al_%d' % number)
        index.discard('rocon:/pr2/bob_%d' % number)
        assert index.count('rocon:/pr2/al*') == number + 1
    for changes, times in ((limit, 1), (limit + 1, 2)):
        for number in range(changes):
            index.add('rocon:/pr2/carol_%d_%d' % (changes, number))
        assert index.count('rocon:/pr2/carol_%d_*' % changes) == changes
        assert len(sorts) == times


@pytest.mark.parametrize('pattern, matched, found, orders', [
    ('al*_left', ['al_0_left', 'al_left', 'bo_left'], ['al_left', 'al_0_left'], 2),
    ('bo*_left', ['bo_left', 'bo_right'], ['bo_left'], 2),
    ('bo*_right', ['bo_right'], ['bo_right'], 2),
    ('al_l*_left', ['al_left'], [], 1), ('carol*_left', [], [], 1),
])
def test_only_names_with_the_prefix_or_those_with_the_suffix_are_matched(
        pattern, matched, found, orders, sorts, monkeypatch):
    names = ['al_%d' % number for number in range(100)] \
        + ['al_left', 'al_0_left', 'bo_left', 'bo_right']
    index = ResourceIndex('rocon:/pr2/' + name for name in names)
    compared, matches = [], Glob.matches
    monkeypatch.setattr(
        Glob, 'matches', lambda glob, name: compared.append(name) or matches(glob, name))
    assert list(index.find('rocon:/pr2/' + pattern)) == [
        parse('rocon:/pr2/' + name) for name in found]
    assert (sorted(compared), len(sorts)) == (matched, orders)


def test_many_names_that_end_alike():
    index = ResourceIndex('rocon:/pr2/%s_%d_left' % (name, number)
                          for number in range(100) for name in 'abcdefgh')
    for pattern in ('(a|c|e)_[0-9]*_left', '[b-d].*7_left', '[a-h]_(1|3|5)[0-9]?_left'):
        request = parse('rocon:/*/' + pattern)
        assert list(index.find(request)) == [uri for uri in index if is_compatible(uri, request)]


class TestUndecided:
    """Two patterns that take too much work to compare."""

    REQUEST = 'rocon:/*/(a|b)*a(a|b){200}'
    HARD = 'rocon:/pr2/(a|b)*b(a|b){120}'

    def test_everything_else_comes_first(self):
        with pytest.raises(PatternTooComplex):
            is_compatible(self.REQUEST, self.HARD)
        index = ResourceIndex([self.HARD, 'rocon:/pr2/a*', self.HARD + '#app', 'rocon:/pr2/bob'])
        found = index.find(self.REQUEST)
        assert next(found) == parse('rocon:/pr2/a*')
        with pytest.raises(PatternTooComplex, match='2 resources') as raised:
            next(found)
        assert raised.value.undecided == [parse(self.HARD), parse(self.HARD + '#app')]
        request = parse(self.REQUEST)
        assert (raised.value.uri, raised.value.field, raised.value.value) == (
            str(request), 'name', request.name.string)

    def test_any_is_true_if_one_matches_that_is_decided(self):
        index = ResourceIndex([self.HARD])
        with pytest.raises(PatternTooComplex) as raised:
            index.any(self.REQUEST)
        assert raised.value.undecided == [parse(self.HARD)]
        index.add('rocon:/pr2/a*')
        assert index.any(self.REQUEST)

    def test_a_count_is_exact_or_an_error(self):
        index = ResourceIndex([self.HARD, 'rocon:/pr2/a*'])
        with pytest.raises(PatternTooComplex) as raised:
            index.count(self.REQUEST)
        assert raised.value.undecided == [parse(self.HARD)]
        assert index.count('rocon:/pc') == 0

    def test_the_undecided_are_in_order_of_insertion(self):
        kinds = ['rocon:/%s/' % platform for platform in ('pr2', 'kobuki', 'pr2|kobuki')]
        hard = [kinds[number % 3] + '(a|b)*b(a|b){%d}' % (120 + number % 5)
                for number in (7, 3, 11, 2, 9, 6, 1, 4)]
        index = ResourceIndex()
        for place, uri in enumerate(hard):
            index.add(uri, place)
            index.add('rocon:/pr2/a_%d' % place)
        with pytest.raises(PatternTooComplex, match='of 8 resources') as raised:
            index.any(self.REQUEST)
        assert raised.value.undecided == [parse(uri) for uri in hard]

    def test_what_no_field_lets_through_is_not_undecided(self):
        index = ResourceIndex([self.HARD])
        assert not index.any(self.REQUEST.replace('*', 'pc', 1))


class TestBudget:
    """The work that all comparisons of one request may take together."""

    REQUEST = '.*a.{40}'

    @pytest.fixture
    def products(self, monkeypatch):
        """The products of automata that are walked, each once for a little and once in full."""
        made = []

        def intersection(*args):
            made.append(Intersection(*args))
            return made[-1]
        monkeypatch.setattr('rocon_uri.regular.intersection.Intersection', intersection)
        return made

    def test_hundreds_of_hard_patterns_take_no_more_than_ten(self, products):
        hard = ['rocon:/pr2/.*[ab].{%d}c%d' % (20 + number % 100, number) for number in range(400)]
        index = ResourceIndex(hard + ['rocon:/pr2/[x-z]+_?'])
        found = index.find('rocon:/*/' + self.REQUEST)
        taken = sum(product.work for product in products)
        assert REQUEST_WORK_LIMIT - WORK_LIMIT < taken
        assert taken + sum(8 * (product.one.tree.size + product.other.tree.size)
                           for product in products) < REQUEST_WORK_LIMIT + WORK_LIMIT
        matching = []
        with pytest.raises(PatternTooComplex) as raised:
            for uri in found:
                matching.append(uri)
        assert 200 < len(raised.value.undecided) < 400
        assert sorted(map(str, matching + raised.value.undecided)) \
            == sorted(str(parse(uri)) for uri in hard)

    def test_easy_comparisons_come_first_wherever_they_were_added(self):
        hard = ['rocon:/pr2/(a|b)*b(a|b){%d}' % (120 + number) for number in range(30)]
        easy = ['rocon:/pr2/[w-z]_%d?' % number for number in range(10)]
        request = 'rocon:/*/((a|b)*a(a|b){200}|x_)'
        for texts in (hard + easy, easy + hard):
            found = ResourceIndex(texts).find(request)
            assert [next(found) for _ in easy] == list(map(parse, easy))
            with pytest.raises(PatternTooComplex) as raised:
                next(found)
            assert raised.value.undecided == list(map(parse, hard))

    def test_any_compares_no_hard_patterns_once_something_matches(self, products):
        index = ResourceIndex(['rocon:/pr2/.*[ab].{40}c', 'rocon:/kobuki/[w-z]_'])
        assert index.any('rocon:/*/(.*a.{40}|x_)')
        assert sum(product.work for product in products) < WORK_LIMIT / 50

    def test_a_pattern_of_several_kinds_is_compared_once(self, products):
        index = ResourceIndex('rocon:/%s/.*[ab].{40}c%s' % (platform, app)
                              for platform in ('pr2', 'kobuki', 'pc') for app in ('', '#a/b'))
        assert index.count('rocon:/*/' + self.REQUEST) == 6
        assert len(products) == 2

    def test_what_takes_work_to_tell_apart_is_not_undecided(self, products):
        index = ResourceIndex(['rocon:/pr2/.*b.{12}', 'rocon:/pr2/.*[ab].{12}c'])
        assert list(index.find('rocon:/*/.*a.{12}')) == [parse('rocon:/pr2/.*[ab].{12}c')]
        assert len(products) > 2        # one at least was compared again, with more work

    def test_each_request_has_a_budget_of_its_own(self):
        index = ResourceIndex('rocon:/pr2/(a|b)*b(a|b){%d}' % (120 + number)
                              for number in range(20))
        index.add('rocon:/pr2/.*[ab].{40}c')
        for _ in range(2):
            with pytest.raises(PatternTooComplex):
                index.count('rocon:/*/(a|b)*a(a|b){200}')
            assert index.any('rocon:/*/' + self.REQUEST)


class TestNothingIsKept:
    """What was discarded can be freed."""

    class Payload:
        pass

    @staticmethod
    def held_by(index):
        """What an index refers to, but not what resources and their fields refer to."""
        found, waiting = {}, [*vars(index).values()]
        while waiting:
            here = waiting.pop()
            if id(here) not in found and not isinstance(here, type):
                found[id(here)] = here
                if not isinstance(here, (RoconURI, Field, Vocabulary)):
                    waiting += gc.get_referents(here)
        return found.values()

    @pytest.mark.parametrize('kept', [[], ['rocon:/pr2/carol', 'rocon:/pc/carol/noetic']])
    @pytest.mark.parametrize('size', [3, 300])
    def test_of_resources_that_were_discarded(self, kept, size):
        texts = [text % number for number in range(size) for text in (
            'rocon:/pr2/bob_%d', 'rocon:/kobuki/bob_%d_*', 'rocon:/pc/[ab]+%d/noetic',
            'rocon:/pc/al_%d/noetic')]
        index = ResourceIndex({uri: self.Payload() for uri in texts + kept})
        for request in ('rocon:/*/bob_1*', 'rocon:/*/*_1', 'rocon:/*/[a-c]o*.*'):
            assert index.count(request) > 0
        for uri in texts:
            index.discard(uri)
        held = list(self.held_by(index))
        assert sum(isinstance(thing, self.Payload) for thing in held) == len(kept)
        uris = {thing for thing in held if isinstance(thing, RoconURI)}
        assert {uri.name_text for uri in uris} <= {'*', 'carol'}
        assert {uri.replace(name='*') for uri in uris} == {
            parse(uri).replace(name='*') for uri in kept}
        assert not [thing for thing in held if isinstance(thing, NamePattern)]
        assert {thing for thing in held if isinstance(thing, str)} - set(vars(index)) \
            <= {'', 'carol', 'lorac'}

    def test_of_the_payload_that_another_replaced(self, fleet):
        payloads = [self.Payload() for _ in FLEET]
        references = list(map(weakref.ref, payloads))
        for uri, payload in zip(FLEET, payloads):
            fleet[uri] = payload
        del payloads, payload
        for number, uri in enumerate(FLEET):
            fleet[uri] = None if number % 2 else number
        assert [reference() for reference in references] == [None] * len(FLEET)

    def test_of_a_pattern_that_no_resource_has_any_more(self, monkeypatch):
        compared = []
        intersects = NamePattern.intersects

        def counted(pattern, other, *budget):
            compared.append(other.text)
            return intersects(pattern, other, *budget)
        index = ResourceIndex('rocon:/pr2/%s%s' % (name, app) for name in ('b*', '[ab]+')
                              for app in ('', '#a/b', '#a/c'))
        index.add('rocon:/pr2/alice')
        monkeypatch.setattr(NamePattern, 'intersects', counted)
        for app, expected in (('', 4), ('#a/b', 2), ('#a/c', 0)):
            for name in ('b*', '[ab]+'):
                index.discard('rocon:/pr2/' + name + app)
            compared.clear()
            assert index.count('rocon:/*/b.*') == expected
            assert compared == ['b*', '[ab]+'] * (expected > 0)


class TestVocabularies:
    """Resources and requests that were read with different vocabularies."""

    ours = complete().extended({'hardware_platform': {'mobile_device': ['our_phone']}})

    def test_a_group_has_the_extent_that_the_newer_one_gives_it(self):
        index = ResourceIndex(['rocon:/mobile_device/bob', 'rocon:/pr2/al'])
        assert list(index.find(parse('rocon:/our_phone', self.ours))) == [
            parse('rocon:/mobile_device/bob')]
        index.add(parse('rocon:/our_phone/marvin', self.ours))
        assert index.count('rocon:/mobile_device') == 2
        assert index.count('rocon:/pr2') == 1

    def test_an_equal_resource_of_another_vocabulary_is_the_same(self):
        index = ResourceIndex([parse('rocon:/pr2/bob', self.ours)])
        index.add('rocon:/pr2/bob')
        assert len(index) == index.count('rocon:/pr2') == 1
        index.add('rocon:/pr2/al')
        index.discard('rocon:/pr2/bob')
        assert list(index) == list(index.find('rocon:/')) == [parse('rocon:/pr2/al')]

    def test_anything_at_all_meets_what_is_not_registered(self):
        unknown = parse('rocon:/our_robot/bob', Vocabulary.open())
        index = ResourceIndex(['rocon:/', 'rocon:/pr2', unknown])
        assert list(index.find('rocon:/')) == [parse('rocon:/'), parse('rocon:/pr2'), unknown]
        assert list(index.find(unknown)) == [parse('rocon:/'), unknown]

    def test_of_two_that_know_nothing_of_each_other_only_anything_at_all_meets(self):
        theirs = Vocabulary({'hardware_platform': ['their_robot']})
        index = ResourceIndex(['rocon:/'])
        assert index.count(parse('rocon:/their_robot/bob', theirs)) == 1
        index = ResourceIndex([parse('rocon:/their_robot/bob', theirs)])
        assert index.count('rocon:/') == 1
        newest = Vocabulary({'hardware_platform': ['newest']})
        for request in (parse('rocon:/newest', newest), parse('rocon:/*/bob', newest)):
            with pytest.raises(RoconURIValueError, match='their_robot'):
                index.count(request)
        index.add('rocon:/pr2')
        assert list(index.find(parse('rocon:/', newest))) == list(index)


PLATFORMS = ['*', 'pr2', 'kobuki', 'pr2|kobuki', 'kobuki|pr2', 'robot', 'phone|tablet', 'galaxy',
             'mobile_device']
FRAMEWORKS = ['*', 'noetic', 'ros', 'indigo|noetic']
SYSTEMS = ['*', 'focal', 'ubuntu', 'trusty|chrome', 'linux']
NAMES = ['*', 'bob', 'bob_1', 'bob_2', 'bob_10', 'al', 'al_2', 'bo', 'z', 'Z', 'bob_*', 'b*', '*_2',
         '*b*', '**', 'b*_*2', 'bob_[0-9]+', '[a-z]+_?[12]*', '(al|bob).*', '[a-z]o?b?',
         '.*[_A-Z].*',
         'b.*_.', '.{2,4}', '(bob)_2']
VOCABULARIES = [Vocabulary.bundled(), complete(), TestVocabularies.ours,
                TestVocabularies.ours.opened()]


def some_uris(*vocabularies):
    """RoconURIs of few parts, so that many of them meet."""
    choose = random.Random(4).choice
    return [RoconURI.from_fields(
        choose(['', '', '', 'north', 'south']), choose(PLATFORMS), choose(NAMES),
        choose(FRAMEWORKS), choose(SYSTEMS), choose(['', '', 'apps/teleop']), choose(vocabularies))
        for _ in range(600)]


class IndexAndLoop(RuleBasedStateMachine):
    """Whatever is added and discarded, an index and a loop over a dict give the same answers."""

    uris = st.sampled_from(some_uris(None))

    def __init__(self):
        super().__init__()
        self.index = ResourceIndex()
        self.expected = {}

    @rule(data=st.data(), payload=st.sampled_from([None, 1, 2]), as_text=st.booleans())
    def add(self, data, payload, as_text):
        uri = data.draw(self.uris)
        self.index.add(str(uri) if as_text and uri.vocabulary is parse().vocabulary else uri,
                       payload)
        self.expected[uri] = payload

    @rule(data=st.data(), count=st.integers(2, 150))
    def add_names(self, data, count):
        """So many at once that an index rather sorts again than inserts them."""
        uri = data.draw(self.uris)
        for number in range(count):
            self.index.add(uri.replace(name='bob_%d' % number), number)
            self.expected[uri.replace(name='bob_%d' % number)] = number

    @rule(data=st.data())
    def discard(self, data):
        known = list(self.expected)
        uri = data.draw(st.one_of(st.sampled_from(known), self.uris) if known else self.uris)
        self.index.discard(uri)
        self.expected.pop(uri, None)

    @rule(data=st.data(), ask=st.sampled_from(['find', 'count', 'any']))
    def ask(self, data, ask):
        request = data.draw(self.uris)
        matching = [uri for uri in self.expected if is_compatible(request, uri)]
        answer = getattr(self.index, ask)(request)
        assert (list(answer) if ask == 'find' else answer) == {
            'find': matching, 'count': len(matching), 'any': bool(matching)}[ask]

    @invariant()
    def the_same_mapping(self):
        assert list(self.index.items()) == list(self.expected.items())
        assert len(self.index) == len(self.expected)


class OfSeveralVocabularies(IndexAndLoop):
    """The same, where URIs were read with different vocabularies."""

    uris = st.sampled_from(some_uris(*VOCABULARIES))


TestIndexAndLoop = IndexAndLoop.TestCase
TestIndexAndLoop.settings = settings(max_examples=40, stateful_step_count=40, deadline=None,
                                      suppress_health_check=[HealthCheck.too_slow])
TestOfSeveralVocabularies = OfSeveralVocabularies.TestCase
TestOfSeveralVocabularies.settings = TestIndexAndLoop.settings
