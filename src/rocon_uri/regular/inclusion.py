"""
Does one regular language include another? A search for a name that only the second one has.

The antichain method, pruned by simulation between the Glushkov positions of the two NFAs.
"""
from __future__ import annotations

from functools import reduce
from itertools import islice
from operator import or_

from rocon_uri.regular.budget import WORK_LIMIT
from rocon_uri.regular.language import BEGIN, Language, Step, union
from rocon_uri.regular.product import Product, numbers_in, union_work

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, List, Optional

__all__ = ['Difference', 'includes']

#: A new state set is compared with this many of the sets visited first, which are small and so most
#: likely to be subsets of it. Comparing it with all would make the walk quadratic; a missed subset
#: costs an unneeded visit, never a wrong answer.
_COMPARED_SETS = 16

#: The simulation preorder is computed for at most this many pairs of positions: for more it would
#: take most of `WORK_LIMIT`. Without it the walk visits more product states, with the same answer.
_MOST_PAIRS = 1 << 18


def includes(one: Language, other: Language) -> bool:
    """
    Does a language have all names that another one has?

    :returns: bool
    :raises PatternTooComplex: if deciding takes too much work

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

        A state set of the other NFA needs no second visit if a subset of it has been visited: it
        accepts all that the subset accepts.

        :returns: Step whose shortest completion in the first language is such a name, or ``None``
            if there is no such name
        :raises PatternTooComplex: if deciding takes too much work
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
                    met[others] = union(simulated, others)
                fresh = self._unmet(met, positions, others)
                if fresh:
                    met[others] |= fresh
                    steps.append(Step(step, char, fresh, others))
        return None

    def _simulated(self) -> List[int]:
        """
        For each position of the other NFA, the positions that it simulates.

        Position p simulates q if p reads every character that q reads, and whatever may follow q is
        simulated by something that may follow p. The largest such relation is found by starting
        with all pairs that agree in what they read, and removing those that fail until none does.
        Where that takes too long, the relation is left empty.
        """
        follow, other_follow = self.one.follow, self.other.follow
        if len(follow) * len(other_follow) > _MOST_PAIRS:
            return [0] * len(other_follow)
        before = [0] * len(follow)
        for position, following in enumerate(follow):
            for after in numbers_in(following):
                before[after] |= 1 << position
        everything = (1 << len(follow)) - 1
        readers = {chars: sum(1 << position for position, reads in enumerate(self.one.reads)
                              if reads and not reads & ~chars) for chars in set(self.other.reads)}
        simulated = [readers[chars] for chars in self.other.reads]
        simulated[0] = 1      # among the positions that may follow, 0 is the end of a name
        round_work = len(other_follow) * (20 + len(follow) // 4) + 2 * _total_size(other_follow)
        self.spend(2 * _total_size(follow))
        while self.work + round_work < WORK_LIMIT // 2:
            self.spend(round_work)
            known = list(simulated)
            for other in range(len(simulated) - 1, 0, -1):
                able = reduce(or_, (simulated[after] for after in numbers_in(other_follow[other])))
                simulated[other] &= ~union(before, everything & ~able)
            if simulated == known:
                return simulated
        return [0] * len(other_follow)

    def _unmet(self, met: Dict[int, int], positions: int, others: int) -> int:
        """The positions that have not been visited with ``others`` or a subset of it."""
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


def _total_size(sets: List[int]) -> int:
    return sum(bin(members).count('1') for members in sets)
