"""
What the capability server offers: the specs that its filters leave, and the default providers.

A `Catalogue` is made whole and never changed, so that a reload replaces one by another.
"""
from __future__ import annotations

import logging
from typing import Dict, Iterable, List, NamedTuple, Optional, Set, Union

from capabilities.discovery import (
    spec_file_index_from_package_index, spec_index_from_spec_file_index)
from capabilities.parameters import InvalidConfiguration, Parameters
from capabilities.planning.faults import Fault
from capabilities.planning.providers import choose_provider
from capabilities.spec_index import InterfaceNameNotFoundException, SpecIndex
from capabilities.specs.interface import CapabilityInterface
from capabilities.specs.provider import CapabilityProvider
from capabilities.specs.semantic_interface import SemanticCapabilityInterface
from rocon_uri.sources.packages import PackageError, find_packages
from rocon_uri.sources.wording import did_you_mean, near_misses, quoted

Spec = Union[CapabilityInterface, SemanticCapabilityInterface, CapabilityProvider]

__all__ = ['Catalogue', 'Spec', 'catalogue_of', 'default_providers', 'load_specs',
           'read_catalogue']

_logger = logging.getLogger('rosout.capabilities')


class Catalogue(NamedTuple):
    """
    The specs that are offered.

    >>> Catalogue(SpecIndex(), {}, {}).redefined_by('a_package/Camera')
    []
    """

    #: the specs that the filters leave
    spec_index: SpecIndex
    #: default providers by interface name; interfaces without a default are left out
    defaults: Dict[str, str]
    #: the text of each spec file, by the name of the spec
    contents: Dict[str, str]

    def redefines(self, capability: str) -> Optional[str]:
        """The interface that a semantic interface redefines; None for any other name."""
        spec = self.spec_index.semantic_interfaces.get(capability)
        return None if spec is None else spec.redefines

    def redefined_by(self, interface: str) -> List[str]:
        """The semantic interfaces that redefine an interface; '' for all of them."""
        return [name for name, spec in self.spec_index.semantic_interfaces.items()
                if interface in ('', spec.redefines)]

    def has(self, capability: str) -> bool:
        """Is there an interface or semantic interface of this name? (bool)"""
        return (capability in self.spec_index.interface_names
                or capability in self.spec_index.semantic_interface_names)


def read_catalogue(package_paths: Iterable[str], parameters: Parameters) -> Catalogue:
    """
    Read the specs that packages export, but for those that are filtered out.

    :param package_paths: the folders to look for packages in, iterable of str
    :param Parameters parameters: the filters and defaults
    :returns: `Catalogue`
    :raises InvalidConfiguration: if a default provider cannot be one, or one is missing that must
        not be
    """
    return catalogue_of(load_specs(package_paths, parameters), parameters)


def catalogue_of(spec_index: SpecIndex, parameters: Parameters) -> Catalogue:
    """
    The catalogue of specs that were read and filtered.

    :returns: `Catalogue`
    :raises InvalidConfiguration: as `read_catalogue` does
    """
    defaults = default_providers(spec_index, parameters)
    paths = {**spec_index.interface_paths, **spec_index.semantic_interface_paths,
             **spec_index.provider_paths}
    contents = {name: _content(spec, paths[name]) for name, spec in spec_index.specs.items()}
    return Catalogue(spec_index=spec_index, defaults=defaults, contents=contents)


