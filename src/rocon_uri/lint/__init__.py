"""
What is wrong with the specs, apps and interactions of packages, for continuous integration.

It checks more than reading them does: names, types, and whether the files and all else that they
name exist.

>>> [str(finding) for finding in check_packages(['examples/workspace'])]
[]
"""
from __future__ import annotations

import os
from dataclasses import replace
from functools import partial
from pathlib import PurePath
from time import perf_counter
from typing import (
    AbstractSet, Callable, Collection, Dict, Iterable, Iterator, List, Mapping, NamedTuple,
    Optional, Sequence, Tuple)

from rocon_uri.apps.installed import installed_files
from rocon_uri.lint.app_files import check_app_file
from rocon_uri.lint.checked_file import is_inside
from rocon_uri.lint.finding import ERROR, WARNING, Finding
from rocon_uri.lint.ignoring import Ignored, read_configuration, without_ignored
from rocon_uri.lint.interactions_files import check_interactions_file
from rocon_uri.lint.manifest import check_manifest
from rocon_uri.lint.package_files import package_files
from rocon_uri.lint.rapp_files import check_rapp
from rocon_uri.lint.spec_files import check_spec
from rocon_uri.lint.unexported import check_unexported, listed_apps
from rocon_uri.sources.located import Fault
from rocon_uri.sources.packages import Package, PackageError, find_packages
from rocon_uri.sources.wording import cannot_be_read
from rocon_uri.workspace import Workspace, load_workspace

__all__ = ['ERROR', 'Checked', 'Finding', 'WARNING', 'check_package_index', 'check_packages']


class Checked(NamedTuple):
    """
    What was checked.

    The path of a file below the working directory is relative to it, others are absolute.
    """

    #: what was found, by file and line
    findings: List[Finding]
    #: the seconds that it took to check each file, by its path; 0 if it could not be read
    files: Dict[str, float]


def check_packages(paths: Iterable[str], package_path: Iterable[str] = ()) -> List[Finding]:
    """
    Check all that some packages export, and the ``.interactions`` files in them.

    :param paths: iterable of str, the folders with the packages to check
    :param package_path: iterable of str, the folders with other packages that these may refer to
    :returns: list of `Finding`, as `Checked` has it
    """
    faults: List[PackageError] = []
    checked = find_packages(paths, faults)
    return check_package_index(checked, find_packages(package_path), faults).findings


def check_package_index(checked: Mapping[str, Package], others: Mapping[str, Package],
                        faults: Iterable[Fault] = (), only: Optional[Sequence[str]] = None,
                        ignore: Collection[str] = (), findings: Iterable[Finding] = ()) -> Checked:
    """
    Check packages that were found already.

    :param checked: dict of `rocon_uri.sources.packages.Package` by name, those to check
    :param others: dict of the same, those that these may refer to
    :param faults: the errors of `rocon_uri.sources.packages.find_packages`
    :param only: sequence of str, the absolute paths of the files, or of the folders with the files,
        that are checked; all in the packages where left out
    :param ignore: collection of str, the ids of findings that are left out
    :param findings: iterable of `Finding`, those that are known already
    :returns: `Checked`

    >>> check_package_index({}, {}).findings
    []
    """
    workspace = load_workspace({**others, **checked})
    # A missing file is a fault of the file that names it.
    folders = {package.folder for package in checked.values()}
    found = [_finding(fault) for fault in workspace.faults
             if os.path.isfile(_path(fault)) and _is_in_one_of(_path(fault), folders)]
    ignored: List[Ignored] = []
    seconds: Dict[str, float] = {}
    for path, check in _checks(checked, workspace, ignored):
        begin = perf_counter()
        found += check()
        seconds[path] = seconds.get(path, 0) + perf_counter() - begin
    if only is not None:
        wanted = frozenset(only)
        found = [finding for finding in found if _is_in_one_of(finding.file_name, wanted)]
        seconds = {path: time for path, time in seconds.items() if _is_in_one_of(path, wanted)}
    found += [*map(_finding, faults), *findings]
    return _shown(without_ignored(found, ignore, ignored), seconds)


def _checks(checked: Mapping[str, Package], workspace: Workspace, ignored: List[Ignored],
            ) -> Iterator[Tuple[str, Callable[[], List[Finding]]]]:
    """The checks of each file. That of a configuration adds to what is ignored."""
    listed = listed_apps(workspace.packages.values())
    for package in checked.values():
        folder, paths = package.folder, package_files(package.folder)
        entries, faults = read_configuration(folder)
        ignored += entries
        if faults:
            yield faults[0].file_name, partial(list, faults)
        yield package.manifest, partial(check_manifest, package)
        yield package.manifest, partial(check_unexported, package, paths, listed)
        interactions = [path for path in paths if path.endswith('.interactions')]
        for path in interactions:
            others = [other for other in interactions if other != path]
            yield path, partial(check_interactions_file, path, folder, workspace, others)
    for path, spec in workspace.specs():
        folder = _folder(spec.name, checked)
        if folder and is_inside(path, folder):      # else the manifest's finding is enough
            yield path, partial(check_spec, spec, path, folder, workspace)
    for rapp in workspace.own_rapps.values():
        folder = _folder(rapp.name, checked)
        if folder and is_inside(rapp.path, folder):
            yield rapp.path, partial(check_rapp, rapp, folder, workspace)
    for package in checked.values():
        for path in [*package.files('rocon_uri', 'rules'), *installed_files(package)]:
            if is_inside(path, package.folder) and os.path.isfile(path):
                yield path, list    # what is wrong with it was found when it was read
    for app in workspace.app_files.values():
        folder = _folder(app.name, checked)
        if folder:
            yield app.path, partial(check_app_file, app, folder, workspace)


def _folder(name: str, checked: Mapping[str, Package]) -> str:
    """The folder of the package that a name begins with; '' if it is not checked."""
    package = checked.get(name.partition('/')[0])
    return package.folder if package else ''


def _is_in_one_of(path: str, paths: AbstractSet[str]) -> bool:
    """Is this one of the files, or in one of the folders?"""
    path = os.path.normpath(path)
    return path in paths or not paths.isdisjoint(map(str, PurePath(path).parents))


def _path(fault: Fault) -> str:
    return str(fault.filename if isinstance(fault, OSError) else fault.file_name)


def _finding(fault: Fault) -> Finding:
    if isinstance(fault, OSError):
        return Finding(file_name=_path(fault), line=None, column=None, severity=ERROR,
                       problem=cannot_be_read(fault), id='cannot-read')
    return Finding(file_name=_path(fault), line=fault.line, column=fault.column, severity=ERROR,
                   problem=fault.sentence, id=fault.id)


def _shown(findings: Iterable[Finding], seconds: Mapping[str, float]) -> Checked:
    """Each finding once, by its place, with the paths that are the shortest to read."""
    here = os.getcwd()

    def shown(path: str) -> str:
        return os.path.relpath(path, here) if is_inside(path, here) else path

    placed = {replace(finding, file_name=shown(finding.file_name)): None for finding in findings}
    files: Dict[str, float] = dict.fromkeys((finding.file_name for finding in placed), 0)
    files.update((shown(path), time) for path, time in seconds.items())
    return Checked(
        sorted(placed, key=lambda finding: (
            finding.file_name, finding.line or 0, finding.column or 0)),
        {path: files[path] for path in sorted(files)})
