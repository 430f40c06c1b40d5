"""A thread that does in order what must not be waited for: publishing and the like."""
from __future__ import annotations

import logging
import queue
import threading
from typing import Callable, Optional

__all__ = ['Outbox']

_logger = logging.getLogger('rosout.capabilities')


class Outbox:
    """
    Does what it is given, one after the other, in a thread of its own.

    >>> outbox = Outbox()
    >>> outbox.put(lambda: print('done'))
    >>> outbox.close(1.0)
    done
    """

    def __init__(self) -> None:
        self._queue: queue.SimpleQueue[Optional[Callable[[], object]]] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._run, name='outbox', daemon=True)
        self._thread.start()

    def put(self, do: Callable[[], object]) -> None:
        """Have something done; returns at once."""
        self._queue.put(do)

    def close(self, timeout: float) -> None:
        """Do nothing after what was put; wait for that, so many seconds at most."""
        self._queue.put(None)
        self._thread.join(timeout)

    def _run(self) -> None:
        for do in iter(self._queue.get, None):
            try:
                do()
            except Exception as error:      # of one message; the others are to be sent
                _logger.debug('not sent: %s', error)
