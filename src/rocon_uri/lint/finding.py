"""What the linter has found, and the forms in which it is shown."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, List, Optional, Union
from xml.sax.saxutils import escape, quoteattr

from rocon_uri.sources.located import Located

__all__ = ['ERROR', 'WARNING', 'Finding', 'junit_text']

#: It does not work, or not as the file says.
ERROR = 'error'
#: It works, but is probably not what was meant.
WARNING = 'warning'


@dataclass(frozen=True)
class Finding(Located):
    """
    A fault that the linter has found.

    >>> print(Finding('dance.rapp', 3, 9, ERROR, "launch file 'dance.lanch' does not exist"))
    dance.rapp:3:9: error: launch file 'dance.lanch' does not exist
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

    @property
    def sentence(self) -> str:
        """The problem after its severity."""
        return '%s: %s' % (self.severity, self.problem)

    def as_github(self) -> str:
        """
        The finding as a workflow command of GitHub, which shows it beside the line.

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


def junit_text(name: str, findings: List[Finding]) -> str:
    """
    An XML report of one test, in the form of JUnit. The test fails if a finding is an error.

    :param str name: what was checked

    >>> print(junit_text('ours', [Finding('a.rapp', 3, 9, ERROR, 'no <launch> file')]))
    <?xml version="1.0" encoding="utf-8"?>
    <testsuite name="rocon_uri_check" tests="1" failures="1" errors="0" time="0">
    <testcase classname="rocon_uri_check" name="ours" time="0">
    <failure message="1 error" type="error">a.rapp:3:9: error: no &lt;launch&gt; file</failure>
    </testcase>
    </testsuite>
    """
    errors = sum(finding.severity == ERROR for finding in findings)
    lines = ['<?xml version="1.0" encoding="utf-8"?>',
             '<testsuite name="rocon_uri_check" tests="1" failures="%d" errors="0" time="0">'
             % bool(errors),
             '<testcase classname="rocon_uri_check" name=%s time="0">' % quoteattr(name)]
    text = escape('\n'.join(map(str, findings)))
    if errors:
        lines.append('<failure message="%d error%s" type="error">%s</failure>' % (
            errors, '' if errors == 1 else 's', text))
    elif findings:
        lines.append('<system-out>%s</system-out>' % text)
    return '\n'.join(lines + ['</testcase>', '</testsuite>'])


def _escaped(text: str, characters: str) -> str:
    return ''.join('%%%02X' % ord(c) if c in characters else c if c.isprintable() else
                   repr(c)[1:-1] for c in text)
