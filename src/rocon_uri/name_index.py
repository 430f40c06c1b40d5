"""
The names of many resources, in order, so that a pattern need not be tried on each of them.

What is asked for decides what is built: names in alphabetical order for a literal name or for a
pattern that says how names start, names read backwards in order for one that says how they end.
"""
from __future__ import annotations

from bisect import bisect_left, bisect_right
from itertools import compress

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Dict, Iterable, List, Mapping, Tuple
    from rocon_uri.name_pattern import NamePattern
    from rocon_uri.uri import RoconURI
    Matcher = Callable[[List[str]], Iterable[bool]]

__all__ = ['NameIndex']

_AFTER_NAMES = '\x7f'       # greater than any character of a name
_CHANGES_LIMIT = 100        # more of them since the last question, and the order is built anew


class NameIndex:
    """
    The resources of a mapping that have a literal name, found by it.

    The one who changes the mapping says so, with `add` and `discard`.

    :param resources: mapping from numbers to `RoconURI`

    >>> from rocon_uri import name_pattern, parse
    >>> names = NameIndex({1: parse('rocon:/pr2/bob_2'), 2: parse('rocon:/pr2/bob_1'),
    ...                    3: parse('rocon:/pr2/al_1')})
    >>> bob = name_pattern.read('bob_*')
    >>> names.numbers(bob, bob.matches_in_order())
    [2, 1]
    """

    __slots__ = ('_resources', '_orders', '_changes')

    def __init__(self, resources: Mapping[int, RoconURI]) -> None:
        self._resources = resources
        self._orders: Dict[bool, _Order] = {}       # by whether names are read backwards
        self._changes = 0

    def add(self, name: str, number: int) -> None:
        """
        Note that the mapping has one resource more.

        :param str name: its name, a literal
        :param int number: its number, larger than those that there were
        """
        for backwards, order in self._changing():
            order.add(name[::-1] if backwards else name, number)

    def discard(self, name: str, number: int) -> None:
        """
        Note that the mapping has one resource less.

        :param str name: its name, a literal
        :param int number: its number
        """
        for backwards, order in self._changing():
            order.discard(name[::-1] if backwards else name, number)

    def _changing(self) -> Iterable[Tuple[bool, _Order]]:
        """What is to be kept up to date; where a lot changes, sorting again is cheaper."""
        self._changes += 1
        if self._changes > _CHANGES_LIMIT:
            self._orders.clear()
        return self._orders.items()

    def numbers(self, pattern: NamePattern, matches_in_order: Matcher) -> List[int]:
        """
        The resources whose name a pattern admits.

        :param NamePattern pattern: any but ``*``
        :param matches_in_order: what its method of that name returned
        :returns: list of int, their numbers, in no order to rely on
        """
        prefix, suffix = pattern.prefix, pattern.suffix
        if pattern.literal is not None:
            return self._order(False).equal_to(prefix)
        matches = matches_in_order
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
            names = ((uri._name, number) for number, uri in self._resources.items()
                     if uri._pattern is None)
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
