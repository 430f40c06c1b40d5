"""The values of a plan: `StartPlan`, and the error that refuses one."""
from __future__ import annotations

from typing import Dict, List, NamedTuple, Optional, Tuple

from capabilities.planning.faults import Fault, FaultKind
from rocon_uri.sources.wording import quoted

__all__ = ['PlannedProvider', 'RunningProvider', 'StartPlan', 'error_text']


class RunningProvider(NamedTuple):
    """
    A provider that waits, starts, runs or stops when a plan is made.

    >>> RunningProvider('navigation/Navigation', 'navigation/nav_stack').ends
    False
    """

    #: the interface or semantic interface that it is the instance of
    capability: str
    #: its name, ``package/name``
    provider: str
    #: the `LaunchFile.real_path` of what it runs; None where it has no launch file
    launch_file: Optional[str] = None
    #: is it being stopped? Then no plan shares it, but its launch file is still in use.
    ends: bool = False


class PlannedProvider(NamedTuple):
    """
    One provider of a plan.

    >>> PlannedProvider('navigation/Navigation', 'navigation/nav_stack', False).required_by
    """

    #: the interface or semantic interface that it is the instance of: what it implements
    capability: str
    #: its name, ``package/name``
    provider: str
    #: does it run already? Then it is shared, and nothing is started.
    running: bool
    #: the `LaunchFile.real_path` of what it runs; None where there is none, or none was looked at
    launch_file: Optional[str] = None
    #: the instances that it depends on directly, by their capabilities
    depends_on: Tuple[str, ...] = ()
    #: the provider that depends on it (the first, if several do); None for what was asked for
    required_by: Optional[str] = None


class StartPlan(NamedTuple):
    """
    The providers that have to run for some capabilities, and the faults.

    >>> StartPlan([], {}, {}, []).can_start
    True
    """

    #: the providers to start, each once and after those it depends on; those that run already are
    #: not among them. With faults it is what could be found of it.
    order: List[str]
    #: the provider chosen for each capability that is reached
    providers: Dict[str, str]
    #: the providers that each of the providers depends on directly
    dependencies: Dict[str, List[str]]
    #: all faults, in the order in which they were met; then conflicts, then one cycle
    #: of each set of providers that all depend on each other, then what cannot be launched in the
    #: order of the start, then launch files that are shared
    faults: List[Fault]
    #: the providers of the plan in the order of the start, with those that run already
    steps: Tuple[PlannedProvider, ...] = ()
    #: the launch files that could not be judged, since they were never read
    unread: Tuple[str, ...] = ()

    @property
    def can_start(self) -> bool:
        """Can it be started? (bool)"""
        return not self.faults


def error_text(plan: StartPlan) -> str:
    """
    The error by which the capability server refuses a plan: its faults, as `Fault.reason` has them.

    Clients recognise three errors of the earlier server by their texts, which therefore stand in
    front of the faults.

    :param StartPlan plan: one that has faults
    :returns: str of one line

    >>> fault = Fault(FaultKind.NO_INTERFACE, 'ours/Map', 'ours/Map')
    >>> error_text(StartPlan([], {}, {}, [fault]))
    "Capability 'ours/Map' not found. capability 'ours/Map': no package exports this capability"
    """
    texts = '; '.join(fault.reason for fault in plan.faults)
    head = next(filter(None, map(_recognised_text, plan.faults)), None)
    return texts if head is None else '%s %s' % (head, texts)


def _recognised_text(fault: Fault) -> Optional[str]:
    """The text by which clients recognise a fault; None for most faults."""
    is_asked_for = fault.required_by is None
    if fault.kind is FaultKind.NO_INTERFACE and is_asked_for:
        return 'Capability %s not found.' % quoted(fault.capability)
    if fault.is_default or fault.provider is None:
        return None
    if fault.kind in (FaultKind.UNKNOWN_PROVIDER, FaultKind.WRONG_PROVIDER) and is_asked_for:
        return 'Capability Provider %s not found for Capability %s' % (
            quoted(fault.provider), quoted(fault.capability))
    if fault.kind is FaultKind.UNKNOWN_PROVIDER:
        return 'Capability Provider %s not found' % quoted(fault.provider)
    return None
