"""Many names in order are matched as each of them is."""
import gc
import itertools
import tracemalloc
from bisect import bisect_left

import pytest

from rocon_uri import name_pattern

NAMES = sorted(
    [first + ''.join(rest) for first in 'abz' for length in range(6)
     for rest in itertools.product('ab_7', repeat=length)]
    + ['a' + ''.join(rest) for rest in itertools.product('ab', repeat=11)]
    + ['ab_7'] * 70 + ['z' * 255])


@pytest.mark.parametrize('text', [
    'bob', '*', 'a*', '*7', 'a*_*7',
    'a.*', '(ab|z).*', '[ab]+', '.*7', '[a-z]+_?7*', '(a|b)*a(a|b){3}', 'ab_7',
    'zz(z|7){0,3}', '.+z',
    '[^z].*', '(a|b)*a(a|b){10}',       # which has more DFA states than are remembered
])
def test_names_in_order_are_matched_as_each_of_them_is(text):
    pattern = name_pattern.read(text)
    expected = [pattern.matches(name) for name in NAMES]
    matches = pattern.matches_in_order()
    assert list(matches(NAMES)) == expected
    assert list(matches(NAMES[::3])) == expected[::3]
    assert list(matches(NAMES[::99])) == expected[::99]
    start, end = bisect_left(NAMES, 'ab'), bisect_left(NAMES, 'ac')
    assert list(matches(NAMES[start:end])) == expected[start:end]
    assert list(matches([])) == []


@pytest.mark.parametrize('text', ['[bc].*', '(b|c{9}).*'])
def test_names_that_are_decided_are_not_read(text):
    class Names(list):
        def __getitem__(self, index):
            assert not isinstance(index, slice), 'somebody reads these names'
            return super().__getitem__(index)
    names = ['%s%04d' % (letter, number) for letter in 'ab' for number in range(1000)]
    matches = name_pattern.read(text).matches_in_order()
    assert list(matches(Names(names))) == [False] * 1000 + [True] * 1000


def test_the_states_of_a_walk_are_bounded_without_the_garbage_collector():
    matches = name_pattern.read('(a|b)*a(a|b){14}').matches_in_order()
    names = sorted('a' + ''.join(rest) for rest in itertools.product('ab', repeat=14))
    gc.disable()
    tracemalloc.start()
    try:
        assert list(matches(names)) == [name[0] == 'a' for name in names]
        kept, highest = tracemalloc.get_traced_memory()
        assert highest < 2e6
    finally:
        tracemalloc.stop()
        gc.enable()
