"""Name patterns, two at a time: against `re`, a second grammar, and all short names."""
from __future__ import annotations

import functools
import itertools
import re
import warnings

from fuzz.damage import damaged

from rocon_uri import PatternTooComplex, RoconURIValueError
from rocon_uri.grammar import NAME_LIMIT
from rocon_uri.name_pattern import read
from rocon_uri.sources.ros_names import is_legal_base_name

GOOD = ['*', 'bob', 'bob_7', 'bob_*', '*_left', 'r*_*', '*a*b*', 'a*a', 'ab*ba', 'dud*', '.*',
        '^bob$', 'bob[0-9]+', '(bob|alice)_\\d{2}', 'bob?[0-9]', 'a(|b)c', '^b[^a-f_]{2,}$',
        '(?:ab){0,3}\\D+', '(a|aa)+b', '[A-Z][a-z]*', '(a*)*b', '((a?){3}){2}', '([ab]0?)+',
        'a{2,3}b{0}', '(a(b(A|0)?)*)+', '[^\\d]\\w*', 'a\\W?', '(.*a)?(.*b)?',
        '(a|b){1,2}(0|A){2}']
TOKENS = ['*', '+', '?', '{2}', '{0}', '{0,2}', '{1,}', '{,2}', '{3,1}', '{255}', '{256}', '{',
          '}', '(', ')', '(?:', '(?=', '(?P<a>', '|', '[', ']', '[^', '-', '^', '$', '.', '\\',
          '\\d', '\\D', '\\w', '\\W', '\\b', '\\1', '[a-z]', '[A-z]', '[9-0]', '[ab]', '(a|b)',
          '(|a)', 'a', 'b', 'A', '0', '_', 'aab', '\xe9', '\u0660', '/', ' ', '\n', 'a' * 252]

SHORT_NAMES = ['', 'a_', '_a', 'a\n', '\xe9', 'a\xe9', 'a-b', 'bob', 'bob_7', 'bob_left', 'ababab']
SHORT_NAMES += [''.join(name) for length in range(1, 5)
                for name in itertools.product('abA0', repeat=length)]
NAMES = SHORT_NAMES + ['a' * 255, 'b' * 256, 'a' * 3000 + '0']

CLASS = re.compile(r'\[\^?(?:[0-9]-[0-9]|[a-z]-[a-z]|[A-Z]-[A-Z]|\w|\\[dDwW])+\]', re.ASCII)
BRANCH = r'(?:(?:\w|\.|\\[dDwW])(?:[*+?]|\{\d+(?:,\d*)?\})?)*'
GROUP = re.compile(r'\((?:\?:)?%s(?:\|%s)*\)' % (BRANCH, BRANCH), re.ASCII)
REGEX = re.compile(r'\^?%s\$?' % BRANCH, re.ASCII)


def make(rng):
    return tuple(damaged(rng, text, TOKENS) if rng.random() < 0.7 else text
                 for text in (rng.choice(GOOD), rng.choice(GOOD)))


def check(pair):
    a, b = map(check_one, pair)
    if a is None or b is None:
        return
    for one, other in ((a, b), (b, a)):
        check_relation(one, other)
    assert answer(a.intersects, b) is answer(b.intersects, a)


def answer(method, other):
    try:
        return method(other)
    except PatternTooComplex:
        return PatternTooComplex


def check_one(text):
    """The pattern of a text, or None if it rightly is none."""
    names = expected_names(text)
    try:
        pattern = read(text)
    except RoconURIValueError as error:
        start, end = error.span
        assert error.field == 'name' and 0 <= start <= end <= len(text)
        assert str(error).isprintable()
        if is_in_grammar(text):
            assert not names, names
            assert re.search('admits no name|starts with a letter|at most|deep|more than|larger',
                             error.problem), error
        return None
    assert is_in_grammar(text)
    found = {name for name in NAMES if pattern.matches(name)}
    assert found == set(filter(pattern.matches, NAMES))
    assert all(map(is_legal_base_name, found))
    assert names is None or found.intersection(SHORT_NAMES) == names, names
    assert all(name.startswith(pattern.prefix) and name.endswith(pattern.suffix) for name in found)
    example = pattern.example()
    assert is_legal_base_name(example) and pattern.matches(example)
    assert not found or len(example) <= min(map(len, found))
    return pattern


def check_relation(a, b):
    ours, theirs = ({name for name in NAMES if pattern.matches(name)} for pattern in (a, b))
    meets, example, includes = (
        answer(method, b) for method in (a.intersects, a.example, a.includes))
    if PatternTooComplex not in (meets, example):
        assert meets is (example is not None)
        assert meets or not ours & theirs
        assert not meets or a.matches(example) and b.matches(example)
        assert not ours & theirs or len(example) <= min(map(len, ours & theirs))
    if includes is not PatternTooComplex:
        assert theirs <= ours or not includes
        assert meets or not includes    # none is empty


@functools.lru_cache(maxsize=1000)
def is_in_grammar(text):
    """Is it a literal, a glob or a regular expression, whatever it admits?"""
    if len(text) > NAME_LIMIT:
        return False
    if re.fullmatch(r'[\w*]*', text, re.ASCII):
        return text != ''
    counts = re.findall(r'\{(\d+),?(\d*)\}', text)
    ends = re.findall('(.)-(.)', text)
    text = CLASS.sub('a', text)
    while GROUP.search(text):
        text = GROUP.sub('a', text)
    return (REGEX.fullmatch(text) is not None and all(start <= end for start, end in ends)
            and all(int(low) <= int(high or 255) <= 255 for low, high in counts))


def is_easy_for_re(text):
    """Does `re` need no more than a moment, though it tries one way after the other?"""
    counted = re.findall(r'\d+', ' '.join(re.findall(r'\{[^}]*\}', text)))
    steps = functools.reduce(lambda steps, count: steps * (int(count) + 1), counted, 1)
    return steps <= 12 and len(re.findall(r'[*+?}|]', text)) <= 8


def expected_names(text):
    """The SHORT_NAMES that `re` finds, or None where that is no help or takes for ever."""
    if not is_in_grammar(text):
        return None
    if re.fullmatch(r'[\w*]+', text, re.ASCII):
        text = re.sub(r'\*+', r'\\w*', text)
    if not is_easy_for_re(text):
        return None
    with warnings.catch_warnings():
        warnings.simplefilter('ignore')     # that a set could mean something else in the future
        matches = re.compile(text, re.ASCII).fullmatch
    return {name for name in SHORT_NAMES if matches(name) and is_legal_base_name(name)}
