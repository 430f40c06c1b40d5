"""
Standard output and error of a node: a line is written at once, and lost where that is impossible.

ROS writes its log to both, and would raise what a full disk raises wherever something is logged. In
a file, Python would keep what is written until there is more, up to 3.8 the warnings too. Imports
only the standard library, since `capabilities.runner` is run by its path.
"""
import io
import sys
from typing import TextIO

__all__ = ['install']


class _Lossy:
    """A stream that raises nothing when it is written to."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        try:
            self._stream.write(text)
        except (OSError, ValueError):       # ValueError: it is closed
            pass
        return len(text)

    def flush(self) -> None:
        try:
            self._stream.flush()
        except (OSError, ValueError):
            pass

    def __getattr__(self, name: str) -> object:
        attribute: object = getattr(self._stream, name)
        return attribute


def install() -> None:
    """Let this process write to its standard output and error in that way."""
    for stream in sys.stdout, sys.stderr:
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(line_buffering=True)
    sys.stdout, sys.stderr = _Lossy(sys.stdout), _Lossy(sys.stderr)
