"""A database in the place of a file of resources."""
from __future__ import annotations

import re
from itertools import combinations, islice

from rocon_uri.cli.given import say, shown_name
from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.uri import RoconURI

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Iterator, Optional

    from rocon_uri.cli.given import Line, Report
    from rocon_uri.resource_database import ResourceDatabase

__all__ = ['Fleet', 'is_url', 'open_fleet']

_NEAREST = 1000     # resources among which the nearest name is looked for
_FIELDS = ('name', 'application_framework', 'operating_system', 'concert_name',
           'hardware_platform')

is_url = re.compile(r'[a-z0-9+]+://').match


class Fleet:
    """
    The resources in a database, as `Matches` takes them; what goes wrong is reported.

    :param ResourceDatabase database: open
    :param str name: what it is called, without a password
    :param Report report: gets what goes wrong
    """

    def __init__(self, database: ResourceDatabase, name: str, report: Report) -> None:
        self.name = name
        self._database = database
        self._report = report

    def lines(self, request: RoconURI) -> Iterator[Iterator[Line]]:
        """The resources that a request may be compatible with, as `Report.read_lines` yields."""
        yield self._lines(request)

    def _lines(self, request: RoconURI) -> Iterator[Line]:
        try:
            try:
                for uri in self._database.find(request, ordered=True):
                    yield uri, str(uri), None
            except PatternTooComplex as error:
                for uri in error.undecided:
                    yield uri, str(uri), None
        except OSError as error:
            self._report.note(str(error), self.name)
            say('rocon_uri: %s' % error)

    def nearest_lines(self, request: RoconURI) -> Iterator[Iterator[Line]]:
        """Resources that as few fields as possible exclude, where a request finds none."""
        asked = [field for field in _FIELDS if str(getattr(request, field)) not in ('', '*')]
        for count in range(1, len(asked) + 1):
            wider = (request.replace(**dict.fromkeys(fields, ''))       # type: ignore[arg-type]
                     for fields in combinations(asked, count))
            found = [line for each in wider for line in islice(self._lines(each), _NEAREST)]
            if found:
                yield iter(found)
                return

    def store(self, path: str) -> None:
        """Store the resources in a file, those whose lines are legal."""
        lines = (line for batch in self._report.read_lines(path) for line in batch)
        try:
            self._database.add_all(uri for uri, _, _ in lines)
        except OSError as error:
            self._report.note(str(error), shown_name(path))
            say('rocon_uri: %s' % error)


def open_fleet(url: str, report: Report, create: bool) -> Optional[Fleet]:
    """
    Open a database.

    :param str url: where it is
    :param Report report: gets what goes wrong
    :param bool create: make the tables
    :returns: Fleet, or None if it cannot be opened, which is reported
    """
    try:
        # here, since few calls need them, and not everybody has SQLAlchemy
        from rocon_uri.resource_database import ResourceDatabase, open_engine
        from rocon_uri.resource_database.engines import shown
        engine = open_engine(url)
        return Fleet(ResourceDatabase(engine, create), shown(engine), report)
    except ImportError as error:
        message = 'a database needs SQLAlchemy: apt-get install python3-sqlalchemy (%s)' % error
    except (OSError, ValueError, NotImplementedError) as error:
        message = str(error)
    report.note(message, None)
    say('rocon_uri: ' + message)
    return None
