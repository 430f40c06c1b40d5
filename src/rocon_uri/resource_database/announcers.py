"""
Who announced which resource, for directories that share a PostgreSQL.

A resource is there as long as the last of its announcers. No statement joins two tables: Citus may
have distributed them.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple

from rocon_uri.resource_database.database import ResourceDatabase
from rocon_uri.resource_database.engines import transaction
from rocon_uri.resource_database.rows import digest_of, fields_of, row_of
from rocon_uri.resource_database.postgresql import PostgreSQL
from rocon_uri.resource_database.writing import Writer
from rocon_uri.uri import RoconURI

if TYPE_CHECKING:
    from sqlalchemy.engine import Engine
    from sqlalchemy.engine.interfaces import DBAPICursor

__all__ = ['Announced', 'Announcers']

_LOCK = 0x726f636f6e75726a      # of this package alone; directories write in turn

_KEYS = 'unnest(%(announcers)s::text[], %(keys)s::text[]) AS given (announcer, key)'
_IS_GIVEN = ('rocon_uri_announcer.master = %(master)s AND '
             'rocon_uri_announcer.announcer = given.announcer AND '
             'rocon_uri_announcer.key = given.key')
_BEFORE = 'SELECT digest FROM rocon_uri_announcer, ' + _KEYS + ' WHERE ' + _IS_GIVEN
_LEAVE = 'DELETE FROM rocon_uri_announcer USING ' + _KEYS + ' WHERE ' + _IS_GIVEN
_ANNOUNCE = (
    'INSERT INTO rocon_uri_announcer (master, announcer, key, digest, uri, expires) '
    'SELECT %(master)s, * FROM unnest(%(announcers)s::text[], %(keys)s::text[], '
    '%(digests)s::bytea[], %(uris)s::text[], %(expires)s::double precision[]) '
    'ON CONFLICT (master, announcer, key) DO UPDATE SET digest = excluded.digest, '
    'uri = excluded.uri, expires = excluded.expires')
_LAST = ('SELECT digest, max(expires) FROM rocon_uri_announcer '
         'WHERE digest = ANY(%(digests)s::bytea[]) GROUP BY digest')
_FOR_EVER = ('SELECT digest FROM rocon_uri_resource '
             'WHERE digest = ANY(%(digests)s::bytea[]) AND expires IS NULL')
_SHORTEN = ('UPDATE rocon_uri_resource SET expires = given.expires FROM '
            'unnest(%(digests)s::bytea[], %(expires)s::double precision[]) AS given '
            '(digest, expires) WHERE rocon_uri_resource.digest = given.digest')
_REMOVE = 'DELETE FROM rocon_uri_resource WHERE digest = ANY(%(digests)s::bytea[])'


class Announced(NamedTuple):
    """What an announcer last said."""

    uri: RoconURI
    #: seconds from now on
    lifetime: float


class Announcers:
    """
    The announcers of one master, and the resources of all.

    :param engine: `sqlalchemy.engine.Engine`, of a PostgreSQL
    :param str master: tells this master from others
    :raises DatabaseError: for whatever the database reports, as do all methods
    """

    def __init__(self, engine: Engine, master: str) -> None:
        #: what answers requests
        self.resources = ResourceDatabase(engine)
        self._engine = engine
        self._dialect = PostgreSQL()
        self._writer = Writer(engine, self._dialect)
        self._master = master

    def store(self, announced: Mapping[Tuple[str, str], Optional[Announced]]) -> None:
        """
        Store announcements, all or none of them.

        :param announced: by announcer and key; None for a goodbye
        """
        said = {who: what for who, what in announced.items() if what is not None}
        uris = {digest_of(what.uri): what.uri for what in said.values()}
        fields = {digest: fields_of(uri) for digest, uri in uris.items()}
        kinds = self._writer.kind_ids(set(fields.values()))
        with transaction(self._engine) as connection:
            cursor = self._dialect.begin_writing(connection)
            cursor.execute('SELECT pg_advisory_xact_lock(%d)' % _LOCK)
            if any(uri.name_pattern is not None for uri in uris.values()):
                self._dialect.await_patterns(cursor)
            now, numbers = self._dialect.numbers(cursor, max(1, len(uris)))
            cursor.execute(_BEFORE, self._named(announced))
            before = {bytes(digest) for digest, in cursor.fetchall()}
            cursor.execute(_LEAVE, self._named(announced.keys() - said.keys()))
            cursor.execute(_ANNOUNCE, dict(
                self._named(said), digests=[digest_of(what.uri) for what in said.values()],
                uris=[str(what.uri) for what in said.values()],
                expires=[now + what.lifetime for what in said.values()]))
            last = self._last_expiries(cursor, [*before.union(uris)])
            rows = [row_of(uris[digest], number, kinds[fields[digest]], None, last[digest])
                    for number, digest in zip(numbers, uris) if digest in last]
            if rows:
                self._dialect.add_rows(cursor, rows, now)
            others = {digest: expires for digest, expires in last.items() if digest not in uris}
            cursor.execute(_SHORTEN, {'digests': list(others), 'expires': list(others.values())})

    def _last_expiries(self, cursor: DBAPICursor, digests: List[bytes]) -> Dict[bytes, float]:
        """
        When the last announcer of each resource falls silent.

        A resource that nobody announces any more is removed. One that was stored for ever, by
        somebody else, is left out and stays.
        """
        cursor.execute(_FOR_EVER, {'digests': digests})
        for_ever = {bytes(digest) for digest, in cursor.fetchall()}
        cursor.execute(_LAST, {'digests': digests})
        last = {bytes(digest): expires for digest, expires in cursor.fetchall()}
        cursor.execute(_REMOVE, {'digests': list(set(digests) - last.keys() - for_ever)})
        return {digest: expires for digest, expires in last.items() if digest not in for_ever}

    def purge(self) -> None:
        """Remove what has expired, which is in no answer anyway."""
        with transaction(self._engine) as connection:
            cursor = self._dialect.begin_writing(connection)
            cursor.execute('SELECT pg_advisory_xact_lock(%d)' % _LOCK)
            cursor.execute('DELETE FROM rocon_uri_announcer WHERE expires <= ' + self._dialect.now)
        self.resources.purge()

    def state(self) -> Tuple[object, ...]:
        """What differs when other resources are there, as far as 64 bits tell them apart."""
        return tuple(self._read('count(*), sum(hashtext(uri)::bigint)', '')[0])

    def uris(self) -> List[str]:
        """The texts of all resources, in the order in which they appeared."""
        return [uri for uri, in self._read('uri', ' ORDER BY id')]

    def _read(self, columns: str, order: str) -> List[Tuple[str, ...]]:
        with transaction(self._engine) as connection:
            cursor = self._dialect.begin_reading(connection)
            cursor.execute('SELECT %s FROM rocon_uri_resource WHERE expires IS NULL OR expires > %s'
                           % (columns, self._dialect.now) + order)
            rows: List[Tuple[str, ...]] = cursor.fetchall()
            return rows

    def _named(self, who: Iterable[Tuple[str, str]]) -> Dict[str, object]:
        pairs = list(who)
        return {'master': self._master, 'announcers': [announcer for announcer, _ in pairs],
                'keys': [key for _, key in pairs]}
