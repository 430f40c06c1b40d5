"""What can be wrong in a ``.rapp`` file that can be read, and in the files that it names."""
from __future__ import annotations

import os

from rocon_uri.sources.wording import quoted
from rocon_uri.grammar import is_rocon_app
from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.finding import ERROR, WARNING
from rocon_uri.lint.launch_files import check_launch_file
from rocon_uri.apps.rapp import GROUPS_OF_REMAPPINGS, KEYS, TYPES_OF_REMAPPINGS
from rocon_uri.sources.yaml_data import YamlMapping, YamlSequence

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, List
    from rocon_uri.lint.finding import Finding
    from rocon_uri.lint.surroundings import Surroundings
    from rocon_uri.apps.rapp import Rapp

__all__ = ['check_rapp']

_PUBLIC_INTERFACE_KEYS = ('publishers', 'subscribers', 'services', 'action_clients',
                          'action_servers')


def check_rapp(rapp: Rapp, package_folder: str, surroundings: Surroundings) -> List[Finding]:
    """
    Check one rapp, and the public interface and parameters that it names.

    :param Rapp rapp: as it was read from its file
    :param str package_folder: where the package is that exports it
    :param Surroundings surroundings: what it may refer to
    :returns: list of `Finding`
    """
    file = CheckedFile(rapp.path, package_folder)
    if not is_rocon_app(rapp.name):
        file.warn('no rocon URI can name rapp %s: package and file need ROS base names (a letter, '
                  'then letters, digits and _)' % quoted(rapp.name))
    file.check_keys(rapp.source, KEYS, 'a rapp')
    if rapp.compatibility is not None:
        file.check_compatibility(rapp.compatibility, surroundings.vocabulary,
                                 rapp.position('compatibility'))
    if not rapp.is_implementation:
        for key, lacking in (('launch', 'compatibility'), ('compatibility', 'launch')):
            if getattr(rapp, key) is not None:
                file.warn('the rapp has %s and no %s, so it never runs' % (key, lacking),
                          rapp.position(key))
    folder = os.path.dirname(file.path)
    findings: List[Finding] = []
    for key, what, if_missing in (
            ('icon', 'icon', WARNING),
            ('public_interface', 'public_interface', ERROR),
            ('public_parameters', 'public_parameters', ERROR)):
        name = rapp.source.get(key)
        if name is not None:
            path = file.check_file(name, what, rapp.position(key), folder, if_missing=if_missing)
            if path is not None and key.startswith('public_'):
                findings += _check_public_file(key, path, package_folder)
    if rapp.launch is not None:
        findings += check_launch_file(rapp.launch, rapp.position('launch'), file,
                                      surroundings.launch_files)
    for item in rapp.source.get('required_capabilities') or ():
        _check_required_capability(item, file, surroundings)
    return findings + file.findings


def _check_required_capability(item: Any, file: CheckedFile, surroundings: Surroundings) -> None:
    file.check_keys(item, ('name', 'interface'), 'a required capability')
    name = item['name']
    file.check_exists(name, 'capability', surroundings.capabilities, item.value_position('name'))
    interface = surroundings.interface(name)
    kinds = item.get('interface') or {}
    file.check_keys(kinds, TYPES_OF_REMAPPINGS, 'interface')
    for kind in TYPES_OF_REMAPPINGS:
        groups = kinds.get(kind) or {}
        file.check_keys(groups, GROUPS_OF_REMAPPINGS, kind)
        for group in GROUPS_OF_REMAPPINGS:
            if interface is not None and groups.get(group):
                file.check_remapped_names(kind, groups[group], interface)


def _check_public_file(key: str, path: str, package_folder: str) -> List[Finding]:
    """What is wrong with the public interface or the public parameters of a rapp."""
    file = CheckedFile(path, package_folder)
    data = file.load()
    if isinstance(data, YamlMapping):
        if key == 'public_interface':
            file.check_keys(data, _PUBLIC_INTERFACE_KEYS, key)
            for kind in _PUBLIC_INTERFACE_KEYS:
                _check_connections(kind, data, file)
    elif data is not None:
        file.error('%s is no mapping' % key, getattr(data, 'position', (1, 1)))
    return file.findings


def _check_connections(kind: str, data: Any, file: CheckedFile) -> None:
    """Check the publishers, the services and so on, each a mapping with a name and a type."""
    connections = data.get(kind)
    if not connections:
        return
    if not isinstance(connections, YamlSequence):
        file.error('%s is no list' % kind, data.value_position(kind))
        return
    for index, connection in enumerate(connections):
        if (not isinstance(connection, YamlMapping)
                or not all(isinstance(connection.get(key), str) for key in ('name', 'type'))):
            file.error('%s has something else than mappings with a name and a type' % kind,
                       connections.item_position(index))
            continue
        file.check_keys(connection, ('name', 'type'), kind)
        file.check_ros_name(connection['name'], 'name', connection.value_position('name'))
        file.check_type(connection['type'], quoted(connection['name']),
                        connection.value_position('type'))
