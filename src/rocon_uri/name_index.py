"""
The names of many resources, so that what a request says of the name need not be tried on each.

What is asked for decides what is built: names in alphabetical order for a literal name or for a
pattern that says how names start, names read backwards in order for one that says how they end.
Resources that have a pattern themselves are few; each different one is compared.
"""
from __future__ import annotations

from bisect import bisect_left, bisect_right
from itertools import compress

from rocon_uri.exceptions import PatternTooComplex

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, Iterable, List, Mapping, Optional, Set, Tuple
    from rocon_uri.name_pattern import NamePattern
    from rocon_uri.uri import RoconURI

__all__ = ['NameIndex', 'NameRequest']

_AFTER_NAMES = '\x7f'       # greater than any character of a name
_CHANGES_LIMIT = 100        # more of them since the last question, and the order is built anew


class NameRequest:
    """
    What a request says of the name, and what has come of it so far.

    :param NamePattern pattern: what it says

    ``pattern`` is an attribute too, and ``matches_in_order`` what its method returned.
    """

    def __init__(self, pattern: NamePattern) -> None:
        self.pattern = pattern
        self.matches_in_order = pattern.matches_in_order()
        self._verdicts: Dict[NamePattern, Optional[bool]] = {}

    def meets(self, pattern: NamePattern) -> Optional[bool]:
        """
        Is there a name that the request and another pattern both admit?

        :param NamePattern pattern: of a resource
        :returns: bool, or None if that takes too much work to decide
        """
        if pattern not in self._verdicts:
            try:
                self._verdicts[pattern] = self.pattern.intersects(pattern)
            except PatternTooComplex:
                self._verdicts[pattern] = None
        return self._verdicts[pattern]


class NameIndex:
    """
    The resources of a mapping, found by their name.

    The one who changes the mapping says so, with `add` and `discard`.

    :param resources: mapping from numbers to `RoconURI`

    >>> from rocon_uri import name_pattern, parse
    >>> names = NameIndex({1: parse('rocon:/pr2/bob_2'), 2: parse('rocon:/pr2/alice')})
    >>> names.numbers(NameRequest(name_pattern.read('bob_*')))
    ([1], [])
    """

    __slots__ = ('_resources', '_patterned', '_orders', '_changes')

    def __init__(self, resources: Mapping[int, RoconURI]) -> None:
        self._resources = resources
        self._patterned: Dict[NamePattern, Set[int]] = {}
        self._orders: Dict[bool, _Order] = {}       # by whether names are read backwards
        self._changes = 0
        for number, uri in resources.items():
            self.add(number, uri)

    def add(self, number: int, uri: RoconURI) -> None:
        """
        Note that the mapping has one resource more.

        :param int number: its number, larger than those that there were
        :param RoconURI uri: the resource
        """
        if uri.name_pattern is None:
            for backwards, order in self._changing():
                order.add(uri.name_text[::-1] if backwards else uri.name_text, number)
        else:
            self._patterned.setdefault(uri.name_pattern, set()).add(number)

    def discard(self, number: int, uri: RoconURI) -> None:
        """
        Note that the mapping has one resource less.

        :param int number: its number
        :param RoconURI uri: the resource
        """
        if uri.name_pattern is None:
            for backwards, order in self._changing():
                order.discard(uri.name_text[::-1] if backwards else uri.name_text, number)
        else:
            numbers = self._patterned[uri.name_pattern]
            numbers.remove(number)
            if not numbers:
                del self._patterned[uri.name_pattern]

    def _changing(self) -> Iterable[Tuple[bool, _Order]]:
        """What is to be kept up to date; where a lot changes, sorting again is cheaper."""
        self._changes += 1
        if self._changes > _CHANGES_LIMIT:
            self._orders.clear()
        return self._orders.items()

    def numbers(self, request: NameRequest) -> Tuple[List[int], List[int]]:
        """
        The resources whose name a request admits.

        :param NameRequest request: of any pattern but ``*``
        :returns: (list of int, list of int), their numbers and those of the ones that it takes
            too much work to decide about, in no order to rely on
        """
        found = self._literal(request)
        undecided: List[int] = []
        for pattern, numbers in self._patterned.items():
            verdict = request.meets(pattern)
            if verdict:
                found += numbers
            elif verdict is None:
                undecided += numbers
        return found, undecided

    def _literal(self, request: NameRequest) -> List[int]:
        pattern, prefix, suffix = request.pattern, request.pattern.prefix, request.pattern.suffix
        if pattern.literal is not None:
            return self._order(False).equal_to(prefix)
        matches = request.matches_in_order
        names: List[str] = []
        numbers: List[int] = []
        if prefix or not suffix:
            names, numbers = self._order(False).starting_with(prefix)
        if suffix and (len(numbers) > 1 or not prefix):
            reversed_names, ending = self._order(True).starting_with(suffix[::-1])
            if not prefix or len(ending) < len(numbers):
                names, numbers = [name[::-1] for name in reversed_names], ending
                matches = pattern.matches_each
        if pattern.text in (prefix + '*', '*' + suffix):
            return numbers
        return list(compress(numbers, matches(names)))

    def _order(self, backwards: bool) -> _Order:
        self._changes = 0
        order = self._orders.get(backwards)
        if order is None:
            names = ((uri.name_text, number) for number, uri in self._resources.items()
                     if uri.name_pattern is None)
            order = _Order((name[::-1], number) for name, number in names) if backwards \
                else _Order(names)
            self._orders[backwards] = order
        return order


class _Order:
    """Keys in order, and the number that belongs to each; equal keys by number."""

    __slots__ = ('_keys', '_numbers')

    def __init__(self, numbered: Iterable[Tuple[str, int]]) -> None:
        pairs = sorted(numbered)
        self._keys = [key for key, _ in pairs]
        self._numbers = [number for _, number in pairs]

    def add(self, key: str, number: int) -> None:
        index = bisect_right(self._keys, key)
        self._keys.insert(index, key)
        self._numbers.insert(index, number)

    def discard(self, key: str, number: int) -> None:
        index = self._numbers.index(number, bisect_left(self._keys, key))
        del self._keys[index], self._numbers[index]

    def equal_to(self, key: str) -> List[int]:
        start = bisect_left(self._keys, key)
        return self._numbers[start:bisect_right(self._keys, key, start)]

    def starting_with(self, start: str) -> Tuple[List[str], List[int]]:
        first = bisect_left(self._keys, start)
        last = bisect_left(self._keys, start + _AFTER_NAMES, first)
        return self._keys[first:last], self._numbers[first:last]
