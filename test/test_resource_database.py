"""A database of resources: whatever is asked, the answers are those of ResourceIndex."""
import json
import random
import sqlite3
import time
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import pytest
import test_resource_index as of_index

from rocon_uri import (PatternTooComplex, ResourceIndex, RoconURIValueError, Vocabulary, parse,
                       vocabulary)

sqlalchemy = pytest.importorskip('sqlalchemy', reason='SQLAlchemy is not installed')
StaticPool = sqlalchemy.pool.StaticPool

from rocon_uri.resource_database import (  # noqa: E402
    DatabaseError, NotAllAdded, ResourceDatabase, open_engine)
from rocon_uri.resource_database.tables import VERSION  # noqa: E402


@pytest.fixture
def fleet(engine):
    return ResourceDatabase(engine)


def in_memory():
    return sqlalchemy.create_engine('sqlite://', poolclass=StaticPool)


def do(engine, statement):
    """Whatever a person may do to the tables by hand."""
    with engine.begin() as connection:
        result = connection.execute(sqlalchemy.text(statement))
        return [tuple(row) for row in result] if result.returns_rows else None


def check_same_answers(database, index, requests):
    for request in requests:
        expected = list(index.find(request))
        assert list(database.find(request, ordered=True)) == expected, request
        assert sorted(map(str, database.find(request))) == sorted(map(str, expected)), request
        assert database.count(request) == len(expected), request
        assert database.any(request) is bool(expected), request


class TestAnswers:
    """Random fleets and requests."""

    URIS = of_index.some_uris(None)

    def test_they_are_those_that_the_tests_of_the_index_expect(self, fleet):
        fleet.add_all(of_index.FLEET)
        mark, = of_index.test_a_request_finds_the_resources_it_is_compatible_with.pytestmark
        for request, places in mark.args[1]:
            expected = [parse(of_index.FLEET[place]) for place in places]
            assert list(fleet.find(request, ordered=True)) == expected, request

    @pytest.mark.parametrize('seed', range(3))
    def test_they_are_those_of_the_index(self, fleet, seed):
        chosen = random.Random(seed)
        index = ResourceIndex()
        for _ in range(3):
            payloads = {uri: chosen.choice([None, 1, 'two', [3]])
                        for uri in chosen.sample(self.URIS, 150)}
            fleet.add_all(payloads)
            index.update(payloads)
            for uri in chosen.sample(self.URIS, 50):
                fleet.discard(uri)
                index.discard(uri)
            check_same_answers(fleet, index, chosen.sample(self.URIS, 25))
        assert list(fleet) == list(index)
        assert len(fleet) == len(index)
        for uri in chosen.sample(self.URIS, 100):
            assert (uri in fleet) is (uri in index)
        for uri in chosen.sample(list(index), 50):
            assert fleet[uri] == index[uri]

    def test_of_a_database_in_memory_too(self):
        fleet = ResourceDatabase(in_memory())
        index = ResourceIndex(self.URIS)
        fleet.add_all(self.URIS)
        check_same_answers(fleet, index, self.URIS[:50])
        found = fleet.find('rocon:/', ordered=True)
        first = next(found)
        fleet.discard(first)
        assert list(found) == list(index)[1:]

    def test_names_of_all_sorts(self, fleet):
        names = ['bob', 'Bob', 'bob_', 'bob_1', 'bob_9', 'bob_10', 'bobby', 'bo', 'b', 'Zoe', 'zoe',
                 'a_b', 'axb', 'a' * 255, 'a1b2', '*', 'bob*', '*b', 'b*b', '[a-z]+_[0-9]',
                 '(a|b).*', 'z.e']
        patterns = names + ['B*', 'bo*', '*_1', '*b*', 'a_*', 'a*b', '*1*2', '[A-Z].*', 'a{255}',
                            r'\w\d.*', r'[^a-c]\D+', '(bob|zoe)_?', 'bob_[0-9]{1,2}', '(a|)(b|)_b',
                            'a{2,255}', '(a{100}){2}a*', '(bo?b?)+', '.{3}', 'b(o(b|)|)', 'x*y*zo.',
                            '(bob|a_b)', '(bob_1|zo|a.*)']
        resources = ['rocon:/%s/%s' % (platform, name)
                     for name in names for platform in ('pr2', 'kobuki')]
        fleet.add_all(resources)
        index = ResourceIndex(resources)
        check_same_answers(fleet, index, ['rocon:/%s/%s' % (platform, name) for name in patterns
                                          for platform in ('*', 'pr2')])

    @pytest.mark.parametrize('pattern', ['bob_([a-z]|[0-9]){0,255}x?', '(a|b){250}(c|d){0,50}',
                                         '((a|b|x_)?){200}(bob|_)*'])
    def test_an_expression_that_is_too_large_for_a_database(self, fleet, pattern):
        chosen = random.Random(1)
        resources = ['rocon:/pr2/%s' % ''.join(chosen.choice('ab') for _ in range(250))
                     for _ in range(20)] + ['rocon:/pr2/bob_1x', 'rocon:/pc/bob_y', 'rocon:/pr2/*']
        fleet.add_all(resources)
        check_same_answers(fleet, ResourceIndex(resources), [
            'rocon:/*/' + pattern, 'rocon:/pr2/' + pattern, 'rocon:/warthog/' + pattern])


