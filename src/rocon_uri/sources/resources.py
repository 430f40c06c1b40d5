"""
Resource names, ``package/file``: the file is found anywhere in the package, as roslib finds it.

>>> from rocon_uri.sources.packages import find_packages
>>> resources = Resources(find_packages(['examples/workspace']))
>>> resources.find('cafe_rapps/radio.launch').problem is None
True
>>> print(resources.find('cafe_rapps/raido.launch').problem)
does not exist: package 'cafe_rapps' has no file 'raido.launch' (did you mean \
'cafe_rapps/radio.launch'?)
"""
from __future__ import annotations

import os
import re
import stat
from functools import lru_cache
from typing import Callable, Dict, Iterator, List, Mapping, NamedTuple, Optional, Tuple

from rocon_uri.sources.packages import (
    MANIFEST, Package, PackageError, package_from_manifest)
from rocon_uri.sources.walk import walk
from rocon_uri.sources.wording import NearMisses, did_you_mean, quoted

__all__ = ['AMBIGUOUS', 'MISSING', 'NotAPath', 'Resource', 'Resources', 'not_a_path']

#: the kinds of faults: no file has the name
MISSING = 'missing'
#: several files of the package have it
AMBIGUOUS = 'ambiguous'

_MAX_NAMES = 200    # of files with one extension; among more no near miss is looked for


class Resource(NamedTuple):
    """
    What a resource name stands for.

    >>> Resource('ours/dance.launch', '/src/ours/dance.launch').kind is None
    True
    """

    #: ``package/file``, as it is written
    name: str
    #: the file; None where there is none, or several
    path: Optional[str] = None
    #: `MISSING` or `AMBIGUOUS`; None where there is exactly one file
    kind: Optional[str] = None
    #: what is wrong, without the name; None where nothing is
    problem: Optional[str] = None


class Resources:
    """
    The files of packages. The folder of each is walked once, when it is first asked for.

    :param packages: mapping of `rocon_uri.sources.packages.Package` by name
    """

    def __init__(self, packages: Mapping[str, Package]) -> None:
        self._packages = packages
        self._files: Dict[str, Dict[str, List[str]]] = {}
        self._near_misses = NearMisses()

    def find(self, name: str, extension: str = '') -> Resource:
        """
        The file of a name.

        :param str name: ``package/file``
        :param str extension: what the name of the file has, and ``name`` has not
        :returns: `Resource`; it raises nothing
        """
        return self._find(name, lambda package, file: self._files_of(package.folder).get(file, []),
                          extension)

    def find_executable(self, name: str) -> Resource:
        """
        The program of a name: what is built or installed, else a file of the package.

        :param str name: ``package/program``
        :returns: `Resource`; it raises nothing
        """
        found = self._find(name, self._programs)
        return found if found.path is None or _is_executable(found.path) else Resource(
            name=name, path=None, kind=MISSING, problem='is not executable')

    def _find(self, name: str, files: Callable[[Package, str], List[str]],
              extension: str = '') -> Resource:
        package_name, slash, file = name.partition('/')
        if not package_name or not file or '/' in file:
            return Resource(name=name, path=None, kind=MISSING,
                            problem='is not of the form package/file')
        package = self._packages.get(package_name)
        if package is None:
            meant = did_you_mean(self._near_misses.of(package_name, self._packages))
            return Resource(
                name=name, path=None, kind=MISSING,
                problem='does not exist: there is no package %s%s' % (quoted(package_name), meant))
        paths = files(package, file + extension)
        if len(paths) == 1:
            return Resource(name=name, path=paths[0])
        if paths:
            return Resource(
                name=name, path=None, kind=AMBIGUOUS,
                problem='is ambiguous: package %s has %s' % (
                    quoted(package_name), ' and '.join(
                        quoted(os.path.relpath(path, package.folder)) for path in paths[:3])))
        return Resource(
            name=name, path=None, kind=MISSING,
            problem='does not exist: package %s has no file %s%s' % (
                quoted(package_name), quoted(file + extension),
                did_you_mean(self._alike(package, file, extension))))

    def _programs(self, package: Package, file: str) -> List[str]:
        beside = [os.path.dirname(os.path.dirname(package.folder))]     # of PREFIX/share/package
        prefixes = os.environ.get('CMAKE_PREFIX_PATH', '').split(os.pathsep)
        for prefix in filter(None, beside + prefixes):
            path = os.path.join(prefix, 'lib', package.name, file)
            if os.path.isfile(path):
                return [path]
        found = self._files_of(package.folder).get(file, [])
        return list(filter(_is_executable, found)) or found

    def _alike(self, package: Package, file: str, extension: str) -> List[str]:
        stem, own_extension = os.path.splitext(file + extension)
        stems = {os.path.splitext(other)[0] for other in self._files_of(package.folder)
                 if other.endswith(own_extension)}
        near = self._near_misses.of(stem, stems) if len(stems) <= _MAX_NAMES else []
        return ['%s/%s%s' % (package.name, other, '' if extension else own_extension)
                for other in near]

    def _files_of(self, folder: str) -> Dict[str, List[str]]:
        """The paths below the folder of a package by the name of the file."""
        if folder not in self._files:
            self._files[folder] = _files_by_name.__wrapped__(folder)
        return self._files[folder]


