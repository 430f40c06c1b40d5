"""
The apps of app_manager that packages export: ``.installed`` files, and the ``.app`` files in them.

A package exports a folder, and each ``.installed`` file directly in it lists apps by their names::

    <export><app_manager app_dir="${prefix}/apps"/></export>

    apps:
      - app: our_apps/dance         # dance.app, anywhere in the package our_apps
        display: Dance              # not needed

app_manager loses all apps of an ``.installed`` file if one of them is broken. Here a broken one
costs only itself.

>>> app_files_from_package_index({})
({}, [])
"""
from __future__ import annotations

import os
from typing import Dict, List, Mapping, Tuple

from rocon_uri.apps.app_file import AppFile, InvalidApp, app_from_file_path
from rocon_uri.sources.resources import Resources
from rocon_uri.sources.checked import Reading
from rocon_uri.sources.located import NOWHERE, LocatedError, Place, with_id
from rocon_uri.sources.packages import Package
from rocon_uri.sources.wording import cannot_be_read, quoted
from rocon_uri.sources.yaml_source import read_file

__all__ = ['app_files_from_package_index', 'app_folders', 'installed_apps', 'installed_files']


def app_folders(package: Package) -> List[str]:
    """The folders that a package exports to app_manager, whether they exist or not."""
    return package.files('app_manager', 'app_dir')


def installed_files(package: Package) -> List[str]:
    """
    The ``.installed`` files of a package that count.

    :param Package package: what may export folders with them
    :returns: list of str, their paths
    """
    found: Dict[str, None] = {}
    for folder in app_folders(package):
        try:
            names = sorted(os.listdir(folder))
        except OSError:     # for the linter to say
            continue
        found.update((os.path.join(folder, name), None) for name in names
                     if name.endswith('.installed'))
    return list(found)


def installed_apps(path: str) -> List[Tuple[str, Place]]:
    """
    The apps that an ``.installed`` file lists.

    :param str path: the file
    :returns: list of (name, place in the file), the name is ``package/name``
    :raises InvalidApp: if it cannot be read, or its content is not a list of apps
    """
    try:
        source = Reading(path, InvalidApp).load(read_file(path), 'the list of apps')
    except OSError as error:
        raise _unreadable(path, error) from None
    source.required('apps', ('apps',))
    return [(entry.required_text('app', ('app', 'display')), entry.value_place('app'))
            for entry in source.reading.mappings(source.sequence('apps'), 'an item of apps',
                                                 'a mapping with an app')]


def app_files_from_package_index(packages: Mapping[str, Package],
                                 ) -> Tuple[Dict[str, AppFile], List[LocatedError]]:
    """
    The apps that packages export to app_manager.

    :param packages: mapping of `rocon_uri.sources.packages.Package` by name
    :returns: (dict of `AppFile` by name, list of `InvalidApp`); a fault of one app costs only that
        one
    """
    resources = Resources(packages)
    apps: Dict[str, AppFile] = {}
    faults: List[LocatedError] = []
    read = set()
    for package in packages.values():
        for path in installed_files(package):
            try:
                listed = installed_apps(path)
            except InvalidApp as fault:
                faults.append(fault)
                continue
            for name, place in listed:
                if name in read:
                    continue
                read.add(name)
                try:
                    apps[name] = _app(name, path, place, resources)
                except InvalidApp as fault:
                    faults.append(fault)
    return apps, faults


def _app(name: str, installed: str, place: Place, resources: Resources) -> AppFile:
    found = resources.find(name, '.app')
    if found.path is None:
        raise with_id(InvalidApp('app %s %s' % (quoted(name), found.problem), installed, *place),
                      'unknown-app')
    try:
        return app_from_file_path(found.path, name, resources)
    except OSError as error:
        raise _unreadable(found.path, error) from None


def _unreadable(path: str, error: OSError) -> InvalidApp:
    return with_id(InvalidApp(cannot_be_read(error), path, *NOWHERE), 'cannot-read')
