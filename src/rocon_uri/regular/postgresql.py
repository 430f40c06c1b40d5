r"""
A syntax tree as a regular expression of PostgreSQL.

There ``\w`` matches é, a range goes by the collation and counts end at 255; so the characters of
every class are written out, and larger counts as several.
"""
from __future__ import annotations

from typing import List, Optional, Tuple, cast

from rocon_uri.regular.tree import ALPHABET, Node

__all__ = ['expression']

_MOST = 255     # PostgreSQL's DUPMAX
_Key = Tuple[object, ...]


def expression(tree: Node) -> str:
    """
    The expression that matches the whole of what a tree matches.

    :param Node tree: the tree, of few positions: PostgreSQL takes seconds to compile some that are
        large
    :returns: str, in PostgreSQL's advanced syntax

    >>> from rocon_uri.regular.syntax import parse
    >>> expression(parse('(a{200}){2}|b_[a-c]?'.join('()')))
    '^(?:a{255,255}a{145,145}|b_[abc]?)$'
    """
    return '^%s$' % _part(tree.key)


def _written(key: _Key) -> str:
    kind, *parts = key
    if kind == 'characters':
        chars = cast(int, parts[0])
        members = ''.join(char for bit, char in enumerate(ALPHABET) if chars >> bit & 1)
        return members if len(members) == 1 else '[%s]' % members
    if kind == 'sequence':
        return ''.join(map(_part, cast(List[_Key], parts)))
    if kind == 'choice':
        return '|'.join(map(_written, cast(List[_Key], parts)))
    item, least, most = cast(Tuple[_Key, int, Optional[int]], tuple(parts))
    single = _written(item) if item[0] == 'characters' else _group(item)
    return ''.join(single + count for count in _counts(least, most))


def _part(key: _Key) -> str:
    """What may stand beside others."""
    return _group(key) if key[0] == 'choice' else _written(key)


def _group(key: _Key) -> str:
    return '(?:%s)' % _written(key)


def _counts(least: int, most: Optional[int]) -> List[str]:
    """The quantifiers that together repeat so often."""
    short = {(0, None): '*', (1, None): '+', (0, 1): '?'}
    if (least, most) in short:
        return [short[least, most]]
    counts = []
    while least > _MOST or most is not None and most > _MOST:
        once = min(least, _MOST)
        upper = once if most is None else min(most, _MOST)
        counts.append('{%d,%d}' % (once, upper))
        least -= once
        most = None if most is None else most - upper
    return counts + ['{%d,%s}' % (least, '' if most is None else most)]