class TestMapping:
    def test_an_equal_resource_replaces_the_payload_and_keeps_its_place(self, fleet):
        fleet.add_all({'rocon:/pr2|kobuki/al*': 'old', 'rocon:/pc': None})
        fleet.add('rocon:/kobuki|pr2/al*', 'new')
        assert fleet['rocon:/pr2|kobuki/al*'] == 'new'
        assert list(map(str, fleet)) == ['rocon:/pr2|kobuki/al*/*/*', 'rocon:/pc/*/*/*']
        fleet.add('rocon:/pr2|kobuki/al*')
        assert fleet['rocon:/pr2|kobuki/al*'] is None

    def test_of_equal_ones_that_are_added_at_once_the_last_payload_counts(self, fleet):
        fleet.add_all([('rocon:/pr2|pc', 1), 'rocon:/kobuki', ('rocon:/pc|pr2', 2)])
        assert list(map(str, fleet)) == ['rocon:/pr2|pc/*/*/*', 'rocon:/kobuki/*/*/*']
        assert fleet['rocon:/pr2|pc'] == 2

    def test_what_is_not_there(self, fleet):
        fleet.discard('rocon:/pc')
        assert 'rocon:/pc' not in fleet
        with pytest.raises(KeyError, match='rocon:/pc'):
            fleet['rocon:/pc']
        assert list(fleet) == [] and len(fleet) == 0 and not fleet.any('rocon:/')

    @pytest.mark.parametrize('ask', ['add', 'discard', 'find', 'count', 'any', '__getitem__',
                                     '__contains__'])
    def test_what_is_not_a_uri_is_an_error_at_once(self, fleet, ask):
        with pytest.raises(RoconURIValueError, match='turtelbot'):
            getattr(fleet, ask)('rocon:/turtelbot')

    @pytest.mark.parametrize('payload', [0, False, '', [], {'a': [1.5, None, 'é\x00"']}])
    def test_a_payload_comes_back(self, fleet, payload):
        fleet.add('rocon:/pr2', payload)
        assert fleet['rocon:/pr2'] == payload == json.loads(json.dumps(payload))

    @pytest.mark.parametrize('payload, error', [({1, 2}, TypeError), (float('nan'), ValueError)])
    def test_a_payload_that_json_cannot_hold(self, fleet, payload, error):
        with pytest.raises(error):
            fleet.add('rocon:/pr2', payload)
        with pytest.raises(NotAllAdded):
            fleet.add_all({'rocon:/pc': 1, 'rocon:/pr2': payload})
        assert len(fleet) == 0


