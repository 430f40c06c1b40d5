"""
How the sets of resources that two rocon URIs match are related, and why.

Such a set is the product of the sets that the fields and the concert match. The app is not
compared: it says what runs, not where it can run.
"""
from __future__ import annotations

from collections import namedtuple
from enum import Enum

from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.uri import RoconURI, aligned, comparable, is_compatible

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, List, Optional, Union
    Resource = Union[str, RoconURI]

__all__ = ['Explanation', 'FieldComparison', 'LEGEND', 'MARKS', 'Relation', 'UNDECIDED',
           'explain', 'is_compatible', 'relation']

#: The letters of all tables: whether something fits, None where that is too complex to say.
MARKS = {True: 'x', False: '.', None: '?'}

#: What they mean, and what is added to it where the third one can occur.
LEGEND = 'x fits, . does not'
UNDECIDED = ', ? is too complex to say'


class Relation(Enum):
    """How the sets of resources that two URIs match are related."""

    #: the two sets are the same
    EQUAL = 'equal'
    #: the first is a proper subset of the second
    SUBSET = 'subset'
    #: the first is a proper superset of the second
    SUPERSET = 'superset'
    #: the two sets overlap, and neither is a subset of the other
    OVERLAP = 'overlap'
    #: no resource is in both sets
    DISJOINT = 'disjoint'


def relation(a: Resource, b: Resource) -> Relation:
    """
    How the sets of resources that two URIs match are related.

    :param a: RoconURI, or str that is parsed
    :param b: RoconURI, or str that is parsed
    :returns: `Relation`
    :raises RoconURIValueError: for a text that is not legal
    :raises PatternTooComplex: if the two names take too much work to decide

    >>> relation('rocon:/pr2/bob_*', 'rocon:/pr2|kobuki/[a-z].*').value
    'subset'
    """
    first, second = aligned(a, b, complete=True)
    if not is_compatible(first, second):
        return Relation.DISJOINT
    pairs = [(x, y) for (_, x), (_, y) in zip(first.sets, second.sets)]
    is_subset = all(y.includes(x) for x, y in pairs)
    is_superset = all(x.includes(y) for x, y in pairs)
    if is_subset:
        return Relation.EQUAL if is_superset else Relation.SUBSET
    return Relation.SUPERSET if is_superset else Relation.OVERLAP


# Not a typing.NamedTuple: importing typing takes longer than importing the rest of the package.
class FieldComparison(namedtuple('FieldComparison', 'field a b is_compatible shared')):
    """
    What an `Explanation` says about one field.

    ``field`` is its name (str), ``a`` and ``b`` are its texts in the first and the second URI
    (str). ``is_compatible`` (bool) says whether the two sets overlap; it is None if the patterns
    are too complex to compare but another field decides. ``shared`` (str) is what both match: the
    text of a field, a name for two patterns, '' for nothing.
    """

    __slots__ = ()

    if TYPE_CHECKING:
        field: str
        a: str
        b: str
        is_compatible: Optional[bool]
        shared: str


class Explanation:
    """
    Whether two URIs are compatible, field by field; it is true if they are.

    :param RoconURI a: the first, an attribute too
    :param RoconURI b: the second, an attribute too
    """

    __slots__ = ('a', 'b', 'fields')

    def __init__(self, a: RoconURI, b: RoconURI) -> None:
        self.a = a
        self.b = b
        #: tuple of `FieldComparison`: the four fields, after the concert if both name one
        self.fields = tuple(self._comparisons())

    def __repr__(self) -> str:
        return '<Explanation: %r and %r are %s>' % (
            self.a.short, self.b.short, 'compatible' if self else 'not compatible')

    def _comparisons(self) -> List[FieldComparison]:
        compared: Dict[str, FieldComparison] = {}
        for (field, x), (_, y) in zip(self.a.sets, self.b.sets):      # the name comes last
            overlap: Optional[bool]
            try:
                overlap, shared = x.intersects(y), x.shared(y)
            except PatternTooComplex:
                if all(comparison.is_compatible for comparison in compared.values()):
                    raise
                overlap, shared = None, ''
            compared[field] = FieldComparison(field, x.string, y.string, overlap, shared)
        shown = ['hardware_platform', 'name', 'application_framework', 'operating_system']
        if self.a.concert_name or self.b.concert_name:
            shown.insert(0, 'concert_name')
        return [compared[field] for field in shown]

    @property
    def is_compatible(self) -> bool:
        """The same as `rocon_uri.is_compatible` says."""
        return all(comparison.is_compatible for comparison in self.fields)

    def __bool__(self) -> bool:
        return self.is_compatible

    def __str__(self) -> str:
        rows = [('', 'field', 'first', 'second', 'in common')]
        for field, a, b, overlap, shared in self.fields:
            example = 'e.g. ' if field == 'name' and shared not in (a, b, '') else ''
            in_common = 'too complex to say' if overlap is None else example + shared or 'nothing'
            rows.append((MARKS[overlap], field, a, b, in_common))
        widths = [max(map(len, column)) for column in zip(*rows)]
        lines = ['  '.join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip()
                 for row in rows]
        undecided = any(field.is_compatible is None for field in self.fields)
        return '\n'.join(['compatible' if self else 'not compatible', *lines,
                          LEGEND + UNDECIDED * undecided])


def explain(a: Resource, b: Resource) -> Explanation:
    """
    Why two URIs are compatible, or why they are not; it takes and raises what `relation` does.

    :returns: `Explanation`, whose text is a table of the fields, with a legend in its last line

    >>> print(explain('rocon:/kobuki/arm_*', 'rocon:/pr2/*_left/noetic'))
    not compatible
       field                  first   second  in common
    .  hardware_platform      kobuki  pr2     nothing
    x  name                   arm_*   *_left  e.g. arm_left
    x  application_framework  *       noetic  noetic
    x  operating_system       *       *       *
    x fits, . does not
    """
    return Explanation(*comparable(a, b))
