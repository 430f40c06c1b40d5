r"""
What may stand in the name field of a rocon URI: a set of ROS names.

======================  ============================================================
text                    what it admits
======================  ============================================================
``*``                   any name
``bob``                 a literal: letters, digits and ``_`` only; that name
``bob_*``, ``*_left``   a glob: these and at least one ``*``, which stands for any
                        run of them, none included
anything else           a regular expression over the whole name, in the syntax of
                        `rocon_uri.regular.syntax`
======================  ============================================================

So ``dud*`` admits ``dude``, as a glob, and ``(dud*)`` does not, as a regular expression: there the
``*`` repeats the ``d``. Patterns are the sets of the legal ROS names that they admit, of any
length; two that are written differently may be the same set.

Only a regular expression, or a shortest name in two globs, needs an automaton and the modules for
it, which are imported then.
"""
from __future__ import annotations

import re

from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.sources.wording import quoted
from rocon_uri.grammar import NAME_LIMIT
from rocon_uri.sources.ros_names import is_legal_base_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Callable, Iterable, List, Optional, Tuple
    from rocon_uri.regular.language import Language
    from rocon_uri.regular.tree import Node

__all__ = ['ANY', 'Glob', 'Literal', 'NamePattern', 'RegularExpression', 'read']

_is_literal = re.compile(r'\w+', re.ASCII).fullmatch
_is_glob = re.compile(r'[\w*]+', re.ASCII).fullmatch
_LETTERS = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ'


def read(text: str) -> NamePattern:
    """
    Read what stands in the name field.

    :param str text: the field, with nothing left of percent-escapes
    :returns: NamePattern
    :raises RoconURIValueError: if it is none of the above or admits no name; ``span`` is where in
        ``text`` the fault is

    >>> read('bob_*').matches('bob_7'), read('bob_[0-9]').matches('bob_x')
    (True, False)
    """
    if text == '*':
        return ANY
    if len(text) > NAME_LIMIT:
        raise _error(text, 'a name or name pattern has at most %d characters, this one has %d'
                     % (NAME_LIMIT, len(text)), NAME_LIMIT, len(text))
    if _is_literal(text):
        if not is_legal_base_name(text):
            raise _error(text, 'name %s is not legal: a ROS name starts with a letter'
                         % quoted(text), 0, 1)
        return Literal(text)
    if _is_glob(text):
        if text[0] != '*' and not is_legal_base_name(text[0]):
            raise _error(text, 'name pattern %s admits no name: a ROS name starts with a letter'
                         % quoted(text), 0, 1)
        return Glob(text)
    return RegularExpression(text)


def _error(text: str, problem: str, start: int, end: int) -> RoconURIValueError:
    return RoconURIValueError(problem, text, 'name', text, (start, end))


