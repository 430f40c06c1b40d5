"""One field of a rocon URI: a set of values, or of names."""
from __future__ import annotations

from rocon_uri.alternatives import read_alternatives
from rocon_uri.exceptions import UnregisteredValue
from rocon_uri.sources.ros_names import is_legal_base_name
from rocon_uri.vocabulary import Vocabulary, completed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import FrozenSet, Iterator, List, Optional, Tuple
    from rocon_uri.name_pattern import NamePattern

__all__ = ['Field', 'NameField', 'UnregisteredValue', 'ValuesField', 'read_values']

# All bits, which are more than any vocabulary has: `*` is larger than everything registered.
_ANY_MASK = -1
# Texts of each field that a vocabulary remembers, and characters of one. A longer text is read
# anew each time; when the memo is full it starts again with nothing.
_MEMO_SIZE = 1024
_MEMO_TEXT_LENGTH = 256


class Field:
    """
    One field of a `rocon_uri.RoconURI`, a set of values; specification, section "Definition".

    Iteration yields the alternatives as written, ``'*'`` for any.

    >>> import rocon_uri
    >>> uri = rocon_uri.parse('rocon:/pr2|kobuki/bob*/noetic/ubuntu')
    >>> uri.hardware_platform.string, uri.hardware_platform.list, list(uri.operating_system)
    ('pr2|kobuki', ['pr2', 'kobuki'], ['ubuntu'])
    >>> 'focal' in uri.operating_system, 'bob7' in uri.name, 'kobuki' in uri.hardware_platform
    (True, True, True)
    """

    __slots__ = ('_string', '_key')

    _string: str
    _key: object        # what two equal fields have in common

    @property
    def string(self) -> str:
        """The text of the field, as str: ``'pr2|kobuki'``, or ``'*'`` for any."""
        return self._string

    @property
    def list(self) -> List[str]:
        """The alternatives as written: a new list of str, ``['*']`` for any."""
        return list(self)

    @property
    def is_any(self) -> bool:
        """Is the field ``*``?"""
        return self._string == '*'

    def __iter__(self) -> Iterator[str]:
        return iter((self._string,))

    def __contains__(self, value: object) -> bool:
        raise NotImplementedError

    def expand(self) -> List[str]:
        """
        The registered values that the field matches, each group replaced by its members.

        :returns: list of str; for the name, which has no registered values, the same as ``list``

        >>> import rocon_uri
        >>> rocon_uri.parse('rocon:/phone').hardware_platform.expand()
        ['galaxy', 'mega', 'note3', 'phone_other']
        """
        return self.list

    def __setattr__(self, name: str, value: object = None) -> None:
        raise AttributeError('a field of a rocon URI cannot be changed')

    __delattr__ = __setattr__

    def __copy__(self, memo: object = None) -> 'Field':
        return self

    __deepcopy__ = __copy__

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Field):
            return NotImplemented
        return self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)

    def __str__(self) -> str:
        return self._string

    def __repr__(self) -> str:
        return '<Field %r>' % self._string