class TestLifetime:
    """Time passes where a test makes it pass, in the table."""

    def expire(self, engine, name):
        do(engine, "UPDATE rocon_uri_resource SET expires = 1 WHERE name = '%s'" % name)

    def test_one_that_has_expired_is_in_no_answer(self, fleet, engine):
        fleet.add_all(['rocon:/pr2/bob', 'rocon:/pr2/al', 'rocon:/pr2/b*'], lifetime=3600)
        fleet.add('rocon:/pr2/bo')
        self.expire(engine, 'bob')
        self.expire(engine, 'b*')
        left = [parse('rocon:/pr2/al'), parse('rocon:/pr2/bo')]
        assert list(fleet) == list(fleet.find('rocon:/pr2', ordered=True)) == left
        assert len(fleet) == fleet.count('rocon:/pr2') == 2
        assert list(fleet.find('rocon:/*/b*')) == left[1:]
        assert not fleet.any('rocon:/*/bob') and not fleet.count('rocon:/*/bob')
        assert 'rocon:/pr2/bob' not in fleet
        with pytest.raises(KeyError):
            fleet['rocon:/pr2/bob']
        assert fleet.purge() == 2
        assert fleet.purge() == 0
        assert len(fleet) == 2

    def test_an_undecided_one_that_has_expired_is_none(self, fleet, engine):
        fleet.add(of_index.TestUndecided.HARD, lifetime=10)
        do(engine, 'UPDATE rocon_uri_resource SET expires = 1')
        assert not fleet.any(of_index.TestUndecided.REQUEST)

    def test_it_starts_anew_when_the_resource_is_added_again(self, fleet, engine):
        fleet.add('rocon:/pr2/bob', lifetime=10)
        now, = do(engine, 'SELECT expires FROM rocon_uri_resource')[0]
        fleet.add('rocon:/pr2/bob', lifetime=1000)
        later, = do(engine, 'SELECT expires FROM rocon_uri_resource')[0]
        assert 900 < later - now < 2000
        fleet.add('rocon:/pr2/bob')
        assert do(engine, 'SELECT expires FROM rocon_uri_resource') == [(None,)]

    def test_one_that_comes_back_comes_last(self, fleet, engine):
        fleet.add('rocon:/pr2|pc/bob', 'old', lifetime=10)
        fleet.add('rocon:/pr2/al')
        self.expire(engine, 'bob')
        fleet.add('rocon:/pc|pr2/bob', lifetime=10)
        fleet.add('rocon:/pr2/zoe')
        assert list(map(str, fleet)) == ['rocon:/pr2/al/*/*', 'rocon:/pc|pr2/bob/*/*',
                                         'rocon:/pr2/zoe/*/*']
        assert fleet['rocon:/pr2|pc/bob'] is None

    @pytest.mark.parametrize('lifetime', [0, -1, float('nan'), float('inf')])
    def test_what_is_none(self, fleet, lifetime):
        for add in (fleet.add, lambda uri, lifetime: fleet.add_all([uri], lifetime)):
            with pytest.raises(ValueError, match='lifetime'):
                add('rocon:/pr2', lifetime=lifetime)


class TestUndecided:
    REQUEST, HARD = of_index.TestUndecided.REQUEST, of_index.TestUndecided.HARD

    def test_everything_else_comes_first(self, fleet):
        fleet.add_all([self.HARD, 'rocon:/pr2/a*', self.HARD + '#app', 'rocon:/pr2/bob'])
        found = fleet.find(self.REQUEST)
        assert next(found) == parse('rocon:/pr2/a*')
        with pytest.raises(PatternTooComplex, match='2 resources') as raised:
            next(found)
        assert raised.value.undecided == [parse(self.HARD), parse(self.HARD + '#app')]
        assert fleet.any(self.REQUEST)
        with pytest.raises(PatternTooComplex):
            fleet.count(self.REQUEST)

    def test_any_if_nothing_else_matches(self, fleet):
        fleet.add(self.HARD)
        with pytest.raises(PatternTooComplex) as raised:
            fleet.any(self.REQUEST)
        assert raised.value.undecided == [parse(self.HARD)]
        assert not fleet.any(self.REQUEST.replace('*', 'pc', 1))


