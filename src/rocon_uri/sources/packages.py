"""
Packages: the one walk that finds their folders.

A folder with a ``package.xml``, the manifest, is a package. `find_packages` walks as
``catkin_pkg.packages.find_packages`` and rospack do:

- nothing is looked for below a package, a rosbuild package (``manifest.xml``) included,
- a folder with a file ``AMENT_IGNORE``, ``CATKIN_IGNORE`` or ``COLCON_IGNORE`` is skipped,
- the folders below one with a file ``rospack_nosubdirs`` are skipped, the folder itself is not,
- hidden folders are skipped, and of ``/usr/share`` only the folders directly in it are visited.

Symbolic links are followed, and a folder that several lead to is visited once. A folder that exists
and cannot be read is a fault, since packages may be in it; one of ``/usr/share`` is not.
"""
from __future__ import annotations

import os
from typing import Dict, Iterable, Iterator, List, Optional

from rocon_uri.sources.located import with_id
from rocon_uri.sources.manifest import (
    MANIFEST, Element, Export, Package, PackageError, as_package, manifest_elements,
    package_from_manifest, read_manifest)
from rocon_uri.sources.walk import leads_to_folder
from rocon_uri.sources.wording import cannot_be_read, quoted, quoted_path

__all__ = ['Element', 'Export', 'MANIFEST', 'Package', 'PackageError', 'as_package',
           'duplicate_package', 'find_packages', 'manifest_elements', 'package_folders',
           'package_from_manifest', 'read_manifest']

_IGNORE_MARKERS = frozenset(['AMENT_IGNORE', 'CATKIN_IGNORE', 'COLCON_IGNORE'])
_NOTHING_BELOW = frozenset([MANIFEST, 'manifest.xml', 'rospack_nosubdirs'])


def find_packages(paths: Iterable[str], errors: Optional[List[PackageError]] = None,
                  ) -> Dict[str, Package]:
    """
    The packages below some folders, by name.

    A package in an earlier folder hides those of its name in later ones.

    :param list errors: what is wrong is appended to it: a manifest or a folder that cannot be read,
        and a package whose name another one below the same folder has

    >>> find_packages(['test/workspace'])['home_navigation'].exports[0].text
    'providers/grid_navigation.yaml'
    """
    errors = [] if errors is None else errors
    packages: Dict[str, Package] = {}
    for path in filter(None, paths):    # an empty one is not the working directory
        found: Dict[str, Package] = {}
        for folder in package_folders(path, errors):
            try:
                package = package_from_manifest(os.path.join(folder, MANIFEST))
                if package.name in found:
                    raise duplicate_package(package, found[package.name])
                found[package.name] = package
            except PackageError as error:
                errors.append(error)
        for name, package in found.items():
            packages.setdefault(name, package)
    return packages


def duplicate_package(package: Package, first: Package) -> PackageError:
    """The fault of a package that has the name of another one, which was found first."""
    return with_id(PackageError('duplicate package %s, the first is in %s' % (
        quoted(package.name), quoted_path(first.manifest)), package.manifest), 'duplicate-package')


def package_folders(path: str, errors: Optional[List[PackageError]] = None) -> Iterator[str]:
    """The absolute paths of package folders, from a folder downwards, in order of their names."""
    visited = set()
    waiting = [os.path.abspath(path)]
    while waiting:      # not os.walk, which recurses: a path can be 2,000 folders deep
        folder = waiting.pop()
        try:
            status = os.stat(folder)
            if (status.st_dev, status.st_ino) in visited:
                continue
            visited.add((status.st_dev, status.st_ino))
            with os.scandir(folder) as entries:
                is_folder = {entry.name: leads_to_folder(entry) for entry in entries}
        except (FileNotFoundError, NotADirectoryError, ValueError):     # or a NUL in it
            continue
        except OSError as error:
            if errors is not None and not folder.startswith('/usr/share/'):
                errors.append(with_id(PackageError(
                    'folder ' + cannot_be_read(error), folder), 'cannot-read'))
            continue
        if not _IGNORE_MARKERS.isdisjoint(is_folder):
            continue
        if is_folder.get(MANIFEST) is False:
            yield folder
        if folder.startswith('/usr/share/') or any(
                is_folder.get(name) is False for name in _NOTHING_BELOW):
            continue
        waiting += [os.path.join(folder, name) for name in sorted(is_folder, reverse=True)
                    if is_folder[name] and not name.startswith('.')]
