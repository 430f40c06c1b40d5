"""A request as a condition for a table of the user's own: it finds what is_compatible accepts."""
import random

import pytest

from rocon_uri import PatternTooComplex, RoconURI, is_compatible, name_pattern, parse

sqlalchemy = pytest.importorskip('sqlalchemy', reason='SQLAlchemy is not installed')

from rocon_uri.regular.postgresql import expression  # noqa: E402
from rocon_uri.regular.syntax import parse as parse_expression  # noqa: E402
from rocon_uri.resource_database import condition, register  # noqa: E402

FIELDS = ['concert_name', 'hardware_platform', 'name', 'application_framework', 'operating_system']
ROBOTS = sqlalchemy.Table('robots', sqlalchemy.MetaData(),
                          sqlalchemy.Column('number', sqlalchemy.Integer),
                          *[sqlalchemy.Column(field, sqlalchemy.Text) for field in FIELDS])
CONCERTS = ['', None, 'north', 'south']
PLATFORMS = ['', None, '*', 'pr2', 'kobuki', 'robot', 'phone', 'galaxy', 'mobile_device', 'tablet']
FRAMEWORKS = ['', None, '*', 'noetic', 'indigo', 'ros']
SYSTEMS = ['', None, '*', 'focal', 'ubuntu', 'linux', 'trusty', 'chrome', 'windows']
NAMES = ['', None, '*', 'bob', 'Bob', 'bob_1', 'bobx1', 'bob_10', 'al', 'a_l', 'axl', 'BOB_1', 'b',
         'zoe_left', 'zoeXleft', 'a' * 20]
PATTERNS = ['*', 'bob', 'bob_1', 'BOB', 'bob*', 'B*', 'bob_*', '*_1', 'b*_1', '*b*', '*_left',
            'a_*', '[a-z]+', 'bob_[0-9]+', r'\w+_\d', r'[^b].*', '.*[A-Z].*', 'a{3,}',
            '(bob|al)(_1)?', 'a{20}', '(a{5}){2,4}', '(a|b|o)*', r'\D+', '.{2,3}', '(bob|a_?l)',
            'b(ob|)']


def columns(*fields):
    return {field: ROBOTS.c[field] for field in fields or FIELDS}


def rows_that_fit(engine, wanted):
    with engine.begin() as connection:
        return [row[0] for row in connection.execute(
            ROBOTS.select().where(wanted).order_by(ROBOTS.c.number))]


@pytest.fixture
def fill(engine):
    """Put rows into the table, and return them as URIs."""
    register(engine)

    def fill(rows):
        with engine.begin() as connection:
            ROBOTS.create(connection)
            connection.execute(ROBOTS.insert(), [
                dict(zip(FIELDS, row), number=number) for number, row in enumerate(rows)])
        return [RoconURI.from_fields(**{
            field: value or '' for field, value in zip(FIELDS, row)}) for row in rows]
    return fill


def test_rows_and_requests_of_all_kinds(engine, fill):
    choose = random.Random(7).choice
    robots = fill([tuple(map(choose, (CONCERTS, PLATFORMS, NAMES, FRAMEWORKS, SYSTEMS)))
                   for _ in range(400)])
    for _ in range(200):
        request = RoconURI.from_fields(
            choose(['', '', 'north']),
            choose(['*', 'pr2', 'robot', 'phone|kobuki', 'mobile_device', 'galaxy']),
            choose(PATTERNS), choose(['*', 'noetic', 'ros', 'indigo|noetic']),
            choose(['*', '*', 'focal', 'ubuntu', 'linux', 'trusty|chrome']))
        assert rows_that_fit(engine, condition(request, **columns())) == [
            number for number, robot in enumerate(robots) if is_compatible(request, robot)], request


@pytest.mark.parametrize('pattern', PATTERNS)
def test_names(engine, fill, pattern):
    robots = fill([('', 'pr2', name, '*', '*') for name in NAMES])
    request = parse('rocon:/*/' + pattern)
    assert rows_that_fit(engine, condition(request, name=ROBOTS.c.name)) == [
        number for number, robot in enumerate(robots) if is_compatible(request, robot)]


def test_classes_are_those_of_ascii(engine, fill):
    fill([('', 'pr2', 'bob', '*', '*')])
    with engine.begin() as connection:
        connection.execute(ROBOTS.insert(), [
            {'number': 1, 'name': 'bé'}, {'number': 2, 'name': 'b٣'}])
    for pattern in (r'b\w+', r'b[^x].*', 'b.+'):
        assert rows_that_fit(engine, condition('rocon:/*/' + pattern, name=ROBOTS.c.name)) == [0]


