"""
Finding the capability specs that packages export, and indexing them.

A package exports specs in its ``package.xml``, by paths that are relative to the package::

    <export>
      <capability_interface>interfaces/RGBCamera.yaml</capability_interface>
      <semantic_capability_interface>interfaces/FrontRGBCamera.yaml</semantic_capability_interface>
      <capability_provider>providers/rgb_camera.yaml</capability_provider>
    </export>

Three steps lead from the folders of a package path to a `SpecIndex`:

>>> packages = package_index_from_package_path(['test/workspace'])
>>> spec_files = spec_file_index_from_package_index(packages)
>>> spec_index, errors = spec_index_from_spec_file_index(spec_files)

What is wrong with one package or one spec is reported, and costs only that one and what stands on
it. A path that leads out of its package is followed.
"""
from __future__ import annotations

import logging
import os
from xml.parsers.expat import ErrorString, ExpatError

from catkin_pkg.package import PACKAGE_MANIFEST_FILENAME, InvalidPackage, parse_package_string

from capabilities.spec_index import (
    DuplicateNameException, InterfaceNameNotFoundException, SpecIndex)
from capabilities.specs.common import InvalidSpec
from capabilities.specs.interface import capability_interface_from_file_path
from capabilities.specs.provider import capability_provider_from_file_path
from capabilities.specs.semantic_interface import semantic_capability_interface_from_file_path
from rocon_uri.sources.located import LocatedError
from rocon_uri.sources.wording import quoted, quoted_path
from rocon_uri.sources.yaml_data import MAX_SIZE
from rocon_uri.sources.yaml_source import read_file

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Callable, Dict, Iterable, Iterator, List, Optional, Tuple, Union

    from catkin_pkg.package import Package

    SpecFileIndex = Dict[str, Dict[str, List[str]]]

__all__ = ['DuplicateNameException', 'InterfaceNameNotFoundException', 'PackageError', 'SpecIndex',
           'package_index_from_package_path', 'spec_file_index_from_package_index',
           'spec_index_from_spec_file_index']

#: the exports that name specs, in the order in which they are indexed
EXPORTS = ('capability_interface', 'semantic_capability_interface', 'capability_provider')

_IGNORE_MARKERS = frozenset(['AMENT_IGNORE', 'CATKIN_IGNORE', 'COLCON_IGNORE'])

_logger = logging.getLogger('capabilities.discovery')


class PackageError(LocatedError):
    """
    A package that is left out: there is one of that name already, or its manifest is at fault.

    Its attributes are those of `rocon_uri.sources.located.LocatedError`; ``file_name`` is its
    ``package.xml``.

    >>> print(PackageError('no element found', 'a_package/package.xml', 3, 1))
    a_package/package.xml:3:1: no element found
    """


def package_index_from_package_path(package_paths: Union[str, Iterable[str]],
                                    errors: Optional[List[Any]] = None) -> Dict[str, Package]:
    """
    The packages below some folders.

    They are looked for as ``catkin_pkg.packages.find_packages`` does: no package within another,
    nothing in a hidden folder or in one with a ``CATKIN_IGNORE`` file. A folder that symbolic links
    lead to more than once is visited once. A folder that is not there has no packages.

    :param package_paths: the folders, an iterable of str, or one str. A package in an earlier one
        stands for those of its name in later ones.
    :param list errors: what is wrong is appended to it, as `PackageError`: a package.xml that is
        not valid, and a package that is twice below the same folder, of which the first counts.
        It is logged in any case.
    :returns: dict from the name to the ``catkin_pkg.package.Package``, whose ``filename`` is the
        absolute path of its package.xml

    >>> package_index_from_package_path(['no/such/folder'])
    {}
    """
    if isinstance(package_paths, str):
        package_paths = [package_paths]
    packages: Dict[str, Package] = {}
    for path in filter(None, package_paths):    # an empty one is not the current folder
        found: Dict[str, Package] = {}
        for folder in _package_folders(os.path.abspath(path)):
            try:
                package = _package(os.path.join(folder, PACKAGE_MANIFEST_FILENAME))
                if package.name in found:
                    raise PackageError('package %s is there already, in %s' % (
                        quoted(package.name), quoted_path(found[package.name].filename)),
                        package.filename)
                found[package.name] = package
            except PackageError as error:
                _logger.warning('package left out: %s', error)
                if errors is not None:
                    errors.append(error)
        for name, package in found.items():
            packages.setdefault(name, package)
    return packages


