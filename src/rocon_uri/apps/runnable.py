"""
Can a rapp run on a robot, and if not, why not?

A rapp runs if it is an implementation, if its compatibility string matches the robot's URI, and if
its launch file and each capability that it requires can be started. The verdict has all reasons
against it, not only the first.
"""
from __future__ import annotations

import os
from enum import Enum
from typing import Collection, Iterator, Mapping, NamedTuple, Optional, Tuple, Union

from capabilities.planning.faults import Fault, FaultKind
from capabilities.planning.providers import plan_for_capabilities
from capabilities.spec_index import SpecIndex
from rocon_uri.apps.rapp import Rapp
from rocon_uri.compatibility import Explanation, explain
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.sources.launch_file import LaunchFiles
from rocon_uri.uri import RoconURI, parse
from rocon_uri.vocabulary import Vocabulary

__all__ = ['REASON_IDS', 'Reason', 'ReasonKind', 'Verdict', 'runnable']


class ReasonKind(Enum):
    """What a reason against running a rapp is about."""

    #: it is virtual, a parent of others only
    VIRTUAL = 'virtual'
    #: its compatibility string does not match the robot, or is not legal
    PLATFORM = 'platform'
    #: its own launch file cannot be started
    LAUNCH = 'launch'
    #: a capability that it requires cannot be had
    CAPABILITY = 'capability'
    #: a capability that it requires has a provider, which lacks something itself
    DEPENDENCY = 'dependency'


#: The ids that reasons may have, in a stable order.
REASON_IDS: Tuple[str, ...] = (ReasonKind.VIRTUAL.value, ReasonKind.PLATFORM.value,
                               *(kind.value for kind in FaultKind
                                 if kind is not FaultKind.NO_NODELET_MANAGER))


class Reason(NamedTuple):
    """
    One thing that is against running a rapp. Its text is one line.

    >>> print(Reason(ReasonKind.VIRTUAL, 'virtual', 'it is virtual: it has no launch'))
    it is virtual: it has no launch
    """

    #: what it is about
    kind: ReasonKind
    #: which kind of thing it is, one of `REASON_IDS`
    id: str
    #: what is wrong; '' if a capability is the reason, since ``fault`` has the text
    problem: str = ''
    #: of the rapp and the robot, if their platforms were compared; its text is a table of fields
    explanation: Optional[Explanation] = None
    #: if a capability is the reason
    fault: Optional[Fault] = None

    def __str__(self) -> str:
        return self.problem if self.fault is None else self.fault.reason


class Verdict(NamedTuple):
    """
    Whether a rapp runs on a robot; true if it does.

    >>> from rocon_uri.apps.rapps import rapp_from_string
    >>> print(Verdict(rapp_from_string('launch: dance.launch', 'ours/dance'), (), ()))
    ours/dance runs
    """

    #: what is judged
    rapp: Rapp
    #: all reasons against it; empty if it runs
    reasons: Tuple[Reason, ...]
    #: the providers of capabilities to start for it, in order; as many as can be had
    providers: Tuple[str, ...]

    def __bool__(self) -> bool:
        return not self.reasons

    def __str__(self) -> str:
        if self:
            return '%s runs' % self.rapp.name
        return '%s does not run: %s' % (self.rapp.name, '; '.join(map(str, self.reasons)))


def runnable(rapp: Rapp, robot_uri: Union[str, RoconURI], spec_index: SpecIndex,
             defaults: Optional[Mapping[str, str]] = None,
             launch_files: Optional[LaunchFiles] = None,
             ignore: Collection[str] = ()) -> Verdict:
    """
    Can this rapp run on this robot?

    :param Rapp rapp: with what it has from its parents
    :param robot_uri: the robot, RoconURI or str; it may have values that are not registered, which
        rapps that run anywhere do not mind
    :param spec_index: `capabilities.discovery.SpecIndex` of the capabilities that the robot has
    :param defaults: mapping of names of interfaces to those of the providers to take for them
    :param launch_files: `LaunchFiles`, to read each launch file once for several rapps
    :param ignore: collection of str, the ids of the reasons to leave out, of `REASON_IDS`
    :returns: `Verdict`
    :raises RoconURIValueError: if the robot's URI is not legal

    >>> from capabilities.discovery import SpecIndex
    >>> from rocon_uri.apps.rapps import rapp_from_file_path
    >>> path = 'examples/workspace/cafe_rapps/rapps/radio/radio.rapp'
    >>> radio = rapp_from_file_path(path, 'cafe_rapps/radio')
    >>> bool(runnable(radio, 'rocon:/pr2/bob', SpecIndex()))
    True
    >>> from rocon_uri.apps.rapps import rapp_from_string
    >>> dance = rapp_from_string('{compatibility: "rocon:/pr2", launch: d.launch}', 'ours/dance')
    >>> print(runnable(dance, 'rocon:/kobuki', SpecIndex(), ignore=['launch-missing']))
    ours/dance does not run: 'rocon:/pr2' does not include this robot: hardware_platform is kobuki
    """
    if isinstance(robot_uri, str):
        parse(robot_uri, Vocabulary.open())     # a fault in it is not the rapp's
    launch_files = launch_files or LaunchFiles()
    plan = plan_for_capabilities(
        spec_index, [capability.name for capability in rapp.required_capabilities], defaults,
        launch_files)
    reasons = (*_platform_reasons(rapp, robot_uri), *_launch_reasons(rapp, launch_files),
               *(Reason(ReasonKind.CAPABILITY if fault.is_of_the_capability else
                        ReasonKind.DEPENDENCY, fault.kind.value, fault=fault)
                 for fault in plan.faults))
    return Verdict(rapp, tuple(reason for reason in reasons if reason.id not in ignore),
                   tuple(plan.order))


def _launch_reasons(rapp: Rapp, launch_files: LaunchFiles) -> Iterator[Reason]:
    if rapp.launch is not None:
        fault = launch_files.look_at(rapp.launch, os.path.dirname(rapp.path)).fault
        if fault is not None:
            yield Reason(ReasonKind.LAUNCH, fault.kind, str(fault))


def _platform_reasons(rapp: Rapp, robot_uri: Union[str, RoconURI]) -> Iterator[Reason]:
    if not rapp.is_implementation:
        lacks = ' and no '.join(key for key in ('compatibility', 'launch')
                             if getattr(rapp, key) is None)
        yield Reason(ReasonKind.VIRTUAL, 'virtual', 'it is virtual: it has no %s' % lacks)
    if rapp.compatibility is None:
        return
    vocabulary = None if isinstance(robot_uri, str) else robot_uri.vocabulary
    try:
        explanation = explain(parse(rapp.compatibility, vocabulary), robot_uri)
    except RoconURIValueError as error:
        yield Reason(ReasonKind.PLATFORM, 'platform', str(error))
        return
    if not explanation:
        wrong = ', '.join('%s is %s' % (comparison.field, comparison.b)
                          for comparison in explanation.fields if not comparison.is_compatible)
        yield Reason(ReasonKind.PLATFORM, 'platform', "'%s' does not include this robot: %s" % (
            explanation.a.short, wrong), explanation)
