r"""
The name field of a rocon URI, which denotes a set of legal ROS names.

======================  ============================================================
text                    the names that it matches
======================  ============================================================
``*``                   any name
``bob``                 a literal, only letters, digits and ``_``: that name
``bob_*``, ``*_left``   a glob, the same with at least one ``*``, which stands for any
                        run of these characters, the empty one too
anything else           a regular expression over the whole name, in the syntax of
                        `rocon_uri.regular.syntax`
======================  ============================================================

So ``dud*`` is a glob and matches ``dude``; ``(dud*)`` is a regular expression and does not: its
``*`` repeats the ``d``. Two patterns with different texts may denote the same set.

Automata are imported only for a regular expression or for a shortest name in two globs.
"""
from __future__ import annotations

import re
from functools import partial

from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.sources.wording import quoted
from rocon_uri.grammar import NAME_LIMIT
from rocon_uri.sources.ros_names import is_legal_base_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Callable, Iterable, List, Optional, Tuple
    from rocon_uri.regular.budget import Budget
    from rocon_uri.regular.language import Language

__all__ = ['ANY', 'Glob', 'Literal', 'NamePattern', 'RegularExpression', 'read']

_is_glob = re.compile(r'[\w*]+', re.ASCII).fullmatch
_LETTERS = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ'


def read(text: str) -> NamePattern:
    """
    Read the text of a name field.

    :param str text: the text, with percent-escapes decoded
    :returns: NamePattern
    :raises RoconURIValueError: if it has none of the forms above or matches no name; ``span`` is
        where in ``text`` the fault is

    >>> read('bob_*').matches('bob_7'), read('bob_[0-9]').matches('bob_x')
    (True, False)
    """
    if text == '*':
        return ANY
    if len(text) > NAME_LIMIT:
        raise _error(text, 'a name or name pattern has at most %d characters, this one has %d'
                     % (NAME_LIMIT, len(text)), NAME_LIMIT, len(text))
    if not _is_glob(text):
        return RegularExpression(text)
    is_literal = '*' not in text
    if text[0] != '*' and not is_legal_base_name(text[0]):
        raise _error(text, '%s: a ROS name starts with a letter' % (
            'name %s is not legal' if is_literal else 'name pattern %s admits no name')
            % quoted(text), 0, 1)
    return Literal(text) if is_literal else Glob(text)


def _error(text: str, problem: str, start: int, end: int) -> RoconURIValueError:
    return RoconURIValueError(problem, text, 'name', text, (start, end))


class NamePattern:
    """
    A set of ROS names, made by `read`; immutable.

    Two are equal if their texts are; ``a.includes(b) and b.includes(a)`` says whether they denote
    the same set.
    """

    __slots__ = ('prefix', 'suffix', 'text')

    text: str       # as written
    prefix: str     # of every name in the set; '' if unknown
    suffix: str     # the same; it may overlap with the prefix

    def __init__(self, text: str, prefix: str, suffix: str) -> None:
        object.__setattr__(self, 'text', text)
        object.__setattr__(self, 'prefix', prefix)
        object.__setattr__(self, 'suffix', suffix)

    @property
    def is_any(self) -> bool:
        """Is this ``*``?"""
        return self.text == '*'

    @property
    def literal(self) -> Optional[str]:
        """The name if this is a literal, else ``None``."""
        return self.text if isinstance(self, Literal) else None

    def matches(self, name: str) -> bool:
        """
        Is a name in the set?

        :param str name: any text
        :returns: bool, ``False`` if the text is not a legal ROS name
        """
        raise NotImplementedError

    def matches_in_order(self) -> Callable[[List[str]], Iterable[bool]]:
        """
        `matches` for long lists of names, faster than one by one.

        :returns: function from a list of legal names in alphabetical order to an iterable of bool

        >>> list(read('[a-c].*').matches_in_order()(['alice', 'bob', 'marvin']))
        [True, True, False]
        """
        return partial(map, self.matches)

    def intersects(self, other: NamePattern, budget: Optional[Budget] = None) -> bool:
        """
        Do the two sets overlap?

        :param Budget budget: the work that this may take; `WORK_LIMIT` where it is left out
        :returns: bool
        :raises PatternTooComplex: if deciding takes too much work

        >>> read('dud*').intersects(read('[a-z]+'))
        True
        """
        longer, shorter = sorted((self.prefix, other.prefix), key=len, reverse=True)
        ending, end = sorted((self.suffix, other.suffix), key=len, reverse=True)
        if not longer.startswith(shorter) or not ending.endswith(end):
            return False
        if self.literal is not None:
            return other.matches(self.literal)
        if other.literal is not None:
            return self.matches(other.literal)
        if self.text == other.text:
            return True
        # Between prefix and suffix a glob has a star, into which the rest of the other one fits.
        if isinstance(self, Glob) and isinstance(other, Glob) or self.is_any or other.is_any:
            return True
        return self._common_name(other, budget) is not None

    def includes(self, other: NamePattern) -> bool:
        """
        Is the other set a subset of this one?

        :returns: bool
        :raises PatternTooComplex: if deciding takes too much work

        >>> read('dud*').includes(read('dud[a-e]+')), read('dud[a-e]+').includes(read('dud*'))
        (True, False)
        """
        if other.literal is not None:
            return self.matches(other.literal)
        if self.text == other.text:
            return True
        from rocon_uri.regular.inclusion import includes
        return includes(self._language(), other._language())

    def example(self, other: Optional[NamePattern] = None) -> Optional[str]:
        """
        A shortest name in the set, of lower-case letters if there is such a name.

        :param NamePattern other: another pattern, whose set has to have the name too
        :returns: str, or ``None`` if no name is in both sets
        :raises PatternTooComplex: if deciding takes too much work

        >>> read('bob_[0-9]+').example(), read('*_left').example(read('arm*'))
        ('bob_0', 'arm_left')
        """
        if other is None or other.is_any:
            return self._language().example()
        if self.is_any or other.literal is not None:
            return other.example(self)
        return self._common_name(other)

    def _common_name(self, other: NamePattern, budget: Optional[Budget] = None) -> Optional[str]:
        from rocon_uri.regular.budget import too_complex
        from rocon_uri.regular.intersection import common_name
        if budget is not None and budget.limit <= 0:        # before automata are made
            raise too_complex(self.text, other.text)
        return common_name(self._language(), other._language(), budget)

    def _language(self) -> Language:
        from rocon_uri.regular.language import language
        from rocon_uri.regular.tree import glob
        return language(self.text, glob)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError('a name pattern cannot be changed')

    def __eq__(self, other: object) -> bool:
        return self.text == other.text if isinstance(other, NamePattern) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.text)

    def __repr__(self) -> str:
        return '%s(%r)' % (type(self).__name__, self.text)

    def __reduce__(self) -> Tuple[Any, ...]:
        return read, (self.text,)


