"""
Which of a million names a regular language has.

Names that the language cannot tell apart, as those of a word and a number may be, are read once.
Where most can be told apart, those that start alike in alphabetical order are read at once as far
as they do, and where that decides about them, they are read no further. The first takes a seventh
of the time that it takes to read each name, the second a tenth at best.
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
    Derivatives = Dict[str, '_Derivative']
else:
    Derivatives = dict

__all__ = ['Walk']

_FEW = 50               # names, for which it costs more to find out what they share than it saves
_DERIVATIVES = 1024     # remembered
_KNOWN = 1 << 16        # names remembered, in about 10 MB
_AFTER_NAMES = '\x7f'   # greater than any character of a name


class Walk:
    """
    Names that are many, read by one language.

    :param Language language: any

    >>> from rocon_uri.regular.language import Language
    >>> from rocon_uri.regular.syntax import parse
    >>> Walk(Language('bo*b', parse('bo*b'))).matches(['al', 'bob', 'bobby', 'boob'])
    [False, True, False, True]
    """

    def __init__(self, language: Language) -> None:
        self.language = language
        self._derivatives: Dict[int, _Derivative] = {}
        self._class = str.maketrans(language.char_class)
        self._known: Dict[str, bool] = {}       # of names in which classes stand for characters
        self._room = _KNOWN                     # for more of these; none once they have no end

    def matches(self, names: List[str]) -> List[bool]:
        """
        Are these names in the language?

        :param names: list of str, legal ROS names in alphabetical order
        :returns: list of bool
        """
        if not names:
            return []
        if self._room:
            classes = '\n'.join(names).translate(self._class).split('\n')
            new = set(classes).difference(self._known)
            self._room = max(0, self._room - len(new))
            if self._room:
                self._known.update(zip(new, map(self.language.matches, new)))
                return [self._known[name] for name in classes]
        return self._walked(names)

    def _walked(self, names: List[str]) -> List[bool]:
        matches = [False] * len(names)
        ranges = [(0, len(names), 0, self.derivative(BEGIN))]
        while ranges:
            # names[start:end] share the characters up to depth, which led here
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

    def derivative(self, positions: int) -> _Derivative:
        """What is left of the language when these positions have just been read."""
        found = self._derivatives.get(positions)
        if found is None:
            if len(self._derivatives) >= _DERIVATIVES:
                for known in self._derivatives.values():
                    known.clear()       # since they hold each other
                self._derivatives.clear()
            found = self._derivatives[positions] = _Derivative(self, positions)
        return found


class _Derivative(Derivatives):
    """What is left of a language: by each next character, what is left then."""

    __slots__ = ('accepts', '_positions', '_walk')

    def __init__(self, walk: Walk, positions: int) -> None:
        self.accepts = positions & walk.language.last != 0
        self._positions = positions
        self._walk = walk

    def __missing__(self, char: str) -> _Derivative:
        language = self._walk.language
        readers = language.readers[language.char_class[char]]
        self[char] = self._walk.derivative(language.following(self._positions) & readers)
        return self[char]

    def decides(self) -> bool:
        """Is it all the same what follows?"""
        return all(self[char] is self for char in ALPHABET)
