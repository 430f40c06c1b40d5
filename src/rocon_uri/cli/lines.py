"""The lines of a file or of standard input, in batches."""
from __future__ import annotations

import os
import stat
import sys

from rocon_uri.cli.progress import progress
from rocon_uri.grammar import TEXT_LIMIT
from rocon_uri.sources.encoding import utf16_problem

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Iterator, List

__all__ = ['read_lines']

_BATCH = 1 << 17    # bytes


def read_lines(path: str) -> Iterator[List[str]]:
    """
    Read lines, with a progress bar on a terminal if the file is large.

    A line that is longer than any URI may be cut.

    :param str path: the file, ``-`` for standard input
    :returns: iterator of lists of str, each with the lines that can be read without waiting, at
        most a few megabytes; bytes that are not UTF-8 become surrogates
    :raises OSError: if it cannot be read
    :raises UnicodeError: if it is UTF-16
    """
    if path == '-':
        _say_what_is_waited_for()
    with open(0 if path == '-' else path, 'rb', closefd=path != '-') as file:
        status = os.fstat(file.fileno())
        is_known = stat.S_ISREG(status.st_mode) or file.isatty()     # who types needs no bar
        with progress(status.st_size if is_known else None) as bar:
            encoding, read, rest = 'utf-8-sig', True, b''
            while read:
                octets = file.read1(_BATCH)
                bar.update(len(octets))
                problem = utf16_problem(octets) if encoding == 'utf-8-sig' else ''
                if problem:
                    raise UnicodeError('it is ' + problem)
                read = bool(octets)
                whole, newline, rest = (rest + octets).rpartition(b'\n')
                if not read:
                    whole, rest = rest, b''
                rest = rest[:TEXT_LIMIT + 2]
                if whole or newline:
                    yield whole.decode(encoding, 'surrogateescape').split('\n')
                    encoding = 'utf-8'


def _say_what_is_waited_for() -> None:
    """Whoever types at a terminal that stays silent should know why."""
    if sys.stdin is not None and sys.stdin.isatty():
        print('rocon_uri: reading standard input, one URI a line; Ctrl-D ends it',
              file=sys.stderr)
