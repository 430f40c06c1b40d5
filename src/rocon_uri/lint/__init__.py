"""
What is wrong with the specs, rapps and interactions of packages, for continuous integration.

It checks more than reading them does: names, types, and whether the files and all else that they
name exist.

>>> [str(finding) for finding in check_packages(['examples/workspace'])]
[]
"""
from __future__ import annotations

import os
from dataclasses import replace
from pathlib import PurePath
from typing import AbstractSet, Iterable, List, Mapping

from rocon_uri.lint.checked_file import is_inside
from rocon_uri.lint.finding import ERROR, WARNING, Finding
from rocon_uri.lint.interactions_files import check_interactions_file, interactions_files
from rocon_uri.lint.manifest import check_manifest
from rocon_uri.lint.rapp_files import check_rapp
from rocon_uri.lint.spec_files import check_spec
from rocon_uri.sources.located import Fault
from rocon_uri.sources.packages import Package, PackageError, find_packages
from rocon_uri.workspace import load_workspace

__all__ = ['ERROR', 'Finding', 'WARNING', 'check_package_index', 'check_packages']


def check_packages(paths: Iterable[str], package_path: Iterable[str] = ()) -> List[Finding]:
    """
    Check all that some packages export, and the ``.interactions`` files in them.

    :param paths: iterable of str, the folders with the packages to check
    :param package_path: iterable of str, the folders with other packages that these may refer to
    :returns: list of `Finding`, by file and line; the path of a file below the working directory
        is relative to it, others are absolute
    """
    faults: List[PackageError] = []
    checked = find_packages(paths, faults)
    return check_package_index(checked, find_packages(package_path), faults)


def check_package_index(checked: Mapping[str, Package], others: Mapping[str, Package],
                        faults: Iterable[Fault] = ()) -> List[Finding]:
    """
    Check packages that were found already.

    :param checked: dict of `rocon_uri.sources.packages.Package` by name, those to check
    :param others: dict of the same, those that these may refer to
    :param faults: the errors of `rocon_uri.sources.packages.find_packages`
    :returns: list of `Finding`, as `check_packages` returns it

    >>> check_package_index({}, {})
    []
    """
    workspace = load_workspace({**others, **checked})
    folders = {name: package.folder for name, package in checked.items()}
    own_folders = set(folders.values())
    findings = [_finding(fault) for fault in faults]
    findings += [_finding(fault) for fault in workspace.faults
                 if _is_in_one_of(_path(fault), own_folders)]
    for name, folder in folders.items():
        findings += check_manifest(checked[name])
        for path in interactions_files(folder):
            findings += check_interactions_file(path, folder, workspace)
    for path, spec in workspace.specs():
        folder = folders.get(spec.name.partition('/')[0], '')
        if folder and is_inside(path, folder):      # else the manifest's finding is enough
            findings += check_spec(spec, path, folder, workspace)
    for rapp in workspace.own_rapps.values():
        folder = folders.get(rapp.package, '')
        if folder and is_inside(rapp.path, folder):
            findings += check_rapp(rapp, folder, workspace)
    return _sorted(findings)


def _is_in_one_of(path: str, folders: AbstractSet[str]) -> bool:
    """Is this a file in one of the folders? A missing file is a fault of the file that names it."""
    return os.path.isfile(path) and not folders.isdisjoint(
        map(str, PurePath(os.path.normpath(path)).parents))


def _path(fault: Fault) -> str:
    return str(fault.filename if isinstance(fault, OSError) else fault.file_name)


def _finding(fault: Fault) -> Finding:
    if isinstance(fault, OSError):
        return Finding(_path(fault), None, None, ERROR,
                       'cannot be read: %s' % (fault.strerror or fault))
    return Finding(_path(fault), fault.line, fault.column, ERROR, fault.sentence)


def _sorted(findings: Iterable[Finding]) -> List[Finding]:
    """Each finding once, by its place, with the path that is the shortest to read."""
    here = os.getcwd()
    shown = {finding: os.path.relpath(finding.file_name)
             if is_inside(finding.file_name, here) else finding.file_name for finding in findings}
    return sorted({replace(finding, file_name=path): None for finding, path in shown.items()},
                  key=lambda finding: (finding.file_name, finding.line or 0, finding.column or 0))
