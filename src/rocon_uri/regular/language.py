"""
Regular languages over ROS names: which names a syntax tree matches.

A language has only *legal ROS names*: a letter, then letters, digits and ``_``, of any length. It
stands on the positions of the tree and works by derivatives. What is left of the language after
some characters, its derivative by them, is fixed by the set of positions that have just been read;
sets are ints with a bit for each position. A derivative is worked out when a name first leads to
it and kept in a bounded memo. So each character of a name takes one step, whatever the pattern,
and the next name that comes the same way only looks them up.
"""
from __future__ import annotations

import threading
from functools import reduce
from operator import getitem, or_

from rocon_uri.regular.tree import ALPHABET, BIT, LETTERS, Node

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Dict, List, Optional, Tuple
    _Mapping = Dict[str, int]
    _Derivatives = Dict[int, '_State']
else:
    _Mapping = _Derivatives = dict

__all__ = ['BEGIN', 'Language', 'Step', 'Unions', 'language']

BEGIN = 1           # the set of the one position that comes before the first character
_END = 1            # in a set of positions that may follow: the name may end here

_STATES = 768       # derivatives in a memo
_SPARE = 256        # of these, how many a name to come can count on
_MEMO_BYTES = 32 << 20      # of all languages that are remembered, about


class _Row(_Mapping):
    """The unions of some of four sets, by which of them, as a hexadecimal digit."""

    __slots__ = ('sets',)

    def __init__(self, sets: List[int]) -> None:
        self.sets = sets

    def __missing__(self, digit: str) -> int:
        chosen = int(digit, 16)
        self[digit] = union = reduce(
            or_, (members for index, members in enumerate(self.sets) if chosen >> index & 1), 0)
        return union


class Unions:
    """
    Of sets that are numbered, the union of any selection.

    A selection can have thousands of members, so unions are taken over four of them at a time.

    :param sets: list of int
    """

    def __init__(self, sets: List[int]) -> None:
        self.sets = sets
        self._rows = [_Row(sets[index:index + 4]) for index in range(0, len(sets), 4)]

    def __call__(self, selection: int) -> int:
        """
        The union of some of the sets.

        :param int selection: the set of their numbers
        :returns: int
        """
        lowest = selection & -selection
        if selection == lowest:     # of one set or none there is nothing to unite
            return self.sets[selection.bit_length() - 1] if selection else 0
        before = (lowest.bit_length() - 1) // 4
        digits = format(selection >> 4 * before, 'x')[::-1]
        return reduce(or_, map(getitem, self._rows[before:], digits))


class _State(_Derivatives):
    """A derivative: from the classes of characters met so far, as octets, to those by them."""

    __slots__ = ('accepts', 'positions')

    def __init__(self, positions: int, accepts: bool) -> None:
        self.positions = positions
        self.accepts = accepts


def _new_memo() -> Dict[int, _State]:
    """Derivatives by their positions."""
    nowhere = _State(0, False)
    nowhere.update(dict.fromkeys(ALPHABET.encode(), nowhere))
    return {0: nowhere, BEGIN: _State(BEGIN, False)}


