"""What is said of bytes that are not text in UTF-8."""
from __future__ import annotations

__all__ = ['NOT_UTF8', 'MARKS_OF_UTF16', 'byte_at', 'utf16_problem']

NOT_UTF8 = 'not UTF-8 (Latin-1?)'
MARKS_OF_UTF16 = b'\xff\xfe', b'\xfe\xff'

_START = 200        # bytes that are enough to recognise UTF-16


def byte_at(byte: int, offset: int) -> str:
    """The byte at which something is wrong, as an error names it."""
    return 'byte 0x%02x at offset %d' % (byte, offset)


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
    return 'UTF-16, not UTF-8: ' + byte_at(start[zero], zero) if zero >= 0 else ''
