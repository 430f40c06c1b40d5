"""A thread that calls functions in order, so that nobody waits for them, such as publishing."""
from __future__ import annotations

import logging
import queue
import threading
from typing import Callable, Optional

__all__ = ['Outbox']

_logger = logging.getLogger('rosout.capabilities')


class Outbox:
    """
    Calls functions one after the other, in a thread of its own.

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
        """Have a function called; returns at once."""
        self._queue.put(do)

    def close(self, timeout: float) -> None:
        """Wait for the functions put so far, for so many seconds at most; call no others."""
        self._queue.put(None)
        self._thread.join(timeout)

    def _run(self) -> None:
        for do in iter(self._queue.get, None):
            try:
                do()
            except Exception as error:      # one message failed; send the others
                _logger.debug('not sent: %s', error)