class Language:
    """
    The legal ROS names that a syntax tree matches; there has to be one.

    Immutable but for its memo, and any number of threads may use it at once.

    :param str text: the pattern as written, for errors
    :param Node tree: its syntax tree

    ``work`` is what matching has cost so far: one for each derivative that was not in the memo,
    and one for every four positions. Where several threads match at once it is approximate.

    >>> from rocon_uri.regular.syntax import parse
    >>> bob = Language('bob_?[0-9]*', parse('bob_?[0-9]*'))
    >>> bob.matches('bob_7'), bob.matches('bobby'), bob.example()
    (True, False, 'bob')
    """

    def __init__(self, text: str, tree: Node) -> None:
        self.text = text
        self.tree = tree
        self.work = 0
        size = tree.size + 1
        follow, reads = [0] * size, [0] * size
        tree.lay_out(1, _END, follow, reads)
        follow[0] = tree.first << 1
        #: for each position, the characters that it reads
        self.reads = reads
        #: for each set of positions, those that may come next
        self.following = Unions(follow)
        #: the positions after which the name may end
        self.last = reduce(or_, (1 << index for index in range(size) if follow[index] & _END))
        self.char_class, self.readers = _classes(reads)
        self._to_classes = _octets(self.char_class)
        self._lock = threading.Lock()
        self._memo = _new_memo()
        self._earlier: Dict[int, _State] = {}

    def matches(self, name: str) -> bool:
        """
        Is this name in the language?

        :param str name: any text
        :returns: bool, ``False`` for what is not a legal ROS name
        """
        memo = self._memo
        if len(memo) > _STATES - _SPARE:
            memo = self._fresh_memo()
        state = memo[BEGIN]
        # octets, since to put a str into classes takes as long as all the rest
        for octet in name.encode('ascii', 'replace').translate(self._to_classes):
            try:
                state = state[octet]
            except KeyError:
                if not octet:
                    return False
                state = self._derivative(memo, state, octet)
        return state.accepts

    def _fresh_memo(self) -> Dict[int, _State]:
        with self._lock:        # others may still add to what is now the earlier memo
            if len(self._memo) > _STATES - _SPARE:
                for state in self._earlier.values():
                    state.clear()       # since they hold each other
                self._earlier, self._memo = self._memo, _new_memo()
            return self._memo

    def _derivative(self, memo: Dict[int, _State], state: _State, octet: int) -> _State:
        earlier = self._earlier.get(state.positions, state).get(octet)
        positions = self._read(state.positions, chr(octet)) if earlier is None \
            else earlier.positions
        with self._lock:
            found = memo.get(positions)
            if found is None:
                found = _State(positions, positions & self.last != 0)
                if len(memo) == _STATES:
                    return found
                memo[positions] = found
            state[octet] = found
        return found

    def _read(self, positions: int, char: str) -> int:
        self.work += 1 + positions.bit_length() // 4
        if positions == BEGIN and not BIT[char] & LETTERS:
            return 0
        return self.following(positions) & self.readers[self.char_class[char]]

    def example(self) -> str:
        """
        A shortest name of the language.

        :returns: str, of lower-case letters if there is such a one
        """
        return self.completion(BEGIN)

    def completion(self, positions: int) -> str:
        """
        A shortest text that makes a name of what has been read.

        :param int positions: the set of positions that have just been read
        :returns: str
        """
        steps, seen = [Step(None, '', positions)], positions
        for step in steps:
            if step.positions & self.last:
                break
            following = self.following(step.positions)
            for char, readers in self.readers.items():
                fresh = following & readers & ~seen
                if fresh and (step.positions != BEGIN or BIT[char] & LETTERS):
                    seen |= fresh
                    steps.append(Step(step, char, fresh))
        return step.text()


class Step:
    """
    A step of a breadth-first walk through derivatives.

    :param Step before: the step before, ``None`` at the beginning
    :param str char: the character read
    :param int positions: the positions that have been come to
    :param int others: those of another language, where two are walked
    """

    __slots__ = ('before', 'char', 'others', 'positions')

    def __init__(self, before: Optional[Step], char: str, positions: int,
                 others: int = 0) -> None:
        self.before = before
        self.char = char
        self.positions = positions
        self.others = others

    def text(self) -> str:
        """What has been read on the way here, as str."""
        chars: List[str] = []
        step: Optional[Step] = self
        while step is not None:
            chars.append(step.char)
            step = step.before
        return ''.join(reversed(chars))


def _octets(char_class: Dict[str, str]) -> bytes:
    """For `bytes.translate`: to the class of a character, and to 0 for what no name has."""
    table = bytearray(256)
    for char, name in char_class.items():
        table[ord(char)] = ord(name)
    return bytes(table)


def _classes(reads: List[int]) -> Tuple[Dict[str, str], Dict[str, int]]:
    """
    The alphabet in classes of characters that every position reads all or none of.

    Each is named by its first character: the class of every character, and the positions that
    read a class.
    """
    readers: Dict[int, int] = {LETTERS: 0}      # which alone may be the first of a name
    for index, chars in enumerate(reads):
        readers[chars] = readers.get(chars, 0) | 1 << index
    named: Dict[Tuple[bool, ...], str] = {}
    char_class = {char: named.setdefault(tuple(chars & BIT[char] != 0 for chars in readers), char)
                  for char in ALPHABET}
    return char_class, {
        name: reduce(or_, (found for chars, found in readers.items() if chars & BIT[name]), 0)
        for name in named.values()}


_languages: Dict[str, Language] = {}        # those used last are last
_lock = threading.Lock()


def language(text: str, tree: Callable[[str], Node]) -> Language:
    """
    The language of a pattern, from a bounded memo.

    :param str text: the pattern
    :param tree: makes its syntax tree out of ``text``; asked if it is not in the memo
    :returns: Language
    """
    with _lock:
        found = _languages.pop(text, None)
        if found is not None:
            _languages[text] = found
            return found
    found = Language(text, tree(text))
    with _lock:
        _languages[text] = found
        room = _MEMO_BYTES - sum(map(_weight, _languages.values()))
        for oldest in list(_languages):
            if room >= 0:       # at the latest with this one, whatever its size
                break
            room += _weight(_languages.pop(oldest))
    return found


def _weight(found: Language) -> int:
    """The bytes that a language may come to take, about: most are rows of sets of positions."""
    return (found.tree.size + 300) ** 2 // 2
