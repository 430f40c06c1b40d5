"""What the files that are checked may refer to: all that the packages around them export."""
from __future__ import annotations

from capabilities.discovery import (
    spec_file_index_from_package_index, spec_index_from_spec_file_index)
from capabilities.planning.providers import find_cycles
from capabilities.specs.common import InvalidSpec
from rocon_uri.package_rules import vocabulary_from_package_index
from rocon_uri.apps.rapps import (
    rapp_file_index_from_package_index, rapps_from_rapp_file_index, with_inheritance)
from rocon_uri.sources.launch_file import LaunchFiles

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Dict, Iterator, List, Optional, Tuple
    from capabilities.specs.interface import CapabilityInterface

__all__ = ['Surroundings']


class Surroundings:
    """
    What a set of packages exports.

    :param package_index: dict of catkin_pkg packages by name

    - ``spec_index``: `capabilities.discovery.SpecIndex`
    - ``capabilities``: dict of the interfaces and semantic interfaces by name
    - ``providers``: dict of the providers by name
    - ``cycles``: dict of `capabilities.faults.Fault` by the providers that depend on each other
    - ``rapps``: dict of `rocon_uri.rapp.Rapp` by name, with what they have from their parents;
      ``own_rapps`` of those that can be read, with what they say themselves
    - ``vocabulary``: `rocon_uri.Vocabulary`
    - ``launch_files``: `LaunchFiles`, those that were looked at
    - ``faults``: list of what could not be read, or not be used as it is
    """

    def __init__(self, package_index: Dict[str, Any]) -> None:
        self.launch_files = LaunchFiles()
        self.spec_index, spec_faults = spec_index_from_spec_file_index(
            spec_file_index_from_package_index(package_index))
        self.capabilities: Dict[str, Any] = {**self.spec_index.interfaces,
                                             **self.spec_index.semantic_interfaces}
        self.providers = self.spec_index.providers
        self.cycles = {provider: fault for fault in find_cycles(self.spec_index)
                       for provider in fault.cycle}
        self.own_rapps, rapp_faults = rapps_from_rapp_file_index(
            rapp_file_index_from_package_index(package_index))
        self.rapps, more_rapp_faults = with_inheritance(self.own_rapps.values())
        self.vocabulary, rules_faults = vocabulary_from_package_index(package_index)
        self.faults: List[Exception] = [*spec_faults, *rapp_faults, *more_rapp_faults,
                                        *rules_faults]

    def specs(self) -> Iterator[Tuple[str, Any]]:
        """All specs, each as (path of its file, spec)."""
        index = self.spec_index
        for paths in index.interface_paths, index.semantic_interface_paths, index.provider_paths:
            for name, path in paths.items():
                yield path, self.capabilities.get(name) or self.providers[name]

    def interface(self, name: str) -> Optional[CapabilityInterface]:
        """
        The interface of a name, as a client of it sees it.

        :param str name: that of an interface or of a semantic interface
        :returns: `CapabilityInterface`; None if there is none, or if it does not fit what it
            redefines
        """
        capability: Any = self.capabilities.get(name)
        interface: Optional[CapabilityInterface] = capability
        if capability is not None and capability.spec_type == 'semantic_interface':
            try:
                interface = capability.resolve(self.capabilities[capability.redefines])
            except InvalidSpec:
                interface = None
        return interface
