"""What holds for all that the linter says."""
from __future__ import annotations

import os
from pathlib import Path

from rocon_uri.lint import ERROR, WARNING


def check_findings(findings, folder):
    """Each is one line about a place in a file below the folder."""
    for finding in findings:
        assert finding.severity in (ERROR, WARNING)
        for line in (str(finding), finding.as_github()):
            assert line.isprintable()
        file = Path(os.path.abspath(finding.file_name))
        assert Path(folder) in file.parents
        if finding.line is not None:
            assert 1 <= finding.line <= lines_of(file) + 1 and finding.column >= 1
    assert findings == sorted(findings, key=lambda finding: (
        finding.file_name, finding.line or 0, finding.column or 0))


def lines_of(file):
    """How many lines a file has; those of a missing one are not asked for."""
    assert os.path.isfile(str(file))
    return len(file.read_bytes().decode('utf-8', 'replace').splitlines())