class ValuesField(Field):
    """
    A field whose values are registered; its set is a mask of bits of one vocabulary.

    :param str name: the name of the field
    :param alternatives: tuple of str, as written; ``('*',)`` for any
    :param Vocabulary vocabulary: what they are read with
    """

    __slots__ = ('field_name', 'alternatives', 'mask', 'others', 'vocabulary')

    field_name: str
    alternatives: Tuple[str, ...]
    mask: int
    others: FrozenSet[str]      # values that only an open vocabulary accepts: they have no bits
    vocabulary: Vocabulary

    def __init__(self, name: str, alternatives: Tuple[str, ...], vocabulary: Vocabulary) -> None:
        known = vocabulary.field(name)
        mask = _ANY_MASK if alternatives == ('*',) else 0
        for value in alternatives:
            if value in known:
                mask |= known.mask(value)
        others = frozenset(value for value in alternatives if value != '*' and value not in known)
        for attribute, content in (
                ('_string', '|'.join(alternatives)), ('field_name', name),
                ('alternatives', alternatives), ('mask', mask), ('others', others),
                ('vocabulary', vocabulary), ('_key', frozenset(alternatives))):
            object.__setattr__(self, attribute, content)

    def __iter__(self) -> Iterator[str]:
        return iter(self.alternatives)

    def __contains__(self, value: object) -> bool:
        if not isinstance(value, str):
            return False
        field, known = self, self.vocabulary.field(self.field_name)
        if value not in known or known.children(value):     # of others, the groups do not change
            vocabulary = completed(self.vocabulary)
            if vocabulary is not self.vocabulary:
                field = read_values(self.field_name, self._string, vocabulary)
                known = vocabulary.field(self.field_name)
        if value not in known:
            return value in self.others or self.is_any and is_legal_base_name(value)
        return not known.mask(value) & ~field.mask

    def expand(self) -> List[str]:
        vocabulary = completed(self.vocabulary)
        known = vocabulary.field(self.field_name)
        values = known if self.is_any else self.alternatives
        return list(dict.fromkeys(leaf for value in values
                                  for leaf in (known.leaves(value) if value in known else [value])))

    def intersects(self, other: 'ValuesField') -> bool:
        """Do the two sets overlap? Both are read with one vocabulary."""
        return bool(self.mask & other.mask or self.others & other.others
                    or self.is_any and other.others or other.is_any and self.others)

    def includes(self, other: 'ValuesField') -> bool:
        """Is the other a subset of this one? Both are read with one vocabulary."""
        return self.is_any or not other.mask & ~self.mask and other.others <= self.others

    def shared(self, other: 'ValuesField') -> str:
        """The intersection, as the text of a field; '' for nothing."""
        if self.is_any:
            return other.string
        if other.is_any:
            return self.string
        known = self.vocabulary.field(self.field_name)
        return '|'.join(known.covering(self.mask & other.mask)
                        + sorted(self.others & other.others))

    def __reduce__(self) -> Tuple[object, ...]:
        return _read_again, (self.field_name, self._string, self.vocabulary)


class NameField(Field):
    """
    The name: a set of ROS names, given by a literal name or a pattern.

    :param str string: the text
    :param NamePattern pattern: the set that the text denotes
    """

    __slots__ = ('pattern',)

    pattern: NamePattern

    def __init__(self, string: str, pattern: NamePattern) -> None:
        for attribute, content in ('_string', string), ('_key', string), ('pattern', pattern):
            object.__setattr__(self, attribute, content)

    def __contains__(self, value: object) -> bool:
        return isinstance(value, str) and self.pattern.matches(value)

    def intersects(self, other: 'NameField') -> bool:
        """Do the two sets of names overlap?"""
        return self.pattern.intersects(other.pattern)

    def includes(self, other: 'NameField') -> bool:
        """Is the other's set of names a subset of this one?"""
        return self.pattern.includes(other.pattern)

    def shared(self, other: 'NameField') -> str:
        """A name in both sets, '' if there is none; where one is ``*``, the text of the other."""
        if self.is_any or other.is_any:
            return self.string if other.is_any else other.string
        return self.pattern.example(other.pattern) or ''

    def __reduce__(self) -> Tuple[object, ...]:
        return NameField, (self._string, self.pattern)


def read_values(name: str, text: str, vocabulary: Vocabulary) -> ValuesField:
    """
    Read a field whose values are registered, as `rocon_uri.alternatives.read_alternatives` does.

    :returns: ValuesField
    """
    memo = vocabulary.fields_read[name]
    field: Optional[ValuesField] = memo.get(text)
    if field is None:
        field = ValuesField(name, read_alternatives(name, text, vocabulary), vocabulary)
        if len(text) <= _MEMO_TEXT_LENGTH:
            if len(memo) >= _MEMO_SIZE:
                memo.clear()
            memo[text] = field
    return field


def _read_again(name: str, text: str, vocabulary: Vocabulary) -> ValuesField:
    """A field that was pickled, with the complete vocabulary if the current one lacks a value."""
    try:
        return read_values(name, text, vocabulary)
    except UnregisteredValue:
        return read_values(name, text, completed(vocabulary))