def _package_folders(path: str) -> Iterator[str]:
    """
    The folders of packages below a path, in the order of their names.

    Not ``catkin_pkg.packages.find_package_paths``, which follows symbolic links round in circles.
    """
    visited = set()
    for folder, subfolders, files in os.walk(path, followlinks=True):
        status = os.stat(folder)
        identity = status.st_dev, status.st_ino
        if identity in visited or not _IGNORE_MARKERS.isdisjoint(subfolders + files):
            subfolders.clear()
            continue
        visited.add(identity)
        if PACKAGE_MANIFEST_FILENAME in files:
            yield folder
            subfolders.clear()
        elif folder.startswith('/usr/share/'):
            subfolders.clear()      # only one level of it is looked at, as catkin_pkg does
        else:
            subfolders[:] = sorted(name for name in subfolders if not name.startswith('.'))


def _package(file_name: str) -> Package:
    """The package of a package.xml; PackageError if it has none."""
    try:
        content = read_file(file_name)
        if len(content) > MAX_SIZE:
            raise InvalidPackage('larger than 1 MiB, which is all that is read')
        if b'<!ENTITY' in content:  # of which not every expat bounds the expansion
            raise InvalidPackage('it declares entities, and those are not read')
        # Its warnings are for those who build the package.
        return parse_package_string(content.decode('utf-8'), file_name, warnings=[])
    except OSError as error:
        raise PackageError(error.strerror or str(error), file_name) from error
    except InvalidPackage as error:
        syntax = error.__context__
        if isinstance(syntax, ExpatError):
            raise PackageError('not XML: ' + ErrorString(syntax.code), file_name, syntax.lineno,
                               syntax.offset + 1) from error
        raise PackageError(' '.join(error.msg.split()), file_name) from error
    except Exception as error:  # parse_package_string has asserts, int() and recursion in it
        raise PackageError('not a valid manifest: %s' % error, file_name) from error


def spec_file_index_from_package_index(package_index: Dict[str, Package]) -> SpecFileIndex:
    """
    The files of specs that packages export.

    :param package_index: dict as `package_index_from_package_path` returns
    :returns: dict from the name of each package that exports any to a dict with the keys
        ``'capability_interface'``, ``'semantic_capability_interface'`` and
        ``'capability_provider'``, and lists of paths (str, absolute), in the order of the exports

    >>> spec_file_index_from_package_index({})
    {}
    """
    index: SpecFileIndex = {}
    for name, package in package_index.items():
        folder = os.path.dirname(os.path.abspath(package.filename))
        spec_files: Dict[str, List[str]] = {tag: [] for tag in EXPORTS}
        for export in package.exports:
            if export.tagname in spec_files:
                path = os.path.join(folder, (export.content or '').strip())
                spec_files[export.tagname].append(path)
        if any(spec_files.values()):
            index[name] = spec_files
    return index


def spec_index_from_spec_file_index(
        spec_file_index: SpecFileIndex) -> Tuple[SpecIndex, List[Exception]]:
    """
    An index of all specs in some files.

    Interfaces are added first, then semantic interfaces, then providers, those of one kind in the
    order of the packages and their exports.

    :param spec_file_index: dict as `spec_file_index_from_package_index` returns
    :returns: (`SpecIndex`, list of the errors). A spec that is left out is there as

        - `OSError`, if its file cannot be read,
        - `capabilities.specs.common.InvalidSpec`, if it is not valid, or has the name of another
          package in front of its own,
        - `DuplicateNameException`, if there is a spec of that name already,
        - `InterfaceNameNotFoundException`, if the interface that it stands on is not there.

    >>> spec_index_from_spec_file_index({})[1]
    []
    """
    index = SpecIndex()
    errors: List[Exception] = []
    steps: Tuple[Tuple[Callable[[str], Any], Callable[[Any, str, str], None]], ...] = (
        (capability_interface_from_file_path, index.add_interface),
        (semantic_capability_interface_from_file_path, index.add_semantic_interface),
        (capability_provider_from_file_path, index.add_provider))
    for tag, (read, add) in zip(EXPORTS, steps):
        for package_name, spec_files in spec_file_index.items():
            for path in spec_files.get(tag, ()):
                try:
                    add(read(path), path, package_name)
                except (OSError, InvalidSpec, DuplicateNameException,
                        InterfaceNameNotFoundException) as error:
                    errors.append(error)
    return index, errors
