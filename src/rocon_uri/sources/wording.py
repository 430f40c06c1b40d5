"""How a text is shown in an error, and what was probably meant by it."""
from __future__ import annotations

import re

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Collection, Dict, Iterable, List, Sequence

__all__ = ['NamesByPart', 'NearMisses', 'cannot_be_read', 'carets', 'did_you_mean', 'expectation',
           'near_misses', 'near_parts', 'near_values', 'printable', 'quoted', 'quoted_path',
           'shown', 'with_article']

_QUOTED_LENGTH = 80     # characters of the offending text that a line shows
_FEW_NAMES = 500        # of which each is compared, at about 20 us
_MAX_COMPARED = 20000   # names, which takes up to 1.2 s
_NEAR_LENGTH = 64       # characters: a longer text is not a typing error, and would take long


def quoted(text: str) -> str:
    """
    A text as an error shows it: in single quotes, on one line, and shortened if it is long.

    >>> print(quoted('a' * 100 + chr(10)), quoted(chr(10)))
    'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa...' '\\n'
    """
    if len(text) > _QUOTED_LENGTH:
        text = text[:_QUOTED_LENGTH - 3] + '...'
    return "'%s'" % printable(text)


def quoted_path(path: str) -> str:
    """The path of a file as an error shows it: in single quotes, on one line, and whole."""
    return "'%s'" % printable(path)


def printable(text: str) -> str:
    """
    A text on one line, in which characters that cannot be printed are escaped.

    >>> print(printable('a' + chr(10) + 'b'))
    a\\nb
    """
    return ''.join(c if c.isprintable() else repr(c)[1:-1] for c in text)


def cannot_be_read(error: OSError) -> str:
    """
    What an error says of the file or folder that it is about.

    >>> cannot_be_read(PermissionError(13, 'Permission denied', '/root'))
    'cannot be read: Permission denied'
    """
    return 'cannot be read: %s' % (error.strerror or error)


def carets(before: str, marked: str) -> str:
    """
    The line below a text that marks what comes after the first part of it.

    A terminal shows some characters, as those of Chinese, two columns wide, and accents with none.

    >>> print(carets('rocon:/', 'pr3')), print(carets('\u8e0a: ', 'icon'))
           ^^^
        ^^^^
    (None, None)
    """
    return ' ' * _columns(before) + '^' * max(1, _columns(marked))


def _columns(text: str) -> int:
    if text.isascii():
        return len(text)
    from unicodedata import combining, east_asian_width     # here, since few texts need it
    return sum(0 if combining(c) else 2 if east_asian_width(c) in 'FW' else 1 for c in text)


def near_misses(text: str, candidates: Iterable[str]) -> List[str]:
    """
    The candidates that somebody probably meant by a text: at most three, the likeliest first.

    >>> near_misses('turtelbot2', ['kobuki', 'turtlebot', 'turtlebot2'])
    ['turtlebot2', 'turtlebot']
    >>> near_misses('Bell', ['bellboy/Base', 'bellboy/Bell'])
    ['bellboy/Bell']
    """
    if len(text) > _NEAR_LENGTH:
        return []
    import difflib      # here, since only an error that is shown needs it
    by_lower = {candidate.lower(): candidate for candidate in sorted(candidates)}
    found = difflib.get_close_matches(text.lower(), by_lower, n=3, cutoff=0.7)
    whole = [name for name in by_lower if name.endswith('/' + text.lower())]    # of a package
    return [by_lower[name] for name in found or whole[:3]]


class NearMisses:
    """
    The near misses of many texts, none after so many comparisons that they would take long.

    :param int limit: how many names are compared with texts in all, at up to 60 us each

    >>> NearMisses().of('turtelbot2', ['kobuki', 'turtlebot2'])
    ['turtlebot2']
    """

    def __init__(self, limit: int = _MAX_COMPARED) -> None:
        self._left = limit

    def among(self, names: Collection[str]) -> Collection[str]:
        """The names, to compare one text with later; none if there were too many."""
        self._left -= len(names)
        return names if self._left >= 0 else ()

    def of(self, text: str, names: Collection[str]) -> List[str]:
        """The `near_misses` of a text among names."""
        return near_misses(text, self.among(names))


