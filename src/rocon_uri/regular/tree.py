"""
Normalised syntax trees of regular expressions over the characters of ROS names.

`Characters`, `sequence`, `choice` and `repeat` make the nodes and simplify as they build: they drop
equal branches, unite branches of one character, and turn repetition of repetition into one. No
part of a tree matches nothing, unless the whole tree is `NOTHING`.

The Glushkov positions of a node are its single characters once counted repetition is written out,
and the node can write them into an NFA: for each position, the characters that it reads and the
set of positions that may come next. A set of positions is an int with one bit each. Copies of a
repeated part are written out as ``r(r(r)?)?``: each is followed by the next one only, which keeps
the NFA small.
"""
from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, Iterable, List, Optional, Tuple

__all__ = ['ALPHABET', 'BIT', 'DIGITS', 'LETTERS', 'LOWER', 'NOTHING', 'UPPER', 'WORD',
           'Characters', 'Node', 'choice', 'glob', 'literal_ends', 'repeat', 'sequence']

# Example names prefer the characters that come first.
ALPHABET = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_'
BIT: Dict[str, int] = {char: 1 << index for index, char in enumerate(ALPHABET)}
LOWER = (1 << 26) - 1
UPPER = LOWER << 26
LETTERS = LOWER | UPPER
DIGITS = 0x3ff << 52
WORD = (1 << 63) - 1


class Node:
    """A part of a syntax tree; immutable, and equal to another of the same structure."""

    __slots__ = ('first', 'key', 'nullable', 'opening', 'size')
    key: Tuple[object, ...]     # the structure
    size: int           # how many positions it has
    nullable: bool      # does it match the empty text?
    first: int          # the positions that may read its first character; its own first one is 0
    opening: int        # the characters that they read

    def lay_out(self, base: int, after: int, follow: List[int], reads: List[int]) -> None:
        """
        Write the positions of this part into an NFA.

        :param int base: the number of its first position there
        :param int after: the set of positions that may come after this part
        :param follow: list of int, for each position the set of those that may come next
        :param reads: list of int, for each position the set of characters that it reads
        """
        raise NotImplementedError

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Node) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)


class Characters(Node):
    """
    One character out of a set.

    :param int chars: the set, as a sum of values of `BIT`; 0 makes `NOTHING`

    >>> Characters(BIT['a'] | BIT['b']).size
    1
    """

    __slots__ = ('chars',)

    def __init__(self, chars: int) -> None:
        self.key = ('characters', chars)
        self.chars = self.opening = chars
        self.size = self.first = 1
        self.nullable = False

    def lay_out(self, base: int, after: int, follow: List[int], reads: List[int]) -> None:
        follow[base], reads[base] = after, self.chars


class _Sequence(Node):
    __slots__ = ('items',)

    def __init__(self, items: Tuple[Node, ...]) -> None:
        self.key = ('sequence',) + tuple(item.key for item in items)
        self.items = items
        self.size = self.first = self.opening = 0
        self.nullable = True
        for item in items:
            if self.nullable:
                self.first |= item.first << self.size
                self.opening |= item.opening
                self.nullable = item.nullable
            self.size += item.size

    def lay_out(self, base: int, after: int, follow: List[int], reads: List[int]) -> None:
        base += self.size
        for item in reversed(self.items):
            base -= item.size
            item.lay_out(base, after, follow, reads)
            after = item.first << base | (after if item.nullable else 0)


class _Choice(Node):
    __slots__ = ('branches',)

    def __init__(self, branches: Tuple[Node, ...]) -> None:
        self.key = ('choice',) + tuple(branch.key for branch in branches)
        self.branches = branches
        self.size = self.first = self.opening = 0
        self.nullable = any(branch.nullable for branch in branches)
        for branch in branches:
            self.first |= branch.first << self.size
            self.opening |= branch.opening
            self.size += branch.size

    def lay_out(self, base: int, after: int, follow: List[int], reads: List[int]) -> None:
        for branch in self.branches:
            branch.lay_out(base, after, follow, reads)
            base += branch.size


