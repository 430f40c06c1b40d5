"""Resources on their way into a database, in batches that are stored whole or not at all."""
from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import islice
from typing import TYPE_CHECKING, Dict, Iterable, Iterator, List, NamedTuple, Optional, Tuple, Union

from rocon_uri.resource_database.engines import DatabaseError, transaction
from rocon_uri.resource_database.rows import Fields, fields_of, payload_text, row_of
from rocon_uri.uri import RoconURI, parse

if TYPE_CHECKING:
    from sqlalchemy.engine import Engine

    from rocon_uri.resource_database.dialects import Dialect
    Resource = Union[str, RoconURI]
    Resources = Union[Mapping[Resource, object], Iterable[Union[Resource, Tuple[Resource, object]]]]

__all__ = ['Entry', 'NotAllAdded', 'Writer', 'entries_of']

_BATCH = 5000


class NotAllAdded(DatabaseError):
    """
    Resources that were added in batches, up to one that failed; the cause is its error.

    :param int added: how many were read of those that are stored; an attribute too
    :param error: what is wrong with the next batch, of which nothing is stored
    """

    def __init__(self, added: int, error: Exception) -> None:
        super().__init__('%s; of the resources the first %d are stored, and no others'
                         % (error, added))
        self.added = added

    def __reduce__(self) -> Tuple[object, ...]:
        return _unpickled, (str(self), self.added)


def _unpickled(text: str, added: int) -> NotAllAdded:
    error = NotAllAdded.__new__(NotAllAdded)
    OSError.__init__(error, text)
    error.added = added
    return error


class Entry(NamedTuple):
    """A resource to be stored."""

    #: the resource
    uri: RoconURI
    #: as `rocon_uri.resource_database.rows.payload_text` returns it
    payload: Optional[str]


def entries_of(resources: Resources) -> Iterator[Entry]:
    """
    Resources as they are given to `ResourceDatabase.add_all`.

    :param resources: mapping from resources to payloads, or iterable of resources and of pairs of
        a resource and a payload
    :returns: iterator of Entry
    :raises RoconURIValueError: for a text that is not legal
    :raises TypeError: for a payload that JSON cannot hold; also a ValueError
    """
    for item in resources.items() if isinstance(resources, Mapping) else resources:
        uri, payload = item if isinstance(item, tuple) else (item, None)
        yield Entry(parse(uri), payload_text(payload))


class Writer:
    """
    Stores resources.

    :param engine: `sqlalchemy.engine.Engine`
    :param Dialect dialect: of the engine
    """

    def __init__(self, engine: Engine, dialect: Dialect) -> None:
        self._engine = engine
        self._dialect = dialect
        self._kinds: Dict[Fields, int] = {}     # their ids, which never change

    def store_all(self, resources: Resources, lifetime: Optional[float]) -> None:
        """Store any number; as `ResourceDatabase.add_all`."""
        check_lifetime(lifetime)
        entries = entries_of(resources)
        added = 0
        while True:
            try:
                batch = list(islice(entries, _BATCH))
                if batch:
                    self.store(batch, lifetime)
            except (DatabaseError, TypeError, ValueError) as error:
                raise NotAllAdded(added, error) from error
            added += len(batch)
            if len(batch) < _BATCH:
                return

    def store(self, entries: List[Entry], lifetime: Optional[float]) -> None:
        """Store some, all or none of them; an equal one that comes later replaces the payload."""
        payloads: Dict[RoconURI, Optional[str]] = {}
        for uri, payload in entries:
            payloads[uri] = payload
        fields = {uri: fields_of(uri) for uri in payloads}
        kinds = self.kind_ids(set(fields.values()))
        with transaction(self._engine) as connection:
            cursor = self._dialect.begin_writing(connection)
            if any(uri.name_pattern is not None for uri in payloads):
                self._dialect.await_patterns(cursor)
            now, numbers = self._dialect.numbers(cursor, len(payloads))
            expires = None if lifetime is None else now + lifetime
            self._dialect.add_rows(cursor, [
                row_of(uri, number, kinds[fields[uri]], payload, expires)
                for number, (uri, payload) in zip(numbers, payloads.items())], now)

    def kind_ids(self, kinds: Iterable[Fields]) -> Dict[Fields, int]:
        """Their ids; those that are new are committed, so that whoever sees a row sees its kind."""
        missing = {fields.digest(): fields for fields in kinds if fields not in self._kinds}
        if missing:
            with transaction(self._engine) as connection:
                self._dialect.add_kinds(self._dialect.begin_writing(connection), missing)
            with transaction(self._engine) as connection:
                ids = self._dialect.kind_ids(self._dialect.begin_reading(connection), missing)
            self._kinds.update((missing[digest], number) for digest, number in ids.items())
        return self._kinds


def check_lifetime(lifetime: Optional[float]) -> None:
    """Refuse what is not a time in seconds, with a ValueError."""
    if lifetime is not None and not 0 < lifetime < math.inf:
        raise ValueError('lifetime %r is not a number of seconds greater than 0' % lifetime)
