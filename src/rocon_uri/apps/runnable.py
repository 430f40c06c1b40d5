"""
Can a rapp run on a robot, and if not, what is against it?

A rapp runs where it is an implementation, where its compatibility string meets the robot's URI, and
where each capability that it requires can be started. The verdict has everything that is against,
not only the first.
"""
from __future__ import annotations

from collections import namedtuple
from enum import Enum

from capabilities.planning.faults import Fault, FaultKind
from capabilities.planning.providers import plan_for_capabilities
from rocon_uri.compatibility import explain
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.sources.wording import quoted
from rocon_uri.uri import parse
from rocon_uri.vocabulary import Vocabulary

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Iterator, Mapping, Optional, Union
    from capabilities.spec_index import SpecIndex
    from rocon_uri.apps.rapp import Rapp
    from rocon_uri.uri import RoconURI

__all__ = ['Reason', 'ReasonKind', 'Verdict', 'runnable']


class ReasonKind(Enum):
    """What is against running a rapp."""

    #: it is virtual, a parent of others only
    VIRTUAL = 'virtual'
    #: the robot is no platform for it, or its compatibility string cannot be read
    PLATFORM = 'platform'
    #: a capability that it requires cannot be had
    CAPABILITY = 'capability'
    #: a capability that it requires has a provider, which lacks something itself
    DEPENDENCY = 'dependency'


class Reason(namedtuple('Reason', 'kind problem explanation fault')):
    """
    One thing that is against running a rapp. Its text is one line.

    - ``kind``: `ReasonKind`
    - ``problem``: str, what is wrong with the rapp or the platform; '' if a capability is the
      reason, of which ``fault`` has the text
    - ``explanation``: `rocon_uri.compatibility.Explanation`, of the rapp and the robot, if the
      platform is the reason and could be compared; its text is a table of the fields
    - ``fault``: `capabilities.providers.Fault`, if a capability is the reason
    """

    __slots__ = ()

    def __str__(self) -> str:
        if self.fault is None:
            return str(self.problem)
        if self.kind is ReasonKind.CAPABILITY:
            return str(self.fault)
        return 'capability %s cannot be started: %s' % (quoted(self.fault.asked_for), self.fault)


class Verdict(namedtuple('Verdict', 'rapp reasons providers')):
    """
    Whether a rapp runs on a robot; true if it does.

    - ``rapp``: `rocon_uri.rapp.Rapp`
    - ``reasons``: tuple of `Reason`, everything that is against; empty if it runs
    - ``providers``: tuple of str, the providers of capabilities to start for it, in order; as many
      as can be had
    """

    __slots__ = ()

    def __bool__(self) -> bool:
        return not self.reasons

    def __str__(self) -> str:
        if self:
            return '%s runs' % self.rapp.name
        return '%s does not run: %s' % (self.rapp.name, '; '.join(map(str, self.reasons)))


def runnable(rapp: Rapp, robot_uri: Union[str, RoconURI], spec_index: SpecIndex,
             defaults: Optional[Mapping[str, str]] = None) -> Verdict:
    """
    Can this rapp run on this robot?

    :param Rapp rapp: with what it has from its parents
    :param robot_uri: the robot, RoconURI or str; it may have values that are not registered, which
        rapps that run anywhere do not mind
    :param spec_index: `capabilities.discovery.SpecIndex` of the capabilities that the robot has
    :param defaults: mapping of names of interfaces to those of the providers to take for them
    :returns: `Verdict`
    :raises RoconURIValueError: if the robot's URI is not legal

    >>> from capabilities.discovery import SpecIndex
    >>> from rocon_uri.apps.rapp import rapp_from_string
    >>> dance = rapp_from_string('{compatibility: "rocon:/pr2", launch: d.launch}', 'ours/dance')
    >>> bool(runnable(dance, 'rocon:/pr2/bob', SpecIndex()))
    True
    >>> print(runnable(dance, 'rocon:/kobuki/bob', SpecIndex()))
    ours/dance does not run: 'rocon:/pr2' does not include this robot: hardware_platform is kobuki
    """
    if isinstance(robot_uri, str):
        parse(robot_uri, Vocabulary.open())     # a fault in it is none of the rapp's
    reasons = list(_platform_reasons(rapp, robot_uri))
    plan = plan_for_capabilities(
        spec_index, [capability.name for capability in rapp.required_capabilities], defaults)
    reasons += [_capability_reason(fault) for fault in plan.faults]
    return Verdict(rapp, tuple(reasons), tuple(plan.order))


def _capability_reason(fault: Fault) -> Reason:
    is_its_own = fault.required_by is None and fault.kind not in (FaultKind.CYCLE,
                                                                  FaultKind.CONFLICT)
    return Reason(ReasonKind.CAPABILITY if is_its_own else ReasonKind.DEPENDENCY, '', None, fault)


def _platform_reasons(rapp: Rapp, robot_uri: Union[str, RoconURI]) -> Iterator[Reason]:
    if not rapp.is_implementation:
        lacks = ' and no '.join(key for key in ('compatibility', 'launch')
                             if getattr(rapp, key) is None)
        yield Reason(ReasonKind.VIRTUAL, 'it is virtual: it has no %s' % lacks, None, None)
    if rapp.compatibility is None:
        return
    vocabulary = None if isinstance(robot_uri, str) else robot_uri.vocabulary
    try:
        explanation = explain(parse(rapp.compatibility, vocabulary), robot_uri)
    except RoconURIValueError as error:
        yield Reason(ReasonKind.PLATFORM, str(error), None, None)
        return
    if not explanation:
        wrong = ['%s is %s' % (comparison.field, comparison.b)
                 for comparison in explanation.fields if not comparison.is_compatible]
        yield Reason(ReasonKind.PLATFORM, "'%s' does not include this robot: %s" % (
            explanation.a.short, ', '.join(wrong)), explanation, None)
