"""What a robot announces of itself to a resource directory, and within which limits."""
from __future__ import annotations

from typing import Tuple, Union

from rocon_uri.exceptions import UnregisteredValue
from rocon_uri.parts import FIELDS
from rocon_uri.sources.wording import quoted
from rocon_uri.uri import RoconURI, parse
from rocon_uri.vocabulary import Vocabulary

__all__ = ['LIFETIMES', 'Values', 'check_key', 'check_lifetime', 'read_values', 'values_of']

#: the shortest and the longest lifetime, in seconds
LIFETIMES = (0.1, 3600.0)

_KEY_LENGTH = 255       # characters

#: the fields of a URI in their order, as a message has them: str, or tuple of str
Values = Tuple[Union[str, Tuple[str, ...]], ...]


def values_of(uri: Union[str, RoconURI]) -> Values:
    """
    The fields of a URI as a message has them.

    :param uri: str or RoconURI, which may have values that are not registered
    :returns: tuple of str and of tuples of str
    :raises RoconURIValueError: for a text that is not legal

    >>> values_of('rocon:/pr2|pc/bob')
    ('', ('pr2', 'pc'), 'bob', ('*',), ('*',), '')
    """
    uri = parse(uri, None if isinstance(uri, RoconURI) else Vocabulary.open())
    return (uri.concert_name, tuple(uri.hardware_platform.list), uri.name.string,
            tuple(uri.application_framework.list), tuple(uri.operating_system.list), uri.rocon_app)


def read_values(values: Values) -> RoconURI:
    """
    A URI from its fields, read with the current vocabulary or, if that lacks a value, with any.

    :param values: as `values_of` returns them
    :returns: RoconURI
    :raises RoconURIValueError: for a field that is not legal
    """
    fields = dict(zip(FIELDS, values))
    try:
        return RoconURI.from_fields(**fields)       # type: ignore[arg-type]
    except UnregisteredValue:
        return RoconURI.from_fields(**fields, vocabulary=Vocabulary.open())  # type: ignore[arg-type]


def check_lifetime(lifetime: float) -> None:
    """
    Refuse a lifetime that is too short or too long.

    :param float lifetime: seconds
    :raises ValueError: for such a one

    >>> check_lifetime(7200.0)
    Traceback (most recent call last):
    ValueError: lifetime 7200 s is not between 0.1 s and 3600 s
    """
    least, most = LIFETIMES
    if not least <= lifetime <= most:
        raise ValueError('lifetime %g s is not between %g s and %g s' % (lifetime, least, most))


def check_key(key: str) -> None:
    """
    Refuse a key that is too long.

    :param str key: which of an announcer's resources it is
    :raises ValueError: for more than 255 characters
    """
    if len(key) > _KEY_LENGTH:
        raise ValueError('key %s has %d characters, expected at most %d'
                         % (quoted(key), len(key), _KEY_LENGTH))