def test_columns_that_are_left_out_are_not_restricted(engine, fill):
    fill([('north', 'pr2', 'bob', 'noetic', 'focal'),
          ('south', 'kobuki', 'al', 'indigo', 'trusty')])
    request = 'rocon://north/pr2/bob/noetic/focal'
    assert rows_that_fit(engine, condition(request)) == [0, 1]
    for field in FIELDS:
        assert rows_that_fit(engine, condition(request, **columns(field))) == [0]


def test_it_is_an_expression_as_any_other(engine, fill):
    fill([('', platform, name, '*', '*') for platform in ('pr2', 'pc') for name in ('bob_1', 'al')])
    pr2, bob = (condition('rocon:/pr2', **columns()), condition('rocon:/*/bob_.*', **columns()))
    assert rows_that_fit(engine, sqlalchemy.and_(pr2, bob)) == [0]
    assert rows_that_fit(engine, sqlalchemy.or_(pr2, bob)) == [0, 1, 2]
    assert rows_that_fit(engine, ~bob) == rows_that_fit(engine, sqlalchemy.not_(bob)) == [1, 3]
    other = ROBOTS.alias()
    for pattern, expected in (('al', [0, 2]), ('a*', [0, 2]), ('bob_[0-9]', [1, 3])):
        others = sqlalchemy.exists().where(sqlalchemy.and_(
            other.c.hardware_platform == ROBOTS.c.hardware_platform, other.c.name != ROBOTS.c.name,
            condition('rocon:/*/' + pattern, name=other.c.name)))
        assert rows_that_fit(engine, others) == expected


def test_a_request_is_in_parameters_only(engine):
    wanted = condition('rocon://north/pr2/bob_[0-9]+/noetic/focal', **columns())
    compiled = str(wanted.compile(engine))
    for text in ('north', 'pr2', 'bob', 'noetic', 'focal'):
        assert text not in compiled


def test_another_dialect_is_named():
    from sqlalchemy.dialects import mysql
    for request in ('rocon:/', 'rocon:/pr2', 'rocon:/*/bob_*'):
        with pytest.raises(NotImplementedError, match="dialect 'mysql'"):
            condition(request, **columns()).compile(dialect=mysql.dialect())


def test_an_expression_that_is_too_large():
    condition('rocon:/*/(a|bc){85}d?', name=ROBOTS.c.name)
    with pytest.raises(PatternTooComplex, match='use ResourceDatabase') as raised:
        condition('rocon:/*/(a|bc){86}', name=ROBOTS.c.name)
    assert raised.value.value == '(a|bc){86}'
    condition('rocon:/*/(a|bc){86}', hardware_platform=ROBOTS.c.hardware_platform)


def test_registering_again_changes_nothing(engine):
    for _ in range(2):
        register(engine)
    with engine.begin() as connection:
        if engine.dialect.name == 'sqlite':
            assert connection.execute(sqlalchemy.text(
                "SELECT rocon_uri_matches('a+', 'aa'), rocon_uri_matches('a+', NULL)")
            ).fetchone()[:] == (1, None)


@pytest.mark.parametrize('text', [
    'a', '[a-c]', '(ab*)', '(ab|c)+', '(a|b){2}', '(ab){2,255}', '(a{16}){16}', '(a{2}){130}',
    'a?b?', '((a|b)c?){0,3}', '(ab|)', r'[^\w]?a', '(a|(b|cd)*){2,}x', 'x(a{2,}){3,4}',
    '(a{85}){3,}'])
def test_an_expression_as_postgresql_writes_it(postgresql, text):
    pattern = name_pattern.read(text)
    chosen = random.Random(3)
    names = {''.join(chosen.choice('abcdx') for _ in range(chosen.choice([1, 2, 3, 5, 9])))
             for _ in range(150)} | {'a' * count for count in range(1, 300)}
    import psycopg2
    connection = psycopg2.connect(host=postgresql.folder, user='postgres', dbname='postgres')
    try:
        with connection, connection.cursor() as cursor:
            cursor.execute('SELECT name FROM unnest(%s) AS name WHERE name ~ %s',
                           (sorted(names), expression(parse_expression(text))))
            assert {name for name, in cursor} == set(filter(pattern.matches, names))
    finally:
        connection.close()
