"""
All that some packages export, read once: specs, apps and rules, and what is wrong with each.

>>> workspace = read_workspace(['examples/workspace'])
>>> 'cafe_rapps/serve' in workspace.rapps, workspace.faults
(True, [])
"""
from __future__ import annotations

from typing import Dict, Iterable, Iterator, List, Mapping, NamedTuple, Optional, Tuple, Union

from capabilities.discovery import (
    SpecIndex, spec_file_index_from_package_index, spec_index_from_spec_file_index)
from capabilities.planning.faults import Fault
from capabilities.planning.providers import find_cycles
from capabilities.specs.common import InvalidSpec
from capabilities.specs.interface import CapabilityInterface
from capabilities.specs.provider import CapabilityProvider
from capabilities.specs.semantic_interface import SemanticCapabilityInterface
from rocon_uri.apps.app_file import AppFile
from rocon_uri.apps.installed import app_files_from_package_index
from rocon_uri.apps.rapp import Rapp
from rocon_uri.apps.rapps import (
    rapp_file_index_from_package_index, rapps_from_rapp_file_index, with_inheritance)
from rocon_uri.apps.runnable import App
from rocon_uri.sources.located import Fault as FileFault
from rocon_uri.sources.launch_file import LaunchFiles
from rocon_uri.sources.packages import Package, PackageError, find_packages
from rocon_uri.sources.wording import NamesByPart
from rocon_uri.vocabulary import Vocabulary, vocabulary_of_packages

__all__ = ['Workspace', 'load_workspace', 'read_workspace']

Capability = Union[CapabilityInterface, SemanticCapabilityInterface]


class Workspace(NamedTuple):
    """What a set of packages exports."""

    #: the packages by name
    packages: Mapping[str, Package]
    #: the capability specs
    spec_index: SpecIndex
    #: the interfaces and semantic interfaces among them by name
    capabilities: Dict[str, Capability]
    #: the providers among them by name
    providers: Dict[str, CapabilityProvider]
    #: the rapps by name, with what they inherit; those with faulty ancestors are left out
    rapps: Dict[str, Rapp]
    #: all rapps that can be read by name, with what their own files say
    own_rapps: Dict[str, Rapp]
    #: the apps of app_manager by name
    app_files: Dict[str, AppFile]
    #: the names of the capabilities, to look for near misses in
    capability_names: NamesByPart
    #: those of the providers
    provider_names: NamesByPart
    #: those of the rapps
    rapp_names: NamesByPart
    #: the cycle of each provider that depends on itself, through others or not, by its name
    cycles: Dict[str, Fault]
    #: the launch files that were looked at so far
    launch_files: LaunchFiles
    #: what this machine knows, and what the packages add
    vocabulary: Vocabulary
    #: What is wrong, in the order of packages, specs, rapps, other apps and rules: `PackageError`;
    #: the errors of `spec_index_from_spec_file_index`; `InvalidRapp`; `InvalidApp`; `YamlError` and
    #: `OSError`
    faults: List[FileFault]

    def __repr__(self) -> str:
        return '<Workspace: %d packages, %d apps, %r, %d faults>' % (
            len(self.packages), len(list(self.apps())), self.spec_index, len(self.faults))

    def apps(self) -> Iterator[App]:
        """All apps: the rapps, then those of app_manager. Two may have one name."""
        yield from self.rapps.values()
        yield from self.app_files.values()

    def specs(self) -> Iterator[Tuple[str, Union[Capability, CapabilityProvider]]]:
        """All specs, each as (path of its file, spec)."""
        index = self.spec_index
        for paths in index.interface_paths, index.semantic_interface_paths, index.provider_paths:
            for name, path in paths.items():
                yield path, self.capabilities.get(name) or self.providers[name]

    def interface(self, name: str) -> Optional[CapabilityInterface]:
        """
        An interface or semantic interface as its client sees it.

        It is None if no package exports the name, or if it does not fit what it redefines.
        """
        capability = self.capabilities.get(name)
        if not isinstance(capability, SemanticCapabilityInterface):
            return capability
        try:
            return capability.resolve(self.redefined_by(capability))
        except InvalidSpec:
            return None

    def redefined_by(self, semantic: SemanticCapabilityInterface) -> CapabilityInterface:
        """The interface that a semantic interface of this workspace redefines."""
        redefined = self.capabilities[semantic.redefines]
        assert isinstance(redefined, CapabilityInterface)   # the index refuses another
        return redefined


def read_workspace(paths: Iterable[str]) -> Workspace:
    """All that the packages below some folders export."""
    faults: List[PackageError] = []
    return load_workspace(find_packages(paths, faults), faults)


def load_workspace(packages: Mapping[str, Package], faults: Iterable[FileFault] = ()) -> Workspace:
    """
    All that packages export which were found already, with these faults.

    >>> load_workspace({}).rapps
    {}
    """
    index, spec_faults = spec_index_from_spec_file_index(
        spec_file_index_from_package_index(packages))
    own_rapps, rapp_faults = rapps_from_rapp_file_index(
        rapp_file_index_from_package_index(packages))
    rapps, heirs_faults = with_inheritance(own_rapps.values())
    app_files, app_faults = app_files_from_package_index(packages)
    vocabulary, rules_faults = vocabulary_of_packages(packages)
    capabilities: Dict[str, Capability] = {**index.interfaces, **index.semantic_interfaces}
    providers = index.providers
    return Workspace(
        packages=packages, spec_index=index, capabilities=capabilities, providers=providers,
        capability_names=NamesByPart(capabilities), provider_names=NamesByPart(providers),
        rapp_names=NamesByPart(rapps), rapps=rapps, own_rapps=own_rapps, app_files=app_files,
        launch_files=LaunchFiles(), vocabulary=vocabulary,
        cycles={name: fault for fault in find_cycles(index) for name in fault.cycle},
        faults=[*faults, *spec_faults, *rapp_faults, *heirs_faults, *app_faults,
                *rules_faults])
