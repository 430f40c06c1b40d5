"""Plans starts beside the running capabilities, and makes the instances."""
from __future__ import annotations

import os
from typing import List

from capabilities.catalogue import Catalogue
from capabilities.instances import USER_SERVICE_REASON, CapabilityInstance
from capabilities.planning.plan import RunningProvider, StartPlan
from capabilities.planning.providers import plan_start
from capabilities.roster import Roster
from rocon_uri.sources.launch_file import LaunchFiles

__all__ = ['Starts', 'running_providers']


def running_providers(roster: Roster) -> List[RunningProvider]:
    """
    All instances, in the form that a plan takes.

    >>> running_providers(Roster(lambda: 0.0))
    []
    """
    return [RunningProvider(capability=instance.interface, provider=instance.provider,
                            launch_file=instance.launch_file,
                            ends=roster.stopping(instance.interface) is instance)
            for instance in roster.instances]


class Starts:
    """Plans starts, and remembers the launch files that it has read."""

    def __init__(self) -> None:
        #: bool: is there a nodelet manager that providers can use?
        self.has_nodelet_manager = False
        self._launch_files = LaunchFiles()

    def plan(self, catalogue: Catalogue, capability: str, preferred: str,
             running: List[RunningProvider], may_read: bool) -> StartPlan:
        """
        What a start of a capability would do.

        :param str preferred: the provider that is asked for, '' for any
        :param running: list of `RunningProvider`
        :param bool may_read: else launch files that are not known are left in the plan's ``unread``
        :returns: `StartPlan`
        """
        launch_files = self._launch_files
        return plan_start(catalogue.spec_index, capability, preferred, catalogue.defaults, running,
                          launch_files if may_read else launch_files.remembered(),
                          self.has_nodelet_manager)

    def instances(self, catalogue: Catalogue, plan: StartPlan) -> List[CapabilityInstance]:
        """
        New instances for a plan without faults; reads no file.

        :returns: list of `CapabilityInstance`, dependencies first
        """
        providers = catalogue.spec_index.providers
        paths = catalogue.spec_index.provider_paths
        launch_files = self._launch_files.remembered()
        instances = []
        for step in plan.steps:
            if not step.running:
                spec, path = providers[step.provider], paths[step.provider]
                uses_nodelet_manager = spec.nodelet_manager is not None
                if spec.launch_file is not None:
                    launch_file = launch_files.look_at(spec.launch_file, os.path.dirname(path))
                    uses_nodelet_manager |= (launch_file is not None
                                             and launch_file.names_nodelet_manager)
                instances.append(CapabilityInstance(
                    spec, path, step.required_by or USER_SERVICE_REASON,
                    catalogue.redefines(step.capability), step.launch_file, step.depends_on,
                    uses_nodelet_manager))
        return instances
