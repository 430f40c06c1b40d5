"""Vocabularies: values, groups, and rules that add to them."""
from __future__ import annotations

import itertools
import re

import pytest
from at_once import at_once

from rocon_uri import RoconURIValueError, Vocabulary, is_compatible, parse, relation
from rocon_uri.grammar import EBNF, VOCABULARY_FIELDS, ebnf
from rocon_uri.vocabulary import RulesError, complete, completed, current


def platforms(rules):
    return Vocabulary({'hardware_platform': rules}).field('hardware_platform')


def tree(field, group=None):
    """A field as nested dicts, from its public methods."""
    return {value: tree(field, value) for value in field.children(group)}


ROBOTS = {'a': {}, 'b': {'c': {}, 'd': {'e': {}}}}


@pytest.mark.parametrize('rules', [
    {'a': None, 'b': {'c': None, 'd': {'e': None}}},
    {'a': [], 'b': {'c': {}, 'd': ['e']}},
    {'a': None, 'b': ['c', {'d': 'e'}]},
    ['a', {'b': ['c', {'d': ['e']}]}],
    ['a', {'b': 'c'}, {'b': {'d': ['e']}}],
    ['a', 'b', {'b': ['c', 'd']}, {'b': {'d': 'e'}}],
    ['a', {'b': ['c', 'd']}, {'d': ['e']}],
    ['a', {'b': ['c', {'d': 'e'}]}, 'b', 'd', {'b': ['c', 'c']}],
    [None, 'a', {'b': [None, 'c', {'d': ['e', None]}]}],
])
def test_mappings_and_lists_are_interchangeable(rules):
    assert tree(platforms(rules)) == ROBOTS
    assert tree(Vocabulary([{'hardware_platform': rules}]).field('hardware_platform')) == ROBOTS


def test_rules_as_the_old_package_had_them():
    rules = [{'hardware_platform': ['pc', {'robot': ['pr2', {'gocart': ['gocart_mini']}]}]},
             {'application_framework': [{'ros': ['hydro', 'indigo']}, 'opros']},
             {'operating_system': [{'linux': [{'ubuntu': ['precise', 'trusty']}]}]}]
    vocabulary = Vocabulary(rules)
    assert vocabulary.field('hardware_platform').leaves('robot') == ['pr2', 'gocart_mini']
    assert vocabulary.field('application_framework').leaves('ros') == ['hydro', 'indigo']
    assert vocabulary.field('operating_system').leaves('linux') == ['precise', 'trusty']


def test_values_are_listed_a_group_before_its_members():
    assert list(platforms({'a': None, 'b': ['c', {'d': ['e']}], 'f': None})) == list('abcdef')


def test_a_group_stands_for_its_members_at_every_depth():
    field = platforms(['a', {'b': ['c', {'d': ['e', 'f']}, 'g']}])
    assert field.leaves('b') == ['c', 'e', 'f', 'g']
    assert field.leaves('d') == ['e', 'f']
    assert field.leaves('a') == ['a']
    for value in field:
        mask = field.mask(value)
        assert mask == sum(field.mask(leaf) for leaf in field.leaves(value))
        assert bin(mask).count('1') == len(field.leaves(value))
    assert field.mask('a') & field.mask('b') == 0
    for method in (field.leaves, field.mask):
        with pytest.raises(KeyError):
            method('h')


def test_a_mask_is_covered_by_the_fewest_values():
    field = platforms(['a', {'b': ['c', {'d': ['e', 'f']}]}, {'g': ['h']}])
    leaves = ['a', 'c', 'e', 'f', 'h']
    for count in range(len(leaves) + 1):
        for chosen in itertools.combinations(leaves, count):
            mask = sum(map(field.mask, chosen))
            covering = field.covering(mask)
            assert sum(map(field.mask, covering)) == mask
            fewest = min(n for n in range(count + 1) for values in itertools.combinations(field, n)
                         if {leaf for v in values for leaf in field.leaves(v)} == set(chosen))
            assert len(covering) == fewest
    assert field.covering(field.mask('e') | field.mask('f') | field.mask('h')) == ['d', 'g']


def test_what_is_known_joins_the_group_that_exists():
    bundled = Vocabulary.bundled()
    ours = bundled.extended({'hardware_platform': {
        'robot': ['our_robot', {'our_family': ['our_family_a', 'our_family_b']}],
        'phone': ['our_phone']}})
    field = ours.field('hardware_platform')
    assert {'our_robot', 'our_family_a', 'our_family_b', 'pr2'} <= set(field.leaves('robot'))
    assert 'our_family' not in field.leaves('robot')
    assert 'our_phone' in field.leaves('mobile_device')
    assert field.children().count('phone') == 0
    assert is_compatible(parse('rocon:/robot', ours), parse('rocon:/our_family', ours))