class NamesByPart:
    """
    Names, ``package/name``, to look for the near misses of many names in.

    :param names: iterable of str

    >>> names = NamesByPart(['ours/Camera', 'theirs/Base'])
    >>> 'ours/Camra' in names, names.near_misses('ours/Camra')
    (False, ['ours/Camera'])
    """

    def __init__(self, names: Iterable[str]) -> None:
        self._names = dict.fromkeys(names)
        self._by_part: Dict[str, List[str]] = {}    # once it is needed
        self._near_misses = NearMisses()

    def __contains__(self, name: str) -> bool:
        return name in self._names

    def like(self, name: str) -> List[str]:
        """
        The names to compare one with: where there are many, those that share a part with it.

        The list is not to be changed.
        """
        return list(self._names) if len(self._names) <= _FEW_NAMES else self._sharing_a_part(name)

    def near_misses(self, name: str) -> List[str]:
        """The `near_misses` among those that share a part with one; none after many comparisons."""
        return self._near_misses.of(name, self._sharing_a_part(name))

    def _sharing_a_part(self, name: str) -> List[str]:
        if not self._by_part:
            for other in self._names:
                for part in _parts(other):
                    self._by_part.setdefault(part, []).append(other)
        return [other for part in _parts(name) for other in self._by_part.get(part, ())]


def _parts(name: str) -> List[str]:
    package, _, own_name = name.rpartition('/')
    return [package + '/', '/' + own_name]


def near_parts(text: str, candidates: Iterable[str]) -> List[str]:
    """
    The candidates whose parts between underscores contain, or are contained in, those of a text.

    What cannot stand in a name separates parts of the text, too.

    >>> near_parts('nao', ['aldebaran_nao', 'nano']), near_parts('my-pr2', ['pr2', 'pr2_other'])
    (['aldebaran_nao'], ['pr2'])
    """
    parts = set(re.findall('[a-z0-9]+', text.lower()))
    if not parts or len(text) > _NEAR_LENGTH:
        return []
    found = [(len(parts ^ others), candidate) for candidate in candidates
             for others in [set(candidate.lower().split('_'))]
             if parts <= others or others <= parts]
    return [candidate for _, candidate in sorted(found)[:3]]


def near_values(text: str, candidates: Iterable[str]) -> List[str]:
    """
    The registered values that were probably meant: at most three `near_misses`, then `near_parts`.

    >>> near_values('nao', ['aldebaran_nao', 'nano'])
    ['nano', 'aldebaran_nao']
    """
    known = list(candidates)
    return list(dict.fromkeys(near_misses(text, known) + near_parts(text, known)))[:3]


def with_article(noun: str) -> str:
    """
    A noun with the article that it takes.

    >>> with_article('hardware_platform'), with_article('operating_system')
    ('a hardware_platform', 'an operating_system')
    """
    return ('an ' if noun[0] in 'aeiou' else 'a ') + noun


def did_you_mean(suggestions: Iterable[str]) -> str:
    """
    The end of an error: what was probably meant, the likeliest first; empty if there is nothing.

    >>> did_you_mean(['a_package/RGBCamera'])
    " (did you mean 'a_package/RGBCamera'?)"
    """
    meant = ' or '.join(map(quoted, suggestions))
    return ' (did you mean %s?)' % meant if meant else ''


def expectation(found: object, known: Sequence[str]) -> str:
    """
    The end of an error about an unknown text: what was probably meant, or all that could have been.

    >>> expectation('iocn', ['icon', 'launch']), expectation('x', ['icon', 'launch'])
    (" (did you mean 'icon'?)", ' (expected icon, launch)')
    """
    meant = did_you_mean(near_misses(found, known)) if isinstance(found, str) else ''
    return meant or ' (expected %s)' % ', '.join(known)


def shown(value: object) -> str:
    """
    A value that was read, as an error shows it: on one line, short and safe whatever it is.

    >>> print(shown('laser'), shown(''), shown(True), shown(7), shown(['laser']))
    'laser' empty true 7 a list
    """
    if isinstance(value, str):
        return quoted(value) if value else 'empty'
    if value is None:
        return 'empty'
    if isinstance(value, bool):
        return 'true' if value else 'false'
    if isinstance(value, int) and int.bit_length(value) < 64:
        return int.__repr__(value)
    if isinstance(value, float):
        return float.__repr__(value)
    for kind, text in ((dict, 'a mapping'), ((list, tuple), 'a list'), (int, 'a large number')):
        if isinstance(value, kind):
            return text
    return 'an object of type %s' % type(value).__name__
