"""
Regular languages over ROS names: which names a syntax tree matches.

A language has only *legal ROS names*: a letter, then letters, digits and ``_``, of any length. It
is held as Glushkov's NFA, whose states are the positions of the tree. A state set is an int with a
bit for each position. The states of the DFA are such sets, made when a name first leads to them
and kept in a bounded memo. So each character of a name takes one step, whatever the pattern, and
the next name that goes the same way only looks the steps up.
"""
from __future__ import annotations

import threading
from functools import reduce
from itertools import compress
from operator import or_

from rocon_uri.regular.tree import ALPHABET, BIT, LETTERS, Node

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Dict, List, Optional, Tuple
    _Transitions = Dict[int, '_State']
else:
    _Transitions = dict

__all__ = ['BEGIN', 'Language', 'Step', 'language', 'union']

BEGIN = 1           # the state set before the first character: position 0 alone
_END = 1            # in a set of positions that may follow: the name may end here

#: The DFA of a pattern can have 2 ** 4096 states, so its memo is bounded. A match begins with room
#: for at least `_SPARE` states, which is enough for a name of 255 characters, or with a new memo;
#: a longer name that fills it makes its other states without remembering them.
_STATES = 768
_SPARE = 256

#: About the bytes that all remembered languages may come to take: three of the largest, or hundreds
#: of ordinary ones. Past it those that were not used for longest are made again when needed.
_MEMO_BYTES = 32 << 20


_IS_ONE = bytes(octet == ord('1') for octet in range(256))


def union(sets: List[int], selection: int) -> int:
    """
    The union of some of many sets.

    :param sets: list of int, a set each
    :param int selection: the set of the numbers of those to unite
    :returns: int

    >>> union([0b0001, 0b0010, 0b1000], 0b101) == 0b1001
    True
    """
    if not selection:
        return 0
    lowest = (selection & -selection).bit_length() - 1
    selected = format(selection >> lowest, 'b')[::-1].encode().translate(_IS_ONE)
    return reduce(or_, compress(sets[lowest:lowest + len(selected)], selected))


class _State(_Transitions):
    """A DFA state: for each class of characters met so far, as an octet, the next DFA state."""

    __slots__ = ('accepts', 'positions')

    def __init__(self, positions: int, accepts: bool) -> None:
        self.positions = positions
        self.accepts = accepts


def _new_memo() -> Dict[int, _State]:
    """DFA states by their NFA state sets."""
    nowhere = _State(0, False)
    nowhere.update(dict.fromkeys(ALPHABET.encode(), nowhere))
    return {0: nowhere, BEGIN: _State(BEGIN, False)}


class Language:
    """
    The legal ROS names that a syntax tree matches; there has to be one.

    Immutable but for its memo, and any number of threads may use it at once.

    :param str text: the pattern as written, for errors
    :param Node tree: its syntax tree

    ``work`` is what matching has cost so far: one for each transition that was not in the memo,
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
        #: for each position, those that may come next
        self.follow = follow
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
                state = self._next_state(memo, state, octet)
        return state.accepts

    def _fresh_memo(self) -> Dict[int, _State]:
        with self._lock:        # others may still add to what is now the earlier memo
            if len(self._memo) > _STATES - _SPARE:
                for state in self._earlier.values():
                    state.clear()       # since they hold each other
                self._earlier, self._memo = self._memo, _new_memo()
            return self._memo

    def _next_state(self, memo: Dict[int, _State], state: _State, octet: int) -> _State:
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

    def following(self, positions: int) -> int:
        """
        The positions that may come after any of some.

        :param int positions: the set of positions that have just been read
        :returns: int
        """
        return union(self.follow, positions)

    def example(self) -> str:
        """
        A shortest name of the language.

        :returns: str, of lower-case letters if there is such a name
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
    A step of a breadth-first walk through state sets.

    :param Step before: the step before, ``None`` at the beginning
    :param str char: the character read
    :param int positions: the state set that it leads to
    :param int others: that of another language, where two are walked
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
    """The bytes that a language may come to take, about: most are state sets."""
    return (found.tree.size + 300) ** 2 // 2