def test_an_extended_vocabulary_leaves_the_old_one_as_it_is():
    bundled = Vocabulary.bundled()
    before = {name: tree(bundled.field(name)) for name in VOCABULARY_FIELDS}
    ours = bundled.extended({'hardware_platform': {'robot': ['bender'], 'pr2': ['pr2_a']}})
    assert {name: tree(bundled.field(name)) for name in VOCABULARY_FIELDS} == before
    assert 'bender' in ours.field('hardware_platform')
    assert 'bender' not in bundled.field('hardware_platform')
    assert ours.field('operating_system').leaves('linux') == (
        bundled.field('operating_system').leaves('linux'))
    assert ours.serial > bundled.serial


def test_a_value_becomes_a_group_and_stays_usable():
    bundled = Vocabulary.bundled()
    ours = bundled.extended({'hardware_platform': {'pr2': ['pr2_a', 'pr2_b']}})
    field = ours.field('hardware_platform')
    assert field.leaves('pr2') == ['pr2_a', 'pr2_b']
    assert 'pr2' not in field.leaves('robot')
    pr2, robot = parse('rocon:/pr2', ours), parse('rocon:/robot', ours)
    assert is_compatible(pr2, robot)
    assert is_compatible(pr2, parse('rocon:/pr2_a', ours))
    assert not is_compatible(pr2, parse('rocon:/kobuki', ours))
    assert relation(parse('rocon:/pr2_a|pr2_b', ours), pr2).value == 'equal'
    assert relation(pr2, robot).value == 'subset'
    assert pr2.hardware_platform.list == ['pr2']
    assert pr2.hardware_platform.expand() == ['pr2_a', 'pr2_b']
    assert 'pr2' in pr2.hardware_platform


def test_the_vocabularies_that_there_are():
    assert Vocabulary({}).field('hardware_platform').children() == []
    assert not Vocabulary.bundled().is_open
    everything = Vocabulary.open()
    assert everything.is_open
    assert everything.opened() is everything
    assert everything.extended({'hardware_platform': ['bender']}).is_open
    with pytest.raises(KeyError):
        everything.field('name')


def test_an_open_vocabulary_takes_any_base_name():
    everything = Vocabulary.bundled().opened()
    uri = parse('rocon:/bender|pr2/bob/my_framework/Linux_7', everything)
    assert uri.hardware_platform.list == ['bender', 'pr2']
    for field, text in [('hardware_platform', 'rocon:/be-nder'),
                        ('application_framework', 'rocon:/*/*/3'),
                        ('operating_system', 'rocon:/*/*/*/_x'),
                        ('hardware_platform', 'rocon:/b%C3%B6b'),
                        ('hardware_platform', 'rocon:/pr2|')]:
        with pytest.raises(RoconURIValueError) as caught:
            parse(text, everything)
        assert caught.value.field == field


def test_open_values_are_compared_as_values():
    everything = Vocabulary.bundled().opened()
    for a, b, compatible, lies in [
            ('bender', 'bender', True, 'equal'), ('bender', 'flexo', False, 'disjoint'),
            ('bender', '*', True, 'subset'), ('bender', 'robot', False, 'disjoint'),
            ('bender|pr2', 'bender|kobuki', True, 'overlap'),
            ('bender|pr2', 'robot', True, 'overlap'),
            ('bender|robot', 'bender|pr2', True, 'superset')]:
        first, second = parse('rocon:/' + a, everything), parse('rocon:/' + b, everything)
        assert is_compatible(first, second) is is_compatible(second, first) is compatible
        assert relation(first, second).value == lies
        assert first.isdisjoint(second) is not compatible


def test_a_vocabulary_of_ones_own_is_never_completed():
    ours = Vocabulary({'hardware_platform': ['bender']})
    assert completed(ours) is ours
    with pytest.raises(RoconURIValueError):
        parse('rocon:/pr2', ours)
    assert parse('rocon:/*', ours).hardware_platform.expand() == ['bender']
    assert completed(current()) is complete() is complete()


