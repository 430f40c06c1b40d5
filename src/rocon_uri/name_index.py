"""
Resources by their names, so that a request is not compared with each name.

A sorted order is built when a request first needs it: of names for a literal name or a pattern with
a prefix, of reversed names for a pattern with a suffix. Few resources have a pattern themselves;
each distinct pattern is compared once.
"""
from __future__ import annotations

from bisect import bisect_left, bisect_right
from itertools import compress

from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.regular.budget import REQUEST_WORK_LIMIT, WORK_LIMIT, Budget

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Collection, Dict, List, Optional, Set, Tuple
    from rocon_uri.name_pattern import NamePattern
    from rocon_uri.uri import RoconURI
    Undecided = List[Tuple[NamePattern, Set[int]]]

__all__ = ['NameIndex', 'NameRequest']

_AFTER_NAMES = '\x7f'       # greater than any character of a name
_LITTLE_WORK = WORK_LIMIT // 200        # 0.3 ms: most comparisons take less
_CHANGES_LIMIT = 100        # after more changes between two requests, sorting again is cheaper


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
        self._tried: Dict[NamePattern, int] = {}    # with which limit, in vain

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
    Numbered resources, found by their name.

    ``resources`` has them all by number; it changes by `add` and `discard` only.

    >>> from rocon_uri import name_pattern, parse
    >>> names = NameIndex()
    >>> names.add(1, parse('rocon:/pr2/bob_2'))
    >>> names.add(2, parse('rocon:/pr2/alice'))
    >>> names.numbers(NameRequest(name_pattern.read('bob_*')))
    ([1], [])
    """

    __slots__ = ('resources', '_patterned', '_orders', '_changes')

    def __init__(self) -> None:
        self.resources: Dict[int, RoconURI] = {}
        self._patterned: Dict[NamePattern, Set[int]] = {}
        self._orders: Dict[bool, _Order] = {}       # by whether names are read backwards
        self._changes = 0       # since the last request

    def add(self, number: int, uri: RoconURI) -> None:
        """Add a resource, whose number is larger than all numbers so far."""
        self.resources[number] = uri
        if uri.name_pattern is None:
            for order in self._orders_to_change():
                order.add(uri.name_text, number)
        else:
            self._patterned.setdefault(uri.name_pattern, set()).add(number)

    def discard(self, number: int) -> None:
        """Remove a resource."""
        uri = self.resources.pop(number)
        if uri.name_pattern is None:
            for order in self._orders_to_change():
                order.discard(uri.name_text, number)
        else:
            numbers = self._patterned[uri.name_pattern]
            numbers.remove(number)
            if not numbers:
                del self._patterned[uri.name_pattern]

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
        found = self._literal(request)
        undecided: Undecided = []
        for pattern, numbers in self._patterned.items():
            verdict = request.intersects(pattern, _LITTLE_WORK)
            if verdict:
                found += numbers
            elif verdict is None:
                undecided.append((pattern, numbers))
        return found, undecided

    def _literal(self, request: NameRequest) -> List[int]:
        """The resources with a literal name that the request matches."""
        pattern, prefix, suffix = request.pattern, request.pattern.prefix, request.pattern.suffix
        if pattern.literal is not None:
            return self._order(False).equal_to(prefix)
        in_order = True
        names: List[str] = []
        numbers: List[int] = []
        if prefix or not suffix:
            names, numbers = self._order(False).starting_with(prefix)
        if suffix and (len(numbers) > 1 or not prefix):
            reversed_names, ending = self._order(True).starting_with(suffix[::-1])
            if not prefix or len(ending) < len(numbers):
                names, numbers = [name[::-1] for name in reversed_names], ending
                in_order = False
        if pattern.text in (prefix + '*', '*' + suffix):
            return numbers
        return list(compress(numbers, request.matches_in_order(names) if in_order
                             else map(pattern.matches, names)))

    def _order(self, backwards: bool) -> _Order:
        self._changes = 0
        if backwards not in self._orders:
            self._orders[backwards] = _Order(self.resources, backwards)
        return self._orders[backwards]


class _Order:
    """The literal names, or these reversed, in order with their numbers; equal ones by number."""

    __slots__ = ('_direction', '_keys', '_numbers')

    def __init__(self, resources: Dict[int, RoconURI], backwards: bool) -> None:
        self._direction = slice(None, None, -1 if backwards else 1)
        pairs = sorted((uri.name_text[self._direction], number)
                       for number, uri in resources.items() if uri.name_pattern is None)
        self._keys = [key for key, _ in pairs]
        self._numbers = [number for _, number in pairs]

    def add(self, name: str, number: int) -> None:
        key = name[self._direction]
        index = bisect_right(self._keys, key)
        self._keys.insert(index, key)
        self._numbers.insert(index, number)

    def discard(self, name: str, number: int) -> None:
        index = self._numbers.index(number, bisect_left(self._keys, name[self._direction]))
        del self._keys[index], self._numbers[index]

    def equal_to(self, key: str) -> List[int]:
        start = bisect_left(self._keys, key)
        return self._numbers[start:bisect_right(self._keys, key, start)]

    def starting_with(self, start: str) -> Tuple[List[str], List[int]]:
        first = bisect_left(self._keys, start)
        last = bisect_left(self._keys, start + _AFTER_NAMES, first)
        return self._keys[first:last], self._numbers[first:last]
