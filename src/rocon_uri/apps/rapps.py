"""
Rapps (robot apps): those that packages export, and what they inherit from their parents.

A package exports a rapp by the path of its file, relative to the package::

    <export><rocon_app>rapps/dance/dance.rapp</rocon_app></export>

Its name is made of those of the package and the file: ``our_rapps/dance``.

>>> from capabilities.discovery import package_index_from_package_path
>>> packages = package_index_from_package_path(['examples/workspace'])
>>> rapps, errors = rapps_from_package_index(packages)
>>> rapps['cafe_rapps/serve'].compatibility
'rocon:/turtlebot2|waiterbot'
"""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Dict, Iterable, List, Mapping, Optional, Tuple, Union

from rocon_uri.apps.rapp import (
    InvalidRapp, Rapp, RequiredCapability, rapp_from_file_path, rapp_from_string)
from rocon_uri.apps.runnable import Reason, ReasonKind, Verdict, runnable
from rocon_uri.sources.located import with_id
from rocon_uri.sources.packages import Package, as_package
from rocon_uri.sources.wording import (
    NamesByPart, cannot_be_read, did_you_mean, quoted, quoted_path)

if TYPE_CHECKING:
    from catkin_pkg.package import Package as CatkinPackage

__all__ = ['InvalidRapp', 'Rapp', 'Reason', 'ReasonKind', 'RequiredCapability', 'Verdict',
           'rapp_file_index_from_package_index', 'rapp_from_file_path', 'rapp_from_string',
           'rapp_name', 'rapps_from_package_index', 'rapps_from_rapp_file_index', 'runnable',
           'with_inheritance']


def rapp_name(package: str, path: str) -> str:
    """
    What a rapp is called.

    :param str package: the name of the package that exports it
    :param str path: its file
    :returns: str

    >>> rapp_name('our_rapps', 'rapps/dance/dance.rapp')
    'our_rapps/dance'
    """
    return '%s/%s' % (package, os.path.splitext(os.path.basename(path))[0])


def rapp_file_index_from_package_index(
        package_index: Mapping[str, Union[Package, CatkinPackage]]) -> Dict[str, List[str]]:
    """
    The files that packages export as rapps, whether they exist or not.

    :param package_index: mapping of package names to packages, as
        `rocon_uri.sources.packages.find_packages` or
        `capabilities.discovery.package_index_from_package_path` returns it
    :returns: dict of package name to a list of paths, in the order of the exports; packages
        without any are left out
    """
    index = {name: as_package(package).files('rocon_app')
             for name, package in package_index.items()}
    return {name: paths for name, paths in index.items() if paths}


def rapps_from_package_index(
        package_index: Mapping[str, Union[Package, CatkinPackage]],
        ) -> Tuple[Dict[str, Rapp], List[InvalidRapp]]:
    """
    The rapps that packages export, with what they inherit from their parents.

    :param package_index: as `rapp_file_index_from_package_index` takes it
    :returns: (dict of `Rapp` by name, list of `InvalidRapp`); a fault of one rapp costs only that
        one
    """
    rapps, errors = rapps_from_rapp_file_index(rapp_file_index_from_package_index(package_index))
    related, more_errors = with_inheritance(rapps.values())
    return related, errors + more_errors


def rapps_from_rapp_file_index(
        rapp_file_index: Mapping[str, Iterable[str]],
        ) -> Tuple[Dict[str, Rapp], List[InvalidRapp]]:
    """
    The rapps in some files, without what they inherit.

    :param rapp_file_index: as `rapp_file_index_from_package_index` returns it
    :returns: (dict of `Rapp` by name, list of `InvalidRapp`); of several rapps of one name, the
        first counts
    """
    rapps: Dict[str, Rapp] = {}
    errors: List[InvalidRapp] = []
    for package, paths in rapp_file_index.items():
        for path in paths:
            try:
                rapp = rapp_from_file_path(path, rapp_name(package, path))
                first = rapps.setdefault(rapp.name, rapp)
                if first is not rapp:
                    errors.append(with_id(InvalidRapp('duplicate rapp %s, the first is in %s' % (
                        quoted(rapp.name), quoted_path(first.path)), path), 'duplicate-name'))
            except InvalidRapp as error:
                errors.append(error)
            except OSError as error:
                errors.append(with_id(InvalidRapp(cannot_be_read(error), path), 'cannot-read'))
    return rapps, errors


def with_inheritance(rapps: Iterable[Rapp]) -> Tuple[Dict[str, Rapp], List[InvalidRapp]]:
    """
    Rapps with what they inherit from their parents, through all generations.

    A parent that is not among them is an error of the rapp that names it, and a cycle is an error
    of each rapp in it. Rapps that descend from such rapps inherit what there is.

    :param rapps: iterable of Rapp
    :returns: (dict of `Rapp` by name, list of `InvalidRapp`)
    """
    by_name = {rapp.name: rapp for rapp in rapps}
    names = NamesByPart(by_name)
    related: Dict[str, Rapp] = {}
    errors: Dict[str, InvalidRapp] = {}
    for rapp in by_name.values():
        line: Dict[str, Rapp] = {}      # of descent, from the rapp upwards
        ancestor: Optional[Rapp] = rapp
        while ancestor is not None and not (
                ancestor.name in related or ancestor.name in line):
            line[ancestor.name] = ancestor
            ancestor = by_name.get(ancestor.parent_name or '')
        if ancestor is not None and ancestor.name in line:
            cycle = list(line)[list(line).index(ancestor.name):]
            for index, name in enumerate(cycle):
                errors[name] = _cycle_error(by_name[name], cycle[index + 1:] + cycle[:index])
                related[name] = by_name[name]
        for name, descendant in reversed(list(line.items())):
            parent = related.get(descendant.parent_name or '')
            if parent is None and not descendant.is_ancestor:
                errors.setdefault(name, _missing_parent_error(descendant, names))
            if name not in related:
                related[name] = descendant if parent is None else descendant.inheriting(parent)
    return ({name: related[name] for name in by_name if name not in errors},
            [errors[name] for name in by_name if name in errors])


def _missing_parent_error(rapp: Rapp, names: NamesByPart) -> InvalidRapp:
    parent_name = rapp.parent_name or ''
    return with_id(InvalidRapp('parent_name %s does not exist or cannot be read%s' % (
        quoted(parent_name), did_you_mean(names.near_misses(parent_name))),
        rapp.path, *rapp.position('parent_name')), 'unknown-app')


def _cycle_error(rapp: Rapp, ancestors: List[str]) -> InvalidRapp:
    if len(ancestors) > 5:
        ancestors[5:] = ['...']
    return with_id(InvalidRapp('rapp %s is its own ancestor: %s' % (
        quoted(rapp.name), ' -> '.join([rapp.name, *ancestors, rapp.name])),
        rapp.path, *rapp.position('parent_name')), 'ancestor-cycle')
