"""
Whether one regular language includes another: a name that only one of them has.

The antichain method, with simulation between the positions of the two NFAs.
"""
from __future__ import annotations

from functools import partial, reduce
from itertools import islice
from operator import or_

from rocon_uri.regular.language import BEGIN, Language, Step, union
from rocon_uri.regular.product import WORK_LIMIT, Product, numbers_in, union_work

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Dict, List, Optional

__all__ = ['Difference', 'difference', 'includes']

#: A new state set is compared with this many of the sets visited first, which are small and so are
#: most likely to be subsets of it. Comparing with all would make the walk quadratic; a subset that
#: is missed costs a visit that was not needed, never a wrong answer.
_COMPARED_SETS = 16

#: Simulation is worked out for at most this many pairs of positions. It would take most of
#: `WORK_LIMIT` for more; past it the walk visits more product states, with the same answer.
_MOST_PAIRS = 1 << 18


def difference(one: Language, other: Language) -> Optional[str]:
    """
    A name that one language has and the other one does not have.

    :param Language one: a language
    :param Language other: another one
    :returns: str, or ``None`` if all names of ``one`` are names of ``other``
    :raises PatternTooComplex: if that takes too much work to decide

    >>> from rocon_uri.regular.syntax import parse
    >>> difference(Language('', parse('(ab)*c')), Language('', parse('c?(abc)*')))
    'ababc'
    """
    found = Difference(one, other).find()
    return None if found is None else found.text() + one.completion(found.positions)


def includes(one: Language, other: Language) -> bool:
    """
    Does a language have all names that another one has?

    :param Language one: a language
    :param Language other: another one
    :returns: bool
    :raises PatternTooComplex: if that takes too much work to decide

    >>> from rocon_uri.regular.syntax import parse
    >>> includes(Language('', parse('(ab)*a')), Language('', parse('a(ba){3}')))
    True
    """
    return one.tree == other.tree or Difference(other, one).find() is None


class Difference(Product):
    """The product of two NFAs, searched for a name that only the first one accepts."""

    def find(self) -> Optional[Step]:
        """
        Find a name that the first language has and the other one does not have.

        A state set of the other NFA needs no second visit where it has been visited with a subset
        of it: the larger set accepts all that the smaller one accepts.

        :returns: Step after which the first language has such a name and the other one has none
            to match it, or ``None`` if there is no such name
        :raises PatternTooComplex: if that takes too much work
        """
        simulated = self._simulated()
        met: Dict[int, int] = {}
        steps = [Step(None, '', BEGIN, BEGIN)]
        for step in steps:
            for char, positions, others in self.successors(step):
                if not others or positions & self.one.last and not others & self.other.last:
                    return Step(step, char, positions, others)
                if others not in met:
                    self.spend(20 + union_work(others))
                    met[others] = simulated(others)
                fresh = self._unmet(met, positions, others)
                if fresh:
                    met[others] |= fresh
                    steps.append(Step(step, char, fresh, others))
        return None

    def _simulated(self) -> Callable[[int], int]:
        """
        For each set of the other NFA's positions, the positions that one of them simulates.

        A position simulates another one if it reads every character that the other one reads, and
        for whatever may follow the other one, something that simulates it may follow here. The
        largest such relation is found by starting with all pairs that agree in what they read, and
        taking out those that fail until none does. Where that takes long, the walk does without.
        """
        follow, other_follow = self.one.follow, self.other.follow
        if len(follow) * len(other_follow) > _MOST_PAIRS:
            return _nothing
        before = [0] * len(follow)
        for position, following in enumerate(follow):
            for after in numbers_in(following):
                before[after] |= 1 << position
        precede, everything = partial(union, before), (1 << len(follow)) - 1
        readers = {chars: sum(1 << position for position, reads in enumerate(self.one.reads)
                              if reads and not reads & ~chars) for chars in set(self.other.reads)}
        simulated = [readers[chars] for chars in self.other.reads]
        simulated[0] = 1      # the end of a name, among the positions that may follow
        round_work = len(other_follow) * (20 + len(follow) // 4) + 2 * _count(other_follow)
        self.spend(2 * _count(follow))
        while self.work + round_work < WORK_LIMIT // 2:
            self.spend(round_work)
            known = list(simulated)
            for other in range(len(simulated) - 1, 0, -1):
                able = reduce(or_, (simulated[after] for after in numbers_in(other_follow[other])))
                simulated[other] &= ~precede(everything & ~able)
            if simulated == known:
                return partial(union, simulated)
        return _nothing

    def _unmet(self, met: Dict[int, int], positions: int, others: int) -> int:
        self.spend(6 + self.cost)
        fresh = positions & ~met[others]
        missing = ~others
        for fewer, known in islice(met.items(), _COMPARED_SETS if fresh else 0):
            self.spend(self.cost)
            if not fewer & missing:
                fresh &= ~known
                if not fresh:
                    break
        return fresh


def _count(sets: List[int]) -> int:
    return sum(format(members, 'b').count('1') for members in sets)


def _nothing(positions: int) -> int:
    return 0
