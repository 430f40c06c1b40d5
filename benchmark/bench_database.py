"""
One request against a million robots in a database, beside the same asked for by hand.

By hand is `hand_written.sql`: statements with all values written out, run by the driver's own
cursor, with each text given to `parse`. What takes the time is another process, so that the clock
counts; both are run in turn, and the least of 15 rounds is taken. It needs SQLAlchemy, psycopg2 and
a PostgreSQL, which is started as the tests start theirs, and 1 GB for temporary files. With the
environment variable ROBOTS there are fewer robots, and other answers than those by hand.
"""
import os
import re
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

from bench_index import VOCABULARY_REQUESTS
from fleet import fleet
from measure import once

from rocon_uri import parse

SIZE = int(os.environ.get('ROBOTS', 1000000))
ROUNDS = 15
NAME_REQUESTS = [
    'rocon:/*/bob_*', 'rocon:/*/*_000042', 'rocon:/*/bob_[0-9]*(2|4|6|8)',
    'rocon:/pr2/bob_*/noetic', 'rocon:/robot/bob_000*/noetic/ubuntu', 'rocon:/*/xtrudy_391430']
FOLDER = Path(__file__).resolve().parent


def figures():
    """What this part measures."""
    try:
        import psycopg2     # noqa: F401

        from rocon_uri.resource_database import ResourceDatabase, open_engine, register
    except ImportError as error:
        print('left out: %s' % error)
        return
    by_hand = statements()
    texts = fleet(SIZE)
    for name, opened in (('SQLite', sqlite), ('PostgreSQL', postgresql)):
        with opened() as url:
            engine = open_engine(url)
            register(engine)
            database = ResourceDatabase(engine)
            seconds, _ = once(database.add_all, texts, clock=time.perf_counter)
            yield {'name': '%s: load %s robots' % (name, format(SIZE, ',')), 'ratio': seconds,
                   'target': 120, 'reference': 'a second'}
            if engine.dialect.name == 'postgresql':
                with engine.connect() as connection:    # as autovacuum does within a minute
                    execute(connection, 'ANALYZE')
            for request in VOCABULARY_REQUESTS + NAME_REQUESTS:
                yield from asked(name, engine, database, request,
                                 by_hand[request, engine.dialect.name])
            yield from memory(name, url)
            engine.dispose()


@contextmanager
def sqlite():
    """The URL of an empty file."""
    with tempfile.TemporaryDirectory() as folder:
        yield 'sqlite:///%s/fleet.db' % folder


@contextmanager
def postgresql():
    """The URL of an empty database of a server of its own."""
    sys.path.append(str(FOLDER.parent / 'test'))
    from postgresql_server import Server
    server = Server()
    try:
        with server.database() as url:
            yield url
    finally:
        server.remove()


def statements():
    """Those of `hand_written.sql`, by request and dialect."""
    _, *blocks = (FOLDER / 'hand_written.sql').read_text().split('-- request ')
    return {(block.partition('\n')[0], dialect): statement for block in blocks
            for dialect, statement in re.findall(r'-- (\w+)\n(.*?);\n', block, re.DOTALL)}


def asked(name, engine, database, request, statement):
    """The time of one request, and the rows that are read for it."""
    ours, by_hand = [], []
    for _ in range(ROUNDS):
        seconds, expected = once(run_by_hand, engine, statement, clock=time.perf_counter)
        by_hand.append(seconds)
        seconds, found = once(exhausted, database, request, clock=time.perf_counter)
        ours.append(seconds)
        if found != expected and SIZE == 1000000:
            raise RuntimeError('%s: %d by hand, %d found' % (request, expected, found))
    allowed = 1.2 * min(by_hand) + 2e-3
    yield {'name': '%s: find %s' % (name, request), 'ratio': min(ours) / allowed, 'target': 1,
           'reference': '1.2 times by hand, and 2 ms', 'seconds': min(ours),
           'reference_seconds': allowed,
           'details': '%.3g ms by hand, %d found' % (min(by_hand) * 1e3, found)}
    counts = found <= SIZE / 10 and request in NAME_REQUESTS
    rows, how = (rows_read if engine.dialect.name == 'postgresql' else scans)(database, request)
    yield {'name': '%s: %s' % (name, how), 'ratio': rows / max(found, 1) if rows else 0,
           'target': (1.2 if engine.dialect.name == 'postgresql' else 0) if counts else None,
           'reference': 'one found'}


def rows_read(database, request):
    """The rows that PostgreSQL reads from the table of resources."""
    with database._asking(parse(request)) as (_, cursor, question):
        if not question.parts:
            return 0, 'rows read for one found'
        cursor.execute('EXPLAIN (ANALYZE, FORMAT JSON) ' + question.select(), question.parameters)
        plan = cursor.fetchone()[0][0]['Plan']
    return sum(map(rows_of, nodes(plan))), 'rows read for one found'


def nodes(plan):
    """The parts of a plan that read the table."""
    if plan.get('Relation Name') == 'rocon_uri_resource':
        yield plan
    for below in plan.get('Plans', ()):
        yield from nodes(below)


def rows_of(node):
    """What one of them reads."""
    return node['Actual Loops'] * (
        node['Actual Rows'] + node.get('Rows Removed by Filter', 0)
        + node.get('Rows Removed by Index Recheck', 0))


def scans(database, request):
    """How often SQLite goes through the whole table."""
    with database._asking(parse(request)) as (_, cursor, question):
        cursor.execute('EXPLAIN QUERY PLAN ' + database._dialect.written(question.select()),
                       question.parameters)
        found = [row[3] for row in cursor.fetchall()]
    return sum(text.startswith('SCAN') and 'resource' in text for text in found), \
        'scans of the table'


def memory(name, url):
    """What a process takes that finds all."""
    printed = subprocess.run([sys.executable, str(FOLDER / 'streamed.py'), url], check=True,
                             stdout=subprocess.PIPE, universal_newlines=True).stdout
    for what, figure, target in zip(('at most', 'growth'), printed.split(), (60, 10)):
        yield {'name': '%s: memory while all are found, %s' % (name, what),
               'ratio': float(figure), 'target': target, 'reference': 'a megabyte'}


def run_by_hand(engine, statement):
    """Run a statement, read each text, and count them."""
    found = 0
    with engine.connect() as connection:
        cursor = connection.connection.cursor(*(
            ['by_hand'] if engine.dialect.name == 'postgresql' else []))
        cursor.execute(statement)
        rows = cursor.fetchmany(2000)
        while rows:
            for text, in rows:
                parse(text)
                found += 1
            rows = cursor.fetchmany(2000)
    return found


def exhausted(database, request):
    """Find all and say how many there are; one by one, as a caller does."""
    found = 0
    for _ in database.find(request):
        found += 1
    return found


def execute(connection, statement):
    """Run a statement and keep what it changes."""
    connection.connection.cursor().execute(statement)
    connection.connection.commit()