class TestVocabularies:
    ours = of_index.TestVocabularies.ours

    def test_a_value_that_is_not_known_here(self, fleet):
        resources = [parse('rocon:/our_phone/bob', self.ours), parse('rocon:/phone/al'),
                     parse('rocon:/their_robot', Vocabulary.open())]
        fleet.add_all(resources)
        index = ResourceIndex(parse(str(uri), Vocabulary.open()) for uri in resources)
        assert list(fleet) == resources
        check_same_answers(fleet, index, [
            'rocon:/', 'rocon:/*/bob', 'rocon:/mobile_device', parse('rocon:/our_phone', self.ours),
            parse('rocon:/mobile_device', self.ours),
            parse('rocon:/their_robot', self.ours.opened())])

    def test_when_it_changes_the_answers_do(self, fleet, monkeypatch):
        fleet.add_all([parse('rocon:/our_phone/bob', self.ours), 'rocon:/phone/al'])
        assert fleet.count('rocon:/mobile_device') == 1
        monkeypatch.setattr(vocabulary, '_complete', self.ours)
        assert fleet.count('rocon:/mobile_device') == 2
        assert all(not uri.vocabulary.is_open for uri in fleet)

    def test_of_one_that_knows_nothing_of_theirs(self, fleet):
        newest = Vocabulary({'hardware_platform': ['newest']})
        fleet.add('rocon:/')
        assert fleet.count(parse('rocon:/newest/bob', newest)) == 1
        fleet.add('rocon:/pr2')
        for request in (parse('rocon:/newest', newest), parse('rocon:/*/bob', newest)):
            with pytest.raises(RoconURIValueError, match='pr2'):
                fleet.count(request)


class TestSeveralProcesses:
    """Here they are several engines, which share nothing but the database."""

    def test_what_another_adds_is_found(self, fleet, database_url):
        engine = open_engine(database_url)
        other = ResourceDatabase(engine)
        for resource in ('rocon:/pr2/bob', 'rocon:/kobuki/b*', 'rocon:/pc/[a-b].*', 'rocon:/pc/z*',
                         'rocon://north/pr2/bo*'):
            before = fleet.count('rocon:/*/b*')
            other.add(resource)
            assert fleet.count('rocon:/*/b*') == before + ('z' not in resource)
            other.discard('rocon:/pc/z*')      # an id that must not be given out again
        engine.dispose()

    def test_an_open_find_locks_nobody_out_and_sees_what_there_was(self, fleet, database_url):
        fleet.add_all('rocon:/pr2/bob_%d' % number for number in range(5000))
        found = fleet.find('rocon:/pr2', ordered=True)
        engine = open_engine(database_url)
        other = ResourceDatabase(engine)
        other.discard('rocon:/pr2/bob_4999')
        other.add('rocon:/pr2/al')
        assert [uri.name_text for uri in found] == ['bob_%d' % number for number in range(5000)]
        assert len(fleet) == 5000
        engine.dispose()

    def test_two_who_write_at_once_lose_nothing(self, fleet, database_url):
        resources = ['rocon:/%s/bob_%d%s' % (platform, number, '*' * (number % 50 == 0))
                     for platform in ('pr2', 'kobuki', 'pc|pr2') for number in range(2500)]

        def write(own, name):
            engine = open_engine(database_url)
            try:
                ResourceDatabase(engine).add_all((uri, name) for uri in own)
            finally:
                engine.dispose()
        with ThreadPoolExecutor(2) as pool:
            list(pool.map(write, (resources[:6000], resources[:1000:-1]), ('first', 'second')))
        assert set(fleet) == set(map(parse, resources))
        check_same_answers(fleet, ResourceIndex(fleet), ['rocon:/pr2/bob_1*', 'rocon:/kobuki'])

    def test_the_tables_are_made_once(self, database_url):
        engines = [open_engine(database_url) for _ in range(4)]
        with ThreadPoolExecutor(4) as pool:
            list(pool.map(lambda engine: ResourceDatabase(engine).add('rocon:/pr2'), engines))
        assert do(engines[0], 'SELECT version FROM rocon_uri_version') == [(VERSION,)]
        assert len(ResourceDatabase(engines[0])) == 1
        for engine in engines:
            engine.dispose()


def test_sqlite_waits_for_another_that_makes_the_file(tmp_path, monkeypatch):
    path = tmp_path / 'fleet.db'
    other = sqlite3.connect(str(path), isolation_level=None)
    other.execute('BEGIN EXCLUSIVE')
    monkeypatch.setattr(time, 'sleep', lambda seconds: other.execute('COMMIT'))
    engine = sqlalchemy.create_engine('sqlite:///%s' % path, connect_args={'timeout': 0})
    fleet = ResourceDatabase(engine)
    assert not other.in_transaction
    fleet.add('rocon:/pr2')
    assert len(fleet) == 1
    engine.dispose()
    other.close()


