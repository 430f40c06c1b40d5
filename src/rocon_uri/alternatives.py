"""
Reading a list of alternatives such as ``pr2|kobuki``.

This module decides what a ``*`` in a list means: it makes the whole list ``*``.
"""
from __future__ import annotations

import re

from rocon_uri.exceptions import RoconURIValueError, UnregisteredValue
from rocon_uri.field_vocabulary import FieldVocabulary
from rocon_uri.grammar import ALTERNATIVES_LIMIT, NAME_LIMIT, VOCABULARY_FIELDS
from rocon_uri.sources.ros_names import is_legal_base_name
from rocon_uri.sources.wording import quoted, with_article
from rocon_uri.vocabulary import Vocabulary

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Tuple

__all__ = ['read_alternatives']

_ANY = ('*',)


def read_alternatives(field: str, text: str, vocabulary: Vocabulary) -> Tuple[str, ...]:
    """
    The alternatives of a field whose values are registered.

    :param str field: the name of the field
    :param str text: the text of the field, decoded; '' for any
    :param Vocabulary vocabulary: the registered values
    :returns: tuple of str, in the order of the text, without duplicates; ``('*',)`` if one of
        them is ``*``, though the others must be registered all the same
    :raises UnregisteredValue: for a value that the vocabulary does not have
    :raises RoconURIValueError: for an empty alternative, for too many, and for what no vocabulary
        can have; ``span`` is where in ``text`` the fault is

    >>> everything = Vocabulary.bundled()
    >>> read_alternatives('hardware_platform', 'pr2|kobuki|pr2', everything)
    ('pr2', 'kobuki')
    >>> read_alternatives('hardware_platform', 'pr2|*', everything)
    ('*',)
    """
    if text in ('', '*'):
        return _ANY
    if text.count('|') >= ALTERNATIVES_LIMIT:
        raise RoconURIValueError('%s has more than %d alternatives' % (field, ALTERNATIVES_LIMIT),
                                 text, field, text)
    registered = vocabulary.field(field)
    alternatives = text.split('|')
    start = 0
    for value in alternatives:
        end = start + len(value)
        if not value:
            raise RoconURIValueError(
                '%s %s has an empty alternative' % (field, quoted(text)), text, field, value,
                (max(0, start - 1), max(1, end)), advice="write a value on each side of '|'")
        if value != '*' and value not in registered:
            _check_unregistered(field, value, text, (start, end), vocabulary)
        start = end + 1
    return _ANY if '*' in alternatives else tuple(dict.fromkeys(alternatives))


def _check_unregistered(field: str, value: str, text: str, span: Tuple[int, int],
                        vocabulary: Vocabulary) -> None:
    """Raise unless the vocabulary is open and the value is a ROS base name."""
    known = vocabulary.field(field)
    if not is_legal_base_name(value) or len(value) > NAME_LIMIT:
        problem = ('is not a ROS base name of at most %d characters' % NAME_LIMIT
                   if vocabulary.is_open else 'is not registered, and cannot be')
        raise RoconURIValueError('%s %s %s' % (field, quoted(value), problem), text, field, value,
                                 span, candidates=known, advice=_what_to_write(text, value, known))
    if not vocabulary.is_open:
        others = [other for other in VOCABULARY_FIELDS if value in vocabulary.field(other)]
        raise UnregisteredValue(
            '%s %s is not registered' % (field, quoted(value)), text, field, value, span,
            candidates=known,
            advice='%s is %s' % (quoted(value), ' and '.join(map(with_article, others)))
                   if others else
                   'to register it, add it to a rules file that a package exports or that '
                   'ROCON_URI_RULES names')


def _what_to_write(text: str, value: str, known: FieldVocabulary) -> str:
    """Advice to somebody who wrote a value that no vocabulary can have."""
    advice = 'a value is a letter, then letters, digits and _'
    if len(value) > NAME_LIMIT:
        return advice + ', at most %d characters' % NAME_LIMIT
    values = list(filter(None, re.split('[][(){},;&+*?^$ ]+', text)))
    stem = value.strip('(){}[]*?+.^$')
    if re.search('[,;&+ ]', value) and len(values) > 1:
        return advice + '; alternatives have a | between them: %s' % quoted('|'.join(values))
    if re.search(r'\d\.\d', value):
        return advice + '; a release has the name that is registered for it, not its number'
    if text[0] == '(' and text[-1] == ')':
        return advice + '; alternatives need no parentheses: %s' % quoted(text.strip('()'))
    if stem != value:
        advice += '; only the name can be a pattern'
        if known.children(stem):
            advice += ', but the group %s covers its members' % quoted(stem)
    return advice
