"""
Two regular languages compared: a name that both have, a name that only one has.

The two are walked side by side, breadth first and so to the shortest names first. No step is
taken twice: each goes only to what no step before it has come to, in a sense that differs between
the two questions. The work is counted, and `PatternTooComplex` raised where it is too much.
"""
from __future__ import annotations

from functools import reduce
from itertools import islice
from operator import or_

from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.sources.wording import quoted
from rocon_uri.regular.language import BEGIN, Language, Step, Unions
from rocon_uri.regular.tree import ALPHABET, BIT, LETTERS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Dict, Iterator, List, Optional, Tuple

__all__ = ['WORK_LIMIT', 'Product', 'common_name', 'difference', 'includes']

WORK_LIMIT = 600000     # of one walk; a unit takes 0.1 to 0.2 microseconds, and 20 bytes at most
_COMPARED = 16          # how many of the sets come to first a new one is compared with
_PAIRS = 1 << 18        # of positions, of which it is found out whether one covers the other


def common_name(one: Language, other: Language) -> Optional[str]:
    """
    A shortest name that two languages have in common.

    :param Language one: a language
    :param Language other: another one
    :returns: str, or ``None`` if there is none
    :raises PatternTooComplex: if that takes too much work to decide

    >>> from rocon_uri.regular.syntax import parse
    >>> common_name(Language('', parse('[a-e]+')), Language('', parse('.*[d-z]{2}')))
    'dd'
    """
    if (one.tree.size, one.text) < (other.tree.size, other.text):
        one, other = other, one
    found = Product(one, other).common()
    return None if found is None else found.text()


def difference(one: Language, other: Language) -> Optional[str]:
    """
    A name that one language has and the other one has not.

    :param Language one: a language
    :param Language other: another one
    :returns: str, or ``None`` if all names of ``one`` are names of ``other``
    :raises PatternTooComplex: if that takes too much work to decide

    >>> from rocon_uri.regular.syntax import parse
    >>> difference(Language('', parse('(ab)*c')), Language('', parse('c?(abc)*')))
    'ababc'
    """
    found = Product(one, other).difference()
    return None if found is None else found.text() + one.completion(found.positions)


def includes(one: Language, other: Language) -> bool:
    """
    Has a language all names that another one has?

    :param Language one: a language
    :param Language other: another one
    :returns: bool
    :raises PatternTooComplex: if that takes too much work to decide

    >>> from rocon_uri.regular.syntax import parse
    >>> includes(Language('', parse('(ab)*a')), Language('', parse('a(ba){3}')))
    True
    """
    return one.tree == other.tree or Product(other, one).difference() is None


