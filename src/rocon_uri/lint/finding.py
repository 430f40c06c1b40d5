"""One thing that the linter has found, and the forms in which it is told."""
from __future__ import annotations

from collections import namedtuple

from rocon_uri.sources.located import located

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Dict

__all__ = ['ERROR', 'WARNING', 'Finding']

#: It will not work, or not as it says.
ERROR = 'error'
#: It works, but is probably not what was meant.
WARNING = 'warning'


class Finding(namedtuple('Finding', 'file line column severity text')):
    """
    What is wrong, and where.

    - ``file``: str; ``line`` and ``column``: int from 1, ``None`` where it is in no one place
    - ``severity``: `ERROR` or `WARNING`
    - ``text``: str, one sentence without the place

    >>> print(Finding('dance.rapp', 3, 9, ERROR, "launch file 'dance.lanch' does not exist"))
    dance.rapp:3:9: error: launch file 'dance.lanch' does not exist
    """

    __slots__ = ()

    def __str__(self) -> str:
        return located('%s: %s' % (self.severity, self.text), self.file, self.line, self.column)

    def as_github(self) -> str:
        """
        The finding as a workflow command of GitHub, which shows it beside the line.

        :returns: str

        >>> print(Finding('a,b.rapp', 3, 9, ERROR, '50% of it: no').as_github())
        ::error file=a%2Cb.rapp,line=3,col=9::50%25 of it: no
        """
        properties = [('file', self.file), ('line', self.line), ('col', self.column)]
        return '::%s %s::%s' % (
            self.severity,
            ','.join('%s=%s' % (name, _escaped(str(value), '%\r\n:,'))
                     for name, value in properties if value is not None),
            _escaped(self.text, '%\r\n'))

    def as_json(self) -> Dict[str, Any]:
        """
        The finding as plain data.

        :returns: dict with ``file``, ``line``, ``column``, ``severity`` and ``text``
        """
        return dict(self._asdict())


def _escaped(text: str, characters: str) -> str:
    return ''.join('%%%02X' % ord(c) if c in characters else c if c.isprintable() else
                   repr(c)[1:-1] for c in text)
