"""
Checks ``.interactions`` files, which say what people can do with a robot, and on which devices.

No export names these files. They have several forms: a list of interactions; a mapping with a list
of ``interactions`` and one of ``pairings``; a list of groups that have such lists, under these keys
or others.
"""
from __future__ import annotations

import os
from typing import Dict, Iterator, List, Tuple

from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.finding import Finding
from rocon_uri.sources.checked import CheckedMapping
from rocon_uri.sources.wording import did_you_mean, near_misses, quoted
from rocon_uri.workspace import Workspace

__all__ = ['check_interactions_file', 'interactions_files']

_LISTS = {'interactions': 'interaction', 'pairings': 'pairing'}
_ENTRIES = {'interaction': 'an interaction', 'pairing': 'a pairing'}
_KEYS = {
    'interaction': (
        'name', 'command', 'compatibility', 'group', 'role', 'display_name', 'description', 'icon',
        'namespace', 'remappings', 'parameters', 'max', 'hidden', 'pairing', 'bringup_pairing',
        'teardown_pairing', 'required_pairings'),
    'pairing': ('name', 'rapp', 'group', 'description', 'icon', 'remappings', 'parameters',
                'requires_interaction'),
}
_REQUIRED_KEYS = {'interaction': ('name', 'compatibility'), 'pairing': ('name', 'rapp')}


def interactions_files(package_folder: str) -> Iterator[str]:
    """
    The ``.interactions`` files of a package, without those of a package within it.

    :param str package_folder: the folder of the package
    :returns: iterator of str, their paths, in the order of their names
    """
    for folder, subfolders, files in os.walk(package_folder):
        if folder != package_folder and 'package.xml' in files:
            subfolders.clear()
            continue
        subfolders[:] = sorted(name for name in subfolders if not name.startswith('.'))
        for name in sorted(files):
            if name.endswith('.interactions'):
                yield os.path.join(folder, name)


def check_interactions_file(path: str, package_folder: str,
                            workspace: Workspace) -> List[Finding]:
    """
    Check one file.

    :param str path: the file
    :param str package_folder: the folder of its package
    :param Workspace workspace: what it may refer to
    :returns: list of `Finding`
    """
    file = CheckedFile(path, package_folder)
    data = file.read()
    if data is not None:
        _check_data(data, file, workspace)
    elif not file.findings:
        file.error('expected interactions, the file is empty', (1, 1))
    return file.findings


def _check_data(data: object, file: CheckedFile, workspace: Workspace) -> None:
    seen = set()
    for kind, entry in _entries(data, 'interaction', file):
        _check_entry(kind, entry, file, workspace)
        identity = kind, tuple(repr(entry.get(key)) for key in (
            'name', 'group', 'role', 'namespace', 'compatibility'))
        if identity in seen:
            file.error('duplicate %s %s' % (kind, quoted(str(entry.get('name')))), entry.place)
        seen.add(identity)
    if not seen and not file.findings:
        file.error('expected a list of interactions, or a mapping that has one', (1, 1))


def _entries(data: object, kind: str, file: CheckedFile) -> Iterator[Tuple[str, CheckedMapping]]:
    """The interactions and pairings in a list or a group, each with its kind."""
    if isinstance(data, list):
        for item in file.mappings(data, _ENTRIES[kind]):
            if _is_group(item.data):
                yield from _entries(item.data, kind, file)
            else:
                yield kind, item
    elif isinstance(data, dict):
        group = CheckedMapping(file, data, 'a group')
        for key in group:
            below = group.get(key)
            if isinstance(below, list):
                near = [] if key in _LISTS else near_misses(str(key), list(_LISTS))
                if near:
                    file.warn('unknown key %s%s' % (quoted(str(key)), did_you_mean(near)),
                              group.key_place(key))
                yield from _entries(below, _LISTS.get(key, kind), file)
            elif key in _LISTS:
                group.sequence(key)     # refuses it


def _is_group(item: Dict[str, object]) -> bool:
    """Is it a group of interactions, and not an interaction itself?"""
    return any(key in item for key in _LISTS) or (
        not any(key in item for keys in _REQUIRED_KEYS.values() for key in keys)
        and any(isinstance(below, list) for below in item.values()))


def _check_entry(kind: str, entry: CheckedMapping, file: CheckedFile,
                 workspace: Workspace) -> None:
    entry.warn_of_unknown(_KEYS[kind])
    for key in _REQUIRED_KEYS[kind]:
        entry.required(key)
    texts = {key: entry.text(key) for key in ('name', 'compatibility', 'namespace', 'rapp')}
    for key, value in texts.items():
        place = entry.value_place(key)
        if value is not None and key == 'compatibility':
            file.check_compatibility(value, workspace.vocabulary, place)
        elif value is not None and key == 'namespace':
            file.check_ros_name(value, key, place)
        elif value is not None and key == 'rapp':
            file.check_exists(value, key, workspace.rapps, place)
    for remapping in file.mappings(entry.sequence('remappings'), 'a remapping'):
        remapping.warn_of_unknown(('remap_from', 'remap_to'))
        for key in ('remap_from', 'remap_to'):
            name = remapping.required_text(key)
            if name:
                file.check_ros_name(name, key, remapping.value_place(key))
