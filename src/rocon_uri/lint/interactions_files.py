"""
Checks ``.interactions`` files, which say what people can do with a robot, and on which devices.

No export names these files. They have several forms: a list of interactions; a mapping with a list
of ``interactions`` and one of ``pairings``; a list of groups that have such lists, under these keys
or others.
"""
from __future__ import annotations

from typing import Dict, Iterable, Iterator, List, NamedTuple, Set

from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.finding import Finding
from rocon_uri.lint.interaction_entries import ENTRIES, check_entry, identity
from rocon_uri.sources.checked import CheckedMapping
from rocon_uri.sources.located import Place
from rocon_uri.sources.wording import did_you_mean, near_misses, quoted
from rocon_uri.sources.yaml_data import value_place
from rocon_uri.workspace import Workspace

__all__ = ['check_interactions_file']

_LISTS = {'interactions': 'interaction', 'pairings': 'pairing'}
_KEYS_OF_ENTRIES = ('name', 'compatibility', 'rapp', 'display_name', 'pairing', 'command')


class _Entry(NamedTuple):
    """An interaction or a pairing."""

    #: ``'interaction'`` or ``'pairing'``
    kind: str
    #: what the file says
    source: CheckedMapping
    #: the group that it belongs to if it names none, or ''
    group: str


def check_interactions_file(path: str, package_folder: str, workspace: Workspace,
                            others: Iterable[str] = ()) -> List[Finding]:
    """
    Check one file.

    :param str path: the file
    :param str package_folder: the folder of its package
    :param Workspace workspace: what it may refer to
    :param others: iterable of str, the other such files of the package: its entries may refer to
        those in them, since they can be loaded together
    :returns: list of `Finding`
    """
    file = CheckedFile(path, package_folder)
    data = file.read()
    if data is None:
        if not file.findings:
            file.error('expected interactions, the file is empty', (1, 1), 'no-interactions')
        return file.findings
    entries = list(_entries(data, 'interaction', file))
    if not entries and not file.findings:
        file.error('expected a list of interactions, or a mapping that has one', (1, 1),
                   'no-interactions')
    for entry in entries:
        check_entry(entry.kind, entry.source, file, workspace)
    _check_duplicates(entries, file)
    _check_references(entries, file, others)
    return file.findings


def _entries(data: object, kind: str, file: CheckedFile, group: str = '') -> Iterator[_Entry]:
    """The interactions and pairings in a list or a group."""
    if isinstance(data, list):
        for item in file.mappings(data, ENTRIES[kind]):
            if _is_group(item.data):
                yield from _entries(item.data, kind, file, group)
            else:
                yield _Entry(kind=kind, source=item, group=group)
    elif isinstance(data, dict):
        mapping = CheckedMapping(file, data, 'a group')
        named = data.get('group')
        for key in mapping:
            below = mapping.get(key)
            if isinstance(below, list):
                near = [] if key in _LISTS else near_misses(str(key), list(_LISTS))
                if near:
                    file.warn('unknown key %s%s' % (quoted(str(key)), did_you_mean(near)),
                              mapping.key_place(key), 'unknown-key')
                yield from _entries(below, _LISTS.get(key, kind), file, str(
                    named or (group if key in _LISTS else key)))
            elif key in _LISTS:
                mapping.sequence(key)     # refuses it


def _is_group(item: Dict[str, object]) -> bool:
    """Is it a group of interactions, and not an interaction itself?"""
    return any(key in item for key in _LISTS) or (
        not any(key in item for key in _KEYS_OF_ENTRIES)
        and any(isinstance(below, list) for below in item.values()))


def _check_duplicates(entries: Iterable[_Entry], file: CheckedFile) -> None:
    """Find duplicate entries; those for different platforms can both be useful."""
    first: Dict[object, _Entry] = {}
    for entry in entries:
        key = entry.kind, *identity(entry.kind, entry.source, entry.group)
        other = first.setdefault(key, entry)
        if other is not entry:
            problem = 'duplicate %s %s' % (entry.kind, quoted(key[1]))
            platforms = [str(each.source.get('compatibility')) for each in (other, entry)]
            if platforms[0] == platforms[1]:
                file.error(problem, entry.source.place, 'duplicate-interaction')
            else:
                file.warn(problem + ' for another platform', entry.source.place,
                          'duplicate-interaction')


def _check_references(entries: Iterable[_Entry], file: CheckedFile, others: Iterable[str]) -> None:
    """Check that the pairings and the interactions exist that entries refer to by their names."""
    known = _names(entries)
    waiting = list(others)

    def check(kind: str, name: object, key: str, place: Place, fault_id: str) -> None:
        while waiting and isinstance(name, str) and name not in known[kind]:
            other = CheckedFile(waiting.pop(), file.package_folder)
            for other_kind, names in _names(
                    _entries(other.read(), 'interaction', other)).items():
                known[other_kind] |= names
        text = file.text(name, key, place)
        if text and text not in known[kind]:
            file.error('%s %s does not exist in the interactions of the package%s' % (
                kind, quoted(text), file.suggestion(text, known[kind])), place, fault_id)

    for entry in entries:
        source = entry.source
        if entry.kind == 'interaction':
            names = source.sequence('required_pairings')
            for index, name in enumerate(names):
                check('pairing', name, 'an item of required_pairings', value_place(names, index),
                      'unknown-pairing')
        elif source.get('requires_interaction'):
            key = 'requires_interaction'
            check('interaction', source.get(key), key, source.value_place(key),
                  'unknown-interaction')


def _names(entries: Iterable[_Entry]) -> Dict[str, Set[str]]:
    """What entries can be referred to by."""
    names: Dict[str, Set[str]] = {kind: set() for kind in ENTRIES}
    for entry in entries:
        names[entry.kind].update(
            name for name in (entry.source.get('name'), entry.source.get('display_name'))
            if isinstance(name, str))
    return names
