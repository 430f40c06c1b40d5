"""
The values that one field of a rocon URI may have, and the groups that they form.

A group covers its members, at every depth.
"""
from __future__ import annotations

from itertools import accumulate

from rocon_uri.sources.wording import quoted, shown
from rocon_uri.grammar import NAME_LIMIT
from rocon_uri.sources.ros_names import is_legal_base_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, Iterator, List, Mapping, Optional, Tuple
    Member = Tuple[object, object, Tuple[object, ...]]      # name, rules below it, path

__all__ = ['FieldVocabulary', 'RulesError', 'add_rules', 'members']


class RulesError(ValueError):
    """
    Rules that do not fit: a name that is not legal, or one in two groups of one field.

    :param str problem: what is wrong, an attribute too
    :param path: tuple of the keys and indices that lead to it in the rules, an attribute too
    """

    def __init__(self, problem: str, path: Tuple[object, ...] = ()) -> None:
        super().__init__(problem)
        self.problem = problem
        self.path = path


def members(rules: object, path: Tuple[object, ...] = ()) -> Iterator[Member]:
    """
    The names directly below a group of rules, whichever way it is written.

    :param rules: a mapping from a name to the rules below it, a list of names and mappings, a
        single name, or None for nothing
    :param path: where the rules are, for errors
    :returns: iterator of (name, rules below it, path)

    >>> [name for name, below, path in members({'a': None, 'b': ['c']})]
    ['a', 'b']
    """
    if isinstance(rules, dict):
        for name, below in rules.items():
            yield name, below, path + (name,)
    elif isinstance(rules, list):
        for index, item in enumerate(rules):
            if isinstance(item, list):
                raise RulesError('a list stands where a value or a group belongs', path + (index,))
            if isinstance(item, str):       # as most are
                yield item, None, path + (index,)
            else:
                yield from members(item, path + (index,))
    elif rules is not None:
        yield rules, None, path


class FieldVocabulary:
    """
    The values and groups of one field.

    :param str name: one of `rocon_uri.grammar.VOCABULARY_FIELDS`
    :param parents: mapping from each value and group, in order, to its group, or to None
    """

    __slots__ = ('name', 'parents', '_children', '_leaves', '_bits')

    def __init__(self, name: str, parents: Mapping[str, Optional[str]]) -> None:
        self.name = name
        #: the group of each value and group, or None
        self.parents = dict(parents)
        self._children: Dict[Optional[str], List[str]] = {None: []}
        for value, parent in self.parents.items():
            self._children.setdefault(parent, []).append(value)
        # Leaves are numbered in depth, so that the bits of a group follow one another. Its bits are
        # the first one and the one after the last.
        self._leaves: List[str] = []
        self._bits: Dict[str, Tuple[int, int]] = {}
        values = list(self)
        for value in values:
            self._bits[value] = len(self._leaves), len(self._leaves) + 1
            if value not in self._children:
                self._leaves.append(value)
        for value in reversed(values):      # members before their group
            if value in self._children:
                self._bits[value] = (self._bits[value][0],
                                     self._bits[self._children[value][-1]][1])

    def __contains__(self, value: object) -> bool:
        return value in self.parents

    def __iter__(self) -> Iterator[str]:
        """All values and groups, a group before its members."""
        waiting = self._children[None][::-1]
        while waiting:
            below = waiting.pop()
            yield below
            waiting.extend(reversed(self._children.get(below, ())))

    def children(self, group: Optional[str] = None) -> List[str]:
        """
        The members directly in a group, or at the top.

        :param group: str, or None for the top
        :returns: list of str; empty for a value that is not a group

        >>> from rocon_uri import Vocabulary
        >>> Vocabulary.bundled().field('hardware_platform').children('mobile_device')
        ['phone', 'tablet']
        """
        return list(self._children.get(group, ()))

    def leaves(self, value: str) -> List[str]:
        """
        The values that a group covers, at every depth; a value covers itself.

        :param str value: a registered value or group
        :returns: list of str, in the order of the vocabulary
        :raises KeyError: if it is not registered
        """
        first, end = self._bits[value]
        return self._leaves[first:end]

    def mask(self, value: str) -> int:
        """
        The `leaves` of a value or group as a set of bits, an int.

        :raises KeyError: if it is not registered
        """
        first, end = self._bits[value]
        return (1 << end) - (1 << first)

    def covering(self, mask: int) -> List[str]:
        """
        The fewest values and groups that cover exactly the values of a `mask`, a list of str.

        >>> from rocon_uri import Vocabulary
        >>> systems = Vocabulary.bundled().field('operating_system')
        >>> systems.covering(systems.mask('ubuntu') & systems.mask('linux'))
        ['ubuntu']
        """
        digits = format(mask, 'b')[::-1].ljust(len(self._leaves), '0')
        counts = list(accumulate(map(int, digits), initial=0))      # of bits set below each bit
        found: List[str] = []
        waiting = self._children[None][::-1]
        while waiting:
            value = waiting.pop()
            first, end = self._bits[value]
            count = counts[end] - counts[first]
            if count == end - first:
                found.append(value)
            elif count:
                waiting.extend(reversed(self._children[value]))
        return found

    def extended(self, rules: object, path: Tuple[object, ...] = ()) -> 'FieldVocabulary':
        """
        This vocabulary with more values and groups.

        :param rules: as ``members`` takes; a name that is known is the group that exists
        :param path: where the rules are, for errors
        :returns: FieldVocabulary
        :raises RulesError: for a name that is not a ROS base name, or is in two groups
        """
        added: Dict[str, Optional[str]] = {}
        add_rules(self.name, self.parents, added, rules, path)
        return self.with_added(added)

    def with_added(self, added: Mapping[str, Optional[str]]) -> 'FieldVocabulary':
        """This vocabulary with what ``add_rules`` has added."""
        return FieldVocabulary(self.name, {**self.parents, **added}) if added else self


def add_rules(field: str, known: Mapping[str, Optional[str]], added: Dict[str, Optional[str]],
              rules: object, path: Tuple[object, ...]) -> None:
    """
    Add the values and groups of rules that are not known. Its errors are those of `extended`.

    :param str field: whose they are
    :param known: mapping from each value and group that is known to its group, or to None
    :param added: dict of the same form, which gets the others
    """
    # Depth first, in the order of the rules: the group of a group is known before its members.
    waiting: List[Tuple[Optional[str], Member]] = [(None, entry) for entry in members(rules, path)]
    waiting.reverse()
    while waiting:
        parent, (given, below, place) = waiting.pop()
        name = _checked_name(field, given, place)
        group = known[name] if name in known else added.setdefault(name, parent)
        if parent is not None and group != parent:
            raise RulesError("%s '%s' cannot be in '%s', since it is already %s" % (
                field, name, parent,
                "in '%s'" % group if group else 'at the top, in no group'), place)
        if below is not None:
            waiting += [(name, entry) for entry in members(below, place)][::-1]


def _checked_name(field: str, name: object, path: Tuple[object, ...]) -> str:
    if not isinstance(name, str):
        raise RulesError('a value of %s is %s, expected text%s' % (
            field, shown(name), '' if name is None else ' (in quotes)'), path)
    if not is_legal_base_name(name) or len(name) > NAME_LIMIT:
        raise RulesError('%s %s is not a ROS base name (a letter, then letters, digits and _)'
                         % (field, quoted(name)), path)
    return name
