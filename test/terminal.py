"""A terminal to test with."""
from __future__ import annotations

import pty
from typing import Tuple

import pytest


def open_terminal() -> Tuple[int, int]:
    """The two ends of a pseudo-terminal; the test is skipped where none can be had."""
    try:
        return pty.openpty()
    except OSError as error:
        pytest.skip('no pseudo-terminal can be had: %s' % (error.strerror or error))
