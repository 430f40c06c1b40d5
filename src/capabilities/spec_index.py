"""
All capability specs of a package path, each by its name, ``package/name``.

A `SpecIndex` returns the specs themselves, in a new dict or list for each call: a change to one of
those does not change the index, a change to a spec does. What it refuses is raised, as
`DuplicateNameException`, `InterfaceNameNotFoundException` or, where the name of another package is
in front of its own, `capabilities.specs.common.InvalidSpec`.

It is usually made by `capabilities.discovery.spec_index_from_spec_file_index`.
"""
from __future__ import annotations

from capabilities.refused_specs import DuplicateNameException, InterfaceNameNotFoundException
from capabilities.specs.common import InvalidSpec
from rocon_uri.sources.located import with_id
from rocon_uri.sources.wording import NamesByPart, NearMisses, quoted, quoted_path
from rocon_uri.sources.yaml_data import value_place

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Dict, List, Optional, Tuple, TypeVar, Union

    from capabilities.specs.interface import CapabilityInterface
    from capabilities.specs.provider import CapabilityProvider
    from capabilities.specs.semantic_interface import SemanticCapabilityInterface

    Capability = Union[CapabilityInterface, SemanticCapabilityInterface]
    Spec = Union[Capability, CapabilityProvider]
    S = TypeVar('S')
    T = TypeVar('T')
    Entries = Dict[str, Tuple[S, str]]      # what is there and its path, by name

__all__ = ['DuplicateNameException', 'InterfaceNameNotFoundException', 'SpecIndex']


def _view(made_by: Callable[[SpecIndex], T], doc: str) -> T:
    """A property of `SpecIndex`, which type checkers take for what it returns."""
    return property(made_by, doc=doc)     # type: ignore[return-value]