def test_sqlite_looks_up_what_a_request_says(tmp_path):
    engine = open_engine('sqlite:///%s' % (tmp_path / 'fleet.db'))
    fleet = ResourceDatabase(engine)
    fleet.add_all(TestAnswers.URIS)
    for request in ('rocon:/pr2', 'rocon:/*/bob', 'rocon:/*/bob_*', 'rocon:/*/*_2',
                    'rocon:/pr2/*_2', 'rocon:/pr2/bob_*/noetic', 'rocon:/*/bob_[0-9]+',
                    'rocon:/kobuki/b*_2/*/linux', 'rocon:/*/[a-z]+_2'):
        with fleet._asking(parse(request)) as (_, cursor, question):
            cursor.execute('EXPLAIN QUERY PLAN ' + fleet._dialect.written(question.select()),
                           question.parameters)
            plan = [row[3] for row in cursor.fetchall()]
        assert any('SEARCH' in step and 'resource' in step for step in plan), request
        assert not any('SCAN' in step and 'resource' in step for step in plan), request
    engine.dispose()


class TestBatches:
    def test_the_error_says_how_many_are_in(self, fleet):
        def resources():
            for number in range(7000):
                yield 'rocon:/pr2/bob_%d' % number
            yield 'rocon:/turtelbot'
        with pytest.raises(NotAllAdded, match='turtelbot.*first 5000 are stored') as raised:
            fleet.add_all(resources())
        assert raised.value.added == len(fleet) == 5000
        assert isinstance(raised.value.__cause__, RoconURIValueError)

    def test_more_than_one(self, fleet):
        resources = ['rocon:/pr2/bob_%d' % number for number in range(10001)]
        fleet.add_all(resources)
        assert [uri.name_text for uri in fleet] == ['bob_%d' % number for number in range(10001)]


class TestTables:
    def test_those_of_an_earlier_version_are_kept(self, fleet, engine):
        fleet.add_all({'rocon:/pr2/bob': 1, 'rocon:/pr2/b*': None})
        do(engine, 'DROP TABLE rocon_uri_announcer')
        do(engine, 'UPDATE rocon_uri_version SET version = 1')
        with pytest.raises(DatabaseError, match='of an earlier version, 1'):
            ResourceDatabase(engine, create=False)
        migrated = ResourceDatabase(engine)
        assert list(migrated.find('rocon:/*/bob', ordered=True)) == list(fleet)
        assert migrated['rocon:/pr2/bob'] == 1
        assert do(engine, 'SELECT count(*) FROM rocon_uri_announcer') == [(0,)]
        assert do(engine, 'SELECT version FROM rocon_uri_version') == [(VERSION,)]

    def test_those_of_a_later_version_are_an_error(self, fleet, engine):
        do(engine, 'UPDATE rocon_uri_version SET version = 99')
        with pytest.raises(DatabaseError, match='of version 99.*up to %d' % VERSION):
            ResourceDatabase(engine)

    def test_where_none_are_to_be_made(self, engine, tmp_path):
        if engine.dialect.name == 'sqlite':
            with pytest.raises(DatabaseError, match='No such file'):
                ResourceDatabase(engine, create=False)
            assert not list(tmp_path.iterdir())
            do(engine, 'CREATE TABLE theirs (number INTEGER)')
        with pytest.raises(DatabaseError, match='no tables of resources'):
            ResourceDatabase(engine, create=False)
        ResourceDatabase(engine)
        assert len(ResourceDatabase(engine, create=False)) == 0