def load_specs(package_paths: Iterable[str], parameters: Parameters) -> SpecIndex:
    """
    The specs that packages export, but for those that are filtered out.

    A faulty spec is logged and left out, and so are the specs that need it.

    :returns: `SpecIndex`
    """
    package_errors: List[PackageError] = []
    spec_files = spec_file_index_from_package_index(find_packages(package_paths, package_errors))
    for package_error in package_errors:
        _logger.warning('package left out: %s', package_error)
    left_out = {package for package in spec_files if not _passes(
        package, parameters.package_whitelist, parameters.package_blacklist)}
    spec_index, errors = spec_index_from_spec_file_index(
        {package: files for package, files in spec_files.items() if package not in left_out})
    for error in errors:
        # If the package of its interface is filtered out, a provider is left out on purpose.
        is_expected = (isinstance(error, InterfaceNameNotFoundException)
                       and error.interface.partition('/')[0] in left_out)
        _logger.log(logging.DEBUG if is_expected else logging.ERROR, 'spec left out: %s', error)
    _filter(spec_index, parameters)
    _logger.info('%d interfaces, %d semantic interfaces and %d providers',
                 len(spec_index.interface_names), len(spec_index.semantic_interface_names),
                 len(spec_index.provider_names))
    return spec_index


def default_providers(spec_index: SpecIndex, parameters: Parameters) -> Dict[str, str]:
    """
    Find the default providers, and write them into the interfaces.

    :returns: dict from the names of interfaces and semantic interfaces to their default providers
    :raises InvalidConfiguration: if a default provider cannot be one, or one is missing that must
        not be
    """
    defaults: Dict[str, str] = {}
    missing: List[str] = []
    faults: List[str] = []
    interfaces: Dict[str, Union[CapabilityInterface, SemanticCapabilityInterface]] = {
        **spec_index.interfaces, **spec_index.semantic_interfaces}
    _warn_of_unknown(parameters.defaults, interfaces)
    for name, interface in interfaces.items():
        interface.default_provider = 'unknown'
        candidates = spec_index.providers_of(name)
        wanted = parameters.defaults.get(name)
        if wanted is not None:
            chosen = choose_provider(spec_index, name, None, {name: wanted})
            if not isinstance(chosen, Fault):
                defaults[name] = interface.default_provider = chosen
            elif candidates:
                faults.append(chosen.reason)
            else:
                _logger.warning('a default for %s is not used: no provider of it is left',
                                quoted(name))
        elif len(candidates) == 1:
            defaults[name] = interface.default_provider = candidates[0]
        elif candidates:
            missing.append(name)
    if missing and parameters.missing_default_provider_is_an_error:
        faults += ['no default provider for %s, which has several' % quoted(name)
                   for name in missing]
    elif missing:
        _logger.warning('%d with several providers and no default: %s', len(missing),
                        ', '.join(missing))
    if faults:
        raise InvalidConfiguration(faults)
    return defaults


def _warn_of_unknown(defaults: Dict[str, str], interfaces: Iterable[str]) -> None:
    """Warn of defaults for interfaces that do not exist."""
    known = set(interfaces)
    for name in defaults:
        if name not in known:
            _logger.warning('a default for %s is not used: there is no such interface%s',
                            quoted(name), did_you_mean(near_misses(name, known)))


def _passes(name: str, whitelist: List[str], blacklist: List[str]) -> bool:
    """Does a name pass the filter? An empty whitelist lets all pass."""
    return (not whitelist or name in whitelist) and name not in blacklist


def _filter(spec_index: SpecIndex, parameters: Parameters) -> None:
    """Remove the specs that do not pass the filters, and the providers of removed interfaces."""
    removed: Set[str] = set()
    for names, remove in (
            (spec_index.interface_names, spec_index.remove_interface),
            (spec_index.semantic_interface_names, spec_index.remove_semantic_interface),
            (spec_index.provider_names, spec_index.remove_provider)):
        for name in names:
            if not _passes(name, parameters.whitelist, parameters.blacklist):
                remove(name)
                removed.add(name)
    for name, provider in spec_index.providers.items():
        if provider.implements in removed:
            spec_index.remove_provider(name)


def _content(spec: Spec, path: str) -> str:
    """The text of a spec's file; that of the spec itself if the file has gone meanwhile."""
    try:
        with open(path, encoding='utf-8', errors='replace', newline='') as file:
            return file.read()
    except OSError:
        return spec.to_yaml()
