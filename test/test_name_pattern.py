"""The name field: literals, globs and regular expressions, and the sets of names that they are."""
from __future__ import annotations

import copy
import itertools
import json
import os
import pickle
import subprocess
import sys

import pytest
from at_once import at_once
from hypothesis import given, settings
from hypothesis import strategies as st

from rocon_uri.exceptions import PatternTooComplex, RoconURIValueError
from rocon_uri.name_pattern import ANY, Glob, Literal, RegularExpression, read
from rocon_uri.regular.budget import WORK_LIMIT, Budget
from rocon_uri.regular.inclusion import includes
from rocon_uri.regular.intersection import common_name
from rocon_uri.sources.ros_names import is_legal_base_name

HERE = os.path.dirname(os.path.abspath(__file__))
with open(os.path.join(HERE, 'conformance', 'rocon_uri.json'), encoding='utf-8') as stream:
    CONFORMANCE = json.load(stream)['names']

SHORT_NAMES = [first + ''.join(rest) for length in range(5) for first in 'abX'
               for rest in itertools.product('ab_3', repeat=length)]


# -- what is what --------------------------------------------------------------------------------

@pytest.mark.parametrize('case', CONFORMANCE, ids=[case['pattern'] for case in CONFORMANCE])
def test_admits_the_names_of_the_conformance_cases(case):
    pattern = read(case['pattern'])
    assert [name for name in case['admits'] + case['refuses'] if pattern.matches(name)] \
        == case['admits']


@pytest.mark.parametrize('text, kind, prefix, suffix', [
    ('*', Glob, '', ''), ('bob', Literal, 'bob', 'bob'), ('B_3', Literal, 'B_3', 'B_3'),
    ('bob_*', Glob, 'bob_', ''), ('*_left', Glob, '', '_left'), ('r*_*', Glob, 'r', ''),
    ('a*b*c', Glob, 'a', 'c'), ('**', Glob, '', ''), ('*3', Glob, '', '3'),
    ('bob.*', RegularExpression, 'bob', ''), ('(bob)', RegularExpression, 'bob', 'bob'),
    ('bob?', RegularExpression, 'bo', ''), ('bo+x', RegularExpression, 'bo', 'ox'),
    ('a{3}b{2,}c*', RegularExpression, 'aaabb', ''), ('.*b{2}_\\d', RegularExpression, '', ''),
    ('^[b]ob[0-9]{2}_l$', RegularExpression, 'bob', '_l'), ('[ab]c', RegularExpression, '', 'c'),
    ('[ac]b[xz]', RegularExpression, '', ''), ('a{2}b{2}', RegularExpression, 'aabb', 'aabb'),
    ('(bob|alice)', RegularExpression, '', ''), ('(a(b(c.)))d', RegularExpression, 'abc', 'd'),
])
def test_kinds_and_what_an_index_needs(text, kind, prefix, suffix):
    pattern = read(text)
    assert type(pattern) is kind
    assert (pattern.text, pattern.prefix, pattern.suffix) == (text, prefix, suffix)
    assert pattern.literal == (text if kind is Literal else None)
    assert pattern.is_any == (text == '*')


def test_star_is_one_object():
    assert read('*') is ANY


@pytest.mark.parametrize('text, names, others', [
    ('dud*', ['dud', 'dude'], ['du', 'adud', 'dud-e', 'dud\n']),
    ('(dud*)', ['du', 'dudd'], ['dude']),
    ('a*a', ['aa', 'aba'], ['a', 'ab']),
    ('*3', ['a3', 'a33'], ['3', '33', '_3']),
    ('*a*a*', ['aa', 'bacab'], ['a', 'ba']),
    ('a**b', ['ab', 'axb'], ['a']),
    ('a*bb*b', ['abbb', 'axbbxb'], ['abb', 'abxbb']),
    ('*', ['a', 'a' * 300], ['', '3', '_', 'a b', 'ä']),
    ('bob', ['bob'], ['Bob', 'bo', '', 'bob\n']),
])
def test_matches(text, names, others):
    pattern = read(text)
    assert [name for name in names + others if pattern.matches(name)] == names


@pytest.mark.parametrize('text, span, problem, advice', [
    ('3bob', (0, 1), "name '3bob' is not legal: a ROS name starts with a letter", ''),
    ('_', (0, 1), "name '_' is not legal: a ROS name starts with a letter", ''),
    ('3*', (0, 1), "name pattern '3*' admits no name: a ROS name starts with a letter", ''),
    ('_a*b', (0, 1), "name pattern '_a*b' admits no name: a ROS name starts with a letter", ''),
    ('bob-1', (3, 4), "'-' cannot stand in a ROS name, which has only letters, digits and '_'", ''),
    ('bób', (1, 2), "'ó' cannot stand in a ROS name, which has only letters, digits and '_'", ''),
    ('bob|alice', (3, 4), "the or operator '|' is not for the name", "write '(bob|alice)'"),
    ('a*|b', (2, 3), "the or operator '|' is not for the name", "write '(a*|b)'"),
    ('[0-9]+', (0, 6), "name pattern '[0-9]+' admits no name: a ROS name starts with a letter", ''),
    ('a' * 256, (255, 256),
     'a name or name pattern has at most 255 characters, this one has 256', ''),
    ('a*' * 128, (255, 256),
     'a name or name pattern has at most 255 characters, this one has 256', ''),
    ('[a-z]*' * 60, (255, 360),
     'a name or name pattern has at most 255 characters, this one has 360', ''),
    ('(' * 10 ** 6, (255, 10 ** 6),
     'a name or name pattern has at most 255 characters, this one has 1000000', ''),
])
def test_refused_with_place_and_advice(text, span, problem, advice):
    with pytest.raises(RoconURIValueError) as caught:
        read(text)
    error = caught.value
    assert (error.problem, error.span, error.advice) == (problem, span, advice)
    assert (error.uri, error.field, error.value) == (text, 'name', text)
    assert len(str(error)) < 400


