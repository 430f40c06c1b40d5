"""
Resources that announce themselves, and the requests that they answer.

A resource is there from its first announcement until it says goodbye, or falls silent for longer
than its lifetime. Who it is: who announces it, and a key among those of that announcer. This is the
pure part; `rocon_uri.directory_node` is the node.
"""
from __future__ import annotations

import time
from enum import IntEnum
from threading import RLock
from typing import Callable, Dict, List, NamedTuple, Optional, Set, Tuple, Union

from rocon_uri.announcement import Values, check_key, check_lifetime, read_values
from rocon_uri.compatibility import Explanation, explain
from rocon_uri.exceptions import UnregisteredValue
from rocon_uri.resource_index import ResourceIndex
from rocon_uri.sources.wording import printable
from rocon_uri.uri import RoconURI, parse
from rocon_uri.vocabulary import Vocabulary

__all__ = ['Change', 'ResourceDirectory', 'What']

_KEYS_OF_ONE = 1000     # announcer, so that one that runs wild does not fill the directory
_KEYS = 100000          # in all, likewise of announcers
_SHOWN = 1000           # faults that are remembered, so that each is shown once


class What(IntEnum):
    """What became of one announcer's resource, numbered as in ``ResourceChange.msg``."""

    #: it was not there before
    APPEARED = 1
    #: it is another URI than before
    CHANGED = 2
    #: it said goodbye
    LEFT = 3
    #: it fell silent for longer than its lifetime
    EXPIRED = 4


class Change(NamedTuple):
    """Something that became of one announcer's resource."""

    what: What
    #: the resource
    uri: RoconURI
    #: what it was, if it changed; else None
    before: Optional[RoconURI]
    #: who announced it
    announcer: str
    #: which of the announcer's it is
    key: str


class _Entry:
    """What one announcer last said under one key; mostly it is only renewed, in place."""

    __slots__ = ('values', 'uri', 'expires')

    def __init__(self, values: Values, uri: RoconURI, expires: float) -> None:
        self.values = values
        self.uri = uri
        self.expires = expires      # by the clock of the directory


