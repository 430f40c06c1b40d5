"""
Which of a million names in alphabetical order are in a regular language.

The common prefix of a range of names is read once, and the rest of them only if the prefix does not
decide. Where names have much in common this takes a tenth of the time of reading each name.
"""
from __future__ import annotations

from bisect import bisect_left, bisect_right
from functools import reduce
from operator import getitem
from os.path import commonprefix

from rocon_uri.regular.language import BEGIN
from rocon_uri.regular.tree import ALPHABET

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, List
    from rocon_uri.regular.language import Language
    _Transitions = Dict[str, '_State']
else:
    _Transitions = dict

__all__ = ['SortedWalk']

_FEW = 50               # names: for so few, finding the common prefix costs more than it saves
_STATES = 1024          # DFA states that are remembered; when there are more, all are forgotten
_AFTER_NAMES = '\x7f'   # greater than any character of a name


class SortedWalk:
    """
    A language that reads many sorted names.

    >>> from rocon_uri.regular.language import Language
    >>> from rocon_uri.regular.syntax import parse
    >>> SortedWalk(Language('bo*b', parse('bo*b'))).matches(['al', 'bob', 'bobby', 'boob'])
    [False, True, False, True]
    """

    def __init__(self, language: Language) -> None:
        self.language = language
        self._states: Dict[int, _State] = {}

    def matches(self, names: List[str]) -> List[bool]:
        """
        Are these names in the language?

        :param names: list of str, legal ROS names in alphabetical order
        :returns: list of bool
        """
        if not names:
            return []
        matches = [False] * len(names)
        ranges = [(0, len(names), 0, self.state(BEGIN))]
        while ranges:
            # the first `depth` characters of names[start:end] are equal and lead to this state
            start, end, depth, here = ranges.pop()
            if end - start <= _FEW:
                matches[start:end] = [reduce(getitem, name[depth:], here).accepts
                                      for name in names[start:end]]
                continue
            shared = commonprefix((names[start], names[end - 1]))
            here = reduce(getitem, shared[depth:], here)
            if here.decides():
                matches[start:end] = [here.accepts] * (end - start)
                continue
            same = bisect_right(names, shared, start, end)
            matches[start:same] = [here.accepts] * (same - start)
            while same < end:
                start, following = same, names[same][:len(shared) + 1]
                same = bisect_left(names, following + _AFTER_NAMES, start, end)
                ranges.append((start, same, len(shared), here))
        return matches

    def state(self, positions: int) -> _State:
        """The DFA state of an NFA state set."""
        found = self._states.get(positions)
        if found is None:
            if len(self._states) >= _STATES:
                for known in self._states.values():
                    known.clear()       # breaks their reference cycles
                self._states.clear()
            found = self._states[positions] = _State(self, positions)
        return found


class _State(_Transitions):
    """A DFA state: for each character, the next DFA state."""

    __slots__ = ('accepts', '_positions', '_walk')

    def __init__(self, walk: SortedWalk, positions: int) -> None:
        self.accepts = positions & walk.language.last != 0
        self._positions = positions
        self._walk = walk

    def __missing__(self, char: str) -> _State:
        language = self._walk.language
        readers = language.readers[language.char_class[char]]
        self[char] = self._walk.state(language.following(self._positions) & readers)
        return self[char]

    def decides(self) -> bool:
        """Does no character lead to another state?"""
        return all(self[char] is self for char in ALPHABET)