class TestEngines:
    def test_sqlite_in_memory_needs_one_connection(self):
        for url in ('sqlite://', 'sqlite:///:memory:'):
            with pytest.raises(ValueError, match='StaticPool'):
                ResourceDatabase(sqlalchemy.create_engine(url))

    @pytest.mark.parametrize('name, driver, message', [
        ('mysql', 'mysqldb', "dialect 'mysql'"), ('postgresql', 'asyncpg', "driver 'asyncpg'"),
        ('sqlite', 'aiosqlite', "driver 'aiosqlite'")])
    def test_others_are_not_supported(self, name, driver, message):
        engine = SimpleNamespace(dialect=SimpleNamespace(name=name, driver=driver))
        with pytest.raises(NotImplementedError, match=message):
            ResourceDatabase(engine)

    @pytest.mark.parametrize('url, error', [
        ('postgresql://bob:secret@host:port/fleet', ValueError), ('secret', ValueError),
        ('mysql://bob:secret@host/fleet', NotImplementedError), ('', ValueError),
        ('sqlite+secret:///fleet.db', ValueError)])
    def test_what_is_no_url_of_one(self, url, error):
        with pytest.raises(error) as raised:
            open_engine(url)
        assert 'secret' not in str(raised.value)

    def test_a_password_is_never_shown(self):
        pytest.importorskip('psycopg2', reason='psycopg2 is not installed')
        engine = open_engine('postgres://bob:secret@127.0.0.1:1/fleet?application_name=secret')
        assert (engine.dialect.driver, engine.url.password) == ('psycopg2', 'secret')
        with pytest.raises(DatabaseError, match='postgresql://127.0.0.1:1/fleet: ') as raised:
            ResourceDatabase(engine)
        assert 'secret' not in str(raised.value)

    def test_a_name_for_people(self, fleet, database_url):
        assert repr(fleet).startswith('<ResourceDatabase ' + database_url.split('?')[0].replace(
            'postgres@', ''))

    def test_a_folder_that_is_not_there(self, tmp_path):
        with pytest.raises(DatabaseError, match='unable to open'):
            ResourceDatabase(open_engine('sqlite:///%s' % (tmp_path / 'none' / 'fleet.db')))


class TestLostConnections:
    """To PostgreSQL."""

    @pytest.fixture
    def fleet(self, postgresql_url):
        engine = open_engine(postgresql_url)
        yield ResourceDatabase(engine)
        engine.dispose()

    @pytest.fixture(autouse=True)
    def _says_it_by_the_error_only(self, caplog):
        yield
        assert not caplog.records

    @pytest.fixture
    def end_connections(self, postgresql):
        def end():
            postgresql.execute("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE "
                               "datname LIKE 'fleet%'")
        return end

    def test_in_the_middle_of_an_answer(self, fleet, end_connections):
        fleet.add_all('rocon:/pr2/bob_%d' % number for number in range(5000))
        found = fleet.find('rocon:/pr2')
        next(found)
        end_connections()
        with pytest.raises(DatabaseError, match='^postgresql:///fleet.*terminat'):
            list(found)
        assert len(fleet) == 5000

    def test_in_the_middle_of_a_batch(self, fleet, end_connections, monkeypatch):
        add_rows = fleet._dialect.add_rows

        def fail(cursor, rows, now):
            if any(row.name == 'bob_7000' for row in rows):
                add_rows(cursor, rows[:100], now)
                end_connections()
            add_rows(cursor, rows, now)
        monkeypatch.setattr(fleet._dialect, 'add_rows', fail)
        resources = ['rocon:/pr2/bob_%d' % number for number in range(12000)]
        with pytest.raises(NotAllAdded, match='first 5000 are stored') as raised:
            fleet.add_all(resources)
        assert raised.value.added == len(fleet) == 5000
        monkeypatch.undo()
        fleet.add_all(resources)
        assert len(fleet) == 12000

    def test_between_two_questions(self, fleet, end_connections):
        fleet.add('rocon:/pr2')
        end_connections()
        with pytest.raises(DatabaseError):
            fleet.count('rocon:/')
        assert fleet.count('rocon:/') == 1

    def test_a_server_that_is_away_and_comes_back(self, fleet, postgresql):
        fleet.add('rocon:/pr2')
        postgresql.stop()
        try:
            for _ in range(2):
                with pytest.raises(DatabaseError):
                    fleet.add('rocon:/kobuki')
        finally:
            postgresql.start()
        fleet.add('rocon:/pc')
        assert list(map(str, fleet)) == ['rocon:/pr2/*/*/*', 'rocon:/pc/*/*/*']
