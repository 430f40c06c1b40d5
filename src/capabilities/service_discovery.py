"""What is known of capability servers from outside: which there are, and the specs that one has."""
from __future__ import annotations

from typing import Callable, Dict, List, Optional, Tuple

import capabilities.needs_ros  # noqa: F401
import rosgraph
import rospy
from capabilities.msg import CapabilitySpec
from capabilities.spec_index import (
    DuplicateNameException, InterfaceNameNotFoundException, SpecIndex)
from capabilities.specs.common import InvalidSpec
from capabilities.specs.interface import capability_interface_from_string
from capabilities.specs.provider import capability_provider_from_string
from capabilities.specs.semantic_interface import semantic_capability_interface_from_string
from capabilities.srv import GetCapabilitySpecs

__all__ = ['server_names', 'spec_index_from_service']

_PATH = 'service call'      # in place of that of a file


def server_names(caller: str) -> List[str]:
    """
    The capability servers that the master knows.

    :param str caller: the name of the node that asks
    :returns: list of str, the names of their nodes with the ``/`` in front
    :raises OSError: if the master does not answer
    :raises rosgraph.MasterException: if the master answers with an error
    """
    end = '/start_capability'
    services = rosgraph.Master(caller).getSystemState()[2]
    return [service[:-len(end)] for service, _ in services if service.endswith(end)]


def spec_index_from_service(capability_server_node_name: str = 'capability_server',
                            timeout: Optional[float] = None) -> Tuple[SpecIndex, List[Exception]]:
    """
    Ask a capability server for its specs.

    :param str capability_server_node_name: the name of the server's node, with or without the ``/``
        in front
    :param timeout: float, seconds to wait for the server; None to wait for ever
    :returns: (SpecIndex, list of Exception): the specs, of which the interfaces and semantic
        interfaces have the ``default_provider`` of the server, ``''`` where there is none; and the
        errors of what was left out, as `capabilities.discovery.spec_index_from_spec_file_index`
        has them
    :raises rospy.ROSException: if the server does not come up in time
    :raises rospy.ServiceException: if it does not answer
    """
    name = '/%s/get_capability_specs' % capability_server_node_name.lstrip('/')
    rospy.wait_for_service(name, timeout)
    specs = rospy.ServiceProxy(name, GetCapabilitySpecs)().capability_specs
    index = SpecIndex()
    errors: List[Exception] = []
    steps: Dict[str, Callable[[CapabilitySpec], None]] = {
        'capability_interface': lambda spec: _add_interface(index, spec),
        'semantic_capability_interface': lambda spec: _add_semantic_interface(index, spec),
        'capability_provider': lambda spec: _add_provider(index, spec)}
    for kind, add in steps.items():
        for spec in specs:
            if spec.type == kind:
                try:
                    add(spec)
                except (InvalidSpec, DuplicateNameException,
                        InterfaceNameNotFoundException) as error:
                    errors.append(error)
    return index, errors


def _add_interface(index: SpecIndex, spec: CapabilitySpec) -> None:
    interface = capability_interface_from_string(spec.content, _PATH)
    interface.default_provider = spec.default_provider
    index.add_interface(interface, _PATH, spec.package)


def _add_semantic_interface(index: SpecIndex, spec: CapabilitySpec) -> None:
    interface = semantic_capability_interface_from_string(spec.content, _PATH)
    interface.default_provider = spec.default_provider
    index.add_semantic_interface(interface, _PATH, spec.package)


def _add_provider(index: SpecIndex, spec: CapabilitySpec) -> None:
    index.add_provider(capability_provider_from_string(spec.content, _PATH), _PATH, spec.package)
