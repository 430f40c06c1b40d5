"""A directory that shares a PostgreSQL with others, one for each master: they answer as one."""
from __future__ import annotations

from typing import Callable, Dict, List, Optional, Tuple, Union

from rocon_uri.announcement import Values
from rocon_uri.exceptions import UnregisteredValue
from rocon_uri.resource_database import DatabaseError, open_engine
from rocon_uri.resource_database.announcers import Announced, Announcers
from rocon_uri.resource_directory import Change, ResourceDirectory
from rocon_uri.uri import RoconURI, parse
from rocon_uri.vocabulary import Vocabulary

__all__ = ['SharedDirectory']

_PURGED = 10        # times that something was stored, after which what has expired is removed


class SharedDirectory(ResourceDirectory):
    """
    The announcements on one master, stored in a database that answers for all masters.

    Changes and counts are those of this master.

    :param str url: ``postgresql://USER@HOST/DATABASE``
    :param str master: tells this master from the others
    :param changed: as `ResourceDirectory` takes it
    :param report: likewise; also called when the database goes away, and when it is back
    :raises ValueError: for a text that is no such URL
    :raises NotImplementedError: for another database
    :raises DatabaseError: if the database does not answer
    """

    def __init__(self, url: str, master: str,
                 changed: Callable[[Change], None] = lambda change: None,
                 report: Callable[[str], None] = lambda text: None) -> None:
        super().__init__(changed, report)
        engine = open_engine(url)
        if engine.dialect.name != 'postgresql':
            raise NotImplementedError(
                "'%s' is not supported: directories share a 'postgresql'" % engine.dialect.name)
        self._announcers = Announcers(engine, master)
        #: what is to be stored, with the time until which it holds
        self._pending: Dict[Tuple[str, str], Optional[Tuple[RoconURI, float]]] = {}
        self._is_away = False
        self._stored = 0

    def announce(self, announcer: str, key: str, values: Values, lifetime: float) -> bool:
        """Take an announcement, as `ResourceDirectory` does; `store` makes it count."""
        with self._lock:
            taken = super().announce(announcer, key, values, lifetime)
            if taken:
                self._pending[announcer, key] = None if lifetime == 0.0 else (
                    self._entries[announcer][key].uri, self._clock() + lifetime)
            return taken

    def store(self) -> None:
        """
        Store what was announced since the last time.

        While the database is away the newest announcement of each announcer and key is kept.
        """
        with self._lock:
            pending, self._pending = self._pending, {}
            now = self._clock()
        announced = {who: what and Announced(what[0], what[1] - now)
                     for who, what in pending.items() if what is None or what[1] > now}
        try:
            if announced:
                self._announcers.store(announced)
            self._stored += 1
            if self._stored % _PURGED == 0:
                self._announcers.purge()
        except DatabaseError as error:
            with self._lock:
                self._pending = {**pending, **self._pending}
            self._say_whether_away(error)
        else:
            if announced:
                self._say_whether_away(None)

    def _say_whether_away(self, error: Optional[DatabaseError]) -> None:
        if (error is not None) != self._is_away:
            self._is_away = error is not None
            self._report('the database is back' if error is None else
                         'announcements are kept until the database is back: %s' % error)

    def find(self, request: Union[str, RoconURI]) -> List[str]:
        """
        The resources on all masters that are compatible with a request.

        It takes and raises what `ResourceDirectory.find` does.

        :raises DatabaseError: while the database is away
        """
        resources = self._announcers.resources
        try:
            return list(map(str, resources.find(request, ordered=True)))
        except UnregisteredValue as error:
            found = list(resources.find(parse(request, Vocabulary.open()), ordered=True))
            if not any(error.value in getattr(uri, error.field).alternatives
                       for uri in found if uri.vocabulary.is_open):
                raise
            return list(map(str, found))

    def uris(self) -> List[str]:
        """All resources on all masters, each once; a DatabaseError while the database is away."""
        return self._announcers.uris()

    def state(self) -> Tuple[object, ...]:
        """As `ResourceDirectory.state`; a DatabaseError while the database is away."""
        return self._announcers.state()
