"""What is read key by key: each fault is raised, or noted, with its place and what was expected."""
from __future__ import annotations

import pickle

import pytest

from capabilities.discovery import (
    DuplicateNameException, InterfaceNameNotFoundException, PackageError)
from capabilities.specs.interface import InvalidInterface
from rocon_uri.apps.rapp import InvalidRapp
from rocon_uri.sources.checked import Reading
from rocon_uri.sources.located import LocatedError
from rocon_uri.sources.yaml_data import YamlError


class Noting(Reading):
    """Notes faults, and reads on."""

    def __init__(self):
        super().__init__('f.yaml', LocatedError)
        self.faults = []

    def refuse(self, fault):
        self.faults.append(str(fault))


def read_all(reading, text):
    """Read a text as a thing whose parts are of all kinds; what is read of it."""
    thing = reading.load(text, 'the thing')
    names = thing.mapping('names', 'the names')
    parts = thing.mapping('parts')
    return (
        thing.required_text('name', ('name', 'about', 'names', 'list', 'parts')),
        thing.text('about', may_be_empty=True),
        {names.key_text(key, 'a name'): names.text_at(key, 'the name of %s') for key in names},
        [item.required_text('id') for item in reading.mappings(thing.sequence('list'), 'an item')],
        [parts.mapping(key, 'part %s').text('type') for key in parts])


GOOD = '{name: a, about: "", names: {b: c}, list: [{id: d}], parts: {e: {type: f}}}'


def test_what_is_right_is_read():
    assert read_all(Reading('f.yaml', YamlError), GOOD) == ('a', '', {'b': 'c'}, ['d'], ['f'])
    assert read_all(Reading('f.yaml', YamlError), '{name: a, names: [], list: {}, parts: }') == (
        'a', None, {}, [], [])


@pytest.mark.parametrize('old, new, fault, read', [
    (GOOD, '[', '2:1: did not find expected node content while parsing a flow node', None),
    (GOOD, '- a', '1:1: the thing is a list, expected a mapping', None),
    (GOOD, '', '1:1: the thing is empty, expected a mapping', None),
    ('name: a', 'name: ', '1:2: the thing has no name', ('', '', {'b': 'c'}, ['d'], ['f'])),
    ('name: a', 'naem: a', "1:2: unknown key 'naem', and the thing has no name (did you mean "
     "'name'?)", ('', '', {'b': 'c'}, ['d'], ['f'])),
    ('name: a', 'name: 7', '1:8: name is 7, expected text', ('', '', {'b': 'c'}, ['d'], ['f'])),
    ('name: a', 'name: a, name: b', "1:11: duplicate key 'name'",
     ('b', '', {'b': 'c'}, ['d'], ['f'])),
    ('about: ""', 'about: [a]', '1:18: about is a list, expected text',
     ('a', None, {'b': 'c'}, ['d'], ['f'])),
    ('{b: c}', 'b', "1:29: the names is 'b', expected a mapping", ('a', '', {}, ['d'], ['f'])),
    ('b: c', '7: c', '1:30: a name is 7, expected text', ('a', '', {'': 'c'}, ['d'], ['f'])),
    ('b: c', 'b: 7', "1:33: the name of 'b' is 7, expected text",
     ('a', '', {'b': ''}, ['d'], ['f'])),
    ('[{id: d}]', 'd', "1:43: list is 'd', expected a list", ('a', '', {'b': 'c'}, [], ['f'])),
    ('{id: d}', 'd', "1:44: an item is 'd', expected a mapping", ('a', '', {'b': 'c'}, [], ['f'])),
    ('id: d', 'x: d', '1:44: an item has no id', ('a', '', {'b': 'c'}, [''], ['f'])),
    ('type: f', 'type: 7', "1:72: type of part 'e' is 7, expected text",
     ('a', '', {'b': 'c'}, ['d'], [None])),
    ('type: f', 'type: f, type: f', "1:75: duplicate key 'type' in part 'e'",
     ('a', '', {'b': 'c'}, ['d'], ['f'])),
])
def test_a_fault_is_raised_or_noted_and_read_as_if_nothing_were_there(old, new, fault, read):
    text = GOOD.replace(old, new, 1)
    with pytest.raises(YamlError) as caught:
        read_all(Reading('f.yaml', YamlError), text)
    assert str(caught.value) == 'f.yaml:' + fault
    noting = Noting()
    found = read_all(noting, text)
    assert noting.faults[0] == 'f.yaml:' + fault
    if read is not None:
        assert (noting.faults[1:], found) == ([], read)


def test_duplicate_keys_are_refused_at_any_depth():
    reading = Noting()
    reading.refuse_duplicates(reading.data('a: [{b: {c: 1, c: 2}}]\na: [{b: 1, b: 2}]'))
    assert reading.faults == ["f.yaml:2:1: duplicate key 'a'", "f.yaml:2:12: duplicate key 'b'"]


def test_plain_data_have_no_place():
    with pytest.raises(YamlError) as caught:
        Reading('<dict>', YamlError).mapping({'name': 7}, 'the thing').text('name')
    assert str(caught.value) == '<dict>: name is 7, expected text'
    assert caught.value.place == (None, None)


@pytest.mark.parametrize('error', [
    YamlError('p', 'f', 1, 2), InvalidInterface('p', 'f'), InvalidRapp('p', 'f', 1, 2),
    PackageError(problem='p', file_name='f', line=1, column=2),
    DuplicateNameException('p', 'f', 1, 2, 'a/B', 'a', 'interface'),
    InterfaceNameNotFoundException('p', 'f', 1, 2, 'a/B', 'a', 'provider', 'a/Lazer',
                                   ['a/Laser', 'a/Camera']),
])
def test_errors_can_be_pickled(error):
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again), again.place) == (type(error), str(error), error.place)
    assert again.problem == 'p' and again.sentence == error.sentence
    assert isinstance(again, ValueError) == isinstance(error, ValueError)


def test_near_misses_are_only_looked_for_while_there_is_room_for_warnings():
    class Full(Noting):
        def has_room(self):
            return len(self.noted) < 2

        def warn(self, problem, place, fault_id):
            self.noted.append(problem)

        def expectation(self, found, known):
            self.asked += 1
            return ''

    reading = Full()
    reading.noted, reading.asked = [], 0
    reading.load('{a: 1, b: 2, c: 3, d: 4}', 'the thing').warn_of_unknown(['b'])
    assert reading.noted == ["unknown key 'a' in the thing", "unknown key 'c' in the thing"]
    assert reading.asked == 2
