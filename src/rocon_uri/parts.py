"""
A text taken apart: what was written for each part of a rocon URI, and where.

Here is decided which part is which, after the rule that ``rocon://turtlebot2/bob`` is a robot and
not a concert called turtlebot2, and what makes the whole text illegal.
"""
from __future__ import annotations

from rocon_uri import grammar
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.sources.wording import quoted
from rocon_uri.sources.ros_names import is_legal_base_name
from rocon_uri.vocabulary import Vocabulary, completed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Dict, Tuple, TypeVar
    Value = TypeVar('Value')

__all__ = ['Part', 'read_concert_name', 'read_rocon_app', 'take_apart']

_FIELDS = ('concert_name', 'hardware_platform', 'name', 'application_framework',
           'operating_system', 'rocon_app')


class Part:
    """
    One part of a URI as it was written.

    :param str field: which it is
    :param str raw: its text, with percent-escapes
    :param str uri: the text that it is in
    :param int start: where it starts there
    """

    __slots__ = ('field', 'raw', 'uri', 'start')

    def __init__(self, field: str, raw: str, uri: str, start: int) -> None:
        self.field = field
        self.raw = raw
        self.uri = uri
        self.start = start

    def read(self, read: Callable[[str], Value]) -> Value:
        """
        What this part says.

        :param read: callable that takes the decoded text
        :returns: what the callable returns
        :raises RoconURIValueError: its span is in the whole URI
        """
        try:
            text = grammar.decoded(self.raw)
            if text.count('/') > self.raw.count('/'):
                raise ValueError('an escaped slash has no place in it')
            return read(text)
        except RoconURIValueError as error:
            start, end = grammar.raw_span(self.raw, *error.span)
            raise error.within(self.uri, (self.start + start, self.start + end)) from None
        except ValueError as error:
            raise RoconURIValueError('%s %s: %s' % (self.field, quoted(self.raw), error), self.uri,
                                     self.field, self.raw,
                                     (self.start, self.start + len(self.raw))) from None


def take_apart(text: str, vocabulary: Vocabulary,
               strict: bool) -> Tuple[Dict[str, Part], Vocabulary, bool]:
    """
    The six parts of a URI, the vocabulary to read them with, and whether ``//`` was read as ``/``.

    :param str text: anything
    :param Vocabulary vocabulary: what is a registered platform
    :param bool strict: take the text by its letter
    :returns: (dict of `Part` by field, Vocabulary, bool)
    :raises RoconURIValueError: with ``field`` ``'uri'``, if the whole is not legal
    """
    match = grammar.split(text)
    if match is None:
        _check_characters(text)
        raise RoconURIValueError("%s does not start with 'rocon:'" % quoted(text), text,
                                 value=text, span=(0, min(len(text), len('rocon:'))))
    written = [(match.group(group) or '', max(0, match.start(group)))
               for group in (1, 3, 4, 5, 6, 8)]
    more = match.group(7) or ''
    with_one_slash = False
    if written[0][0] and not strict and not written[4][0] and not more:
        concert, platform = written[0][0], written[1][0]
        if not _are_platforms(platform, vocabulary):
            if platform not in ('', '*') or not _are_platforms(concert, vocabulary):
                vocabulary = completed(vocabulary)      # either may be known to another package
            with_one_slash = (_are_platforms(concert, vocabulary)
                              and not _are_platforms(platform, vocabulary))
    if with_one_slash:
        written[:5] = [('', 0)] + written[:4]
    parts = {field: Part(field, raw, text, start)
             for field, (raw, start) in zip(_FIELDS, written)}
    _check_characters(text)
    _check_fields(text, parts, more, match.end(6))
    if strict and not match.group(2) and match.group(3):
        raise RoconURIValueError('the slash before the hardware_platform is missing', text,
                                 span=match.span(3), advice="write 'rocon:/'")
    return parts, vocabulary, with_one_slash


def _are_platforms(raw: str, vocabulary: Vocabulary) -> bool:
    try:
        alternatives = grammar.decoded(raw).split('|')
    except ValueError:
        return False
    platforms = vocabulary.field('hardware_platform')
    return all(alternative in platforms for alternative in alternatives)


def _check_characters(text: str) -> None:
    index = grammar.stray_character(text)
    if index is not None:
        character = text[index]
        kind = 'white space' if character.isspace() else 'control characters'
        raise RoconURIValueError('a rocon URI has no %s (U+%04X)' % (kind, ord(character)), text,
                                 value=character, span=(index, index + 1))


def _check_fields(text: str, parts: Dict[str, Part], more: str, more_start: int) -> None:
    if len(more) > 1:       # one slash after the fourth field is nothing more
        raise RoconURIValueError(
            'a rocon URI has at most four fields: hardware_platform, name, application_framework '
            'and operating_system', text, value=more, span=(more_start, more_start + len(more)))
    for part in parts.values():
        if part.field != 'name' and '?' in part.raw:
            start = part.start + part.raw.index('?')
            raise RoconURIValueError("only the name can have a '?', as part of a pattern", text,
                                     value='?', span=(start, start + 1))


def read_concert_name(text: str) -> str:
    """
    The name of a concert.

    :param str text: decoded; '' for none
    :returns: str
    :raises RoconURIValueError: if it is not legal
    """
    if text and not is_legal_base_name(text):
        raise RoconURIValueError(
            'concert_name %s is not a ROS base name (a letter, then letters, digits and _)'
            % quoted(text), text, 'concert_name', text)
    return _of_legal_length('concert_name', text)


def read_rocon_app(text: str) -> str:
    """
    The name of an app.

    :param str text: decoded; '' for none
    :returns: str
    :raises RoconURIValueError: if it is not legal
    """
    if text and not all(map(is_legal_base_name, text.split('/', 1))):
        raise RoconURIValueError(
            'rocon_app %s is not of the form package/name or name, each a ROS base name'
            % quoted(text), text, 'rocon_app', text)
    for name in text.split('/'):
        _of_legal_length('rocon_app', name)
    return text


def _of_legal_length(field: str, text: str) -> str:
    if len(text) > grammar.NAME_LIMIT:
        raise RoconURIValueError('%s %s is longer than %d characters'
                                 % (field, quoted(text), grammar.NAME_LIMIT), text, field, text)
    return text
