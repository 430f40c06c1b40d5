"""Do two regular languages intersect, and in which shortest name?"""
from __future__ import annotations

from rocon_uri.regular.budget import Budget
from rocon_uri.regular.language import BEGIN, Language, Step
from rocon_uri.regular.product import Product, numbers_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, Optional

__all__ = ['Intersection', 'common_name']


def common_name(one: Language, other: Language, budget: Optional[Budget] = None) -> Optional[str]:
    """
    A shortest name that two languages have in common.

    :param Budget budget: the work that this may take; `WORK_LIMIT` where it is left out
    :returns: str, or ``None`` if there is none
    :raises PatternTooComplex: if deciding takes too much work

    >>> from rocon_uri.regular.syntax import parse
    >>> common_name(Language('', parse('[a-e]+')), Language('', parse('.*[d-z]{2}')))
    'dd'
    """
    if (one.tree.size, one.text) < (other.tree.size, other.text):
        one, other = other, one
    budget = budget or Budget()
    product = Intersection(one, other, budget.limit)
    try:
        found = product.shortest()
    finally:
        # to make the two languages takes about 8 units of time for each position
        budget.spent += product.work + 8 * (one.tree.size + other.tree.size)
    return None if found is None else found.text()


class Intersection(Product):
    """The product of two NFAs, searched for a name that both accept."""

    def shortest(self) -> Optional[Step]:
        """
        Find a shortest name in both languages.

        The positions of the other language are followed one by one: a pair of positions needs no
        second visit, and there are only as many pairs as the product of the two sizes.

        :returns: Step, the last one of the name, or ``None`` if there is no such name
        :raises PatternTooComplex: if deciding takes too much work
        """
        met: Dict[int, int] = {}
        steps = [Step(None, '', BEGIN, BEGIN)]
        for step in steps:
            for char, positions, others in self.successors(step):
                if positions & self.one.last and others & self.other.last:
                    return Step(step, char, positions, others)
                for other in numbers_in(others):
                    self.spend(6 + self.cost)
                    known = met.get(other, 0)
                    fresh = positions & ~known
                    if fresh:
                        self.spend(6 + self.cost)
                        met[other] = known | fresh
                        steps.append(Step(step, char, fresh, 1 << other))
        return None