class SpecIndex:
    """
    Capability interfaces, semantic interfaces and providers by ``package/name``.

    All are in the order in which they were added, and no two have the same name, of whichever kind
    they are. A new index is empty.

    >>> SpecIndex().names
    []
    """

    def __init__(self) -> None:
        self._interfaces: Entries[CapabilityInterface] = {}
        self._semantic_interfaces: Entries[SemanticCapabilityInterface] = {}
        self._providers: Entries[CapabilityProvider] = {}
        self._providers_of: Dict[str, Dict[str, None]] = {}    # sets that keep their order
        self._redefinitions_of: Dict[str, Dict[str, None]] = {}
        # by provider and semantic interface, as it was when that was added
        self._refers_to: Dict[str, str] = {}
        self._names_like: Dict[str, NamesByPart] = {}      # by kind, as far as they were needed
        self._near_misses = NearMisses()

    def __repr__(self) -> str:
        return '<SpecIndex: %d interfaces, %d semantic interfaces, %d providers>' % (
            len(self._interfaces), len(self._semantic_interfaces), len(self._providers))

    @property
    def names(self) -> List[str]:
        """The names of all specs, a list: interfaces, then semantic interfaces, then providers."""
        return list(self.specs)

    @property
    def specs(self) -> Dict[str, Spec]:
        """All specs by name, a dict, in the order of `names`."""
        specs: Dict[str, Spec] = {}
        specs.update(self.interfaces)
        specs.update(self.semantic_interfaces)
        specs.update(self.providers)
        return specs

    interfaces = _view(lambda index: _specs(index._interfaces),
                       'The interfaces by name: dict of `CapabilityInterface`.')
    semantic_interfaces = _view(
        lambda index: _specs(index._semantic_interfaces),
        'The semantic interfaces by name: dict of `SemanticCapabilityInterface`.')
    providers = _view(lambda index: _specs(index._providers),
                      'The providers by name: dict of `CapabilityProvider`.')
    interface_names = _view(lambda index: list(index._interfaces),
                            'The names of the interfaces: list of str.')
    semantic_interface_names = _view(lambda index: list(index._semantic_interfaces),
                                     'The names of the semantic interfaces: list of str.')
    provider_names = _view(lambda index: list(index._providers),
                           'The names of the providers: list of str.')
    interface_paths = _view(lambda index: _paths(index._interfaces),
                            'The files of the interfaces by name: dict of str.')
    semantic_interface_paths = _view(lambda index: _paths(index._semantic_interfaces),
                                     'The files of the semantic interfaces by name: dict of str.')
    provider_paths = _view(lambda index: _paths(index._providers),
                           'The files of the providers by name: dict of str.')

    def providers_of(self, interface_name: str) -> List[str]:
        """
        The providers that implement an interface or a semantic interface.

        A provider of a semantic interface does not implement the interface that it redefines, nor
        the other way round: the two have different ROS names.

        :param str interface_name: ``package/name``
        :returns: list of str, their names; empty for an interface that does not exist

        >>> SpecIndex().providers_of('a_package/RGBCamera')
        []
        """
        return list(self._providers_of.get(interface_name, ()))

    def redefinitions_of(self, interface_name: str) -> List[str]:
        """
        The semantic interfaces that redefine an interface.

        :param str interface_name: ``package/name``
        :returns: list of str, their names; empty for an interface that does not exist

        >>> SpecIndex().redefinitions_of('a_package/RGBCamera')
        []
        """
        return list(self._redefinitions_of.get(interface_name, ()))

    def capability(self, name: str) -> Optional[Capability]:
        """
        An interface or semantic interface. Unlike `interfaces` it makes no dict.

        :param str name: ``package/name``
        :returns: `CapabilityInterface` or `SemanticCapabilityInterface`; None if there is none

        >>> SpecIndex().capability('a_package/RGBCamera')
        """
        entry = self._interfaces.get(name) or self._semantic_interfaces.get(name)
        return None if entry is None else entry[0]

    def provider(self, name: str) -> Optional[CapabilityProvider]:
        """
        A provider. Unlike `providers` it makes no dict.

        :param str name: ``package/name``
        :returns: `CapabilityProvider`; None if there is none

        >>> SpecIndex().provider('a_package/rgb_camera')
        """
        return self._providers[name][0] if name in self._providers else None

    def provider_path(self, name: str) -> str:
        """
        The file of a provider.

        :param str name: ``package/name``
        :returns: str
        :raises KeyError: if no provider has this name
        """
        return self._providers[name][1]

    def names_like(self, name: str, kind: str) -> List[str]:
        """
        The names of a kind, in which to look for near misses.

        :param str name: ``package/name``
        :param str kind: ``'interfaces'``, ``'capabilities'`` (both kinds of interfaces) or
            ``'providers'``
        :returns: list of str, which is not to be changed
        """
        if kind not in self._names_like:
            names = self._providers if kind == 'providers' else self._interfaces
            self._names_like[kind] = NamesByPart(
                [*names, *(self._semantic_interfaces if kind == 'capabilities' else ())])
        return self._names_like[kind].like(name)

    def add_interface(self, interface: CapabilityInterface, file_path: str,
                      package_name: str) -> None:
        """
        Add an interface, whose name becomes ``package/name``.

        :param interface: `CapabilityInterface`; left as it is if it is refused
        :param str file_path: where it was read from
        :param str package_name: the package that exports it
        :raises InvalidSpec: if it has the name of another package already
        :raises DuplicateNameException: if the name is taken
        """
        name = self._free_name(interface, file_path, package_name)
        interface.name = name
        self._interfaces[name] = interface, str(file_path)
        self._names_like.clear()

    def add_semantic_interface(self, semantic_interface: SemanticCapabilityInterface,
                               file_path: str, package_name: str) -> None:
        """
        Add a semantic interface. Parameters and errors are those of `add_interface`.

        :raises InterfaceNameNotFoundException: if the interface that it redefines does not exist; a
            semantic interface cannot be redefined
        """
        name = self._free_name(semantic_interface, file_path, package_name)
        if semantic_interface.redefines not in self._interfaces:
            raise self._missing(name, semantic_interface, 'redefines', file_path, 'interfaces')
        semantic_interface.name = name
        self._semantic_interfaces[name] = semantic_interface, str(file_path)
        self._refers_to[name] = semantic_interface.redefines
        self._redefinitions_of.setdefault(semantic_interface.redefines, {})[name] = None
        self._names_like.pop('capabilities', None)

    def add_provider(self, provider: CapabilityProvider, file_path: str,
                     package_name: str) -> None:
        """
        Add a provider. Parameters and errors are those of `add_interface`.

        :raises InterfaceNameNotFoundException: if neither an interface nor a semantic interface has
            the name that it implements
        """
        name = self._free_name(provider, file_path, package_name)
        implemented = provider.implements
        if implemented not in self._interfaces and implemented not in self._semantic_interfaces:
            raise self._missing(name, provider, 'implements', file_path, 'capabilities')
        provider.name = name
        self._providers[name] = provider, str(file_path)
        self._refers_to[name] = implemented
        self._providers_of.setdefault(implemented, {})[name] = None
        self._names_like.pop('providers', None)

    def remove_interface(self, name: str) -> None:
        """
        Remove an interface. What redefines or implements it stays.

        :param str name: ``package/name``
        :raises KeyError: if no interface has this name
        """
        del self._interfaces[name]
        self._names_like.clear()

    def remove_semantic_interface(self, name: str) -> None:
        """Remove a semantic interface, as `remove_interface` does an interface."""
        del self._semantic_interfaces[name]
        del self._redefinitions_of[self._refers_to.pop(name)][name]
        self._names_like.pop('capabilities', None)

    def remove_provider(self, name: str) -> None:
        """Remove a provider, as `remove_interface` does an interface."""
        del self._providers[name]
        del self._providers_of[self._refers_to.pop(name)][name]
        self._names_like.pop('providers', None)

    def _free_name(self, spec: Spec, file_path: str, package_name: str) -> str:
        """The name to add a spec by, which it may have already: ``package/name``."""
        package, _, own_name = spec.name.rpartition('/')
        place = value_place(spec.source, 'name')
        if package not in ('', package_name):
            raise with_id(InvalidSpec('name %s is not of package %s, which exports it' % (
                quoted(spec.name), quoted(package_name)), str(file_path), *place), 'illegal-name')
        name = '%s/%s' % (package_name, own_name)
        for kind, entries in (('an interface', self._interfaces),
                              ('a semantic interface', self._semantic_interfaces),
                              ('a provider', self._providers)):
            if name in entries:
                raise DuplicateNameException(
                    '%s is already the name of %s, in %s' % (
                        quoted(name), kind, quoted_path(entries[name][1])),
                    str(file_path), *place, name, package_name, spec.spec_type)
        return name

    def _missing(self, name: str, spec: Spec, key: str, file_path: str, kind: str
                 ) -> InterfaceNameNotFoundException:
        """The error of a spec that redefines or implements an interface that does not exist."""
        interface = getattr(spec, key)
        problem = '%s %s %s %s, which is not an interface that any package exports' % (
            spec.spec_type.replace('_', ' '), quoted(name), key, quoted(interface))
        candidates = self._near_misses.among(self.names_like(interface, kind))
        return InterfaceNameNotFoundException(
            problem, str(file_path), *value_place(spec.source, key), name, name.partition('/')[0],
            spec.spec_type, interface, candidates)


def _specs(entries: Entries[S]) -> Dict[str, S]:
    return {name: spec for name, (spec, _) in entries.items()}


def _paths(entries: Entries[S]) -> Dict[str, str]:
    return {name: path for name, (_, path) in entries.items()}


