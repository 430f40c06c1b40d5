"""What a process remembers of a database: its kinds, and the patterns among its resources."""
from __future__ import annotations

from typing import TYPE_CHECKING, Dict, List, NamedTuple, Optional, Set

from rocon_uri import name_pattern
from rocon_uri.exceptions import UnregisteredValue
from rocon_uri.resource_database.rows import Fields
from rocon_uri.uri import RoconURI, aligned, is_compatible, parse, with_any_name
from rocon_uri.vocabulary import Vocabulary, current

if TYPE_CHECKING:
    from sqlalchemy.engine.interfaces import DBAPICursor

    from rocon_uri.name_pattern import NamePattern
    from rocon_uri.resource_database.dialects import Dialect

__all__ = ['Known', 'read_resource', 'refreshed']

_STATE = ('SELECT (SELECT count(*) FROM rocon_uri_kind), '
          '(SELECT max(id) FROM rocon_uri_resource WHERE is_pattern = 1)')
_KINDS = ('SELECT id, concert_name, hardware_platform, application_framework, operating_system '
          'FROM rocon_uri_kind')
_PATTERNS = ('SELECT kind, name FROM rocon_uri_resource '
             'WHERE is_pattern = 1 AND id > %(last)s')


class Known(NamedTuple):
    """
    What was read of a database; kinds and patterns that have gone from it do no harm.

    Kinds are never removed, so that their number tells whether there are new ones; nor is an id
    ever given out twice, so that new patterns have larger ones.
    """

    #: what the kinds were read with
    vocabulary: Vocabulary
    #: by their ids, each with any name
    kinds: Dict[int, RoconURI]
    #: the ids of the kinds of resources with this pattern
    patterns: Dict[NamePattern, Set[int]]
    #: the largest id of a resource with a pattern
    last_pattern: int

    def kinds_that_fit(self, request: RoconURI) -> Optional[List[int]]:
        """
        The ids of the kinds that a request is compatible with, whatever it says of the name.

        :param RoconURI request: the request
        :returns: list of int, or None for all that there are
        """
        asked = with_any_name(request)
        found = [number for number, kind in self.kinds.items() if _fits(kind, asked, request)]
        return None if len(found) == len(self.kinds) else found


def _fits(kind: RoconURI, asked: RoconURI, request: RoconURI) -> bool:
    if kind.vocabulary is not asked.vocabulary:
        try:
            kind, asked = aligned(kind, asked)
        except UnregisteredValue:       # rocon:/ is compatible all the same
            return is_compatible(kind, request)
    return is_compatible(kind, asked)


def refreshed(known: Optional[Known], dialect: Dialect, cursor: DBAPICursor) -> Known:
    """
    What is known, with all that a database has in addition.

    :param known: Known, or None for nothing
    :param Dialect dialect: of the database
    :param cursor: in a transaction that sees one state of the database
    :returns: Known, the same where nothing is new
    """
    vocabulary = current()
    cursor.execute(_STATE)
    count, last = cursor.fetchone()
    last = last or 0
    if known is None or count != len(known.kinds) or known.vocabulary is not vocabulary:
        cursor.execute(_KINDS)
        kinds = {number: _read_kind(Fields(*fields)) for number, *fields in cursor.fetchall()}
        known = Known(vocabulary=vocabulary, kinds=kinds, patterns=known.patterns if known else {},
                      last_pattern=known.last_pattern if known else 0)
    if last > known.last_pattern:
        cursor.execute(dialect.written(_PATTERNS), {'last': known.last_pattern})
        patterns = {pattern: set(kinds) for pattern, kinds in known.patterns.items()}
        for kind, name in cursor.fetchall():
            patterns.setdefault(name_pattern.read(name), set()).add(kind)
        known = known._replace(patterns=patterns, last_pattern=last)
    return known


def _read_kind(fields: Fields) -> RoconURI:
    try:
        return RoconURI.from_fields(**fields._asdict())
    except UnregisteredValue:
        return RoconURI.from_fields(**fields._asdict(), vocabulary=Vocabulary.open())


def read_resource(text: str) -> RoconURI:
    """
    A resource that was stored, as the current vocabulary reads it, or else any.

    :param str text: its canonical text
    :returns: RoconURI
    """
    try:
        return parse(text)
    except UnregisteredValue:
        return parse(text, Vocabulary.open())
