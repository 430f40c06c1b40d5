"""
Remappings: new names for the ROS names of an interface.

Providers and semantic interfaces have them, by kind:

>>> from capabilities.specs.provider import capability_provider_from_file_path
>>> path = 'test/unit/specs/providers/navigation_nav_stack.yaml'
>>> capability_provider_from_file_path(path).remappings_by_type
{'topics': {'scan': 'nav_stack/scan'}, 'services': {}, 'actions': {}, 'parameters': {}}
"""
from __future__ import annotations

from typing import Dict, Mapping, Optional

from capabilities.specs._reading import SpecReading
from capabilities.specs.common import CapabilitySpec
from rocon_uri.sources.wording import shown

__all__ = ['REMAPPING_KINDS', 'RemapCollection', 'RemappingSpec', 'read_remappings']

REMAPPING_KINDS = ('topics', 'services', 'actions', 'parameters')


class RemapCollection:
    """
    Remappings by kind. A name has only one new name, even if it is remapped in several kinds.

    >>> collection = RemapCollection()
    >>> collection.add_remappings_by_dict({'topics': {'scan': 'laser/scan'}})
    >>> collection.remappings
    {'scan': 'laser/scan'}
    """

    def __init__(self) -> None:
        self._remappings: Dict[str, str] = {}
        self._remappings_by_type: Dict[str, Dict[str, str]] = {kind: {} for kind in REMAPPING_KINDS}

    @property
    def remappings(self) -> Dict[str, str]:
        """The new names by the old ones: a new dict, in the order of the file."""
        return dict(self._remappings)

    @property
    def remappings_by_type(self) -> Dict[str, Dict[str, str]]:
        """The remappings of each of the four kinds: a new dict of new dicts."""
        return {kind: dict(new_names) for kind, new_names in self._remappings_by_type.items()}

    def add_remapping(self, kind: str, name: str, new_name: str) -> None:
        """
        Add a remapping.

        :param str kind: ``'topics'``, ``'services'``, ``'actions'`` or ``'parameters'``
        :param str name: a ROS name of the interface
        :param str new_name: what it is called instead
        :raises ValueError: if the kind is another
        :raises RuntimeError: if the name is remapped to something else
        """
        _check_kind(kind)
        if self._remappings.setdefault(name, new_name) != new_name:
            raise RuntimeError(_two_names(name, self._remappings[name], new_name))
        self._remappings_by_type[kind][name] = new_name

    def add_remappings_by_dict(self, remappings: Mapping[str, Mapping[str, str]]) -> None:
        """
        Add remappings of several kinds. Errors are those of `add_remapping`.

        :param dict remappings: new names by name, by kind
        """
        for kind, new_names in remappings.items():
            _check_kind(kind)       # there may be no names
            for name, new_name in new_names.items():
                self.add_remapping(kind, name, new_name)

    def _remappings_to_dict(self) -> Dict[str, object]:
        """The part of ``to_dict`` for the remappings; empty if there are none."""
        remappings = {
            kind: {str(name): str(new_name) for name, new_name in new_names.items()}
            for kind, new_names in self._remappings_by_type.items() if new_names}
        return {'remappings': remappings} if remappings else {}


class RemappingSpec(CapabilitySpec, RemapCollection):
    """A spec with remappings: a provider, or a semantic interface."""

    def __init__(self, name: str, spec_version: int, description: Optional[str],
                 remappings: Optional[Mapping[str, Mapping[str, str]]]) -> None:
        CapabilitySpec.__init__(self, name, spec_version, description)
        RemapCollection.__init__(self)
        self.add_remappings_by_dict(remappings or {})


def _check_kind(kind: str) -> None:
    """Refuse what is not a kind of remapping."""
    if kind not in REMAPPING_KINDS:
        raise ValueError('%s is not a kind of remapping, expected %s' % (
            shown(kind), ', '.join(REMAPPING_KINDS)))


def read_remappings(reading: SpecReading, spec: RemappingSpec) -> None:
    """Add the remappings that a spec has in its file; InvalidSpec if one cannot be used."""
    kinds = reading.spec.mapping('remappings')
    for kind in kinds:
        if kind not in REMAPPING_KINDS:
            raise kinds.unknown_key(kind, REMAPPING_KINDS, 'kind')
        new_names = kinds.mapping(kind, 'remappings of ' + kind, is_checked=False)
        for key in new_names:
            name = new_names.key_text(key, 'the name of a remapping')
            try:
                spec.add_remapping(kind, name, new_names.text_at(key, 'the new name of %s'))
            except RuntimeError as error:
                raise reading.fault(
                    str(error), new_names.key_place(key), 'duplicate-key') from None
        for name, lost, place in getattr(new_names.data, 'repeated', ()):
            if lost != new_names.get(name):
                raise reading.fault(_two_names(name, lost, new_names.get(name)), place,
                                    'duplicate-key')
            reading.warn('duplicate key %s, remapped to the same name' % shown(name), place,
                         'duplicate-key')


def _two_names(name: str, new_name: object, other: object) -> str:
    return '%s is remapped to %s and to %s' % (shown(name), shown(new_name), shown(other))
