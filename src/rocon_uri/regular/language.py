"""
Regular languages of ROS names: which names a syntax tree matches.

A language has *legal ROS names* only: a letter, then letters, digits and ``_``, of any length. Its
NFA is Glushkov's, whose states are the positions of the tree; an NFA state set is an int with one
bit a position. DFA states are NFA state sets, made when a name first reaches them and kept in a
bounded memo. So every character of a name takes one step, whatever the pattern, and the next name
that takes the same way only looks the steps up.
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

#: A pattern can have 2 ** 4096 DFA states, so its memo is bounded. A match starts with room for at
#: least `_SPARE` states, enough for a name of 255 characters, or with a new memo; a longer name
#: that fills it makes its other states without remembering them.
_STATES = 768
_SPARE = 256

#: Approximate limit in bytes for all remembered languages: three of the largest, or hundreds of
#: ordinary ones. Above it the least recently used ones are forgotten.
_MEMO_BYTES = 32 << 20

_IS_ONE = bytes(octet == ord('1') for octet in range(256))


def union(sets: List[int], selection: int) -> int:
    """
    The union of selected sets.

    :param sets: list of int, one set each
    :param int selection: the set of the indices of those to unite
    :returns: int

    >>> union([0b0001, 0b0010, 0b1000], 0b101) == 0b1001
    True
    """
    if selection & (selection - 1) == 0:    # at most one, as mostly: in a tenth of the time
        return sets[selection.bit_length() - 1] if selection else 0
    lowest = (selection & -selection).bit_length() - 1
    selected = format(selection >> lowest, 'b')[::-1].encode().translate(_IS_ONE)
    return reduce(or_, compress(sets[lowest:lowest + len(selected)], selected))


class _State(_Transitions):
    """A DFA state: a dict from character classes met so far, as octets, to the next DFA state."""

    __slots__ = ('accepts', 'positions')

    def __init__(self, positions: int, accepts: bool) -> None:
        self.positions = positions
        self.accepts = accepts


def _new_memo() -> Dict[int, _State]:
    """The two first DFA states by their NFA state sets."""
    nowhere = _State(0, False)
    nowhere.update(dict.fromkeys(ALPHABET.encode(), nowhere))
    return {0: nowhere, BEGIN: _State(BEGIN, False)}


class Language:
    """
    The legal ROS names that a syntax tree matches; there is at least one.

    Immutable but for its memo; threads may share it.

    :param str text: the pattern as written, for errors
    :param Node tree: its syntax tree

    ``work`` counts what matching has cost so far: one for each transition that was not in the memo,
    and one for every four positions. It is approximate where several threads match at once.

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
        #: for each position, the characters that it reads
        self.reads = [0] * size
        #: for each position, the positions that may come next
        self.follow = [0] * size
        tree.lay_out(1, _END, self.follow, self.reads)
        self.follow[0] = tree.first << 1
        #: the positions after which the name may end
        self.last = sum(1 << index for index in range(size) if self.follow[index] & _END)
        self.char_class, self.readers = _classes(self.reads)
        self._to_classes = bytes(ord(self.char_class.get(chr(octet), '\0')) for octet in range(256))
        self._lock = threading.Lock()
        self._memo = _new_memo()
        self._earlier: Dict[int, _State] = {}

    def matches(self, name: str) -> bool:
        """
        Is this name in the language?

        :param str name: any text
        :returns: bool, ``False`` for what is not a legal ROS name
        """
        memo = self._memo if len(self._memo) <= _STATES - _SPARE else self._fresh_memo()
        state = memo[BEGIN]
        # as bytes: translating a str to classes takes as long as all the rest
        for octet in name.encode('ascii', 'replace').translate(self._to_classes):
            try:
                state = state[octet]
            except KeyError:
                if not octet:
                    return False
                state = self._next_state(memo, state, octet)
        return state.accepts

    def _fresh_memo(self) -> Dict[int, _State]:
        with self._lock:        # other threads may still add to what is now the earlier memo
            if len(self._memo) > _STATES - _SPARE:
                for state in self._earlier.values():
                    state.clear()       # breaks their reference cycles
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
        The positions that may come after those of a state set.

        :param int positions: the state set
        :returns: int
        """
        return union(self.follow, positions)

    def example(self, positions: int = BEGIN) -> str:
        """
        A shortest name of the language, or a shortest completion of a name.

        :param int positions: the state set after the part of the name that has been read
        :returns: str, of lower-case letters if there is such a name
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
    :param int positions: the state set reached
    :param int others: the state set reached of another language, where two are walked
    """

    __slots__ = ('before', 'char', 'others', 'positions')

    def __init__(self, before: Optional[Step], char: str, positions: int,
                 others: int = 0) -> None:
        self.before = before
        self.char = char
        self.positions = positions
        self.others = others

    def text(self) -> str:
        """What has been read so far, as str."""
        chars: List[str] = []
        step: Optional[Step] = self
        while step is not None:
            chars.append(step.char)
            step = step.before
        return ''.join(reversed(chars))


def _classes(reads: List[int]) -> Tuple[Dict[str, str], Dict[str, int]]:
    """
    The character classes: each position reads all characters of a class or none.

    Each is named after its first character. Returns the class of every character, and the set of
    positions that read each class.
    """
    readers: Dict[int, int] = {LETTERS: 0}      # since only letters may start a name
    for index, chars in enumerate(reads):
        readers[chars] = readers.get(chars, 0) | 1 << index
    named: Dict[Tuple[bool, ...], str] = {}
    char_class = {char: named.setdefault(tuple(chars & BIT[char] != 0 for chars in readers), char)
                  for char in ALPHABET}
    return char_class, {name: sum(positions for chars, positions in readers.items()
                                  if chars & BIT[name]) for name in named.values()}


_languages: Dict[str, Language] = {}        # the most recently used last
_lock = threading.Lock()


def language(text: str, tree: Callable[[str], Node]) -> Language:
    """
    The language of a pattern, from a bounded memo.

    :param str text: the pattern
    :param tree: function from ``text`` to its syntax tree; called if the memo lacks the pattern
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
            if room >= 0:
                break
            room += _weight(_languages.pop(oldest))
    return found


def _weight(found: Language) -> int:
    """About the bytes that a language may grow to: most are state sets."""
    return (found.tree.size + 300) ** 2 // 2
