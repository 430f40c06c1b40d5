"""
Resources by their names, so that a request is not compared with each name.

A dict finds a literal name. For patterns a sorted order is built when a request first needs it: of
names for a prefix, of reversed names for a suffix. Few resources have a pattern themselves; each
distinct pattern is compared once.
"""
from __future__ import annotations

from bisect import bisect_left
from functools import partial
from itertools import chain, compress
from operator import itemgetter

from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.regular.budget import REQUEST_WORK_LIMIT, WORK_LIMIT, Budget

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import (Callable, Collection, Dict, Iterable, Iterator, List, Optional, Set, Tuple,
                        TypeVar)
    from rocon_uri.name_pattern import NamePattern
    from rocon_uri.uri import RoconURI
    Undecided = List[Tuple[NamePattern, Set[int]]]
    _Key = TypeVar('_Key')

__all__ = ['LITTLE_WORK', 'NameIndex', 'NameRequest']

_AFTER_NAMES = '\x7f'       # greater than any character of a name
LITTLE_WORK = WORK_LIMIT // 200        # 0.3 ms: most comparisons take less
_CHANGES_LIMIT = 100        # after more changes between two requests, sorting again is cheaper
_reversed: Callable[[str], str] = itemgetter(slice(None, None, -1))


class NameRequest:
    """
    The pattern that a request has in the name field, with the verdicts so far.

    All comparisons of a request together may take `REQUEST_WORK_LIMIT`.

    :param NamePattern pattern: any
    :param verdicts: dict from patterns of resources to whether they overlap with it; it grows, and
        requests with the same pattern may share it
    """

    def __init__(self, pattern: NamePattern,
                 verdicts: Optional[Dict[NamePattern, bool]] = None) -> None:
        self.pattern = pattern
        self.matches_in_order = pattern.matches_in_order()
        self._verdicts: Dict[NamePattern, bool] = {} if verdicts is None else verdicts
        self._work_left = REQUEST_WORK_LIMIT
        self._tried: Dict[NamePattern, int] = {}    # the limit that was too low

    def intersects(self, pattern: NamePattern, limit: int = WORK_LIMIT) -> Optional[bool]:
        """
        Does the pattern of a resource overlap with that of the request?

        :param NamePattern pattern: the pattern of the resource
        :param int limit: the work that this comparison may take, in the units of `WORK_LIMIT`
        :returns: bool, or None if deciding takes more work
        """
        if pattern not in self._verdicts and self._tried.get(pattern, 0) < limit:
            budget = Budget(min(limit, self._work_left))
            try:
                self._verdicts[pattern] = self.pattern.intersects(pattern, budget)
            except PatternTooComplex:
                self._tried[pattern] = limit
            self._work_left -= budget.spent
        return self._verdicts.get(pattern)


