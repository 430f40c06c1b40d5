"""
Standard output and error whose text is lost where it cannot be written, as on a full disk.

ROS writes its log to both, and would raise what that raises wherever something is logged. Imports
only the standard library, since `capabilities.runner` is run by its path.
"""
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
    sys.stdout, sys.stderr = _Lossy(sys.stdout), _Lossy(sys.stderr)
