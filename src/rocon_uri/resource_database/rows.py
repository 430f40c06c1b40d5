"""From a resource to its row."""
from __future__ import annotations

import json
from hashlib import blake2b
from typing import NamedTuple, Optional

from rocon_uri.field import ValuesField
from rocon_uri.uri import RoconURI

__all__ = ['Fields', 'Row', 'digest_of', 'fields_of', 'payload_text', 'row_of']


class Fields(NamedTuple):
    """A kind: the concert and the fields with registered values, their alternatives sorted."""

    concert_name: str               # '' for none
    hardware_platform: str          # as in a URI, with the alternatives sorted
    application_framework: str      # likewise
    operating_system: str           # likewise

    def digest(self) -> bytes:
        """16 bytes that tell kinds apart."""
        return _digest('/'.join(self))


class Row(NamedTuple):
    """A resource, as the columns of its row; see `rocon_uri.resource_database.tables`."""

    #: 16 bytes that tell resources apart
    digest: bytes
    #: larger for one that was added later
    id: int     # noqa: A003
    #: the id of its kind
    kind: int
    #: the literal name, or the pattern
    name: str
    #: the literal name from its end to its beginning; None for a pattern
    reversed: Optional[str]     # noqa: A003
    #: 1 or 0
    is_pattern: int
    #: the canonical text
    uri: str
    #: JSON; None for none
    payload: Optional[str]
    #: when, by the clock of the database; None for never
    expires: Optional[float]


def fields_of(uri: RoconURI) -> Fields:
    """
    The kind of a resource.

    :param RoconURI uri: the resource
    :returns: Fields
    """
    return Fields(concert_name=uri.concert_name, hardware_platform=_sorted(uri.hardware_platform),
                  application_framework=_sorted(uri.application_framework),
                  operating_system=_sorted(uri.operating_system))


def digest_of(uri: RoconURI) -> bytes:
    """
    What equal URIs have in common, and others not.

    :param RoconURI uri: the resource
    :returns: bytes, 16 of them

    >>> from rocon_uri import parse
    >>> digest_of(parse('rocon:/pr2|pc/bob')) == digest_of(parse('rocon:/pc|pr2/bob'))
    True
    """
    return _digest('/'.join((*fields_of(uri), uri.name_text)) + '#' + uri.rocon_app)


def row_of(uri: RoconURI, number: int, kind: int, payload: Optional[str],
           expires: Optional[float]) -> Row:
    """
    The row of a resource.

    :param RoconURI uri: the resource
    :param int number: its id
    :param int kind: the id of its kind
    :param payload: as `payload_text` returns it
    :param expires: float, None for never
    :returns: Row
    """
    is_pattern = uri.name_pattern is not None
    return Row(digest=digest_of(uri), id=number, kind=kind, name=uri.name_text,
               reversed=None if is_pattern else uri.name_text[::-1], is_pattern=int(is_pattern),
               uri=str(uri), payload=payload, expires=expires)


def payload_text(payload: object) -> Optional[str]:
    """
    A payload as it is stored.

    :param payload: what JSON can hold
    :returns: str, or None for None
    :raises TypeError: for what JSON cannot hold
    :raises ValueError: for a number that JSON cannot hold, and for what contains itself

    >>> payload_text({'battery': 0.5}), payload_text(None)
    ('{"battery": 0.5}', None)
    """
    return None if payload is None else json.dumps(payload, allow_nan=False)


def _sorted(field: ValuesField) -> str:
    return '|'.join(sorted(field.alternatives)) if len(field.alternatives) > 1 else field.string


def _digest(text: str) -> bytes:
    return blake2b(text.encode('ascii'), digest_size=16).digest()
