"""The messages of the capability server. Their stamps are wall-clock times."""
from __future__ import annotations

from typing import Iterable, List

from genpy import Time

from capabilities.catalogue import Catalogue
from capabilities.instances import CapabilityInstance, State
from capabilities.msg import (
    Capability, CapabilityEvent, CapabilitySpec, CapabilityStatus, CapabilityStatuses, Remapping,
    RunningCapability)
from capabilities.roster import Roster
from capabilities.status import FAILED, StatusEntry

try:
    from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
except ImportError:         # it is not needed
    DiagnosticArray = None

__all__ = ['DiagnosticArray', 'diagnostics_message', 'event_message', 'ready_message',
           'remapping_messages', 'running_message', 'spec_message', 'status_message']

_EVENTS = {'launched': CapabilityEvent.LAUNCHED, 'stopped': CapabilityEvent.STOPPED,
           'terminated': CapabilityEvent.TERMINATED}

_SPEC_TYPES = {'interface': 'capability_interface',
               'semantic_interface': 'semantic_capability_interface',
               'provider': 'capability_provider'}


def event_message(event: str, capability: str, provider: str, pid: int,
                  stamp: float) -> CapabilityEvent:
    """The event that something was ``launched``, is being ``stopped`` or has ``terminated``."""
    message = CapabilityEvent(capability=capability, provider=provider, type=_EVENTS[event],
                              pid=pid)
    message.header.stamp = Time.from_sec(stamp)
    return message


def ready_message() -> CapabilityEvent:
    """The event that the server is ready."""
    return CapabilityEvent(type=CapabilityEvent.SERVER_READY)


def spec_message(catalogue: Catalogue, name: str) -> CapabilitySpec:
    """A spec, by its name; KeyError if there is none."""
    spec = catalogue.spec_index.specs[name]
    return CapabilitySpec(name.partition('/')[0], _SPEC_TYPES[spec.spec_type],
                          catalogue.contents[name], catalogue.defaults.get(name, ''))


def running_message(roster: Roster, instance: CapabilityInstance) -> RunningCapability:
    """A capability that is listed as running."""
    return RunningCapability(
        Capability(instance.interface, instance.provider),
        [Capability(other.interface, other.provider) for other in roster.dependents(instance)],
        instance.started_by, instance.pid)


def remapping_messages(new_names: Iterable[tuple[str, str]]) -> List[Remapping]:
    """Pairs of a name and its new name."""
    return [Remapping(name, new_name) for name, new_name in new_names]


def status_message(entries: Iterable[StatusEntry], server: str, ready: bool,
                   stamp: float) -> CapabilityStatuses:
    """The status of all capabilities."""
    message = CapabilityStatuses(server=server, ready=ready, capabilities=[
        CapabilityStatus(**entry._replace(since=Time.from_sec(entry.since))._asdict())
        for entry in entries])
    message.header.stamp = Time.from_sec(stamp)
    return message


def diagnostics_message(entries: Iterable[StatusEntry], server: str,
                        stamp: float) -> DiagnosticArray:
    """The diagnosis of all capabilities; only where diagnostic_msgs is installed."""
    message = DiagnosticArray(status=[_diagnosis(entry, server) for entry in entries])
    message.header.stamp = Time.from_sec(stamp)
    return message


def _diagnosis(entry: StatusEntry, server: str) -> DiagnosticStatus:
    level = {FAILED: DiagnosticStatus.ERROR, State.DEGRADED.value: DiagnosticStatus.WARN}.get(
        entry.state, DiagnosticStatus.OK)
    values = [('provider', entry.provider), ('state', entry.state), ('pid', entry.pid),
              ('started', entry.started), ('uses', entry.uses),
              ('dependents', ', '.join(entry.dependents))]
    return DiagnosticStatus(
        level, '%s: %s' % (server.lstrip('/'), entry.capability),
        '%s: %s' % (entry.state, entry.text) if entry.text else entry.state, entry.provider,
        [KeyValue(key, str(value)) for key, value in values])
