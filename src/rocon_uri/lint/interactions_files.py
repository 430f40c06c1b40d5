"""
What can be wrong in an ``.interactions`` file: what people can do with a robot, from which screens.

No export names these files, and several forms of them are about: a list of interactions; a mapping
that has such lists as ``interactions`` and ``pairings``; a list of groups that hold them likewise,
or by other keys.
"""
from __future__ import annotations

import os

from rocon_uri.sources.wording import near_misses, quoted
from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.sources.wording import did_you_mean
from rocon_uri.sources.yaml_data import YamlMapping, YamlSequence

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Iterator, List, Tuple
    from rocon_uri.lint.finding import Finding
    from rocon_uri.lint.surroundings import Surroundings

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
    The ``.interactions`` files of a package, but for those in a package within it.

    :param str package_folder: where the package is
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
                            surroundings: Surroundings) -> List[Finding]:
    """
    Check one file.

    :param str path: which
    :param str package_folder: where the package is that it is in
    :param Surroundings surroundings: what it may refer to
    :returns: list of `Finding`
    """
    file = CheckedFile(path, package_folder)
    data = file.load()
    if data is not None:
        _check_data(data, file, surroundings)
    elif not file.findings:
        file.error('expected interactions, the file is empty', (1, 1))
    return file.findings


def _check_data(data: Any, file: CheckedFile, surroundings: Surroundings) -> None:
    seen = set()
    for kind, entry in _entries(data, 'interaction', file):
        _check_entry(kind, entry, file, surroundings)
        identity = kind, tuple(repr(entry.get(key)) for key in (
            'name', 'group', 'role', 'namespace', 'compatibility'))
        if identity in seen:
            file.error('%s %s is there twice' % (kind, quoted(str(entry.get('name')))),
                       entry.position)
        seen.add(identity)
    if not seen and not file.findings:
        file.error('expected a list of interactions, or a mapping that has one', (1, 1))


def _entries(data: Any, kind: str, file: CheckedFile) -> Iterator[Tuple[str, YamlMapping]]:
    """The interactions and pairings in a list or a group, each with its kind."""
    if isinstance(data, YamlSequence):
        for index, item in enumerate(data):
            if not isinstance(item, YamlMapping):
                file.error('%s is no mapping' % _ENTRIES[kind], data.item_position(index))
            elif _is_group(item):
                yield from _entries(item, kind, file)
            else:
                yield kind, item
    elif isinstance(data, YamlMapping):
        for key, below in data.items():
            if isinstance(below, YamlSequence):
                near = [] if key in _LISTS else near_misses(str(key), _LISTS)
                if near:
                    file.warn('unknown key %s%s' % (quoted(key), did_you_mean(near)),
                              data.key_position(key))
                yield from _entries(below, _LISTS.get(key, kind), file)
            elif key in _LISTS and below is not None:
                file.error('%s is no list' % key, data.value_position(key))


def _is_group(item: YamlMapping) -> bool:
    """Does it hold interactions, and is none itself?"""
    return any(key in item for key in _LISTS) or (
        not any(key in item for keys in _REQUIRED_KEYS.values() for key in keys)
        and any(isinstance(below, YamlSequence) for below in item.values()))


def _check_entry(kind: str, entry: YamlMapping, file: CheckedFile,
                 surroundings: Surroundings) -> None:
    file.check_keys(entry, _KEYS[kind], _ENTRIES[kind])
    for key, _, place in entry.repeated:
        file.error('%s is there twice' % quoted(str(key)), place)
    for key in _REQUIRED_KEYS[kind]:
        if entry.get(key) is None:
            file.error('%s has no %s' % (_ENTRIES[kind], key), entry.position)
    for key in ('name', 'compatibility', 'namespace', 'rapp'):
        value = entry.get(key)
        if value is not None and not isinstance(value, str):
            file.error('%s is no text' % key, entry.value_position(key))
        elif value is not None:
            _check_text(key, value, entry.value_position(key), file, surroundings)
    _check_remappings(entry, file)


def _check_text(key: str, value: str, place: Any, file: CheckedFile,
                surroundings: Surroundings) -> None:
    if key == 'compatibility':
        file.check_compatibility(value, surroundings.vocabulary, place)
    elif key == 'namespace':
        file.check_ros_name(value, 'namespace', place)
    elif key == 'rapp':
        file.check_exists(value, 'rapp', surroundings.rapps, place)


def _check_remappings(entry: YamlMapping, file: CheckedFile) -> None:
    remappings = entry.get('remappings')
    if not isinstance(remappings, YamlSequence):
        if remappings is not None:
            file.error('remappings is no list', entry.value_position('remappings'))
        return
    for index, remapping in enumerate(remappings):
        if not isinstance(remapping, YamlMapping):
            file.error('a remapping is no mapping', remappings.item_position(index))
            continue
        file.check_keys(remapping, ('remap_from', 'remap_to'), 'a remapping')
        for key in ('remap_from', 'remap_to'):
            if isinstance(remapping.get(key), str):
                file.check_ros_name(remapping[key], key, remapping.value_position(key))
            else:
                file.error('a remapping has no %s, or one that is no text' % key,
                           remapping.position)