@pytest.mark.parametrize('rules, path, problem', [
    ({'robots': ['a']}, ('robots',),
     "unknown field 'robots' in the rules (expected hardware_platform, "),
    ({'operating_sistem': ['a']}, ('operating_sistem',),
     "unknown field 'operating_sistem' in the rules (did you mean 'operating_system'?)"),
    ({'name': ['a']}, ('name',), "unknown field 'name'"),
    ({3: ['a']}, (3,), 'unknown field 3'),
    (['robots'], (0,), "unknown field 'robots'"),
    ([['hardware_platform']], (0,), 'a list stands where'),
    ({'hardware_platform': ['*']}, ('hardware_platform', 0), "hardware_platform '*' is not a ROS"),
    ({'hardware_platform': ['a/b']}, ('hardware_platform', 0), "'a/b' is not a ROS base name"),
    ({'hardware_platform': ['a|b']}, ('hardware_platform', 0), "'a|b' is not a ROS base name"),
    ({'hardware_platform': ['']}, ('hardware_platform', 0), "'' is not a ROS base name"),
    ({'hardware_platform': ['v' * 256]}, ('hardware_platform', 0), 'is not a ROS base name'),
    ({'hardware_platform': 'a b'}, ('hardware_platform',), "'a b' is not a ROS base name"),
    ({'hardware_platform': {'3': None}}, ('hardware_platform', '3'), "'3' is not a ROS base name"),
    ({'hardware_platform': [3]}, ('hardware_platform', 0),
     'hardware_platform is 3, expected text (in quotes)'),
    ({'hardware_platform': [True]}, ('hardware_platform', 0),
     'a value of hardware_platform is true'),
    ({'operating_system': {None: ['a']}}, ('operating_system', None),
     'operating_system is empty, expected text'),
    ({'hardware_platform': [['a']]}, ('hardware_platform', 0), 'a list stands where'),
    ({'hardware_platform': {'a': ['b', ['c']]}}, ('hardware_platform', 'a', 1), 'a list stands'),
    ({'hardware_platform': {'a': ['a']}}, ('hardware_platform', 'a', 0), "cannot be in 'a'"),
    ({'hardware_platform': {'a': {'b': ['a']}}}, ('hardware_platform', 'a', 'b', 0), 'at the top'),
    ({'hardware_platform': {'a': ['c'], 'b': ['c']}}, ('hardware_platform', 'b', 0),
     "'c' cannot be in 'b', since it is already in 'a'"),
    ({'hardware_platform': ['c', {'b': [{'c': 'd'}]}]}, ('hardware_platform', 1, 'b', 0, 'c'),
     "'c' cannot be in 'b', since it is already at the top"),
])
def test_rules_that_do_not_fit_are_refused(rules, path, problem):
    with pytest.raises(RulesError) as caught:
        Vocabulary(rules)
    assert problem in str(caught.value) == caught.value.problem
    assert len(str(caught.value)) < 300
    assert caught.value.path == path


def test_a_name_may_stand_in_several_fields():
    ours = Vocabulary({'hardware_platform': ['x'], 'operating_system': {'y': ['x']}})
    assert str(parse('rocon:/x/x/*/x', ours)) == 'rocon:/x/x/*/x'


def test_rules_nested_thousands_deep_are_read():
    rules = 'last'
    for depth in range(5000):
        rules = {'v%d' % depth: rules}
    assert platforms(rules).leaves('v4999') == ['last']


def test_the_grammar_is_shown_with_the_vocabulary_in_it():
    bundled = Vocabulary.bundled()
    text = ebnf({name: bundled.field(name) for name in VOCABULARY_FIELDS})
    assert max(map(len, text.splitlines())) <= 100
    for name in VOCABULARY_FIELDS:
        assert [value for value in bundled.field(name) if ' | "%s"' % value not in text] == []
    rules = [line.split(' ', 1)[0] for line in text.splitlines() if '=' in line]
    assert len(set(rules)) == len(rules)
    for symbol in ('platform', 'framework', 'system', 'rocon_uri', 'regex', 'count'):
        assert symbol in rules


def test_every_symbol_of_the_grammar_has_one_rule():
    bundled = Vocabulary.bundled()
    for text in (EBNF, ebnf({name: bundled.field(name) for name in VOCABULARY_FIELDS})):
        bare = re.sub(r'"[^"]*"|\?[^?]*\?|\(\*.*?\*\)', '', text)
        defined = re.findall(r'(\w+) +=', bare)
        assert sorted(defined) == sorted(set(re.findall(r'\w+', bare)))


def test_a_long_rule_of_the_grammar_goes_on_below_its_equals_sign():
    long, empty = ['a' * 78, 'b' * 84, 'c' * 255], []
    text = ebnf({'hardware_platform': long, 'application_framework': empty,
                 'operating_system': empty})
    assert text.split('\n')[-6:] == [
        'platform    = "*" | "%s"' % long[0], '            | "%s"' % long[1],
        '            | "%s" ;' % long[2], 'framework   = "*" ;', 'system      = "*" ;', '']


def test_threads_that_open_one_vocabulary_get_one_open_vocabulary():
    for _ in range(30):
        ours = Vocabulary({'hardware_platform': ['bender']})
        assert len(set(map(id, at_once(ours.opened, threads=8)))) == 1
