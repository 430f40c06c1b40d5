"""The resources of a fleet in a database, which answers requests."""
from __future__ import annotations

import json
from contextlib import contextmanager
from typing import TYPE_CHECKING, Dict, Iterator, List, Optional, Tuple, Union

from sqlalchemy.pool import StaticPool

from rocon_uri.resource_database.engines import shown, transaction
from rocon_uri.resource_database.functions import check_dialect
from rocon_uri.resource_database.known import Known, read_resource, refreshed
from rocon_uri.resource_database.postgresql import PostgreSQL
from rocon_uri.resource_database.questions import Question, question
from rocon_uri.resource_database.rows import digest_of, payload_text
from rocon_uri.resource_database.sqlite import SQLite, prepare_file
from rocon_uri.resource_database.tables import prepare_tables
from rocon_uri.resource_database.writing import Entry, Writer, check_lifetime
from rocon_uri.resource_index import too_complex
from rocon_uri.uri import RoconURI, parse

if TYPE_CHECKING:
    from sqlalchemy.engine import Connection, Engine
    from sqlalchemy.engine.interfaces import DBAPICursor

    from rocon_uri.resource_database.writing import Resources
    from rocon_uri.vocabulary import Vocabulary
    Resource = Union[str, RoconURI]

__all__ = ['ResourceDatabase']

_ROWS_AT_ONCE = 2000    # that are fetched
_QUESTIONS = 64         # that are remembered, since the same are asked again and again
_DRIVERS = {'sqlite': 'pysqlite', 'postgresql': 'psycopg2'}