class _Repeat(Node):
    __slots__ = ('copies', 'item', 'least', 'most')

    def __init__(self, item: Node, least: int, most: Optional[int]) -> None:
        self.key = ('repeat', item.key, least, most)
        self.item, self.least, self.most = item, least, most
        self.copies = max(least, 1) if most is None else most
        self.size = self.copies * item.size
        # Where the item is nullable, least is 0: copies that match nothing are left off at the end.
        self.first, self.opening, self.nullable = item.first, item.opening, least == 0

    def lay_out(self, base: int, after: int, follow: List[int], reads: List[int]) -> None:
        first, size = self.item.first, self.item.size
        for count in range(self.copies, 0, -1):     # copies read at the end of this one
            start = base + (count - 1) * size
            exits = after if count >= self.least else 0
            if count < self.copies:
                exits |= first << start + size
            elif self.most is None:
                exits |= first << start
            self.item.lay_out(start, exits, follow, reads)


NOTHING: Node = Characters(0)
_EMPTY: Node = _Sequence(())


def sequence(items: Iterable[Node]) -> Node:
    """
    Parts one after the other.

    >>> a = Characters(BIT['a'])
    >>> sequence([a, repeat(a, 0, None)]) == repeat(a, 1, None)
    True
    """
    flat: List[Node] = []
    for part in items:
        if part == NOTHING:
            return NOTHING
        for item in part.items if isinstance(part, _Sequence) else (part,):
            joined = _joined(flat[-1], item) if flat else None
            if joined is None:
                flat.append(item)
            else:
                flat[-1] = joined
    return flat[0] if len(flat) == 1 else _Sequence(tuple(flat))


def _joined(left: Node, right: Node) -> Optional[Node]:
    """Two neighbours as one repetition: ``x*x`` is ``x+``. None where they repeat different x."""
    if not isinstance(left, _Repeat) and not isinstance(right, _Repeat):
        return None
    item, least, most = _repetition(left)
    other, more_least, more_most = _repetition(right)
    if item is not other and item != other:
        return None
    return repeat(item, least + more_least,
                  None if most is None or more_most is None else most + more_most)


def _repetition(node: Node) -> Tuple[Node, int, Optional[int]]:
    return (node.item, node.least, node.most) if isinstance(node, _Repeat) else (node, 1, 1)


def choice(branches: Iterable[Node]) -> Node:
    """
    One of several parts.

    >>> choice([Characters(BIT['a']), Characters(BIT['b'])]).size
    1
    """
    single, empty = 0, False
    distinct: Dict[Node, None] = {}
    for part in branches:
        for branch in part.branches if isinstance(part, _Choice) else (part,):
            if isinstance(branch, Characters):
                single |= branch.chars
            elif branch == _EMPTY:
                empty = True
            else:
                distinct[branch] = None
    several = ((Characters(single),) if single else ()) + tuple(distinct)
    node = _Choice(several) if len(several) > 1 else several[0] if several else NOTHING
    return repeat(node, 0, 1) if empty else node


def repeat(item: Node, least: int, most: Optional[int]) -> Node:
    """
    A part several times in a row.

    :param Node item: the part
    :param int least: how often at least
    :param most: int, how often at most; ``None`` for no limit

    >>> a = Characters(BIT['a'])
    >>> repeat(repeat(a, 0, 1), 3, None) == repeat(a, 0, None)
    True
    """
    if most == 0 or item == _EMPTY:
        return _EMPTY
    if item == NOTHING:
        return NOTHING if least else _EMPTY
    if item.nullable:
        least = 0
    if most == 1 and (least == 1 or item.nullable):
        return item
    if isinstance(item, _Repeat) and (item.least <= 1 or least == most):
        # The total counts leave no gap, so one repetition has them all.
        most = None if most is None or item.most is None else item.most * most
        return repeat(item.item, item.least * least, most)
    return _Repeat(item, least, most)


def glob(text: str) -> Node:
    """
    The tree of a literal name or a glob.

    :param str text: name characters and ``*``

    >>> glob('a*').size
    2
    """
    return sequence(repeat(Characters(WORD), 0, None) if char == '*' else Characters(BIT[char])
                    for char in text)


def literal_ends(tree: Node) -> Tuple[str, str]:
    """
    What every text that a tree matches starts and ends with, as far as its structure shows.

    :param Node tree: the tree
    :returns: (str, str), the prefix and the suffix, each ``''`` if none is known

    >>> literal_ends(glob('ab*c'))
    ('ab', 'c')
    """
    items = tree.items if isinstance(tree, _Sequence) else (tree,)
    return _literal_run(items), _literal_run(reversed(items))[::-1]


def _literal_run(items: Iterable[Node]) -> str:
    run = ''
    for node in items:
        item, least, most = _repetition(node)
        if not isinstance(item, Characters) or item.chars & (item.chars - 1):
            break
        run += ALPHABET[item.chars.bit_length() - 1] * least
        if least != most:
            break
    return run