class Product:
    """
    Two languages side by side.

    :param Language one: a language, of which each step has a set of positions: it may have read
        any one of them, by some name
    :param Language other: another one

    ``work`` is what its walk has cost, in units as for `WORK_LIMIT`.
    """

    def __init__(self, one: Language, other: Language) -> None:
        self.one = one
        self.other = other
        self.work = 0
        classes: Dict[Tuple[str, str], Tuple[str, int, int]] = {}
        for char in ALPHABET:
            pair = one.char_class[char], other.char_class[char]
            classes.setdefault(pair, (char, one.readers[pair[0]], other.readers[pair[1]]))
        self._cost = 2 + (one.tree.size + other.tree.size) // 2000
        self._classes = [entry for entry in classes.values() if entry[1]]

    def common(self) -> Optional[Step]:
        """
        The last step of a shortest name in both, ``None`` if there is none.

        The other language's positions are followed one by one: there are only so many pairs of
        positions, and a pair come to once needs no second visit.
        """
        met: Dict[int, int] = {}
        steps = [Step(None, '', BEGIN, BEGIN)]
        for step in steps:
            for char, positions, others in self._derivatives(step):
                if positions & self.one.last and others & self.other.last:
                    return Step(step, char, positions, others)
                for other in _members(others):
                    self._spend(6 + self._cost)
                    known = met.get(other, 0)
                    fresh = positions & ~known
                    if fresh:
                        self._spend(6 + self._cost)
                        met[other] = known | fresh
                        steps.append(Step(step, char, fresh, 1 << other))
        return None

    def difference(self) -> Optional[Step]:
        """
        A step after which one language has a name and the other has not, ``None`` if none has.

        A set of the other's positions that has been come to with fewer in it needs no second
        visit: it would be harder to find a name that the larger one has not.
        """
        covered = self._covered()
        met: Dict[int, int] = {}
        steps = [Step(None, '', BEGIN, BEGIN)]
        for step in steps:
            for char, positions, others in self._derivatives(step):
                if not others or positions & self.one.last and not others & self.other.last:
                    return Step(step, char, positions, others)
                if others not in met:
                    self._spend(20 + _digits(others))
                    met[others] = covered(others)
                fresh = self._unmet(met, positions, others)
                if fresh:
                    met[others] |= fresh
                    steps.append(Step(step, char, fresh, others))
        return None

    def _covered(self) -> Callable[[int], int]:
        """
        For each set of the other's positions, the positions that one of them covers.

        One position covers another if whatever the latter reads, and whatever may follow it then,
        the former can read and be followed by as well. To find them, they are all taken to be, as
        far as what they read goes, and those that are not are taken out until none is left. Where
        that takes long, the walk does without.
        """
        follow, other_follow = self.one.following.sets, self.other.following.sets
        if len(follow) * len(other_follow) > _PAIRS:
            return _none
        before = [0] * len(follow)
        for position, following in enumerate(follow):
            for after in _members(following):
                before[after] |= 1 << position
        precede, everything = Unions(before), (1 << len(follow)) - 1
        readers = {chars: sum(1 << position for position, reads in enumerate(self.one.reads)
                              if reads and not reads & ~chars) for chars in set(self.other.reads)}
        covered = [readers[chars] for chars in self.other.reads]
        covered[0] = 1      # the end of a name, among the positions that may follow
        round_work = len(other_follow) * (20 + len(follow) // 4) + 2 * _count(other_follow)
        self._spend(2 * _count(follow))
        while self.work + round_work < WORK_LIMIT // 2:
            self._spend(round_work)
            known = list(covered)
            for other in range(len(covered) - 1, 0, -1):
                able = reduce(or_, (covered[after] for after in _members(other_follow[other])))
                covered[other] &= ~precede(everything & ~able)
            if covered == known:
                return Unions(covered)
        return _none

    def _unmet(self, met: Dict[int, int], positions: int, others: int) -> int:
        self._spend(6 + self._cost)
        fresh = positions & ~met[others]
        missing = ~others
        for fewer, known in islice(met.items(), _COMPARED if fresh else 0):
            self._spend(self._cost)
            if not fewer & missing:
                fresh &= ~known
                if not fresh:
                    break
        return fresh

    def _derivatives(self, step: Step) -> Iterator[Tuple[str, int, int]]:
        self._spend(20 + self._cost * len(self._classes)
                    + _digits(step.positions) + _digits(step.others))
        following, others = self.one.following(step.positions), self.other.following(step.others)
        for char, readers, other_readers in self._classes:
            positions = following & readers
            if positions and (step.before or BIT[char] & LETTERS):
                yield char, positions, others & other_readers

    def _spend(self, work: int) -> None:
        self.work += work
        if self.work > WORK_LIMIT:
            raise PatternTooComplex(
                'name patterns %s and %s are too complex to compare'
                % (quoted(self.one.text), quoted(self.other.text)), field='name',
                value=self.one.text, advice='use simpler ones, without large counts')


def _digits(positions: int) -> int:
    """About how many digits `Unions` goes through; one position needs none."""
    length, first = positions.bit_length(), (positions & -positions).bit_length()
    return (length - first) // 4 + length // 128 if length > first else 0


def _members(positions: int) -> Iterator[int]:
    while positions:
        lowest = positions & -positions
        positions ^= lowest
        yield lowest.bit_length() - 1


def _count(sets: List[int]) -> int:
    return sum(format(members, 'b').count('1') for members in sets)


def _none(positions: int) -> int:
    return 0
