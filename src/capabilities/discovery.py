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

A faulty package or spec is reported and left out, with the specs that refer to it; all others are
indexed. A path that leads out of its package is followed.
"""
from __future__ import annotations

import logging
from typing import (
    TYPE_CHECKING, Any, Callable, Dict, Iterable, List, Mapping, Optional, Tuple, TypeVar, Union)

from capabilities.spec_index import (
    DuplicateNameException, InterfaceNameNotFoundException, SpecIndex)
from capabilities.specs.interface import InvalidInterface, capability_interface_from_file_path
from capabilities.specs.provider import InvalidProvider, capability_provider_from_file_path
from capabilities.specs.semantic_interface import (
    InvalidSemanticInterface, semantic_capability_interface_from_file_path)
from rocon_uri.sources.located import Fault, LocatedError
from rocon_uri.sources.packages import (
    Package, PackageError, as_package, find_packages, read_manifest)

if TYPE_CHECKING:
    from catkin_pkg.package import Package as CatkinPackage

__all__ = ['DuplicateNameException', 'InterfaceNameNotFoundException', 'InvalidInterface',
           'InvalidProvider', 'InvalidSemanticInterface', 'PackageError', 'SpecIndex',
           'catkin_package', 'package_index_from_package_path',
           'spec_file_index_from_package_index', 'spec_index_from_spec_file_index']

#: the exports that name specs, in the order in which they are indexed
EXPORTS = ('capability_interface', 'semantic_capability_interface', 'capability_provider')

_logger = logging.getLogger('capabilities.discovery')

Spec = TypeVar('Spec')
SpecFileIndex = Dict[str, Dict[str, Any]]   # lists of paths, and a package


def package_index_from_package_path(
        package_paths: Union[str, Iterable[str]], errors: Optional[List[PackageError]] = None,
        ) -> Dict[str, CatkinPackage]:
    """
    The packages below some folders, as catkin_pkg describes them.

    `rocon_uri.sources.packages` says where they are looked for, and its ``find_packages`` finds
    them many times faster where name, folder and exports are enough.

    :param package_paths: the folders, an iterable of str, or one str. A package in an earlier one
        hides those of its name in later ones.
    :param list errors: a `PackageError` is appended to it for each package.xml that is not valid,
        for a second package of one name below the same folder, and for each folder that cannot be
        read. All are logged in any case.
    :returns: dict of ``catkin_pkg.package.Package`` by name; the ``filename`` of each is absolute

    >>> package_index_from_package_path(['no/such/folder'])
    {}
    """
    if isinstance(package_paths, str):
        package_paths = [package_paths]
    packages: Dict[str, CatkinPackage] = {}
    faults: List[PackageError] = []
    for path in package_paths:
        for name, package in find_packages([path], faults).items():
            try:
                packages.setdefault(name, catkin_package(package.manifest))
            except PackageError as error:
                faults.append(error)
    for fault in faults:
        _logger.warning('package left out: %s', fault)
    if errors is not None:
        errors += faults
    return packages


def catkin_package(manifest: str) -> CatkinPackage:
    """
    The package of a package.xml, as catkin_pkg describes it.

    :param str manifest: the file
    :returns: ``catkin_pkg.package.Package``
    :raises PackageError: if catkin_pkg refuses it

    >>> catkin_package('test/workspace/src/home_navigation/package.xml').version
    '1.0.0'
    """
    # Here, since it takes a third of the time in which this module and all its imports load.
    from catkin_pkg.package import InvalidPackage, parse_package_string
    text = read_manifest(manifest)
    try:
        # Its warnings are for those who build the package.
        return parse_package_string(text, manifest, warnings=[])
    except InvalidPackage as error:
        raise PackageError(' '.join(error.msg.split()), manifest) from error
    except Exception as error:  # parse_package_string has asserts, int() and recursion in it
        raise PackageError('not a valid manifest: %s' % error, manifest) from error


def spec_file_index_from_package_index(
        package_index: Mapping[str, Union[Package, CatkinPackage]]) -> SpecFileIndex:
    """
    The files of specs that packages export.

    :param package_index: dict as `package_index_from_package_path` or
        `rocon_uri.sources.packages.find_packages` returns
    :returns: dict from the name of each package that exports any to a dict with the keys
        ``'capability_interface'``, ``'semantic_capability_interface'`` and
        ``'capability_provider'``, whose values are lists of paths (str, absolute) in the order of
        the exports, and ``'package'``, the package itself, as it was given

    >>> spec_file_index_from_package_index({})
    {}
    """
    index: SpecFileIndex = {}
    for name, given in package_index.items():
        package = as_package(given)
        spec_files = {tag: package.files(tag) for tag in EXPORTS}
        if any(spec_files.values()):
            index[name] = {'package': given, **spec_files}
    return index


def spec_index_from_spec_file_index(
        spec_file_index: SpecFileIndex) -> Tuple[SpecIndex, List[Fault]]:
    """
    An index of all specs in some files.

    Interfaces are added first, then semantic interfaces, then providers, those of one kind in the
    order of the packages and their exports.

    :param spec_file_index: dict as `spec_file_index_from_package_index` returns
    :returns: (`SpecIndex`, list of the errors). For each spec that is left out it has an

        - `OSError`, if its file cannot be read,
        - `capabilities.specs.common.InvalidSpec`, if it is not valid, or has the name of another
          package in front of its own,
        - `DuplicateNameException`, if another spec has that name,
        - `InterfaceNameNotFoundException`, if what it redefines or implements does not exist.

    >>> spec_index_from_spec_file_index({})[1]
    []
    """
    index = SpecIndex()
    errors: List[Fault] = []

    def add_all(tag: str, read: Callable[[str], Spec],
                add: Callable[[Spec, str, str], None]) -> None:
        for package_name, spec_files in spec_file_index.items():
            for path in spec_files.get(tag, ()):
                try:
                    add(read(path), path, package_name)
                except (OSError, LocatedError) as error:
                    errors.append(error)

    add_all('capability_interface', capability_interface_from_file_path, index.add_interface)
    add_all('semantic_capability_interface', semantic_capability_interface_from_file_path,
            index.add_semantic_interface)
    add_all('capability_provider', capability_provider_from_file_path, index.add_provider)
    return index, errors