class Literal(NamePattern):
    """One legal name."""

    __slots__ = ()

    def __init__(self, text: str) -> None:
        super().__init__(text, text, text)

    def matches(self, name: str) -> bool:
        return name == self.text

    def includes(self, other: NamePattern) -> bool:
        return not isinstance(other, Glob) and super().includes(other)

    def example(self, other: Optional[NamePattern] = None) -> Optional[str]:
        return self.text if other is None or other.matches(self.text) else None


class Glob(NamePattern):
    """
    Name characters and ``*``, which stands for any run of name characters.

    :param str text: the glob, with at least one ``*``; its first character is ``*`` or a letter
    """

    __slots__ = ('_between',)

    _between: List[str]

    def __init__(self, text: str) -> None:
        first, *between, last = text.split('*')
        super().__init__(text, first, last)
        object.__setattr__(self, '_between', between)

    def matches(self, name: str) -> bool:
        if not name.startswith(self.prefix) or not name.endswith(self.suffix) \
                or not is_legal_base_name(name):
            return False
        at, end = len(self.prefix), len(name) - len(self.suffix)
        for part in self._between:
            found = name.find(part, at, end)
            if found < 0:
                return False
            at = found + len(part)
        return at <= end

    def includes(self, other: NamePattern) -> bool:
        if not self.suffix and not any(self._between) and other.prefix.startswith(self.prefix):
            return True
        if isinstance(other, Glob):
            # A letter that is not in this glob can only be matched by a star of it, so it can
            # stand for any text in the place of the other one's stars.
            for letter in _LETTERS:
                if letter not in self.text:
                    return self.matches(other.text.replace('*', letter))
        return super().includes(other)


class RegularExpression(NamePattern):
    """
    A regular expression over the whole name.

    :param str text: the expression
    :raises RoconURIValueError: as described under `read`
    """

    __slots__ = ('_remembered',)

    _remembered: Callable[[], Optional[Language]]

    def __init__(self, text: str) -> None:
        from rocon_uri.regular.syntax import parse
        from rocon_uri.regular.tree import literal_ends
        super().__init__(text, *literal_ends(parse(text)))
        object.__setattr__(self, '_remembered', lambda: None)

    def matches(self, name: str) -> bool:
        return (self._remembered() or self._language()).matches(name)

    def matches_in_order(self) -> Callable[[List[str]], Iterable[bool]]:
        from rocon_uri.regular.sorted_walk import SortedWalk
        return SortedWalk(self._language()).matches

    def _language(self) -> Language:
        found = self._remembered()
        if found is None:
            from weakref import ref
            from rocon_uri.regular.language import language
            from rocon_uri.regular.syntax import parse
            found = language(self.text, parse)
            object.__setattr__(self, '_remembered', ref(found))
        return found


ANY: NamePattern = Glob('*')
