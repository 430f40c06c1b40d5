"""
Finds the apps and specs of a package that nobody sees, since no export leads to them.

Nothing is looked for below a folder ``test`` or ``tests``. Interactions are named by no export, and
rules files cannot be told from other YAML.
"""
from __future__ import annotations

import os
from typing import Collection, Iterable, List, Set

from rocon_uri.apps.app_file import InvalidApp
from rocon_uri.apps.installed import installed_apps, installed_files
from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.finding import Finding
from rocon_uri.lint.manifest import FILE_EXPORTS
from rocon_uri.sources.packages import Package
from rocon_uri.sources.wording import near_misses, quoted
from rocon_uri.sources.yaml_data import YamlError
from rocon_uri.sources.yaml_source import load, read_file

__all__ = ['check_unexported', 'listed_apps']

_SUFFIXES = ('.app', '.installed', '.rapp', '.yaml', '.yml')
_TAGS = {'interface': 'capability_interface', 'provider': 'capability_provider',
         'semantic_interface': 'semantic_capability_interface'}


def listed_apps(packages: Iterable[Package]) -> Set[str]:
    """
    The apps that ``.installed`` files list, which may be apps of other packages.

    :param packages: iterable of `Package`, those that the files are in
    :returns: set of str, ``package/name``
    """
    names: Set[str] = set()
    for package in packages:
        for path in installed_files(package):
            try:
                names.update(name for name, _ in installed_apps(path))
            except InvalidApp:      # which is a finding
                continue
    return names


def check_unexported(package: Package, paths: Iterable[str], listed: Collection[str]
                     ) -> List[Finding]:
    """
    Find the apps and specs of a package that no export leads to.

    :param Package package: the package
    :param paths: iterable of str, the files in it
    :param listed: collection of str, as `listed_apps` returns it
    :returns: list of `Finding`
    """
    exported: Set[str] = set()
    for tag in FILE_EXPORTS:
        exported.update(map(os.path.realpath, package.files(tag)))
    installed = set(map(os.path.realpath, installed_files(package)))
    findings: List[Finding] = []
    for path in paths:
        if not path.endswith(_SUFFIXES) or _is_test(path, package):
            continue
        file = CheckedFile(path, package.folder)
        name, suffix = os.path.splitext(os.path.basename(path))
        if suffix == '.installed' and os.path.realpath(path) not in installed:
            file.warn('the file is in no folder that the package exports as app_dir, so '
                      'app_manager does not read it', (1, 1), 'outside-app-dir')
        elif suffix == '.app' and '%s/%s' % (package.name, name) not in listed:
            file.warn('no .installed file lists this app, so app_manager does not know it '
                      "(expected 'app: %s/%s')" % (package.name, name), (1, 1), 'not-listed')
        elif os.path.realpath(path) not in exported:
            tag = _tag_of(path)
            if tag:
                file.warn(
                    'no export names this file, so nobody sees it (expected %s in package.xml)'
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
    try:
        content = read_file(path)
        if b'spec_type' not in content or b'spec_version' not in content:
            return ''       # as nearly all, without reading it as YAML
        data = load(content, path)
    except (OSError, YamlError):
        return ''
    if not isinstance(data, dict) or 'spec_version' not in data:
        return ''
    spec_type = str(data.get('spec_type'))
    return next((_TAGS[meant] for meant in [spec_type, *near_misses(spec_type, _TAGS)]
                 if meant in _TAGS), '')
