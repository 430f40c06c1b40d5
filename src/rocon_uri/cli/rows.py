"""Headings with rows of names below them."""
from __future__ import annotations

from rocon_uri.cli.display import painter
from rocon_uri.cli.packages import one_line

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Iterable, Sequence

__all__ = ['print_names', 'print_rows']


def print_names(heading: str, names: Iterable[str]) -> None:
    """Print names below a heading; nothing if there are none."""
    print_rows(heading, [(name,) for name in names])


def print_rows(heading: str, rows: Sequence[Sequence[str]]) -> None:
    """Print rows in columns below a heading; nothing if there are none."""
    if rows:
        print(painter()(heading, 'bold'))
    cells = [tuple(map(one_line, row)) for row in rows]
    widths = [max(map(len, column)) for column in zip(*cells)]
    for row in cells:
        print('  ' + '  '.join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