@pytest.mark.parametrize('text', ['a' * 255, 'a*' * 127 + 'a', '[a-z]*' * 42 + 'aaa'])
def test_255_characters_are_enough(text):
    assert read(text).matches(read(text).example())


@settings(max_examples=300, deadline=None)
@given(st.text(max_size=300) | st.text(alphabet='ab3_*.[]()|?+{}^$\\,1-', max_size=40))
def test_any_text_is_read_or_refused(text):
    try:
        pattern = read(text)
    except RoconURIValueError as error:
        assert error.field == 'name' and error.uri == text
        assert 0 <= error.span[0] <= error.span[1] <= len(text)
    else:
        example = pattern.example()
        assert pattern.matches(example) and is_legal_base_name(example)
        assert example.startswith(pattern.prefix) and example.endswith(pattern.suffix)


# -- as sets -------------------------------------------------------------------------------------

@pytest.mark.parametrize('one, other, meet, one_has_other, other_has_one', [
    ('*', '*', True, True, True), ('*', '**', True, True, True), ('*', 'bob', True, True, False),
    ('*', '(.*)', True, True, True), ('*', '[a-z]+', True, True, False),
    ('bob', 'bob', True, True, True), ('bob', 'alice', False, False, False),
    ('bob', 'b*', True, False, True), ('bob', '(bob)', True, True, True),
    ('bob', 'bo?b', True, False, True), ('bob', '[c-z]*', False, False, False),
    ('dud*', 'dudette*', True, True, False), ('dud*', 'dad*', False, False, False),
    ('dud*', '*dud', True, False, False), ('*_left', '*_arm_left', True, True, False),
    ('*_left', '*_right', False, False, False), ('a*b', 'a*', True, False, True),
    ('a*b', 'ab', True, True, False), ('a*a', 'a', False, False, False),
    ('a**b', 'a*b', True, True, True), ('*a*b*', '*b*a*', True, False, False),
    ('*a*', '*a*a*', True, True, False), ('*ab*', 'a*b', True, False, False),
    ('bob_*', 'bob_.*', True, True, True), ('bob_*', 'bob_[0-9]+', True, True, False),
    ('*_7', 'bob_\\d', True, False, False), ('bob_*', 'bib_.+', False, False, False),
    ('(ab)*a', 'a(ba)*', True, True, True), ('[a-m]+', '[k-z]+', True, False, False),
])
def test_relations(one, other, meet, one_has_other, other_has_one):
    one, other = read(one), read(other)
    assert one.intersects(other) == other.intersects(one) == meet
    assert (one.includes(other), other.includes(one)) == (one_has_other, other_has_one)
    shared = one.example(other)
    assert (shared is not None) == (other.example(one) is not None) == meet
    assert not meet or one.matches(shared) and other.matches(shared)


def legal(text: str) -> bool:
    return text[0] == '*' or text[0].isalpha()


globs = st.text(alphabet='ab_3**', min_size=1, max_size=7).filter(legal)


@settings(max_examples=400, deadline=None)
@given(globs, globs)
def test_the_short_ways_for_globs_agree_with_the_automata(one, other):
    one, other = read(one), read(other)
    left, right = one._language(), other._language()
    assert one.intersects(other) == (common_name(left, right) is not None)
    assert one.includes(other) == includes(left, right)
    assert [one.matches(name) for name in SHORT_NAMES] == [left.matches(name)
                                                            for name in SHORT_NAMES]


def test_globs_that_leave_no_letter_over_are_compared_too():
    every = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ'
    one, other = read('*' + every + '*'), read('a*' + every)
    assert one.includes(other) and not other.includes(one)


expressions = st.sampled_from([
    'a.*', '.*b', '[ab]+', '(ab)*a', 'a(b|_3)?', '(aa|b)+', '\\D+', '[^3]*3?', 'a{2,4}',
    '(a|bb)_*'])


