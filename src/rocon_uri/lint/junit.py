"""Findings as a report of test results, in the form of JUnit that catkin and CI servers read."""
from __future__ import annotations

from typing import Dict, List, Mapping, Sequence
from xml.sax.saxutils import escape, quoteattr

from rocon_uri.lint.finding import ERROR, Finding
from rocon_uri.sources.wording import printable

__all__ = ['junit_text']


def junit_text(findings: Sequence[Finding], files: Mapping[str, float]) -> str:
    """
    A report with one test for each file, which fails if there is an error in the file.

    :param findings: sequence of `Finding`
    :param files: mapping of the paths of the files that were checked to the seconds that took
    :returns: str, an XML document

    >>> finding = Finding('a.rapp', 3, 9, ERROR, 'no <launch> at its top', 'launch-no-launch')
    >>> print(junit_text([finding], {'a.rapp': 0.25}))
    <?xml version="1.0" encoding="utf-8"?>
    <testsuite name="rocon_uri_check" tests="1" failures="1" errors="0" time="0.2500">
    <testcase classname="rocon_uri_check" name="a.rapp" time="0.2500">
    <failure message="1 error" type="error">\
a.rapp:3:9: error: no &lt;launch&gt; at its top [launch-no-launch]</failure>
    </testcase>
    </testsuite>
    """
    by_file: Dict[str, List[Finding]] = {path: [] for path in files}
    for finding in findings:
        by_file.setdefault(finding.file_name, []).append(finding)
    cases: List[str] = []
    failures = 0
    for path, found in by_file.items():
        errors = sum(finding.severity == ERROR for finding in found)
        failures += bool(errors)
        text = escape('\n'.join(map(str, found)))
        cases.append('<testcase classname="rocon_uri_check" name=%s time="%.4f">' % (
            quoteattr(printable(path)), files.get(path, 0)))
        if errors:
            cases.append('<failure message="%d error%s" type="error">%s</failure>' % (
                errors, '' if errors == 1 else 's', text))
        elif found:
            cases.append('<system-out>%s</system-out>' % text)
        cases.append('</testcase>')
    return '\n'.join([
        '<?xml version="1.0" encoding="utf-8"?>',
        '<testsuite name="rocon_uri_check" tests="%d" failures="%d" errors="0" time="%.4f">' % (
            len(by_file), failures, sum(files.values())), *cases, '</testsuite>'])
