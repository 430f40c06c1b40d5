"""
The product of two NFAs, walked breadth first and with a limit on the work.

A product state is a pair of NFA state sets. The subclasses in `rocon_uri.regular.intersection` and
`rocon_uri.regular.inclusion` decide which product states need no second visit.
"""
from __future__ import annotations

from rocon_uri.regular.budget import WORK_LIMIT, too_complex
from rocon_uri.regular.language import Language, Step
from rocon_uri.regular.tree import ALPHABET, BIT, LETTERS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, Iterator, Tuple

__all__ = ['Product', 'numbers_in', 'union_work']

class Product:
    """
    Two languages side by side.

    ``work`` is what the walk has cost so far, in the units of `WORK_LIMIT`; ``cost`` is the cost of
    one operation on a state set.
    """

    def __init__(self, one: Language, other: Language, limit: int = WORK_LIMIT) -> None:
        self.one = one
        self.other = other
        self.limit = limit
        self.work = 0
        classes: Dict[Tuple[str, str], Tuple[str, int, int]] = {}
        for char in ALPHABET:
            pair = one.char_class[char], other.char_class[char]
            classes.setdefault(pair, (char, one.readers[pair[0]], other.readers[pair[1]]))
        self.cost = 2 + (one.tree.size + other.tree.size) // 2000
        self._classes = [entry for entry in classes.values() if entry[1]]

    def successors(self, step: Step) -> Iterator[Tuple[str, int, int]]:
        """
        The product states that can come next.

        :param Step step: where the walk is
        :returns: iterator of (str, int, int): a character and the state set of each language
        """
        self.spend(20 + self.cost * len(self._classes)
                   + union_work(step.positions) + union_work(step.others))
        following, others = self.one.following(step.positions), self.other.following(step.others)
        for char, readers, other_readers in self._classes:
            positions = following & readers
            if positions and (step.before or BIT[char] & LETTERS):
                yield char, positions, others & other_readers

    def spend(self, work: int) -> None:
        """
        Count work.

        :param int work: how much
        :raises PatternTooComplex: if the total exceeds the limit
        """
        self.work += work
        if self.work > self.limit:
            raise too_complex(self.one.text, self.other.text)


def union_work(positions: int) -> int:
    """
    About the cost of uniting the sets of some positions, in the units of `WORK_LIMIT`.

    :param int positions: the positions
    :returns: int, 0 for a single position
    """
    length, first = positions.bit_length(), (positions & -positions).bit_length()
    return (length - first) // 4 + length // 128 if length > first else 0


def numbers_in(positions: int) -> Iterator[int]:
    """
    The numbers of the positions in a set, in ascending order.

    :param int positions: the set, one bit a position
    :returns: iterator of int
    """
    while positions:
        lowest = positions & -positions
        positions ^= lowest
        yield lowest.bit_length() - 1
