"""
What SQLite and PostgreSQL say differently.

The parameters of statements are written as psycopg2 does, ``%(name)s``.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Dict, Iterable, List, Mapping, NamedTuple, Tuple

from rocon_uri.name_pattern import NamePattern
from rocon_uri.resource_database.names import after_names

if TYPE_CHECKING:
    from sqlalchemy.engine import Connection
    from sqlalchemy.engine.interfaces import DBAPICursor

    from rocon_uri.resource_database.rows import Fields, Row

__all__ = ['ADD_KIND', 'COLUMNS', 'REPLACE', 'Condition', 'Dialect', 'ranges']

#: those of a resource, in the order in which rows are given
COLUMNS = ('digest', 'id', 'kind', 'name', 'reversed', 'is_pattern', 'uri', 'payload', 'expires')

#: what adding a resource does with an equal one; if that has expired, the new one gets a new id, so
#: that it comes last
REPLACE = (' ON CONFLICT (digest) DO UPDATE SET payload = excluded.payload, '
           'expires = excluded.expires, ' + ', '.join(
               '{0} = CASE WHEN rocon_uri_resource.expires <= %(now)s THEN excluded.{0} '
               'ELSE rocon_uri_resource.{0} END'.format(column) for column in ('id', 'uri')))

ADD_KIND = (
    'INSERT INTO rocon_uri_kind (digest, concert_name, hardware_platform, application_framework, '
    'operating_system) VALUES (%(digest)s, %(concert_name)s, %(hardware_platform)s, '
    '%(application_framework)s, %(operating_system)s) ON CONFLICT (digest) DO NOTHING')


class Condition(NamedTuple):
    """A part of a statement, and what its parameters stand for."""

    #: SQL, with parameters as ``%(name)s``
    text: str
    #: the values of the parameters by name
    parameters: Dict[str, object]


class Dialect:
    """Statements, and parts of them, that differ; see `SQLite` and `PostgreSQL`."""

    #: an expression, seconds since 1970 by the clock of the database
    now: str

    def written(self, statement: str) -> str:
        """A statement with its parameters as the driver writes them."""
        return statement

    def begin_reading(self, connection: Connection) -> DBAPICursor:
        """Make a transaction one that sees one state of the database; returns a cursor."""
        raise NotImplementedError

    def begin_writing(self, connection: Connection) -> DBAPICursor:
        """Make a transaction one that writes; returns a cursor."""
        raise NotImplementedError

    def streaming_cursor(self, connection: Connection) -> DBAPICursor:
        """A cursor that does not hold all that it answers."""
        raise NotImplementedError

    def close(self, cursor: DBAPICursor) -> None:
        """Leave no statement of a cursor open, where that matters."""

    def kinds(self, numbers: List[int]) -> Condition:
        """The kind is one of these."""
        raise NotImplementedError

    def pairs(self, pairs: List[Tuple[int, str]]) -> Condition:
        """The resources joined with a table of kinds and names."""
        raise NotImplementedError

    def names(self, pattern: NamePattern, kinds: str, by_kind: bool) -> Condition:
        """
        A literal name matches, as far as a database compares it, and so does the kind.

        If ``by_kind``, a prefix is looked up for each of the kinds, which are few.
        """
        raise NotImplementedError

    def numbers(self, cursor: DBAPICursor, count: int) -> Tuple[float, List[int]]:
        """The time, and so many ids in order, none of which was ever given out."""
        raise NotImplementedError

    def await_patterns(self, cursor: DBAPICursor) -> None:
        """Wait for others who write patterns, whose ids are then in the order of their commits."""

    def add_kinds(self, cursor: DBAPICursor, kinds: Mapping[bytes, Fields]) -> None:
        """Insert kinds, unless they are there."""
        raise NotImplementedError

    def kind_ids(self, cursor: DBAPICursor, digests: Iterable[bytes]) -> Dict[bytes, int]:
        """The ids of kinds that are there, by their digests."""
        raise NotImplementedError

    def add_rows(self, cursor: DBAPICursor, rows: List[Row], now: float) -> None:
        """Insert resources, in the order of their digests, or replace the equal ones."""
        raise NotImplementedError


def ranges(pattern: NamePattern, name: str = 'name', backwards: str = 'reversed',
           comparison: str = '') -> Condition:
    """
    What a pattern says of how a literal name starts and ends.

    :param NamePattern pattern: any but ``*``
    :param str name: the column of names
    :param str backwards: that of names read backwards
    :param str comparison: what stands on both sides of ``<`` and ``>=`` for names
    :returns: Condition, '' for nothing

    >>> from rocon_uri import name_pattern
    >>> ranges(name_pattern.read('bob_*'))
    Condition(text='name >= %(name)s AND name < %(after_name)s', \
parameters={'name': 'bob_', 'after_name': 'bob`'})
    """
    if pattern.literal is not None:
        return Condition('%s = %%(name)s' % name, {'name': pattern.literal})
    texts: List[str] = []
    parameters: Dict[str, object] = {}
    for column, key, start, around in ((name, 'name', pattern.prefix, comparison),
                                       (backwards, 'reversed', pattern.suffix[::-1], '')):
        if start:
            texts.append('{0} {2}>={2} %({1})s AND {0} {2}<{2} %(after_{1})s'.format(
                column, key, around))
            parameters.update({key: start, 'after_' + key: after_names(start)})
    return Condition(' AND '.join(texts), parameters)