class NotAPath(NamedTuple):
    """What stands where a path is expected, and is another name of a file."""

    #: what is wrong, without the name
    problem: str
    #: the paths of the files that have the name, relative to the folder that paths are relative to
    paths: Tuple[str, ...]


_OTHER_NAMES = (    # and what they are called
    (re.compile(r'\$\(find\s+([^\s)]+)\s*\)/+(.+)').fullmatch, 'is written with $(find)'),
    (re.compile(r'package://([^/]+)/+(.+)').fullmatch, 'is a package:// URL'),
    (re.compile(r'([A-Za-z0-9][A-Za-z0-9_-]*)/([^/]+)').fullmatch, 'is a resource name'),
    (re.compile(r'([A-Za-z0-9][A-Za-z0-9_-]*)/(.+)').fullmatch,
     'begins with the name of a package'),
)


def not_a_path(name: str, folder: str, package_folder: Optional[str]) -> Optional[NotAPath]:
    """
    What is wrong with the name of a file that is not there, if it is not meant as a path.

    :param str name: what was written: ``package/file``, as in rapps before 2014,
        ``$(find package)/path`` or ``package://package/path``
    :param str folder: what a path would be relative to
    :param package_folder: str, the folder of the package of the file that says it; None if it is in
        no package
    :returns: `NotAPath`, or None for what may be a path

    >>> folder = 'examples/workspace/cafe_rapps/rapps/radio'
    >>> not_a_path('cafe_rapps/radio.launch', folder, 'examples/workspace/cafe_rapps')
    NotAPath(problem='is a resource name, expected a path relative to the file that names it', \
paths=('radio.launch',))
    >>> not_a_path('launch/radio.launch', folder, 'examples/workspace/cafe_rapps')
    """
    if package_folder is None:
        return None
    own_name = _package_name(package_folder)
    for match, what in _OTHER_NAMES:
        found = match(name)
        if found is None:
            continue
        package, file = found.groups()
        beside = os.path.join(os.path.dirname(os.path.abspath(package_folder)), package, MANIFEST)
        if name.startswith(('$', 'package://')) or package == own_name or os.path.isfile(beside):
            paths = _named(file, package_folder) if package == own_name else []
            where = '' if package == own_name else ', in the same package'
            return NotAPath(what + ', expected a path relative to the file that names it' + where,
                            tuple(os.path.relpath(path, folder) for path in paths[:3]))
    return None


def _named(file: str, package_folder: str) -> List[str]:
    """The files of a package that a path in it, or a name alone, stands for."""
    path = os.path.join(package_folder, file)
    return [path] if os.path.isfile(path) else [
        path for path in _files_by_name(package_folder).get(file, []) if os.path.isfile(path)]


# What these remember may be out of date in a server: then a suggestion is missing.

@lru_cache(maxsize=16)
def _package_name(package_folder: str) -> str:
    try:
        return package_from_manifest(os.path.join(package_folder, MANIFEST)).name
    except PackageError:
        return os.path.basename(package_folder)


@lru_cache(maxsize=16)
def _files_by_name(folder: str) -> Dict[str, List[str]]:
    """The paths below a folder by the name of the file."""
    files: Dict[str, List[str]] = {}
    for path in _files_below(folder):
        files.setdefault(os.path.basename(path), []).append(path)
    return files


def _files_below(folder: str) -> Iterator[str]:
    """All files, but for hidden folders; links are followed, and a folder is visited once."""
    visited = set()
    for path, folders, files in walk(folder, follow_links=True):
        here: Tuple[int, int] = (0, 0)
        try:
            status = os.stat(path)
            here = status.st_dev, status.st_ino
        except OSError:     # it has gone
            pass
        if here in visited:
            folders.clear()
            continue
        visited.add(here)
        yield from (os.path.join(path, name) for name in files)


def _is_executable(path: str) -> bool:
    try:
        mode = os.stat(path).st_mode
    except OSError:
        return False
    return mode & (stat.S_IRUSR | stat.S_IXUSR) == stat.S_IRUSR | stat.S_IXUSR
