"""
Checks one entry of an ``.interactions`` file: an interaction or a pairing.

There are two forms of interactions. In the first, ``display_name`` is what people read, ``role``
says who may use it, and ``name`` is what starts. In the later one, ``name`` is what people read and
``command`` what starts.
"""
from __future__ import annotations

from typing import Tuple

from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.sources.checked import CheckedMapping
from rocon_uri.workspace import Workspace

__all__ = ['ENTRIES', 'check_entry', 'identity']

#: what errors call an entry of each kind
ENTRIES = {'interaction': 'an interaction', 'pairing': 'a pairing'}

_KEYS = {
    'interaction': (
        'name', 'command', 'compatibility', 'group', 'role', 'display_name', 'description', 'icon',
        'namespace', 'remappings', 'parameters', 'max', 'hidden', 'pairing', 'bringup_pairing',
        'teardown_pairing', 'required_pairings'),
    'pairing': ('name', 'rapp', 'group', 'description', 'icon', 'remappings', 'parameters',
                'requires_interaction'),
}


def identity(kind: str, entry: CheckedMapping, group: str = '') -> Tuple[str, ...]:
    """
    What tells an entry of a file apart from others of its kind; it begins with the name.

    :param str kind: ``'interaction'`` or ``'pairing'``
    :param str group: the group that it belongs to if it names none
    :returns: tuple of str
    """
    def text(key: str, default: str = '') -> str:
        value = entry.get(key)
        return default if value is None or value == '' else str(value)

    if kind == 'pairing':
        return text('name'), text('group', group)
    namespace = text('namespace', '/')
    if _is_of_first_form(entry):
        return text('display_name'), text('role'), namespace, 'first form'
    return text('name'), 'Hidden' if entry.get('hidden') is True else text(
        'group', group or 'Other'), namespace


def _is_of_first_form(entry: CheckedMapping) -> bool:
    return 'display_name' in entry.data or ('role' in entry.data and 'command' not in entry.data)


def check_entry(kind: str, entry: CheckedMapping, file: CheckedFile, workspace: Workspace) -> None:
    """
    Check one entry.

    :param str kind: ``'interaction'`` or ``'pairing'``
    :param CheckedMapping entry: what the file says
    :param CheckedFile file: gets the findings
    :param Workspace workspace: what it may refer to
    """
    entry.warn_of_unknown(_KEYS[kind])
    if kind == 'pairing':
        entry.required_text('name')
        _check_pairing(entry, file, workspace)
        return
    pairing = entry.mapping('pairing')
    if isinstance(entry.get('pairing'), dict):
        pairing.warn_of_unknown(_KEYS['pairing'])
        _check_pairing(pairing, file, workspace)
    if entry.get('name') not in (None, '') or not pairing.get('rapp'):
        entry.required_text('name')
    if _is_of_first_form(entry):
        entry.required_text('role')
    elif 'group' in entry.data and not any(
            key in entry.data for key in ('command', 'pairing', 'required_pairings')):
        entry.required('command')
    if entry.required('compatibility') is not None:
        text = entry.text_at('compatibility')
        if text:
            file.check_compatibility(text, workspace.vocabulary, entry.value_place('compatibility'))
    _check_number(entry)
    namespace = entry.text('namespace', may_be_empty=True)
    if namespace:
        file.check_ros_name(namespace, 'namespace', entry.value_place('namespace'))
    _check_remappings(entry, file)


def _check_pairing(pairing: CheckedMapping, file: CheckedFile, workspace: Workspace) -> None:
    """Check what a pairing consists of, wherever it stands."""
    rapp = pairing.required_text('rapp')
    if rapp:
        file.check_exists(rapp, 'rapp', workspace.rapp_names, pairing.value_place('rapp'),
                          'unknown-app')
    _check_remappings(pairing, file)


def _check_remappings(entry: CheckedMapping, file: CheckedFile) -> None:
    for remapping in file.mappings(entry.sequence('remappings'), 'a remapping'):
        remapping.warn_of_unknown(('remap_from', 'remap_to'))
        for key in ('remap_from', 'remap_to'):
            name = remapping.required_text(key)
            if name:
                file.check_ros_name(name, key, remapping.value_place(key))


def _check_number(entry: CheckedMapping) -> None:
    """How many people may use an interaction at once: -1 for any number."""
    number = entry.get('max')
    if number is not None and (
            isinstance(number, bool) or not isinstance(number, int) or number < -1):
        entry.reading.refuse(entry.wrong('max', 'a whole number from -1 on'))
