"""Name patterns as the databases match them."""
from __future__ import annotations

from rocon_uri.name_pattern import Glob, NamePattern
from rocon_uri.regular.postgresql import expression
from rocon_uri.regular.syntax import parse

__all__ = ['after_names', 'in_postgresql', 'is_left_to_database', 'is_too_large', 'like']

#: atoms of an expression, once counted repetition is written out: of those with more PostgreSQL
#: takes up to 4.6 s to compile one
_ATOMS_LIMIT = 256


def is_too_large(pattern: NamePattern) -> bool:
    """
    Is this a regular expression that is not left to a database?

    :param NamePattern pattern: any
    :returns: bool
    """
    return pattern.literal is None and not isinstance(pattern, Glob) \
        and parse(pattern.text).size > _ATOMS_LIMIT


def is_left_to_database(pattern: NamePattern) -> bool:
    """
    Does a database look at each name, because prefix and suffix do not decide?

    :param NamePattern pattern: any
    :returns: bool, False too for an expression that is too large
    """
    if pattern.literal is not None:
        return False
    return pattern.text not in (pattern.prefix + '*', '*' + pattern.suffix) \
        and not is_too_large(pattern)


def in_postgresql(pattern: NamePattern) -> str:
    """
    A regular expression as PostgreSQL writes it.

    :param NamePattern pattern: a regular expression
    :returns: str
    """
    return expression(parse(pattern.text))


def like(glob: str) -> str:
    """
    A glob as LIKE writes it, with ``!`` as escape character.

    :param str glob: the text
    :returns: str

    >>> like('bob_*')
    'bob!_%'
    """
    return glob.replace('_', '!_').replace('*', '%')


def after_names(prefix: str) -> str:
    """
    The least text that comes after all names with this prefix, in the order of ASCII.

    :param str prefix: name characters, at least one
    :returns: str

    >>> after_names('bob_')
    'bob`'
    """
    return prefix[:-1] + chr(ord(prefix[-1]) + 1)
