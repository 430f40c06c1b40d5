"""Name patterns that bring other engines to a halt."""
import itertools
import tracemalloc
from random import Random

from measure import once

from rocon_uri import PatternTooComplex, ResourceIndex, RoconURIValueError
from rocon_uri.name_pattern import read
from rocon_uri.regular.inclusion import includes
from rocon_uri.regular.intersection import common_name
from rocon_uri.regular.language import Language
from rocon_uri.regular.syntax import parse

PATTERNS = ['(a|aa)+b', '(a*)*b', '(x+x+)+y', '(a|b)*a(a|b){20}', '(a|b)*a(a|b){200}',
            '([a-z]+)*[0-9]{200}', '(.*a.*b.*c)*d', '[a-z]*' * 42, '((a?){250}){250}', '(' * 255,
            '(' * 85 + 'a' + ')*' * 85, '((a?){63}){64}']
NAMES = [('ab' * 128)[:255], 'a' * 254 + 'c', 'x' * 254 + 'y', 'abcd' * 63 + 'abc',
         'q' * 55 + '7' * 200]


def figures():
    """What this part measures."""
    accepted = []
    for pattern in PATTERNS:
        try:
            parse(pattern)
        except RoconURIValueError:
            continue
        accepted.append(pattern)
    yield from matching(accepted)
    yield from comparing(accepted)
    yield many()
    yield sorted_uuids()


def matching(patterns):
    """Every name with an automaton of its own, then again."""
    first, again = [], []
    for pattern, name in itertools.product(patterns, NAMES):
        seconds, language = once(lambda: Language(pattern, parse(pattern)))     # noqa: B023
        first.append((seconds + once(language.matches, name)[0], pattern))
        again.append((min(once(language.matches, name)[0] for _ in range(5)), pattern))
    yield in_milliseconds('read a pattern and match a name of 255', *max(first), 50)
    yield in_milliseconds('match it again', *max(again), 1)


def comparing(patterns):
    """Every relation that two of them can have."""
    times, sizes = [], []
    for one, other in itertools.product(patterns, repeat=2):
        for compare in (common_name, includes):
            languages = [Language(pattern, parse(pattern)) for pattern in (one, other)]
            pair = '%s and %s' % (one, other)
            times.append((once(decided, compare, *languages)[0], pair))
            tracemalloc.start()
            decided(compare, *[Language(pattern, parse(pattern)) for pattern in (one, other)])
            sizes.append((tracemalloc.get_traced_memory()[1], pair))
            tracemalloc.stop()
    yield in_milliseconds('decide a relation, or find it too complex', *max(times), 500)
    size, pair = max(sizes)
    yield {'name': 'memory for that', 'ratio': size / 1e6, 'target': 20, 'reference': 'a megabyte',
           'details': pair}


def many():
    """One request against hundreds of resources with hard patterns."""
    times = []
    for pattern, request in (('(a|b)*b(a|b){%d}', '(a|b)*a(a|b){200}'), ('.*[ab].{%d}', '.*a.{40}'),
                             ('(.{1,%d}a){16}', '((.*[a-z].?){64}){21}')):
        index = ResourceIndex('rocon:/pr2/' + pattern % (number % 200 + 20) + '_%d' % number
                              for number in range(400))
        times.append((once(decided, index.count, 'rocon:/*/' + request)[0], request))
    return in_milliseconds('count among 400 hard patterns', *max(times), 1500)


def sorted_uuids():
    """A great many names that have nothing in common, in lists as long as those of an index."""
    random = Random(3)
    lists = [sorted('u%032x' % random.getrandbits(128) for _ in range(1200)) for _ in range(100)]
    times = []
    for pattern in ('u[0-9a-f]*(17|23|45|89)[0-9a-f]*', '[a-z]([0-9a-f]{8})*'):
        matches = read(pattern).matches_in_order()
        seconds = min(once(lambda: list(map(matches, lists)))[0] for _ in range(3))   # noqa: B023
        times.append((seconds / 120000 * 1e6, pattern))
    return in_milliseconds('match a million uuids', *max(times), 600)


def decided(ask, *args):
    """Ask for what may take too much work."""
    try:
        ask(*args)
    except PatternTooComplex:
        pass


def in_milliseconds(name, seconds, details, target):
    """A figure that is a time."""
    return {'name': name, 'ratio': seconds * 1e3, 'target': target, 'reference': 'a millisecond',
            'details': 'the dearest is ' + details}
