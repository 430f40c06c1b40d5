"""Checks ``.rapp`` files that can be read, and the files that they name."""
from __future__ import annotations

import os
from typing import List

from rocon_uri.apps.rapp import GROUPS_OF_REMAPPINGS, KEYS, TYPES_OF_REMAPPINGS, Rapp
from rocon_uri.grammar import is_rocon_app
from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.finding import WARNING, Finding
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
    _check_form(rapp, source, file)
    folder = os.path.dirname(file.path)
    findings: List[Finding] = []
    for key in 'icon', 'public_interface', 'public_parameters':
        name = source.text(key)
        if name is not None:    # without it, the app still runs
            path = file.check_file(name, key, rapp.position(key), folder, if_missing=WARNING)
            if path is not None and key.startswith('public_'):
                findings += _check_public_file(key, path, package_folder)
    if rapp.launch is not None:
        file.check_launch_file(rapp.launch, rapp.position('launch'), workspace.launch_files)
    for item in file.mappings(source.sequence('required_capabilities'), 'a required capability'):
        _check_required_capability(item, file, workspace)
    return findings + file.findings


def _check_form(rapp: Rapp, source: CheckedMapping, file: CheckedFile) -> None:
    """Check what the published form requires of an ancestor, a child and a virtual rapp."""
    lacking = [key for key in ('launch', 'compatibility') if getattr(rapp, key) is None]
    if rapp.is_ancestor:
        unsaid = [key for key in ('display', 'description') if getattr(rapp, key) is None]
        if unsaid:
            file.warn('the rapp has no %s, and no parent that has it' % ' and no '.join(unsaid),
                      source.place, 'missing-key')
        if len(lacking) == 1:
            key = 'compatibility' if lacking == ['launch'] else 'launch'
            file.warn('the rapp has %s but no %s, so it never runs' % (key, lacking[0]),
                      rapp.position(key), 'never-runs')
    else:
        if lacking:
            file.warn('the rapp has a parent but no %s, so it never runs' % ' and no '.join(
                lacking), rapp.position('parent_name'), 'never-runs')
        if rapp.public_interface is not None:
            file.warn('the rapp has a public_interface, which a rapp takes from its parent',
                      rapp.position('public_interface'), 'own-interface')
    if lacking and rapp.required_capabilities:
        file.warn('the rapp is virtual and requires capabilities, which no other rapp inherits',
                  source.key_place('required_capabilities'), 'virtual-capabilities')


def _check_required_capability(capability: CheckedMapping, file: CheckedFile,
                               workspace: Workspace) -> None:
    capability.warn_of_unknown(('name', 'interface'))
    name = capability.required_text('name')
    file.check_exists(name, 'capability', workspace.capability_names,
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
