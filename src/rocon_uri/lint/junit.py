"""Findings as a report of test results, in the form of JUnit that catkin and CI servers read."""
from __future__ import annotations

from typing import List
from xml.sax.saxutils import escape, quoteattr

from rocon_uri.lint.finding import ERROR, Finding

__all__ = ['junit_text']


def junit_text(name: str, findings: List[Finding]) -> str:
    """
    A report of one test, which fails if there is an error among the findings.

    :param str name: what was checked
    :param findings: list of `Finding`
    :returns: str, an XML document

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
