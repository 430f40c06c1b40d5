"""What the linter has found, and the forms in which it is shown."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, Optional, Union

from rocon_uri.sources.located import Located, located

__all__ = ['ERROR', 'WARNING', 'Finding']

#: It does not work, or not as the file says.
ERROR = 'error'
#: It works, but is probably not what was meant.
WARNING = 'warning'


@dataclass(frozen=True)
class Finding(Located):
    """
    A fault that the linter has found.

    >>> print(Finding('dance.rapp', 3, 9, ERROR, "icon 'dnace.png' does not exist", 'file-missing'))
    dance.rapp:3:9: error: icon 'dnace.png' does not exist [file-missing]
    """

    #: the file
    file_name: str
    #: where in it, counted from 1; None if the whole file is meant
    line: Optional[int]
    #: counted from 1, or None
    column: Optional[int]
    #: `ERROR` or `WARNING`
    severity: str
    #: one sentence without the place
    problem: str
    #: which kind of fault it is, one that ``specs check --explain`` knows
    id: str

    @property
    def sentence(self) -> str:
        """The problem between its severity and its id."""
        return '%s: %s [%s]' % (self.severity, self.problem, self.id)

    def __str__(self) -> str:
        # GitHub takes a line of a log that begins with :: for a command.
        path = './' + self.file_name if self.file_name.lstrip().startswith('::') else self.file_name
        return located(self.sentence, path, self.line, self.column)

    def as_github(self) -> str:
        """
        The finding as a workflow command of GitHub, which shows it beside the line.

        >>> print(Finding('a,b.rapp', 3, 9, ERROR, '50% of it: no', 'cycle').as_github())
        ::error file=a%2Cb.rapp,line=3,col=9,title=cycle::50%25 of it: no
        """
        properties = [('file', self.file_name), ('line', self.line), ('col', self.column),
                      ('title', self.id)]
        return '::%s %s::%s' % (
            self.severity,
            ','.join('%s=%s' % (name, _escaped(str(value), '%\r\n:,'))
                     for name, value in properties if value is not None),
            _escaped(self.problem, '%\r\n'))

    def as_json(self) -> Dict[str, Union[str, int, None]]:
        """
        The finding as plain data.

        :returns: dict with ``file``, ``line``, ``column``, ``severity``, ``id`` and ``text``
        """
        return {'file': self.file_name, 'line': self.line, 'column': self.column,
                'severity': self.severity, 'id': self.id, 'text': self.problem}


def _escaped(text: str, characters: str) -> str:
    return ''.join('%%%02X' % ord(c) if c in characters else c if c.isprintable() else
                   repr(c)[1:-1] for c in text)
