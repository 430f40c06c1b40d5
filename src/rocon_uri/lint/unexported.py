"""
Finds the apps and specs of a package that nobody sees, since no export names them.

Nothing is looked for below a folder ``test`` or ``tests``. Interactions are named by no export, and
files of rules cannot be told from other YAML.
"""
from __future__ import annotations

import os
from typing import Iterable, List, Set

from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.finding import Finding
from rocon_uri.lint.manifest import FILE_EXPORTS
from rocon_uri.sources.packages import Package
from rocon_uri.sources.wording import quoted
from rocon_uri.sources.yaml_data import YamlError
from rocon_uri.sources.yaml_source import load, read_file

__all__ = ['check_unexported']

_TAGS = {'interface': 'capability_interface', 'provider': 'capability_provider',
         'semantic_interface': 'semantic_capability_interface'}


def check_unexported(package: Package, paths: Iterable[str]) -> List[Finding]:
    """
    Find the rapps and specs of a package that no export names.

    :param Package package: the package
    :param paths: iterable of str, the files in it
    :returns: list of `Finding`
    """
    exported: Set[str] = set()
    for tag in FILE_EXPORTS:
        exported.update(map(os.path.realpath, package.files(tag)))
    findings: List[Finding] = []
    for path in paths:
        tag = '' if _is_test(path, package) or os.path.realpath(path) in exported else _tag_of(path)
        if tag:
            file = CheckedFile(path, package.folder)
            file.warn('no export names this file, so nobody sees it (expected %s in package.xml)'
                      % quoted('<%s>%s</%s>' % (tag, os.path.relpath(path, package.folder), tag)),
                      (1, 1), 'not-exported')
            findings += file.findings
    return findings


def _is_test(path: str, package: Package) -> bool:
    folders = os.path.relpath(path, package.folder).split(os.sep)[:-1]
    return 'test' in folders or 'tests' in folders


def _tag_of(path: str) -> str:
    """The tag of the export that a file should have; '' if it should have none."""
    if path.endswith('.rapp'):
        return 'rocon_app'
    if not path.endswith(('.yaml', '.yml')):
        return ''
    try:
        content = read_file(path)
        if b'spec_type' not in content or b'spec_version' not in content:
            return ''       # as nearly all, without reading it as YAML
        data = load(content, path)
    except (OSError, YamlError):
        return ''
    is_spec = isinstance(data, dict) and 'spec_version' in data
    return _TAGS.get(str(data.get('spec_type')), '') if is_spec else ''