class NamePattern:
    """
    A set of ROS names; immutable.

    Made by `read`. Two are equal if their texts are; whether they are the same set is another
    question, ``a.includes(b) and b.includes(a)``. ``text`` is the pattern as written. Every name
    that it admits starts with ``prefix`` and ends with ``suffix``, each a str that is ``''`` where
    nothing is known; they may overlap.
    """

    __slots__ = ('prefix', 'suffix', 'text')

    text: str
    prefix: str
    suffix: str

    def __init__(self, text: str, prefix: str, suffix: str) -> None:
        object.__setattr__(self, 'text', text)
        object.__setattr__(self, 'prefix', prefix)
        object.__setattr__(self, 'suffix', suffix)

    @property
    def is_any(self) -> bool:
        """Is this ``*``?"""
        return False

    @property
    def literal(self) -> Optional[str]:
        """The name, if this is a literal, else ``None``."""
        return None

    def matches(self, name: str) -> bool:
        """
        Does this admit a name?

        :param str name: any text
        :returns: bool, ``False`` for what is not a legal ROS name
        """
        raise NotImplementedError

    def matches_each(self, names: Iterable[str]) -> Iterable[bool]:
        """
        `matches` for many names, which is faster than one by one.

        :param names: iterable of str
        :returns: iterable of bool, in the order of the names
        """
        return map(self.matches, names)

    def matches_in_order(self) -> Callable[[List[str]], Iterable[bool]]:
        """
        `matches` for a great many names, which come in several lists.

        :returns: callable that takes a list of legal names in alphabetical order, and returns an
            iterable of bool

        >>> list(read('[a-c].*').matches_in_order()(['alice', 'bob', 'marvin']))
        [True, True, False]
        """
        return self.matches_each

    def intersects(self, other: NamePattern) -> bool:
        """
        Is there a name that both admit?

        :param NamePattern other: another one
        :returns: bool
        :raises PatternTooComplex: if that takes too much work to decide

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
        # Between a prefix and a suffix, globs leave room for whatever the other one wants.
        if isinstance(self, Glob) and isinstance(other, Glob) or self.is_any or other.is_any:
            return True
        return self._shared_name(other) is not None

    def includes(self, other: NamePattern) -> bool:
        """
        Does this admit every name that the other one admits?

        :param NamePattern other: another one
        :returns: bool
        :raises PatternTooComplex: if that takes too much work to decide

        >>> read('dud*').includes(read('dud[a-e]+')), read('dud[a-e]+').includes(read('dud*'))
        (True, False)
        """
        if other.literal is not None:
            return self.matches(other.literal)
        if self.text == other.text:
            return True
        from rocon_uri.regular.inclusion import includes     # which only patterns need
        return includes(self._language(), other._language())

    def example(self, other: Optional[NamePattern] = None) -> Optional[str]:
        """
        A shortest name that this admits, of lower-case letters where there is such a name.

        :param NamePattern other: another pattern that has to admit it as well
        :returns: str, or ``None`` if no name is in both
        :raises PatternTooComplex: if that takes too much work to decide

        >>> read('bob_[0-9]+').example(), read('*_left').example(read('arm*'))
        ('bob_0', 'arm_left')
        """
        if other is None or other.is_any:
            return self._language().example()
        if self.is_any or other.literal is not None:
            return other.example(self)
        return self._shared_name(other)

    def _shared_name(self, other: NamePattern) -> Optional[str]:
        from rocon_uri.regular.intersection import common_name    # which only patterns need
        return common_name(self._language(), other._language())

    def _tree(self, text: str) -> Node:
        from rocon_uri.regular import tree as regular_tree      # which only patterns need
        return regular_tree.glob(text)

    def _language(self) -> Language:
        from rocon_uri.regular.language import language     # which only patterns need
        return language(self.text, self._tree)

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
    """
    One name.

    :param str text: the name, which is legal
    """

    __slots__ = ()

    def __init__(self, text: str) -> None:
        super().__init__(text, text, text)

    @property
    def literal(self) -> Optional[str]:
        return self.text

    def matches(self, name: str) -> bool:
        return name == self.text

    def includes(self, other: NamePattern) -> bool:
        return not isinstance(other, Glob) and super().includes(other)

    def example(self, other: Optional[NamePattern] = None) -> Optional[str]:
        return self.text if other is None or other.matches(self.text) else None


class Glob(NamePattern):
    """
    Name characters and ``*``, which stands for any run of name characters.

    :param str text: with at least one ``*``, and nothing before it that a name cannot start with
    """

    __slots__ = ('_between',)

    _between: List[str]

    def __init__(self, text: str) -> None:
        first, *between, last = text.split('*')
        super().__init__(text, first, last)
        object.__setattr__(self, '_between', between)

    @property
    def is_any(self) -> bool:
        return self.text == '*'

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
            # A letter that is nowhere here can only be admitted by a star, so that it stands for
            # whatever is in the place of the other one's stars.
            for letter in _LETTERS:
                if letter not in self.text:
                    return self.matches(other.text.replace('*', letter))
        return super().includes(other)


class RegularExpression(NamePattern):
    """
    A regular expression over the whole name.

    :param str text: the expression
    :raises RoconURIValueError: as `read` does
    """

    __slots__ = ('_remembered',)

    _remembered: Callable[[], Optional[Language]]

    def __init__(self, text: str) -> None:
        from rocon_uri.regular.tree import literal_ends     # which only patterns need
        super().__init__(text, *literal_ends(self._tree(text)))
        object.__setattr__(self, '_remembered', _nothing)

    def matches(self, name: str) -> bool:
        return (self._remembered() or self._language()).matches(name)

    def matches_each(self, names: Iterable[str]) -> Iterable[bool]:
        return map(self._language().matches, names)

    def matches_in_order(self) -> Callable[[List[str]], Iterable[bool]]:
        from rocon_uri.regular.sorted_walk import SortedWalk     # which only many names need
        return SortedWalk(self._language()).matches

    def _tree(self, text: str) -> Node:
        from rocon_uri.regular.syntax import parse      # which only patterns need
        return parse(text)

    def _language(self) -> Language:
        found = self._remembered()
        if found is None:
            from weakref import ref     # which only patterns need
            found = super()._language()
            object.__setattr__(self, '_remembered', ref(found))
        return found


def _nothing() -> None:
    return None


ANY: NamePattern = Glob('*')