class ResourceDirectory:
    """
    The resources that are announced, in memory; any thread may use it.

    :param changed: called with each `Change`, one at a time and in their order
    :param report: called with a text for each announcement that is refused, once for each announcer
        and text
    :param clock: returns seconds

    >>> from rocon_uri.announcement import values_of
    >>> directory = ResourceDirectory()
    >>> directory.announce('/bob', '', values_of('rocon:/pr2/bob'), 10.0)
    True
    >>> directory.find('rocon:/pr2')
    ['rocon:/pr2/bob/*/*']
    """

    def __init__(self, changed: Callable[[Change], None] = lambda change: None,
                 report: Callable[[str], None] = lambda text: None,
                 clock: Callable[[], float] = time.monotonic) -> None:
        self._changed = changed
        self._report = report
        self._clock = clock
        self._lock = RLock()
        self._entries: Dict[str, Dict[str, _Entry]] = {}    # by announcer and key
        self._size = 0              # of all of them
        self._index = ResourceIndex()       # its payloads: how many announce a resource
        self._version = 0           # another one when other resources are there
        self._next_expiry = float('inf')    # none expires before
        self._shown: Set[Tuple[str, str]] = set()
        #: how many announcements were refused
        self.refused = 0

    def announce(self, announcer: str, key: str, values: Values, lifetime: float) -> bool:
        """
        Take an announcement; the announcer's earlier one with this key no longer counts.

        One that is wrong is counted and reported, and changes nothing.

        :param str announcer: who it is
        :param str key: which of the announcer's resources it is, at most 255 characters; an
            announcer has at most 1,000 of them, and all have at most 100,000
        :param values: the fields of the resource, as `rocon_uri.announcement.values_of` returns
            them
        :param float lifetime: seconds, 0.1 to 3,600; 0 says goodbye
        :returns: bool, was it taken?
        """
        with self._lock:
            now = self._clock()
            entry = self._entries.get(announcer, {}).get(key)
            if entry is not None and entry.expires <= now:      # and nobody has looked since
                self._remove(announcer, key, What.EXPIRED)
                entry = None
            if lifetime == 0.0:
                if entry is not None:
                    self._remove(announcer, key, What.LEFT)
                return True
            try:
                check_lifetime(lifetime)
                if entry is None:
                    self._check_room(announcer, key)
                uri = entry.uri if entry and entry.values == values else read_values(values)
            except ValueError as fault:
                self.refuse(announcer, str(fault))
                return False
            self._next_expiry = min(self._next_expiry, now + lifetime)
            if entry is None:
                self._entries.setdefault(announcer, {})[key] = _Entry(values, uri, now + lifetime)
                self._size += 1
                self._hold(uri)
                self._tell(What.APPEARED, uri, announcer, key)
                return True
            before = entry.uri
            entry.values, entry.uri, entry.expires = values, uri, now + lifetime
            if uri != before:
                self._hold(uri)
                self._release(before)
                self._tell(What.CHANGED, uri, announcer, key, before)
            return True

    def refuse(self, announcer: str, problem: str) -> None:
        """
        Count something that is wrong, and report it unless that was done.

        :param str announcer: whose it is
        :param str problem: what is wrong
        """
        with self._lock:
            self.refused += 1
            if (announcer, problem) in self._shown or len(self._shown) >= _SHOWN:
                return
            self._shown.add((announcer, problem))
            self._report('refused an announcement of %s: %s'
                         % (printable(announcer), printable(problem)))
            if len(self._shown) == _SHOWN:
                self._report('further announcements that are refused are only counted')

    def expire(self) -> None:
        """Remove the resources whose lifetime has passed; answers do so themselves."""
        with self._lock:
            now = self._clock()
            if now < self._next_expiry:
                return
            for announcer, key in [(announcer, key) for announcer, entries in self._entries.items()
                                   for key, entry in entries.items() if entry.expires <= now]:
                self._remove(announcer, key, What.EXPIRED)
            self._next_expiry = min((entry.expires for entries in self._entries.values()
                                     for entry in entries.values()), default=float('inf'))

    def find(self, request: Union[str, RoconURI]) -> List[str]:
        """
        The resources that are compatible with a request, each once.

        A value that is not registered may be asked for if a resource has it.

        :param request: str or RoconURI
        :returns: list of str
        :raises RoconURIValueError: for a text that is not legal
        :raises PatternTooComplex: as `rocon_uri.ResourceIndex.find` does
        """
        with self._lock:
            self.expire()
            try:
                asked = parse(request)
            except UnregisteredValue as error:
                if not any(error.value in getattr(uri, error.field).alternatives
                           for uri in self._index if uri.vocabulary.is_open):
                    raise
                asked = parse(request, Vocabulary.open())
            return list(map(str, self._index.find(asked)))

    def explain(self, request: str, uri: str) -> Explanation:
        """
        Why a resource is compatible with a request, or not.

        :param str request: a URI
        :param str uri: another one, which need not be in the directory
        :returns: `rocon_uri.compatibility.Explanation`
        :raises RoconURIValueError: for a text that is not legal
        """
        return explain(request, uri)

    def store(self) -> None:
        """Make what was announced count; called once a second. In memory it does so at once."""

    def state(self) -> Tuple[object, ...]:
        """What differs when other resources are there."""
        with self._lock:
            self.expire()
            return (self._version,)

    def uris(self) -> List[str]:
        """All resources, each once, in the order in which they appeared."""
        with self._lock:
            self.expire()
            return list(map(str, self._index))

    def unregistered(self) -> List[str]:
        """The resources that have a value which is not registered."""
        with self._lock:
            self.expire()
            return [str(uri) for uri in self._index if uri.vocabulary.is_open]

    def __len__(self) -> int:
        """How many announcements count now."""
        with self._lock:
            self.expire()
            return self._size

    def _check_room(self, announcer: str, key: str) -> None:
        check_key(key)
        if len(self._entries.get(announcer, ())) >= _KEYS_OF_ONE:
            raise ValueError('it has %d keys, the most that one node may have' % _KEYS_OF_ONE)
        if self._size >= _KEYS:
            raise ValueError('there are %d announcements, the most that a directory keeps' % _KEYS)

    def _remove(self, announcer: str, key: str, what: What) -> None:
        entries = self._entries[announcer]
        uri = entries.pop(key).uri
        self._size -= 1
        if not entries:
            del self._entries[announcer]
        self._release(uri)
        self._tell(what, uri, announcer, key)

    def _tell(self, what: What, uri: RoconURI, announcer: str, key: str,
              before: Optional[RoconURI] = None) -> None:
        self._changed(Change(what=what, uri=uri, before=before, announcer=announcer, key=key))

    def _hold(self, uri: RoconURI) -> None:
        holders = self._index.get(uri) or 0
        self._version += not holders
        self._index[uri] = holders + 1

    def _release(self, uri: RoconURI) -> None:
        holders = self._index[uri]
        if holders == 1:
            self._version += 1
            del self._index[uri]
        else:
            self._index[uri] = holders - 1
