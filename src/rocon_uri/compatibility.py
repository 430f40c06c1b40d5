"""
Two rocon URIs side by side: do they meet, how do they lie to each other, and why?

A URI stands for a set of resources, the product of what its fields and its concert stand for; the
app says what runs, not where it can run, and takes no part.
"""
from __future__ import annotations

from collections import namedtuple
from enum import Enum

from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.field import UnregisteredValue
from rocon_uri.name_pattern import ANY
from rocon_uri.uri import RoconURI, aligned, parse
from rocon_uri.vocabulary import Vocabulary

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, List, Optional, Tuple, Union
    Resource = Union[str, RoconURI]

__all__ = ['Explanation', 'FieldComparison', 'Relation', 'explain', 'is_compatible', 'relation']


class Relation(Enum):
    """How the resources that one URI stands for lie to those of another."""

    #: both stand for the same resources
    EQUAL = 'equal'
    #: the second stands for all that the first stands for, and more
    SUBSET = 'subset'
    #: the first stands for all that the second stands for, and more
    SUPERSET = 'superset'
    #: they have resources in common, and each has others too
    OVERLAP = 'overlap'
    #: they have none in common
    DISJOINT = 'disjoint'


def is_compatible(a: Resource, b: Resource) -> bool:
    """
    Is there a resource that both stand for; can this app run on this robot?

    Where the four fields of one are all ``*``, the other may have values that are not registered.

    :param a: RoconURI, or str that is parsed
    :param b: RoconURI, or str that is parsed
    :returns: bool; the same for (b, a)
    :raises RoconURIValueError: for a text that is not legal
    :raises PatternTooComplex: if the two names take too much work to decide

    >>> is_compatible('rocon:/kobuki|turtlebot2', 'rocon:/kobuki/bob/noetic/bookworm')
    True
    """
    if type(a) is not RoconURI or type(b) is not RoconURI or a._vocabulary is not b._vocabulary:
        a, b = _comparable(a, b)
    # The slots themselves, since by way of the properties this would take twice the time.
    if not (a._hardware_platform.mask & b._hardware_platform.mask
            and a._application_framework.mask & b._application_framework.mask
            and a._operating_system.mask & b._operating_system.mask):
        # values that only an open vocabulary admits have no bits
        return a._vocabulary.is_open and not a.isdisjoint(b)
    if a._concert_name and b._concert_name and a._concert_name != b._concert_name:
        return False
    if a._pattern is None:
        return (a._name == b._name if b._pattern is None
                else b._pattern is ANY or b._pattern.matches(a._name))
    if a._pattern is ANY or b._pattern is ANY:      # most requests leave the name open
        return True
    return a._pattern.matches(b._name) if b._pattern is None else a._pattern.intersects(b._pattern)


def _comparable(a: Resource, b: Resource) -> Tuple[RoconURI, RoconURI]:
    """Both as one vocabulary reads them: an open one if one is unregistered and one is any."""
    try:
        first, second = parse(a), parse(b)
        if first._vocabulary is second._vocabulary:
            return first, second
        return aligned(first, second)
    except UnregisteredValue:
        any_value = Vocabulary.open()
        first, second = parse(a, any_value), parse(b, any_value)
        if _is_any(first) or _is_any(second):
            return first, second
        raise


def _is_any(uri: RoconURI) -> bool:
    return (uri.hardware_platform.is_any and uri.name.is_any
            and uri.application_framework.is_any and uri.operating_system.is_any)


def relation(a: Resource, b: Resource) -> Relation:
    """
    How the first lies to the second, as sets of resources.

    :param a: RoconURI, or str that is parsed
    :param b: RoconURI, or str that is parsed
    :returns: `Relation`
    :raises RoconURIValueError: for a text that is not legal
    :raises PatternTooComplex: if the two names take too much work to decide

    >>> relation('rocon:/pr2/bob_*', 'rocon:/pr2|kobuki/[a-z].*').value
    'subset'
    """
    first, second = aligned(a, b, complete=True)
    pairs = [(x, y) for (_, x), (_, y) in zip(first.sets, second.sets)]
    if not all(x.intersects(y) for x, y in pairs):
        return Relation.DISJOINT
    is_subset = all(y.includes(x) for x, y in pairs)
    is_superset = all(x.includes(y) for x, y in pairs)
    if is_subset:
        return Relation.EQUAL if is_superset else Relation.SUBSET
    return Relation.SUPERSET if is_superset else Relation.OVERLAP


#: What an `Explanation` says of one field: its name, the text of each side (str), whether they
#: meet (bool; None where another field decides and the patterns are too complex), and what they
#: share (str: the text of a field, for two patterns a name that both admit, '' for nothing).
FieldComparison = namedtuple('FieldComparison', 'field a b is_compatible shared')


class Explanation:
    """
    Whether two URIs are compatible, field by field; true if they are.

    :param RoconURI a: the first
    :param RoconURI b: the second

    ``a`` and ``b`` are attributes too.
    """

    __slots__ = ('a', 'b', 'fields')

    def __init__(self, a: RoconURI, b: RoconURI) -> None:
        self.a = a
        self.b = b
        #: tuple of `FieldComparison`: the four fields, after the concert if both name one
        self.fields = tuple(self._comparisons())

    def _comparisons(self) -> List[FieldComparison]:
        compared: Dict[str, FieldComparison] = {}
        for (field, x), (_, y) in zip(self.a.sets, self.b.sets):      # the name comes last
            meets: Optional[bool]
            try:
                meets, shared = x.intersects(y), x.shared(y)
            except PatternTooComplex:
                if all(comparison.is_compatible for comparison in compared.values()):
                    raise
                meets, shared = None, ''
            compared[field] = FieldComparison(field, x.string, y.string, meets, shared)
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
        for field, a, b, meets, shared in self.fields:
            example = 'e.g. ' if field == 'name' and shared not in (a, b, '') else ''
            in_common = 'too complex to say' if meets is None else example + shared or 'nothing'
            rows.append(('x' if meets is False else '', field, a, b, in_common))
        widths = [max(map(len, column)) for column in zip(*rows)]
        lines = ['  '.join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip()
                 for row in rows]
        return '\n'.join(['compatible' if self else 'not compatible'] + lines)


def explain(a: Resource, b: Resource) -> Explanation:
    """
    Why two URIs are compatible, or are not.

    :param a: RoconURI, or str that is parsed
    :param b: RoconURI, or str that is parsed
    :returns: `Explanation`, whose text is a table of the fields
    :raises RoconURIValueError: for a text that is not legal
    :raises PatternTooComplex: if the two names take too much work to decide

    >>> print(explain('rocon:/kobuki/arm_*', 'rocon:/pr2/*_left/noetic'))
    not compatible
       field                  first   second  in common
    x  hardware_platform      kobuki  pr2     nothing
       name                   arm_*   *_left  e.g. arm_left
       application_framework  *       noetic  noetic
       operating_system       *       *       *
    """
    return Explanation(*_comparable(a, b))
