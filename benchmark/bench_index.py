"""
One request against many robots: what an index of a million costs, and what it answers in.

A time that is bounded as such is measured with a second or a millisecond, so that its ratio is
the time in that unit.
"""
import tracemalloc

from fleet import fleet
from measure import best_times, once, uncached_urlsplit

from rocon_uri import ResourceIndex, parse

SIZES = (10000, 100000, 1000000)
VOCABULARY_REQUESTS = [
    'rocon:/%s/*/%s/%s' % (platform, framework, system)
    for platform in ('*', 'robot') for framework in ('*', 'noetic') for system in ('*', 'ubuntu')]
NAME_REQUESTS = [       # what to call it, the request, milliseconds
    ('a literal name', 'rocon:/*/%s', 20),
    ('a prefix', 'rocon:/*/bob_*', 20),
    ('a suffix', 'rocon:/*/*_000042', 20),
    ('a regular expression with a prefix', 'rocon:/*/bob_[0-9]*(2|4|6|8)', 20),
    ('a regular expression without', 'rocon:/*/[a-z_]+_[0-9]*7[0-9]*', 1000),
    ('the beginning in a choice', 'rocon:/*/(bob|my_alice)_.*', 1000),
    ('most digits told apart', 'rocon:/*/[a-z_]+[0-9]*(17|23|45|89)[0-9]*', 600)]


FIRST = [kind for kind, _, _ in NAME_REQUESTS[:3]]      # each is the first that needs its order


def figures():
    """What this part measures."""
    measured = [measure(size) for size in SIZES]
    for figure, *smaller in zip(*reversed(measured)):
        shown = [other['cost'] for other in reversed(smaller)] + [figure.pop('cost')]
        figure['name'] += ', %s robots' % format(SIZES[-1], ',')
        figure['details'] = 'at %s: %s' % (' and '.join(format(size, ',') for size in SIZES),
                                           ' / '.join(shown))
        yield figure


def measure(size):
    """The figures of a fleet, in order, each with what it costs as text."""
    texts = fleet(size)
    reading, robots = once(lambda: list(map(parse, texts)))
    building, index = once(ResourceIndex, robots)
    figures = [{'name': 'build', 'ratio': building / reading, 'target': 3,
                'reference': 'reading them', 'seconds': building, 'reference_seconds': reading,
                'cost': '%.3g s' % building}]
    urlsplit, = best_times(['for text in texts: urlsplit(text)'],
                           {'urlsplit': uncached_urlsplit(), 'texts': texts[:10000]}, 1)
    figures += asked_for_values(index, urlsplit / 10000)
    figures += asked_for_names(index, texts, urlsplit / 10000)
    del index
    return figures + [memory(robots)]


def asked_for_values(index, urlsplit):
    """Every combination of the three fields with registered values; the dearest counts."""
    count, any_, find = [], [], []
    for request in VOCABULARY_REQUESTS:
        count.append(shortest(index.count, request)[0])
        any_.append(shortest(index.any, request)[0])
        seconds, found = shortest(exhausted, index, request)
        find.append((seconds / (2e-3 + found * urlsplit / 2), seconds, found, urlsplit))
    fields = 'values of any of the three fields'
    yield in_milliseconds('count, ' + fields, max(count), 2)
    yield in_milliseconds('any, ' + fields, max(any_), 2)
    ratio, seconds, found, urlsplit = max(find)
    yield {'name': 'find, ' + fields, 'ratio': ratio, 'target': 1, 'seconds': seconds,
           'reference': '2 ms and half an uncached urlsplit for each of those found',
           'reference_seconds': seconds / ratio,
           'cost': '%.3g ms for %d' % (seconds * 1e3, found)}


def asked_for_names(index, texts, urlsplit):
    """
    Names; those of a pattern need an order that is built when it is first asked for.

    What find takes is counted without half a urlsplit for each of those found.
    """
    dearest = 0
    for kind, request, milliseconds in NAME_REQUESTS:
        if '%s' in request:
            request %= next(text for text in texts if '*' not in text).split('/')[2]
        first, found = once(index.count, request)
        if kind in FIRST:
            dearest = max(dearest, first)
        times = [shortest(ask, request)[0] for ask in (
            index.count, index.any, lambda asked: exhausted(index, asked))]
        answer = max(*times[:2], times[2] - found * urlsplit / 2)
        figure = in_milliseconds('count, any or find, ' + kind, answer, milliseconds)
        figure['cost'] = '%s ms for %d (%.3g the first time)' % (
            ', '.join('%.3g' % (seconds * 1e3) for seconds in times), found, first * 1e3)
        yield figure
    yield in_milliseconds('the first time, of ' + ', '.join(FIRST), dearest, 600)


def memory(robots):
    """
    What an index holds beside the robots themselves, with all orders of names built.

    It is to be 200 bytes with the slot of 8 that a robot has for weak references.
    """
    tracemalloc.start()
    index = ResourceIndex(robots)
    built, _ = tracemalloc.get_traced_memory()
    index.count('rocon:/*/bob_*')
    index.count('rocon:/*/*_42')
    all_in_all, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    each = all_in_all / len(robots)
    return {'name': 'memory of each, asked for names both ways', 'ratio': each, 'target': 192,
            'reference': 'a byte', 'cost': '%.0f bytes (%.0f before it was asked for names)'
            % (each, built / len(robots))}


def exhausted(index, request):
    """Find all and say how many there are; one by one, as a caller does."""
    found = 0
    for _ in index.find(request):
        found += 1
    return found


def shortest(function, *args):
    """The shortest of some times that a function takes, and what it returns."""
    return min(once(function, *args) for _ in range(3))


def in_milliseconds(name, seconds, target):
    """A figure that is a time."""
    return {'name': name, 'ratio': seconds * 1e3, 'target': target, 'reference': 'a millisecond',
            'cost': '%.3g ms' % (seconds * 1e3)}
