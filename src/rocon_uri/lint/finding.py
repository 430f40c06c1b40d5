"""One thing that the linter has found, and the forms in which it is shown."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, Optional, Union

from rocon_uri.sources.located import Located

__all__ = ['ERROR', 'WARNING', 'Finding']

#: It does not work, or not as it says.
ERROR = 'error'
#: It works, but is probably not what was meant.
WARNING = 'warning'


@dataclass(frozen=True)
class Finding(Located):
    """
    What is wrong, and where.

    >>> print(Finding('dance.rapp', 3, 9, ERROR, "launch file 'dance.lanch' does not exist"))
    dance.rapp:3:9: error: launch file 'dance.lanch' does not exist
    """

    #: the file
    file_name: str
    #: where in it, counted from 1; None if it concerns the whole file
    line: Optional[int]
    #: counted from 1, or None
    column: Optional[int]
    #: `ERROR` or `WARNING`
    severity: str
    #: one sentence without the place
    problem: str

    @property
    def sentence(self) -> str:
        """The problem, with its severity in front."""
        return '%s: %s' % (self.severity, self.problem)

    def as_github(self) -> str:
        """
        The finding as a workflow command of GitHub, which shows it beside the line.

        :returns: str

        >>> print(Finding('a,b.rapp', 3, 9, ERROR, '50% of it: no').as_github())
        ::error file=a%2Cb.rapp,line=3,col=9::50%25 of it: no
        """
        properties = [('file', self.file_name), ('line', self.line), ('col', self.column)]
        return '::%s %s::%s' % (
            self.severity,
            ','.join('%s=%s' % (name, _escaped(str(value), '%\r\n:,'))
                     for name, value in properties if value is not None),
            _escaped(self.problem, '%\r\n'))

    def as_json(self) -> Dict[str, Union[str, int, None]]:
        """
        The finding as plain data.

        :returns: dict with ``file``, ``line``, ``column``, ``severity`` and ``text``
        """
        return {'file': self.file_name, 'line': self.line, 'column': self.column,
                'severity': self.severity, 'text': self.problem}


def _escaped(text: str, characters: str) -> str:
    return ''.join('%%%02X' % ord(c) if c in characters else c if c.isprintable() else
                   repr(c)[1:-1] for c in text)
