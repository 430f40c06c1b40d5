"""Checks a ``package.xml`` that names its package, and its exports."""
from __future__ import annotations

from typing import List

from capabilities.discovery import EXPORTS, catkin_package
from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.finding import Finding
from rocon_uri.sources.packages import Package, PackageError
from rocon_uri.sources.wording import quoted

__all__ = ['check_manifest']

_FILE_EXPORTS = EXPORTS + ('rocon_app',)    # those whose text is the path of a file


def check_manifest(package: Package) -> List[Finding]:
    """
    Check that catkin accepts a package, and that each exported file exists and is exported once.

    :returns: list of `Finding`
    """
    file = CheckedFile(package.manifest, package.folder)
    try:
        catkin_package(package.manifest)
    except PackageError as error:
        file.error(error.problem, (error.line, error.column))
    seen = set()
    for export in package.exports:
        name = export.file('rules' if export.tag == 'rocon_uri' else '')
        if export.tag not in _FILE_EXPORTS and not (export.tag == 'rocon_uri' and name):
            continue
        place = export.line, export.column
        exported = file.check_file(name, 'exported file', place, package.folder)
        if exported in seen:
            file.error('%s is exported twice' % quoted(name), place)
        elif exported is not None:
            seen.add(exported)
    return file.findings
