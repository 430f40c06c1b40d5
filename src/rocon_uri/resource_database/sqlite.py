"""The statements of SQLite, from 3.31 on."""
from __future__ import annotations

import json
import os
import re
import sqlite3
import time
from typing import TYPE_CHECKING, Dict, Iterable, List, Mapping, Tuple

from sqlalchemy.pool import StaticPool

from rocon_uri.name_pattern import Glob, NamePattern
from rocon_uri.resource_database.dialects import (
    ADD_KIND, COLUMNS, REPLACE, Condition, Dialect, ranges)
from rocon_uri.resource_database.engines import DatabaseError, raw_connection, shown
from rocon_uri.resource_database.functions import add_functions
from rocon_uri.resource_database.names import is_left_to_database

if TYPE_CHECKING:
    from sqlalchemy.engine import Connection, Engine
    from sqlalchemy.engine.interfaces import DBAPICursor

    from rocon_uri.resource_database.rows import Fields, Row

__all__ = ['SQLite', 'prepare_file']

_BUSY_MILLISECONDS = 60000      # to wait for another writer, whose batch takes less
# Of pages in memory. The rows of a batch go to pages all over the indexes: with what SQLite has by
# default, which is enough for reading, loading 300,000 takes 1.4 times as long.
_READING_KIB = 2000
_WRITING_KIB = 65536


class SQLite(Dialect):
    """What SQLite says."""

    now = "((julianday('now') - 2440587.5) * 86400.0)"

    def written(self, statement: str) -> str:
        return re.sub(r'%\((\w+)\)s', r':\1', statement)

    def begin_reading(self, connection: Connection) -> DBAPICursor:
        return _begin(connection, 'BEGIN', _READING_KIB)

    def begin_writing(self, connection: Connection) -> DBAPICursor:
        return _begin(connection, 'BEGIN IMMEDIATE', _WRITING_KIB)

    def streaming_cursor(self, connection: Connection) -> DBAPICursor:
        return connection.connection.cursor()

    def close(self, cursor: DBAPICursor) -> None:
        cursor.close()      # CPython 3.8 crashes where it collects one with its connection later

    def kinds(self, numbers: List[int]) -> Condition:
        return Condition('kind IN (SELECT value FROM json_each(%(kinds)s))',
                         {'kinds': json.dumps(numbers)})

    def pairs(self, pairs: List[Tuple[int, str]]) -> Condition:
        # as keys and values: splitting a list for each pair takes longer than looking it up
        written = ','.join('"%d":"%s"' % (kind, name.replace('\\', r'\\'))
                           for kind, name in pairs)
        return Condition(
            'json_each(%(pairs)s) AS pair CROSS JOIN rocon_uri_resource AS resource '
            'ON resource.kind = CAST(pair.key AS INTEGER) AND resource.name = pair.value',
            {'pairs': '{%s}' % written})

    def names(self, pattern: NamePattern, kinds: str, by_kind: bool) -> Condition:
        # A plus keeps SQLite from looking a column up in an index. Only the longer end of the name
        # is looked up; the index of reversed names does not begin with the kind.
        from_end = len(pattern.suffix) > len(pattern.prefix)
        text, parameters = ranges(pattern, '+name' if from_end else 'name',
                                  'reversed' if from_end else '+reversed')
        conditions = [text, '+' + kinds if kinds and (from_end or not by_kind) else kinds]
        if is_left_to_database(pattern):
            conditions.append('name GLOB %(pattern)s' if isinstance(pattern, Glob)
                              else 'rocon_uri_matches(%(pattern)s, name)')
            parameters['pattern'] = pattern.text
        return Condition(' AND '.join(filter(None, conditions)), parameters)

    def numbers(self, cursor: DBAPICursor, count: int) -> Tuple[float, List[int]]:
        cursor.execute('SELECT %s, (SELECT seq FROM sqlite_sequence '
                       "WHERE name = 'rocon_uri_resource')" % self.now)
        now, last = cursor.fetchone()
        return now, list(range((last or 0) + 1, (last or 0) + 1 + count))

    def add_kinds(self, cursor: DBAPICursor, kinds: Mapping[bytes, Fields]) -> None:
        cursor.executemany(self.written(ADD_KIND), [
            dict(fields._asdict(), digest=digest) for digest, fields in kinds.items()])

    def kind_ids(self, cursor: DBAPICursor, digests: Iterable[bytes]) -> Dict[bytes, int]:
        found = {}
        for digest in digests:
            cursor.execute('SELECT id FROM rocon_uri_kind WHERE digest = ?', (digest,))
            found[digest] = cursor.fetchone()[0]
        return found

    def add_rows(self, cursor: DBAPICursor, rows: List[Row], now: float) -> None:
        values = ', '.join('%%(%s)s' % column for column in COLUMNS)
        statement = self.written('INSERT INTO rocon_uri_resource (%s) VALUES (%s)%s'
                                 % (', '.join(COLUMNS), values, REPLACE))
        cursor.executemany(statement, [dict(row._asdict(), now=now) for row in sorted(rows)])


def _begin(connection: Connection, statement: str, cache_kib: int) -> DBAPICursor:
    cursor = connection.connection.cursor()
    if 'rocon_uri' not in connection.info:
        add_functions(cursor.connection)
        cursor.execute('PRAGMA busy_timeout')
        if cursor.fetchone()[0] < _BUSY_MILLISECONDS:
            cursor.execute('PRAGMA busy_timeout = %d' % _BUSY_MILLISECONDS)
            cursor.fetchall()
        connection.info['rocon_uri'] = True
    if not cursor.connection.in_transaction:
        cursor.execute('PRAGMA cache_size = -%d' % cache_kib)
        cursor.execute(statement)
    return cursor


def prepare_file(engine: Engine, create: bool) -> None:
    """
    Refuse a database that each connection would have a copy of, and let others write.

    :param engine: `sqlalchemy.engine.Engine`
    :param bool create: make the file, and set WAL; else change nothing
    :raises ValueError: for one in memory, unless it has one connection only
    :raises DatabaseError: if there is no such file, and it cannot be created
    """
    path = engine.url.database
    if not create and path and not path.startswith('file:') and not os.path.exists(path):
        raise DatabaseError('%s: No such file or directory' % shown(engine))
    with raw_connection(engine) as cursor:
        is_file = any(name == 'main' and path
                      for _, name, path in _pragma(cursor, 'database_list'))
        if not is_file and not isinstance(engine.pool, StaticPool):
            raise ValueError('SQLite in memory needs an engine with poolclass=StaticPool: else '
                             'each connection has a database of its own')
        if is_file and create:
            _pragma(cursor, 'journal_mode = WAL')


def _pragma(cursor: DBAPICursor, text: str) -> List[Tuple[object, ...]]:
    """
    The rows of a PRAGMA.

    While another one makes the file, SQLite may refuse it at once, whatever the timeout is.
    """
    end = time.monotonic() + _BUSY_MILLISECONDS / 1000
    while True:
        try:
            cursor.execute('PRAGMA ' + text)
            return list(cursor.fetchall())
        except sqlite3.OperationalError as error:
            if 'locked' not in str(error) or time.monotonic() >= end:
                raise
        time.sleep(0.01)
