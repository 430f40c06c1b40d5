"""
Splitting a rocon URI: which part of the text is which field, and where it stands.

This module decides that ``rocon://turtlebot2/bob`` is a robot and not a concert called turtlebot2,
and what makes a text illegal as a whole.
"""
from __future__ import annotations

from rocon_uri import grammar
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.sources.wording import quoted
from rocon_uri.vocabulary import Vocabulary, completed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Iterable, Match, Optional, Sequence

__all__ = ['FIELDS', 'Parts', 'needs_all_fields', 'split']

#: What the six parts of a URI are called, in the order in which they are written.
FIELDS = ('concert_name', 'hardware_platform', 'name', 'application_framework',
          'operating_system', 'rocon_app')


class Parts:
    """
    The six parts of a URI as they are written.

    :param written: sequence of six str in the order of `FIELDS`, '' for a part that is left out
    :param Vocabulary vocabulary: what the parts are to be read with
    :param match: what `rocon_uri.grammar.split` found in the text of a URI; None for parts that
        come from no text, and have no percent-escapes
    :param bool with_one_slash: was ``//`` read as ``/``?
    """

    __slots__ = ('_written', 'vocabulary', '_match', 'with_one_slash')

    def __init__(self, written: Sequence[str], vocabulary: Vocabulary,
                 match: Optional[Match[str]] = None, with_one_slash: bool = False) -> None:
        self._written = written
        self.vocabulary = vocabulary
        self._match = match
        self.with_one_slash = with_one_slash

    def decoded(self, index: int) -> str:
        """
        One part, by its index in `FIELDS`, with its percent-escapes decoded.

        :raises RoconURIValueError: for escapes that are wrong, and for an escaped slash
        """
        raw = self._written[index]
        if '%' not in raw or self._match is None:
            return raw
        try:
            text = grammar.decoded(raw)
            if text.count('/') == raw.count('/'):
                return text
            problem = 'an escaped slash has no place in it'
        except ValueError as error:
            problem = str(error)
        raise RoconURIValueError('%s %s: %s' % (FIELDS[index], quoted(raw), problem), raw,
                                 FIELDS[index], raw)

    def placed(self, error: RoconURIValueError) -> RoconURIValueError:
        """An error of one part, whose text is its ``uri``, placed in the text of the URI."""
        if self._match is None:
            return error
        index = FIELDS.index(error.field)
        raw = self._written[index]
        first, last = error.span
        if error.uri != raw:        # the span counts the characters of the decoded part
            first, last = grammar.raw_span(raw, first, last)
        start = self.start(index)
        return error.within(self._match.string, (start + first, start + last))

    def start(self, index: int) -> int:
        """Where a part starts in the text, by its index in `FIELDS`; 0 if it is left out."""
        groups = _GROUPS_WITH_ONE_SLASH if self.with_one_slash else _GROUPS
        return max(0, self._match.start(groups[index])) if self._match else 0


# The groups of grammar.split that are FIELDS. Group 2 is the slash: where there is no concert,
# nothing can be wrong with its name.
_GROUPS = (1, 3, 4, 5, 6, 8)
_GROUPS_WITH_ONE_SLASH = (2, 1, 3, 4, 5, 8)


def split(text: str, vocabulary: Vocabulary, strict: bool) -> Parts:
    """
    Split a URI into its parts, and check what concerns the whole text.

    :param str text: anything
    :param Vocabulary vocabulary: the registered platforms
    :param bool strict: take the text literally
    :returns: Parts
    :raises RoconURIValueError: with ``field`` ``'uri'``, if the text as a whole is not legal
    """
    if len(text) > grammar.TEXT_LIMIT:
        raise RoconURIValueError('a rocon URI has at most %d characters, this one has more'
                                 % grammar.TEXT_LIMIT, text, value=text)
    match = grammar.split(text)
    if match is None:
        _check_characters(text)
        raise RoconURIValueError("%s does not start with 'rocon:'" % quoted(text), text,
                                 value=text, span=(0, min(len(text), len('rocon:'))))
    concert, slash, platform, name, framework, system, more, app = match.groups('')
    written = (concert, platform, name, framework, system, app)
    with_one_slash = False
    if concert and not strict and not system and not more:
        if not _are_platforms(platform, vocabulary):
            if platform not in ('', '*') or not _are_platforms(concert, vocabulary):
                vocabulary = completed(vocabulary)      # a package may have registered either
            with_one_slash = (_are_platforms(concert, vocabulary)
                              and not _are_platforms(platform, vocabulary))
        if with_one_slash:
            written = ('', concert, platform, name, framework, app)
    parts = Parts(written, vocabulary, match, with_one_slash)
    _check_characters(text)
    if len(more) > 1:       # one slash after the fourth field is nothing more
        raise RoconURIValueError(
            'a rocon URI has at most four fields: hardware_platform, name, application_framework '
            'and operating_system', text, value=more, span=match.span(7))
    if '?' in text:
        _check_question_marks(text, written, parts)
    if strict and platform and not slash:
        raise RoconURIValueError('the slash before the hardware_platform is missing', text,
                                 span=match.span(3), advice="write 'rocon:/'")
    return parts


def _are_platforms(raw: str, vocabulary: Vocabulary) -> bool:
    """Are all alternatives of a raw part registered hardware platforms?"""
    platforms = vocabulary.field('hardware_platform')
    if '%' in raw:
        try:
            raw = grammar.decoded(raw)
        except ValueError:
            return False
    if '|' not in raw:
        return raw in platforms
    return all(alternative in platforms for alternative in raw.split('|'))


def _check_characters(text: str) -> None:
    if text.isprintable() and ' ' not in text:      # 20 times as fast as the search
        return
    match = grammar.stray_character(text)
    if match:
        character = match.group()
        kind = 'white space' if character.isspace() else 'control characters'
        raise RoconURIValueError('a rocon URI has no %s (U+%04X)' % (kind, ord(character)), text,
                                 value=character, span=match.span())


def _check_question_marks(text: str, written: Sequence[str], parts: Parts) -> None:
    for index, raw in enumerate(written):
        if FIELDS[index] != 'name' and '?' in raw:
            start = parts.start(index) + raw.index('?')
            raise RoconURIValueError("only the name can have a '?', as part of a pattern", text,
                                     value='?', span=(start, start + 1))


def needs_all_fields(concert_name: str, platforms: Iterable[str], vocabulary: Vocabulary) -> bool:
    """Would a concert, '' for none, be read as a platform if not all four fields were written?"""
    if not concert_name:
        return False
    registered = completed(vocabulary).field('hardware_platform')
    return concert_name in registered and not all(value in registered for value in platforms)
