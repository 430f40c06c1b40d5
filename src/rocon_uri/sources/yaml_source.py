"""
Reads untrusted YAML (and JSON, a subset of it) into plain data that knows its lines.

``load`` reads a text and ``load_file`` a file. What comes back is what ``yaml.safe_load`` gives,
except that mappings are `YamlMapping`, a ``dict``, and sequences `YamlSequence`, a ``list``, which
also answer where in the text a key, a value or an item begins:

>>> source = load('topics:\\n  scan: sensor_msgs/LaserScan\\n', 'laser.yaml')
>>> source['topics']
{'scan': 'sensor_msgs/LaserScan'}
>>> source['topics'].key_position('scan'), source['topics'].value_position('scan')
((2, 3), (2, 9))

Positions are (line, column), both counted from 1. Each text is either read, or refused with one
`YamlError` that says where:

>>> load('topics: [', 'laser.yaml')
Traceback (most recent call last):
    ...
rocon_uri.sources.yaml_data.YamlError: laser.yaml:2:1: did not find expected node content while \
parsing a flow node

The cost of a text is bounded: it has at most 1 MiB, its collections are at most 100 deep, and its
aliases and merges add at most 1 MiB. An alias gives the same object again, not a copy. The text is
read from the parser's events, never composed or loaded: libyaml's composer overruns the stack on a
few tens of thousands of ``[``.

- Plain scalars have the types of YAML 1.1, as in ``yaml.safe_load`` (``yes``, ``0x1F``, ``1:30``),
  except for dates and ``=``, which stay text. A number of over 256 characters is refused.
- The tags of the core types (``!!str``, ``!!int``, ...) are read; others are refused.
- Merge keys (``<<``) are read; a mapping's own keys win over merged ones, wherever they stand.
- A duplicate key is not an error here. The last one wins, and ``YamlMapping.repeated`` lists what
  was lost; ``1``, ``1.0`` and ``true`` are one key, as in Python. A collection as key is refused,
  and so are more than 100 keys of one mapping that are not text.
- There is one document; an empty text is ``None``.
- Text is UTF-8, or UTF-16 with a byte order mark. A lone surrogate or a control character that
  is not escaped is refused.
"""
from __future__ import annotations

import errno
import os
import re
import stat
from os import PathLike
from typing import Any, Union

from rocon_uri.sources.encoding import MARKS_OF_UTF16, not_utf8_at, utf16_problem
from rocon_uri.sources.yaml_data import (
    MAX_DEPTH, MAX_SIZE, YamlError, YamlMapping, YamlSequence, end_position)

__all__ = ['MAX_DEPTH', 'MAX_SIZE', 'YamlError', 'YamlMapping', 'YamlSequence', 'load',
           'load_file', 'read_file']

_CHUNK = 65536      # bytes that are read at a time of a file that is larger than it says
_MAX_TAG_DIRECTIVES = 100   # libyaml compares each one with all earlier ones

_tag_directives = re.compile('(?:^|[\r\n\x85\u2028\u2029])%TAG').findall


def load(content: Union[str, bytes], file_name: str = '<string>') -> Any:
    """
    Read one YAML document.

    :param content: the text, str or bytes
    :param str file_name: the name that errors give
    :returns: `YamlMapping`, `YamlSequence`, str, int, float, bool or None
    :raises YamlError: if it is not YAML or passes a limit

    >>> load('[yes, 0x1F, 2014-01-01]')
    [True, 31, '2014-01-01']
    """
    if len(content) > MAX_SIZE:
        raise YamlError('larger than 1 MiB, which is all that is read', file_name, 1, 1)
    # Here, since it imports yaml, which is not needed where no YAML is read.
    from rocon_uri.sources.yaml_events import Reader
    return Reader(_text(content, file_name), file_name).document()


def load_file(path: Union[str, PathLike[str]]) -> Any:
    """
    Read a file that holds one YAML document.

    :param path: the file, str or path object
    :returns: as `load`
    :raises YamlError: if it is not YAML or passes a limit
    :raises OSError: if it cannot be read, or is not a regular file

    >>> load_file('test/unit/specs/interfaces/RGBCamera.yaml')['name']
    'RGBCamera'
    """
    return load(read_file(path), str(path))


def read_file(path: Union[str, PathLike[str]]) -> bytes:
    """
    The content of a regular file, up to one byte more than `load` accepts.

    :param path: the file, str or path object
    :returns: bytes, at most one more than 1 MiB
    :raises OSError: if it cannot be read, or is a directory, a FIFO or a device

    >>> read_file('test/unit/specs/interfaces/RGBCamera.yaml')[:9]
    b'%YAML 1.1'
    """
    try:
        # Without O_NONBLOCK, opening a FIFO waits for somebody to write to it.
        descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK | os.O_NOCTTY)
        try:
            status = os.fstat(descriptor)
            if stat.S_ISDIR(status.st_mode):
                raise OSError(errno.EISDIR, 'Is a directory')
            if not stat.S_ISREG(status.st_mode):
                raise OSError(errno.EINVAL, 'Not a regular file')
            # A read allocates what it is asked for, so ask for the size of the file, not for 1 MiB.
            content = more = os.read(descriptor, min(status.st_size, MAX_SIZE) + 1)
            while more and len(content) <= MAX_SIZE:    # it may grow, or be one of /proc
                more = os.read(descriptor, min(MAX_SIZE + 1 - len(content), _CHUNK))
                content += more
            return content
        finally:
            os.close(descriptor)
    except OSError as error:
        if error.filename is None:      # that of a read has none
            error.filename = str(path)
        raise
    except ValueError as error:     # a NUL or a lone surrogate in the path
        raise OSError(errno.EINVAL, str(error), str(path)) from error


def _text(content: Union[str, bytes], file_name: str) -> str:
    """The content as text that both of PyYAML's parsers take as it is."""
    if isinstance(content, str):
        text = content
    else:
        encoding = 'utf-16' if content[:2] in MARKS_OF_UTF16 else 'utf-8'
        if encoding == 'utf-8' and utf16_problem(content):
            raise YamlError(utf16_problem(content), file_name, 1, 1)
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError as error:
            before = content[:error.start].decode(encoding, 'replace')
            problem = (not_utf8_at(content, error.start) if encoding == 'utf-8'
                       else 'not UTF-16 text: ' + error.reason)
            raise YamlError(problem, file_name, *end_position(before)) from error
    # Counting anywhere comes first: it takes a fiftieth of the time, and most texts need no more.
    if (text.count('%TAG') > _MAX_TAG_DIRECTIVES
            and len(_tag_directives(text)) > _MAX_TAG_DIRECTIVES):
        raise YamlError('more than %d %%TAG directives' % _MAX_TAG_DIRECTIVES, file_name, 1, 1)
    return text[1:] if text.startswith('\ufeff') else text
