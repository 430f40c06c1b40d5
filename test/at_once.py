"""Threads to test with."""
from __future__ import annotations

import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from typing import Callable, List, TypeVar

Result = TypeVar('Result')


def at_once(function: Callable[[], Result], threads: int = 16) -> List[Result]:
    """What it returns in each of some threads that begin together; what one raises is raised."""
    ready = threading.Barrier(threads)

    def call() -> Result:
        ready.wait()
        return function()

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)     # so that they meet often
    try:
        with ThreadPoolExecutor(threads) as pool:
            return [future.result() for future in [pool.submit(call) for _ in range(threads)]]
    finally:
        sys.setswitchinterval(interval)
