"""What is said of bytes that are not text in UTF-8."""
from __future__ import annotations

__all__ = ['NOT_UTF8', 'MARKS_OF_UTF16', 'not_utf8_at', 'utf16_problem']

NOT_UTF8 = 'not UTF-8 (Latin-1?)'
MARKS_OF_UTF16 = b'\xff\xfe', b'\xfe\xff'

_START = 200        # bytes that are enough to recognise UTF-16


def not_utf8_at(octets: bytes, offset: int) -> str:
    """
    What is wrong with bytes that are not UTF-8 from an offset on, and not UTF-16.

    >>> not_utf8_at(bytes([0x61, 0xe9]), 1)
    'not UTF-8 (Latin-1?): byte 0xe9 at offset 1'
    """
    return '%s: %s' % (NOT_UTF8, _byte_at(octets, offset))


def utf16_problem(octets: bytes) -> str:
    """
    What is wrong with bytes that are UTF-16, '' if they are not: by the mark, or every other is 0.

    >>> utf16_problem(b'p' + bytes(1) + b'c' + bytes(1))
    'UTF-16, not UTF-8: byte 0x00 at offset 1'
    """
    start = octets[:_START]
    if start.startswith(MARKS_OF_UTF16):
        zero = 0
    else:
        zero = next((first for first in (1, 0) if len(start) > 3 and not any(start[first::2])), -1)
    return 'UTF-16, not UTF-8: ' + _byte_at(start, zero) if zero >= 0 else ''


def _byte_at(octets: bytes, offset: int) -> str:
    return 'byte 0x%02x at offset %d' % (octets[offset], offset)
