"""What is to be checked: folders, packages by name and single files, as somebody gives them."""
from __future__ import annotations

import os
from typing import Dict, Iterable, List, Mapping, NamedTuple, Optional

from rocon_uri.lint.finding import WARNING, Finding
from rocon_uri.sources.packages import (
    MANIFEST, Package, PackageError, duplicate_package, find_packages, package_from_manifest)
from rocon_uri.sources.wording import did_you_mean, near_misses, quoted_path

__all__ = ['Targets', 'find_targets']

_SUFFIXES = ('.rapp', '.app', '.installed', '.interactions')    # of files that belong to a package


class Targets(NamedTuple):
    """What is to be checked."""

    #: the packages by name
    packages: Dict[str, Package]
    #: the absolute paths of the folders and files in them that are checked
    only: List[str]
    #: the faults of manifests
    faults: List[PackageError]
    #: the findings about files that are in no package
    findings: List[Finding]
    #: what is wrong with what was given, one line each
    errors: List[str]
    #: are there only whole packages among them?
    are_whole: bool


def find_targets(given: Iterable[str], around: Mapping[str, Package]) -> Targets:
    """
    The packages and files that are to be checked.

    A folder without a package below it, and a file, belong to the package that they are in. A file
    in no package is left out, unless its name says that it should be in one.

    :param given: iterable of str, paths of folders and files, and names of packages
    :param around: dict of the packages that can be named
    :returns: `Targets`

    >>> find_targets(['examples/workspace/cafe_cart/package.xml'], {}).packages.keys()
    dict_keys(['cafe_cart'])
    """
    finder = _Finder()
    for name in given:
        if os.path.isdir(name):
            finder.add_folder(name)
        elif os.path.lexists(name):
            finder.are_whole = False
            if not finder.add_part(name) and name.endswith(_SUFFIXES):
                finder.findings.append(Finding(
                    file_name=os.path.abspath(name), line=None, column=None, severity=WARNING,
                    problem='the file is in no package, so nobody sees it', id='no-package'))
        elif name in around:
            finder.add(around[name])
        else:
            finder.errors.append(
                '%s is not a file, a directory or a package on the package path%s' % (
                    quoted_path(name), did_you_mean(near_misses(name, around))))
    return Targets(packages=finder.packages, only=finder.only, faults=finder.faults,
                   findings=finder.findings, errors=finder.errors, are_whole=finder.are_whole)


class _Finder:
    """Collects what `Targets` has."""

    def __init__(self) -> None:
        self.packages: Dict[str, Package] = {}
        self.only: List[str] = []
        self.faults: List[PackageError] = []
        self.findings: List[Finding] = []
        self.errors: List[str] = []
        self.are_whole = True

    def add(self, package: Package) -> None:
        """Take a whole package."""
        if self._is_first(package):
            self.only.append(package.folder)

    def add_folder(self, path: str) -> None:
        """Take the packages below a folder, or what is below it in the package that it is in."""
        faults: List[PackageError] = []
        found = find_packages([path], faults)
        self.faults += faults
        for package in found.values():
            self.add(package)
        if not found and not faults and not self.add_part(path):
            self.errors.append('%s has no package in it' % quoted_path(path))

    def add_part(self, path: str) -> bool:
        """Take a file or a folder in a package, if it is in one."""
        path = os.path.abspath(path)
        manifest = _manifest_above(path)
        if manifest is None:
            return False
        self.are_whole = False
        try:
            package = package_from_manifest(manifest)
            if self._is_first(package):
                self.only.append(path)
        except PackageError as error:
            self.faults.append(error)
        return True

    def _is_first(self, package: Package) -> bool:
        """Does no other package have its name? Else that is a fault."""
        first = self.packages.setdefault(package.name, package)
        if first.folder == package.folder:
            return True
        self.faults.append(duplicate_package(package, first))
        return False


def _manifest_above(path: str) -> Optional[str]:
    """The package.xml of the package that a file or a folder is in; None if there is none."""
    folder = os.path.dirname(path)
    if os.path.basename(path) == MANIFEST:
        return path
    while not os.path.isfile(os.path.join(folder, MANIFEST)):
        folder, below = os.path.dirname(folder), folder
        if folder == below:
            return None
    return os.path.join(folder, MANIFEST)
