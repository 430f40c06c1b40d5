"""The statements of PostgreSQL, from 12 on, through psycopg2."""
from __future__ import annotations

from typing import TYPE_CHECKING, Dict, Iterable, List, Mapping, Tuple

from rocon_uri.name_pattern import Glob, NamePattern
from rocon_uri.resource_database.dialects import (
    ADD_KIND, COLUMNS, REPLACE, Condition, Dialect, ranges)
from rocon_uri.resource_database.names import in_postgresql, is_left_to_database, like

if TYPE_CHECKING:
    from sqlalchemy.engine import Connection
    from sqlalchemy.engine.interfaces import DBAPICursor

    from rocon_uri.resource_database.rows import Fields, Row

__all__ = ['PostgreSQL']

_ROWS_AT_ONCE = 2000        # that a cursor asks for
_PATTERNS_LOCK = 0x726f636f6e757269     # of this package alone, as the other one in `tables`
_TYPES = ('bytea', 'bigint', 'integer', 'text', 'text', 'smallint', 'text', 'text',
          'double precision')       # of COLUMNS

#: The planner is told that all of an answer will be read, and that patterns, in the only join, are
#: looked up; there is nothing that compiling would make faster.
_READING = ('SET TRANSACTION ISOLATION LEVEL REPEATABLE READ READ ONLY; '
            'SET LOCAL cursor_tuple_fraction = 1; '
            'SET LOCAL enable_hashjoin = off; SET LOCAL enable_mergejoin = off; '
            'SET LOCAL jit = off')


class PostgreSQL(Dialect):
    """What PostgreSQL says."""

    now = 'CAST(extract(epoch FROM now()) AS double precision)'

    def begin_reading(self, connection: Connection) -> DBAPICursor:
        cursor = connection.connection.cursor()
        cursor.execute(_READING)
        return cursor

    def begin_writing(self, connection: Connection) -> DBAPICursor:
        return connection.connection.cursor()

    def streaming_cursor(self, connection: Connection) -> DBAPICursor:
        cursor = connection.connection.cursor(name='rocon_uri', scrollable=False)
        cursor.itersize = _ROWS_AT_ONCE
        return cursor

    def kinds(self, numbers: List[int]) -> Condition:
        return Condition('kind = ANY(%(kinds)s::integer[])', {'kinds': _array(numbers)})

    def pairs(self, pairs: List[Tuple[int, str]]) -> Condition:
        kinds, names = zip(*pairs)
        return Condition(
            "rocon_uri_resource AS resource JOIN unnest(%(pair_kinds)s::integer[], "
            "string_to_array(%(pair_names)s, '/')) AS pair (kind, name) "
            'ON resource.kind = pair.kind AND resource.name = pair.name',
            {'pair_kinds': _array(kinds), 'pair_names': '/'.join(names)})

    def names(self, pattern: NamePattern, kinds: str, by_kind: bool) -> Condition:
        # Only the index of names in each kind has these operators. The planner would take the other
        # index, since it assumes that few names have the same prefix.
        text, parameters = ranges(pattern, comparison='~' if by_kind else '')
        conditions = [text, kinds]
        if is_left_to_database(pattern):
            if isinstance(pattern, Glob):
                conditions.append("name LIKE %(pattern)s ESCAPE '!'")
                parameters['pattern'] = like(pattern.text)
            else:
                conditions.append('name ~ %(pattern)s')
                parameters['pattern'] = in_postgresql(pattern)
        return Condition(' AND '.join(filter(None, conditions)), parameters)

    def numbers(self, cursor: DBAPICursor, count: int) -> Tuple[float, List[int]]:
        cursor.execute(
            "SELECT extract(epoch FROM clock_timestamp()), nextval('rocon_uri_resource_id') "
            'FROM generate_series(1, %(count)s)', {'count': count})
        rows = cursor.fetchall()
        return float(rows[-1][0]), sorted(number for _, number in rows)

    def await_patterns(self, cursor: DBAPICursor) -> None:
        cursor.execute('SELECT pg_advisory_xact_lock(%d)' % _PATTERNS_LOCK)

    def add_kinds(self, cursor: DBAPICursor, kinds: Mapping[bytes, Fields]) -> None:
        for digest in sorted(kinds):        # in one order: different ones can deadlock
            cursor.execute(ADD_KIND, dict(kinds[digest]._asdict(), digest=digest))

    def kind_ids(self, cursor: DBAPICursor, digests: Iterable[bytes]) -> Dict[bytes, int]:
        cursor.execute('SELECT digest, id FROM rocon_uri_kind '
                       'WHERE digest = ANY(%(digests)s::bytea[])', {'digests': list(digests)})
        return {bytes(digest): number for digest, number in cursor.fetchall()}

    def add_rows(self, cursor: DBAPICursor, rows: List[Row], now: float) -> None:
        columns: Dict[str, object] = dict(zip(COLUMNS, map(list, zip(*sorted(rows)))))
        arrays = ', '.join('%%(%s)s::%s[]' % pair for pair in zip(COLUMNS, _TYPES))
        cursor.execute('INSERT INTO rocon_uri_resource (%s) SELECT * FROM unnest(%s)'
                       % (', '.join(COLUMNS), arrays) + REPLACE, dict(columns, now=now))


def _array(numbers: Iterable[int]) -> str:
    """An array as one text, which takes a third of the time of one element each."""
    return '{%s}' % ','.join(map(str, numbers))
