"""
Capability providers: what implements a capability interface, and what that depends on.

>>> from capabilities.specs.provider import capability_provider_from_file_path
>>> path = 'test/unit/specs/providers/navigation_nav_stack.yaml'
>>> navigation = capability_provider_from_file_path(path)
>>> navigation.implements, navigation.launch_file, navigation.nodelet_manager
('navigation/Navigation', 'launch/navigation_nav_stack.launch', 'nav_manager')
>>> print(navigation.dependencies['laser_capability/LaserObservation'])
laser_capability/LaserObservation:
    preferred provider: hokuyo_capability/hokuyo_base
>>> navigation.remappings
{'scan': 'nav_stack/scan'}
"""
from __future__ import annotations

from typing import Dict, Mapping, Optional

from capabilities.specs._reading import SpecLoader, SpecReading
from capabilities.specs.common import InvalidSpec, SpecName
from capabilities.specs.remappings import RemappingSpec, read_remappings
from rocon_uri.sources.located import Place
from rocon_uri.sources.wording import shown
from rocon_uri.sources.yaml_data import value_place

__all__ = ['CapabilityProvider', 'DependsOnRelationship', 'InvalidProvider',
           'capability_provider_from_dict', 'capability_provider_from_file',
           'capability_provider_from_file_path', 'capability_provider_from_string']


class InvalidProvider(InvalidSpec):
    """A capability provider that is not complete, or has an entry that cannot be used."""


class DependsOnRelationship:
    """
    A capability that a provider depends on.

    :param str capability_name: the name of its interface; also the attribute ``name``
    :param str preferred_provider: the name of the provider to run it with, or ``None``; also the
        attributes ``provider`` and ``provider_preference``

    >>> print(DependsOnRelationship('a_package/Laser', 'b_package/hokuyo'))
    a_package/Laser:
        preferred provider: b_package/hokuyo
    """

    def __init__(self, capability_name: str, preferred_provider: Optional[str]) -> None:
        self.name = capability_name
        self.provider = preferred_provider

    @property
    def capability_name(self) -> str:
        """The same as ``name``."""
        return self.name

    @property
    def preferred_provider(self) -> Optional[str]:
        """The same as ``provider``."""
        return self.provider

    provider_preference = preferred_provider

    def __str__(self) -> str:
        return '%s:\n    preferred provider: %s' % (self.name, self.provider)


class CapabilityProvider(RemappingSpec):
    """
    A capability provider.

    :param str name: its name
    :param int spec_version: the version of the specification, 1
    :param str implements: the name of the interface that it provides
    :param str launch_file: the launch file that runs it, a path relative to the folder of its spec;
        ``None`` if there is nothing to run
    :param str description: free text; ``None`` gives ``'No description given.'``
    :param dict remappings: new names by name, by kind (``{'topics': {'scan': 'laser/scan'}}``)
    :param str nodelet_manager: the name of the nodelet manager that it uses, or ``None``
    :raises ValueError: if there are remappings of another kind
    :raises RuntimeError: if a name is remapped to two others

    The attributes have the names of the parameters and can be set, like those of every spec; but
    ``remappings`` is a copy, a dict of all kinds together.

    >>> CapabilityProvider('navigation', 1, 'navigation/Navigation').dependencies
    {}
    """

    spec_type = 'provider'

    def __init__(self, name: str, spec_version: int, implements: str,
                 launch_file: Optional[str] = None, description: Optional[str] = None,
                 remappings: Optional[Mapping[str, Mapping[str, str]]] = None,
                 nodelet_manager: Optional[str] = None) -> None:
        super().__init__(name, spec_version, description, remappings)
        self.implements = implements
        self.launch_file = launch_file
        self.nodelet_manager = nodelet_manager
        self._dependencies: Dict[SpecName, DependsOnRelationship] = {}

    @property
    def dependencies(self) -> Dict[SpecName, DependsOnRelationship]:
        """Its dependencies by the name of the interface: a new dict."""
        return dict(self._dependencies)

    def depends_on(self, capability_name: str) -> bool:
        """Does it depend on the interface of this name (str)? Returns bool."""
        return capability_name in self._dependencies

    def add_depends_on(self, capability_name: str, preferred_provider: Optional[str] = None
                       ) -> None:
        """
        Add a capability that it depends on. Parameters are those of `DependsOnRelationship`.

        :raises ValueError: if a name is not of the form ``package/name``
        :raises RuntimeError: if it depends on that capability already
        """
        name = SpecName(capability_name)
        provider = None if preferred_provider is None else SpecName(preferred_provider)
        if name in self._dependencies:
            raise RuntimeError('the provider already depends on %s' % shown(name))
        self._dependencies[name] = DependsOnRelationship(name, provider)

    def to_dict(self) -> Dict[str, object]:
        data = super().to_dict()
        data['implements'] = str(self.implements)
        if self.launch_file is not None:
            data['launch_file'] = str(self.launch_file)
        if self._dependencies:
            data['depends_on'] = {
                str(name): {} if dependency.provider is None
                else {'provider': str(dependency.provider)}
                for name, dependency in self._dependencies.items()}
        data.update(self._remappings_to_dict())
        if self.nodelet_manager is not None:
            data['nodelet_manager'] = str(self.nodelet_manager)
        return data


def _make(reading: SpecReading) -> CapabilityProvider:
    provider = CapabilityProvider(
        reading.name, 1, reading.required_name('implements'), reading.spec.text('launch_file'),
        reading.description, nodelet_manager=reading.spec.text('nodelet_manager'))
    _read_dependencies(reading, provider)
    read_remappings(reading, provider)
    return provider


def _read_dependencies(reading: SpecReading, provider: CapabilityProvider) -> None:
    """Add what the provider depends on: one name, a list of names, or a mapping to conditions."""
    given = reading.spec.get('depends_on')
    if isinstance(given, str):
        _add_dependency(reading, provider, given, reading.spec.value_place('depends_on'))
    elif isinstance(given, (list, tuple)):
        for index, name in enumerate(given):
            _add_dependency(reading, provider, name, value_place(given, index))
    elif isinstance(given, dict):
        dependencies = reading.spec.mapping('depends_on')
        for name in dependencies:
            conditions = dependencies.mapping(name, 'depends_on %s')
            for condition in conditions:
                if condition != 'provider':
                    raise conditions.unknown_key(condition, ('provider',), 'condition')
            preferred = conditions.get('provider')
            if preferred is not None:
                preferred = reading.spec_name(preferred, conditions.value_place('provider'),
                                              'provider of depends_on %s', name)
            _add_dependency(reading, provider, name, dependencies.key_place(name), preferred)
    elif given is not None:
        raise reading.spec.wrong('depends_on',
                                 'the name of an interface, a list of names or a mapping')


def _add_dependency(reading: SpecReading, provider: CapabilityProvider, given: object, place: Place,
                    preferred_provider: Optional[str] = None) -> None:
    name = reading.spec_name(given, place, 'depends_on')
    if provider.depends_on(name):
        raise reading.fault('duplicate dependency %s' % shown(name), place, 'duplicate-key')
    provider.add_depends_on(name, preferred_provider)


_loader = SpecLoader(
    'provider', ('implements', 'launch_file', 'depends_on', 'remappings', 'nodelet_manager'),
    InvalidProvider, _make)

# Each is described where SpecLoader defines it, and in its own help().
capability_provider_from_dict = _loader.from_dict
capability_provider_from_file = _loader.from_file
capability_provider_from_file_path = _loader.from_file_path
capability_provider_from_string = _loader.from_string