@settings(max_examples=200, deadline=None)
@given(globs | expressions, globs | expressions)
def test_every_pair_of_patterns_agrees_with_trying_all_short_names(one, other):
    one, other = read(one), read(other)
    ours = {name for name in SHORT_NAMES if one.matches(name)}
    theirs = {name for name in SHORT_NAMES if other.matches(name)}
    shared = one.example(other)
    assert one.intersects(other) == (shared is not None)
    assert shared is not None or not ours & theirs
    assert shared is None or one.matches(shared) and other.matches(shared)
    assert shared is None or len(shared) <= min(map(len, ours & theirs), default=99)
    assert ours >= theirs or not one.includes(other)
    assert one.includes(one) and one.includes(other) <= one.intersects(other)
    assert all(name.startswith(one.prefix) and name.endswith(one.suffix) for name in ours)


@pytest.mark.parametrize('one, other, example', [
    ('*', None, 'a'), ('bob', None, 'bob'), ('bob_*', None, 'bob_'), ('*_3', None, 'a_3'),
    ('bob_[0-9]+', None, 'bob_0'), ('abc*', '*cd', 'abcd'), ('arm*', '*_left', 'arm_left'),
    ('*', 'bob', 'bob'), ('bob', '*', 'bob'), ('bob', 'b*', 'bob'), ('b.b', 'bob', 'bob'),
    ('bob', 'bib', None), ('*_a', '*_b', None), ('[A-Z]\\w', '*_', 'A_'), ('*', 'x+', 'x'),
])
def test_example_is_a_shortest_name(one, other, example):
    assert read(one).example(None if other is None else read(other)) == example


def test_two_patterns_can_be_too_complex_to_compare():
    one, other = read('((.*[a-z].?){64}){21}'), read('(.{1,255}a){16}')
    for question in (one.intersects, one.includes, one.example):
        with pytest.raises(PatternTooComplex, match='are too complex to compare') as caught:
            question(other)
        assert caught.value.field == 'name'


def test_a_budget_says_what_a_comparison_took():
    budget = Budget()
    assert read('.*a.{40}').intersects(read('.*b.{30}'), budget)
    assert 8 * (42 + 32) < budget.spent < WORK_LIMIT // 5
    making = Budget()       # automata, which takes most of the time here
    assert not read('[xy]a(.{64}){60}').intersects(read('[xy]b.*'), making)
    assert 8 * 3840 < making.spent < 10 * 3840
    other_way = Budget()
    assert not read('[xy]b.*').intersects(read('[xy]a(.{64}){60}'), other_way)
    assert 8 * 3840 < other_way.spent < 10 * 3840
    both = Budget()
    assert not read('[xy]a(.{64}){60}').intersects(read('[xy]b(.{64}){60}'), both)
    assert 16 * 3840 < both.spent < 20 * 3840
    with pytest.raises(PatternTooComplex):
        read('.*a.{40}').intersects(read('.*b.{30}'), Budget(budget.spent // 5))


def test_nothing_left_of_a_budget_decides_what_needs_no_automata(monkeypatch):
    nothing = Budget(0)
    assert not read('a.*').intersects(read('b.*'), nothing)
    assert read('a.*').intersects(read('*'), nothing)
    assert read('a.*').intersects(read('abc'), nothing)
    monkeypatch.setattr('rocon_uri.regular.language.language', None)    # which makes automata
    with pytest.raises(PatternTooComplex, match="'a.*' and 'a.[+]' are too complex to compare"):
        read('a.*').intersects(read('a.+'), nothing)
    assert nothing.spent == 0


# -- as values -----------------------------------------------------------------------------------

@pytest.mark.parametrize('text', ['*', 'bob', 'bob_*', 'bob_[0-9]+'])
def test_patterns_are_values(text):
    pattern = read(text)
    assert pattern == read(text) and hash(pattern) == hash(read(text))
    assert pattern != read('alice') and pattern != text
    assert repr(pattern) == '%s(%r)' % (type(pattern).__name__, text)
    assert pickle.loads(pickle.dumps(pattern)) == copy.deepcopy(pattern) == pattern
    with pytest.raises(AttributeError):
        pattern.text = 'alice'
    with pytest.raises(AttributeError):
        pattern.other = 'alice'


def test_equal_is_the_text_and_not_the_set():
    assert read('**') != read('*') and read('**').includes(read('*'))


def test_literals_and_globs_need_no_automata():
    code = '\n'.join([
        'import sys', 'from rocon_uri.name_pattern import read',
        "bob, bobs, lefts = read('bob'), read('bob_*'), read('*_l*_left')",
        "assert bobs.matches('bob_7') and bobs.intersects(lefts) and not bobs.includes(lefts)",
        'assert not bob.intersects(bobs) and not bob.includes(bobs) and not bobs.includes(bob)',
        "assert not [name for name in sys.modules if 'regular' in name]",
        "assert read('bob+').matches('bobb')",
        "assert 'rocon_uri.regular.language' in sys.modules"])
    subprocess.run([sys.executable, '-c', code], check=True,
                   env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))


def test_threads_may_share_a_pattern():
    pattern = read('(a|b)*a[ab]{9}')
    names = [''.join(name) for name in itertools.product('ab', repeat=12)][::16]
    for answers in at_once(lambda: [pattern.matches(name) for name in names]):
        assert answers == [name[-10] == 'a' for name in names]
