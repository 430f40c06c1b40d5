"""Reading a URI and comparing two, beside splitting one with urllib."""
import random

from measure import best_times, uncached_urlsplit

import rocon_uri
from rocon_uri import grammar

REFERENCE = 'urlsplit, uncached'
URI = 'rocon:/turtlebot2/cybernetic_pirate/noetic/focal'
REQUEST = 'rocon:/turtlebot2|pr2/cybernetic_pirate/ros/ubuntu'
PATTERNS = ['cybernetic_[a-z]+_?[0-9]*', '[a-z]+_[a-z]+[0-9]{4}', '(robot|cyber.*)_.*[0-9]']

#: what is said of them, the texts with a number for each, the target
OTHER_FORMS = [
    ('a glob', 'rocon:/turtlebot2/cybernetic_%06d*/noetic/focal', 5),
    ('a concert', 'rocon://north/turtlebot2/cybernetic_%06d/noetic/focal', 4),
    ('// read as /', 'rocon://turtlebot2/cybernetic_%06d/noetic', 4.5),
    ('an escape', 'rocon:/turtlebot2%%7Cpr2/cybernetic_%06d/noetic/focal', 5),
    ('a regular expression', 'rocon:/turtlebot2/cybernetic_%06d[0-9]+/noetic/focal', None)]


def figures():
    """What this part measures."""
    yield from reading_one()
    yield from reading_many()
    yield from comparing_names()


def reading_one():
    """The same URI again and again."""
    known = {
        'urlsplit': uncached_urlsplit(), 'split': grammar.split, 'parse': rocon_uri.parse,
        'is_compatible': rocon_uri.is_compatible, 'text': URI, 'other_text': REQUEST,
        'uri': rocon_uri.parse(URI), 'other_uri': rocon_uri.parse(REQUEST)}
    known['forget'] = known['uri'].vocabulary.uris_read.pop
    reference, match, parse, memo, texts, uris = best_times(
        ['urlsplit(text)', 'split(text)', 'forget(text); parse(text)', 'parse(text)',
         'is_compatible(text, other_text)', 'is_compatible(uri, other_uri)'], known, 5000, 40)
    yield figure('parse, memo bypassed, values seen before', parse, reference, 1.0)
    yield figure('parse, memo bypassed', parse, match, reference_name="match of the grammar's re")
    yield figure('parse, text seen before', memo, reference)
    yield figure('is_compatible(text, text), texts seen before', texts, reference, 0.33)
    yield figure('is_compatible(RoconURI, RoconURI), literal names', uris, reference, 0.12)


def reading_many():
    """Every URI is different."""
    texts = ['rocon:/turtlebot2/cybernetic_%06d/noetic/focal' % number for number in range(100000)]
    known = {'urlsplit': uncached_urlsplit(), 'parse': rocon_uri.parse, 'texts': texts}
    reference, parse = best_times(['for text in texts: urlsplit(text)',
                                   'for text in texts: parse(text)'], known, 1, 8)
    yield figure('parse, 100,000 distinct names', parse / 1e5, reference / 1e5, 1.5)
    for what, form, target in OTHER_FORMS:
        known['texts'] = [form % number for number in range(20000)]
        reference, parse = best_times(['for text in texts: urlsplit(text)',
                                       'for text in texts: parse(text)'], known, 1, 8)
        yield figure('parse, distinct names, ' + what, parse / 2e4, reference / 2e4, target)


def comparing_names():
    """A regular expression with names of 20 characters."""
    chosen = random.Random(0)
    names = ['cybernetic_%s%04d' % (''.join(chosen.choices('abcdefghij', k=5)), number)
             for number in range(5000)]
    known = {'urlsplit': uncached_urlsplit(), 'is_compatible': rocon_uri.is_compatible,
             'texts': ['rocon:/turtlebot2/%s/noetic/focal' % name for name in names]}
    known['robots'] = list(map(rocon_uri.parse, known['texts']))
    for pattern in PATTERNS:
        known['request'] = rocon_uri.parse('rocon:/turtlebot2/' + pattern)
        reference, compare = best_times(
            ['for text in texts: urlsplit(text)',
             'for robot in robots: is_compatible(request, robot)'], known, 1, 20)
        yield figure('is_compatible, %s and names of 20 characters' % pattern,
                     compare / len(names), reference / len(names), 1.0)


def figure(name, seconds, reference, target=None, reference_name=REFERENCE):
    """A figure that is the ratio of two times."""
    return {'name': name, 'ratio': seconds / reference, 'target': target,
            'reference': reference_name, 'seconds': seconds, 'reference_seconds': reference}
