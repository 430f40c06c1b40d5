"""What says FILE:LINE:COLUMN: PROBLEM."""
from __future__ import annotations

from rocon_uri.sources.wording import printable

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Optional

__all__ = ['located']


def located(problem: str, file_name: str, line: Optional[int], column: Optional[int]) -> str:
    """
    A problem with the place that it is at in front, in the form that editors know.

    :param str problem: what is wrong
    :param str file_name: where the text is from
    :param int line: counted from 1, or ``None`` where it is not known
    :param int column: counted from 1, or ``None``
    :returns: str of one line

    >>> located("topic 'scan' has no type", 'laser.yaml', 12, 5)
    "laser.yaml:12:5: topic 'scan' has no type"
    """
    place = file_name if line is None else '%s:%s:%s' % (file_name, line, column)
    return printable('%s: %s' % (place, problem))
