"""The services of the capability server: each request handed to the runtime, and its answer."""
from __future__ import annotations

import logging
from typing import Callable, List

import capabilities.srv as srv
import rospy
from std_srvs.srv import Empty, EmptyResponse

from capabilities.bonds import Bonds
from capabilities.catalogue import Catalogue
from capabilities.merged_remappings import merged_remappings, with_dependencies
from capabilities.messages import remapping_messages, running_message, spec_message
from capabilities.msg import CapabilitySpec, CapabilityStatuses
from capabilities.parameters import InvalidConfiguration
from capabilities.runtime import Runtime
from rocon_uri.sources.wording import printable, quoted

__all__ = ['Services']

_logger = logging.getLogger('rosout.capabilities')


class Services:
    """
    The services, below the name of the node.

    :param Runtime runtime: does what is asked for
    :param Bonds bonds: makes the bonds of clients
    :param status: makes the answer of ``get_status``
    :param read: makes a new catalogue, for a reload
    """

    def __init__(self, runtime: Runtime, bonds: Bonds,
                 status: Callable[[], CapabilityStatuses], read: Callable[[], Catalogue]) -> None:
        self._runtime = runtime
        self._bonds = bonds
        self._status = status
        self._read = read
        self._services: List[rospy.Service] = []

    def advertise_status(self) -> None:
        """Offer ``get_status``, which answers before anything can be started."""
        self._advertise('get_status', srv.GetStatus, self._get_status)

    def advertise(self) -> None:
        """Offer all others."""
        for name, service, handler in (
                ('get_nodelet_manager_name', srv.GetNodeletManagerName, self._get_manager_name),
                ('get_interfaces', srv.GetInterfaces, self._get_interfaces),
                ('get_semantic_interfaces', srv.GetSemanticInterfaces, self._get_semantic),
                ('get_providers', srv.GetProviders, self._get_providers),
                ('get_capability_specs', srv.GetCapabilitySpecs, self._get_specs),
                ('get_capability_spec', srv.GetCapabilitySpec, self._get_spec),
                ('get_remappings', srv.GetRemappings, self._get_remappings),
                ('get_running_capabilities', srv.GetRunningCapabilities, self._get_running),
                ('reload_capabilities', Empty, self._reload),
                ('plan_capability', srv.PlanCapability, self._plan),
                ('start_capability', srv.StartCapability, self._start),
                ('stop_capability', srv.StopCapability, self._stop),
                ('free_capability', srv.FreeCapability, self._free),
                ('use_capability', srv.UseCapability, self._use),
                ('establish_bond', srv.EstablishBond, self._establish_bond)):
            self._advertise(name, service, handler)

    def _advertise(self, name: str, service: type, handler: Callable[..., object]) -> None:
        self._services.append(rospy.Service(
            '~' + name, service, self._answering(handler), error_handler=_log))

    def _answering(self, handler: Callable[..., object]) -> Callable[[object], object]:
        """Wrap a handler so that each error is one line, which rospy sends to the client."""
        def answer(request: object) -> object:
            try:
                self._runtime.check_running()
                return handler(request)
            except RuntimeError as error:
                raise RuntimeError(printable(str(error))) from None
            except Exception as error:
                _logger.debug('while a request was handled', exc_info=True)
                raise RuntimeError('internal error: %s: %s' % (
                    type(error).__name__, printable(str(error)))) from None
        return answer

    # starting and stopping

    def _start(self, request: srv.StartCapabilityRequest) -> srv.StartCapabilityResponse:
        result = self._runtime.start(request.capability, request.preferred_provider)
        return srv.StartCapabilityResponse(result.value)

    def _stop(self, request: srv.StopCapabilityRequest) -> srv.StopCapabilityResponse:
        self._runtime.stop(request.capability)
        return srv.StopCapabilityResponse(True)

    def _use(self, request: srv.UseCapabilityRequest) -> srv.UseCapabilityResponse:
        self._runtime.use(request.capability, request.preferred_provider, request.bond_id)
        return srv.UseCapabilityResponse()

    def _free(self, request: srv.FreeCapabilityRequest) -> srv.FreeCapabilityResponse:
        self._runtime.free(request.capability, request.bond_id)
        return srv.FreeCapabilityResponse()

    def _establish_bond(self, request: srv.EstablishBondRequest) -> srv.EstablishBondResponse:
        bond_id = self._bonds.new_id()
        self._runtime.bond_made(bond_id)
        self._bonds.start(bond_id)
        return srv.EstablishBondResponse(bond_id)

    def _reload(self, request: object) -> EmptyResponse:
        try:
            self._runtime.reload(self._read)
        except InvalidConfiguration as error:
            raise RuntimeError(str(error)) from None
        return EmptyResponse()

    def _plan(self, request: srv.PlanCapabilityRequest) -> srv.PlanCapabilityResponse:
        plan = self._runtime.plan(request.capability, request.preferred_provider)
        return srv.PlanCapabilityResponse(
            [step.capability for step in plan.steps], [step.provider for step in plan.steps],
            [step.running for step in plan.steps], [fault.reason for fault in plan.faults])

    # queries

    def _get_status(self, request: object) -> srv.GetStatusResponse:
        return srv.GetStatusResponse(self._status())

    def _get_manager_name(self, request: object) -> srv.GetNodeletManagerNameResponse:
        return srv.GetNodeletManagerNameResponse(self._runtime.manager.nodelet_manager_name)

    def _get_interfaces(self, request: object) -> srv.GetInterfacesResponse:
        return srv.GetInterfacesResponse(self._runtime.catalogue.spec_index.interface_names)

    def _get_semantic(self, request: srv.GetSemanticInterfacesRequest
                      ) -> srv.GetSemanticInterfacesResponse:
        return srv.GetSemanticInterfacesResponse(
            self._runtime.catalogue.redefined_by(request.interface))

    def _get_providers(self, request: srv.GetProvidersRequest) -> srv.GetProvidersResponse:
        catalogue = self._runtime.catalogue
        if not request.interface:
            return srv.GetProvidersResponse(catalogue.spec_index.provider_names, '')
        if not catalogue.has(request.interface):
            raise RuntimeError('Capability Interface %s not found.' % quoted(request.interface))
        interfaces = [request.interface]
        if request.include_semantic:
            interfaces += catalogue.redefined_by(request.interface)
        providers = [provider for interface in interfaces
                     for provider in catalogue.spec_index.providers_of(interface)]
        return srv.GetProvidersResponse(providers, catalogue.defaults.get(request.interface, ''))

    def _get_specs(self, request: object) -> srv.GetCapabilitySpecsResponse:
        catalogue = self._runtime.catalogue
        return srv.GetCapabilitySpecsResponse(
            [spec_message(catalogue, name) for name in catalogue.spec_index.names])

    def _get_spec(self, request: srv.GetCapabilitySpecRequest) -> srv.GetCapabilitySpecResponse:
        catalogue = self._runtime.catalogue
        if request.capability_spec not in catalogue.contents:
            raise RuntimeError('Could not find requested spec %s' % quoted(request.capability_spec))
        spec: CapabilitySpec = spec_message(catalogue, request.capability_spec)
        return srv.GetCapabilitySpecResponse(spec)

    def _get_running(self, request: object) -> srv.GetRunningCapabilitiesResponse:
        with self._runtime.lock:
            graph = self._runtime.graph
            return srv.GetRunningCapabilitiesResponse(
                [running_message(graph, instance) for instance in graph.instances
                 if instance.is_up])

    def _get_remappings(self, request: srv.GetRemappingsRequest) -> srv.GetRemappingsResponse:
        with self._runtime.lock:
            found = [instance for instance in self._runtime.graph.instances
                     if request.spec in (instance.interface, instance.provider)]
            # of two, the first stops
            specs = [one.spec for one in with_dependencies(found[-1])] if found else []
        if not specs:
            raise RuntimeError('Spec %s is neither a running Interface nor a running Provider.'
                               % quoted(request.spec))
        merged = merged_remappings(specs)
        return srv.GetRemappingsResponse(*[
            remapping_messages(merged[kind].items())
            for kind in ('topics', 'services', 'actions', 'parameters')])


def _log(error: Exception, *more: object) -> None:
    """Log the error of a request."""
    is_usual = 'because it is not running' in str(error)
    _logger.log(logging.WARNING if is_usual else logging.ERROR, '%s', error)