class NameIndex:
    """
    Numbered resources that differ in nothing but name and app, found by their names.

    Iteration gives the numbers.

    >>> from rocon_uri import name_pattern, parse
    >>> names = NameIndex()
    >>> names.add(1, parse('rocon:/pr2/bob_2'))
    >>> names.add(2, parse('rocon:/pr2/alice'))
    >>> names.numbers(NameRequest(name_pattern.read('bob_*')))
    ([1], [])
    """

    __slots__ = ('_named', '_namesakes', '_patterned', '_orders', '_size', '_changes')

    def __init__(self) -> None:
        self._named: Dict[str, int] = {}                # by literal name
        self._namesakes: Dict[str, Set[int]] = {}       # the others with the same name
        self._patterned: Dict[NamePattern, Set[int]] = {}
        self._orders: Dict[Callable[[str], str], _Order] = {}   # by the key
        self._size = 0
        self._changes = 0       # since the last request

    def __len__(self) -> int:
        return self._size

    def __iter__(self) -> Iterator[int]:
        return chain(self._named.values(), chain.from_iterable(self._namesakes.values()),
                     chain.from_iterable(self._patterned.values()))

    def add(self, number: int, uri: RoconURI) -> None:
        """Add a resource that is not there yet."""
        self._size += 1
        name = uri.name_text
        if uri.name_pattern is not None:
            self._patterned.setdefault(uri.name_pattern, set()).add(number)
        elif self._named.setdefault(name, number) == number:
            for order in self._orders_to_change():
                order.add(name)
        else:
            self._namesakes.setdefault(name, set()).add(number)

    def discard(self, number: int, uri: RoconURI) -> None:
        """Remove a resource that is there."""
        self._size -= 1
        name = uri.name_text
        if uri.name_pattern is not None:
            _remove(self._patterned, uri.name_pattern, number)
        elif self._named[name] != number:
            _remove(self._namesakes, name, number)
        elif name in self._namesakes:
            self._named[name] = self._namesakes[name].pop()
            if not self._namesakes[name]:
                del self._namesakes[name]
        else:
            del self._named[name]
            for order in self._orders_to_change():
                order.discard(name)

    def _orders_to_change(self) -> Collection[_Order]:
        self._changes += 1
        if self._changes > _CHANGES_LIMIT:
            self._orders.clear()
        return self._orders.values()

    def numbers(self, request: NameRequest) -> Tuple[List[int], Undecided]:
        """
        The resources whose name overlaps with that of a request.

        :param NameRequest request: of any pattern but ``*``
        :returns: (list of int, list of (NamePattern, set of int)), the numbers of those that do, in
            no particular order, and the patterns that take more than a little work to compare
            with the numbers of those that have them
        """
        names = list(self._names(request))
        found = list(map(self._named.__getitem__, names))
        if self._namesakes:
            found += chain.from_iterable(self._namesakes.get(name, ()) for name in names)
        undecided: Undecided = []
        for pattern, numbers in self._patterned.items():
            verdict = request.intersects(pattern, LITTLE_WORK)
            if verdict:
                found += numbers
            elif verdict is None:
                undecided.append((pattern, numbers))
        return found, undecided

    def _names(self, request: NameRequest) -> Iterable[str]:
        """The literal names that a request matches."""
        pattern, prefix, suffix = request.pattern, request.pattern.prefix, request.pattern.suffix
        if pattern.literal is not None:
            return [prefix] if prefix in self._named else []
        names: List[str] = []
        matches = request.matches_in_order
        if prefix or not suffix:
            names = self._order(str).starting_with(prefix)
        if suffix and (len(names) > 1 or not prefix):
            ending = self._order(_reversed).starting_with(suffix[::-1])
            if not prefix or len(ending) < len(names):
                names, matches = ending, partial(map, pattern.matches)
        if pattern.text in (prefix + '*', '*' + suffix):
            return names
        return compress(names, matches(names))

    def _order(self, key: Callable[[str], str]) -> _Order:
        self._changes = 0
        if key not in self._orders:
            self._orders[key] = _Order(self._named, key)
        return self._orders[key]


def _remove(sets: Dict[_Key, Set[int]], key: _Key, number: int) -> None:
    """Remove a number, and its set if that is empty then."""
    sets[key].remove(number)
    if not sets[key]:
        del sets[key]


class _Order:
    """Names in the order of their keys."""

    __slots__ = ('_key', '_names')

    def __init__(self, names: Iterable[str], key: Callable[[str], str]) -> None:
        self._key = key
        self._names = sorted(names, key=key)

    def add(self, name: str) -> None:
        self._names.insert(self._place(self._key(name)), name)

    def discard(self, name: str) -> None:
        del self._names[self._place(self._key(name))]

    def starting_with(self, start: str) -> List[str]:
        """The names whose key starts with a text."""
        return self._names[self._place(start):self._place(start + _AFTER_NAMES)]

    def _place(self, key: str) -> int:
        """As `bisect.bisect_left`, which takes a key from Python 3.10 on only."""
        if self._key is str:    # of whole names, so that none is needed: a fifth of the time
            return bisect_left(self._names, key)
        low, high = 0, len(self._names)
        while low < high:
            middle = (low + high) // 2
            if self._key(self._names[middle]) < key:
                low = middle + 1
            else:
                high = middle
        return low