class ResourceDatabase:
    """
    Resources in a database, which requests are matched with: SQLite, or PostgreSQL.

    It is used like `rocon_uri.ResourceIndex` and gives the same answers; any number of processes
    may use one database at once. A resource comes back as the current vocabulary reads it, or, if
    that does not know one of its values, as `rocon_uri.Vocabulary.open` does; groups are those of
    the process that asks. A resource with a lifetime is there until that has passed, by the clock
    of the database.

    :param engine: `sqlalchemy.engine.Engine`, as `open_engine` returns
    :param bool create: make the tables if they are not there, or are of an earlier version, and
        let SQLite write beside its file (WAL), so that a ``find`` keeps nobody from writing
    :raises DatabaseError: for tables of a later version; without ``create`` also of an earlier one,
        or if there are none; and, as do all methods, for whatever the database reports
    :raises NotImplementedError: for another dialect or driver, which the error names
    :raises ValueError: for SQLite in memory, if the engine has no `sqlalchemy.pool.StaticPool`:
        each connection would have a database of its own

    >>> from sqlalchemy import create_engine
    >>> fleet = ResourceDatabase(create_engine('sqlite://', poolclass=StaticPool))
    >>> fleet.add_all(['rocon:/pr2/bob', 'rocon:/kobuki/bob', 'rocon:/pr2/alice'])
    >>> [robot.name.string for robot in fleet.find('rocon:/pr2', ordered=True)]
    ['bob', 'alice']
    """

    def __init__(self, engine: Engine, create: bool = True) -> None:
        check_dialect(engine.dialect.name)
        if engine.dialect.driver != _DRIVERS[engine.dialect.name]:
            raise NotImplementedError("driver '%s' is not supported: use %s" % (
                engine.dialect.driver, _DRIVERS[engine.dialect.name]))
        self._engine = engine
        self._dialect = SQLite() if engine.dialect.name == 'sqlite' else PostgreSQL()
        #: what is known, and what it makes of requests
        self._state: Tuple[Optional[Known], Dict[Tuple[RoconURI, Vocabulary], Question]] = None, {}
        self._is_shared = isinstance(engine.pool, StaticPool)
        if engine.dialect.name == 'sqlite':
            prepare_file(engine, create)
        prepare_tables(engine, self._dialect, create)
        self._writer = Writer(engine, self._dialect)

    def add(self, uri: Resource, payload: object = None, lifetime: Optional[float] = None) -> None:
        """
        Add a resource, or give the one that is there another payload and lifetime.

        :param uri: RoconURI, or str that is parsed
        :param payload: what JSON can hold; it comes back as JSON reads it
        :param lifetime: float, seconds; None for ever
        :raises RoconURIValueError: for a text that is not legal, as do all methods that take one
        :raises TypeError: for a payload that JSON cannot hold
        :raises ValueError: for such a number, and a lifetime that is not greater than 0
        """
        check_lifetime(lifetime)
        self._writer.store([Entry(parse(uri), payload_text(payload))], lifetime)

    def add_all(self, resources: Resources, lifetime: Optional[float] = None) -> None:
        """
        Add many resources, 5,000 at a time; each such batch is stored whole or not at all.

        :param resources: mapping from resources to payloads, or iterable of resources and of pairs
            (tuples) of a resource and a payload; each as `add` takes it
        :param lifetime: float, seconds; None for ever
        :raises NotAllAdded: for a resource or payload that `add` refuses, and if the database fails
        :raises ValueError: for a lifetime that is not greater than 0
        """
        self._writer.store_all(resources, lifetime)

    def discard(self, uri: Resource) -> None:
        """
        Remove a resource if it is there.

        :param uri: RoconURI, or str that is parsed
        """
        digest = digest_of(parse(uri))
        with transaction(self._engine) as connection:
            self._dialect.begin_writing(connection).execute(
                self._dialect.written('DELETE FROM rocon_uri_resource WHERE digest = %(digest)s'),
                {'digest': digest})

    def purge(self) -> int:
        """
        Remove the resources whose lifetime has passed, which are in no answer anyway.

        :returns: int, how many there were
        """
        with transaction(self._engine) as connection:
            cursor = self._dialect.begin_writing(connection)
            cursor.execute('DELETE FROM rocon_uri_resource WHERE expires <= ' + self._dialect.now)
            count: int = cursor.rowcount
            return count

    def find(self, request: Resource, ordered: bool = False) -> Iterator[RoconURI]:
        """
        The resources that match a request.

        The answer is that of the moment of the call. It is read as it is taken: the iterator holds
        a connection until the last resource is taken, or until it is closed or lost.

        :param request: RoconURI, or str that is parsed
        :param bool ordered: in the order in which they were added, else in none
        :returns: iterator (a generator) of RoconURI
        :raises PatternTooComplex: after all others, as `rocon_uri.ResourceIndex.find` does
        """
        request = parse(request)
        undecided: List[RoconURI] = []
        rows = self._rows(request, ordered, undecided)
        next(rows)
        return _with_error_last(iter(list(rows)) if self._is_shared else rows, request, undecided)

    def _rows(self, request: RoconURI, ordered: bool,
              undecided: List[RoconURI]) -> Iterator[RoconURI]:
        """What is found, after the request itself, which says that the database was asked."""
        with self._asking(request) as (connection, cursor, asked):
            undecided += self._undecided(cursor, asked)
            if asked.parts:
                cursor = self._dialect.streaming_cursor(connection)
                cursor.execute(self._dialect.written(asked.select(ordered)), asked.parameters)
            try:
                yield request
                rows = cursor.fetchmany(_ROWS_AT_ONCE) if asked.parts else []
                while rows:
                    for row in rows:
                        uri = read_resource(row[0])
                        if asked.check is None or uri.name_pattern is not None \
                                or asked.check(uri.name_text):
                            yield uri
                    rows = cursor.fetchmany(_ROWS_AT_ONCE) if len(rows) == _ROWS_AT_ONCE else []
            finally:
                self._dialect.close(cursor)

    def count(self, request: Resource) -> int:
        """
        How many resources match a request.

        :param request: RoconURI, or str that is parsed
        :returns: int
        :raises PatternTooComplex: as `rocon_uri.ResourceIndex.count` does
        """
        request = parse(request)
        with self._asking(request) as (_, cursor, asked):
            undecided = self._undecided(cursor, asked)
            if not undecided and asked.check is None:
                count = 0
                if asked.parts:
                    cursor.execute(self._dialect.written(asked.select_count()), asked.parameters)
                    count = cursor.fetchone()[0]
                return count
        if undecided:
            raise too_complex(request, undecided)
        return sum(1 for _ in self.find(request))

    def any(self, request: Resource) -> bool:   # noqa: A003
        """
        Does any resource match a request?

        :param request: RoconURI, or str that is parsed
        :returns: bool
        :raises PatternTooComplex: as `rocon_uri.ResourceIndex.any` does
        """
        request = parse(request)
        with self._asking(request) as (_, cursor, asked):
            if asked.check is None and asked.parts:
                cursor.execute(self._dialect.written(asked.select_any()), asked.parameters)
                if cursor.fetchone():
                    return True
            undecided = self._undecided(cursor, asked)
        if asked.check is not None:
            return any(True for _ in self.find(request))
        if undecided:
            raise too_complex(request, undecided)
        return False

    @contextmanager
    def _asking(self, request: RoconURI) -> Iterator[Tuple[Connection, DBAPICursor, Question]]:
        """A transaction that sees one state of the database, and what to ask it."""
        with transaction(self._engine) as connection:
            cursor = self._dialect.begin_reading(connection)
            known, questions = self._state
            new = refreshed(known, self._dialect, cursor)
            if new is not known:
                known, questions = self._state = new, {}
            key = request, request.vocabulary
            asked = questions.get(key)
            if asked is None:
                asked = question(request, new, self._dialect)
                if len(questions) >= _QUESTIONS:
                    questions.clear()
                if asked.undecided is None:     # else the next time there is a new budget for it
                    questions[key] = asked
            try:
                yield connection, cursor, asked
            finally:
                self._dialect.close(cursor)

    def _undecided(self, cursor: DBAPICursor, asked: Question) -> List[RoconURI]:
        if asked.undecided is None:
            return []
        cursor.execute(self._dialect.written(asked.undecided.select(ordered=True)),
                       asked.undecided.parameters)
        return [read_resource(row[0]) for row in cursor.fetchall()]

    def __getitem__(self, uri: Resource) -> object:
        row = self._row(uri)
        if row is None:
            raise KeyError(uri)
        return row[0] and json.loads(row[0])

    def __contains__(self, uri: Resource) -> bool:
        return self._row(uri) is not None

    def _row(self, uri: Resource) -> Optional[Tuple[Optional[str]]]:
        """The payload of a resource that is there."""
        digest = digest_of(parse(uri))
        with transaction(self._engine) as connection:
            cursor = self._dialect.begin_reading(connection)
            cursor.execute(self._dialect.written(
                'SELECT payload FROM rocon_uri_resource WHERE digest = %(digest)s '
                'AND (expires IS NULL OR expires > {})'.format(self._dialect.now)),
                {'digest': digest})
            row: Optional[Tuple[Optional[str]]] = cursor.fetchone()
            self._dialect.close(cursor)
            return row

    def __iter__(self) -> Iterator[RoconURI]:
        return self.find(RoconURI(), ordered=True)

    def __len__(self) -> int:
        return self.count(RoconURI())

    def __repr__(self) -> str:
        return '<ResourceDatabase %s>' % shown(self._engine)


def _with_error_last(found: Iterator[RoconURI], request: RoconURI,
                     undecided: List[RoconURI]) -> Iterator[RoconURI]:
    yield from found
    if undecided:
        raise too_complex(request, undecided)
