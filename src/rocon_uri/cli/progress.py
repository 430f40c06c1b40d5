"""A progress bar on the terminal for large files, if tqdm is installed."""
from __future__ import annotations

import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import ContextManager, Optional, Union

    from tqdm import tqdm

__all__ = ['beside_progress', 'progress']

_SMALL = 1 << 20    # bytes; a smaller file is read before anybody could see a bar


class _NoBar:
    """Takes the place of a bar that is not shown."""

    def __enter__(self) -> _NoBar:
        return self

    def __exit__(self, *error: object) -> None:
        pass

    def update(self, read: int) -> None:
        """Note that this many more bytes have been read."""


def progress(size: Optional[int]) -> Union[tqdm, _NoBar]:
    """
    Show how far a file has been read, on stderr if that is a terminal.

    :param size: int, its bytes; None if it is not known
    :returns: context manager; the method ``update`` of its value takes the number of bytes read
    """
    if sys.stderr.isatty() and (size is None or size > _SMALL):
        try:
            from tqdm import tqdm       # here, since few calls need it
        except ImportError:
            pass
        else:
            options = {'total': size, 'unit': 'B', 'unit_scale': True, 'leave': False}
            try:
                # Without nrows, newer versions show nothing on a terminal that does not know its
                # height, as in a container.
                return tqdm(nrows=20, **options)
            except KeyError:    # that of Ubuntu 20.04 does not know it
                return tqdm(**options)
    return _NoBar()


def beside_progress() -> ContextManager[object]:
    """Take the bar away while something else is printed; a context manager."""
    loaded = sys.modules.get('tqdm')
    return loaded.tqdm.external_write_mode(file=sys.stderr) if loaded else _NoBar()
