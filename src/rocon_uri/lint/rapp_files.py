"""Checks ``.rapp`` files that can be read, and the files that they name."""
from __future__ import annotations

import os
from typing import List

from rocon_uri.apps.rapp import GROUPS_OF_REMAPPINGS, KEYS, TYPES_OF_REMAPPINGS, Rapp
from rocon_uri.grammar import is_rocon_app
from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.finding import ERROR, WARNING, Finding
from rocon_uri.sources.checked import CheckedMapping
from rocon_uri.sources.located import NOWHERE
from rocon_uri.sources.wording import quoted
from rocon_uri.workspace import Workspace

__all__ = ['check_rapp']

_PUBLIC_INTERFACE_KEYS = ('publishers', 'subscribers', 'services', 'action_clients',
                          'action_servers')


def check_rapp(rapp: Rapp, package_folder: str, workspace: Workspace) -> List[Finding]:
    """
    Check one rapp, and the public interface and parameters that it names.

    :param Rapp rapp: as it was read from its file
    :param str package_folder: where the package is that exports it
    :param Workspace workspace: what it may refer to
    :returns: list of `Finding`
    """
    file = CheckedFile(rapp.path, package_folder)
    if not is_rocon_app(rapp.name):
        file.warn('no rocon URI can name rapp %s: the names of package and file have to be ROS '
                  'base names (a letter, then letters, digits and _)' % quoted(rapp.name),
                  NOWHERE, 'illegal-name')
    source = file.mapping(rapp.source, 'the rapp')
    source.warn_of_unknown(KEYS)
    if rapp.compatibility is not None:
        file.check_compatibility(rapp.compatibility, workspace.vocabulary,
                                 rapp.position('compatibility'))
    if not rapp.is_implementation:
        for key, lacking in (('launch', 'compatibility'), ('compatibility', 'launch')):
            if getattr(rapp, key) is not None:
                file.warn('the rapp has %s but no %s, so it never runs' % (key, lacking),
                          rapp.position(key), 'never-runs')
    folder = os.path.dirname(file.path)
    findings: List[Finding] = []
    for key, what, if_missing in (
            ('icon', 'icon', WARNING),
            ('public_interface', 'public_interface', ERROR),
            ('public_parameters', 'public_parameters', ERROR)):
        name = source.text(key)
        if name is not None:
            path = file.check_file(name, what, rapp.position(key), folder, if_missing=if_missing)
            if path is not None and key.startswith('public_'):
                findings += _check_public_file(key, path, package_folder)
    if rapp.launch is not None:
        file.check_launch_file(rapp.launch, rapp.position('launch'), workspace.launch_files)
    for item in file.mappings(source.sequence('required_capabilities'), 'a required capability'):
        _check_required_capability(item, file, workspace)
    return findings + file.findings


def _check_required_capability(capability: CheckedMapping, file: CheckedFile,
                               workspace: Workspace) -> None:
    capability.warn_of_unknown(('name', 'interface'))
    name = capability.required_text('name')
    file.check_exists(name, 'capability', workspace.capabilities,
                      capability.value_place('name'), 'no-interface')
    interface = workspace.interface(name)
    kinds = capability.mapping('interface')
    kinds.warn_of_unknown(TYPES_OF_REMAPPINGS)
    for kind in TYPES_OF_REMAPPINGS:
        groups = kinds.mapping(kind)
        groups.warn_of_unknown(GROUPS_OF_REMAPPINGS)
        for group in GROUPS_OF_REMAPPINGS:
            if interface is not None:
                file.check_remapped_names(kind, groups.mapping(group), interface)


def _check_public_file(key: str, path: str, package_folder: str) -> List[Finding]:
    """The findings in the public interface or the public parameters of a rapp."""
    file = CheckedFile(path, package_folder)
    data = file.read()
    if data is not None:
        public = file.mapping(data, key, place=(1, 1))
        if key == 'public_interface':
            public.warn_of_unknown(_PUBLIC_INTERFACE_KEYS)
            for kind in _PUBLIC_INTERFACE_KEYS:
                _check_connections(kind, public, file)
    return file.findings


def _check_connections(kind: str, public: CheckedMapping, file: CheckedFile) -> None:
    """Check the publishers, the services and so on, each a mapping with a name and a type."""
    for connection in file.mappings(
            public.sequence(kind), 'an item of ' + kind, 'a mapping with a name and a type'):
        connection.warn_of_unknown(('name', 'type'))
        name = connection.required_text('name')
        type_name = connection.required_text('type')
        if name:
            file.check_ros_name(name, 'name', connection.value_place('name'))
        if type_name:
            file.check_type(type_name, quoted(name), connection.value_place('type'))
