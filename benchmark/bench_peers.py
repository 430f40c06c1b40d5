"""
Other libraries that do what is most like it, as far as they are installed, in the same run.

Each reads and compares texts of its own kind, as long as ours. What they answer is not the same:
yarl and packageurl-python split and check a URL, packaging compares versions with specifiers, re2
matches without a relation between patterns, and interegular builds the whole automaton.
"""
import importlib
import sqlite3

from fleet import fleet
from measure import best_times

from rocon_uri import ResourceIndex, is_compatible, parse
from rocon_uri.name_pattern import read

ROBOTS = 100000
COUNT = 2000
PATTERN = '[a-z]+_[a-z]+[0-9]{4}'
OTHER_PATTERN = '(robot|cyber.*)_.*[0-9]'

#: the request, and the same by hand of a table with a column for each field, and an index on each
REQUESTS = [
    ('values', 'rocon:/pr2/*/noetic/focal',
     "platform = 'pr2' AND framework = 'noetic' AND system = 'focal'"),
    ('the beginning of a name', 'rocon:/*/cybernetic_bob_*',
     "name >= 'cybernetic_bob_' AND name < 'cybernetic_bob`'")]


def figures():
    """What this part measures."""
    for peer, measured in (('yarl', urls), ('packageurl', package_urls), ('packaging', versions),
                           ('re2', matching), ('interegular', relations)):
        try:
            module = importlib.import_module(peer)
        except ImportError:
            print('%s is not installed' % peer)
            continue
        yield from measured(module)
    yield from tables()


def our_texts():
    """URIs of which each is another."""
    return ['rocon:/turtlebot2/cybernetic_%06d/noetic/focal' % number for number in range(COUNT)]


def urls(yarl):
    """Reading a URL."""
    texts = [text.replace('rocon:', 'http://host') for text in our_texts()]
    yield reading('yarl.URL', yarl.URL, texts)


def package_urls(packageurl):
    """Reading a package URL."""
    texts = [text.replace('rocon:', 'pkg:pypi') for text in our_texts()]
    yield reading('packageurl.PackageURL', packageurl.PackageURL.from_string, texts)


def versions(_):
    """Reading specifiers of versions, and asking whether a version is one of them."""
    from packaging.specifiers import SpecifierSet
    from packaging.version import Version
    texts = ['>=1.%d,<2.0,!=1.%d.*' % (number, number + 1) for number in range(COUNT)]
    yield reading('packaging.SpecifierSet', SpecifierSet, texts)
    robots = list(map(parse, our_texts()))
    known = {'version': Version('1.5.3'), 'specifiers': list(map(SpecifierSet, texts)),
             'robots': robots, 'request': parse('rocon:/turtlebot2|pr2/*/ros/ubuntu'),
             'is_compatible': is_compatible}
    reference, ours = best_times(
        ['for each in specifiers: each.contains(version)',
         'for robot in robots: is_compatible(request, robot)'], known, 1)
    yield figure('is_compatible', ours / COUNT, reference / COUNT, 'SpecifierSet.contains')


def matching(re2):
    """Names that a regular expression matches, each of them once."""
    names = ['cybernetic_abcde%04d' % number for number in range(COUNT)]
    known = {'names': names, 'ours': read(PATTERN).matches,
             'theirs': re2.compile(PATTERN).fullmatch}
    reference, ours = best_times(['for name in names: theirs(name)',
                                  'for name in names: ours(name)'], known, 1)
    yield figure('match a name of 20 characters', ours / COUNT, reference / COUNT, 're2.fullmatch')


def relations(interegular):
    """Have two regular expressions a name in common? Each time they are read anew."""
    known = {'read': read, 'parse': interegular.parse_pattern, 'a': PATTERN, 'b': OTHER_PATTERN}
    reference, ours = best_times(
        ['parse(a).to_fsm().isdisjoint(parse(b).to_fsm())', 'read(a).intersects(read(b))'],
        known, 1)
    yield figure('compare two patterns', ours, reference, 'interegular isdisjoint')


def tables():
    """Finding all robots that fit, beside a table in memory that has no patterns."""
    texts = [text for text in fleet(ROBOTS) if not set(text) & set('|*[(')]
    index = ResourceIndex(texts)
    connection = sqlite3.connect(':memory:')
    connection.execute('CREATE TABLE robot (uri, platform, name, framework, system)')
    connection.executemany('INSERT INTO robot VALUES (?, ?, ?, ?, ?)', [
        (text, *text.split('/')[1:]) for text in texts])
    connection.execute('CREATE INDEX by_values ON robot (platform, framework, system)')
    connection.execute('CREATE INDEX by_name ON robot (name)')
    for kind, request, condition in REQUESTS:
        statement = 'SELECT uri FROM robot WHERE ' + condition
        found = connection.execute(statement).fetchall()
        if sorted(uri for uri, in found) != sorted(map(str, index.find(request))):
            raise RuntimeError('%s: SQLite finds others' % request)
        known = {'index': index, 'request': request, 'connection': connection,
                 'statement': statement}
        reference, ours = best_times(['connection.execute(statement).fetchall()',
                                      'list(index.find(request))'], known, 3)
        yield figure('find %d of %s robots by %s' % (len(found), format(len(texts), ','), kind),
                     ours, reference, 'SQLite, in memory')
    connection.close()


def reading(peer, read_theirs, texts):
    """The figure of reading texts that are all different."""
    known = {'parse': parse, 'ours': our_texts(), 'read': read_theirs, 'theirs': texts,
             'seen': parse('rocon:/').vocabulary.uris_read}
    reference, ours = best_times(['for text in theirs: read(text)',
                                  'seen.clear()\nfor text in ours: parse(text)'], known, 1)
    return figure('parse, distinct names', ours / COUNT, reference / COUNT, peer)


def figure(name, seconds, reference, peer):
    """A figure that is the ratio of two times."""
    return {'name': name, 'ratio': seconds / reference, 'target': None, 'reference': peer,
            'seconds': seconds, 'reference_seconds': reference}
